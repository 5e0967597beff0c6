use nboom_io::{ReadOptions, parse_scene};
use nboom_model::{HingeState, Release, UnitSystem};
use nboom_scalar::{Mat3, Vec3};

use super::idle::warnings;
use super::{BUS, body, right, wrong};

#[test]
fn what_is_left_out_has_the_default_that_people_expect() {
    let file = right(&(BUS.to_owned() + &body("boom", "", "")));
    let (scene, hinge) = (&file.scene, file.scene.bodies[0].hinge);
    assert_eq!(scene.name, "a");
    assert_eq!((scene.initial.time, scene.end_time), (0.0, 10.0));
    assert_eq!(scene.main_body.center_of_mass, Vec3::zero());
    assert_eq!((hinge.start.state, hinge.start.angle), (HingeState::Free, 0.0));
    assert_eq!((hinge.release, hinge.lock_angle), (Release::Never, None));
    assert_eq!(scene.bodies[0].mount.rot_inboard_from_hinge, Mat3::identity());
    assert_eq!(scene.bodies[0].tip, Vec3::unit_y() * 2.0);
    assert_eq!((file.settings.units, file.structure), (None, None));
}

#[test]
fn a_hinge_with_a_release_is_held() {
    let release = "release = { at = 1.0 }";
    let hinge = right(&(BUS.to_owned() + &body("boom", "", release))).scene.bodies[0].hinge;
    assert_eq!(hinge.start.state, HingeState::Unreleased);
    assert_eq!(hinge.release, Release::Time(1.0));
}

#[test]
fn a_release_waits_for_a_time_an_angle_or_a_latch() {
    let released = |release: &str| {
        let text = BUS.to_owned()
            + &body("one", "", "latch_deg = 90")
            + &body("two", "", &format!("release = {release}"));
        right(&text).scene.bodies[1].hinge.release
    };
    assert_eq!(released("{ at = 0.5 }"), Release::Time(0.5));
    let angle = 45.0_f64.to_radians();
    let passes = released("{ when = \"one\", passes_deg = 45.0 }");
    assert_eq!(passes, Release::Angle { hinge: 0, angle });
    let after = released("{ after = \"one\", by = 2.0 }");
    assert_eq!(after, Release::AfterLock { hinge: 0, delay: 2.0 });
    assert_eq!(released("{ after = \"one\" }"), Release::AfterLock { hinge: 0, delay: 0.0 });
}

#[test]
fn springs_and_dampers_have_the_sign_that_people_expect() {
    let laws = "spring = { stiffness = 2.0, rest_deg = 30.0, quadratic = 0.5 }\n\
                damper = { damping = 0.1, rate_squared = 0.2, angle = 0.3, angle_squared = 0.4, rest_rad = 1.0 }";
    let hinge = right(&(BUS.to_owned() + &body("boom", "", laws))).scene.bodies[0].hinge;
    let (spring, dashpot) = (hinge.spring, hinge.dashpot);
    let (angle, rate) = (0.7, -0.3);
    let stretch = angle + spring.preload_angle;
    let torque = spring.quadratic * stretch * stretch + spring.linear * stretch;
    let from_rest = angle - 30.0_f64.to_radians();
    assert_eq!(torque, 0.5 * from_rest * from_rest - 2.0 * from_rest);
    let stretch: f64 = angle + dashpot.preload_angle;
    let torque = dashpot.rate_quadratic * rate * rate
        + dashpot.rate_linear * rate
        + dashpot.angle_quadratic * stretch * stretch
        + dashpot.angle_linear * stretch;
    let from_rest: f64 = angle - 1.0;
    let expected = 0.2 * rate * rate - 0.1 * rate + 0.4 * from_rest * from_rest + 0.3 * from_rest;
    // Sums in another order.
    assert!((torque - expected).abs() < 1e-15);
}

#[test]
fn a_direction_is_a_name_or_numbers_of_any_length() {
    let axis = |text: &str| {
        let body = body("boom", "", "").replace("axis = \"x\"", &format!("axis = {text}"));
        right(&(BUS.to_owned() + &body)).scene.bodies[0].axis
    };
    assert_eq!(axis("\"-z\""), Vec3::unit_z() * -1.0);
    assert_eq!(axis("[0, 3e200, -4e200]"), Vec3::new(0.0, 0.6, -0.8));
    assert_eq!(axis("[0.6, 0.0, 0.8]"), Vec3::new(0.6, 0.0, 0.8));
}

