use super::{BUS, body, wrong};

/// The one error of this scene.
fn only(text: &str) -> String {
    let errors = wrong(text);
    assert_eq!(errors.len(), 1, "{errors:#?}");
    errors[0].clone()
}

#[test]
fn everything_that_is_wrong_is_said_at_once() {
    let text = BUS.replace("100.0", "\"heavy\"").replace("end = ", "ende = ")
        + &body("boom", "colour = 3", "latch_deg = 0\nlatch_rad = 0.0");
    let errors = wrong(&text);
    let expected = [
        "a.toml:3:1: ende: found `ende` in run, expected a key of this table; did you mean `end`?",
        "a.toml:6:9: mass: found `heavy`, expected a number, a parameter `$name` or `(`",
        "a.toml:14:1: colour: found `colour` in body, expected a key of this table",
        "a.toml:20:1: latch_rad: found `latch_rad` beside `latch_deg`, expected one of them",
    ];
    assert_eq!(errors, expected);
}

#[test]
fn a_key_of_a_table_nearby_is_told_as_such() {
    let of_body = body("boom", "", "coupling = []");
    assert!(
        only(&(BUS.to_owned() + &of_body)).ends_with(
            "found `coupling` in hinge, expected a key of this table; it is a key of body"
        )
    );
    // Bodies and the main body have rotors.
    let rotor = "[[body.rotor]]\naxis = \"z\"\ninertia = 0.1\nspeed_rad = 1.0\nmass = 2.0\n";
    let of_rotor = only(&(BUS.to_owned() + &body("boom", "", "") + rotor));
    assert!(of_rotor.contains("it is a key of ") && of_rotor.contains("body"), "{of_rotor}");
    assert!(of_rotor.ends_with(" or body") || of_rotor.contains("body or "), "{of_rotor}");
    let of_hinge = body("boom", "latch_deg = 0.0", "");
    assert!(only(&(BUS.to_owned() + &of_hinge)).ends_with("; it is a key of hinge"));
}

#[test]
fn a_table_that_is_missing_is_told_as_one() {
    let text = BUS.replace("[run]", "[output]").replace("end = ", "every = ");
    assert!(
        only(&text).ends_with(
            "run: found none in scene, expected a table run: when the run starts and ends"
        )
    );
}

#[test]
fn names_that_nobody_has_are_told_with_the_nearest_one() {
    let text = BUS.to_owned()
        + &body("inner boom", "", "")
        + &body("outer boom", "on = \"iner boom\"", "");
    assert!(only(&text).ends_with("did you mean `inner boom`?"));
    let release = "release = { when = \"outer bom\", passes_deg = 10.0 }";
    let text = BUS.to_owned() + &body("inner boom", "", release) + &body("outer boom", "", "");
    assert!(only(&text).ends_with("did you mean `outer boom`?"));
}

/// Elsewhere a copy is called by its number, within its appendage by the name that all have.
#[test]
fn copies_are_suggested_by_the_names_that_lead_to_them() {
    let panels = body("panel", "repeat = { count = 3, about = [1.0, 0.0, 0.0] }", "")
        + &body("flap", "on = \"panel\"", "release = { after = \"panl\" }");
    let waits = |name: &str| body("boom", "", &format!("release = {{ after = \"{name}\" }}"));
    let told = |text: String| wrong(&(BUS.to_owned() + &text)).join("\n");
    let within = told(panels.clone());
    assert!(within.ends_with("did you mean `panel`?"), "{within}");
    let panels = panels.replace("panl", "panel");
    for (name, meant) in [("panel2", "panel 2"), ("Panel 3", "panel 3"), ("flap1", "flap 1")] {
        let elsewhere = told(panels.clone() + &waits(name));
        assert!(elsewhere.ends_with(&format!("did you mean `{meant}`?")), "{elsewhere}");
    }
    let common = told(panels.clone() + &waits("panel"));
    assert!(common.ends_with("expected the name of one copy, as `panel 1`"), "{common}");
    let coupled = "coupling = [{ to = \"panel4\", stiffness = 1.0 }]";
    let coupled = told(panels + &body("boom", coupled, ""));
    assert!(coupled.contains("did you mean `panel "), "{coupled}");
}

