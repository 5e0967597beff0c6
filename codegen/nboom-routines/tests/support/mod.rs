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
        all.extend(mount(numbers));
        for link in 0..shape.hinges() {
            let mut way = || [(); Layout::WAY].map(|()| numbers.between(0.2, 1.0));
            let Shape::Limb(limb) = shape else {
                let way = way();
                all.extend(body(1.0, numbers));
                all.extend(way);
                continue;
            };
            match Layout::mount(limb, link) {
                0 => {}
                Layout::WAY => all.extend(way()),
                _ => all.extend(mount(numbers)),
            }
            all.extend(body(1.0, numbers));
        }
    }
    for &(i, value) in assumptions {
        all[i] = value;
    }
    all
}

/// Any rotation, and a point.
fn mount(numbers: &mut Rng) -> Vec<f64> {
    let [a, b, c] = [(); 3].map(|()| numbers.between(-3.0, 3.0));
    let rows = nboom_scalar::Mat3::from_euler_121(a, b, c).rows;
    let mut mount: Vec<f64> = rows.into_iter().flat_map(nboom_scalar::Vec3::to_array).collect();
    mount.extend((0..3).map(|_| numbers.between(-1.0, 1.0)));
    mount
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