#[test]
fn rotations_are_said_in_four_ways() {
    let axes = |text: &str| {
        let file = right(&(BUS.to_owned() + &body("boom", "", &format!("axes = {{ {text} }}"))));
        file.scene.bodies[0].mount.rot_inboard_from_hinge
    };
    let quarter = Mat3::from_columns(Vec3::unit_y(), Vec3::unit_x() * -1.0, Vec3::unit_z());
    assert_eq!(axes("turn = { about = \"z\", by_deg = 90 }"), quarter);
    assert_eq!(axes("columns = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]"), quarter);
    assert_eq!(axes("euler_xyx_deg = [90, 90, -90]"), quarter);
    let near = |other: Mat3<f64>| (other - quarter).rows.iter().all(|row| row.norm() < 1e-15);
    assert!(near(axes("quaternion = [0.7071067811865476, 0, 0, 0.7071067811865476]")));
    assert!(near(axes("turn = { about = [0, 0, 2], by_rad = \"3.141592653589793 / 2\" }")));
}

#[test]
fn parameters_stand_for_numbers_and_the_caller_sets_them() {
    let text = "[parameters]\nk = 2.0\nk_total = \"2 * $k\"\n".to_owned()
        + BUS
        + &body("boom", "", "spring = { stiffness = \"$k_total / 4\" }");
    let stiffness = |set: &[(&str, f64)]| {
        let set = set.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
        let options = ReadOptions { set, ..ReadOptions::default() };
        let file = parse_scene("a.toml", &text, "a", None, &options).expect("a right scene");
        -file.scene.bodies[0].hinge.spring.linear
    };
    assert_eq!(stiffness(&[]), 1.0);
    assert_eq!(stiffness(&[("k", 4.0)]), 2.0);
    assert_eq!(stiffness(&[("k_total", 12.0)]), 3.0);
}

#[test]
fn bodies_come_in_any_order_and_branch_anywhere() {
    let text = BUS.to_owned()
        + &body("leaf", "on = \"middle\"", "")
        + &body("root", "", "")
        + &body("other leaf", "on = \"middle\"", "")
        + &body("middle", "on = \"root\"", "");
    let scene = right(&text).scene;
    let names: Vec<_> = (0..4).map(|i| scene.name_of(i).expect("a name")).collect();
    assert_eq!(names, ["root", "middle", "leaf", "other leaf"]);
    let inboard: Vec<_> = scene.bodies.iter().map(|body| body.inboard).collect();
    assert_eq!(inboard, [None, Some(0), Some(1), Some(1)]);
}

#[test]
fn units_are_labels() {
    let units = |text: &str| right(&(text.to_owned() + BUS)).settings.units;
    assert_eq!(units("units = \"si\"\n"), Some(UnitSystem::Si));
    let [length, time, force] = ["mm", "ms", "kN"].map(str::to_owned);
    let custom = units("units = { length = \"mm\", time = \"ms\", force = \"kN\" }\n");
    assert_eq!(custom, Some(UnitSystem::Custom { length, time, force }));
}

#[test]
fn a_label_that_is_missing_is_told_once() {
    let found = wrong(&format!("units = {{ length = \"m\", time = \"s\" }}\n{BUS}"));
    assert!(found.len() == 1 && found[0].contains("force: found none in units"), "{found:?}");
}

/// Counted from the first by the right hand.
#[test]
fn copies_follow_each_other_by_the_right_hand() {
    let text = BUS.to_owned() + &body("boom", "repeat = { count = 3, about = \"x\" }", "");
    let scene = right(&text).scene;
    for (i, body) in scene.bodies.iter().enumerate() {
        let angle = f64::to_radians(120.0 * i as f64);
        let place = Vec3::new(0.0, angle.cos(), angle.sin()) * 2.0;
        assert!((body.mount.point - place).norm() < 1e-15, "{i}: {:?}", body.mount.point);
        let outwards = body.mount.rot_inboard_from_hinge * Vec3::unit_y();
        assert!((outwards * 2.0 - place).norm() < 1e-15, "{i}: {outwards:?}");
    }
}

/// The tip is for pictures only.
#[test]
fn wheels_at_one_place_are_repeated_about_any_axis_but_their_own() {
    let wheels = |about: &str| {
        format!(
            "{BUS}\n[[body]]\nname = \"wheel\"\nmass = 0.0\nmass_centre = [0.0, 0.0, 0.0]\n\
             inertia = [0.05, 0.0, 0.0]\nrepeat = {{ count = 3, about = {about} }}\n\
             hinge = {{ at = [0.0, 0.0, 0.0], axis = \"x\" }}\n"
        )
    };
    assert_eq!(right(&wheels("[1.0, 1.0, 1.0]")).scene.bodies.len(), 3);
    let found = wrong(&wheels("\"x\""));
    assert!(found.len() == 1 && found[0].contains("bodies in places of their own"), "{found:?}");
}

#[test]
fn the_names_of_unit_sets_are_those_of_the_model() {
    for units in UnitSystem::NAMED {
        let file = right(&format!("units = \"{}\"\n{BUS}", units.name()));
        assert_eq!(file.settings.units, Some(units));
    }
}

