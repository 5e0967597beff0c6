//! Single evaluations: mass matrix, forcing and accelerations.

use nalgebra::{DMatrix, DVector};
use nboom::model::{HingeState, Mode};
use nboom::scalar::Vec3;
use proptest::prelude::*;

use super::newton_euler::{self, vector};
use super::random_scene::{Moment, moment};
use super::rates::rates;
use super::{Prepared, cases, condition, relative};

/// Rounding of a sum of a few dozen products, each of a few roundings.
const ROUNDING: f64 = 1e-14;

/// Rounding of both sides of a comparison of accelerations at a condition of one. The factor
/// 1e-15 stands for a few roundings in each entry of the mass matrix, which the solution
/// magnifies by up to the condition; the floor is that of a well-conditioned tree.
fn allowed(condition: f64) -> f64 {
    1e-13 + 1e-15 * condition
}

fn place(moment: &Moment) -> Vec<newton_euler::Placed> {
    let (omega, velocity) = (vector(moment.omega), vector(moment.velocity_body));
    newton_euler::place(&moment.scene, &moment.beta, &moment.tau, omega, velocity)
}

proptest! {
    #![proptest_config(cases(1000))]

    /// T = ½ qᵀ B₀ q: against `Invariants` and against the sum over bodies.
    #[test]
    fn the_mass_matrix_is_that_of_the_kinetic_energy(bodies in 1_usize..=12, seed: u64) {
        let moment = moment(bodies, seed, 0.3);
        let mut prepared = Prepared::new(&moment);
        let matrix = prepared.mass_matrix();
        prop_assert_eq!(&matrix, &matrix.transpose());
        prop_assert!(matrix.clone().cholesky().is_some());
        let q = prepared.velocities(&moment);
        let energy = 0.5 * q.dot(&(&matrix * &q));

        let (beta, tau) = (&prepared.beta, &prepared.tau);
        let motion = nboom::dynamics::Motion { omega_body: moment.omega, beta, tau };
        let at_rest = prepared.dynamics.invariants(&motion, Vec3::zero()).origin_velocity;
        let found = prepared.dynamics.invariants(&motion, moment.velocity_body - at_rest);
        let sums = newton_euler::sums(&place(&moment));
        // The quadratic form takes the difference of large numbers where bodies move less than
        // O does; their size is that of the form with all signs alike.
        let size = 0.5 * q.abs().dot(&(matrix.abs() * q.abs()));
        prop_assert!((energy - sums.kinetic_energy).abs() < ROUNDING * size);
        prop_assert!((found.kinetic_energy - sums.kinetic_energy).abs() < ROUNDING * size);
        let momentum = &matrix * &q;
        let linear = (vector(found.linear_momentum) - sums.linear).norm();
        prop_assert!(linear < ROUNDING * sums.linear_scale);
        let of_matrix = (momentum.fixed_rows::<3>(0) - sums.linear).norm();
        prop_assert!(of_matrix < ROUNDING * (matrix.abs() * q.abs()).rows(0, 3).amax() * 3.0);
        let angular = (vector(found.angular_momentum) - sums.angular).norm();
        prop_assert!(angular < 10.0 * ROUNDING * sums.angular_scale);
        let center = (vector(found.mass_center) - sums.center).norm();
        prop_assert!(center < ROUNDING * (1.0 + sums.center.norm()));
    }

    /// Articulated bodies against composite bodies: B₀ (a_O, ω̇, τ̇) = u₀.
    #[test]
    fn accelerations_satisfy_the_equation_of_motion(bodies in 1_usize..=12, seed: u64) {
        let moment = moment(bodies, seed, 0.3);
        let mut prepared = Prepared::new(&moment);
        let (matrix, forcing) = (prepared.mass_matrix(), prepared.forcing(&moment));
        let found = prepared.accelerations(&moment);
        // Backward error: free of the condition for a stable elimination.
        let size = (matrix.abs() * found.abs()).amax();
        let residual = (&matrix * &found - &forcing).amax();
        prop_assert!(residual < 1e-13 * size, "{:e}", residual / size);
        let solved = matrix.clone().cholesky().expect("positive definite").solve(&forcing);
        let (error, kappa) = (relative(&found, &solved), condition(&matrix));
        prop_assert!(error < allowed(kappa), "{error:e}, condition {kappa:e}");
    }

    /// Held hinges are merged; here their rows and columns are struck from the full equation.
    #[test]
    fn held_hinges_are_struck_from_the_full_equation(bodies in 1_usize..=12, seed: u64) {
        let moment = moment(bodies, seed, 0.5);
        let mut merged = Prepared::new(&moment);
        let all_free = Mode { hinges: vec![HingeState::Free; bodies], ..moment.mode.clone() };
        let full_moment = Moment { mode: all_free, ..moment };
        let mut full = Prepared::new(&full_moment);
        let kept: Vec<usize> =
            (0..6).chain(merged.dynamics.free_hinges().iter().map(|i| 6 + i)).collect();
        let matrix = full.mass_matrix().select_rows(&kept).select_columns(&kept);
        let forcing = full.forcing(&full_moment).select_rows(&kept);
        let size = matrix.amax();
        let of_merged = merged.mass_matrix();
        prop_assert!((&of_merged - &matrix).amax() < 1e-13 * size);
        let solved = matrix.clone().cholesky().expect("positive definite").solve(&forcing);
        let found = merged.accelerations(&full_moment);
        let (error, kappa) = (relative(&found, &solved), condition(&matrix));
        prop_assert!(error < allowed(kappa), "{error:e}, condition {kappa:e}");
    }
}

