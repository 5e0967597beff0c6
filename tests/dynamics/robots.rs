//! Seven public robots and one with gimbals, read from URDF, against Pinocchio 4.1.0; one has fingers that
//! slide.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::formulation::{
    self, Coordinates, Drive, Formulation, HingeCoordinates, HingeMotion, Layout, Parameters,
    Recognised, inverse_dynamics, recognise,
};
use nboom::io::{Format, read_scene};
use nboom::model::{HingeState, Mode};
use nboom::scalar::{Derivatives, Dual, Twist, Vec3, Wrench};
use serde_json::Value;

use crate::support::{data, data_path, numbers, relative_error};

/// Both codes compute in `f64` and differ by rounding, at most 3e-15 here; a condition number thirty times
/// as large is allowed for.
const TOLERANCE: f64 = 1e-13;

#[test]
fn robots_accelerate_as_by_pinocchio() {
    let robots = data("robots/accelerations.json");
    let robots = robots.as_object().expect("robots by name");
    assert_eq!(robots.len(), 8);
    for (name, robot) in robots {
        let largest = largest_difference(name, robot);
        assert!(largest < TOLERANCE, "{name}: {largest:e}");
    }
}

fn largest_difference(name: &str, robot: &Value) -> f64 {
    let file = read_scene(&data_path(&format!("robots/{name}.urdf"))).expect("a robot");
    assert_eq!(file.format, Format::Urdf);
    let scene = file.scene;
    let place = |link: &Value| {
        let link = link.as_str();
        (0..scene.bodies.len()).find(|&i| scene.name_of(i) == link).expect("a hinge of each")
    };
    let places: Vec<usize> = robot["hinges"].as_array().expect("links").iter().map(place).collect();
    assert_eq!(places.len(), scene.bodies.len());
    let mass = robot["mass"].as_f64().expect("a mass");
    assert!((scene.total_mass() - mass).abs() < 1e-13 * mass);
    let mode = Mode::at_start(&scene);
    assert!(mode.hinges.iter().all(|&hinge| hinge == HingeState::Free));
    let mut dynamics = Recursive::<f64>::new(&scene);
    let states = robot["states"].as_array().expect("states");
    let difference = |state: &Value| {
        let of_hinges = |key: &str| {
            let mut ordered = vec![0.0; places.len()];
            for (&place, value) in places.iter().zip(numbers(&state[key])) {
                ordered[place] = value;
            }
            ordered
        };
        let vector = |key: &str| {
            let [x, y, z] = numbers(&state[key]).try_into().expect("three numbers");
            Vec3::new(x, y, z)
        };
        let (beta, tau) = (of_hinges("angles"), of_hinges("rates"));
        let motion = Motion { omega_body: vector("omega"), beta: &beta, tau: &tau };
        let mut found = Accelerations::for_hinges(places.len());
        // Pinocchio leaves dampers out of account.
        let torques = of_hinges("torques");
        dynamics.accelerations_with(|_, all| all.copy_from_slice(&torques), &motion, &mut found);
        let base = |omega_dot: Vec3<f64>, origin: Vec3<f64>| {
            [omega_dot.to_array(), origin.to_array()].concat()
        };
        let of_base = base(vector("omega_dot"), vector("origin_acceleration"));
        let found = [base(found.omega_dot_body, found.origin_body), found.tau_dot].concat();
        let expected = [of_base, of_hinges("hinge_accelerations")].concat();
        relative_error(&found, &expected, 0.0)
    };
    states.iter().map(difference).fold(0.0, f64::max)
}

/// What two derivations in `f64` differ by is rounding, at most 5e-14 here.
const TOLERANCE_OF_CLOSED_FORMS: f64 = 1e-12;

/// A robot in one of the states, as closed forms take it.
struct InState {
    recognised: Recognised,
    coordinates: Coordinates<f64>,
    /// For each hinge of the topology, which it is in the data.
    order: Vec<usize>,
}

