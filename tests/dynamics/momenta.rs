//! Momenta about the mass centre: mass matrix times velocities, and rates that are their derivatives.

use nalgebra::{DMatrix, DVector};
use nboom::dynamics::{Accelerations, Momenta, Motion, Recursive};
use nboom::scalar::{Dual, Quaternion, Real, Vec3};

use crate::random_scene::{Moment, moment};
use crate::support::relative_error;

/// Sums over up to eight bodies, and a solution with a condition of up to about a hundred.
const ROUNDING: f64 = 1e-12;

/// Random trees, a quarter of whose hinges are held, most of them under forces and torques from outside.
fn moments() -> impl Iterator<Item = Moment> {
    (0..400).map(|seed| moment(1 + seed as usize % 8, seed, 0.25))
}

fn dynamics<R: Real>(moment: &Moment) -> Recursive<R> {
    let beta: Vec<R> = moment.beta.iter().map(|&angle| R::constant(angle)).collect();
    let mut dynamics = Recursive::new(&moment.scene);
    dynamics.set_mode(&moment.mode, &beta);
    let Quaternion { scalar, vector } = moment.scene.initial.attitude;
    let attitude = Quaternion { scalar: R::constant(scalar), vector: Vec3::constant(vector) };
    dynamics.set_outside(attitude, R::zero());
    dynamics
}

fn of_free(all: &[f64], dynamics: &Recursive<f64>) -> Vec<f64> {
    dynamics.free_hinges().iter().map(|&i| all[i]).collect()
}

#[test]
fn momenta_are_the_mass_matrix_times_the_velocities_and_back() {
    for moment in moments() {
        let mut dynamics = dynamics::<f64>(&moment);
        let (beta, tau) = (of_free(&moment.beta, &dynamics), of_free(&moment.tau, &dynamics));
        let motion = Motion { omega_body: moment.omega, beta: &beta, tau: &tau };
        let mut hinges = vec![0.0; tau.len()];
        let angular_body = dynamics.momenta(&motion, &mut hinges);
        let v = dynamics.invariants(&motion, Vec3::zero()).origin_velocity;
        let velocities = [&v.to_array(), &moment.omega.to_array(), &tau[..]].concat();
        let size = velocities.len();
        let mut matrix = vec![0.0; size * size];
        dynamics.mass_matrix(&beta, &mut matrix);
        let expected = DMatrix::from_row_slice(size, size, &matrix) * DVector::from_vec(velocities);
        let found = [&[0.0; 3], &angular_body.to_array(), &hinges[..]].concat();
        let error = relative_error(&found, expected.as_slice(), 1.0);
        assert!(error < ROUNDING, "{error:e}");

        let momenta = Momenta { angular_body, beta: &beta, hinges: &hinges };
        let mut back = vec![0.0; tau.len()];
        let omega = dynamics.velocities(&momenta, &mut back);
        back.extend(omega.to_array());
        let expected = [&tau[..], &moment.omega.to_array()].concat();
        let error = relative_error(&back, &expected, 1.0);
        assert!(error < ROUNDING, "{error:e}");
    }
}

/// H̄_c along main-body axes and π, differentiated along the motion that the accelerations make.
fn along_the_motion(moment: &Moment, beta: &[f64], tau: &[f64]) -> (Vec3<f64>, Vec<f64>) {
    let mut found = Accelerations::for_hinges(tau.len());
    let motion = Motion { omega_body: moment.omega, beta, tau };
    dynamics::<f64>(moment).accelerations(&motion, &mut found);
    let in_time = |values: &[f64], rates: &[f64]| -> Vec<Dual<f64>> {
        let pairs = values.iter().zip(rates);
        pairs.map(|(&value, &derivative)| Dual { value, derivative }).collect()
    };
    let omega = in_time(&moment.omega.to_array(), &found.omega_dot_body.to_array());
    let omega_body = Vec3::new(omega[0], omega[1], omega[2]);
    let (beta, tau) = (in_time(beta, tau), in_time(tau, &found.tau_dot));
    let mut hinges = vec![Dual::zero(); tau.len()];
    let motion = Motion { omega_body, beta: &beta, tau: &tau };
    let angular = dynamics::<Dual<f64>>(moment).momenta(&motion, &mut hinges);
    (angular.map(|h| h.derivative), hinges.iter().map(|pi| pi.derivative).collect())
}

#[test]
fn rates_of_the_momenta_are_their_derivatives_along_the_motion() {
    let mut pushed = 0;
    for moment in moments() {
        let mut dynamics = dynamics::<f64>(&moment);
        let (beta, tau) = (of_free(&moment.beta, &dynamics), of_free(&moment.tau, &dynamics));
        let motion = Motion { omega_body: moment.omega, beta: &beta, tau: &tau };
        let mut hinges = vec![0.0; tau.len()];
        let angular_body = dynamics.momenta(&motion, &mut hinges);
        let found = dynamics.invariants(&motion, Vec3::zero());
        let outside = dynamics.outside(&motion, &found);
        let momenta = Momenta { angular_body, beta: &beta, hinges: &hinges };
        let (mut back, mut rates) = (tau.clone(), tau.clone());
        dynamics.momentum_rates(&momenta, &mut back, &mut rates);
        pushed += usize::from(dynamics.elements().on_links().next().is_some());
        let (angular_rate, expected) = along_the_motion(&moment, &beta, &tau);
        // Ḣ_c along inertial axes is the moment from outside about the mass centre.
        let inertial = angular_rate + moment.omega.cross(angular_body) - outside.moment;
        let largest = expected.iter().fold(angular_body.norm(), |most, rate| most.max(rate.abs()));
        assert!(inertial.norm() < ROUNDING * largest.max(1.0), "{:e}", inertial.norm());
        for (rate, expected) in rates.iter().zip(&expected) {
            let apart = (rate - expected).abs();
            assert!(apart < ROUNDING * largest.max(1.0), "{apart:e} of {largest:e}");
        }
    }
    assert!(pushed > 100, "{pushed}");
}
