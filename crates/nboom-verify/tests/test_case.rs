//! Test cases, labels and the file.

mod support;

use std::cell::Cell;

use nboom_formulation::{Embedding, Formulation, Layout};
use nboom_model::{MassProperties, Scene, Topology};
use nboom_scalar::{Isa, Kernel, Real, Routine, Sym3, Vec3};
use nboom_sim::Fit;
use nboom_verify::{ComparedCode, Label, TestCase, VerifyError, compare};

use support::{fork, s2_p, s2_p_scene};

#[test]
fn states_are_as_fast_as_the_scene() {
    let mut description = s2_p_scene();
    description.initial.omega_body = Vec3::unit_y() * 1e-3;
    let test_case =
        TestCase::new(Scene::new(description).expect("as before"), 50, 1).expect("finite");
    let rates = test_case.states().iter().flat_map(|state| &state.tau);
    assert!(rates.clone().all(|rate| rate.abs() <= 1e-3) && rates.count() == 200);
}

#[test]
fn states_are_drawn_until_somebody_interrupts() {
    let asked = Cell::new(0);
    let interrupted = || asked.replace(asked.get() + 1) == 3;
    let scene = Scene::new(s2_p_scene()).expect("as before");
    let drawn = TestCase::new_unless(&interrupted, scene, 1_000, 1);
    assert!(matches!(drawn, Err(VerifyError::Interrupted)), "{drawn:?}");
    assert_eq!(asked.get(), 4);
}

#[test]
fn parameters_that_overflow_are_refused() {
    let mut description = s2_p_scene();
    // Each body's numbers are finite; the paddle's, seen from where a chain has its origin, is not.
    description.bodies[3].mount.point = Vec3::unit_x() * 1e160;
    let scene = Scene::new(description).expect("every number is finite");
    let refused = TestCase::new(scene, 1, 1);
    let Err(VerifyError::NotFinite { topology, parameter, value }) = &refused else {
        panic!("{refused:?}")
    };
    assert_eq!(topology, "S2_P");
    assert!(parameter.ends_with("of link 2 of appendage 1") && !value.is_finite(), "{parameter}");
    let message = refused.expect_err("not finite").to_string();
    assert!(message.ends_with("a finite one expected"), "{message}");
}

#[test]
fn states_without_accelerations_are_refused() {
    let mut description = s2_p_scene();
    let test_case = |description| TestCase::new(Scene::new(description).expect("bodies"), 9, 1);
    let regular = test_case(description.clone()).expect("finite");
    assert!(regular.check_regular().is_ok());
    // The last segment is a point on its hinge's axis.
    description.bodies[3].mass_properties = MassProperties::new(1.0, Vec3::zero(), Sym3::zero());
    let refused = test_case(description).expect("finite").check_regular();
    let Err(VerifyError::NoReference { state: 1, hinge: Some(hinge) }) = refused else {
        panic!("{refused:?}")
    };
    assert_eq!(hinge.to_string(), "2,2");
}

/// Assumes the first `ASSUMED` of three parameters.
struct Assuming<const ASSUMED: usize>;

impl<const ASSUMED: usize> Routine for Assuming<ASSUMED> {
    const RESULT: &'static str = "accelerations";
    const TOPOLOGY: &'static str = "M";
    const FORMULATION: &'static str = "articulated";
    const ASSUMPTIONS: &'static [(usize, f64)] = [(0, 1.0), (1, 1.0), (2, 1.0)].split_at(ASSUMED).0;
    const EXTERNAL: bool = true;
    const PARAMETERS: usize = 3;
    const CONSTANTS: usize = 0;
    const COORDINATES: usize = 0;
    const OUTPUTS: usize = 0;

    fn prepare<R: Real>(_: &[R], _: &mut [R]) {}

    fn evaluate<R: Real>(_: &[R], _: &[R], _: &mut [R]) {}

    fn evaluate_packed<I: Isa>(_: &[f64], _: &[f64], _: &mut [f64]) {}
}

#[test]
fn labels_say_what_is_assumed() {
    for (kernel, assumptions) in [
        (Kernel::of::<Assuming<0>>(), "general"),
        (Kernel::of::<Assuming<2>>(), "general"),
        (Kernel::of::<Assuming<3>>(), "baked"),
    ] {
        let topology: Topology = "M".parse().expect("a topology");
        let embedding = Embedding::new(&topology, &topology).expect("it is in itself");
        let fit = Fit { kernel, embedding: embedding.into(), parameters: vec![1.0; 3] };
        let label = Label::generated(&fit);
        assert_eq!(
            (label.assumptions, label.topology, label.virtual_links),
            (assumptions, Some("M"), 0)
        );
    }
}

