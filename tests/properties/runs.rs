//! Short runs of random conservative trees, with lock-ups: momenta and energy as the test adds
//! them up from the recorded motion, and as the run's own account has them.

use nboom::scalar::Vec3;
use nboom::sim::EventKind;
use proptest::prelude::*;

use super::cases;
use super::log::{Log, options, run};
use super::newton_euler::{self, Sums, matrix, vector};
use super::random_scene::{Rng, conservative};
use nboom::formulation::Formulation;
use nboom::model::SceneDescription;
use nboom::sim::{Form, Options, Snapshot};

fn sums(scene: &SceneDescription, seen: &Snapshot) -> Sums {
    let to_inertial = seen.attitude.to_matrix();
    let velocity = to_inertial.transpose_mul(seen.velocity_inertial);
    let omega = vector(seen.omega_body);
    newton_euler::sums(&newton_euler::place(scene, &seen.beta, &seen.tau, omega, vector(velocity)))
}

/// A tree that moves for half a time unit, some hinges of which may lock on the way.
fn scene(bodies: usize, seed: u64, locks: bool) -> SceneDescription {
    let mut scene = conservative(bodies, seed);
    let dice = &mut Rng::new(seed ^ 0xca7c);
    scene.gravity = None;
    scene.end_time = 0.5;
    for body in &mut scene.bodies {
        // A spring through its own attachment has a force without direction there.
        body.hinge.kick_off = None;
        if locks && dice.chance(0.5) {
            body.hinge.lock_angle = Some(body.hinge.start.angle + 0.2 * body.hinge.start.rate);
        }
    }
    scene
}

/// Local errors of 1e-12 add up over some dozen steps, most of them with opposite signs; where a
/// light tree folds up, faster motion magnifies them.
const BALANCE: f64 = 2e-11;

