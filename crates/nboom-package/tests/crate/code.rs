use super::*;

#[test]
fn a_crate_passes_its_tests_and_fails_them_when_its_code_is_wrong() {
    let choices = Choices {
        formulation: Formulation::Relative,
        equations: true,
        inverse_dynamics: true,
        lock_states: true,
        ..Choices::default()
    };
    // The topology is S2_S1, so that hinges stand in another order than in the scene.
    let place = written(&satellite("two booms", &[1, 2]), &choices);
    let said = cargo_test(place.path()).expect("the code is right");
    assert!(said.contains("SatelliteM, portable code: largest deviation"), "{said}");

    let routines = place.path().join("src/routines.rs");
    let text = fs::read_to_string(&routines).expect("readable");
    let first = text.find("fn evaluate_on").expect("a straight line");
    let last = text.rfind("fn evaluate_on").expect("a straight line");
    let inverse = text.find("pub struct SatelliteS2S1Inverse").expect("it was asked for");
    let inverse = inverse + text[inverse..].find("fn evaluate_on").expect("a straight line");
    let evaluations =
        [(first, "satelliteS2S1"), (inverse, "satelliteS2S1Inverse"), (last, "satelliteM")];
    for (evaluation, test) in evaluations {
        // The first sum becomes a difference.
        let (head, tail) = text.split_at(evaluation);
        let wrong = head.to_owned() + &tail.replacen(" + ", " - ", 1);
        assert_ne!(wrong, text);
        fs::write(&routines, wrong).expect("writable");
        let said = cargo_test(place.path()).expect_err("the code is wrong");
        let failed = format!("{}_is_as_certified ... FAILED", test.to_lowercase());
        assert!(said.contains(&failed), "{said}");
    }
}

/// All of its accelerations are zero, and rounding is what compiled code has of them.
#[test]
fn a_crate_of_a_sphere_passes_its_tests() {
    let formulation = Formulation::Symmetric;
    let choices =
        Choices { formulation, equations: true, inverse_dynamics: true, ..Choices::default() };
    let body = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(30.0, 30.0, 30.0));
    let scene = Scene::new(SceneDescription::at_rest("sphere", body, 10.0)).expect("a sphere");
    let place = written(&scene, &choices);
    let said = cargo_test(place.path()).unwrap_or_else(|said| panic!("{said}"));
    assert!(said.contains("SatelliteM, portable code: largest deviation"), "{said}");
}

/// Names are filled in among keys of a template that look like this.
#[test]
fn a_body_may_be_called_like_a_key_of_a_template() {
    for key in ["TREE_LIST", "MORE_FUNCTIONS", "HINGE_COUNT"] {
        let name = format!("/*{key}*/");
        let place = written(&one_boom().with_names(vec![name.clone()]), &Choices::default());
        let text = fs::read_to_string(place.path().join("src/lib.rs")).expect("readable");
        assert!(text.contains(&format!("name: \"{name}\"")), "{text}");
    }
}

#[test]
fn a_crate_with_stresses_passes_its_tests_and_fails_them_when_they_are_wrong() {
    let deck = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/n-boom-1970.nml");
    let file = nboom_io::read_scene(&deck).expect("the sample deck is right");
    let choices = Choices { stresses: file.structure.as_ref(), ..Choices::default() };
    // What acts on hinged bodies is a part of the motion that loads follow from.
    let mut description = (*file.scene).clone();
    let push = External::thrust(Vec3::unit_x(), Vec3::unit_y(), [0.0, 1.0]);
    description.externals =
        vec![External { body: Some(0), ..push.clone() }, External { body: Some(1), ..push }];
    let scene = Scene::new(description).expect("the bodies are physical");
    let place = written(&scene, &choices);
    let test = fs::read_to_string(place.path().join("tests/stresses.rs")).expect("readable");
    assert!(test.contains("const HINGES: usize = 4;"), "{test}");
    cargo_test(place.path()).expect("the code is right");
    let readme = fs::read_to_string(place.path().join("README.md")).expect("readable");
    assert!(readme.contains("| `StressesS2P` | 4 hinges | loads and stresses |"), "{readme}");
    // Lints of today's clippy, which is there wherever the gate runs.
    cargo(place.path(), &["clippy", "--all-targets", "--quiet"]).expect("the code is clean");

    let routines = place.path().join("src/routines.rs");
    let text = fs::read_to_string(&routines).expect("readable");
    let (head, tail) = text.split_at(text.rfind("fn evaluate_on").expect("a straight line"));
    fs::write(&routines, head.to_owned() + &tail.replacen(" + ", " - ", 1)).expect("writable");
    let said = cargo_test(place.path()).expect_err("the code is wrong");
    assert!(said.contains("loads_and_stresses_are_those_of_the_equations ... FAILED"), "{said}");
}