/// The accelerations that the maximal-coordinate equations give, and their balance.
fn reference(moment: &Moment) -> (DVector<f64>, newton_euler::Accelerated) {
    let placed = place(moment);
    let (scene, mode) = (&*moment.scene, &moment.mode);
    let loads = newton_euler::loads(scene, mode, &placed, &moment.beta, &moment.tau);
    let found = newton_euler::accelerations(scene, mode, &placed, &moment.tau, &loads);
    let mut all: Vec<f64> = found.origin.iter().chain(&found.omega_dots[0]).copied().collect();
    all.extend((0..mode.hinges.len()).filter(|&i| mode.is_free(i)).map(|i| found.tau_dots[i]));
    (DVector::from_vec(all), found)
}

proptest! {
    #![proptest_config(cases(300))]

    /// The independent derivation: Newton and Euler for every body, hinges as constraints.
    #[test]
    fn accelerations_are_those_of_newton_and_euler(bodies in 1_usize..=12, seed: u64) {
        let moment = moment(bodies, seed, 0.25);
        let mut prepared = Prepared::new(&moment);
        let found = prepared.accelerations(&moment);
        let (expected, _) = reference(&moment);
        let (error, kappa) = (relative(&found, &expected), condition(&prepared.mass_matrix()));
        // 1e-11 holds as such up to a condition of 1e4, where the dense system of up to 150
        // unknowns itself has lost five digits of sixteen.
        let allowed = 1e-11 * (kappa / 1e4).max(1.0);
        prop_assert!(error < allowed, "{error:e}, condition {kappa:e}");
    }

    /// Rate of kinetic energy = power of all forces, rates of momenta = outside force and
    /// moment, from the product's accelerations spread over the bodies by the test.
    #[test]
    fn power_and_momentum_balance(bodies in 1_usize..=12, seed: u64) {
        let moment = moment(bodies, seed, 0.25);
        let mut prepared = Prepared::new(&moment);
        let accelerations = prepared.accelerations(&moment);
        let kappa = condition(&prepared.mass_matrix());
        let placed = place(&moment);
        let (scene, mode) = (&*moment.scene, &moment.mode);
        let loads = newton_euler::loads(scene, mode, &placed, &moment.beta, &moment.tau);
        let free = prepared.dynamics.free_hinges().to_vec();
        let mut tau_dot = vec![0.0; bodies];
        free.iter().enumerate().for_each(|(j, &i)| tau_dot[i] = accelerations[6 + j]);
        let rates = rates(scene, &placed, &moment.tau, &accelerations, &tau_dot);
        let allowed = 10.0 * allowed(kappa);
        let power = (rates.kinetic_energy - loads.power).abs() / rates.energy_scale;
        prop_assert!(power < allowed, "power {power:e}, condition {kappa:e}");
        let linear = (rates.linear - loads.outside.0).norm() / rates.linear_scale;
        prop_assert!(linear < allowed, "force {linear:e}, condition {kappa:e}");
        let angular = (rates.angular - loads.outside.1).norm() / rates.angular_scale;
        prop_assert!(angular < allowed, "moment {angular:e}, condition {kappa:e}");
    }
}

#[test]
fn the_condition_of_a_diagonal_matrix_is_one() {
    let matrix = DMatrix::from_diagonal(&DVector::from_vec(vec![1e-3, 1.0, 1e6]));
    assert!((condition(&matrix) - 1.0).abs() < 1e-15);
}
