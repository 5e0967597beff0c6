//! Every method against closed forms: order, dense output, cut steps, refusals.

use nboom_expr::Graph;
use nboom_ode::{Bernstein, Method, StepError, Stepper, System, Tolerance};
use nboom_scalar::Real;
use nboom_series::Series;

/// The series of an equation over any scalar.
macro_rules! series_of {
    ($rates:expr) => {
        fn series(&mut self, t: f64, y: &[f64], order: usize, out: &mut [f64]) -> bool {
            let size = y.len();
            let graph = Graph::trace(size + 1, |x| Vec::from($rates(x[size], &x[..size])));
            Series::new(&graph, &[], order).write(t, y, out);
            true
        }
    };
}

/// ÿ = −y and ż = z cos t, whose solutions are cos t and exp(sin t).
struct Closed;

fn rates<R: Real>(t: R, y: &[R]) -> [R; 3] {
    [y[1], -y[0], y[2] * t.sin_cos().1]
}

impl System for Closed {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy.copy_from_slice(&rates(t, y));
    }

    series_of!(rates);
}

fn exact(t: f64) -> [f64; 3] {
    [t.cos(), -t.sin(), t.sin().exp()]
}

fn error(found: &[f64], t: f64) -> f64 {
    found.iter().zip(exact(t)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn both(tolerance: f64) -> Tolerance {
    Tolerance { relative: tolerance, absolute: tolerance }
}

fn with_tolerance(method: Method, tolerance: f64) -> Box<dyn Stepper> {
    method.stepper(both(tolerance))
}

fn started(method: Method, tolerance: f64) -> Box<dyn Stepper> {
    let mut stepper = with_tolerance(method, tolerance);
    stepper.start(&mut Closed, 0.0, &exact(0.0), 3);
    stepper
}

/// A tolerance for steps of given length: what an iteration leaves is to be below the error of the step.
fn for_given_steps(method: Method) -> f64 {
    if method == Method::GaussLanes { 1e-14 } else { 1e-3 }
}

/// All whose order does not change from step to step.
fn of_one_order() -> impl Iterator<Item = Method> {
    Method::ALL.into_iter().filter(|&method| method != Method::Adams)
}

/// Error of `count` equal steps.
fn with_equal_steps(method: Method, step: f64, count: usize) -> f64 {
    let mut stepper = started(method, for_given_steps(method));
    for _ in 0..count {
        stepper.retake(&mut Closed, step);
        stepper.advance();
    }
    error(&stepper.window().state, stepper.window().time)
}

#[test]
fn the_order_is_what_the_table_says() {
    for method in of_one_order() {
        let order_of_method = method.order(both(1e-3));
        // Long enough for errors to be above rounding.
        let step = match order_of_method {
            16 => 4.0,
            13 => 2.0,
            9 => 1.5,
            _ => 1.0 / 3.0,
        };
        let coarse = with_equal_steps(method, step, 12);
        let fine = with_equal_steps(method, 0.5 * step, 24);
        let (order, expected) = ((coarse / fine).log2(), f64::from(order_of_method));
        let near = (expected - 0.5..expected + 1.5).contains(&order);
        assert!(near, "{method}: order {order}, {coarse:e} {fine:e}");
    }
}

#[test]
fn dense_output_has_the_order_of_the_table() {
    for method in of_one_order() {
        let largest_inside = |step: f64| {
            let mut stepper = started(method, for_given_steps(method));
            stepper.retake(&mut Closed, step);
            stepper.prepare_dense(&mut Closed);
            let mut y = [0.0; 3];
            let at = |fraction: f64, y: &mut [f64]| {
                stepper.interpolate(fraction, y);
                error(y, fraction * step)
            };
            (1..10).map(|i| at(f64::from(i) / 10.0, &mut y)).fold(0.0, f64::max)
        };
        // Short enough for the order to show, long enough not to be lost in rounding.
        let step = if method.order(both(1e-3)) > 5 { 0.8 } else { 0.1 };
        let local = (largest_inside(step) / largest_inside(0.5 * step)).log2();
        assert!(
            local > f64::from(method.dense_order(both(1e-3))) + 0.5,
            "{method}: local order {local}"
        );
    }
}

#[test]
fn polynomials_are_the_dense_output() {
    for method in Method::ALL {
        let mut stepper = started(method, 1e-6);
        stepper.step(&mut Closed, 5.0).expect("a smooth problem");
        stepper.prepare_dense(&mut Closed);
        let mut middle = [0.0; 3];
        stepper.interpolate(0.5, &mut middle);
        for (i, expected) in middle.iter().enumerate() {
            let value = at_the_middle(stepper.polynomial(i).coefficients());
            assert!((value - expected).abs() < 1e-14, "{method}: {value} {expected}");
        }
    }
}

#[test]
fn a_polynomial_has_derivatives_inside_and_beyond() {
    // 1 − 2 x + 3 x³, and constants and straight lines, which bend nowhere.
    let cubic = Bernstein::of_powers(&[1.0, -2.0, 0.0, 3.0]);
    let line = Bernstein::of_powers(&[0.5, 2.0]);
    for x in [-0.5_f64, 0.0, 0.3, 1.0, 2.5] {
        let of_cubic = [1.0 - 2.0 * x + 3.0 * x.powi(3), -2.0 + 9.0 * x * x, 18.0 * x];
        for (found, expected) in [
            (cubic.derivatives(x), of_cubic),
            (line.derivatives(x), [0.5 + 2.0 * x, 2.0, 0.0]),
            (Bernstein::new(&[7.0]).derivatives(x), [7.0, 0.0, 0.0]),
        ] {
            let largest = expected.iter().fold(1.0, |m: f64, e| m.max(e.abs()));
            for (found, expected) in found.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-13 * largest, "{x}: {found} {expected}");
            }
        }
    }
}

