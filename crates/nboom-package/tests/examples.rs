//! Routines of the examples.

use std::fs;
use std::path::Path;

use nboom_codegen::{Level, Module};
use nboom_formulation::Formulation;
use nboom_io::read_scene;

/// Springs, slides, a hundred hinges, lines that push or do not: what is asked of the generator for each
/// example is code, or refused with a reason.
#[test]
fn no_example_is_too_much_for_the_generator() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let mut scenes = 0;
    for entry in fs::read_dir(examples).expect("readable") {
        let path = entry.expect("readable").path();
        if !path.extension().is_some_and(|ending| ending == "toml" || ending == "nml") {
            continue;
        }
        let file = read_scene(&path).expect("an example");
        let (formulation, level) = (Formulation::Articulated, Level::Fast);
        match Module::of_simulator(&file.scene, file.structure.as_ref(), formulation, level) {
            Ok(module) => assert!(!module.routines.is_empty(), "{}", path.display()),
            Err(error) => assert!(!error.to_string().is_empty(), "{}", path.display()),
        }
        scenes += 1;
    }
    assert!(scenes > 8, "{scenes} examples");
}