fn keeps_momenta(scene: &SceneDescription, log: &Log) -> Result<(), TestCaseError> {
    let start = (sums(scene, &log.samples[0]), log.samples[0].attitude.to_matrix());
    for seen in log.samples.iter().chain(log.events.iter().map(|(_, after)| after)) {
        let (now, to_inertial) = (sums(scene, seen), matrix(&seen.attitude.to_matrix()));
        let at_start = matrix(&start.1);
        let linear = (to_inertial * now.linear - at_start * start.0.linear).norm();
        prop_assert!(linear < BALANCE * now.linear_scale, "linear {linear:e}");
        let angular = (to_inertial * now.angular - at_start * start.0.angular).norm();
        prop_assert!(angular < BALANCE * now.angular_scale, "angular {angular:e}");
        let energy = (seen.kinetic_energy - now.kinetic_energy).abs();
        prop_assert!(energy < 1e-12 * now.kinetic_energy, "reported energy {energy:e}");
        let reported = (vector(seen.angular_momentum_inertial) - to_inertial * now.angular).norm();
        prop_assert!(reported < 1e-12 * now.angular_scale, "reported momentum {reported:e}");
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn momenta_and_energy_are_kept(bodies in 1_usize..=8, seed: u64) {
        let scene = scene(bodies, seed, false);
        let log = run(&scene, &options(5, 1e-12));
        keeps_momenta(&scene, &log)?;
        let kept = log.summary.conservation;
        prop_assert!(kept.linear_momentum.is_some_and(|off| off < BALANCE), "{kept:?}");
        prop_assert!(kept.angular_momentum.is_some_and(|off| off < BALANCE), "{kept:?}");
        prop_assert!(kept.energy < BALANCE, "{kept:?}");
        // The energy from the test's own potentials, eq. (6.1) integrated.
        let total = |seen: &Snapshot| seen.kinetic_energy + potential(&scene, &seen.beta);
        let size = potential_scale(&scene, &log);
        let change = (total(log.last()) - total(&log.samples[0])).abs();
        prop_assert!(change < BALANCE * size, "{change:e} of {size:e}");
    }

    #[test]
    fn lock_ups_keep_momenta_and_lose_energy(bodies in 1_usize..=8, seed: u64) {
        let scene = scene(bodies, seed, true);
        let log = run(&scene, &options(5, 1e-12));
        keeps_momenta(&scene, &log)?;
        let kept = log.summary.conservation;
        prop_assert!(kept.angular_momentum.is_some_and(|off| off < BALANCE) && kept.energy < BALANCE, "{kept:?}");
        for (event, after) in log.of_kind(EventKind::LockUp) {
            prop_assert!(event.after.kinetic_energy <= event.before.kinetic_energy);
            let hinge = event.hinge.expect("a lock-up has a hinge");
            prop_assert_eq!(after.tau[hinge], 0.0);
            prop_assert_eq!(Some(after.beta[hinge]), scene.bodies[hinge].hinge.lock_angle);
            let jump = event.after.angular_momentum_inertial - event.before.angular_momentum_inertial;
            let size = sums(&scene, after).angular_scale;
            prop_assert!(jump.norm() < 1e-12 * size, "{:e} of {size:e}", jump.norm());
        }
    }
}

/// With momenta integrated, H̄_c is as exact as the velocities that are solved for: a condition of up
/// to some hundreds on the rounding of each state, whatever the errors of the steps.
const SOLVED_FOR: f64 = 1e-13;

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn momenta_that_are_integrated_are_kept_to_rounding(bodies in 1_usize..=8, seed: u64) {
        let scene = scene(bodies, seed, true);
        let formulation = Some(Form::Closed(Formulation::Momentum));
        let log = run(&scene, &Options { formulation, ..options(5, 1e-12) });
        keeps_momenta(&scene, &log)?;
        let kept = log.summary.conservation;
        prop_assert!(kept.energy < BALANCE, "{kept:?}");
        prop_assert!(kept.angular_momentum.is_some_and(|off| off < SOLVED_FOR), "{kept:?}");
        let rates = run(&scene, &options(5, 1e-12));
        prop_assert_eq!(log.events.len(), rates.events.len());
        let sum = |seen: &Snapshot| seen.tau.iter().map(|tau| tau.abs()).sum::<f64>();
        let apart = log.last().tau.iter().zip(&rates.last().tau).map(|(a, b)| (a - b).abs());
        let (apart, size) = (apart.sum::<f64>(), sum(log.last()) + log.last().omega_body.norm());
        // Errors of steps, magnified by a light tree that folds up.
        prop_assert!(apart < 1e-8 * size, "{apart:e} of {size:e}");
    }
}

fn potentials(scene: &SceneDescription, beta: &[f64]) -> Vec<f64> {
    let of_law =
        |quadratic: f64, linear: f64, x: f64| -quadratic * x * x * x / 3.0 - linear * x * x / 2.0;
    let of_hinge = |(body, &beta): (&nboom::model::Body, &f64)| {
        let (spring, dashpot) = (body.hinge.spring, body.hinge.dashpot);
        of_law(spring.quadratic, spring.linear, beta + spring.preload_angle)
            + of_law(dashpot.angle_quadratic, dashpot.angle_linear, beta + dashpot.preload_angle)
    };
    scene.bodies.iter().zip(beta).map(of_hinge).collect()
}

fn potential(scene: &SceneDescription, beta: &[f64]) -> f64 {
    potentials(scene, beta).iter().sum()
}

/// The largest energy of the run, so that a moment of rest does not count as nothing.
fn potential_scale(scene: &SceneDescription, log: &Log) -> f64 {
    let size = |seen: &Snapshot| {
        seen.kinetic_energy + potentials(scene, &seen.beta).iter().map(|p| p.abs()).sum::<f64>()
    };
    log.samples.iter().map(size).fold(0.0, f64::max)
}

/// The random scenes do what they are here for: without lock-ups the tests above prove little.
#[test]
fn many_of_the_random_scenes_lock() {
    let locks = |seed| {
        let scene = scene(6, seed, true);
        run(&scene, &options(1, 1e-9)).of_kind(EventKind::LockUp).len()
    };
    let counts: Vec<usize> = (0..20).map(locks).collect();
    assert!(counts.iter().filter(|&&n| n > 0).count() >= 10, "{counts:?}");
    assert!(scene(6, 0, true).initial.omega_body != Vec3::zero());
}
