//! Seven public robots and one with gimbals, read from URDF, against Pinocchio 4.1.0; one has fingers that
//! slide.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::io::{Format, read_scene};
use nboom::model::{HingeState, Mode};
use nboom::scalar::Vec3;
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

#[test]
fn fingers_of_panda_slide() {
    let scene = read_scene(&data_path("robots/panda.urdf")).expect("a robot").scene;
    let slides = |&i: &usize| scene.bodies[i].joint.slides();
    let sliding = (0..scene.bodies.len()).filter(slides).filter_map(|i| scene.name_of(i));
    assert_eq!(sliding.collect::<Vec<_>>(), ["panda_leftfinger", "panda_rightfinger"]);
}
