//! Adams' method: its orders, its steps over the last ones, and when it leaves a motion to another one.

mod pendulum;

use nboom_ode::{Automatic, Method, StepError, Stepper, System};

use pendulum::{Pendulum, energy, tolerance};

/// Steps to `end`; the error of the energy and the evaluations.
fn swing(method: Method, relative: f64, end: f64) -> (f64, usize) {
    let mut stepper = method.stepper(tolerance(relative));
    stepper.start(&mut Pendulum, 0.0, &[2.0, 0.0], 2);
    while stepper.window().time < end {
        stepper.step(&mut Pendulum, end).expect("a smooth problem");
        stepper.advance();
    }
    let window = stepper.window();
    ((energy(&window.state) - energy(&[2.0, 0.0])).abs(), window.counts.evaluations)
}

#[test]
fn a_long_smooth_motion_takes_fewer_evaluations_to_about_the_same_error() {
    for (relative, share) in [(1e-7, 0.75), (1e-9, 0.65), (1e-11, 0.6), (1e-13, 0.5)] {
        let (error, evaluations) = swing(Method::Adams, relative, 200.0);
        let (error_of_explicit, of_explicit) = swing(Method::Dop853, relative, 200.0);
        let most = share * of_explicit as f64;
        assert!((evaluations as f64) < most, "{relative}: {evaluations} {of_explicit}");
        assert!(error < 10.0 * error_of_explicit, "{relative}: {error} {error_of_explicit}");
    }
}

#[test]
fn the_order_rises_with_the_demand() {
    // Of order 12 a millionth of the error takes 10^(6/13) = 2.9 times the steps, of order 4 fifteen times.
    let [loose, tight] = [1e-6, 1e-12].map(|relative| swing(Method::Adams, relative, 200.0).1);
    assert!(tight < 4 * loose, "{loose} {tight}");
}

#[test]
fn each_step_evaluates_twice() {
    let mut stepper = Method::Adams.stepper(tolerance(1e-10));
    stepper.start(&mut Pendulum, 0.0, &[2.0, 0.0], 2);
    let started = stepper.window().counts.evaluations;
    while stepper.window().time < 50.0 {
        stepper.step(&mut Pendulum, 50.0).expect("a smooth problem");
        // Dense output needs no more.
        stepper.prepare_dense(&mut Pendulum);
        stepper.advance();
    }
    let counts = stepper.window().counts;
    assert_eq!(counts.evaluations - started, 2 * counts.accepted + counts.rejected);
}

/// ẏ = (t + 1)ᵈ for each degree d, so that a formula of order k is exact up to degree k.
struct Powers;

impl System for Powers {
    fn derivative(&mut self, t: f64, _y: &[f64], dy: &mut [f64]) {
        dy.iter_mut().zip(0..).for_each(|(dy, degree)| *dy = (t + 1.0).powi(degree));
    }
}

#[test]
fn formulas_over_uneven_steps_are_exact_for_polynomials() {
    const DEGREES: usize = 9;
    let integral = |t: f64, degree: usize| {
        let power = degree as i32 + 1;
        ((t + 1.0).powi(power) - 1.0) / f64::from(power)
    };
    let mut stepper = Method::Adams.stepper(tolerance(1e-9));
    stepper.start(&mut Powers, 0.0, &[0.0; DEGREES], DEGREES);
    // The order rises with each of the first steps; later ones are cut to uneven lengths and taken again.
    for _ in 0..14 {
        stepper.step(&mut Powers, 1e3).expect("a smooth problem");
        stepper.advance();
    }
    let usual = stepper.window().next_step;
    let mut y = [0.0; DEGREES];
    for share in [1.0, 0.31, 0.77, 0.05, 1.3, 0.5] {
        let before = stepper.window().clone();
        stepper.retake(&mut Powers, share * usual);
        stepper.prepare_dense(&mut Powers);
        for fraction in [0.2, 0.5, 0.9, 1.0] {
            stepper.interpolate(fraction, &mut y);
            let t = before.time + fraction * share * usual;
            for (degree, y) in y.iter().enumerate() {
                let change = integral(t, degree) - integral(before.time, degree);
                let found = y - before.state[degree];
                let scale = integral(t, degree).abs().max(1.0);
                assert!(
                    (found - change).abs() < 1e-13 * scale,
                    "{degree} {fraction}: {found} {change}"
                );
            }
        }
        stepper.advance();
    }
}

#[test]
fn the_polynomial_of_a_step_joins_its_ends() {
    let mut stepper = Method::Adams.stepper(tolerance(1e-8));
    stepper.start(&mut Pendulum, 0.0, &[2.0, 0.0], 2);
    let mut y = [0.0; 2];
    for _ in 0..60 {
        stepper.step(&mut Pendulum, 100.0).expect("a smooth problem");
        stepper.prepare_dense(&mut Pendulum);
        for (fraction, end) in
            [(0.0, stepper.window().state.clone()), (1.0, stepper.window().end_state.clone())]
        {
            stepper.interpolate(fraction, &mut y);
            let furthest = y.iter().zip(&end).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(furthest < 1e-14, "{fraction}: {furthest}");
        }
        stepper.advance();
    }
}

