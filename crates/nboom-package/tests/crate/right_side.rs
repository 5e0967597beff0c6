use std::f64::consts::FRAC_PI_2;

use nboom_model::{
    Base, Coupling, Course, Dashpot, Drive, DrivePoint, ExternalAxes, ExternalKind, Gravity,
    TorqueTable,
};
use nboom_sim::Options;

use super::library::run;
use super::*;

/// Between the last two of three hinges.
const CABLE: Coupling = Coupling {
    hinges: [1, 2],
    ratio: -1.5,
    stiffness: 3.0,
    rest: 0.2,
    damping: 0.3,
    is_mutual: true,
};

/// Springs, dashpots, a cable, a wheel, a torque table and a kick-off spring that pushes to the end; a thruster fires on the way. In the topology,
/// S2_S1, hinges stand in another order than in the scene.
fn sprung() -> Scene {
    let mut description = (*satellite("sprung", &[1, 2])).clone();
    description.initial.time = 0.25;
    description.end_time = 1.75;
    let (kind, course) = (ExternalKind::Torque, Course::ALWAYS);
    let torque = External { kind, course, ..description.externals[0].clone() };
    description.externals.push(torque);
    for (i, body) in description.bodies.iter_mut().enumerate() {
        let dashpot = Dashpot { rate_linear: -0.4, rate_quadratic: 0.02, ..Dashpot::default() };
        body.hinge.dashpot = dashpot;
        body.hinge.start.angle = 0.3 + 0.2 * i as f64;
        body.hinge.start.rate = 0.1;
    }
    // Clippy takes it for a constant.
    description.bodies[2].hinge.start.angle = FRAC_PI_2;
    description.bodies[1].hinge.kick_off = Some(KickOffSpring {
        main_body_point: Vec3::new(0.2, 0.3, 0.0),
        body_point: Vec3::unit_y() * 0.8,
        coefficients: [2.0, -0.2, 0.0, 0.0],
        limit_length: 100.0,
    });
    let points = vec![[-10.0, 3.0], [0.0, 1.0], [10.0, -2.0]];
    description.torque_tables = vec![TorqueTable { hinge: 0, points }];
    description.couplings.push(CABLE);
    let axis = Vec3::new(0.6, 0.0, 0.8);
    let speed = RotorSpeed::Constant(60.0);
    description.rotors.push(Rotor { body: None, axis, inertia: 0.5, speed });
    Scene::new(description).expect("the bodies are physical")
}

/// Integrates with the crate alone, and compares the end with that of a run: 3000 steps of the classical Runge-Kutta
/// method, each of half a millisecond, whose fourth power is 6e-14.
const PROGRAM: &str = r#"
use satellite_sprung::{
    HINGES, HOLDINGS, START, START_TIME, THRUSTS, VARIABLES, WRENCH, right_side, right_side_parameters,
};

const END: f64 = 1.75;
const STEPS: usize = 3000;

const EXPECTED: &[f64] = &EXPECTED_NUMBERS;

#[test]
fn it_ends_where_the_simulation_ends() {
    let kernel = right_side();
    let mut parameters = right_side_parameters().to_vec();
    let mut constants = vec![0.0; kernel.constants];
    let (mut y, step) = (START.to_vec(), (END - START_TIME) / STEPS as f64);
    for i in 0..STEPS {
        let middle = START_TIME + (i as f64 + 0.5) * step;
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
    assert!(HINGES.len() == VARIABLES.len() && HOLDINGS.is_empty());
    let limits = VARIABLES.map(|variables| variables.kick_off_limit);
    assert_eq!(limits, [None, Some(100.0), None]);
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

/// A pendulum on a main body that turns faster and faster: m = 3, l = 0.9, J = 4 + m l² about x at the origin, g = 9.81
/// along -x, ω̇ = 0.2 about x after the first second.
const PENDULUM: &str = r#"
use satellite_rig::{
    HOLDINGS, MAIN_BODY, START, VARIABLES, WRENCH, holding_wrench, right_side, right_side_parameters,
};

#[test]
fn it_swings_as_its_main_body_turns() {
    let kernel = right_side();
    let mut parameters = right_side_parameters().to_vec();
    let mut rates = |from: usize| {
        parameters[WRENCH].copy_from_slice(&HOLDINGS[from].wrench);
        assert!(kernel.accepts(&parameters));
        let mut constants = vec![0.0; kernel.constants];
        kernel.prepare(&parameters, &mut constants);
        let mut rates = vec![0.0; kernel.outputs];
        kernel.evaluate(&constants, &START, &mut rates);
        [rates[4], rates[VARIABLES[0].rate]]
    };
    assert_eq!(HOLDINGS.map(|holding| holding.from), [f64::NEG_INFINITY, 1.0, 3.0]);
    assert_eq!(right_side_parameters()[WRENCH], HOLDINGS[1].wrench);
    assert_eq!(holding_wrench(MAIN_BODY), HOLDINGS[1].wrench);
    for (found, expected) in [(rates(0), [0.0, 0.0]), (rates(1), [0.2, -0.2]), (rates(2), [0.0, 0.0])] {
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-13, "{found} {expected}");
        }
    }
}
"#;

