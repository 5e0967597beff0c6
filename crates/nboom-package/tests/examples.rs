//! Routines of the examples.

use std::fs;
use std::path::Path;

use nboom_codegen::{Level, Module, Output, Request};
use nboom_formulation::{Formulation, RightSideLayout};
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

/// Two wings of a yoke and four panels, each hinge coupled with the one inboard of it: with all hinges free, and with any
/// held, all that acts has a place in a right side.
#[test]
fn cables_along_wings_are_in_the_right_sides_of_a_simulator() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/solar-array.toml");
    let file = read_scene(&path).expect("an example");
    let (formulation, level) = (Formulation::Articulated, Level::Fast);
    let module = Module::of_simulator(&file.scene, None, formulation, level).expect("chains");
    let of = |output: Output| module.routines.iter().filter(move |of| of.output == output);
    for request in of(Output::Accelerations) {
        let is_its_own = |other: &&Request| other.topology == request.topology;
        assert!(of(Output::RightSide).any(|other| is_its_own(&other)), "{}", request.topology);
    }
    let all_free = of(Output::RightSide).filter(|of| of.topology.to_string() == "2xS5");
    let mut count = 0;
    for request in all_free {
        // A yoke has no hinge inboard of its own, whatever is assumed of it.
        let inboard = request.topology.inboard_hinges();
        let couples = |hinge: usize| {
            let mut strength = RightSideLayout::strength(&request.topology, hinge).into_iter();
            inboard[hinge].is_some() && strength.all(|at| request.assumptions[at] != Some(0.0))
        };
        let found: Vec<usize> = (0..10).filter(|&hinge| couples(hinge)).collect();
        assert_eq!(found, [1, 2, 3, 4, 6, 7, 8, 9]);
        count += 1;
    }
    assert!(count > 0);
}
