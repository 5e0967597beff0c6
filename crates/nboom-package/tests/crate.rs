//! What `generate` writes: a crate that passes its own tests, the same bytes each time, and
//! nothing over what somebody else has written.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use nboom_codegen::{CodegenError, OPERATION_LIMIT};
use nboom_formulation::{Formulation, Layout};
use nboom_io::read_scene;
use nboom_model::{
    Appendage, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment, Spring, Thrust,
    Topology,
};
use nboom_package::{
    Choices, Numbers, PackageError, Standing, TOLERANCE, Written, generate, is_current,
};
use nboom_scalar::{Mat3, Sym3, Vec3};
use tempfile::TempDir;

/// A main body under thrust, with sprung chains of these lengths.
fn satellite(name: &str, chains: &[usize]) -> Scene {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
    let boom = MassProperties::new(3.0, Vec3::unit_y() * 0.9, Sym3::diagonal(4.0, 0.1, 4.0));
    let spring = Spring { linear: -0.7, ..Spring::default() };
    let hinge = Hinge { spring, ..Hinge::free() };
    let segment = Segment { length: 2.0, mass_properties: boom, hinge };
    let mut description = SceneDescription::at_rest(name, hub, 10.0);
    description.initial.omega_body = Vec3::new(0.8, 0.1, -0.2);
    let (force, point) = (Vec3::new(5.0, -3.0, 1.0), Vec3::new(0.0, 0.2, 0.4));
    description.thrust = Some(Thrust { force, point, on: 1.0, off: 2.0 });
    for (i, &links) in chains.iter().enumerate() {
        let mount = Mount::at(Vec3::new(0.2, 0.5, 0.3 * i as f64));
        description.attach(&Appendage::Regular { mount, segments: vec![segment.clone(); links] });
    }
    Scene::new(description).expect("the bodies are physical")
}

fn one_boom() -> Scene {
    satellite("One boom", &[1])
}

fn place() -> TempDir {
    tempfile::tempdir().expect("a directory")
}

/// All files of a directory and their bytes.
fn contents(directory: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(directory).expect("readable") {
        let path = entry.expect("readable").path();
        if path.is_dir() {
            found.extend(contents(&path));
        } else {
            let bytes = fs::read(&path).expect("readable");
            found.insert(path, bytes);
        }
    }
    found
}

fn relative(directory: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let inside = |path: PathBuf| path.strip_prefix(directory).expect("inside").to_owned();
    contents(directory).into_iter().map(|(path, bytes)| (inside(path), bytes)).collect()
}

fn certificate(directory: &Path) -> serde_json::Value {
    let text = fs::read_to_string(directory.join("CERTIFICATE.json")).expect("a certificate");
    serde_json::from_str(&text).expect("JSON")
}

fn written(scene: &Scene, choices: &Choices) -> TempDir {
    let place = place();
    let outcome = generate(scene, choices, place.path()).expect("the scene is covered");
    assert!(matches!(outcome, Written::Anew { .. }), "{outcome:?}");
    place
}

/// Runs the tests of a crate, without network.
fn cargo_test(directory: &Path) -> Result<String, String> {
    cargo(directory, &["test"])
}

