//! A pendulum for tests of several methods.

use nboom_ode::{System, Tolerance};

/// θ̈ = −sin θ.
pub struct Pendulum;

impl System for Pendulum {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1]) = (y[1], -y[0].sin());
    }
}

/// Of unit mass and length.
pub fn energy(y: &[f64]) -> f64 {
    0.5 * y[1] * y[1] - y[0].cos()
}

pub fn tolerance(relative: f64) -> Tolerance {
    Tolerance { relative, absolute: relative }
}
