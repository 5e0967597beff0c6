//! Decks beside the same scenes as JSON, in radians and 0-based.

use nboom_io::{SceneFile, parse_deck};
use nboom_model::{Body, Course, HingeState, MassProperties, Release};
use nboom_scalar::{Mat3, Sym3, Vec3};
use serde_json::Value;

/// One rounding of a product of a number in degrees with π/180, and one of the printed digits.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

fn close(found: f64, expected: f64, scale: f64, what: &str) {
    let allowed = ROUNDING * scale.max(expected.abs());
    assert!((found - expected).abs() <= allowed, "{what}: {found} found, {expected} expected");
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn vector(value: &Value) -> Vec3<f64> {
    Vec3::new(number(&value[0]), number(&value[1]), number(&value[2]))
}

fn compare_vectors(found: Vec3<f64>, expected: Vec3<f64>, scale: f64, what: &str) {
    for (found, expected) in found.to_array().into_iter().zip(expected.to_array()) {
        close(found, expected, scale, what);
    }
}

fn symmetric(value: &Value) -> Sym3<f64> {
    Sym3::upper_of(&Mat3::from_rows(vector(&value[0]), vector(&value[1]), vector(&value[2])))
}

fn compare_masses(found: &MassProperties, expected: &Value) {
    assert_eq!(found.mass, number(&expected["mass"]));
    assert_eq!(found.center_of_mass, vector(&expected["com"]));
    assert_eq!(found.inertia, symmetric(&expected["inertia"]));
}

fn compare_environment(file: &SceneFile, expected: &Value) {
    let scene = &file.scene;
    let g = number(&expected["gravity"]["g"]);
    assert_eq!(scene.gravity.map_or(0.0, |gravity| gravity.acceleration), g);
    if let Some(gravity) = scene.gravity {
        compare_vectors(gravity.up, vector(&expected["gravity"]["direction"]), 1.0, "gravity");
    }
    let thrust = &expected["thrust"];
    let magnitude = number(&thrust["magnitude"]);
    assert_eq!(scene.externals.len(), usize::from(magnitude != 0.0));
    for found in &scene.externals {
        let force = vector(&thrust["direction"]) * magnitude;
        compare_vectors(found.amount, force, magnitude, "thrust");
        assert_eq!(found.point, vector(&thrust["point"]));
        let (on, off) = (number(&thrust["t_on"]), number(&thrust["t_off"]));
        assert_eq!(found.course, Course::Pulse { on, off });
    }
}

/// The deck has RHO and VBAR along body axes, the JSON has ρ along inertial ones and v = VBAR +
/// ω × RHO along body axes.
fn compare_motion(file: &SceneFile, expected: &Value) {
    let (found, initial) = (&file.scene.initial, &expected["initial"]);
    assert_eq!(found.time, number(&initial["t0"]));
    assert_eq!(file.scene.end_time, number(&expected["t_end"]));
    let rows = &initial["M0"];
    let attitude = Mat3::from_rows(vector(&rows[0]), vector(&rows[1]), vector(&rows[2]));
    let found_attitude = found.attitude.to_matrix();
    for j in 0..3 {
        compare_vectors(found_attitude.column(j), attitude.column(j), 1.0, "attitude");
    }
    compare_vectors(found.omega_body, vector(&initial["omega"]), 0.0, "omega");
    // The deck's components are rounded after a product with M0 and a difference of terms as
    // large as ω ρ, so they are good to a few roundings of those.
    let rho = vector(&initial["rho"]);
    compare_vectors(found.position_inertial, rho, 2.0 * rho.norm(), "rho");
    let velocity = vector(&initial["v"]);
    let terms = velocity.norm() + vector(&initial["omega"]).norm() * rho.norm();
    compare_vectors(found.velocity_inertial, attitude * velocity, 4.0 * terms, "v");
}

fn compare_hinge(body: &Body, expected: &Value) {
    let hinge = &body.hinge;
    let spring = &expected["spring"];
    assert_eq!(hinge.spring.quadratic, number(&spring["k1"]));
    assert_eq!(hinge.spring.linear, number(&spring["k2"]));
    close(hinge.spring.preload_angle, number(&spring["theta"]), 0.0, "theta");
    let (found, dashpot) = (&hinge.dashpot, &expected["dashpot"]);
    let q = [found.rate_quadratic, found.rate_linear, found.angle_quadratic, found.angle_linear];
    assert_eq!(q, ["q1", "q2", "q3", "q4"].map(|name| number(&dashpot[name])));
    close(found.preload_angle, number(&dashpot["gamma"]), 0.0, "gamma");
    close(hinge.start.angle, number(&expected["beta0"]), 0.0, "beta0");
    close(hinge.start.rate, number(&expected["tau0"]), 0.0, "tau0");
    let state = match hinge.start.state {
        HingeState::Unreleased => "unreleased",
        HingeState::Free => "free",
        HingeState::Locked => "locked",
        HingeState::Stuck => "stuck",
    };
    assert_eq!(state, expected["state0"]);
    match (hinge.lock_angle, &expected["lock"]) {
        (None, Value::Null) => {}
        (Some(angle), lock) => close(angle, number(&lock["beta_s"]), 0.0, "beta_s"),
        (None, lock) => panic!("no lock found, {lock} expected"),
    }
    compare_release(&hinge.release, &expected["release"]);
    compare_kick_off(body, &expected["kickoff"]);
}

fn compare_release(found: &Release, expected: &Value) {
    match (found, expected["kind"].as_str()) {
        // `initial`: not later than the initial time, which is 0 in all these scenes.
        (Release::Time(time), Some("initial")) => assert!(*time <= 0.0),
        (Release::Time(time), Some("time")) => assert_eq!(*time, number(&expected["time"])),
        (Release::Never, Some("never")) => {}
        (Release::Angle { hinge, angle }, Some("angle")) => {
            assert_eq!(*hinge as u64, expected["segment"]);
            close(*angle, number(&expected["angle"]), 0.0, "release angle");
        }
        (found, _) => panic!("{found:?} found, {expected} expected"),
    }
}

fn compare_kick_off(body: &Body, expected: &Value) {
    assert_eq!(body.hinge.kick_off.is_none(), expected.is_null());
    let Some(found) = body.hinge.kick_off else { return };
    assert_eq!(found.coefficients, [0, 1, 2, 3].map(|j| number(&expected["a"][j])));
    assert_eq!(found.main_body_point, vector(&expected["r"]));
    assert_eq!(found.body_point, vector(&expected["s"]));
    assert_eq!(found.limit_length, number(&expected["x_f"]));
}

fn compare_appendages(file: &SceneFile, expected: &Value) {
    let mut next = 0;
    for appendage in expected["appendages"].as_array().into_iter().flatten() {
        let mut length = None;
        for (i, segment) in appendage["segments"].as_array().into_iter().flatten().enumerate() {
            let body = &file.scene.bodies[next];
            let is_paddle = i == 1 && appendage["type"] == "paddle";
            assert_eq!(body.axis, if is_paddle { Vec3::unit_y() } else { Vec3::unit_x() });
            assert_eq!(body.inboard, (i > 0).then(|| next - 1));
            match length {
                None => compare_mount(body, appendage),
                Some(length) => assert_eq!(body.mount.point, Vec3::new(0.0, length, 0.0)),
            }
            compare_masses(&body.mass_properties, segment);
            compare_hinge(body, segment);
            length = Some(number(&segment["length"]));
            next += 1;
        }
    }
    assert_eq!(file.scene.bodies.len(), next);
}

fn compare_mount(body: &Body, appendage: &Value) {
    assert_eq!(body.mount.point, vector(&appendage["hinge_point"]));
    for j in 0..3 {
        let expected = match &appendage["axes"] {
            Value::Null => {
                let euler = vector(&appendage["euler"]);
                Mat3::from_euler_121(euler.x, euler.y, euler.z).column(j)
            }
            axes => {
                // Rows of the printed matrix.
                Vec3::from([0, 1, 2].map(|i| number(&axes[i][j])))
            }
        };
        compare_vectors(body.mount.rot_inboard_from_hinge.column(j), expected, 1.0, "axes");
    }
}

fn compare(name: &str, deck: &str, json: &str) {
    let file = parse_deck(name, deck, name).unwrap_or_else(|error| panic!("{error}"));
    let expected: Value = serde_json::from_str(json).expect("the file is JSON");
    assert_eq!(file.scene.name, name);
    assert_eq!(file.warnings, []);
    assert_eq!(file.structure, None);
    compare_masses(&file.scene.main_body, &expected["main_body"]);
    compare_environment(&file, &expected);
    compare_motion(&file, &expected);
    compare_appendages(&file, &expected);
}

#[test]
fn a_chain() {
    let deck = include_str!("../data/s03_chain3_general.nml");
    compare("s03", deck, include_str!("../data/s03_chain3_general.json"));
}

#[test]
fn gravity_and_thrust() {
    let deck = include_str!("../data/s06_gravity_thrust.nml");
    compare("s06", deck, include_str!("../data/s06_gravity_thrust.json"));
}

#[test]
fn kick_off_springs_and_a_paddle() {
    let deck = include_str!("../data/s08_kickoff_disengage.nml");
    compare("s08", deck, include_str!("../data/s08_kickoff_disengage.json"));
}

#[test]
fn all_initial_states() {
    let deck = include_str!("../data/s13_initial_states.nml");
    compare("s13", deck, include_str!("../data/s13_initial_states.json"));
}
