//! Scenes.
#![allow(dead_code, reason = "each test takes what it needs")]

use nboom_formulation::{Coordinates, Formulation, Parameters};
use nboom_model::{
    Appendage, Body, External, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment,
};
use nboom_scalar::{Isa, Kernel, Mat3, Real, Routine, Sym3, Vec3};
use nboom_verify::TestCase;

pub fn body() -> MassProperties {
    MassProperties::new(1.0, Vec3::new(0.1, 0.5, 0.2), Sym3::diagonal(1.0, 1.2, 1.4))
}

fn segment(length: f64) -> Segment {
    Segment { length, mass_properties: body(), hinge: Hinge::free() }
}

fn with_thrust(mut description: SceneDescription) -> Scene {
    let (force, point) = (Vec3::unit_x(), Vec3::unit_y());
    description.externals.push(External::thrust(force, point, [0.0, 1.0]));
    Scene::new(description).expect("the bodies are physical")
}

/// A paddle before a boom of two segments, so that the scene's order of hinges is not the
/// topology's.
pub fn s2_p_scene() -> SceneDescription {
    let mut description = SceneDescription::at_rest("paddle and boom", body(), 1.0);
    let mut mount = Mount::at(Vec3::unit_y());
    mount.rot_inboard_from_hinge = Mat3::from_euler_121(0.3, 0.5, -0.7);
    let [arm, paddle] = [segment(0.8), segment(0.0)];
    description.attach(&Appendage::Paddle { mount, arm, paddle });
    let segments = vec![segment(1.0), segment(0.6)];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_z()), segments });
    description
}

/// Forty states of [`s2_p_scene`] under thrust.
pub fn s2_p() -> TestCase {
    TestCase::new(with_thrust(s2_p_scene()), 40, 1970).expect("all numbers are finite")
}

/// A boom of two segments, and a third one on the first: no chain.
pub fn fork() -> Scene {
    let mut description = SceneDescription::at_rest("fork", body(), 1.0);
    let segments = vec![segment(1.0); 2];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_z()), segments });
    let axis = Vec3::unit_z();
    description.bodies.push(Body { inboard: Some(0), axis, ..description.bodies[1] });
    with_thrust(description)
}

/// `articulated` of S3_P, nothing assumed, with τ̇ of the hinge at `WRONG` wrong by 1e-9
/// of itself.
struct ArticulatedS3P<const WRONG: usize>;

impl<const WRONG: usize> Routine for ArticulatedS3P<WRONG> {
    const RESULT: &'static str = "accelerations";
    const TOPOLOGY: &'static str = "S3_P";
    const FORMULATION: &'static str = "articulated";
    const ASSUMPTIONS: &'static [(usize, f64)] = &[];
    const EXTERNAL: bool = true;
    const PARAMETERS: usize = 94;
    const CONSTANTS: usize = 94;
    const COORDINATES: usize = 24;
    const OUTPUTS: usize = 11;

    fn prepare<R: Real>(parameters: &[R], constants: &mut [R]) {
        constants.copy_from_slice(parameters);
    }

    fn evaluate<R: Real>(constants: &[R], coordinates: &[R], outputs: &mut [R]) {
        let topology = Self::TOPOLOGY.parse().expect("a topology");
        let parameters = Parameters::read(&topology, constants.iter().copied());
        let coordinates = Coordinates::read(&topology, coordinates);
        let found = Formulation::Articulated.solve(&topology, &parameters, &coordinates);
        outputs.copy_from_slice(&found.write(&topology));
        if let Some(wrong) = outputs.get_mut(6 + WRONG) {
            *wrong = *wrong * R::constant(1.0 + 1e-9);
        }
    }

    fn evaluate_packed<I: Isa>(constants: &[f64], coordinates: &[f64], outputs: &mut [f64]) {
        Self::evaluate(constants, coordinates, outputs);
    }
}

/// `articulated` of S3_P.
pub fn articulated_s3_p() -> &'static [Kernel] {
    vec![Kernel::of::<ArticulatedS3P<5>>()].leak()
}

/// `articulated` of S3_P with the paddle's τ̇ wrong by 1e-9 of itself.
pub fn wrong_s3_p() -> &'static [Kernel] {
    vec![Kernel::of::<ArticulatedS3P<4>>()].leak()
}
