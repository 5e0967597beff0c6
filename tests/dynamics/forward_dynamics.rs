//! 150 random states of six topologies, computed independently three times to about 1e-14.

use nalgebra::{DMatrix, DVector};
use nboom::dynamics::{Accelerations, Impulses, Motion, Recursive, Struck};
use nboom::model::{HingeState, Mode, Scene};
use nboom::scalar::{Quaternion, Vec3};
use serde_json::Value;

use crate::random_scene::spring;
use crate::support::json_scene::{bodies, vector};
use crate::support::{data, number, numbers, relative_error};

pub struct Case {
    pub scene: Scene,
    pub mode: Mode,
    pub attitude: Quaternion<f64>,
    pub beta: Vec<f64>,
    pub tau: Vec<f64>,
    pub omega: Vec3<f64>,
    pub velocity_body: Vec3<f64>,
    pub expected: Value,
}

pub fn cases() -> Vec<Case> {
    let file = data("forward_dynamics_cases.json");
    file["cases"].as_array().expect("cases").iter().map(case).collect()
}

fn case(value: &Value) -> Case {
    let mut description = bodies(value, 1.0);
    let state = &value["state"];
    let (beta, tau) = (numbers(&state["beta"]), numbers(&state["tau"]));
    let free = value["hinge_free"].as_array().expect("flags");
    for (i, body) in description.bodies.iter_mut().enumerate() {
        body.hinge.start.state =
            if free[i] == true { HingeState::Free } else { HingeState::Locked };
    }
    let scene = Scene::new(description).expect("reference cases are valid");
    let mut mode = Mode::at_start(&scene);
    mode.externals.fill(usize::from(value["thrust_on"] == true));
    let lengths = numbers(&value["expected"]["kick_extension"]);
    for (i, body) in scene.bodies.iter().enumerate() {
        if let Some(kick_off) = body.hinge.kick_off {
            mode.pieces[spring(&scene.bodies, i)] = usize::from(lengths[i] > kick_off.limit_length);
        }
    }
    let q = numbers(&state["quat_wxyz"]);
    let attitude = Quaternion { scalar: q[0], vector: Vec3::new(q[1], q[2], q[3]) };
    let (omega, velocity_body) = (vector(&state["omega"]), vector(&state["vO_body"]));
    let expected = value["expected"].clone();
    Case { scene, mode, attitude, beta, tau, omega, velocity_body, expected }
}

impl Case {
    pub fn dynamics(&self) -> Recursive<f64> {
        let mut dynamics = Recursive::new(&self.scene);
        dynamics.set_mode(&self.mode, &self.beta);
        dynamics
    }

    pub fn of_free(&self, dynamics: &Recursive<f64>, all: &[f64]) -> Vec<f64> {
        dynamics.free_hinges().iter().map(|&i| all[i]).collect()
    }
}

/// Ratio of the largest to the smallest eigenvalue after each row and column has been scaled
/// to a unit diagonal, which takes the units out.
pub fn condition(mass_matrix: &DMatrix<f64>) -> f64 {
    let scaled = DMatrix::from_fn(mass_matrix.nrows(), mass_matrix.ncols(), |i, j| {
        mass_matrix[(i, j)] / (mass_matrix[(i, i)] * mass_matrix[(j, j)]).sqrt()
    });
    let values = scaled.symmetric_eigenvalues();
    values.max() / values.min()
}

#[test]
fn mass_matrix_of_all_hinges() {
    for (id, case) in cases().iter().enumerate() {
        let mut dynamics = Recursive::new(&case.scene);
        let all_free =
            Mode { hinges: vec![HingeState::Free; case.beta.len()], ..case.mode.clone() };
        dynamics.set_mode(&all_free, &case.beta);
        let size = case.scene.degrees_of_freedom();
        let mut matrix = vec![0.0; size * size];
        dynamics.mass_matrix(&case.beta, &mut matrix);
        let error = relative_error(&matrix, &numbers(&case.expected["mass_matrix"]), 0.0);
        assert!(error < 1e-13, "case {id}: {error:e}");
    }
}

#[test]
fn accelerations() {
    let mut worst = 0.0_f64;
    for (id, case) in cases().iter().enumerate() {
        let mut dynamics = case.dynamics();
        let (beta, tau) = (case.of_free(&dynamics, &case.beta), case.of_free(&dynamics, &case.tau));
        let motion = Motion { omega_body: case.omega, beta: &beta, tau: &tau };
        let mut found = Accelerations::for_hinges(beta.len());
        dynamics.accelerations(&motion, &mut found);

        let gravity = case.scene.gravity.map_or(Vec3::zero(), |g| {
            case.attitude.normalized().to_matrix().transpose_mul(g.up) * g.acceleration
        });
        let component_rate = found.origin_body - gravity - case.omega.cross(case.velocity_body);
        let mut all_rates = component_rate.to_array().to_vec();
        all_rates.extend(found.omega_dot_body.to_array());
        let mut tau_dot = vec![0.0; case.beta.len()];
        for (&i, rate) in dynamics.free_hinges().iter().zip(&found.tau_dot) {
            tau_dot[i] = *rate;
        }
        all_rates.extend(&tau_dot);
        let expected: Vec<f64> = ["vO_body_rate", "omega_dot", "beta_ddot"]
            .iter()
            .flat_map(|key| numbers(&case.expected[key]))
            .collect();
        let size = 6 + beta.len();
        let mut matrix = vec![0.0; size * size];
        dynamics.mass_matrix(&beta, &mut matrix);
        let condition = condition(&DMatrix::from_row_slice(size, size, &matrix));
        let error = relative_error(&all_rates, &expected, 0.0);
        worst = worst.max(error);
        // 1e-11 as such holds for every case; beyond a condition of 1e4 rounding in the data
        // themselves (1e-16 of each entry) could exceed it.
        let allowed = 1e-11 * (condition / 1e4).max(1.0);
        assert!(error < allowed, "case {id}: {error:e}, condition {condition:e}");
    }
    assert!(worst > 0.0, "equality to the last digit means that nothing was computed");
}

