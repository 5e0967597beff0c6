//! Satellites and states for any topology.
#![allow(dead_code, reason = "each test binary uses its own part")]

use nboom_formulation::Layout;
use nboom_model::{Shape, Topology};

pub use random::Rng;

#[path = "../../../../tests/support/random.rs"]
mod random;

/// Parameters of a satellite whose mass matrix is positive: light links on a heavy main body,
/// every inertia well above what its first moment demands.
pub fn parameters(
    topology: &Topology,
    assumptions: &[(usize, f64)],
    numbers: &mut Rng,
) -> Vec<f64> {
    let mut all = body(100.0, numbers);
    for shape in topology.shapes() {
        let rot = nboom_scalar::Mat3::from_euler_121(
            numbers.between(-3.0, 3.0),
            numbers.between(-3.0, 3.0),
            numbers.between(-3.0, 3.0),
        );
        all.extend(rot.rows.into_iter().flat_map(nboom_scalar::Vec3::to_array));
        all.extend((0..3).map(|_| numbers.between(-1.0, 1.0)));
        for _ in 0..shape.hinges() {
            all.extend(body(1.0, numbers));
            all.extend((0..2).map(|_| numbers.between(0.2, 1.0)));
        }
    }
    for &(i, value) in assumptions {
        all[i] = value;
    }
    all
}

fn body(mass: f64, numbers: &mut Rng) -> Vec<f64> {
    let mut body = vec![mass * numbers.between(1.0, 2.0)];
    body.extend((0..3).map(|_| mass * numbers.between(-0.3, 0.3)));
    body.extend((0..3).map(|_| mass * numbers.between(1.5, 2.0)));
    body.extend((0..3).map(|_| mass * numbers.between(-0.1, 0.1)));
    body
}

pub fn state(topology: &Topology, external: bool, numbers: &mut Rng) -> Vec<f64> {
    let count = Layout::coordinates(topology);
    let mut state: Vec<f64> = (0..count).map(|_| numbers.between(-2.0, 2.0)).collect();
    if !external {
        state[3..9].fill(0.0);
    }
    state
}

/// The shapes that a topology's name stands for.
pub fn shapes(name: &str) -> Vec<Shape> {
    let shape = |text: &str| match text {
        "P" => Shape::Paddle,
        chain => Shape::Chain(chain[1..].parse().expect("a chain has a length")),
    };
    let group = |text: &str| match text.split_once('x') {
        Some((count, of)) => vec![shape(of); count.parse().expect("a count")],
        None => vec![shape(text)],
    };
    name.split('_').filter(|text| *text != "M").flat_map(group).collect()
}
