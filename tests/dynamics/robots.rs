//! Seven public robots and one with gimbals, read from URDF, against Pinocchio 4.1.0; one has fingers that
//! slide.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::formulation::{
    Coordinates, Formulation, HingeCoordinates, Parameters, Recognised, recognise,
};
use nboom::io::{Format, read_scene};
use nboom::model::{HingeState, Mode};
use nboom::scalar::{Dual, Vec3, Wrench};
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

/// Derivatives by two derivations in `f64` differ by rounding, at most 5e-14 here.
const TOLERANCE_OF_DERIVATIVES: f64 = 1e-12;

#[test]
fn derivatives_by_angles_rates_and_torques_are_those_of_pinocchio() {
    let (states, all) = (data("robots/accelerations.json"), data("robots/dynamics.json"));
    for (name, expected) in all.as_object().expect("robots by name") {
        let robot = &states[name];
        let state = &robot["states"][expected["state"].as_u64().expect("a number") as usize];
        for formulation in [Formulation::Articulated, Formulation::Symmetric] {
            for (row, key) in ["by_angles", "by_rates", "by_torques"].into_iter().enumerate() {
                let found = derivatives(name, robot, state, formulation, row);
                let error = relative_error(&found, &numbers(&expected[key]), 0.0);
                assert!(
                    error < TOLERANCE_OF_DERIVATIVES,
                    "{name}, {formulation}, {key}: {error:e}"
                );
            }
        }
    }
}

/// Derivatives of ω̇, a_O and τ̇, hinges in the order of the data: rows of one number for each angle, rate or
/// torque (`of_hinge`).
fn derivatives(
    name: &str,
    robot: &Value,
    state: &Value,
    formulation: Formulation,
    of_hinge: usize,
) -> Vec<f64> {
    let scene = read_scene(&data_path(&format!("robots/{name}.urdf"))).expect("a robot").scene;
    let Recognised { topology, parameters, links, .. } =
        recognise(Recursive::<f64>::new(&scene).tree()).expect("rigid bodies");
    let constants = parameters.write().into_iter().map(Dual::constant);
    let parameters = Parameters::read(&topology, constants);
    let names: Vec<&str> =
        robot["hinges"].as_array().expect("links").iter().filter_map(Value::as_str).collect();
    let of_link = |link: &usize| names.iter().position(|&name| scene.name_of(*link) == Some(name));
    let order: Vec<usize> = links.iter().map(|link| of_link(link).expect("a hinge")).collect();
    let values = ["angles", "rates", "torques"].map(|key| numbers(&state[key]));
    let [x, y, z] = numbers(&state["omega"]).try_into().expect("three numbers");
    let (n, mut all) = (order.len(), vec![0.0; (6 + order.len()) * order.len()]);
    for along in 0..n {
        let number = |row: usize, i: usize| match (row, i) == (of_hinge, along) {
            true => Dual::variable(values[row][i]),
            false => Dual::constant(values[row][i]),
        };
        let hinge = |&i: &usize| HingeCoordinates {
            beta: number(0, i),
            tau: number(1, i),
            torque: number(2, i),
        };
        let coordinates = Coordinates {
            omega: Vec3::new(x, y, z).map(Dual::constant),
            external: Wrench::zero(),
            hinges: order.iter().map(hinge).collect(),
        };
        let found = formulation.solve(&topology, &parameters, &coordinates);
        let main = [found.main.angular.to_array(), found.main.linear.to_array()].concat();
        let of_main = main.into_iter().enumerate();
        let of_hinges = order.iter().map(|i| 6 + i).zip(found.tau_dot);
        of_main.chain(of_hinges).for_each(|(row, dual)| all[row * n + along] = dual.derivative);
    }
    all
}

#[test]
fn fingers_of_panda_slide() {
    let scene = read_scene(&data_path("robots/panda.urdf")).expect("a robot").scene;
    let slides = |&i: &usize| scene.bodies[i].joint.slides();
    let sliding = (0..scene.bodies.len()).filter(slides).filter_map(|i| scene.name_of(i));
    assert_eq!(sliding.collect::<Vec<_>>(), ["panda_leftfinger", "panda_rightfinger"]);
}
