//! The end of a step that is moved a little, and steps that go on where a system has changed.

use nboom_ode::{Method, Stepper, System, Tolerance, Window};

/// ÿ = −y, which y = sin t solves.
struct Oscillator {
    evaluations: usize,
}

impl System for Oscillator {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        self.evaluations += 1;
        (dy[0], dy[1]) = (y[1], -y[0]);
    }
}

const TOLERANCE: Tolerance = Tolerance { relative: 1e-9, absolute: 1e-9 };

/// A stepper of the method that has taken a step of the oscillator from t = 0.
fn after_a_step(method: Method) -> (Box<dyn Stepper>, Oscillator) {
    let (mut system, mut stepper) = (Oscillator { evaluations: 0 }, method.stepper(TOLERANCE));
    stepper.start(&mut system, 0.0, &[0.0, 1.0], 2);
    stepper.step(&mut system, 0.1).expect("a smooth motion");
    (stepper, system)
}

/// The distance of the end from the oscillator's motion, which turns with it.
fn error_at_end(window: &Window) -> f64 {
    let (sin, cos) = window.end_time.sin_cos();
    (window.end_state[0] - sin).hypot(window.end_state[1] - cos)
}

/// All but the one that takes power series, which this system has none of.
fn methods() -> impl Iterator<Item = Method> {
    Method::ALL.into_iter().filter(|&method| method != Method::Taylor)
}

#[test]
fn an_end_that_is_moved_is_on_the_motion() {
    let mut moved = Vec::new();
    for method in methods() {
        for by in [1e-6, -1e-6, 3e-5] {
            let (mut stepper, mut system) = after_a_step(method);
            let before = stepper.window().clone();
            if !stepper.move_end(&mut system, by) {
                assert_eq!(stepper.window().end_state, before.end_state, "{method}");
                assert_eq!(stepper.window().end_time, before.end_time, "{method}");
                continue;
            }
            moved.push(method);
            let window = stepper.window();
            assert_eq!(window.end_time, before.end_time + by);
            assert_eq!(window.counts.evaluations, system.evaluations);
            // The step's own error, by³/6 of the parabola, and a rounding.
            let allowed = error_at_end(&before) + by.abs().powi(3) + f64::EPSILON;
            let error = error_at_end(window);
            assert!(error < allowed, "{method}: {error:e}, {allowed:e}");
            // The next step starts there.
            stepper.advance();
            stepper.step(&mut system, 0.2).expect("a smooth motion");
            let window = stepper.window();
            let error = (window.end_state[0] - window.end_time.sin()).abs();
            assert!(error < 3.0 * TOLERANCE.absolute, "{method}: {error}");
        }
    }
    assert!(moved.contains(&Method::Dop853) && moved.contains(&Method::Auto));
}

#[test]
fn an_end_is_not_moved_as_far_as_the_motion_bends() {
    for method in methods() {
        let (mut stepper, mut system) = after_a_step(method);
        // Half of this squared, the bend of the motion, is far above the tolerance.
        assert!(!stepper.move_end(&mut system, 1e-2), "{method}");
    }
}

/// A stepper of the method that has taken three steps, as long as it chooses, with dense output of the last.
fn within_steps(method: Method) -> (Box<dyn Stepper>, Oscillator) {
    let (mut system, mut stepper) = (Oscillator { evaluations: 0 }, method.stepper(TOLERANCE));
    stepper.start(&mut system, 0.0, &[0.0, 1.0], 2);
    for _ in 0..3 {
        stepper.advance();
        stepper.step(&mut system, 100.0).expect("a smooth motion");
    }
    stepper.prepare_dense(&mut system);
    (stepper, system)
}

#[test]
fn a_step_that_ends_inside_is_on_the_motion() {
    let mut end_inside = Vec::new();
    for method in methods() {
        let (mut stepper, system) = within_steps(method);
        let before = stepper.window().clone();
        for fraction in [0.1, 0.5, 0.9, 0.987, 0.99, 1.0, 1.005] {
            if !stepper.end_inside(fraction) {
                let near = (fraction - 1.0_f64).abs() < 0.015;
                assert!(!(near && stepper.ends_inside()), "{method} {fraction}");
                continue;
            }
            assert!(stepper.ends_inside() && fraction > 0.9, "{method}");
            let window = stepper.window();
            let expected = before.time + fraction * before.length();
            assert!((window.end_time - expected).abs() < 1e-15, "{method} {fraction}");
            // As good as a step that is taken to there, but for a tenth of the tolerance.
            let (mut other, mut of_other) = within_steps(method);
            other.retake(&mut of_other, window.length());
            let allowed = error_at_end(other.window()) + 0.1 * TOLERANCE.absolute;
            let error = error_at_end(window);
            assert!(error < allowed, "{method} {fraction}: {error:e}, {allowed:e}");
            end_inside.push((method, fraction));
        }
        assert_eq!(stepper.window().counts.evaluations, system.evaluations, "{method}");
    }
    for method in [Method::Auto, Method::Dopri5, Method::Dop853, Method::GaussLanes] {
        assert!(end_inside.contains(&(method, 0.987)), "{method}");
    }
}