/// An oscillator of rate `turning` with some `damping`, beside ẏ = cos t.
struct Beside {
    turning: f64,
    damping: f64,
}

impl System for Beside {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = t.cos();
        dy[1] = self.turning * y[2];
        dy[2] = -self.turning * y[1] - self.damping * y[2];
    }
}

/// Methods in the order in which they were taken, beginning with an amplitude of the oscillator.
fn methods(mut system: Beside, amplitude: f64, relative: f64) -> Vec<Method> {
    let mut automatic = Automatic::new(tolerance(relative));
    automatic.start(&mut system, 0.0, &[0.0, amplitude, 0.0], 3);
    let mut methods = vec![automatic.choice().method];
    while automatic.window().time < 40.0 {
        automatic.step(&mut system, 40.0).expect("a bounded motion");
        automatic.advance();
        let method = automatic.choice().method;
        if methods.last() != Some(&method) {
            methods.push(method);
        }
    }
    methods
}

#[test]
fn what_accuracy_bounds_goes_on_and_what_stability_bounds_does_not() {
    use Method::{Adams, Dop853};
    for relative in [1e-7, 1e-9, 1e-12] {
        let seen = Beside { turning: 100.0, damping: 0.0 };
        assert_eq!(methods(seen, 1.0, relative), [Dop853, Adams], "{relative}");
        let slow = Beside { turning: 1.0, damping: 0.1 };
        assert_eq!(methods(slow, 1.0, relative), [Dop853, Adams], "{relative}");
        for damping in [0.0, 300.0] {
            let unseen = Beside { turning: 1000.0, damping };
            let methods = methods(unseen, 1e-3 * relative, relative);
            assert!(!methods.contains(&Adams), "{relative} {damping}: {methods:?}");
        }
    }
}

/// So many pendulums, each as if it were alone.
struct Pendulums;

impl System for Pendulums {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        for (y, dy) in y.chunks_exact(2).zip(dy.chunks_exact_mut(2)) {
            Pendulum.derivative(t, y, dy);
        }
    }
}

#[test]
fn variables_are_all_alike_whatever_their_number() {
    let end = |count: usize| {
        let mut stepper = Method::Adams.stepper(tolerance(1e-10));
        stepper.start(&mut Pendulums, 0.0, &[2.0, 0.0].repeat(count), 2 * count);
        while stepper.window().time < 20.0 {
            stepper.step(&mut Pendulums, 20.0).expect("a smooth problem");
            stepper.advance();
        }
        stepper.window().state.clone()
    };
    let alone = end(1);
    // Sums over lanes are rounded otherwise, steps follow, and each end errs by some tolerances.
    for count in [2, 4, 5, 8, 12, 33] {
        for (i, found) in end(count).iter().enumerate() {
            assert!((found - alone[i % 2]).abs() < 1e-8, "{i} of {count}: {found}");
        }
    }
}

#[test]
fn a_start_far_from_the_origin_of_time_is_a_step_or_a_refusal() {
    for method in Method::ALL.into_iter().filter(|&method| method != Method::Taylor) {
        for turning in [1.0, 100.0, 1e4] {
            let mut system = Beside { turning, damping: 0.0 };
            let mut stepper = method.stepper(tolerance(1e-12));
            stepper.start(&mut system, 1.7e9, &[0.0, 1.0, 0.0], 3);
            match stepper.step(&mut system, 1.7e9 + 1.0) {
                Ok(()) | Err(StepError::Underflow { .. }) => {}
                refused => panic!("{method}: {refused:?}"),
            }
        }
    }
}

/// A pendulum whose slope is no number in one evaluation.
struct Interrupted {
    evaluations: usize,
    broken: usize,
}

impl System for Interrupted {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.evaluations += 1;
        Pendulum.derivative(t, y, dy);
        if self.evaluations == self.broken {
            dy.fill(f64::NAN);
        }
    }
}

#[test]
fn a_step_whose_slope_is_no_number_is_taken_again() {
    // Of the predictor and of the corrector, after two for the start.
    for broken in [41, 42] {
        let mut system = Interrupted { evaluations: 0, broken };
        let mut stepper = Method::Adams.stepper(tolerance(1e-9));
        stepper.start(&mut system, 0.0, &[2.0, 0.0], 2);
        while stepper.window().time < 20.0 {
            stepper.step(&mut system, 20.0).expect("a number the next time");
            stepper.advance();
        }
        let error = (energy(&stepper.window().state) - energy(&[2.0, 0.0])).abs();
        assert!(error < 1e-7, "{broken}: {error}");
    }
}