/// What cargo says in a directory, without network.
fn cargo(directory: &Path, words: &[&str]) -> Result<String, String> {
    let output = Command::new(env!("CARGO"))
        .args(words)
        .args(["--offline", "--color", "never", "--target-dir"])
        .arg(directory.join("target"))
        .current_dir(directory)
        .env("RUSTFLAGS", "-D warnings")
        .output()
        .expect("cargo starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let said = text(&output.stdout) + &text(&output.stderr);
    if output.status.success() { Ok(said) } else { Err(said) }
}

#[test]
fn a_crate_passes_its_tests_and_fails_them_when_its_code_is_wrong() {
    let choices = Choices {
        formulation: Formulation::Relative,
        equations: true,
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
    for (evaluation, test) in [(first, "satelliteS2S1"), (last, "satelliteM")] {
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

#[test]
fn a_crate_with_stresses_passes_its_tests_and_fails_them_when_they_are_wrong() {
    let deck = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/n-boom-1970.nml");
    let file = nboom_io::read_scene(&deck).expect("the sample deck is right");
    let choices = Choices { stresses: file.structure.as_ref(), ..Choices::default() };
    let place = written(&file.scene, &choices);
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
    assert!(formulation["condition"].as_f64().is_some_and(|condition| condition > 1.0));
    let allowed = routine["compiled_code"]["tolerance"].as_f64().expect("a number");
    assert!(allowed < TOLERANCE, "{allowed:e}");
    assert_eq!((&routine["topology"], &routine["level"]), (&"S1".into(), &"fast".into()));
    // FNV-1a of 64 bits of the two letters.
    assert_eq!(routine["topology_hash"], "0945ff07b5d5a329");
    assert_eq!(routine["evaluation"]["angles"], 1);
    assert_eq!(routine["taken_for_granted"][0], "O at the main body's mass centre");
    let table = fs::read_to_string(place.path().join("tests/SatelliteS1.csv")).expect("a table");
    let topology: Topology = "S1".parse().expect("a topology");
    let columns =
        Layout::parameters(&topology) + Layout::coordinates(&topology) + Layout::outputs(&topology);
    assert_eq!(table.lines().count(), 21);
    assert!(table.lines().all(|line| line.split(',').count() == columns));
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
        lock_states: true,
        ..usual
    };
    let expected = ["SatelliteS2", "SatelliteS2Equations", "SatelliteS1", "SatelliteM"];
    assert_eq!(names(all), expected);
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

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let scene = satellite("booms", &[3, 3, 3, 3]);
    let (one, other) = (written(&scene, &Choices::default()), written(&scene, &Choices::default()));
    assert_eq!(relative(one.path()), relative(other.path()));
}

#[test]
fn what_is_up_to_date_is_not_written_and_what_is_not_is() {
    let (scene, choices) = (one_boom(), Choices::default());
    let place = place();
    let directory = place.path().join("inner/crate");
    let missing = is_current(&scene, &choices, &directory).expect_err("nothing there");
    assert!(matches!(missing, PackageError::Outdated { standing: None, .. }), "{missing}");
    generate(&scene, &choices, &directory).expect("written");
    is_current(&scene, &choices, &directory).expect("as it was written");
    assert_eq!(generate(&scene, &choices, &directory).ok(), Some(Written::UpToDate));

    let baked = Choices { numbers: Numbers::Baked, ..choices };
    let stale = is_current(&scene, &baked, &directory).expect_err("other numbers");
    let is_stale =
        |error| matches!(error, PackageError::Outdated { standing: Some(Standing::Stale), .. });
    assert!(is_stale(stale));
    let equations = Choices { formulation: Formulation::Symmetric, equations: true, ..baked };
    generate(&scene, &equations, &directory).expect("what was written here is replaced");
    assert!(directory.join("tests/BakedS1Equations.csv").exists());
    generate(&scene, &baked, &directory).expect("what was written here is replaced");
    assert!(!directory.join("tests/BakedS1Equations.csv").exists());
    assert_eq!(relative(&directory), relative(written(&scene, &baked).path()));

    let text = fs::read_to_string(directory.join("src/routines.rs")).expect("readable");
    fs::remove_file(directory.join("src/routines.rs")).expect("removable");
    let missing = is_current(&scene, &baked, &directory).expect_err("one file less");
    assert!(missing.to_string().ends_with("src/routines.rs is missing"), "{missing}");
    generate(&scene, &baked, &directory).expect("what is missing is written");
    assert_eq!(fs::read_to_string(directory.join("src/routines.rs")).ok(), Some(text));
}

#[test]
fn what_others_have_written_is_not_overwritten() {
    let (scene, choices) = (one_boom(), Choices::default());
    for name in ["src/routines.rs", "Cargo.toml", "CERTIFICATE.json", "GENERATED"] {
        let place = written(&scene, &choices);
        let path = place.path().join(name);
        let changed = fs::read_to_string(&path).expect("readable") + "\n";
        fs::write(&path, &changed).expect("writable");
        let before = contents(place.path());
        for choices in [choices, Choices { numbers: Numbers::Baked, ..choices }] {
            let error = generate(&scene, &choices, place.path()).expect_err("edited");
            let PackageError::NotOurs { path: found, standing } = &error else { panic!("{error}") };
            assert_eq!((found, *standing), (&path, Standing::Edited));
            let error = is_current(&scene, &choices, place.path()).expect_err("edited");
            assert!(error.to_string().contains("was changed"), "{error}");
        }
        assert_eq!(contents(place.path()), before);
    }
    let place = place();
    let path = place.path().join("Cargo.toml");
    fs::write(&path, "[package]\nname = \"mine\"\n").expect("writable");
    let error = generate(&scene, &choices, place.path()).expect_err("somebody else's");
    let PackageError::NotOurs { path: found, standing } = &error else { panic!("{error}") };
    assert_eq!((found, *standing), (&path, Standing::Foreign));
    assert_eq!(contents(place.path()).len(), 1);
}

#[test]
fn what_has_no_code_is_refused() {
    let place = place();
    let directory = place.path().join("crate");
    let refused = |scene: &Scene, choices: Choices| {
        generate(scene, &choices, &directory).expect_err("no code").to_string()
    };
    let choices = Choices::default();
    let equations = refused(&one_boom(), Choices { equations: true, ..choices });
    assert!(equations.contains("topology S1, formulation articulated"), "{equations}");

    let mut description = (*satellite("tree", &[2])).clone();
    description.bodies[1].mount.rot_inboard_from_hinge = Mat3::from_euler_121(0.1, 0.2, 0.3);
    let tree = Scene::new(description).expect("the bodies are physical");
    let hinge = refused(&tree, choices);
    assert!(hinge.contains("hinge 1,2"), "{hinge}");

    let report = Choices { formulation: Formulation::Report, ..choices };
    let long = generate(&satellite("long", &[60]), &report, &directory).expect_err("too long");
    assert!(matches!(long, PackageError::Codegen(CodegenError::Budget { .. })), "{long}");
    let words = ["S60", "report", &OPERATION_LIMIT.to_string()];
    assert!(words.iter().all(|word| long.to_string().contains(word)), "{long}");
    assert!(!directory.exists());
}

#[test]
fn a_directory_that_cannot_be_made_is_an_error() {
    let place = place();
    let file = place.path().join("file");
    fs::write(&file, "").expect("writable");
    let error = generate(&one_boom(), &Choices::default(), &file).expect_err("a file is there");
    assert!(matches!(error, PackageError::Read { .. } | PackageError::Write { .. }), "{error}");
}

/// Every parameter that a routine takes for granted is named in the crate's README: the numbers
/// of a parameter's name over all phrases are those that are pinned in the code.
#[test]
fn a_crate_names_all_that_it_takes_for_granted() {
    let place = written(&satellite("mixed", &[1, 2, 2]), &Choices::default());
    let readme = fs::read_to_string(place.path().join("README.md")).expect("readable");
    let row = readme.lines().find(|line| line.starts_with("| `Satellite")).expect("a row");
    let phrases = row.trim_end_matches(" |").rsplit(" | ").next().expect("a last column");
    let named: usize = phrases.split("; ").map(parameters_of).sum();
    let code = fs::read_to_string(place.path().join("src/routines.rs")).expect("readable");
    let start = code.find("const PINNED").expect("a table");
    let table = &code[start..start + code[start..].find("];").expect("its end")];
    // A pair of place and number for each, after the pair of types.
    let pinned = table.matches('(').count() - 1;
    assert!(pinned > 30, "{table}");
    assert_eq!(named, pinned, "{phrases}");
}

/// How many parameters a phrase speaks of.
fn parameters_of(phrase: &str) -> usize {
    let links = || -> usize {
        let (count, _) = phrase.split_once(" of 5 links").expect("five links");
        count.rsplit(' ').next().and_then(|count| count.parse().ok()).expect("a count")
    };
    match phrase {
        "no external wrench on the main body" => 0,
        "O at the main body's mass centre" | "main body along its principal axes" => 3,
        _ if phrase.starts_with("inertia along the segment axes") => 3 * links(),
        _ if phrase.ends_with("links") => links(),
        _ => {
            let (equations, owners) = phrase.rsplit_once(" of ").expect("equations and owners");
            let owners = owners.split(", ").count();
            let of_group = |group: &str| group.matches(" = ").count();
            owners * equations.split(", ").map(of_group).sum::<usize>()
        }
    }
}

#[test]
fn a_crate_says_where_the_numbers_of_a_hinge_stand() {
    let place = written(&satellite("mixed", &[1, 2, 2]), &Choices::default());
    let text = fs::read_to_string(place.path().join("src/lib.rs")).expect("readable");
    let found: Vec<&str> = text.lines().filter(|line| line.starts_with("    Hinge {")).collect();
    // Two chains of two side by side, then the chain of one: 9 numbers before the hinges.
    let expected = [
        (1, 1, [21, 22, 23, 10]),
        (2, 1, [9, 11, 13, 6]),
        (2, 2, [15, 17, 19, 8]),
        (3, 1, [10, 12, 14, 7]),
        (3, 2, [16, 18, 20, 9]),
    ];
    let line = |(appendage, segment, [angle, rate, torque, acceleration]): (i32, i32, [i32; 4])| {
        format!(
            "    Hinge {{ appendage: {appendage}, segment: {segment}, angle: {angle}, rate: {rate}, \
             torque: {torque}, acceleration: {acceleration} }},"
        )
    };
    assert_eq!(found, expected.map(line));
}

#[test]
fn the_example_is_covered() {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/n-boom-1970.nml");
    let file = read_scene(&example).expect("the example is right");
    let choices = Choices { numbers: Numbers::Baked, lock_states: true, ..Choices::default() };
    let place = written(&file.scene, &choices);
    let found = certificate(place.path());
    assert_eq!(found["routines"][0]["topology"], "S2_P");
    assert!(found["routines"].as_array().is_some_and(|routines| routines.len() > 5));
}

#[test]
fn a_crate_for_another_mass_is_out_of_date() {
    let (scene, choices) = (one_boom(), Choices::default());
    let place = written(&scene, &choices);
    is_current(&scene, &choices, place.path()).expect("as it was written");
    // Masses are no part of the code, but of what its certificate was measured with.
    let mut description = (*scene).clone();
    let mass = &mut description.bodies[0].mass_properties.mass;
    *mass = mass.next_up();
    let heavier = Scene::new(description).expect("the bodies are physical");
    let stale = is_current(&heavier, &choices, place.path()).expect_err("another mass");
    assert!(
        matches!(stale, PackageError::Outdated { standing: Some(Standing::Stale), .. }),
        "{stale}"
    );
    let before = relative(place.path());
    let outcome = generate(&heavier, &choices, place.path()).expect("what was ours is replaced");
    assert!(matches!(outcome, Written::Anew { .. }), "{outcome:?}");
    assert_ne!(relative(place.path()), before);
    is_current(&heavier, &choices, place.path()).expect("as it was written");
}