#[test]
fn a_value_of_zero_at_an_end_is_not_the_root_between() {
    // (x − ¼)(x − 1), x (¼ − x), and the first one a rounding lower at its end.
    for polynomial in [
        Bernstein::of_powers(&[0.25, -1.25, 1.0]),
        Bernstein::of_powers(&[0.0, 0.25, -1.0]),
        Bernstein::new(&[0.25, -0.375, -1e-18]),
    ] {
        let root = polynomial.leaves_side(1.0).expect("it is negative later");
        assert!((root - 0.25).abs() < 1e-13, "{root}");
    }
}

/// De Casteljau's means of means.
fn at_the_middle(coefficients: &[f64]) -> f64 {
    let mut row = coefficients.to_vec();
    while row.len() > 1 {
        row = row.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    }
    row[0]
}

/// Below this an error is one of rounding.
const ROUNDING: f64 = 1e-14;

#[test]
fn smaller_tolerance_gives_smaller_error() {
    for method in Method::ALL {
        let at_ten = |tolerance: f64| {
            let mut stepper = started(method, tolerance);
            while stepper.window().time < 10.0 {
                stepper.step(&mut Closed, 10.0).expect("a smooth problem");
                stepper.advance();
            }
            error(&stepper.window().state, 10.0)
        };
        let tolerances = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];
        let errors = tolerances.map(at_ten);
        let falls = |pair: &[f64]| pair[1] < pair[0] || pair[1] < ROUNDING;
        assert!(errors.windows(2).all(falls), "{method}: {errors:?}");
        // An error of some tolerances in each unit of time.
        let loose = errors.iter().zip(tolerances).find(|(error, t)| **error > 100.0 * t);
        assert!(loose.is_none(), "{method}: {errors:?}");
    }
}

#[test]
fn no_step_is_longer_than_allowed() {
    for method in Method::ALL {
        let mut stepper = with_tolerance(method, 1e-3);
        let longest = 0.013;
        stepper.limit_steps(longest);
        stepper.start(&mut Closed, 0.0, &exact(0.0), 3);
        while stepper.window().time < 1.0 {
            stepper.step(&mut Closed, 1.0).expect("a smooth problem");
            let length = stepper.window().length();
            // A hundredth more reaches the end.
            assert!(length <= 1.01 * longest && stepper.window().next_step <= longest, "{method}");
            stepper.advance();
        }
        // At this tolerance steps would be about as long as the whole.
        assert!(stepper.window().counts.accepted < 100, "{method}");
    }
}

#[test]
fn a_limit_is_reached_exactly_and_does_not_shorten_later_steps() {
    for method in Method::ALL {
        let mut stepper = started(method, 1e-9);
        stepper.step(&mut Closed, 10.0).expect("a smooth problem");
        stepper.advance();
        let (t, usual) = (stepper.window().time, stepper.window().next_step);
        stepper.step(&mut Closed, t + 1e-6).expect("a smooth problem");
        stepper.advance();
        assert_eq!(stepper.window().time, t + 1e-6, "{method}");
        assert!(stepper.window().next_step >= usual, "{method}");
    }
}

/// An attitude that is turned at a given rate, linear in its four variables.
struct Turned;

