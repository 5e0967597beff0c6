//! Hinges that friction or a stop lets go, for a moment or for good.

use std::f64::consts::PI;

use nboom_model::{
    Appendage, Base, Hinge, MassProperties, Mount, Scene, SceneDescription, Segment,
};
use nboom_ode::Method;
use nboom_scalar::{Sym3, Vec3};
use nboom_sim::{EventKind, Options};

use crate::friction::{METHODS, run};
use crate::stops::{pushed, stops};
use crate::{ball, free, scene, tight};

/// Rate of the outer body.
const RATE: f64 = 3.0;
/// The largest torque about the inner hinge, of a mass of 1 at 0.3 from the outer one, which is at 1.
const LARGEST: f64 = 0.3 * RATE * RATE;
/// What holds the inner hinge bears this much.
const BEARS: f64 = 1.1;

/// An arm that is held, and on its end a body out of balance, which turns at a constant rate from the angle `phase` on
/// and draws the arm along with `LARGEST` times the sine of its angle.
fn unbalanced(arm: Hinge, phase: f64) -> SceneDescription {
    let turning = MassProperties::new(1.0, Vec3::unit_y() * 0.3, Sym3::diagonal(0.1, 0.1, 0.1));
    let segments = vec![
        Segment { length: 1.0, mass_properties: ball(5.0), hinge: arm },
        Segment { length: 1.0, mass_properties: turning, hinge: free(phase, RATE) },
    ];
    let mut description = SceneDescription::at_rest("unbalanced", ball(4.0), 3.0);
    description.base = Base::Fixed;
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    description
}

/// The arm is let go at the time that its closed form has, by every method at every tolerance, though the torque comes
/// back within a long step.
fn is_let_go(name: &str, scene: &Scene, kind: EventKind, expected: f64) {
    for integrator in METHODS.into_iter().chain([Method::Adams, Method::Dopri5, Method::Radau13]) {
        for rtol in [1e-6, 1e-9, 1e-12] {
            let options = Options { integrator, rtol, atol: 1e-2 * rtol, ..tight(1) };
            let (told, _) = run(scene, options);
            let first = told.events.iter().find(|event| event.kind == kind);
            let found = first.map_or(f64::NAN, |event| event.time);
            // Tolerances of a few steps.
            let is_near = (found - expected).abs() < 1e2 * rtol.max(1e-11);
            assert!(is_near, "{name}, {integrator:?}, {rtol:e}: {found}, {expected} expected");
        }
    }
}

#[test]
fn a_stop_lets_go_what_is_drawn_off_for_a_moment() {
    let leaves_at = (BEARS / LARGEST).asin();
    for number in 0..12 {
        let phase = -3.0 + 0.25 * f64::from(number);
        let mut description =
            unbalanced(Hinge { stops: stops(0.0, 1.0, 0.5), ..free(0.0, 0.0) }, phase);
        pushed(&mut description, 0, -BEARS);
        let expected = (leaves_at - phase) / RATE;
        is_let_go(&format!("from {phase}"), &scene(description), EventKind::Leave, expected);
    }
}

#[test]
fn friction_lets_go_what_is_drawn_along_for_a_moment() {
    let slips_at = (BEARS / LARGEST).asin();
    for number in 0..12 {
        let before = slips_at * (0.05 + 0.16 * f64::from(number));
        for half_a_turn in [0.0, PI] {
            let phase = slips_at - before - half_a_turn;
            let arm = Hinge { friction: BEARS, ..free(0.0, 0.0) };
            let scene = scene(unbalanced(arm, phase));
            is_let_go(&format!("from {phase}"), &scene, EventKind::Slip, before / RATE);
        }
    }
}
