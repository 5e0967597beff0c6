//! Impulses of lock-ups and stops: momenta added up by the test, Carnot's theorem, and the independence of
//! the order in which hinges of one instant are locked.

use nboom::dynamics::{Impulses, Motion, Struck};
use nboom::model::HingeState;
use nboom::scalar::Vec3;
use proptest::prelude::*;

use super::newton_euler::{self, Sums, vector};
use super::random_scene::{Moment, Rng, moment};
use super::{Prepared, cases};

fn sums(moment: &Moment) -> Sums {
    let (omega, velocity) = (vector(moment.omega), vector(moment.velocity_body));
    newton_euler::sums(&newton_euler::place(
        &moment.scene,
        &moment.beta,
        &moment.tau,
        omega,
        velocity,
    ))
}

/// The moment after locking these hinges of the scene, and what the lock-up says.
fn locked(moment: &Moment, hinges: &[usize]) -> (Moment, Impulses<f64>) {
    let (mut after, found) = rebounded(moment, hinges, &vec![0.0; hinges.len()]);
    for &i in hinges {
        after.mode.hinges[i] = HingeState::Locked;
    }
    (after, found)
}

/// The moment after these hinges have rebounded at such shares of their rates, and what the impulses say.
fn rebounded(moment: &Moment, hinges: &[usize], shares: &[f64]) -> (Moment, Impulses<f64>) {
    let mut prepared = Prepared::new(moment);
    let free = prepared.dynamics.free_hinges().to_vec();
    let position = |i: &usize| free.iter().position(|j| j == i).expect("only free hinges lock");
    let struck = |(i, share): (&usize, &f64)| Struck {
        position: position(i),
        after: -share * moment.tau[*i],
    };
    let struck: Vec<_> = hinges.iter().zip(shares).map(struck).collect();
    let mut found = Impulses::of_none();
    let locked = prepared.dynamics.strike(&prepared.beta, &prepared.tau, &struck, &mut found);
    locked.expect("a regular mass matrix");
    let mut after = Moment {
        scene: moment.scene.clone(),
        mode: moment.mode.clone(),
        beta: moment.beta.clone(),
        tau: moment.tau.clone(),
        omega: moment.omega + found.delta_omega_body,
        velocity_body: moment.velocity_body + found.delta_velocity_body,
    };
    for (&i, change) in free.iter().zip(&found.delta_tau) {
        after.tau[i] += change;
    }
    (after, found)
}

/// Some of the free hinges, at least one.
fn choose(moment: &Moment, seed: u64) -> Vec<usize> {
    let dice = &mut Rng::new(seed ^ 0x10c);
    let free: Vec<usize> =
        (0..moment.mode.hinges.len()).filter(|&i| moment.mode.is_free(i)).collect();
    let chosen: Vec<usize> = free.iter().copied().filter(|_| dice.chance(0.4)).collect();
    if chosen.is_empty() { free.into_iter().take(1).collect() } else { chosen }
}

/// Rounding of the velocity jump, a solution with the mass matrix, magnified by the trees'
/// conditions of up to some thousands; the bodies' own momenta are the scale.
const KEPT: f64 = 1e-13;

