//! The loads that Section 18 prints at t = 0.16678, with the original's slip in handing them inboard
//! and without.
//!
//! The motion is the printed one: angles, rates and ω of block F, with the accelerations that the
//! right equations have there. Those of the print differ by up to 2 % (`blocks.rs`), and so may
//! its loads.

use std::path::Path;

use nboom::model::HingeState::{self, Free, Locked};
use nboom::model::{HingeStart, Release, Scene, SceneDescription};
use nboom::scalar::{Mat3, Vec3, Wrench};
use nboom::strength::{Settings, Slip, Slips, StationStress, StressAnalysis};

use crate::collect::{detail, run, tight};
use crate::support::{data, number, numbers};

/// Of the magnitude of a force or moment.
const MOTION: f64 = 0.02;

const HINGES: [HingeState; 4] = [Locked, Free, Free, Free];

/// What block F prints for a quantity.
fn printed_motion(name: &str) -> f64 {
    let file = data("printed_output.json");
    let all = file["numbers"].as_array().expect("a list");
    let found = all.iter().find(|row| row["block"] == "F_t1667" && row["quantity"] == name);
    found.map_or(0.0, |row| number(row, "printed"))
}

/// P and Q that are printed for a station.
fn printed_load(block: &str) -> Wrench<f64> {
    let file = data("printed_stress.json");
    let all = file["loads_check"].as_array().expect("a list");
    let row = all.iter().find(|row| row["block"] == block).expect("a block");
    let vector = |key: &str| {
        let numbers = numbers(&row[key]);
        Vec3::new(numbers[0], numbers[1], numbers[2])
    };
    Wrench { force: vector("P_printed"), moment: vector("Q_printed") }
}

/// Loads and stresses of all stations in the printed motion.
fn loads(slips: Slips) -> Vec<StationStress> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/n-boom-1970.nml");
    let file = nboom::io::read_scene(&path).expect("the sample deck is valid");
    let mut bodies = file.scene.bodies.clone();
    for (i, body) in bodies.iter_mut().enumerate() {
        let of = |name: &str| printed_motion(&format!("{name}[{i}]")).to_radians();
        body.hinge.start = HingeStart { angle: of("beta"), rate: of("tau"), state: HINGES[i] };
        body.hinge.release = Release::Never;
    }
    let mut initial = file.scene.initial;
    let omega = [0, 1, 2].map(|i| printed_motion(&format!("omega[{i}]")));
    initial.omega_body = omega.into();
    let end_time = initial.time + 1e-6;
    let scene = SceneDescription { bodies, initial, end_time, ..(*file.scene).clone() };
    let scene = Scene::new(scene).expect("the bodies are those of the deck");
    let structure = file.structure.expect("the deck has stations");
    let settings = Settings { slips, ..Settings::default() };
    let mut analysis = StressAnalysis::new(&scene, &structure, settings).expect("sections");
    let (found, _) = run(&scene, &tight(1));
    let at = &found.samples[0];
    analysis.motion(at, detail(at)).expect("loads balance");
    analysis.stations().stresses(analysis.station_loads()).collect()
}

fn load(of: &[StationStress], segment: usize, station: usize) -> Wrench<f64> {
    let is = |at: &&StationStress| (at.segment, at.station) == (segment, station);
    of.iter().find(is).expect("a station").load
}

/// The larger of the differences of forces and of moments, in parts of the printed ones.
fn difference(found: Wrench<f64>, printed: Wrench<f64>) -> f64 {
    let relative = |a: Vec3<f64>, b: Vec3<f64>| (a - b).norm() / b.norm();
    relative(found.force, printed.force).max(relative(found.moment, printed.moment))
}

#[test]
fn of_the_outer_boom() {
    let printed = printed_load("A1S2 st3");
    let off = difference(load(&loads(Slips::default()), 1, 2), printed);
    assert!(off < MOTION, "{off}");
}

#[test]
fn handed_to_the_inner_boom() {
    let printed = printed_load("A1S1 st1");
    let slip = [Slip::LoadTransfer].into_iter().collect();
    let off = difference(load(&loads(slip), 0, 0), printed);
    assert!(off < MOTION, "{off}");
    let off = difference(load(&loads(Slips::default()), 0, 0), printed);
    assert!(off > 0.5, "{off}");
}

/// What the arm is printed to carry is what the paddle is printed to carry, turned about the axis
/// and by the angle of the arm's hinge; the arm adds a slice of 0.001.
#[test]
fn handed_to_the_arm() {
    let turn = |degrees: f64| Mat3::about_axis(Vec3::unit_x(), degrees.to_radians());
    let (paddle, arm) = (printed_load("A2S2 st1"), printed_load("A2S1 st1"));
    let turned = paddle.rotated(&turn(printed_motion("beta[2]")));
    // Moments to the printed digits; the force lacks the slice's own, 0.001 of mass beside 0.2.
    assert!((turned.moment - arm.moment).norm() < 1e-4 * arm.moment.norm(), "{turned:?}, {arm:?}");
    assert!((turned.force - arm.force).norm() < 0.01 * arm.force.norm(), "{turned:?}, {arm:?}");
    let right = Mat3::about_axis(Vec3::unit_y(), printed_motion("beta[3]").to_radians());
    assert!(difference(paddle.rotated(&right), arm) > 0.5);

    let found = loads([Slip::LoadTransfer].into_iter().collect());
    let paddle = load(&found, 3, 0).rotated(&turn(printed_motion("beta[2]")));
    let off = difference(load(&found, 2, 0), paddle);
    assert!(off < MOTION, "{off}");
}
