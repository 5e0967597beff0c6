//! Scenes of the reference data: angles in radians, hinges numbered from 0.

use nboom::model::{
    Appendage, Dashpot, External, Gravity, Hinge, HingeStart, HingeState, InitialMotion,
    KickOffSpring, MassProperties, Mount, Release, Scene, SceneDescription, Segment, Spring, Stops,
};
use nboom::scalar::{Mat3, Quaternion, Sym3, Vec3};
use serde_json::Value;

use super::{number, numbers};

/// A scene with its initial motion and schedule.
pub fn scene(value: &Value, end_time: f64) -> Scene {
    let mut description = bodies(value, end_time);
    let initial = &value["initial"];
    let omega_body = vector(&initial["omega"]);
    let attitude_matrix = matrix(&initial["M0"]);
    description.initial = InitialMotion {
        time: number(initial, "t0"),
        attitude: Quaternion::from_matrix(&attitude_matrix),
        position_inertial: vector(&initial["rho"]),
        velocity_inertial: attitude_matrix * vector(&initial["v"]),
        omega_body,
    };
    Scene::new(description).expect("reference scenes are valid")
}

/// Bodies and environment only.
pub fn bodies(value: &Value, end_time: f64) -> SceneDescription {
    let name = value["name"].as_str().unwrap_or("case");
    let mut description =
        SceneDescription::at_rest(name, mass_properties(&value["main_body"]), end_time);
    for appendage in value["appendages"].as_array().expect("appendages are a list") {
        description.attach(&read_appendage(appendage));
    }
    let gravity = &value["gravity"];
    if gravity["g"].as_f64().is_some_and(|g| g != 0.0) {
        let up = vector(&gravity["direction"]);
        description.gravity =
            Some(Gravity { acceleration: number(gravity, "g"), up: up * (1.0 / up.norm()) });
    }
    let thrust = &value["thrust"];
    if thrust["magnitude"].as_f64().is_some_and(|f| f != 0.0) {
        let force = vector(&thrust["direction"]) * number(thrust, "magnitude");
        let times = [number(thrust, "t_on"), number(thrust, "t_off")];
        description.externals = vec![External::thrust(force, vector(&thrust["point"]), times)];
    }
    description
}

fn read_appendage(value: &Value) -> Appendage {
    let rot = match value.get("axes").filter(|axes| !axes.is_null()) {
        Some(axes) => matrix(axes),
        None => {
            let euler = numbers(&value["euler"]);
            Mat3::from_euler_121(euler[0], euler[1], euler[2])
        }
    };
    let mount = Mount { point: vector(&value["hinge_point"]), rot_inboard_from_hinge: rot };
    let mut segments: Vec<Segment> =
        value["segments"].as_array().expect("segments are a list").iter().map(segment).collect();
    match value["type"].as_str() {
        Some("paddle") => {
            let paddle = segments.pop().expect("a paddle has two bodies");
            let arm = segments.pop().expect("a paddle has two bodies");
            Appendage::Paddle { mount, arm, paddle }
        }
        _ => Appendage::Regular { mount, segments },
    }
}

fn segment(value: &Value) -> Segment {
    let spring = &value["spring"];
    let dashpot = &value["dashpot"];
    let or_zero = |value: &Value| value.as_f64().unwrap_or(0.0);
    let hinge = Hinge {
        spring: Spring {
            quadratic: or_zero(&spring["k1"]),
            linear: or_zero(&spring["k2"]),
            preload_angle: or_zero(&spring["theta"]),
        },
        dashpot: Dashpot {
            rate_quadratic: or_zero(&dashpot["q1"]),
            rate_linear: or_zero(&dashpot["q2"]),
            angle_quadratic: or_zero(&dashpot["q3"]),
            angle_linear: or_zero(&dashpot["q4"]),
            preload_angle: or_zero(&dashpot["gamma"]),
        },
        friction: 0.0,
        stops: Stops::NONE,
        kick_off: kick_off(&value["kickoff"]),
        release: release(&value["release"]),
        lock_angle: value["lock"].get("beta_s").and_then(Value::as_f64),
        start: HingeStart {
            angle: or_zero(&value["beta0"]),
            rate: or_zero(&value["tau0"]),
            state: match value["state0"].as_str() {
                Some("unreleased") => HingeState::Unreleased,
                Some("locked") => HingeState::Locked,
                _ => HingeState::Free,
            },
        },
    };
    Segment { length: number(value, "length"), mass_properties: mass_properties(value), hinge }
}

fn kick_off(value: &Value) -> Option<KickOffSpring> {
    let coefficients = value.get("a").map(numbers)?;
    let coefficients: [f64; 4] = coefficients.try_into().expect("four coefficients");
    (coefficients != [0.0; 4]).then(|| KickOffSpring {
        main_body_point: vector(&value["r"]),
        body_point: vector(&value["s"]),
        coefficients,
        limit_length: number(value, "x_f"),
    })
}

fn release(value: &Value) -> Release {
    match value["kind"].as_str() {
        Some("time") => Release::Time(number(value, "time")),
        Some("angle") => Release::Angle {
            hinge: value["segment"].as_u64().expect("a hinge number") as usize,
            angle: number(value, "angle"),
        },
        Some("initial") => Release::Time(f64::NEG_INFINITY),
        _ => Release::Never,
    }
}

fn mass_properties(value: &Value) -> MassProperties {
    let inertia = Sym3::upper_of(&matrix(&value["inertia"]));
    MassProperties::new(number(value, "mass"), vector(&value["com"]), inertia)
}

/// A vector of three numbers.
pub fn vector(value: &Value) -> Vec3<f64> {
    let array: [f64; 3] = numbers(value).try_into().expect("three components");
    array.into()
}

/// A 3×3 matrix given by rows.
pub fn matrix(value: &Value) -> Mat3<f64> {
    let rows: Vec<Vec3<f64>> = value.as_array().expect("rows").iter().map(vector).collect();
    Mat3::from_rows(rows[0], rows[1], rows[2])
}