impl Turned {
    fn rates<R: Real>(t: R, y: &[R]) -> [R; 4] {
        let (sin, cos) = t.sin_cos();
        let [a, b, c] = [R::constant(0.35), R::constant(0.2) * cos, R::constant(0.2) * sin];
        [
            -a * y[1] - b * y[2] - c * y[3],
            a * y[0] + c * y[2] - b * y[3],
            b * y[0] - c * y[1] + a * y[3],
            c * y[0] + b * y[1] - a * y[2],
        ]
    }
}

impl System for Turned {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy.copy_from_slice(&Self::rates(t, y));
    }

    series_of!(Self::rates);
}

#[test]
fn scaling_what_is_linear_commutes_with_steps() {
    for method in Method::ALL {
        let end = |factor: f64| {
            let mut stepper = with_tolerance(method, 1e-6);
            stepper.start(&mut Turned, 0.0, &[0.5, -0.5, 0.7, 0.1], 4);
            for step in 0..12 {
                if step == 5 {
                    stepper.scale(0..4, factor);
                }
                let end = 0.2 * f64::from(step + 1);
                while stepper.window().time < end {
                    stepper.step(&mut Turned, end).expect("a smooth problem");
                    stepper.advance();
                }
            }
            stepper.window().state.clone()
        };
        // Too little to change a decision on step sizes, and far more than rounding or the
        // error of an iteration that has to converge to 1e-3 of the tolerance.
        let factor = 1.0 + 1e-6;
        for (scaled, plain) in end(factor).iter().zip(end(1.0)) {
            assert!((scaled - factor * plain).abs() < 1e-11, "{method}: {scaled} {plain}");
        }
    }
}

/// ẏ = y², which runs to infinity at t = 1.
struct Exploding;

impl System for Exploding {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[0] * y[0];
    }

    series_of!(|_, y: &[_]| [y[0] * y[0]]);
}

#[test]
fn a_pole_ends_in_an_error_just_before_it() {
    for method in Method::ALL {
        let mut stepper = with_tolerance(method, 1e-9);
        stepper.start(&mut Exploding, 0.0, &[1.0], 1);
        let refused = (0..100_000).find_map(|_| {
            let refused = stepper.step(&mut Exploding, 2.0).err();
            stepper.advance();
            refused
        });
        let Some(StepError::Underflow { time, .. } | StepError::NotFinite { time, .. }) = refused
        else {
            panic!("{method}: {refused:?}")
        };
        assert!((time - 1.0).abs() < 1e-6, "{method}: {time}");
    }
}

/// A derivative that is not a number.
struct Broken;

impl System for Broken {
    fn derivative(&mut self, _t: f64, _y: &[f64], dy: &mut [f64]) {
        dy.fill(f64::NAN);
    }

    fn series(&mut self, _t: f64, _y: &[f64], _order: usize, out: &mut [f64]) -> bool {
        out.fill(f64::NAN);
        true
    }
}

#[test]
fn a_derivative_that_is_not_a_number_is_refused() {
    for method in Method::ALL {
        let mut stepper = with_tolerance(method, 1e-9);
        stepper.start(&mut Broken, 0.0, &[1.0, 2.0], 2);
        let refused = stepper.step(&mut Broken, 1.0);
        let named = matches!(refused, Err(StepError::NotFinite { variable: 0, .. }));
        assert!(named, "{method}: {refused:?}");
    }
}

#[test]
fn names_are_found_again() {
    for method in Method::ALL {
        assert_eq!(Method::named(method.name()), Some(method));
    }
    assert_eq!(Method::named("euler"), None);
}

/// A derivative and nothing else.
struct Plain;

impl System for Plain {
    fn derivative(&mut self, _t: f64, _y: &[f64], dy: &mut [f64]) {
        dy.fill(1.0);
    }
}

#[test]
fn a_system_without_power_series_is_refused_by_the_method_that_needs_them() {
    for method in Method::ALL {
        let mut stepper = with_tolerance(method, 1e-9);
        stepper.start(&mut Plain, 0.5, &[1.0], 1);
        let taken = stepper.step(&mut Plain, 1.0);
        let refused = matches!(taken, Err(StepError::NoSeries { time: 0.5 }));
        assert_eq!(refused, method == Method::Taylor, "{method}: {taken:?}");
    }
}

#[test]
fn explicit_steps_are_those_of_runge_kutta_and_of_what_chooses_them() {
    let explicit = Method::ALL.into_iter().filter(|method| method.takes_explicit_steps());
    assert_eq!(explicit.collect::<Vec<_>>(), [Method::Auto, Method::Dopri5, Method::Dop853]);
}