impl InState {
    fn new(name: &str, robot: &Value, state: &Value) -> Self {
        let scene = read_scene(&data_path(&format!("robots/{name}.urdf"))).expect("a robot").scene;
        let recognised = recognise(Recursive::<f64>::new(&scene).tree()).expect("rigid bodies");
        let names: Vec<&str> =
            robot["hinges"].as_array().expect("links").iter().filter_map(Value::as_str).collect();
        let of_link =
            |link: &usize| names.iter().position(|&name| scene.name_of(*link) == Some(name));
        let order: Vec<usize> =
            recognised.links.iter().map(|link| of_link(link).expect("a hinge")).collect();
        let [beta, tau, torque] = ["angles", "rates", "torques"].map(|key| numbers(&state[key]));
        let hinge = |&i: &usize| HingeCoordinates { beta: beta[i], tau: tau[i], torque: torque[i] };
        let hinges = order.iter().map(hinge).collect();
        let [x, y, z] = numbers(&state["omega"]).try_into().expect("three numbers");
        let (omega, external) = (Vec3::new(x, y, z), Wrench::zero());
        Self { recognised, coordinates: Coordinates { omega, external, hinges }, order }
    }

    /// Rows of six numbers and of one for each hinge in the order of the data.
    fn rows(&self, of_main: [usize; 6]) -> Vec<usize> {
        of_main.into_iter().chain(self.order.iter().map(|i| 6 + i)).collect()
    }

    /// Derivatives of ω̇, a_O and τ̇, hinges in the order of the data: rows of one number for each angle, rate
    /// or torque (`of_hinge`).
    fn derivatives(&self, formulation: Formulation, of_hinge: usize) -> Vec<f64> {
        let Recognised { topology, parameters, .. } = &self.recognised;
        let constants = parameters.write().into_iter().map(Dual::constant);
        let parameters = Parameters::read(topology, constants);
        let n = self.order.len();
        let mut all = vec![0.0; (6 + n) * n];
        for (along, &column) in self.order.iter().enumerate() {
            let Coordinates { omega, hinges, .. } = &self.coordinates;
            let dual = |i: usize, row: usize, value: f64| match (i, row) == (along, of_hinge) {
                true => Dual::variable(value),
                false => Dual::constant(value),
            };
            let hinge = |(i, hinge): (usize, &HingeCoordinates<f64>)| HingeCoordinates {
                beta: dual(i, 0, hinge.beta),
                tau: dual(i, 1, hinge.tau),
                torque: dual(i, 2, hinge.torque),
            };
            let coordinates = Coordinates {
                omega: Vec3::constant(*omega),
                external: Wrench::zero(),
                hinges: hinges.iter().enumerate().map(hinge).collect(),
            };
            let found = formulation.solve(topology, &parameters, &coordinates);
            let main = [found.main.angular.to_array(), found.main.linear.to_array()].concat();
            for (row, dual) in self.rows(MAIN).into_iter().zip(main.iter().chain(&found.tau_dot)) {
                all[row * n + column] = dual.derivative;
            }
        }
        all
    }

    /// The same by the chain rule through inverse dynamics, for angles, rates and torques.
    fn by_chain_rule(&self) -> [Vec<f64>; 3] {
        let Recognised { topology, parameters, .. } = &self.recognised;
        let solution = Formulation::Articulated.solve(topology, parameters, &self.coordinates);
        let state = self.coordinates.write(topology);
        let accelerations = solution.write(topology);
        let mut found = vec![0.0; accelerations.len() * state.len()];
        Derivatives::of(&Layout::tree(topology), &parameters.write()).write(
            &state,
            &accelerations,
            0..state.len(),
            &mut found,
        );
        let (n, places) = (self.order.len(), Layout::places(topology));
        let rows: Vec<usize> =
            (0..6).chain(places.iter().map(|place| Layout::OUTPUT + place)).collect();
        [0, 1, 2].map(|of_hinge| {
            let mut all = vec![0.0; (6 + n) * n];
            for (&place, &column) in places.iter().zip(&self.order) {
                let along = Layout::hinge_in_state(topology, place)[of_hinge];
                for (to, row) in self.rows(MAIN).into_iter().zip(&rows) {
                    all[to * n + column] = found[row * state.len() + along];
                }
            }
            all
        })
    }
}

/// Rows of the main body in the data.
const MAIN: [usize; 6] = [0, 1, 2, 3, 4, 5];

/// Those of matrices of ours, force before moment.
const FORCE_FIRST: [usize; 6] = [3, 4, 5, 0, 1, 2];

/// Each of the robots with what Pinocchio says about one of its states.
fn for_each_robot(check: impl Fn(&str, &InState, &Value)) {
    let (states, all) = (data("robots/accelerations.json"), data("robots/dynamics.json"));
    let all = all.as_object().expect("robots by name");
    assert_eq!(all.len(), 3);
    for (name, expected) in all {
        let robot = &states[name];
        let state = &robot["states"][expected["state"].as_u64().expect("a number") as usize];
        check(name, &InState::new(name, robot, state), expected);
    }
}

