//! Spins, times and positions that are far from 1.

use nboom::model::{External, Gravity, Scene, SceneDescription, Spring};
use nboom::scalar::Vec3;
use nboom::sim::Options;

use crate::collect::run;
use crate::stress::{RTOL, ball, both, chain, checked, conserving, free, options};

/// A hub with a boom that move without torque, all rates in proportion to `spin`, for three
/// radians.
fn spinning(spin: f64) -> Scene {
    let boom = (ball(1.0, 0.5, 0.1), free(0.4, 0.2 * spin));
    let mut scene = chain(ball(10.0, 0.1, 5.0), Vec3::unit_y() * 0.6, &[boom], 3.0 / spin);
    scene.initial.omega_body = Vec3::new(0.2, -0.3, 0.5) * spin;
    checked(scene)
}

/// Without torques the motion has no clock of its own: at any rate the same angles follow.
#[test]
fn spins_from_1e_minus_6_to_1e4_turn_through_the_same_angles() {
    let unit = both(&Options { rtol: 1e-13, atol: 1e-15, ..options(20) })[0];
    let (truth, _) = run(&spinning(1.0), &unit);
    for spin in [1e-6, 1e-3, 1.0, 1e2, 1e4] {
        for options in both(&options(20)) {
            let (found, summary) = conserving(&spinning(spin), &options, 10.0);
            let off = found.samples.iter().zip(&truth.samples).map(|(a, b)| {
                let omega = (a.omega_body * (1.0 / spin) - b.omega_body).norm();
                (a.beta[0] - b.beta[0]).abs().max((a.tau[0] / spin - b.tau[0]).abs()).max(omega)
            });
            let worst = off.fold(0.0, f64::max);
            let allowed = 10.0 * (summary.steps_accepted as f64 + 10.0) * RTOL;
            println!("spin {spin:e}: {worst:.1e} of {allowed:.1e}");
            assert!(worst < allowed, "{spin:e}: {worst:e} of {allowed:e}");
        }
    }
}

#[test]
fn a_swing_of_a_million_seconds_keeps_its_phase() {
    let (hub, boom, frequency, start) = (4.0, 1.0, 1e-4_f64, 0.3);
    let reduced = hub * boom / (hub + boom);
    let mut hinge = free(start, 0.0);
    let linear = -reduced * frequency * frequency;
    hinge.spring = Spring { quadratic: 0.0, linear, preload_angle: 0.0 };
    let segments = [(ball(2.0, 0.0, boom), hinge)];
    let scene = checked(chain(ball(2.0, 0.0, hub), Vec3::zero(), &segments, 1e6));
    for options in both(&options(100)) {
        let (found, summary) = conserving(&scene, &options, 10.0);
        let off =
            found.samples.iter().map(|s| (s.beta[0] - start * (frequency * s.time).cos()).abs());
        let worst = off.fold(0.0, f64::max);
        // The error of a step is one of phase at most.
        let allowed = summary.steps_accepted as f64 * RTOL;
        println!("{worst:.1e} of {allowed:.1e}");
        assert!(worst < allowed, "{worst:e} of {allowed:e}");
        // Steps are as long as the motion allows: 16 periods, less than 100 steps in each.
        assert!(summary.steps_accepted < 1600, "{}", summary.steps_accepted);
    }
}

/// A hub with a boom under gravity and thrust, all seen from `offset` away.
fn displaced(offset: f64) -> SceneDescription {
    let boom = (ball(1.0, 0.5, 0.1), free(0.4, 0.2));
    let mut scene = chain(ball(10.0, 0.1, 5.0), Vec3::unit_y() * 0.6, &[boom], 3.0);
    scene.initial.omega_body = Vec3::new(0.2, -0.3, 0.5);
    scene.initial.position_inertial = Vec3::new(1.0, -0.5, 0.25) * offset;
    scene.gravity = Some(Gravity { acceleration: 9.81, up: Vec3::unit_z() });
    scene.externals = vec![External::thrust(Vec3::unit_x(), Vec3::unit_z(), [0.5, 1.5])];
    scene
}

#[test]
fn an_offset_of_1e8_costs_the_digits_of_positions_only() {
    let offset = 1e8;
    for options in both(&options(20)) {
        let (near, _) = run(&checked(displaced(0.0)), &options);
        let (far, summary) = run(&checked(displaced(offset)), &options);
        let shift = Vec3::new(1.0, -0.5, 0.25) * offset;
        let steps = summary.steps_accepted as f64;
        for (a, b) in near.samples.iter().zip(&far.samples) {
            let turned = (a.omega_body - b.omega_body).norm().max((a.beta[0] - b.beta[0]).abs());
            // Translation drives nothing; under thrust it is among the variables of a step, whose
            // length may then differ.
            let allowed = 10.0 * steps * RTOL;
            assert!(turned < allowed, "{turned:e} of {allowed:e} at {}", a.time);
            let moved = (b.position_inertial - a.position_inertial - shift).norm();
            // A rounding of the offset for each step at most, or its rtol: the position is a
            // variable whose size is the offset.
            let allowed = steps * offset * (f64::EPSILON + RTOL);
            assert!(moved < allowed, "{moved:e} of {allowed:e} at {}", a.time);
        }
        let (a, b) = (near.last(), far.last());
        println!(
            "omega {:.1e}, position {:.1e}, {:?}",
            (a.omega_body - b.omega_body).norm(),
            (b.position_inertial - a.position_inertial - shift).norm(),
            summary.conservation
        );
        assert!(summary.conservation.energy < 10.0 * steps * RTOL, "{:?}", summary.conservation);
    }
}
