//! Subjects, labels and the file.

mod support;

use std::fs;

use nboom_model::{MassProperties, Scene};
use nboom_scalar::{Isa, Kernel, Real, Routine, Vec3};
use nboom_verify::{Label, Subject, VerifyError, compare};

use support::{fork, s2_p, s2_p_scene};

#[test]
fn states_are_as_fast_as_the_scene() {
    let mut description = s2_p_scene();
    description.initial.omega_body = Vec3::unit_y() * 1e-3;
    let subject = Subject::new(Scene::new(description).expect("as before"), 50, 1).expect("finite");
    let rates = subject.states().iter().flat_map(|state| &state.tau);
    assert!(rates.clone().all(|rate| rate.abs() <= 1e-3) && rates.count() == 200);
}

#[test]
fn parameters_that_overflow_are_refused() {
    let mut description = s2_p_scene();
    // Mass and place are finite; the moment about the hinge is not.
    let far = Vec3::unit_y() * 1e160;
    let inertia = description.bodies[0].mass_properties.inertia;
    description.bodies[0].mass_properties = MassProperties::new(1e160, far, inertia);
    let scene = Scene::new(description).expect("every number is finite");
    let refused = Subject::new(scene, 1, 1);
    let Err(VerifyError::NotFinite { topology, number, value }) = &refused else {
        panic!("{refused:?}")
    };
    assert_eq!(topology, "S2_P");
    assert!((1..=82).contains(number) && !value.is_finite());
    let message = refused.expect_err("not finite").to_string();
    assert!(message.ends_with("a finite one expected"), "{message}");
}

/// Says that it takes `PINNED` of three parameters for granted.
struct Facts<const PINNED: usize>;

impl<const PINNED: usize> Routine for Facts<PINNED> {
    const TOPOLOGY: &'static str = "M";
    const FORMULATION: &'static str = "articulated";
    const PINNED: &'static [(usize, f64)] = [(0, 1.0), (1, 1.0), (2, 1.0)].split_at(PINNED).0;
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
fn labels_say_what_is_taken_for_granted() {
    for (kernel, facts) in [
        (Kernel::of::<Facts<0>>(), "general"),
        (Kernel::of::<Facts<2>>(), "principal"),
        (Kernel::of::<Facts<3>>(), "baked"),
    ] {
        assert_eq!(Label::generated(&kernel).facts, facts);
    }
}

#[test]
fn routines_for_other_scenes_are_left_out() {
    let codes = s2_p();
    let codes = codes.codes(&[Kernel::of::<Facts<0>>()]).expect("none fits");
    assert_eq!(codes.len(), 6);
    let why = &s2_p().not_covered(&[Kernel::of::<Facts<0>>()])[0].why;
    assert_eq!(why, "no routine for topology S2_P");
}

#[test]
fn the_file_has_what_was_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("new").join("fork.json");
    let subject = Subject::new(fork(), 10, 3).expect("finite");
    for (tolerance, passed) in [(1e-11, true), (1e-30, false)] {
        let comparison = compare(&subject, &[], &[], tolerance).expect("accelerations");
        comparison.write(&path).expect("writable");
        let text = fs::read_to_string(&path).expect("written");
        let file: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(file["passed"], passed);
        assert_eq!(file["topology"], serde_json::Value::Null);
        assert_eq!((&file["states"], &file["seed"]), (&10.into(), &3.into()));
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
            assert_eq!(in_file["state"], row.state);
        }
    }
}

#[test]
fn a_file_that_cannot_be_written_is_an_error() {
    let folder = tempfile::tempdir().expect("a folder");
    let subject = Subject::new(fork(), 1, 3).expect("finite");
    let comparison = compare(&subject, &[], &[], 1e-11).expect("accelerations");
    let refused = comparison.write(folder.path());
    assert!(matches!(refused, Err(VerifyError::Write { .. })), "{refused:?}");
}