#[test]
fn articulated_bodies_solve_the_composite_body_equation() {
    for (id, case) in cases().iter().enumerate() {
        let mut dynamics = case.dynamics();
        let (beta, tau) = (case.of_free(&dynamics, &case.beta), case.of_free(&dynamics, &case.tau));
        let motion = Motion { omega_body: case.omega, beta: &beta, tau: &tau };
        let size = 6 + beta.len();
        let (mut matrix, mut forcing) = (vec![0.0; size * size], vec![0.0; size]);
        dynamics.mass_matrix(&beta, &mut matrix);
        dynamics.forcing(&motion, &mut forcing);
        let solved = DMatrix::from_row_slice(size, size, &matrix)
            .cholesky()
            .expect("the kinetic energy is positive")
            .solve(&DVector::from_vec(forcing));
        let mut found = Accelerations::for_hinges(beta.len());
        dynamics.accelerations(&motion, &mut found);
        let mut direct = found.origin_body.to_array().to_vec();
        direct.extend(found.omega_dot_body.to_array());
        direct.extend(&found.tau_dot);
        let error = relative_error(&direct, solved.as_slice(), 0.0);
        assert!(error < 1e-11, "case {id}: {error:e}");
    }
}

#[test]
fn energy_momenta_and_mass_center() {
    for (id, case) in cases().iter().enumerate() {
        let mut dynamics = case.dynamics();
        let (beta, tau) = (case.of_free(&dynamics, &case.beta), case.of_free(&dynamics, &case.tau));
        let motion = Motion { omega_body: case.omega, beta: &beta, tau: &tau };
        // The velocity of the mass centre that belongs to the given velocity of O.
        let shift = dynamics.invariants(&motion, Vec3::zero()).origin_velocity;
        let found = dynamics.invariants(&motion, case.velocity_body - shift);
        let to_inertial = case.attitude.normalized().to_matrix();
        let expected = &case.expected;
        let energy = number(expected, "kinetic_energy");
        assert!((found.kinetic_energy - energy).abs() < 1e-13 * energy, "case {id}");
        for (vector, key) in [
            (found.mass_center, "S_body"),
            (to_inertial * found.linear_momentum, "linear_momentum_inertial"),
            (to_inertial * found.angular_momentum, "Hc_inertial"),
        ] {
            let error = relative_error(&vector.to_array(), &numbers(&expected[key]), 0.0);
            assert!(error < 1e-12, "case {id}, {key}: {error:e}");
        }
    }
}

#[test]
fn the_rate_that_the_angular_momentum_of_the_references_gives() {
    for (id, case) in cases().iter().enumerate() {
        let mut dynamics = case.dynamics();
        let (beta, tau) = (case.of_free(&dynamics, &case.beta), case.of_free(&dynamics, &case.tau));
        let [x, y, z] = numbers(&case.expected["Hc_inertial"])[..] else { panic!("a vector") };
        let to_inertial = case.attitude.normalized().to_matrix();
        let momentum_body = to_inertial.transpose_mul(Vec3::new(x, y, z));
        let found = dynamics.angular_rate(momentum_body, &beta, &tau);
        // What hinges add may cancel most of it.
        let allowed = 1e-12 * (case.omega.norm() + tau.iter().map(|tau| tau.abs()).sum::<f64>());
        assert!((found - case.omega).norm() < allowed, "case {id}: {found:?} {:?}", case.omega);
    }
}

#[test]
fn lock_up_of_the_first_free_hinge() {
    for (id, case) in cases().iter().enumerate() {
        let expected = &case.expected["lock_first_free_hinge"];
        if expected.is_null() {
            continue;
        }
        let mut dynamics = case.dynamics();
        let (beta, tau) = (case.of_free(&dynamics, &case.beta), case.of_free(&dynamics, &case.tau));
        let locking = expected["segment"].as_u64().expect("a hinge") as usize;
        let position =
            dynamics.free_hinges().iter().position(|&i| i == locking).expect("it is free");
        let mut found = Impulses::of_none();
        dynamics
            .strike(&beta, &tau, &[Struck::locks(position)], &mut found)
            .expect("a regular matrix");
        let mut delta_tau = vec![0.0; case.beta.len()];
        for (&i, change) in dynamics.free_hinges().iter().zip(&found.delta_tau) {
            delta_tau[i] = *change;
        }
        let scale = tau[position].abs();
        for (values, key) in [
            (found.delta_velocity_body.to_array().to_vec(), "delta_vO_body"),
            (found.delta_omega_body.to_array().to_vec(), "delta_omega"),
            (delta_tau, "delta_tau"),
        ] {
            let error = relative_error(&values, &numbers(&expected[key]), scale);
            assert!(error < 1e-12, "case {id}, {key}: {error:e}");
        }
        let impulse = number(expected, "impulse");
        assert!((found.torques[0] - impulse).abs() < 1e-12 * impulse.abs(), "case {id}");
    }
}