#[test]
fn a_name_fits_into_a_line() {
    for name in ["", "  ", "a\\nb", "a\\u001b[31mb", &"a".repeat(201)] {
        let told = only(&(BUS.to_owned() + &body(name, "", "")));
        assert!(told.ends_with("expected 1 to 200 bytes of text in one line"), "{told}");
    }
}

#[test]
fn impossible_trees_are_refused() {
    let cases = [
        (body("a", "on = \"b\"", "") + &body("b", "on = \"a\"", ""), "in a circle"),
        (body("a", "", "") + &body("a", "", ""), "name `a` of two bodies"),
        (
            body("a", "", "") + &body("b", "on = \"a\"\nrepeat = { count = 2, about = \"z\" }", ""),
            "repetition of a body on `a`",
        ),
        (body("a", "repeat = { count = 2, about = \"y\" }", ""), "through hinge and outer end"),
        (body("a", "repeat = { count = 99999999, about = \"x\" }", ""), "a whole number from 1"),
        (
            body("a", "repeat = { count = 2, about = \"x\" }", "")
                + &body("b", "", "release = { when = \"a\", passes_deg = 1 }"),
            "one copy, as `a 1`",
        ),
        (
            body("a", "repeat = { count = 2, about = \"x\" }", "") + &body("a 2", "", ""),
            "name `a 2` of two bodies",
        ),
    ];
    for (bodies, part) in cases {
        let errors = wrong(&(BUS.to_owned() + &bodies)).join("\n");
        assert!(errors.contains(part), "{part}: {errors}");
    }
}

#[test]
fn parameters_that_have_no_value_are_refused() {
    let cases = [
        ("a = \"$b\"\nb = \"$a\"", "in a circle"),
        ("a = \"1 / 0\"", "found inf, expected a finite number"),
        ("a = \"$c\"", "`$c`, which is no parameter"),
        ("a = true", "found true or false, expected a number"),
        ("\"two words\" = 1", "a name of letters"),
    ];
    for (parameters, part) in cases {
        let errors = wrong(&format!("[parameters]\n{parameters}\n{BUS}")).join("\n");
        assert!(errors.contains(part), "{part}: {errors}");
    }
}

#[test]
fn parameters_that_are_no_table_are_refused() {
    let told = only(&format!("parameters = 3\n{BUS}"));
    assert!(
        told.starts_with("a.toml:1:14: parameters: found a number, expected a table"),
        "{told}"
    );
}

#[test]
fn bodies_that_cannot_be_are_told_at_their_place() {
    let flat = BUS.replace("[40.0, 30.0, 20.0]", "[40.0, 10.0, 20.0]");
    let told = only(&flat);
    assert!(told.starts_with("a.toml:7:11: inertia: found principal moments"), "{told}");
    let none = BUS.replace("100.0", "0");
    assert!(only(&none).starts_with("a.toml:6:8: mass: found mass 0,"));
    let backwards = BUS.replace("end = 10.0", "start = 20.0\nend = 10.0");
    assert!(only(&backwards).starts_with("a.toml:4:7: end: found end time 10"));
}

#[test]
fn what_is_not_toml_is_told_at_its_place() {
    let told = wrong("[run\nend = 10").join("\n");
    assert!(told.starts_with("a.toml:1:5: scene: found "), "{told}");
}

#[test]
fn a_scene_that_is_no_file_includes_nothing() {
    let told = only(&format!("include = [\"other.toml\"]\n{BUS}"));
    assert!(told.starts_with("a.toml:1:12: include: found an include"), "{told}");
}
