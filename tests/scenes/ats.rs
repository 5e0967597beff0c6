//! NASA's program NBOD2 of 1982: every number of interest in the printout of its sample ATS, at eleven times.

use std::path::Path;

use nboom::io::read_scene;
use nboom::model::Scene;
use nboom::scalar::Vec3;
use nboom::sim::{Options, Snapshot};
use serde_json::Value;

use crate::collect::{detail, run};
use crate::nbod2::Tally;
use crate::support::data;

/// What is printed about one quantity at one time, and what it is here.
struct Compared {
    quantity: String,
    found: Vec<f64>,
    /// Below it components are nothing but rounding of what they are a part of: in the program of 1982 of differences of
    /// the momenta of wheels, here of rates.
    rounding: f64,
}

/// The bodies that are printed, in the order of the scene.
const BODIES: [&str; 5] = ["reflector", "array +y", "array -y", "fuel +x", "fuel -x"];
const WHEELS: [&str; 4] = ["roll wheel", "pitch wheel", "yaw wheel", "torsion wheel"];
const INERTIAS: [f64; 4] = [0.065, 0.065, 0.065, 96.705];

/// All quantities at one time; vectors along the axes of body 1 but for the angular momentum, which is inertial.
fn compared(scene: &Scene, seen: &Snapshot) -> Vec<Compared> {
    let number = |name: &str| {
        let found = (0..scene.bodies.len()).find(|&i| scene.name_of(i) == Some(name));
        found.expect("a body of the scene")
    };
    let bodies = seen.bodies(scene);
    let to_main = seen.attitude.to_matrix().transpose();
    let detail = detail(seen);
    let mut all = Vec::new();
    let mut add = |quantity: &str, found: Vec<f64>, rounding: f64| {
        all.push(Compared { quantity: quantity.to_owned(), found, rounding });
    };
    // Rates are up to 1e-5 and accelerations up to 1e-4.
    let [length, rate, acceleration] = [25.0, 1e-14, 1e-13];
    let printed = std::iter::once(0).chain(BODIES.map(|name| number(name) + 1));
    for (i, body) in printed.enumerate() {
        let body = &bodies[body];
        let along = |v: Vec3<f64>| (to_main * v).to_array().to_vec();
        add(&format!("body_{}_rate", i + 1), along(body.omega_inertial), rate);
        add(&format!("body_{}_position", i + 1), along(body.mass_center_inertial), 1e-12);
        add(&format!("body_{}_velocity", i + 1), along(body.velocity_inertial), length * rate);
    }
    add("body_1_angular_acceleration", detail.omega_dot_body.to_array().to_vec(), acceleration);
    // Of the components of the velocity, whose axes turn.
    let carried = seen.omega_body.cross(to_main * seen.velocity_inertial);
    let of_origin = detail.origin_acceleration_body - carried;
    add("origin_acceleration", of_origin.to_array().to_vec(), length * acceleration);
    let angular = bodies
        .iter()
        .fold(Vec3::zero(), |sum, body| sum + body.angular_momentum_about(Vec3::zero()));
    add("angular_momentum", angular.to_array().to_vec(), 1e-12);
    let wheels = WHEELS.map(number);
    let momenta: Vec<f64> = wheels.iter().zip(INERTIAS).map(|(&i, j)| j * seen.tau[i]).collect();
    // The printed energy has no part of the coupling of wheels and bodies, ω·h.
    let coupling = seen.omega_body.dot(Vec3::new(momenta[0], momenta[1], momenta[2]));
    add("kinetic_energy", vec![seen.kinetic_energy - coupling], 1e-12);
    add("wheel_momentum", momenta, 1e-12);
    // Friction, and the drives, which come first among what acts on hinged bodies along x, y and z of their wheels.
    let drive = |i: usize| detail.outside.get(i).map_or(0.0, |torque| torque[i]);
    let torques =
        wheels.iter().enumerate().map(|(i, &wheel)| detail.hinge_torque[wheel] + drive(i));
    add("wheel_torque", torques.collect(), 1e-12);
    let gimbals = (0..scene.bodies.len()).filter(|i| !wheels.contains(i));
    let of = |values: &[f64]| gimbals.clone().map(|i| values[i]).collect::<Vec<_>>();
    add("angle", of(&seen.beta), rate);
    add("angle_rate", of(&seen.tau), rate);
    add("angle_acceleration", of(&detail.beta_ddot), acceleration);
    all
}

#[test]
fn the_printout_of_1982_agrees_digit_by_digit() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/nasa-ats.toml");
    let scene = read_scene(&path).expect("a scene").scene;
    let options = Options { samples: 10, rtol: 1e-14, atol: 1e-17, ..Options::default() };
    let (found, _) = run(&scene, &options);
    let blocks = data("nbod2/ats.json");
    let blocks = blocks.as_array().expect("blocks");
    assert_eq!((blocks.len(), found.samples.len()), (11, 11));
    let mut tally = Tally::default();
    for (block, seen) in blocks.iter().zip(&found.samples) {
        let time: f64 = block["time"].as_str().and_then(|text| text.parse().ok()).expect("a time");
        assert!((seen.time - time).abs() < 1e-15, "{} {time}", seen.time);
        for Compared { quantity, found, rounding: least } in compared(&scene, seen) {
            let printed = block[&quantity].as_array().expect("numbers");
            assert_eq!(printed.len(), found.len(), "{quantity}");
            for (i, (printed, found)) in printed.iter().map(Value::as_str).zip(found).enumerate() {
                let printed = printed.expect("a text");
                tally.add(&format!("{quantity} {i} at {time}"), printed, found, least);
            }
        }
    }
    tally.assert_all_agree(1155);
}
