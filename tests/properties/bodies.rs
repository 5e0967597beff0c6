//! The motion of every body by itself in what a run shows, against the independent derivation.

use nboom::model::SceneDescription;
use nboom::scalar::Vec3;
use nboom::sim::{BodyMotion, Snapshot};
use proptest::prelude::*;

use super::cases;
use super::log::{options, run};
use super::newton_euler::{matrix, place, vector};
use super::random_scene::{Rng, description};

/// Numbers of about 1 to 100 over a dozen hinges, each of which adds some roundings.
const ROUNDING: f64 = 1e-12;

/// A tree with forces of every kind, some hinges of which lock on the way.
fn scene(bodies: usize, seed: u64) -> SceneDescription {
    let mut scene = description(bodies, seed);
    let dice = &mut Rng::new(seed ^ 0xb0d1);
    scene.end_time = 0.2;
    for body in &mut scene.bodies {
        // A spring through its own attachment has a force without direction there.
        body.hinge.kick_off = None;
        if dice.chance(0.3) {
            body.hinge.lock_angle = Some(body.hinge.start.angle + 0.1 * body.hinge.start.rate);
        }
    }
    scene
}

fn are_placed(
    scene: &SceneDescription,
    seen: &Snapshot,
    bodies: &[BodyMotion],
) -> Result<(), TestCaseError> {
    let rot = seen.attitude.to_matrix();
    let velocity = rot.transpose_mul(seen.velocity_inertial);
    let omega = vector(seen.omega_body);
    let placed = place(scene, &seen.beta, &seen.tau, omega, vector(velocity));
    let rot = matrix(&rot);
    prop_assert_eq!(placed.len(), bodies.len());
    for (expected, found) in placed.iter().zip(bodies) {
        let own = expected.inertia * expected.omega;
        for (expected, found) in [
            (rot * expected.center + vector(seen.position_inertial), found.mass_center_inertial),
            (rot * expected.center_velocity, found.velocity_inertial),
            (rot * expected.omega, found.omega_inertial),
            (rot * expected.center_velocity * expected.mass, found.linear_momentum_inertial),
            (rot * own, found.own_angular_momentum_inertial),
        ] {
            let off = (expected - vector(found)).norm();
            prop_assert!(off < ROUNDING * (1.0 + expected.norm()), "{off:e} of {expected}");
        }
        let turned = (rot * expected.rot - matrix(&found.rot_inertial_from_body)).norm();
        prop_assert!(turned < ROUNDING, "{turned:e}");
    }
    Ok(())
}

/// The mass centre of all, and their momenta, angular about `point`.
fn totals(scene: &SceneDescription, bodies: &[BodyMotion], point: Vec3<f64>) -> [Vec3<f64>; 3] {
    let hinged = scene.bodies.iter().map(|body| body.mass_properties.mass);
    let masses: Vec<f64> = std::iter::once(scene.main_body.mass).chain(hinged).collect();
    let mut found = [Vec3::zero(); 3];
    for (body, mass) in bodies.iter().zip(&masses) {
        found[0] += body.mass_center_inertial * (mass / masses.iter().sum::<f64>());
        found[1] += body.linear_momentum_inertial;
        found[2] += body.angular_momentum_about(point);
    }
    found
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn bodies_move_as_hinges_say_and_sum_up_to_the_satellite(bodies in 1_usize..=8, seed: u64) {
        let scene = scene(bodies, seed);
        let log = run(&scene, &options(3, 1e-9));
        let checked = nboom::model::Scene::new(scene.clone()).expect("a scene");
        let point = Rng::new(seed).vector(3.0);
        for seen in log.samples.iter().chain(log.events.iter().map(|(_, after)| after)) {
            let found = seen.bodies(&checked);
            are_placed(&scene, seen, &found)?;
            let energy = found.iter().map(|body| {
                let moving = body.linear_momentum_inertial.dot(body.velocity_inertial);
                0.5 * (moving + body.own_angular_momentum_inertial.dot(body.omega_inertial))
            });
            let off = (energy.sum::<f64>() - seen.kinetic_energy).abs();
            prop_assert!(off < ROUNDING * seen.kinetic_energy, "energy {off:e}");
            let [center, linear, angular] = totals(&scene, &found, point);
            let size = linear.norm() + 1.0;
            let off = (linear - seen.linear_momentum_inertial).norm();
            prop_assert!(off < ROUNDING * size, "linear momentum {off:e}");
            // About another point than the mass centre there is the moment of all momentum more.
            let about_point = seen.angular_momentum_inertial + (center - point).cross(linear);
            let off = (angular - about_point).norm();
            let size = seen.angular_momentum_inertial.norm() + (center - point).norm() * size;
            prop_assert!(off < 10.0 * ROUNDING * size, "angular momentum {off:e} of {size:e}");
        }
    }
}
