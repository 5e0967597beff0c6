use nboom_model::{Base, Coupling, Dashpot, KickOffSpring, TorqueTable};
use nboom_sim::Options;

use super::library::run;
use super::*;

/// Springs, dashpots, a torque table and a kick-off spring that pushes to the end; a thruster fires on the way. In the topology,
/// S2_S1, hinges stand in another order than in the scene.
fn sprung() -> Scene {
    let mut description = (*satellite("sprung", &[1, 2])).clone();
    description.end_time = 1.5;
    for (i, body) in description.bodies.iter_mut().enumerate() {
        let dashpot = Dashpot { rate_linear: -0.4, rate_quadratic: 0.02, ..Dashpot::default() };
        body.hinge.dashpot = dashpot;
        body.hinge.start.angle = 0.3 + 0.2 * i as f64;
        body.hinge.start.rate = 0.1;
    }
    description.bodies[1].hinge.kick_off = Some(KickOffSpring {
        main_body_point: Vec3::new(0.2, 0.3, 0.0),
        body_point: Vec3::unit_y() * 0.8,
        coefficients: [2.0, -0.2, 0.0, 0.0],
        limit_length: 100.0,
    });
    let points = vec![[-10.0, 3.0], [0.0, 1.0], [10.0, -2.0]];
    description.torque_tables = vec![TorqueTable { hinge: 0, points }];
    Scene::new(description).expect("the bodies are physical")
}

/// Integrates with the crate alone, and compares the end with that of a run: 3000 steps of the classical Runge-Kutta
/// method, whose error is 1e-12 or so.
const PROGRAM: &str = r#"
use satellite_sprung::{HINGES, START, THRUSTS, VARIABLES, WRENCH, right_side, right_side_parameters};

const END: f64 = 1.5;
const STEPS: usize = 3000;

const EXPECTED: &[f64] = &EXPECTED_NUMBERS;

#[test]
fn it_ends_where_the_simulation_ends() {
    let kernel = right_side();
    let mut parameters = right_side_parameters().to_vec();
    let mut constants = vec![0.0; kernel.constants];
    let (mut y, step) = (START.to_vec(), END / STEPS as f64);
    for i in 0..STEPS {
        let middle = (i as f64 + 0.5) * step;
        let wrench = &mut parameters[WRENCH];
        wrench.fill(0.0);
        for thrust in THRUSTS.iter().filter(|thrust| (thrust.on..thrust.off).contains(&middle)) {
            wrench.iter_mut().zip(thrust.wrench).for_each(|(sum, number)| *sum += number);
        }
        assert!(kernel.accepts(&parameters));
        kernel.prepare(&parameters, &mut constants);
        let rates = |shift: f64, by: &[f64]| {
            let moved: Vec<f64> = y.iter().zip(by).map(|(y, rate)| y + shift * rate).collect();
            let mut rates = vec![0.0; kernel.outputs];
            kernel.evaluate(&constants, &moved, &mut rates);
            rates
        };
        let k1 = rates(0.0, &y);
        let k2 = rates(step / 2.0, &k1);
        let k3 = rates(step / 2.0, &k2);
        let k4 = rates(step, &k3);
        for i in 0..y.len() {
            y[i] += step / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
    }
    assert_eq!(HINGES.len(), VARIABLES.len());
    let hinges = VARIABLES.iter().map(|v| y[v.angle]).chain(VARIABLES.iter().map(|v| y[v.rate]));
    let found: Vec<f64> = y[..7].iter().copied().chain(hinges).collect();
    assert_eq!(found.len(), EXPECTED.len());
    for (found, expected) in found.iter().zip(EXPECTED) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}
"#;

#[test]
fn a_right_side_is_all_that_an_integrator_needs() {
    let scene = sprung();
    let (end, _) = run(&scene, &Options::default());
    let program = PROGRAM.replace("EXPECTED_NUMBERS", &format!("{end:?}"));
    for numbers in [Numbers::RunTime, Numbers::Baked] {
        let choices = Choices { numbers, right_side: true, ..Choices::default() };
        let place = written(&scene, &choices);
        fs::write(place.path().join("tests/integrates.rs"), &program).expect("writable");
        let said = cargo_test(place.path()).unwrap_or_else(|said| panic!("{said}"));
        let name = match numbers {
            Numbers::RunTime => "SatelliteS2S1RightSide",
            Numbers::Baked => "BakedS2S1RightSide",
        };
        for line in [&format!("{name}, portable code"), "it_ends_where_the_simulation_ends ... ok"]
        {
            assert!(said.contains(line), "{said}");
        }
        cargo(place.path(), &["clippy", "--all-targets", "--quiet"]).expect("the code is clean");
        is_wrong_when_a_sign_is(place.path(), name);
    }
}

/// Its tests find a sum that is a difference.
fn is_wrong_when_a_sign_is(place: &Path, name: &str) {
    fs::remove_file(place.join("tests/integrates.rs")).expect("there");
    let routines = place.join("src/routines.rs");
    let text = fs::read_to_string(&routines).expect("readable");
    let start = text.find(&format!("pub struct {name}")).expect("it was asked for");
    let start = start + text[start..].find("fn evaluate_on").expect("a straight line");
    let (head, tail) = text.split_at(start);
    fs::write(&routines, head.to_owned() + &tail.replacen(" + ", " - ", 1)).expect("writable");
    let said = cargo_test(place).expect_err("the code is wrong");
    let failed = format!("{}_is_as_certified ... FAILED", name.to_lowercase());
    assert!(said.contains(&failed), "{said}");
}

/// The wrench that holds it is among the parameters.
#[test]
fn a_right_side_of_a_rig_holds_its_main_body() {
    let mut description = (*satellite("rig", &[1])).clone();
    description.base = Base::Fixed;
    description.externals.clear();
    description.initial.omega_body = Vec3::zero();
    let scene = Scene::new(description).expect("the bodies are physical");
    let place = written(&scene, &Choices { right_side: true, ..Choices::default() });
    let said = cargo_test(place.path()).unwrap_or_else(|said| panic!("{said}"));
    assert!(said.contains("SatelliteS1RightSide, portable code"), "{said}");
}

#[test]
fn what_a_right_side_has_no_place_for_is_refused() {
    let scene = satellite("coupled", &[2]);
    let mut description = (*scene).clone();
    description.couplings = vec![Coupling {
        hinges: [0, 1],
        ratio: -1.0,
        stiffness: 30.0,
        rest: 0.0,
        damping: 0.1,
        is_mutual: true,
    }];
    let coupled = Scene::new(description).expect("the bodies are physical");
    let place = place();
    let directory = place.path().join("crate");
    let choices = Choices { right_side: true, ..Choices::default() };
    let refused = generate(&coupled, &choices, &directory).expect_err("no place").to_string();
    assert!(refused.contains("scene coupled: a coupling of hinges found"), "{refused}");
    assert!(!directory.exists());
}
