//! NASA's program NBOD2 of 1982: every number of interest in the printout of its sample INS, at eleven times.

use std::path::Path;

use nboom::io::read_scene;
use nboom::model::Scene;
use nboom::scalar::Vec3;
use nboom::sim::{BodyMotion, Snapshot};
use serde_json::Value;

use crate::collect::{detail, run, tight};
use crate::support::data;

/// What is printed about one quantity at one time, and what it is here.
struct Compared {
    quantity: &'static str,
    printed: Vec<String>,
    found: Vec<f64>,
    /// What its components are small beside: the size of the motion that they are a part of.
    whole: f64,
}

/// Angular momentum about the inertial origin.
fn angular_momentum(bodies: &[BodyMotion]) -> Vec3<f64> {
    let of_bodies = bodies.iter().map(|body| body.angular_momentum_about(Vec3::zero()));
    of_bodies.fold(Vec3::zero(), |sum, of_body| sum + of_body)
}

/// All quantities at one time. Body 1 is the stage, bodies 2 and 3 are the tanks; the angular momentum is along
/// inertial axes, all else along those of the stage.
fn compared(scene: &Scene, seen: &Snapshot, printed: &Value) -> Vec<Compared> {
    let bodies = seen.bodies(scene);
    let to_stage = seen.attitude.to_matrix().transpose();
    let [stage, _, first, _, second] = &bodies[..] else { panic!("a stage, two rings, two tanks") };
    let detail = detail(seen);
    let mut all = Vec::new();
    let mut add = |quantity: &'static str, found: &[f64], whole: f64| {
        let printed = printed[quantity].as_array().expect("numbers");
        let printed: Vec<String> =
            printed.iter().map(|text| text.as_str().expect("a text").to_owned()).collect();
        assert_eq!(printed.len(), found.len());
        all.push(Compared { quantity, printed, found: found.to_vec(), whole });
    };
    let [spin, length, acceleration] = [4.2, 7.0, 71.0];
    for (names, body) in [
        (["body_1_rate", "body_1_position", "body_1_velocity"], stage),
        (["body_2_rate", "body_2_position", "body_2_velocity"], first),
        (["body_3_rate", "body_3_position", "body_3_velocity"], second),
    ] {
        add(names[0], &(to_stage * body.omega_inertial).to_array(), spin);
        add(names[1], &(to_stage * body.mass_center_inertial).to_array(), length);
        add(names[2], &(to_stage * body.velocity_inertial).to_array(), length * spin);
    }
    add("body_1_angular_acceleration", &detail.omega_dot_body.to_array(), spin * spin);
    let of_origin = detail.origin_acceleration_body;
    add("origin_acceleration", &of_origin.to_array(), acceleration);
    add("angular_momentum", &angular_momentum(&bodies).to_array(), 2200.0);
    let momentum = to_stage * seen.linear_momentum_inertial;
    add("linear_momentum", &momentum.to_array(), 211.0 * length * spin);
    add("kinetic_energy", &[seen.kinetic_energy], seen.kinetic_energy);
    add("angle", &seen.beta, 1.0);
    add("angle_rate", &seen.tau, spin);
    add("angle_acceleration", &detail.beta_ddot, spin * spin);
    all
}

/// How printed numbers compare with ours.
#[derive(Default)]
pub struct Tally {
    to_the_last_digit: usize,
    rounding: usize,
    others: Vec<String>,
}

impl Tally {
    /// Takes a printed number, of which `what` tells which it is, and ours; a difference of at most `rounding` is
    /// that.
    pub fn add(&mut self, what: &str, printed: &str, found: f64, rounding: f64) {
        let value: f64 = printed.parse().expect("a number");
        let off = (found - value).abs();
        // A number halfway between two printed ones may be printed as either.
        if off <= half_of_last_digit(printed) * (1.0 + 1e-6) && value != 0.0 {
            self.to_the_last_digit += 1;
        } else if off <= rounding {
            self.rounding += 1;
        } else {
            self.others.push(format!("{what}: {found:e}, printed {printed}"));
        }
    }

    pub fn assert_all_agree(&self, numbers: usize) {
        let Self { to_the_last_digit, rounding, others } = self;
        println!("{to_the_last_digit} to the last digit, {rounding} to rounding");
        assert_eq!(to_the_last_digit + rounding + others.len(), numbers);
        assert!(others.is_empty(), "{}", others.join("\n"));
    }
}

/// Half a unit of the last printed digit.
fn half_of_last_digit(printed: &str) -> f64 {
    let (mantissa, exponent) = printed.split_once('e').expect("an exponent");
    let (_, decimals) = mantissa.split_once('.').expect("decimals");
    let exponent: i32 = exponent.parse().expect("a number");
    0.5 * 10.0_f64.powi(exponent - i32::try_from(decimals.len()).expect("a few"))
}

/// Numbers that are parts of something larger carry its rounding, here of 1e-14: in the program of 1982 of the
/// inertias of the stage, here of the lengths and rates of the motion.
const ROUNDING: f64 = 1e-13;

#[test]
fn the_printout_of_1982_agrees_digit_by_digit() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/nasa-ins.toml");
    let scene = read_scene(&path).expect("a scene").scene;
    let (found, _) = run(&scene, &tight(10));
    let blocks = data("nbod2/ins.json");
    let blocks = blocks.as_array().expect("blocks");
    assert_eq!((blocks.len(), found.samples.len()), (11, 11));
    let mut tally = Tally::default();
    for (block, seen) in blocks.iter().zip(&found.samples) {
        let time: f64 = block["time"].as_str().and_then(|text| text.parse().ok()).expect("a time");
        assert!((seen.time - time).abs() < 1e-15, "{} {time}", seen.time);
        for Compared { quantity, printed, found, whole } in compared(&scene, seen, block) {
            for (i, (printed, found)) in printed.iter().zip(found).enumerate() {
                tally.add(&format!("{quantity} {i} at {time}"), printed, found, ROUNDING * whole);
            }
        }
    }
    tally.assert_all_agree(572);
}
