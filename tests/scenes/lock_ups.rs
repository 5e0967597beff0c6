//! Lock-ups of the reference scenes: what an instant conserves and what it takes away.

use nboom::dynamics::{Motion, Recursive};
use nboom::model::{HingeState, Mode, Scene};
use nboom::sim::{Event, EventKind, Snapshot};
use serde_json::Value;

use crate::catalog::Reference;
use crate::collect::{run, tight};
use crate::compare::{hinge_of, kind_of};
use crate::support::json_scene::vector;
use crate::support::{number, numbers, relative_error};

/// Sums of the magnitudes of the bodies' own linear and angular momenta just before a lock-up.
fn momentum_scales(scene: &Scene, after: &Snapshot, pre: &Value) -> (f64, f64) {
    let hinges = vec![HingeState::Free; scene.bodies.len()];
    let (beta, tau) = (numbers(&pre["beta"]), numbers(&pre["tau"]));
    let mut dynamics = Recursive::new(scene);
    dynamics.set_mode(&Mode { hinges, ..Mode::at_start(scene) }, &beta);
    let motion = Motion { omega_body: vector(&pre["omega"]), beta: &beta, tau: &tau };
    let momentum = after.attitude.to_matrix().transpose_mul(after.linear_momentum_inertial);
    let found = dynamics.invariants(&motion, momentum * (1.0 / scene.total_mass()));
    (found.linear_momentum_scale, found.angular_momentum_scale)
}

/// Every lock-up of a scene with the motion after it and the expected event.
fn lock_ups(reference: &Reference) -> Vec<(Event, Snapshot, Value)> {
    let (found, _) = run(&reference.scene(), &tight(1));
    let ours = found.events.into_iter().filter(|(event, _)| event.kind == EventKind::LockUp);
    let with_expected = ours.map(|(event, after)| {
        let same = |e: &&Value| kind_of(e) == EventKind::LockUp && hinge_of(e) == event.hinge;
        let expected = reference.events.iter().find(same).expect("the lock-up is expected");
        (event, after, expected.clone())
    });
    with_expected.collect()
}

#[test]
fn momentum_is_the_same_before_and_after() {
    let mut count = 0;
    let mut worst = 0.0_f64;
    for reference in Reference::all() {
        let scene = reference.scene();
        for (event, after, expected) in lock_ups(&reference) {
            let scales = momentum_scales(&scene, &after, &expected["pre"]);
            let (linear_scale, angular_scale) = scales;
            let (Event { before, after, .. }, name) = (event, reference.name);
            let linear = (after.linear_momentum_inertial - before.linear_momentum_inertial).norm();
            let angular =
                (after.angular_momentum_inertial - before.angular_momentum_inertial).norm();
            worst = worst.max(angular / angular_scale);
            assert!(linear < 1e-13 * linear_scale, "{name}: {linear:e} of {linear_scale:e}");
            assert!(angular < 1e-13 * angular_scale, "{name}: {angular:e} of {angular_scale:e}");
            count += 1;
        }
    }
    println!("worst angular momentum change {worst:.1e}");
    assert_eq!(count, LOCK_UPS);
}

/// Lock-ups in all scenes together.
const LOCK_UPS: usize = 16;

#[test]
fn the_lost_energy_is_half_the_impulses_times_the_rates_taken_away() {
    let (mut count, mut worst) = (0, 0.0_f64);
    for reference in Reference::all() {
        let found = lock_ups(&reference);
        for (event, _, _) in &found {
            // All lock-ups of one instant share its energies.
            let jointly = found.iter().filter(|(other, _, _)| other.time == event.time);
            let half_products = jointly.map(|(lock, _, expected)| {
                let hinge = lock.hinge.expect("a hinge locks");
                let impulse = lock.impulse.expect("a lock-up has an impulse");
                -0.5 * impulse * numbers(&expected["pre"]["tau"])[hinge]
            });
            let taken: f64 = half_products.sum();
            let (before, after) = (event.before.kinetic_energy, event.after.kinetic_energy);
            let error = (before - after - taken).abs() / before;
            worst = worst.max(error);
            assert!(taken > 0.0 && error < 1e-12, "{}: {error:e}", reference.name);
            count += 1;
        }
    }
    println!("worst Carnot error {worst:.1e}");
    assert_eq!(count, LOCK_UPS);
}

#[test]
fn the_motion_after_a_lock_up_is_the_expected_one() {
    let mut count = 0;
    for reference in Reference::all() {
        for (event, after, expected) in lock_ups(&reference) {
            let (pre, post) = (&expected["pre"], &expected["post"]);
            for (found, expected) in [
                (event.before.kinetic_energy, number(pre, "kinetic_energy")),
                (event.after.kinetic_energy, number(post, "kinetic_energy")),
            ] {
                assert!((found - expected).abs() < 1e-9 * expected, "{}", reference.name);
            }
            for (found, key) in [
                (after.omega_body.to_array().to_vec(), "omega"),
                (after.tau.clone(), "tau"),
                (after.beta.clone(), "beta"),
                (after.velocity_inertial.to_array().to_vec(), "vO_inertial"),
                (after.position_inertial.to_array().to_vec(), "rho_inertial"),
            ] {
                // The limit for states; nothing that moves in these scenes is smaller than 1e-3.
                let error = relative_error(&found, &numbers(&post[key]), 1e-3);
                assert!(error < 1e-9, "{}, {key}: {error:e}", reference.name);
            }
            let hinge = event.hinge.expect("a hinge locks");
            assert_eq!(after.tau[hinge], 0.0);
            assert_eq!(Some(after.beta[hinge]), reference.scene().bodies[hinge].hinge.lock_angle);
            count += 1;
        }
    }
    assert_eq!(count, LOCK_UPS);
}