#[test]
fn derivatives_by_angles_rates_and_torques_are_those_of_pinocchio() {
    for_each_robot(|name, robot, expected| {
        for formulation in [Formulation::Articulated, Formulation::Symmetric] {
            for (row, key) in ["by_angles", "by_rates", "by_torques"].into_iter().enumerate() {
                let found = robot.derivatives(formulation, row);
                let error = relative_error(&found, &numbers(&expected[key]), 0.0);
                assert!(
                    error < TOLERANCE_OF_CLOSED_FORMS,
                    "{name}, {formulation}, {key}: {error:e}"
                );
            }
        }
    });
}

#[test]
fn derivatives_by_the_chain_rule_are_those_of_pinocchio() {
    for_each_robot(|name, robot, expected| {
        let keys = ["by_angles", "by_rates", "by_torques"];
        for (key, found) in keys.into_iter().zip(robot.by_chain_rule()) {
            let error = relative_error(&found, &numbers(&expected[key]), 0.0);
            assert!(error < TOLERANCE_OF_CLOSED_FORMS, "{name}, {key}: {error:e}");
        }
    });
}

#[test]
fn forces_for_given_accelerations_are_those_of_pinocchio() {
    for_each_robot(|name, robot, expected| {
        let Recognised { topology, parameters, .. } = &robot.recognised;
        let given = numbers(&expected["accelerations"]);
        let three = |at: usize| Vec3::new(given[at], given[at + 1], given[at + 2]);
        let hinges = robot.coordinates.hinges.iter().zip(&robot.order);
        let hinge = |(hinge, &i): (&HingeCoordinates<f64>, &usize)| HingeMotion {
            beta: hinge.beta,
            tau: hinge.tau,
            tau_dot: given[6 + i],
        };
        let motion = formulation::Motion {
            omega: robot.coordinates.omega,
            main: Twist { angular: three(0), linear: three(3) },
            hinges: hinges.map(hinge).collect(),
        };
        let Drive { external, torques } = inverse_dynamics(topology, parameters, &motion);
        let found =
            [&external.moment.to_array()[..], &external.force.to_array(), &torques].concat();
        let mut in_order = vec![0.0; found.len()];
        robot.rows(MAIN).into_iter().zip(found).for_each(|(row, found)| in_order[row] = found);
        let error = relative_error(&in_order, &numbers(&expected["drive"]), 0.0);
        assert!(error < TOLERANCE_OF_CLOSED_FORMS, "{name}: {error:e}");
    });
}

#[test]
fn mass_matrix_and_bias_are_those_of_pinocchio() {
    for_each_robot(|name, robot, expected| {
        let Recognised { topology, parameters, .. } = &robot.recognised;
        let mut at_no_torque = robot.coordinates.clone();
        at_no_torque.hinges.iter_mut().for_each(|hinge| hinge.torque = 0.0);
        let found = Formulation::Symmetric.equations(topology, parameters, &at_no_torque);
        let found = found.expect("it has equations");
        let (rows, size) = (robot.rows(FORCE_FIRST), found.forcing.len());
        let (mut matrix, mut bias) = (vec![0.0; size * size], vec![0.0; size]);
        for (i, &row) in rows.iter().enumerate() {
            bias[row] = -found.forcing[i];
            for (j, &column) in rows.iter().enumerate() {
                matrix[row * size + column] = found.matrix[i * size + j];
            }
        }
        for (key, found) in [("mass_matrix", matrix), ("bias", bias)] {
            let error = relative_error(&found, &numbers(&expected[key]), 0.0);
            assert!(error < TOLERANCE_OF_CLOSED_FORMS, "{name}, {key}: {error:e}");
        }
    });
}

#[test]
fn fingers_of_panda_slide() {
    let scene = read_scene(&data_path("robots/panda.urdf")).expect("a robot").scene;
    let slides = |&i: &usize| scene.bodies[i].joint.slides();
    let sliding = (0..scene.bodies.len()).filter(slides).filter_map(|i| scene.name_of(i));
    assert_eq!(sliding.collect::<Vec<_>>(), ["panda_leftfinger", "panda_rightfinger"]);
}
