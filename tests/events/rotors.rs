//! Scenes of coaxial rotors: every mass centre is on the x axis, about which everything turns.
//!
//! Hub and booms are then rotors with moments of inertia [`HUB`] and [`BOOM`]. Without torque
//! each keeps its absolute rate, so every hinge turns at constant rate; a hinge alone, with a
//! torque Q, obeys μ β̈ = Q with μ = HUB·BOOM/(HUB+BOOM).

use nboom::model::{
    Appendage, Dashpot, Hinge, HingeStart, HingeState, MassProperties, Mount, Release, Scene,
    SceneDescription, Segment, Spring,
};
use nboom::scalar::{Sym3, Vec3};

/// Moment of inertia of the hub.
pub const HUB: f64 = 4.0;
/// Moment of inertia of each boom.
pub const BOOM: f64 = 1.0;
/// Reduced moment of inertia of the hub and one boom.
pub const REDUCED: f64 = HUB * BOOM / (HUB + BOOM);

/// Error of a time or angle of order 1 that only rounding and corrections of an event bring in:
/// some ten roundings.
pub const ROUNDING: f64 = 4e-15;

/// A ball with its mass centre at its origin.
pub fn ball(moment: f64) -> MassProperties {
    MassProperties::new(2.0, Vec3::zero(), Sym3::diagonal(moment, moment, moment))
}

/// Hub and booms about the x axis, at rest but for the hinges.
pub fn scene(hinges: &[Hinge], end_time: f64) -> Scene {
    Scene::new(description(hinges, end_time)).expect("rotors are bodies")
}

pub fn description(hinges: &[Hinge], end_time: f64) -> SceneDescription {
    let mut description = SceneDescription::at_rest("rotors", ball(HUB), end_time);
    for &hinge in hinges {
        let boom = Segment { length: 1.0, mass_properties: ball(BOOM), hinge };
        let mount = Mount::at(Vec3::zero());
        description.attach(&Appendage::Regular { mount, segments: vec![boom] });
    }
    description
}

/// A hinge that starts free.
pub fn free(angle: f64, rate: f64) -> Hinge {
    Hinge { start: HingeStart { angle, rate, state: HingeState::Free }, ..Hinge::free() }
}

/// A hinge that waits at angle zero.
pub fn waiting(release: Release) -> Hinge {
    let start = HingeStart { angle: 0.0, rate: 0.0, state: HingeState::Unreleased };
    Hinge { release, start, ..Hinge::free() }
}

pub fn locking_at(hinge: Hinge, angle: f64) -> Hinge {
    Hinge { lock_angle: Some(angle), ..hinge }
}

/// With a spring that makes β oscillate about `rest` at `frequency`.
pub fn oscillating(hinge: Hinge, frequency: f64, rest: f64) -> Hinge {
    let linear = -REDUCED * frequency * frequency;
    Hinge { spring: Spring { quadratic: 0.0, linear, preload_angle: -rest }, ..hinge }
}

/// With a dashpot that adds 2·`growth`·τ to β̈.
pub fn growing(hinge: Hinge, growth: f64) -> Hinge {
    let rate_linear = 2.0 * growth * REDUCED;
    Hinge { dashpot: Dashpot { rate_linear, ..Dashpot::default() }, ..hinge }
}

/// The rate of the hub after a boom that turned at `relative` has locked on a hub at `rate`,
/// with all else free: their angular momentum about the axis is kept.
pub fn merged_rate(rate: f64, relative: f64) -> f64 {
    rate + BOOM / (HUB + BOOM) * relative
}