/// Nothing acts on the scene from outside.
#[test]
fn a_wrench_is_taken_and_compared_where_it_is_asked_for() {
    let mut description = (*one_boom()).clone();
    description.externals.clear();
    let scene = Scene::new(description).expect("the bodies are physical");
    let wrench_of = |external_wrench: bool| {
        let choices = Choices { right_side: true, external_wrench, ..Choices::default() };
        let place = written(&scene, &choices);
        let table =
            fs::read_to_string(place.path().join("tests/SatelliteS1.csv")).expect("a table");
        let mut rows = table.lines();
        let names: Vec<&str> = rows.next().expect("names").split(',').collect();
        let first: Vec<&str> = rows.next().expect("a state").split(',').collect();
        let at = |name: &str| names.iter().position(|other| *other == name).expect("a column");
        let force: f64 = first[at("state_6")].parse().expect("a number");
        (place, force)
    };
    let (without, force) = wrench_of(false);
    assert_eq!(force, 0.0);
    let phrases =
        |place: &TempDir| certificate(place.path())["routines"][1]["assumptions"].to_string();
    assert!(phrases(&without).contains("no external wrench"));
    let (with, force) = wrench_of(true);
    assert_eq!(force, 100.0);
    assert!(!phrases(&with).contains("no external wrench"));
    cargo_test(with.path()).unwrap_or_else(|said| panic!("{said}"));
}

#[test]
fn two_crates_are_in_one_program() {
    let place = place();
    let write = |path: &str, text: &str| {
        let path = place.path().join(path);
        fs::create_dir_all(path.parent().expect("inside")).expect("writable");
        fs::write(path, text).expect("writable");
    };
    for (name, chains) in [("one", &[1][..]), ("two", &[2])] {
        let directory = place.path().join("crates").join(name);
        generate(&satellite(name, chains), &Choices::default(), &directory).expect("covered");
    }
    write("Cargo.toml", "[workspace]\nmembers = [\"program\", \"crates/*\"]\nresolver = \"3\"\n");
    write(
        "program/Cargo.toml",
        "[package]\nname = \"program\"\nedition = \"2024\"\n\n[dependencies]\n\
         satellite-one = { path = \"../crates/one\" }\n\
         satellite-two = { path = \"../crates/two\" }\n",
    );
    write(
        "program/src/main.rs",
        "fn main() {\n    \
         println!(\"{} and {}\", satellite_one::kernels()[0].topology, \
         satellite_two::kernels()[0].topology);\n}\n",
    );
    let said = cargo(place.path(), &["run", "--quiet"]).expect("both are in the program");
    assert_eq!(said, "S1 and S2\n");
}

#[test]
fn a_certificate_says_what_was_compared() {
    let place = written(&one_boom(), &Choices::default());
    let found = certificate(place.path());
    assert_eq!(found["scene"], "One boom");
    let routine = &found["routines"][0];
    let formulation = &routine["formulation"];
    assert_eq!(formulation["name"], "articulated");
    assert_eq!((&formulation["states"], &formulation["seed"]), (&100.into(), &1970.into()));
    for key in ["deviation_from_recursion", "deviation_from_double_double"] {
        let deviation = formulation[key].as_f64().expect("a number");
        assert!(deviation > 0.0 && deviation < TOLERANCE, "{key}: {deviation:e}");
    }
    assert!(formulation["magnification"].as_f64().is_some_and(|magnification| magnification > 1.0));
    let allowed = routine["compiled_code"]["tolerance"].as_f64().expect("a number");
    assert!(allowed < TOLERANCE, "{allowed:e}");
    assert_eq!((&routine["topology"], &routine["level"]), (&"S1".into(), &"fast".into()));
    // FNV-1a of 64 bits of the two letters.
    assert_eq!(routine["topology_hash"], "0945ff07b5d5a329");
    assert_eq!(routine["evaluation"]["angles"], 1);
    assert_eq!(routine["assumptions"][0], "O at the main body's mass centre");
    let table = fs::read_to_string(place.path().join("tests/SatelliteS1.csv")).expect("a table");
    let topology: Topology = "S1".parse().expect("a topology");
    let columns =
        Layout::parameters(&topology) + Layout::coordinates(&topology) + Layout::outputs(&topology);
    assert_eq!(table.lines().count(), 21);
    // The last one is the least scale of deviations.
    assert!(table.lines().all(|line| line.split(',').count() == columns + 1));
}