/// What hangs on a body of that name would hang on another one.
#[test]
fn the_name_of_a_body_comes_before_that_of_the_main_body() {
    for name in ["main_body", "main body"] {
        let on = format!("on = \"{name}\"");
        let alone = right(&format!("{BUS}{}{}", body("a", &on, ""), body("b", "on = \"a\"", "")));
        assert_eq!(alone.scene.bodies[0].inboard, None);
        let file = right(&format!("{BUS}{}{}", body(name, "", ""), body("b", &on, "")));
        assert_eq!(file.scene.bodies[1].inboard, Some(0));
        let again = right(&nboom_io::write_scene(&file));
        assert_eq!(*again.scene, *file.scene);
        let told = wrong(&format!("{BUS}{}", body(name, &on, "")));
        assert!(told[0].contains("on: found inboard bodies in a circle"), "{told:?}");
    }
}

#[test]
fn pulse_constants_of_some_matter_only_to_stations() {
    let with = "pulse_constant = 0.1\nmaterial = \"steel\"";
    let bodies = |station: &str| {
        BUS.to_owned()
            + "\n[materials.steel]\nyoungs_modulus = 1.0\n"
            + &body("one", with, "latch_deg = 90")
            + station
            + &body("two", "", "latch_deg = 90")
    };
    let file = right(&bodies(""));
    // A constant that nobody gave would make up pulses.
    assert_eq!(file.structure, None);
    let told: Vec<String> = file.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0]
            .contains("pulse_constant: found a body whose hinge has a latch or stops, without it"),
        "{told:?}"
    );
    let station = "\n[[body.station]]\nat = 0.0\nmass = 3.0\nmass_centre = [0.0, 1.0, 0.0]\n\
                   inertia = [1.0, 0.1, 1.0]\nsection = { tube = { radius = 0.1, thickness = 0.001 } }\n";
    let told = wrong(&bodies(station));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains("since bodies of the scene have stations"), "{told:?}");
}

#[test]
fn a_body_with_stations_is_told_what_it_lacks() {
    let station = "[[body.station]]\nat = 0.0\nmass = 3.0\nmass_centre = [0.0, 1.0, 0.0]\n\
                   inertia = [1.0, 0.1, 1.0]\nsection = { tube = { radius = 0.1, thickness = 0.001 } }\n";
    let told = wrong(&(BUS.to_owned() + &body("boom", "", "") + station));
    let expected = "found a body without it, expected `material`, the name of its material, since the body has stations";
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].contains(expected), "{told:?}");
    let steel = "\n[materials.steel]\nyoungs_modulus = 1.0\n";
    let of = |hinge: &str| {
        let more = "material = \"steel\"\nrepeat = { count = 3, about = \"z\" }";
        BUS.to_owned() + steel + &body("boom", more, hinge) + station
    };
    assert!(right(&of("")).structure.is_some(), "what never latches needs no pulse of a latch");
    // Of copies it is said once.
    let told = wrong(&of("latch_deg = 90"));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0]
            .contains("pulse_constant: found a body whose hinge has a latch or stops, without it"),
        "{told:?}"
    );
}

#[test]
fn slices_add_up_to_their_body_unless_it_says_that_they_differ() {
    let scene = |more: &str| {
        BUS.to_owned()
            + "\n[materials.steel]\nyoungs_modulus = 1.0\n"
            + &body("boom", &format!("material = \"steel\"\n{more}"), "")
            + "[[body.station]]\nat = 0.0\nmass = 0.3\nmass_centre = [0.0, 1.0, 0.0]\n\
               inertia = [1.0, 0.1, 1.0]\nsection = { tube = { radius = 0.1, thickness = 0.001 } }\n"
    };
    // The slice has a tenth of the mass: stresses would be a tenth, too.
    let told = wrong(&scene(""));
    assert_eq!(told.len(), 1, "{told:?}");
    for part in
        ["slices of mass 0.3 in all", "3 of the segment (2.7 away)", "or slices = \"differ\""]
    {
        assert!(told[0].contains(part), "{told:?}");
    }
    let file = right(&scene("slices = \"differ\""));
    assert!(file.structure.is_some());
    assert!(
        file.warnings[0].to_string().contains("slices of mass 0.3 in all"),
        "{:?}",
        file.warnings
    );
    let again = right(&nboom_io::write_scene(&file));
    assert_eq!(again.structure, file.structure);
    assert!(wrong(&scene("slices = \"alike\""))[0].contains("one of differ"));
}

