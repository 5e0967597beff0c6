//! The method that chooses: which one it takes, and that it is right to.

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
fn a_long_smooth_motion_is_left_to_few_evaluations_where_these_are_slow() {
    let run = |relative: f64, end: f64| {
        let system = Drawn { fast: (0.0, 0.0), pace: Pace::Slow, evaluations: 0 };
        run_system(&mut Automatic::new(tolerance(relative)), system, end)
    };
    assert_eq!(run(1e-6, 200.0).2, [Method::Dop853]);
    for relative in [1e-9, 1e-12] {
        let (error, evaluations, methods) = run(relative, 200.0);
        assert_eq!(methods, [Method::Dop853, Method::Adams], "{relative}");
        // A step errs by the tolerance at most, and errors are drawn in within a time unit.
        assert!(error < 10.0 * relative, "{relative}: {error}");
        let mut alone = RungeKutta::dop853(tolerance(relative));
        let of_explicit = self::run(&mut alone, (0.0, 0.0), 200.0).1;
        assert!(3 * evaluations < 2 * of_explicit, "{relative}: {evaluations} {of_explicit}");
    }
    assert_eq!(run(1e-8, 3.0).2, [Method::Dop853]);
}

#[test]
fn an_event_hands_few_evaluations_back_to_the_explicit_method() {
    let mut system = Drawn { fast: (0.0, 0.0), pace: Pace::Slow, evaluations: 0 };
    let mut automatic = Automatic::new(tolerance(1e-9));
    automatic.start(&mut system, 0.0, &[1.0], 1);
    while automatic.choice().method != Method::Adams {
        automatic.step(&mut system, 100.0).expect("a bounded motion");
        automatic.advance();
    }
    let (time, state) = (automatic.window().time, automatic.window().state.clone());
    automatic.restart(&mut system, time, &state, 1);
    assert_eq!(automatic.choice().method, Method::Dop853);
}

/// By the method that chooses, for a system that takes eight states at once.
fn run_on_eight(relative: f64, fast: (f64, f64), end: f64) -> (f64, usize, Vec<Method>) {
    let system = Drawn { fast, pace: Pace::SideBySide, evaluations: 0 };
    run_system(&mut Automatic::new(tolerance(relative)), system, end)
}

#[test]
fn stages_go_side_by_side_where_a_smooth_motion_goes_on_and_errors_are_small() {
    for relative in [1e-3, 1e-6] {
        let (.., methods) = run_on_eight(relative, (0.0, 0.0), 40.0);
        assert_eq!(methods.len(), 1, "{relative}: {methods:?}");
    }
    // At very small ones from the first step.
    let [both, lanes] = [&[Method::Dop853, Method::GaussLanes][..], &[Method::GaussLanes]];
    for (relative, expected) in [(1e-8, both), (1e-12, lanes)] {
        let (error, _, methods) = run_on_eight(relative, (0.0, 0.0), 40.0);
        assert_eq!(methods, expected, "{relative}");
        // A step errs by the tolerance at most, and errors are drawn in within a time unit.
        assert!(error < 10.0 * relative, "{relative}: {error}");
    }
}

#[test]
fn stages_side_by_side_are_left_where_their_iteration_is_slow() {
    for relative in [1e-8, 1e-10, 1e-12] {
        let (error, evaluations, methods) = run_on_eight(relative, (1.5, 41.0), 40.0);
        assert_eq!(methods.last(), Some(&implicit(relative)), "{relative}");
        // As above.
        assert!(error < relative.powf(2.0 / 3.0), "{relative}: {error}");
        assert!(evaluations < 20_000, "{relative}: {evaluations}");
    }
}

#[test]
fn what_slows_stages_side_by_side_down_counts_as_stiffness() {
    let mut system = Drawn { fast: (20.0, 41.0), pace: Pace::SideBySide, evaluations: 0 };
    let mut automatic = Automatic::new(tolerance(1e-8));
    automatic.start(&mut system, 0.0, &[1.0], 1);
    let (mut were_side_by_side, mut explicit) = (false, 0);
    while automatic.choice().method != Method::Radau13 {
        automatic.step(&mut system, 40.0).expect("a bounded motion");
        automatic.advance();
        match automatic.choice().method {
            Method::GaussLanes => were_side_by_side = true,
            Method::Dop853 if were_side_by_side => explicit += 1,
            _ => {}
        }
    }
    // The explicit method needs fifteen steps to see it alone.
    assert!((1..15).contains(&explicit), "{explicit}");
}

#[test]
fn what_was_left_once_is_tried_again_later() {
    let mut system = Drawn { fast: (20.0, 41.0), pace: Pace::SideBySide, evaluations: 0 };
    let mut automatic = Automatic::new(tolerance(1e-8));
    automatic.start(&mut system, 0.0, &[1.0], 1);
    let mut until = |automatic: &mut Automatic, method: Method| {
        let mut steps = 0;
        while automatic.choice().method != method {
            automatic.step(&mut system, 200.0).expect("a bounded motion");
            automatic.advance();
            steps += 1;
        }
        steps
    };
    // The last of these steps is the other method's.
    assert_eq!(until(&mut automatic, Method::GaussLanes), 12 + 1);
    until(&mut automatic, Method::Dop853);
    let mut smooth = Drawn { fast: (0.0, 0.0), pace: Pace::SideBySide, evaluations: 0 };
    automatic.restart(&mut smooth, 50.0, &[50.0_f64.cos()], 1);
    assert_eq!(until(&mut automatic, Method::GaussLanes), 24 + 1);
    // Another run knows nothing of it.
    automatic.reset();
    automatic.start(&mut smooth, 50.0, &[50.0_f64.cos()], 1);
    assert_eq!(until(&mut automatic, Method::GaussLanes), 12 + 1);
}

