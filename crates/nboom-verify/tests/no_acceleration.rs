//! Scenes whose true accelerations are zero: right code passes, and wrong code is still found.

mod support;

use nboom_formulation::{Coordinates, Formulation, Layout, Parameters};
use nboom_model::{Base, MassProperties, Scene, SceneDescription, Topology};
use nboom_scalar::{Isa, Kernel, Real, Routine, Sym3, Vec3};
use nboom_verify::{Hinges, Quantity, Row, TestCase, compare};

use support::s2_p_scene;

const TOLERANCE: f64 = 1e-11;

/// Isotropic inertias that once failed.
const INERTIAS: [f64; 7] = [0.02, 0.1, 0.3, 2.5, 4.0, 7.3, 10.0];

/// A free body with the same inertia about all axes, which turns at a constant rate.
fn sphere(inertia: f64, rate: f64) -> TestCase {
    let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(inertia, inertia, inertia));
    let mut description = SceneDescription::at_rest("sphere", body, 1.0);
    description.initial.omega_body = Vec3::unit_x() * rate;
    let scene = Scene::new(description).expect("the body is physical");
    TestCase::new(scene, 200, 1970).expect("all numbers are finite")
}

/// [`s2_p_scene`] on a heavy main body that is held, without gravity.
fn rig() -> Scene {
    let mut description = s2_p_scene();
    let inertia = Sym3::diagonal(40.0, 30.0, 20.0);
    description.main_body = MassProperties::new(100.0, Vec3::zero(), inertia);
    description.base = Base::Fixed;
    Scene::new(description).expect("the bodies are physical")
}

/// `articulated` of a main body alone, with the first acceleration off by 10^-`DIGITS` ω².
struct OfMainBody<const DIGITS: i32>;

/// As much as a fused multiplication and addition leaves of ω × J ω.
const RIGHT: i32 = 16;
const WRONG: i32 = 9;

impl<const DIGITS: i32> Routine for OfMainBody<DIGITS> {
    const RESULT: &'static str = "accelerations";
    const TOPOLOGY: &'static str = "M";
    const FORMULATION: &'static str = "articulated";
    const ASSUMPTIONS: &'static [(usize, f64)] = &[];
    const EXTERNAL: bool = true;
    const PARAMETERS: usize = Layout::MAIN;
    const CONSTANTS: usize = Layout::MAIN;
    const COORDINATES: usize = 9;
    const OUTPUTS: usize = 6;

    fn prepare<R: Real>(parameters: &[R], constants: &mut [R]) {
        constants.copy_from_slice(parameters);
    }

    fn evaluate<R: Real>(constants: &[R], coordinates: &[R], outputs: &mut [R]) {
        let topology: Topology = Self::TOPOLOGY.parse().expect("a topology");
        let parameters = Parameters::read(&topology, constants.iter().copied());
        let coordinates = Coordinates::read(&topology, coordinates);
        let found = Formulation::Articulated.solve(&topology, &parameters, &coordinates);
        outputs.copy_from_slice(&found.write(&topology));
        let square = coordinates.omega.dot(coordinates.omega);
        outputs[0] += square * R::constant(10.0_f64.powi(-DIGITS));
    }

    fn evaluate_packed<I: Isa>(constants: &[f64], coordinates: &[f64], outputs: &mut [f64]) {
        Self::evaluate(constants, coordinates, outputs);
    }
}

#[test]
fn a_sphere_passes_and_wrong_code_for_it_does_not() {
    let right = vec![Kernel::of::<OfMainBody<RIGHT>>()].leak();
    let wrong = vec![Kernel::of::<OfMainBody<WRONG>>()].leak();
    for inertia in INERTIAS {
        // Slow and fast: the scale follows the rates.
        for rate in [1e-3, 1.0, 50.0] {
            let sphere = sphere(inertia, rate);
            let comparison = compare(&sphere, &[], right, &[], TOLERANCE).expect("accelerations");
            let worst = comparison.worst();
            assert!(comparison.passed(), "{inertia} {rate} {worst:?}");
            let comparison = compare(&sphere, &[], wrong, &[], TOLERANCE).expect("accelerations");
            let caught = comparison.rows.iter().filter(|row| row.worst() > TOLERANCE);
            let caught: Vec<_> = caught.map(|row| (row.quantity, row.label.path)).collect();
            assert_eq!(caught, [(Quantity::Accelerations, "generated")], "{inertia} {rate}");
        }
    }
}

#[test]
fn a_rig_without_gravity_passes_and_wrong_code_for_it_does_not() {
    let held = TestCase::with_held_hinges(&rig(), 60, 1970).expect("finite");
    let free = TestCase::new(rig(), 20, 1970).expect("finite");
    for (kernel, right) in
        [(Kernel::of::<OfMainBody<RIGHT>>(), true), (Kernel::of::<OfMainBody<WRONG>>(), false)]
    {
        let comparison = compare(&free, &held, vec![kernel].leak(), &[], TOLERANCE);
        let comparison = comparison.expect("accelerations");
        // The routine is for states all of whose hinges are held.
        let generated = |row: &&Row| row.label.path == "generated";
        let row = comparison.rows.iter().find(generated).expect("some such states");
        assert_eq!((row.hinges, comparison.passed()), (Hinges::Held, right), "{row:?}");
    }
}