#[test]
fn a_station_beyond_its_slice_is_worth_a_warning() {
    let section = "section = { tube = { radius = 0.1, thickness = 0.001 } }\n";
    let scene = |at: &str| {
        let boom = body("boom", "material = \"steel\"\nrepeat = { count = 3, about = \"x\" }", "");
        let outer = format!(
            "[[body.station]]\nat = {at}\nmass = 3.0\nmass_centre = [0.0, 1.0, 0.0]\ninertia = [1.0, 0.1, 1.0]\n{section}"
        );
        let at_hinge = format!("[[body.station]]\nat = 0.0\nmass = 0.0\n{section}");
        format!("{BUS}\n[materials.steel]\nyoungs_modulus = 1.0\n{boom}{outer}{at_hinge}")
    };
    assert_eq!(warnings(&scene("1.0"), &[]), [""; 0]);
    let with_rotor =
        scene("1.0") + "[[body.rotor]]\naxis = \"y\"\ninertia = 0.1\nspeed_rad = 3.0\n";
    let told = warnings(&with_rotor, &[]);
    let words = ": station: found a rotor in a body with stations away from its hinge, 1 of them";
    assert!(told.len() == 1 && told[0].contains(words), "{told:?}");
    let told = warnings(&scene("5.0"), &[]);
    let words = ": at: found distance 5 of a station whose slice has its mass centre at 1 along the long axis";
    assert!(told.len() == 1 && told[0].contains(words), "{told:?}");
}

/// A wrong number of a table that stands for several bodies is one mistake, at its own key.
#[test]
fn what_is_wrong_of_all_copies_is_told_once() {
    let scene = |of_body: &str, of_slice: &str, more: &str| {
        let boom = body("boom", &format!("repeat = {{ count = 3, about = \"x\" }}\n{more}"), "");
        let boom = boom.replace("inertia = [1.0, 0.1, 1.0]", &format!("inertia = {of_body}"));
        BUS.to_owned()
            + "\n[materials.steel]\nyoungs_modulus = 1.0\n"
            + &boom.replace("\n\n[body.hinge]", "\nmaterial = \"steel\"\n\n[body.hinge]")
            + &format!(
                "[[body.station]]\nat = 0.0\nmass = 3.0\nmass_centre = [0.0, 1.0, 0.0]\ninertia = {of_slice}\n\
                 section = {{ tube = {{ radius = 0.1, thickness = 0.001 }} }}\n"
            )
    };
    let (right, none) = ("[1.0, 0.1, 1.0]", "[1.0, 0.1, 3.0]");
    for text in [scene(right, none, ""), scene(none, right, "")] {
        let line = 1 + text.lines().position(|line| line.contains(none)).expect("it is there");
        let told = wrong(&text);
        assert_eq!(told.len(), 1, "{told:#?}");
        assert!(
            told[0].contains(&format!(":{line}:")) && told[0].contains(": inertia: "),
            "{told:?}"
        );
    }
    let wrong_body = "repeat = { count = 3, about = \"x\" }\nrotor = [{ axis = \"y\", inertia = -0.5, speed_rad = 4 }]";
    let told =
        wrong(&(BUS.to_owned() + &body("boom", wrong_body, "torque_deg = [[1, 2], [0, 3]]")));
    assert_eq!(told.len(), 2, "{told:#?}");
    let other = "[1.0, 0.1, 0.9]";
    let told = wrong(&scene(right, other, ""));
    assert!(told.len() == 1 && told[0].contains("slices with moments"), "{told:#?}");
    let told = warnings(&scene(right, other, "slices = \"differ\"\n"), &[]);
    assert!(told.len() == 1 && told[0].contains("slices with moments"), "{told:#?}");
}

#[test]
fn a_pulse_constant_is_positive_with_loads_and_without() {
    let found = wrong(&format!("{BUS}{}", body("one", "pulse_constant = -0.2", "")));
    let words = ":14:18: pulse_constant: found";
    assert!(found.len() == 1 && found[0].contains(words), "{found:?}");
}

#[test]
fn friction_is_zero_or_more_and_no_hinge_starts_stuck() {
    let with = |hinge: &str| BUS.to_owned() + &body("boom", "", hinge);
    assert_eq!(right(&with("friction = 0.25")).scene.bodies[0].hinge.friction, 0.25);
    assert_eq!(right(&with("")).scene.bodies[0].hinge.friction, 0.0);
    for (hinge, words) in [
        ("friction = -0.25", "friction -0.25, expected zero or more"),
        ("friction = inf", "friction"),
        ("state = \"stuck\"", "expected one of"),
    ] {
        let told = wrong(&with(hinge));
        assert!(told.len() == 1 && told[0].contains(words), "{hinge}: {told:?}");
    }
    let file = right(&with("friction = 0.25"));
    assert_eq!(right(&nboom_io::write_scene(&file)).scene.bodies[0].hinge.friction, 0.25);
}