#[test]
fn routines_for_other_scenes_are_left_out() {
    let test_case = s2_p();
    let other = vec![Kernel::of::<Assuming<0>>()].leak();
    assert_eq!(test_case.codes(other).expect("none fits").len(), 7);
    assert_eq!(test_case.not_covered(other)[0].why, "no routine for topology S2_P");
}

#[test]
fn an_assumption_that_does_not_hold_is_named() {
    // S2_P with the chain's first mass taken for 2; it is 1.
    const MASS: usize = Layout::MAIN + Layout::BRANCH;
    let mut kernel = Kernel::of::<Assuming<0>>();
    (kernel.topology, kernel.parameters, kernel.assumptions) = ("S2_P", 82, &[(MASS, 2.0)]);
    let why = &s2_p().not_covered(vec![kernel].leak())[0].why;
    let words = "mass of link 1 of appendage 1 is 1, and 2 is assumed";
    assert_eq!(*why, format!("no routine for topology S2_P fits: {words}"));
    (kernel.assumptions, kernel.external) = (&[], false);
    let why = &s2_p().not_covered(vec![kernel].leak())[0].why;
    assert!(why.ends_with("that nothing acts on the main body from outside"), "{why}");
}

#[test]
fn a_routine_that_a_run_embeds_the_scene_in_is_covered() {
    let test_case = s2_p();
    let larger = support::articulated_s3_p();
    let codes = test_case.codes(larger).expect("it fits");
    let (label, ComparedCode::Routine { fit, .. }) = codes.last().expect("codes") else {
        panic!("no routine")
    };
    assert_eq!((label.topology, label.virtual_links), (Some("S3_P"), 1));
    assert_eq!(fit.kernel.formulation, Formulation::Articulated.name());
    assert!(test_case.not_covered(larger).is_empty());
    let comparison = compare(&test_case, &[], larger, &[], 1e-11).expect("accelerations");
    assert!(comparison.passed(), "{comparison:?}");
    let row = comparison.rows.iter().find(|row| row.label == *label).expect("a row");
    assert!(row.states == 40 && row.from_double_double > 0.0, "{row:?}");
}

#[test]
fn held_hinges_are_some_and_have_all_angles() {
    let scene = Scene::new(s2_p_scene()).expect("as before");
    let held = TestCase::with_held_hinges(&scene, 200, 3).expect("finite");
    assert_eq!(held.len(), 200);
    for test_case in &held {
        let free = test_case.held().iter().filter(|angle| angle.is_none()).count();
        let [state] = test_case.states() else { panic!("one state each") };
        assert!(free < 4 && state.beta.len() == free && state.tau.len() == free);
    }
    let angles = || held.iter().flat_map(TestCase::held).flatten();
    assert!(angles().any(|angle| *angle > 3.0) && angles().any(|angle| *angle < -3.0));
    for hinge in 0..4 {
        let count = held.iter().filter(|test_case| test_case.held()[hinge].is_some()).count();
        assert!((100..150).contains(&count), "{count}");
    }
    assert!(held.iter().any(|test_case| test_case.held().iter().all(Option::is_some)));
}

#[test]
fn the_file_has_what_was_found() {
    let test_case = TestCase::new(fork(), 7, 3).expect("finite");
    let held = TestCase::with_held_hinges(&fork(), 3, 3).expect("finite");
    for (tolerance, passed) in [(1e-11, true), (1e-30, false)] {
        let comparison = compare(&test_case, &held, &[], &[], tolerance).expect("accelerations");
        let text = comparison.json();
        let file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(file["passed"], passed);
        assert_eq!(file["topology"], "Tr(p)(r)");
        assert_eq!((&file["states"], &file["held"]), (&10.into(), &3.into()));
        assert_eq!(file["seed"], 3);
        // The reader of the test may be off by the last bit; the text is not.
        let same = |found: &serde_json::Value, expected: f64| {
            found.as_f64().is_some_and(|found| (found - expected).abs() <= 1e-15 * expected)
        };
        assert!(same(&file["tolerance"], tolerance), "{file}");
        assert!(same(&file["largest_condition"], comparison.largest_condition), "{file}");
        let rows = file["rows"].as_array().expect("rows");
        assert_eq!(rows.len(), comparison.rows.len());
        for (in_file, row) in rows.iter().zip(&comparison.rows) {
            assert_eq!(in_file["formulation"], row.label.formulation);
            let from_recursion = &in_file["from_recursion"];
            assert!(
                row.from_recursion.map_or(from_recursion.is_null(), |x| same(from_recursion, x))
            );
            assert!(same(&in_file["from_double_double"], row.from_double_double), "{in_file}");
            assert_eq!(
                (&in_file["state"], &in_file["states"]),
                (&row.state.into(), &row.states.into())
            );
        }
    }
}
