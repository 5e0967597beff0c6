//! Uniform gravity: the common mass centre falls along a parabola and nothing else changes,
//! whatever swings, locks and is kicked off inside.

use nboom::model::{Gravity, SceneDescription};
use nboom::scalar::Vec3;

use super::log::{Log, options, run};
use super::newton_euler::{self, matrix, vector};
use super::random_scene::{Rng, description};

fn scene(seed: u64) -> SceneDescription {
    let mut scene = description(6, seed);
    scene.externals.clear();
    scene.end_time = 1.0;
    let dice = &mut Rng::new(seed ^ 0xfa11);
    for body in &mut scene.bodies {
        body.hinge.lock_angle = Some(body.hinge.start.angle + 0.3 * body.hinge.start.rate);
    }
    scene.gravity = Some(Gravity { acceleration: 9.81, up: dice.direction() });
    scene
}

/// The mass centre at every output time, added up by the test from the recorded motion.
fn centers(scene: &SceneDescription, log: &Log) -> Vec<(f64, Vec3<f64>)> {
    let zero = nalgebra::Vector3::zeros();
    let center = |seen: &nboom::sim::Snapshot| {
        let placed = newton_euler::place(scene, &seen.beta, &seen.tau, zero, zero);
        let from_o = matrix(&seen.attitude.to_matrix()) * newton_euler::sums(&placed).center;
        let at = vector(seen.position_inertial) + from_o;
        (seen.time, Vec3::new(at.x, at.y, at.z))
    };
    log.samples.iter().map(center).collect()
}

#[test]
fn the_mass_center_falls_along_a_parabola() {
    for seed in 0..5 {
        let scene = scene(seed);
        let log = run(&scene, &options(20, 1e-12));
        let found = centers(&scene, &log);
        // The velocity of the mass centre at the start, from the test's own sums.
        let initial = &scene.initial;
        let to_body = initial.attitude.to_matrix().transpose();
        let velocity = vector(to_body * initial.velocity_inertial);
        let (beta, tau) = (&log.samples[0].beta, &log.samples[0].tau);
        let placed = newton_euler::place(&scene, beta, tau, vector(initial.omega_body), velocity);
        let sums = newton_euler::sums(&placed);
        let start = sums.linear / sums.mass;
        let start = initial.attitude.to_matrix() * Vec3::new(start.x, start.y, start.z);
        let gravity = scene.gravity.expect("it was set");
        let fall = gravity.up * -gravity.acceleration;
        for &(t, at) in &found {
            let expected = found[0].1 + start * t + fall * (0.5 * t * t);
            // Closed form in the simulator too: rounding of positions of order ten.
            assert!(
                (at - expected).norm() < 1e-13,
                "seed {seed}, {t}: {:e}",
                (at - expected).norm()
            );
        }
    }
}

/// A residual of energy is one of the motion inside, whoever looks on and wherever height is counted from.
#[test]
fn what_the_balance_of_energy_says_does_not_depend_on_who_looks_on() {
    for seed in 0..5 {
        let falling = scene(seed);
        let floating = SceneDescription { gravity: None, ..falling.clone() };
        let mut far = falling.clone();
        far.initial.position_inertial = Vec3::new(0.0, 0.0, 6.4e6);
        let mut fast = floating.clone();
        fast.initial.velocity_inertial = Vec3::new(7500.0, 0.0, 0.0);
        let residual =
            |scene: &SceneDescription| run(scene, &options(20, 1e-4)).summary.conservation.energy;
        let expected = residual(&floating);
        assert!(expected > 1e-9, "seed {seed}: {expected:e}");
        for scene in [&falling, &far, &fast] {
            let found = residual(scene);
            // The same motion; sums of its energies round otherwise.
            assert!((found - expected).abs() < 1e-12, "seed {seed}: {found:e} {expected:e}");
        }
    }
}

#[test]
fn gravity_changes_no_relative_motion() {
    for seed in 0..5 {
        let falling = scene(seed);
        let floating = SceneDescription { gravity: None, ..falling.clone() };
        let (a, b) = (run(&falling, &options(20, 1e-10)), run(&floating, &options(20, 1e-10)));
        assert!(a.events.len() > 3, "seed {seed}: {} events", a.events.len());
        assert_eq!(a.events.len(), b.events.len());
        for ((x, _), (y, _)) in a.events.iter().zip(&b.events) {
            assert_eq!((x.time, x.kind, x.hinge, x.impulse), (y.time, y.kind, y.hinge, y.impulse));
        }
        let gravity = falling.gravity.expect("it was set");
        for (x, y) in a.samples.iter().zip(&b.samples) {
            // Not only close: the same equations are solved, so every bit agrees.
            assert_eq!((x.time, x.omega_body, x.attitude), (y.time, y.omega_body, y.attitude));
            assert_eq!((&x.beta, &x.tau), (&y.beta, &y.tau));
            let fall = gravity.up * (-0.5 * gravity.acceleration * x.time * x.time);
            let apart = x.position_inertial - y.position_inertial;
            assert!((apart - fall).norm() < 1e-13);
        }
        let conserved = a.summary.conservation;
        assert!(conserved.linear_momentum.is_some_and(|off| off < 1e-13), "{conserved:?}");
    }
}
