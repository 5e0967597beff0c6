//! Generated code of a public robot against Pinocchio 4.1.0: inverse dynamics, mass matrix and bias. Its equations, and
//! those of others, are compared in `tests/dynamics/robots.rs`.

use std::path::PathBuf;

use nboom::dynamics::Recursive;
use nboom::formulation::{Coordinates, HingeCoordinates, Layout, Motion, Recognised, recognise};
use nboom::io::read_scene;
use nboom::scalar::{Kernel, Routine, Twist, Vec3, Wrench};
use serde_json::Value;

nboom::routine! { ArmInverse: Trrpprr, inverse_dynamics }
nboom::routine! { ArmMatrix: Trrpprr, equations, formulation = symmetric }

/// Both codes compute in `f64`, on matrices of condition up to 1e4.
const TOLERANCE: f64 = 1e-11;

/// A robot in a state, with what Pinocchio says about it; rows are ω̇, a_O, hinges.
struct Robot {
    recognised: Recognised,
    coordinates: Coordinates<f64>,
    expected: Value,
    /// For each hinge in the topology's order, which it is in the data.
    order: Vec<usize>,
}

fn data(name: &str) -> Value {
    let text = std::fs::read_to_string(path(name)).expect("the data file is in the clone");
    serde_json::from_str(&text).expect("the data file is JSON")
}

fn path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/robots").join(name)
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|n| n.as_f64().expect("a number")).collect()
}

fn vector(value: &Value) -> Vec3<f64> {
    let [x, y, z] = numbers(value).try_into().expect("three numbers");
    Vec3::new(x, y, z)
}

impl Robot {
    fn new(name: &str) -> Self {
        let scene = read_scene(&path(&format!("{name}.urdf"))).expect("a robot").scene;
        let expected = data("dynamics.json")[name].clone();
        let robot = &data("accelerations.json")[name];
        let state = &robot["states"][expected["state"].as_u64().expect("a number") as usize];
        let recognised = recognise(Recursive::<f64>::new(&scene).tree()).expect("rigid bodies");
        let names = robot["hinges"].as_array().expect("links");
        let at = |link: &usize| {
            let name = scene.name_of(*link);
            names.iter().position(|other| other.as_str() == name).expect("a hinge of each")
        };
        let order: Vec<usize> = recognised.links.iter().map(at).collect();
        let [angles, rates, torques] = ["angles", "rates", "torques"].map(|k| numbers(&state[k]));
        let hinge =
            |&i: &usize| HingeCoordinates { beta: angles[i], tau: rates[i], torque: torques[i] };
        let hinges = order.iter().map(hinge).collect();
        let coordinates =
            Coordinates { omega: vector(&state["omega"]), external: Wrench::zero(), hinges };
        Self { recognised, coordinates, expected, order }
    }

    fn constants<T: Routine>(&self) -> Vec<f64> {
        let Recognised { topology, parameters, .. } = &self.recognised;
        assert_eq!(topology.to_string(), T::TOPOLOGY);
        let kernel = Kernel::of::<T>();
        let mut constants = vec![0.0; T::CONSTANTS];
        kernel.prepare(&parameters.write(), &mut constants);
        constants
    }

    fn evaluate<T: Routine>(&self, coordinates: &[f64]) -> Vec<f64> {
        let mut found = vec![0.0; T::OUTPUTS];
        Kernel::of::<T>().evaluate(&self.constants::<T>(), coordinates, &mut found);
        found
    }

    /// For each place among accelerations, its row in the data.
    fn rows(&self) -> Vec<usize> {
        let mut rows: Vec<usize> = (0..6 + self.order.len()).collect();
        for (i, place) in self.order.iter().zip(Layout::places(&self.recognised.topology)) {
            rows[6 + place] = 6 + i;
        }
        rows
    }

    /// The forces for other accelerations.
    fn is_driven<T: Routine>(&self) {
        let topology = &self.recognised.topology;
        let accelerations = numbers(&self.expected["accelerations"]);
        let mut motion = Motion::read(topology, &self.coordinates.write(topology));
        let three =
            |at: usize| Vec3::new(accelerations[at], accelerations[at + 1], accelerations[at + 2]);
        motion.main = Twist { angular: three(0), linear: three(3) };
        for (hinge, i) in motion.hinges.iter_mut().zip(&self.order) {
            hinge.tau_dot = accelerations[6 + i];
        }
        let found = self.evaluate::<T>(&motion.write(topology));
        let expected = numbers(&self.expected["drive"]);
        let scale = expected.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
        for (row, found) in self.rows().into_iter().zip(found) {
            let off = (found - expected[row]).abs() / scale;
            assert!(off < TOLERANCE, "{}, drive, {row}: {off:e}", T::TOPOLOGY);
        }
    }

    /// Mass matrix, and right side without torques, which is the bias with the other sign.
    fn has_matrix<T: Routine>(&self) {
        let mut coordinates = self.coordinates.clone();
        coordinates.hinges.iter_mut().for_each(|hinge| hinge.torque = 0.0);
        let found = self.evaluate::<T>(&coordinates.write(&self.recognised.topology));
        let size = 6 + self.order.len();
        let (matrix, right) = found.split_at(size * size);
        // Force before moment, hinges in the topology's order.
        let rows: Vec<usize> =
            [3, 4, 5, 0, 1, 2].into_iter().chain(self.order.iter().map(|i| 6 + i)).collect();
        let expected: Vec<Vec<f64>> =
            self.expected["mass_matrix"].as_array().expect("rows").iter().map(numbers).collect();
        for (found, &i) in matrix.chunks_exact(size).zip(&rows) {
            for (found, &j) in found.iter().zip(&rows) {
                let scale = (expected[i][i] * expected[j][j]).sqrt();
                let off = (found - expected[i][j]).abs() / scale;
                assert!(off < TOLERANCE, "{}, entry {i}, {j}: {off:e}", T::TOPOLOGY);
            }
        }
        let bias = numbers(&self.expected["bias"]);
        let scale = bias.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
        for (right, &i) in right.iter().zip(&rows) {
            let off = (right + bias[i]).abs() / scale;
            assert!(off < TOLERANCE, "{}, bias {i}: {off:e}", T::TOPOLOGY);
        }
    }
}

#[test]
fn inverse_dynamics_is_that_of_pinocchio() {
    Robot::new("ur5").is_driven::<ArmInverse>();
}

#[test]
fn matrix_and_bias_are_those_of_pinocchio() {
    Robot::new("ur5").has_matrix::<ArmMatrix>();
}