#[test]
fn held_hinges_are_held_at_other_angles_in_each_state() {
    let choices = Choices { lock_states: true, ..Choices::default() };
    let place = written(&satellite("two", &[2]), &choices);
    let table = fs::read_to_string(place.path().join("tests/SatelliteS1.csv")).expect("a table");
    let of_satellite = Layout::parameters(&"S1".parse::<Topology>().expect("a topology"));
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|row| row.split(',').collect()).collect();
    assert_eq!(rows.len(), 4);
    assert_ne!(rows[0][..of_satellite], rows[1][..of_satellite]);
}

/// A matrix costs accelerations nothing.
#[test]
fn equations_are_symmetric_beside_articulated_accelerations() {
    let place = written(&one_boom(), &Choices { equations: true, ..Choices::default() });
    let found = certificate(place.path());
    let of =
        |i: usize| (&found["routines"][i]["output"], &found["routines"][i]["formulation"]["name"]);
    assert_eq!(of(0), (&"accelerations".into(), &"articulated".into()));
    assert_eq!(of(1), (&"equations".into(), &"symmetric".into()));
}

/// Rows of the matrix go by the topology, S2_S1, in which the scene's second boom comes first.
#[test]
fn hinges_say_which_row_of_the_equations_is_theirs() {
    let (scene, choices) = (satellite("two booms", &[1, 2]), Choices::default());
    let place = written(&scene, &Choices { equations: true, ..choices });
    let [code, readme] = ["src/lib.rs", "README.md"]
        .map(|file| fs::read_to_string(place.path().join(file)).expect("readable"));
    for (hinge, row) in [("1, segment: 1", 8), ("2, segment: 1", 6), ("2, segment: 2", 7)] {
        let mut lines = code.lines().filter(|line| line.contains(&format!("appendage: {hinge}")));
        let line = lines.next().expect("a line for each hinge");
        assert!(line.ends_with(&format!(", equation: {row} }},")), "{line}");
    }
    assert!(readme.contains("2,1; 2,2; 1,1. `Hinge::equation`"), "{readme}");
    let place = written(&scene, &choices);
    let code = fs::read_to_string(place.path().join("src/lib.rs")).expect("readable");
    assert!(!code.contains("equation:"));
}

#[test]
fn routines_are_those_asked_for() {
    let names = |choices: Choices| -> Vec<String> {
        let place = written(&satellite("two", &[2]), &choices);
        let routines = certificate(place.path())["routines"].clone();
        let routines = routines.as_array().expect("a list");
        let text = |value: &serde_json::Value| value.as_str().expect("a text").to_owned();
        routines.iter().map(|routine| text(&routine["name"])).collect()
    };
    let usual = Choices::default();
    assert_eq!(names(usual), ["SatelliteS2"]);
    assert_eq!(names(Choices { numbers: Numbers::Baked, ..usual }), ["BakedS2"]);
    let all = Choices {
        formulation: Formulation::Symmetric,
        equations: true,
        inverse_dynamics: true,
        lock_states: true,
        ..usual
    };
    let all_free = ["SatelliteS2", "SatelliteS2Equations", "SatelliteS2Inverse"];
    assert_eq!(names(all), [&all_free[..], &["SatelliteS1", "SatelliteM"]].concat());
}

#[test]
fn every_formulation_is_certified() {
    for formulation in Formulation::ALL {
        let equations = formulation.has_equations();
        let choices = Choices { formulation, equations, ..Choices::default() };
        let place = written(&satellite("mixed", &[1, 2, 2]), &choices);
        let found = certificate(place.path());
        assert_eq!(found["routines"][0]["formulation"]["name"], formulation.name());
        let residual = found["routines"][1]["formulation"]["residual"].as_f64();
        assert_eq!(residual.is_some(), equations);
        assert!(residual.is_none_or(|residual| residual < 1e-13), "{formulation}: {residual:?}");
    }
}
