//! Decays that are seen at once.

use nboom_ode::{Automatic, Method, Stepper, System};

use crate::tolerance;

/// ẏ = −rate (y − cos t) − sin t with its Jacobian, and an oscillator ẍ = −turning² x − damping ẋ by x and ẋ/scale.
#[derive(Clone, Copy)]
struct Decaying {
    rate: f64,
    turning: f64,
    damping: f64,
    scale: f64,
    /// Size of the two variables.
    turned: f64,
}

impl System for Decaying {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = -self.rate * (y[0] - t.cos()) - t.sin();
        dy[1] = self.scale * y[2];
        dy[2] = -self.turning.powi(2) / self.scale * y[1] - self.damping * y[2];
    }

    fn jacobian(&mut self, _t: f64, _y: &[f64], out: &mut [f64]) -> bool {
        let back = -self.turning.powi(2) / self.scale;
        let row = [0.0, back, -self.damping];
        out.copy_from_slice(&[-self.rate, 0.0, 0.0, 0.0, 0.0, self.scale, row[0], row[1], row[2]]);
        true
    }
}

/// Explicit steps before the first implicit one, if there is one.
fn explicit_steps(mut system: Decaying, end: f64) -> Option<usize> {
    let mut automatic = Automatic::new(tolerance(1e-8));
    let start = [1.0, 0.0, system.turned];
    automatic.start(&mut system, 0.0, &start, 3);
    let mut steps = 0;
    while automatic.window().time < end {
        automatic.step(&mut system, end).expect("a bounded motion");
        automatic.advance();
        match automatic.choice().method {
            Method::Dop853 | Method::Adams => steps += 1,
            _ => return Some(steps),
        }
    }
    None
}

#[test]
fn no_jacobian_is_asked_for_where_few_steps_could_follow() {
    let mut system = Decaying { rate: 1e5, turning: 1.0, damping: 0.0, scale: 1.0, turned: 1.0 };
    let mut automatic = Automatic::new(tolerance(1e-8));
    automatic.start(&mut system, 0.0, &[1.0, 0.0, 1.0], 3);
    // Stability bounds some seventy steps.
    while automatic.window().time < 5e-3 && automatic.choice().method == Method::Dop853 {
        automatic.step(&mut system, 5e-3).expect("a bounded motion");
        automatic.advance();
        let is_explicit = automatic.choice().method == Method::Dop853;
        assert!(!is_explicit || automatic.window().counts.jacobians == 0);
    }
}

#[test]
fn a_decay_that_would_bound_many_steps_is_seen_at_once() {
    let plain = Decaying { rate: 1e5, turning: 1.0, damping: 0.0, scale: 1.0, turned: 1.0 };
    let clear = explicit_steps(plain, 10.0);
    // The first step bounded by stability is enough, and the motion begins on its slow part.
    assert!(clear.is_some_and(|steps| steps < 12), "{clear:?}");
    // Where it bounds few steps until something happens, or what is fast turns, fifteen have to show it.
    let short = explicit_steps(plain, 3e-3);
    assert!(short.is_none_or(|steps| steps >= 15), "{short:?}");
    // In units of which one is far larger than the other, too.
    for (damping, scale) in [(0.0, 1e5), (2e4, 1e5), (0.0, 1.0), (2e4, 1.0)] {
        let turned = 1e-12 / scale;
        let turning = Decaying { rate: 1.0, turning: 1e5, damping, scale, turned };
        let steps = explicit_steps(turning, 10.0);
        assert!(steps.is_some_and(|steps| steps >= 15), "{damping} {scale}: {steps:?}");
    }
    let accurate = Decaying { rate: 1.0, turning: 1e2, scale: 1e2, ..plain };
    assert_eq!(explicit_steps(accurate, 10.0), None);
}