#[test]
fn stages_do_not_go_side_by_side_where_a_motion_soon_ends() {
    let steps = |end: f64| run_on_eight(1e-9, (0.0, 0.0), end).2;
    let mut alone = RungeKutta::dop853(tolerance(1e-9));
    let mut system = Drawn { fast: (0.0, 0.0), pace: Pace::SideBySide, evaluations: 0 };
    alone.start(&mut system, 0.0, &[1.0], 1);
    let mut times = Vec::new();
    for _ in 0..40 {
        alone.step(&mut system, 100.0).expect("a bounded motion");
        alone.advance();
        times.push(alone.window().time);
    }
    // After twelve steps there is room for six more, or for 27.
    assert_eq!(steps(times[17]), [Method::Dop853]);
    assert_eq!(steps(times[38]), [Method::Dop853, Method::GaussLanes]);
}

#[test]
fn an_event_hands_stages_side_by_side_back_to_the_explicit_method() {
    let mut system = Drawn { fast: (0.0, 0.0), pace: Pace::SideBySide, evaluations: 0 };
    let mut automatic = Automatic::new(tolerance(1e-9));
    automatic.start(&mut system, 0.0, &[1.0], 1);
    while automatic.choice().method != Method::GaussLanes {
        automatic.step(&mut system, 100.0).expect("a bounded motion");
        automatic.advance();
    }
    let (time, state) = (automatic.window().time, automatic.window().state.clone());
    automatic.restart(&mut system, time, &state, 1);
    assert_eq!(automatic.choice().method, Method::Dop853);
    automatic.step(&mut system, 100.0).expect("a bounded motion");
    automatic.advance();
    let window = automatic.window();
    assert!((window.state[0] - window.time.cos()).abs() < 1e-8);
    assert_eq!(window.counts.evaluations, system.evaluations);
}

#[test]
fn an_event_leaves_stages_side_by_side_at_very_small_errors() {
    let mut system = Drawn { fast: (0.0, 0.0), pace: Pace::SideBySide, evaluations: 0 };
    let mut automatic = Automatic::new(tolerance(1e-11));
    automatic.start(&mut system, 0.0, &[1.0], 1);
    for _ in 0..3 {
        automatic.step(&mut system, 100.0).expect("a bounded motion");
        automatic.advance();
    }
    let (time, state) = (automatic.window().time, automatic.window().state.clone());
    automatic.restart(&mut system, time, &state, 1);
    assert_eq!(automatic.choice().method, Method::GaussLanes);
    // From few evaluations as well.
    let mut slow = Drawn { fast: (0.0, 0.0), pace: Pace::Slow, evaluations: 0 };
    let mut automatic = Automatic::new(tolerance(1e-11));
    automatic.start(&mut slow, 0.0, &[1.0], 1);
    while automatic.choice().method != Method::Adams {
        automatic.step(&mut slow, 100.0).expect("a bounded motion");
        automatic.advance();
    }
    automatic.restart(&mut system, time, &state, 1);
    assert_eq!(automatic.choice().method, Method::GaussLanes);
    // The next mode has no code for eight states.
    system.pace = Pace::Fast;
    automatic.restart(&mut system, time, &state, 1);
    assert_eq!(automatic.choice().method, Method::Dop853);
}

/// ẏ = 1 from `jump` on and ẏ = 0 before, beside an oscillator.
struct Jumping {
    jump: f64,
}

impl System for Jumping {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = if t < self.jump { 0.0 } else { 1.0 };
        (dy[1], dy[2]) = (y[2], -y[1]);
    }
}

#[test]
fn a_jump_far_from_the_origin_of_time_ends_no_run() {
    let (begin, jump) = (1e5, 1e5 + 30.25);
    for relative in [1e-9, 1e-11] {
        let mut system = Jumping { jump };
        let mut automatic = Automatic::new(tolerance(relative));
        automatic.start(&mut system, begin, &[1.0, 1.0, 0.0], 3);
        let mut methods = Vec::new();
        while automatic.window().time < begin + 60.0 {
            automatic.step(&mut system, begin + 60.0).expect("a bounded motion");
            automatic.advance();
            methods.push(automatic.choice().method);
        }
        assert!(methods.contains(&Method::Adams), "{relative}");
        let found = &automatic.window().state;
        let expected = [1.0 + 29.75, 60.0_f64.cos(), -60.0_f64.sin()];
        for (found, expected) in found.iter().zip(expected) {
            // Of the jump the time is known to 1e-11.
            assert!((found - expected).abs() < 100.0 * relative, "{relative}: {found} {expected}");
        }
    }
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
