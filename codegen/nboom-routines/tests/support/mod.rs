//! Satellites and states for any topology.
#![allow(dead_code, reason = "each test binary uses its own part")]

use nboom_formulation::Layout;
use nboom_model::{Shape, Topology};

/// Numbers that look random and are the same everywhere.
pub struct Numbers(pub u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }
}

/// Parameters of a satellite whose mass matrix is positive: light links on a heavy main body,
/// every inertia well above what its first moment demands.
pub fn parameters(
    topology: &Topology,
    assumptions: &[(usize, f64)],
    numbers: &mut Numbers,
) -> Vec<f64> {
    let mut all = body(100.0, numbers);
    for shape in topology.shapes() {
        let rot = nboom_scalar::Mat3::from_euler_121(
            numbers.within(-3.0, 3.0),
            numbers.within(-3.0, 3.0),
            numbers.within(-3.0, 3.0),
        );
        all.extend(rot.rows.into_iter().flat_map(nboom_scalar::Vec3::to_array));
        all.extend((0..3).map(|_| numbers.within(-1.0, 1.0)));
        for _ in 0..shape.hinges() {
            all.extend(body(1.0, numbers));
            all.extend((0..2).map(|_| numbers.within(0.2, 1.0)));
        }
    }
    for &(i, value) in assumptions {
        all[i] = value;
    }
    all
}

fn body(mass: f64, numbers: &mut Numbers) -> Vec<f64> {
    let mut body = vec![mass * numbers.within(1.0, 2.0)];
    body.extend((0..3).map(|_| mass * numbers.within(-0.3, 0.3)));
    body.extend((0..3).map(|_| mass * numbers.within(1.5, 2.0)));
    body.extend((0..3).map(|_| mass * numbers.within(-0.1, 0.1)));
    body
}

pub fn state(topology: &Topology, external: bool, numbers: &mut Numbers) -> Vec<f64> {
    let count = Layout::coordinates(topology);
    let mut state: Vec<f64> = (0..count).map(|_| numbers.within(-2.0, 2.0)).collect();
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
