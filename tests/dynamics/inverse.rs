//! Inverse dynamics against what the recursion accelerates: wrench and torques that were handed to it come
//! back.

use nboom::formulation::{Drive, HingeMotion, Motion, Recognised, inverse_dynamics};
use nboom::scalar::Twist;

use crate::limbs;
use crate::satellites::{Satellite, random};

const SATELLITES: u64 = 3000;

/// The motion that the recursion gives, hinges in the order of the topology.
pub fn motion(satellite: &Satellite, recognised: &Recognised) -> Motion<f64> {
    let of = &satellite.accelerations;
    let hinge = |&j: &usize| {
        let (at, tau_dot) = (satellite.coordinates.hinges[j], of.tau_dot[j]);
        HingeMotion { beta: at.beta, tau: at.tau, tau_dot }
    };
    Motion {
        omega: satellite.coordinates.omega,
        main: Twist { angular: of.omega_dot_body, linear: of.origin_body },
        hinges: recognised.links.iter().map(hinge).collect(),
    }
}

/// Force, moment and torques, as rows of B₀.
fn flat(drive: &Drive<f64>) -> Vec<f64> {
    let Drive { external, torques } = drive;
    let mut all = [external.force.to_array(), external.moment.to_array()].concat();
    all.extend(torques);
    all
}

fn assert_returns(satellite: &Satellite, label: &str) {
    let recognised = satellite.recognised();
    let Recognised { topology, parameters, .. } = &recognised;
    let motion = motion(satellite, &recognised);
    let found = flat(&inverse_dynamics(topology, parameters, &motion));
    assert_drives(satellite, &recognised, &found, &format!("{label}, {topology}"));
}

/// Force, moment and torques that were found are those that acted.
pub fn assert_drives(satellite: &Satellite, recognised: &Recognised, found: &[f64], label: &str) {
    let coordinates = satellite.coordinates_of(recognised);
    let torques = coordinates.hinges.iter().map(|hinge| hinge.torque).collect();
    let expected = flat(&Drive { external: coordinates.external, torques });
    let accelerations = satellite.expected(&recognised.links);
    let matrix = satellite.mass_matrix_of(recognised);
    let forcing = satellite.forcing_of(recognised);
    assert_eq!(found.len(), expected.len());
    for (i, (found, expected)) in found.iter().zip(&expected).enumerate() {
        // Rounding of the sum that each force is, and of the accelerations in it, which are off by a few
        // roundings of the largest times the condition.
        let terms = (0..accelerations.len()).map(|j| (matrix[(i, j)] * accelerations[j]).abs());
        let size = terms.sum::<f64>() + forcing[i].abs() + expected.abs();
        let (error, allowed) = ((found - expected).abs(), satellite.allowed() * size.max(1.0));
        assert!(error < allowed, "{label}, row {i}: {error:e} of {allowed:e}");
    }
}

#[test]
fn forces_on_chains_and_paddles_come_back() {
    for seed in 0..SATELLITES {
        assert_returns(&Satellite::of_moment(&random(seed)), &format!("seed {seed}"));
    }
}

#[test]
fn forces_on_trees_come_back() {
    for seed in 0..SATELLITES {
        assert_returns(&limbs::satellite(seed), &format!("seed {seed}"));
    }
}

#[test]
fn numbers_of_a_motion_read_back() {
    for seed in 0..100 {
        let satellite = limbs::satellite(seed);
        let recognised = satellite.recognised();
        let motion = motion(&satellite, &recognised);
        let topology = &recognised.topology;
        assert_eq!(Motion::read(topology, &motion.write(topology)), motion);
    }
}