fn momenta_are_kept(old: &Sums, new: &Sums) -> Result<(), TestCaseError> {
    let linear = (new.linear - old.linear).norm() / (old.linear_scale + new.linear_scale);
    prop_assert!(linear < KEPT, "linear momentum {linear:e}");
    let angular = (new.angular - old.angular).norm() / (old.angular_scale + new.angular_scale);
    prop_assert!(angular < KEPT, "angular momentum {angular:e}");
    Ok(())
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn a_lock_up_keeps_momenta_and_obeys_carnot(bodies in 1_usize..=12, seed: u64) {
        let moment = moment(bodies, seed, 0.2);
        let hinges = choose(&moment, seed);
        prop_assume!(!hinges.is_empty());
        let (after, found) = locked(&moment, &hinges);
        let (old, new) = (sums(&moment), sums(&after));
        momenta_are_kept(&old, &new)?;
        for &i in &hinges {
            prop_assert!(after.tau[i].abs() < KEPT * (1.0 + moment.tau[i].abs()) * 10.0);
        }

        // Carnot: the energy lost is the kinetic energy of the lost velocities.
        let (omega, velocity) = (found.delta_omega_body, found.delta_velocity_body);
        let tau: Vec<f64> = after.tau.iter().zip(&moment.tau).map(|(a, b)| a - b).collect();
        let beta = moment.beta.clone();
        let (scene, mode) = (moment.scene.clone(), moment.mode.clone());
        let lost = sums(&Moment { scene, mode, beta, tau, omega, velocity_body: velocity });
        let energy = old.kinetic_energy + new.kinetic_energy;
        let change = new.kinetic_energy - old.kinetic_energy;
        prop_assert!((change + lost.kinetic_energy).abs() < KEPT * energy);
        prop_assert!((change - found.delta_energy).abs() < KEPT * energy);
        prop_assert!(found.delta_energy <= 0.0);
        // ... and half the work of the impulses at the rates before.
        let work: f64 = hinges.iter().zip(&found.torques).map(|(&i, p)| p * moment.tau[i]).sum();
        prop_assert!((0.5 * work - found.delta_energy).abs() < KEPT * energy);
    }

    /// ... and hinges that rebound, each at its own share of its rate and after others have locked, lose what their
    /// impulses do at the mean of the rates before and after. Where each impulse turns its hinge back, that is no gain.
    #[test]
    fn rebounds_keep_momenta_and_give_energy_back(bodies in 1_usize..=12, seed: u64) {
        let start = moment(bodies, seed, 0.2);
        let chosen = choose(&start, seed);
        let dice = &mut Rng::new(seed ^ 0xe);
        let (locking, hinges): (Vec<_>, Vec<_>) = chosen.into_iter().partition(|_| dice.chance(0.3));
        prop_assume!(!hinges.is_empty());
        let shares: Vec<f64> = hinges.iter().map(|_| dice.between(0.0, 1.0)).collect();
        let (mut before, _) = locked(&start, &locking);
        // Exactly at rest relative to each other, as the simulator makes them.
        locking.iter().for_each(|&i| before.tau[i] = 0.0);
        let (after, found) = rebounded(&before, &hinges, &shares);
        let (first, old, new) = (sums(&start), sums(&before), sums(&after));
        momenta_are_kept(&first, &new)?;
        let of_hinges = || hinges.iter().zip(&shares).zip(&found.torques);
        for ((&i, share), _) in of_hinges() {
            let off = after.tau[i] + share * before.tau[i];
            prop_assert!(off.abs() < KEPT * (1.0 + before.tau[i].abs()) * 10.0);
        }
        let energy = old.kinetic_energy + new.kinetic_energy;
        let change = new.kinetic_energy - old.kinetic_energy;
        prop_assert!((change - found.delta_energy).abs() < KEPT * energy);
        let work: f64 = of_hinges().map(|((&i, e), p)| 0.5 * (1.0 - e) * p * before.tau[i]).sum();
        prop_assert!((found.delta_energy - work).abs() < KEPT * energy);
        let all_turn_back = of_hinges().all(|((&i, _), p)| p * before.tau[i] <= 0.0);
        prop_assert!(!all_turn_back || found.delta_energy <= KEPT * energy);
        // Alike they keep the square of their share of what lock-ups would take.
        let alike = rebounded(&before, &hinges, &vec![shares[0]; hinges.len()]).1.delta_energy;
        let locks = locked(&before, &hinges).1.delta_energy;
        let lost = (1.0 - shares[0] * shares[0]) * locks;
        prop_assert!((alike - lost).abs() < KEPT * energy);
    }

    /// Joint locking = one hinge after another with the earlier ones kept, in any order.
    #[test]
    fn the_order_of_locking_does_not_matter(bodies in 2_usize..=12, seed: u64) {
        let start = moment(bodies, seed, 0.2);
        let hinges = choose(&start, seed);
        prop_assume!(!hinges.is_empty());
        let (jointly, _) = locked(&start, &hinges);
        let mut backwards = hinges.clone();
        backwards.reverse();
        for order in [hinges, backwards] {
            let mut one_by_one = moment(bodies, seed, 0.2);
            for hinge in order {
                one_by_one = locked(&one_by_one, &[hinge]).0;
                // Exactly at rest relative to each other, as the simulator makes them.
                one_by_one.tau[hinge] = 0.0;
            }
            let scale = 1.0 + start.tau.iter().fold(0.0_f64, |m, t| m.max(t.abs()));
            prop_assert!((jointly.omega - one_by_one.omega).norm() < 1e-12 * scale);
            prop_assert!((jointly.velocity_body - one_by_one.velocity_body).norm() < 1e-12 * scale);
            for (a, b) in jointly.tau.iter().zip(&one_by_one.tau) {
                prop_assert!((a - b).abs() < 1e-12 * scale, "{a} {b}");
            }
        }
    }

    /// The impulse is an impulse: the same jump comes of integrating a huge hinge torque over a
    /// tiny time, for which B₀ Δq = E Λ is solved densely.
    #[test]
    fn the_velocity_jump_is_that_of_the_impulsive_torques(bodies in 1_usize..=12, seed: u64) {
        let moment = moment(bodies, seed, 0.2);
        let hinges = choose(&moment, seed);
        prop_assume!(!hinges.is_empty());
        let (_, found) = locked(&moment, &hinges);
        let mut prepared = Prepared::new(&moment);
        let matrix = prepared.mass_matrix();
        let mut jump = found.delta_velocity_body.to_array().to_vec();
        jump.extend(found.delta_omega_body.to_array());
        jump.extend(&found.delta_tau);
        let jump = nalgebra::DVector::from_vec(jump);
        let momentum = &matrix * &jump;
        let mut impulses = nalgebra::DVector::zeros(momentum.len());
        let free = prepared.dynamics.free_hinges();
        for (hinge, impulse) in hinges.iter().zip(&found.torques) {
            let j = free.iter().position(|i| i == hinge).expect("it was free");
            impulses[6 + j] = *impulse;
        }
        let size = (matrix.abs() * jump.abs()).amax();
        prop_assert!((momentum - impulses).amax() < KEPT * size);
    }
}

#[test]
fn locking_a_hinge_at_rest_changes_nothing() {
    let mut still = moment(4, 7, 0.0);
    still.tau[2] = 0.0;
    let (after, found) = locked(&still, &[2]);
    assert_eq!(found.torques, [0.0]);
    assert_eq!(found.delta_energy, 0.0);
    assert_eq!(found.delta_omega_body, Vec3::zero());
    assert_eq!(after.tau, still.tau);
    let motion_is_kept = Motion { omega_body: after.omega, beta: &after.beta, tau: &after.tau };
    assert_eq!(motion_is_kept.omega_body, still.omega);
}
