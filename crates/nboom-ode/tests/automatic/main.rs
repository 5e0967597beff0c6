//! The method that chooses: which one it takes, and that it is right to.

mod decay;
mod long;

use nboom_ode::{Automatic, Method, Pace, RungeKutta, Stepper, System, Tolerance};

/// ẏ = −rate(t) (y − cos t) − sin t, which y = cos t solves; fast for `fast.0 < t < fast.1`.
struct Drawn {
    fast: (f64, f64),
    /// What it says that evaluations cost.
    pace: Pace,
    /// How often it was evaluated.
    evaluations: usize,
}

impl System for Drawn {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        self.evaluations += 1;
        let rate = if self.fast.0 < t && t < self.fast.1 { 1e5 } else { 1.0 };
        dy[0] = -rate * (y[0] - t.cos()) - t.sin();
    }

    fn takes_eight(&mut self) -> bool {
        self.pace == Pace::SideBySide
    }

    fn pace(&mut self) -> Pace {
        self.pace
    }
}

/// Error at the end, evaluations, and the methods in the order in which they were taken.
fn run(stepper: &mut dyn Stepper, fast: (f64, f64), end: f64) -> (f64, usize, Vec<Method>) {
    run_system(stepper, Drawn { fast, pace: Pace::Fast, evaluations: 0 }, end)
}

fn run_system(stepper: &mut dyn Stepper, mut system: Drawn, end: f64) -> (f64, usize, Vec<Method>) {
    stepper.start(&mut system, 0.0, &[1.0], 1);
    let mut methods = vec![stepper.choice().method];
    let mut steps = 0;
    while stepper.window().time < end {
        stepper.step(&mut system, end).expect("a bounded motion");
        stepper.advance();
        steps += 1;
        let method = stepper.choice().method;
        if methods.last() != Some(&method) {
            methods.push(method);
        }
    }
    let window = stepper.window();
    // Nothing is lost on the way, whichever method it was done by.
    assert_eq!(window.counts.accepted, steps);
    assert_eq!(window.counts.evaluations, system.evaluations);
    ((window.state[0] - end.cos()).abs(), window.counts.evaluations, methods)
}

fn tolerance(relative: f64) -> Tolerance {
    Tolerance { relative, absolute: relative }
}

#[test]
fn a_smooth_motion_is_left_to_the_explicit_method_for_the_tolerance() {
    for (relative, expected) in [(1e-3, Method::Dopri5), (1e-8, Method::Dop853)] {
        let mut automatic = Automatic::new(tolerance(relative));
        let (error, evaluations, methods) = run(&mut automatic, (0.0, 0.0), 20.0);
        assert_eq!(methods, [expected]);
        let mut alone = expected.stepper(tolerance(relative));
        assert_eq!((error, evaluations), {
            let (error, evaluations, _) = run(&mut *alone, (0.0, 0.0), 20.0);
            (error, evaluations)
        });
    }
}

/// The implicit method for a tolerance.
fn implicit(relative: f64) -> Method {
    if relative > 1e-6 { Method::Radau9 } else { Method::Radau13 }
}

#[test]
fn a_stiff_motion_is_left_to_the_implicit_method() {
    for relative in [1e-4, 1e-8, 1e-10, 1e-12] {
        let (error, evaluations, methods) =
            run(&mut Automatic::new(tolerance(relative)), (-1.0, 11.0), 10.0);
        assert_eq!(methods.last(), Some(&implicit(relative)), "{relative}");
        // Errors are drawn in within 1e-5 time units: what remains is one step's, which the
        // implicit method compares with a wider tolerance; where it filters its estimate, that is
        // too small by up to a decade.
        assert!(error < relative.powf(2.0 / 3.0), "{relative}: {error}");
        // An explicit method needs 10 · 1e5 / 6.1 steps.
        assert!(evaluations < 10_000, "{relative}: {evaluations}");
    }
}

#[test]
fn the_explicit_method_comes_back_when_the_motion_is_smooth_again() {
    let (error, evaluations, methods) = run(&mut Automatic::new(tolerance(1e-8)), (2.0, 4.0), 40.0);
    assert_eq!(methods, [Method::Dop853, Method::Radau13, Method::Dop853]);
    assert!(error < 1e-8, "{error}");
    let mut alone = RungeKutta::dop853(tolerance(1e-8));
    let (_, of_explicit, _) = run(&mut alone, (2.0, 4.0), 40.0);
    assert!(10 * evaluations < of_explicit, "{evaluations} {of_explicit}");
}

#[test]
fn work_is_counted_through_changes_of_method() {
    let mut automatic = Automatic::new(tolerance(1e-8));
    let (_, evaluations, _) = run(&mut automatic, (-1.0, 11.0), 10.0);
    let counts = automatic.window().counts;
    assert!(counts.jacobians > 0 && counts.factorizations > 0);
    // Fifteen steps of twelve evaluations come before the change.
    assert!(evaluations > 15 * 12, "{evaluations}");
}

#[test]
fn a_step_that_errs_too_much_is_not_taken_and_the_next_one_grows_no_further() {
    // The motion becomes fast so suddenly that steps have to be taken back.
    let mut system = Drawn { fast: (2.0, 2.1), pace: Pace::Fast, evaluations: 0 };
    let mut stepper = RungeKutta::dopri5(tolerance(1e-8));
    stepper.start(&mut system, 0.0, &[1.0], 1);
    let mut rejected = 0;
    while stepper.window().time < 3.0 {
        stepper.step(&mut system, 3.0).expect("a bounded motion");
        let window = stepper.window();
        // Told per unit of time, in units of the tolerance.
        let error = stepper.error_of(0) * window.length();
        assert!(error <= 1.0 + 1e-9, "{error} at {}", window.time);
        if window.counts.rejected > rejected {
            let growth = window.next_step / window.length();
            assert!(growth <= 1.0 + 1e-9, "{growth} at {}", window.time);
        }
        rejected = window.counts.rejected;
        stepper.advance();
    }
    assert!(rejected > 5, "{rejected}");
}
