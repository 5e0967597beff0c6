//! Routines for states with held hinges of robots, whose link frames depend on the angles.

use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng as _, SeedableRng};

use super::*;

/// A robot of equal links half a metre apart, each on the one given by a hinge about an axis.
fn robot(links: &[(Option<usize>, Vec3<f64>)]) -> Scene {
    let inertia = Sym3::diagonal(0.1, 0.11, 0.12);
    let link = MassProperties::new(1.0, Vec3::unit_z() * 0.5, inertia);
    let mut description = SceneDescription::at_rest("robot", link, 1.0);
    let body = |&(inboard, axis): &(Option<usize>, Vec3<f64>)| Body {
        inboard,
        mount: Mount::at(Vec3::unit_z() * 0.5),
        joint: Joint::Revolute,
        axis,
        mass_properties: link,
        tip: Vec3::unit_z(),
        hinge: Hinge::free(),
    };
    description.bodies = links.iter().map(body).collect();
    Scene::new(description).expect("the bodies are physical")
}

/// How many states held at angles of their own there are of the topologies that have a routine, and how many of
/// them the routines accept. Each routine is certified, which compares it with the recursion.
fn accepted(scene: &Scene) -> [usize; 2] {
    let requests = Request::lock_states(scene, Level::Fast).expect("limbs are covered");
    assert!(!requests.is_empty());
    for request in &requests {
        let free = request.free_hinges(scene).expect("covered").expect("it is one of them");
        let certified = Certified::new(scene, request, Some(&free));
        certified.unwrap_or_else(|error| panic!("{error}"));
    }
    let (mut of_states, mut of_accepted) = (0, 0);
    for test_case in TestCase::with_held_hinges(scene, 100, SEED).expect("finite") {
        let recognised = recognised(&test_case);
        let of_topology = requests.iter().filter(|r| r.topology == recognised.topology);
        for request in of_topology {
            of_states += 1;
            of_accepted += usize::from(accepts(request, recognised));
        }
    }
    [of_states, of_accepted]
}

#[test]
fn an_arm_is_certified_and_runs_generated_at_any_held_angle() {
    let [x, y] = [Vec3::unit_x(), Vec3::unit_y()];
    let arm = robot(&[(None, x), (Some(0), y), (Some(1), y), (Some(2), x)]);
    let [states, accepted] = accepted(&arm);
    assert!(states >= 50 && accepted == states, "{accepted} of {states}");
}

#[test]
fn a_routine_that_accepts_no_state_is_refused() {
    let [x, y] = [Vec3::unit_x(), Vec3::unit_y()];
    let arm = robot(&[(None, x), (Some(0), y), (Some(1), x)]);
    let mut request = Request::lock_states(&arm, Level::Fast).expect("limbs are covered").remove(0);
    let free = request.free_hinges(&arm).expect("covered").expect("it is one of them");
    assert!(Certified::new(&arm, &request, Some(&free)).is_ok());
    let assumed = request.assumptions.iter_mut().flatten().next().expect("it assumes something");
    *assumed = 12.5;
    let refused = Certified::new(&arm, &request, Some(&free)).err();
    assert!(matches!(refused, Some(PackageError::NotAccepted { .. })), "{refused:?}");
}

#[test]
fn random_trees_are_certified_and_run_generated_at_held_angles() {
    let units = [Vec3::unit_x(), Vec3::unit_y(), Vec3::unit_z()];
    let [mut states, mut of_accepted] = [0; 2];
    for tree in 0..12 {
        let mut dice = SplitMix64::seed_from_u64(tree);
        let mut below = |end: usize| (dice.next_u64() % end as u64) as usize;
        // Each link hangs on the last one or inboard of it.
        let mut way = Vec::new();
        let mut links = Vec::new();
        for i in 0..5 {
            way.truncate(1 + below(way.len() + 1));
            links.push((way.last().copied(), units[below(3)]));
            way.push(i);
        }
        let [all, accepted] = accepted(&robot(&links));
        states += all;
        of_accepted += accepted;
    }
    assert!(states >= 1000 && of_accepted == states, "{of_accepted} of {states}");
}
