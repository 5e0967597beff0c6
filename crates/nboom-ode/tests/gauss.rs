//! What Gauss's method is for: invariants, reversal, equal steps.

mod pendulum;

use nboom_ode::{Gauss, RungeKutta, Stepper, System};

use pendulum::{Pendulum, energy, tolerance};

/// Euler's equations, whose energy and squared momentum are quadratic.
struct Top;

const MOMENTS: [f64; 3] = [1.0, 2.0, 2.6];

impl System for Top {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let [a, b, c] = MOMENTS;
        dy[0] = (b - c) / a * y[1] * y[2];
        dy[1] = (c - a) / b * y[2] * y[0];
        dy[2] = (a - b) / c * y[0] * y[1];
    }
}

fn quadratic(power: i32, y: &[f64]) -> f64 {
    MOMENTS.iter().zip(y).map(|(moment, y)| moment.powi(power) * y * y).sum()
}

/// Steps of this length, whatever their error.
fn stride(stepper: &mut dyn Stepper, system: &mut dyn System, step: f64, count: usize) {
    for _ in 0..count {
        stepper.retake(system, step);
        stepper.advance();
    }
}

#[test]
fn quadratic_invariants_are_kept_by_steps_that_err() {
    let start = [0.7, 0.3, 0.9];
    let (mut coarse, mut fine) = (Gauss::new(tolerance(1e-6)), Gauss::new(tolerance(1e-12)));
    coarse.start(&mut Top, 0.0, &start, 3);
    fine.start(&mut Top, 0.0, &start, 3);
    stride(&mut coarse, &mut Top, 3.0, 10_000);
    stride(&mut fine, &mut Top, 1.0, 30_000);
    let (coarse, fine) = (&coarse.window().state, &fine.window().state);
    let error = coarse.iter().zip(fine).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(error > 1e-6, "{error:e}: the steps were meant to be too long");
    for power in [1, 2] {
        let drift = quadratic(power, coarse) / quadratic(power, &start) - 1.0;
        // A random walk of 1e4 roundings.
        assert!(drift.abs() < 2e-14, "{power}: {drift:e}");
    }
}

#[test]
fn steps_that_err_are_undone_by_steps_back() {
    let start = [2.5, 0.4];
    let mut stepper = Gauss::new(tolerance(1e-6));
    stepper.start(&mut Pendulum, 0.0, &start, 2);
    stride(&mut stepper, &mut Pendulum, 3.0, 40);
    let error = energy(&stepper.window().state) - energy(&start);
    assert!(error.abs() > 1e-9, "{error:e}: the steps were meant to be too long");
    stride(&mut stepper, &mut Pendulum, -3.0, 40);
    for (back, start) in stepper.window().state.iter().zip(start) {
        // Rounding of 80 steps, magnified by the motion less than a thousand times.
        assert!((back - start).abs() < 1e-12, "{back} {start}");
    }
}

/// Largest errors in energy over the first and the second half of this many steps.
fn halves(stepper: &mut dyn Stepper, step: f64, count: usize) -> [f64; 2] {
    let start = [2.0, 0.0];
    stepper.start(&mut Pendulum, 0.0, &start, 2);
    [0, 1].map(|_| {
        let each = (0..count / 2).map(|_| {
            stride(stepper, &mut Pendulum, step, 1);
            (energy(&stepper.window().state) - energy(&start)).abs()
        });
        each.fold(0.0, f64::max)
    })
}

#[test]
fn errors_in_energy_do_not_grow() {
    let [first, second] = halves(&mut Gauss::new(tolerance(1e-6)), 3.0, 20_000);
    assert!(first > 1e-10, "{first:e}: the steps were meant to be too long");
    assert!(second < 1.1 * first, "{first:e} {second:e}");
    // Those of a method without structure do, in proportion to time.
    let [first, second] = halves(&mut RungeKutta::dop853(tolerance(1e-6)), 0.5, 20_000);
    assert!(second > 1.8 * first, "{first:e} {second:e}");
}

#[test]
fn steps_to_a_limit_are_equal() {
    let (limit, mut lengths) = (100.0, Vec::new());
    let mut stepper = Gauss::new(tolerance(1e-10));
    stepper.start(&mut Top, 0.0, &[0.7, 0.3, 0.9], 3);
    while stepper.window().time < limit {
        stepper.step(&mut Top, limit).expect("a smooth problem");
        lengths.push(stepper.window().length());
        stepper.advance();
    }
    assert_eq!(stepper.window().counts.rejected, 0);
    assert_eq!(stepper.window().time, limit);
    // Times are rounded to 1e-14.
    assert!(lengths.iter().all(|length| (length - lengths[0]).abs() < 1e-13), "{lengths:?}");
}

/// An oscillation that turns faster and faster.
struct Chirp;

impl System for Chirp {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        let rate = t.exp();
        (dy[0], dy[1]) = (rate * y[1], -rate * y[0]);
    }
}

#[test]
fn steps_are_shortened_for_good_where_the_motion_demands_it() {
    let limit = 4.0;
    let mut stepper = Gauss::new(tolerance(1e-10));
    stepper.start(&mut Chirp, 0.0, &[0.0, 1.0], 2);
    let mut last = f64::INFINITY;
    while stepper.window().time < limit {
        stepper.step(&mut Chirp, limit).expect("a smooth problem");
        let length = stepper.window().length();
        assert!(length < last * (1.0 + 1e-12), "{length} after {last}");
        last = length;
        stepper.advance();
    }
    let counts = stepper.window().counts;
    assert!((3..40).contains(&counts.rejected), "{counts:?}");
    let phase = limit.exp() - 1.0;
    let error = (stepper.window().state[0] - phase.sin()).abs();
    // Some 200 steps, each within the tolerance.
    assert!(error < 2e-8, "{error:e}");
}

/// Nothing but time.
struct Clock;

impl System for Clock {
    fn derivative(&mut self, _t: f64, _y: &[f64], dy: &mut [f64]) {
        dy[0] = 1.0;
    }
}

#[test]
fn what_rounding_takes_from_one_step_the_next_ones_give_back() {
    let (step, count) = (0.1, 100_000);
    let mut stepper = Gauss::new(tolerance(1e-10));
    stepper.start(&mut Clock, 0.0, &[0.0], 1);
    stride(&mut stepper, &mut Clock, step, count);
    // The sum of as many tenths, each added to what is there with a rounding, is off by 1.9e-8.
    let plain = (0..count).fold(0.0, |sum, _| sum + step);
    let exact = step * count as f64;
    assert!((plain - exact).abs() > 1e-8, "{plain}");
    // Eight increments make a step, to some roundings of a tenth each.
    let off = (stepper.window().state[0] - exact).abs();
    assert!(off < 1e-16 * count as f64, "{off:e}");
}
