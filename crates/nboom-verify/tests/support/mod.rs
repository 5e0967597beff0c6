//! Scenes.
#![allow(dead_code, reason = "each test takes what it needs")]

use nboom_model::{
    Appendage, Body, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment, Thrust,
};
use nboom_scalar::{Mat3, Sym3, Vec3};
use nboom_verify::Subject;

pub fn body() -> MassProperties {
    MassProperties::new(1.0, Vec3::new(0.1, 0.5, 0.2), Sym3::diagonal(1.0, 1.2, 1.4))
}

fn segment(length: f64) -> Segment {
    Segment { length, mass_properties: body(), hinge: Hinge::free() }
}

fn with_thrust(mut description: SceneDescription) -> Scene {
    let (force, point) = (Vec3::unit_x(), Vec3::unit_y());
    description.thrust = Some(Thrust { force, point, on: 0.0, off: 1.0 });
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
pub fn s2_p() -> Subject {
    Subject::new(with_thrust(s2_p_scene()), 40, 1970).expect("all numbers are finite")
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