#[test]
fn a_step_that_does_not_end_inside_stays_as_it_is() {
    for method in methods() {
        let (mut stepper, mut system) = within_steps(method);
        let before = stepper.window().clone();
        assert!(!stepper.end_inside(0.5), "{method}");
        assert_eq!(stepper.window().end_time, before.end_time, "{method}");
        assert_eq!(stepper.window().end_state, before.end_state, "{method}");
        // Nor without dense output of its own.
        stepper.advance();
        stepper.step(&mut system, 100.0).expect("a smooth motion");
        assert!(!stepper.end_inside(1.0), "{method}");
    }
}

#[test]
fn slopes_at_a_start_are_those_of_the_motion() {
    for method in methods() {
        let (mut stepper, mut system) = within_steps(method);
        stepper.restart(&mut system, 2.0, &[0.6, 0.8], 2);
        let found = stepper.slopes();
        assert_eq!(found, stepper.ends_inside().then_some(&[0.8, -0.6][..]), "{method}");
    }
}

#[test]
fn a_step_in_which_rounding_is_all_that_is_left_is_not_refused() {
    for relative in [1e-4, 1e-6, 1e-9, 1e-12] {
        for step in [1e-3, 1e-6, 1e-9] {
            let tolerance = Tolerance { relative, absolute: relative };
            let mut stepper = Method::GaussLanes.stepper(tolerance);
            let mut system = Oscillator { evaluations: 0 };
            stepper.start(&mut system, 0.0, &[0.0, 1.0], 2);
            stepper.step(&mut system, step).expect("a smooth motion");
            let window = stepper.window();
            assert_eq!((window.end_time, window.counts.rejected), (step, 0), "{relative:e}");
        }
    }
}

#[test]
fn a_restart_goes_on_with_the_step_it_had_or_finds_one() {
    for method in methods() {
        let (mut stepper, mut system) = after_a_step(method);
        for _ in 0..20 {
            stepper.advance();
            let limit = stepper.window().time + 10.0;
            stepper.step(&mut system, limit).expect("a smooth motion");
        }
        let (had, counted) = (stepper.window().next_step, stepper.window().counts);
        stepper.restart(&mut system, 5.0, &[5.0_f64.sin(), 5.0_f64.cos()], 2);
        let window = stepper.window();
        assert_eq!((window.time, &window.state), (5.0, &vec![5.0_f64.sin(), 5.0_f64.cos()]));
        if method == Method::Dop853 {
            assert!(0.5 * had < window.next_step && window.next_step <= had);
            assert_eq!(window.counts.evaluations, counted.evaluations + 1);
        }
        while stepper.window().time < 10.0 {
            stepper.step(&mut system, 10.0).expect("a smooth motion");
            stepper.advance();
        }
        let error = (stepper.window().state[0] - 10.0_f64.sin()).abs();
        // A few dozen steps, each within the tolerance; rkam has an error of its own.
        let allowed = if method == Method::Rkam { 1e-6 } else { 1e-7 };
        assert!(error < allowed, "{method}: {error}");
    }
}

/// A thousandth of the time to the limit does not change the time of a clock that counts from an epoch.
#[test]
fn what_is_at_rest_reaches_a_near_limit_at_a_large_time() {
    let start = 1.7e9;
    for after in [1e-3, 1e-6] {
        for method in methods() {
            let (mut system, mut stepper) =
                (Oscillator { evaluations: 0 }, method.stepper(TOLERANCE));
            stepper.start(&mut system, start, &[0.0, 0.0], 2);
            while stepper.window().time < start + after {
                stepper.step(&mut system, start + after).expect("nothing moves");
                stepper.advance();
            }
            assert_eq!(stepper.window().time, start + after, "{method}");
            assert_eq!(stepper.window().state, [0.0, 0.0], "{method}");
        }
    }
}

#[test]
fn a_restart_of_what_was_at_rest_finds_a_first_step() {
    for method in methods() {
        let (mut system, mut stepper) = (Oscillator { evaluations: 0 }, method.stepper(TOLERANCE));
        stepper.start(&mut system, 0.0, &[0.0, 0.0], 2);
        stepper.restart(&mut system, 0.0, &[0.0, 1.0], 2);
        stepper.step(&mut system, 10.0).expect("a smooth motion");
        let window = stepper.window();
        assert!((window.end_state[0] - window.end_time.sin()).abs() < 1e-6, "{method}");
    }
}
