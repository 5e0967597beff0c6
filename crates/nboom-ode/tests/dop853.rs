//! The stepper against closed forms: order, dense output, cut steps, refusals.

use nboom_ode::{Dop853, StepError, System, Tolerance};

/// ÿ = −y and ż = z cos t, whose solutions are cos t and exp(sin t).
struct Closed;

impl System for Closed {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1], dy[2]) = (y[1], -y[0], y[2] * t.cos());
    }
}

fn exact(t: f64) -> [f64; 3] {
    [t.cos(), -t.sin(), t.sin().exp()]
}

fn error(found: &[f64], t: f64) -> f64 {
    found.iter().zip(exact(t)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn started(tolerance: f64) -> Dop853 {
    let mut stepper = Dop853::new(Tolerance { relative: tolerance, absolute: tolerance });
    stepper.start(&mut Closed, 0.0, &exact(0.0), 3);
    stepper
}

/// Error at t = 4 of `count` equal steps.
fn with_equal_steps(count: usize) -> f64 {
    let mut stepper = started(1e-3);
    for _ in 0..count {
        stepper.retake(&mut Closed, 4.0 / count as f64);
        stepper.advance();
    }
    error(stepper.state(), stepper.time())
}

#[test]
fn the_order_is_eight() {
    let (coarse, fine) = (with_equal_steps(12), with_equal_steps(24));
    let order = (coarse / fine).log2();
    assert!((7.5..9.5).contains(&order), "order {order}: {coarse:e} {fine:e}");
}

#[test]
fn dense_output_is_of_order_seven_or_better() {
    let largest_inside = |step: f64| {
        let mut stepper = started(1e-3);
        stepper.retake(&mut Closed, step);
        stepper.prepare_dense(&mut Closed);
        let mut y = [0.0; 3];
        let at = |fraction: f64, y: &mut [f64]| {
            stepper.interpolate(fraction, y);
            error(y, fraction * step)
        };
        (1..10).map(|i| at(f64::from(i) / 10.0, &mut y)).fold(0.0, f64::max)
    };
    let order = (largest_inside(0.8) / largest_inside(0.4)).log2();
    assert!(order > 7.5, "local order {order}");
}

#[test]
fn polynomials_are_the_dense_output() {
    let mut stepper = started(1e-6);
    stepper.step(&mut Closed, 5.0).expect("a smooth problem");
    stepper.prepare_dense(&mut Closed);
    let mut middle = [0.0; 3];
    stepper.interpolate(0.5, &mut middle);
    for (i, expected) in middle.iter().enumerate() {
        let c = stepper.polynomial(i);
        let weights = [1.0, 7.0, 21.0, 35.0, 35.0, 21.0, 7.0, 1.0];
        let value: f64 = c.coefficients().iter().zip(weights).map(|(c, w)| c * w / 128.0).sum();
        assert!((value - expected).abs() < 1e-14);
    }
}

#[test]
fn smaller_tolerance_gives_smaller_error() {
    let at_ten = |tolerance: f64| {
        let mut stepper = started(tolerance);
        while stepper.time() < 10.0 {
            stepper.step(&mut Closed, 10.0).expect("a smooth problem");
            stepper.advance();
        }
        error(stepper.state(), 10.0)
    };
    let errors = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12].map(at_ten);
    assert!(errors.windows(2).all(|pair| pair[1] < pair[0]), "{errors:?}");
    assert!(errors[4] < 1e-11, "{errors:?}");
}

#[test]
fn a_limit_is_reached_exactly_and_does_not_shorten_later_steps() {
    let mut stepper = started(1e-9);
    stepper.step(&mut Closed, 10.0).expect("a smooth problem");
    stepper.advance();
    let (t, usual) = (stepper.time(), stepper.next_step());
    stepper.step(&mut Closed, t + 1e-6).expect("a smooth problem");
    stepper.advance();
    assert_eq!(stepper.time(), t + 1e-6);
    assert!(stepper.next_step() >= usual);
}

/// ẏ = y², which runs to infinity at t = 1.
struct Exploding;

impl System for Exploding {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[0] * y[0];
    }
}

#[test]
fn a_pole_ends_in_an_error_just_before_it() {
    let mut stepper = Dop853::new(Tolerance { relative: 1e-9, absolute: 1e-9 });
    stepper.start(&mut Exploding, 0.0, &[1.0], 1);
    let refused = (0..10_000).find_map(|_| {
        let refused = stepper.step(&mut Exploding, 2.0).err();
        stepper.advance();
        refused
    });
    let Some(StepError::Underflow { time, .. } | StepError::NotFinite { time, .. }) = refused
    else {
        panic!("{refused:?}")
    };
    assert!((time - 1.0).abs() < 1e-6, "{time}");
}

/// A derivative that is not a number.
struct Broken;

impl System for Broken {
    fn derivative(&mut self, _t: f64, _y: &[f64], dy: &mut [f64]) {
        dy.fill(f64::NAN);
    }
}

#[test]
fn a_derivative_that_is_not_a_number_is_refused() {
    let mut stepper = Dop853::new(Tolerance { relative: 1e-9, absolute: 1e-9 });
    stepper.start(&mut Broken, 0.0, &[1.0, 2.0], 2);
    let refused = stepper.step(&mut Broken, 1.0);
    assert!(matches!(refused, Err(StepError::NotFinite { variable: 0, .. })), "{refused:?}");
}
