//! What holds for every tree, state and mode, over random ones: the equations of motion against
//! an independent derivation in maximal coordinates, energy and momentum balances, lock-up
//! impulses, loads of hinges and sections, and conservation over whole runs.
//!
//! The random numbers are the same in every run; a failure names the number of bodies and the
//! seed of the smallest scene found.

#[path = "../support/collect.rs"]
mod collect;
#[path = "../physics/log.rs"]
mod log;
mod newton_euler;
#[path = "../support/random_scene.rs"]
mod random_scene;

mod bodies;
mod evaluations;
mod loads;
mod lock_up_loads;
mod lock_ups;
mod rates;
mod runs;

use nalgebra::{DMatrix, DVector};
use nboom::dynamics::{Accelerations, Motion, Recursive};
use proptest::test_runner::{Config, RngSeed};

use random_scene::Moment;

/// Random cases from a fixed seed, nothing written to disk.
fn cases(count: u32) -> Config {
    Config {
        cases: count,
        rng_seed: RngSeed::Fixed(1970),
        failure_persistence: None,
        ..Config::default()
    }
}

/// The recursive formulation in the moment's mode, with the free hinges' angles and rates.
struct Prepared {
    dynamics: Recursive<f64>,
    beta: Vec<f64>,
    tau: Vec<f64>,
}

impl Prepared {
    fn new(moment: &Moment) -> Self {
        let mut dynamics = Recursive::new(&moment.scene);
        dynamics.set_mode(&moment.mode, &moment.beta);
        dynamics.set_outside(moment.scene.initial.attitude, moment.scene.initial.time);
        let free = dynamics.free_hinges();
        let beta = free.iter().map(|&i| moment.beta[i]).collect();
        let tau = free.iter().map(|&i| moment.tau[i]).collect();
        Self { dynamics, beta, tau }
    }

    fn mass_matrix(&mut self) -> DMatrix<f64> {
        let size = 6 + self.beta.len();
        let mut entries = vec![0.0; size * size];
        self.dynamics.mass_matrix(&self.beta, &mut entries);
        DMatrix::from_row_slice(size, size, &entries)
    }

    fn forcing(&mut self, moment: &Moment) -> DVector<f64> {
        let motion = Motion { omega_body: moment.omega, beta: &self.beta, tau: &self.tau };
        let mut entries = vec![0.0; 6 + self.beta.len()];
        self.dynamics.forcing(&motion, &mut entries);
        DVector::from_vec(entries)
    }

    /// (a_O, ω̇, τ̇) of the free hinges.
    fn accelerations(&mut self, moment: &Moment) -> DVector<f64> {
        let motion = Motion { omega_body: moment.omega, beta: &self.beta, tau: &self.tau };
        let mut found = Accelerations::for_hinges(self.beta.len());
        self.dynamics.accelerations(&motion, &mut found);
        let mut all = found.origin_body.to_array().to_vec();
        all.extend(found.omega_dot_body.to_array());
        all.extend(found.tau_dot);
        DVector::from_vec(all)
    }

    /// (V, ω, τ) of the free hinges.
    fn velocities(&self, moment: &Moment) -> DVector<f64> {
        let mut all = moment.velocity_body.to_array().to_vec();
        all.extend(moment.omega.to_array());
        all.extend(&self.tau);
        DVector::from_vec(all)
    }
}

/// Ratio of the largest to the smallest eigenvalue with the diagonal scaled to one.
fn condition(matrix: &DMatrix<f64>) -> f64 {
    let scaled = DMatrix::from_fn(matrix.nrows(), matrix.ncols(), |i, j| {
        matrix[(i, j)] / (matrix[(i, i)] * matrix[(j, j)]).sqrt()
    });
    let values = scaled.symmetric_eigenvalues();
    values.max() / values.min()
}

/// Largest absolute difference over the largest magnitude.
fn relative(found: &DVector<f64>, expected: &DVector<f64>) -> f64 {
    (found - expected).amax() / expected.amax()
}