/// What holds it as the scene starts is among the parameters, and what does later is told.
#[test]
fn a_right_side_of_a_rig_holds_its_main_body() {
    let mut description = (*satellite("rig", &[1])).clone();
    let point = |time, rate| DrivePoint { time, rate, speed: 0.0 };
    let points = vec![point(1.0, 0.5), point(3.0, 0.9)];
    description.base = Base::Driven(Drive { axis: Vec3::unit_x(), points });
    description.externals.clear();
    description.gravity = Some(Gravity { acceleration: 9.81, up: Vec3::unit_x() });
    description.bodies[0].hinge.spring = Spring::default();
    description.bodies[0].mount = Mount::at(Vec3::zero());
    description.initial.time = 1.5;
    description.initial.omega_body = Vec3::unit_x() * 0.6;
    let scene = Scene::new(description).expect("the bodies are physical");
    let place = written(&scene, &Choices { right_side: true, ..Choices::default() });
    fs::write(place.path().join("tests/pendulum.rs"), PENDULUM).expect("writable");
    let said = cargo_test(place.path()).unwrap_or_else(|said| panic!("{said}"));
    for line in ["SatelliteS1RightSide, portable code", "it_swings_as_its_main_body_turns ... ok"] {
        assert!(said.contains(line), "{said}");
    }
}

#[test]
fn what_a_right_side_has_no_place_for_is_refused() {
    let place = place();
    let directory = place.path().join("crate");
    let refused = |name: &str, whose: &str, change: &dyn Fn(&mut SceneDescription)| {
        let mut description = (*satellite(name, &[3])).clone();
        change(&mut description);
        let scene = Scene::new(description).expect("the bodies are physical");
        for numbers in [Numbers::RunTime, Numbers::Baked] {
            let choices = Choices { numbers, right_side: true, ..Choices::default() };
            let refused = generate(&scene, &choices, &directory).expect_err("no place");
            let expected = format!("scene {name}: {whose}: ");
            assert!(refused.to_string().starts_with(&expected), "{refused}");
            assert!(
                refused.to_string().ends_with("for which a right side has no place"),
                "{refused}"
            );
        }
    };
    refused("one alone", "coupling of hinges 1,2 and 1,3", &|scene| {
        scene.couplings = vec![Coupling { is_mutual: false, ..CABLE }];
    });
    refused("apart", "coupling of hinges 1,3 and 1,1", &|scene| {
        scene.couplings = vec![Coupling { hinges: [2, 0], ..CABLE }];
    });
    refused("doubled", "coupling of hinges 1,2 and 1,3", &|scene| {
        scene.couplings = vec![CABLE; 2];
    });
    let rotor =
        Rotor { body: None, axis: Vec3::unit_x(), inertia: 1.0, speed: RotorSpeed::Constant(2.0) };
    let speed = RotorSpeed::Table(vec![[0.0, 1.0], [2.0, 3.0]]);
    refused("spun up", "rotor on the main body", &|scene| {
        scene.rotors = vec![Rotor { speed: speed.clone(), ..rotor.clone() }]
    });
    refused("on a boom", "thrust on the segment 1,2 from 1.0 to 2.0", &|scene| {
        scene.externals[0].body = Some(1);
    });
    // The first one has a place.
    let push = "thrust on the main body from 3.0 to 4.0";
    refused("inertial", push, &|scene| {
        let course = Course::Pulse { on: 3.0, off: 4.0 };
        let push = External { course, ..scene.externals[0].clone() };
        scene.externals.push(External { axes: ExternalAxes::Inertial, ..push });
    });
    let table = Course::Table(vec![[0.0, 0.0], [1.0, 1.0], [2.0, 0.0]]);
    refused("table", "thrust on the main body from 0.0 to 2.0", &|scene| {
        scene.externals[0].course = table.clone();
    });
    assert!(!directory.exists());
}
