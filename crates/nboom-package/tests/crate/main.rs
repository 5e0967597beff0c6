//! What `generate` writes: a crate that passes its own tests, the same bytes each time, and
//! nothing over what somebody else has written.

mod code;
mod derivatives;
mod freshness;
mod library;
mod readme;
mod rig;
mod right_side;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use nboom_codegen::{CodegenError, OPERATION_LIMIT};
use nboom_formulation::{Formulation, Layout};
use nboom_io::read_scene;
use nboom_model::{
    Appendage, External, Hinge, KickOffSpring, MassProperties, Mount, Rotor, RotorSpeed, Scene,
    SceneDescription, Segment, Spring, Topology,
};
use nboom_package::{
    Choices, Numbers, PackageError, Standing, TOLERANCE, Written, generate, is_current,
};
use nboom_scalar::{Sym3, Vec3};
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
    description.externals = vec![External::thrust(force, point, [1.0, 2.0])];
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
fn what_has_no_code_is_refused() {
    let place = place();
    let directory = place.path().join("crate");
    let refused = |scene: &Scene, choices: Choices| {
        generate(scene, &choices, &directory).expect_err("no code").to_string()
    };
    let choices = Choices::default();
    let mut description = (*satellite("tree", &[2])).clone();
    let (axis, speed) = (Vec3::unit_x(), RotorSpeed::Constant(1.0));
    description.rotors = vec![Rotor { body: Some(1), axis, inertia: 1e-3, speed }];
    let with_rotor = Scene::new(description).expect("the bodies are physical");
    let hinge = refused(&with_rotor, choices);
    assert!(hinge.contains("what hinge 1,2 carries, which has a rotor"), "{hinge}");

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
