//! What follows explicit steps where a motion goes on.

use nboom_ode::{Automatic, Method, Pace, RungeKutta, Stepper, System};

use crate::{Drawn, implicit, run_system, tolerance};

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
        let of_explicit = crate::run(&mut alone, (0.0, 0.0), 200.0).1;
        assert!(3 * evaluations < 2 * of_explicit, "{relative}: {evaluations} {of_explicit}");
    }
    assert_eq!(run(1e-8, 3.0).2, [Method::Dop853]);
}

#[test]
fn few_evaluations_are_left_where_stability_bounds_many_steps() {
    for relative in [1e-8, 1e-10] {
        let system = Drawn { fast: (20.0, 41.0), pace: Pace::Slow, evaluations: 0 };
        let mut automatic = Automatic::new(tolerance(relative));
        let (error, evaluations, methods) = run_system(&mut automatic, system, 40.0);
        let expected = [Method::Dop853, Method::Adams, Method::Dop853, implicit(relative)];
        assert_eq!(methods, expected, "{relative}");
        // As where it is stiff from the start.
        assert!(error < relative.powf(2.0 / 3.0), "{relative}: {error}");
        assert!(evaluations < 10_000, "{relative}: {evaluations}");
    }
}

/// Steps until this method has taken one; how many.
fn until(automatic: &mut Automatic, system: &mut dyn System, method: Method) -> usize {
    let mut steps = 0;
    while automatic.choice().method != method {
        automatic.step(system, 200.0).expect("a bounded motion");
        automatic.advance();
        steps += 1;
    }
    steps
}

#[test]
fn an_event_hands_few_evaluations_back_to_the_explicit_method() {
    let mut system = Drawn { fast: (0.0, 0.0), pace: Pace::Slow, evaluations: 0 };
    let mut automatic = Automatic::new(tolerance(1e-9));
    automatic.start(&mut system, 0.0, &[1.0], 1);
    until(&mut automatic, &mut system, Method::Adams);
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
    // The last of these steps is the other method's.
    assert_eq!(until(&mut automatic, &mut system, Method::GaussLanes), 12 + 1);
    until(&mut automatic, &mut system, Method::Dop853);
    let mut smooth = Drawn { fast: (0.0, 0.0), pace: Pace::SideBySide, evaluations: 0 };
    automatic.restart(&mut smooth, 50.0, &[50.0_f64.cos()], 1);
    assert_eq!(until(&mut automatic, &mut smooth, Method::GaussLanes), 24 + 1);
    // Another run knows nothing of it.
    automatic.reset();
    automatic.start(&mut smooth, 50.0, &[50.0_f64.cos()], 1);
    assert_eq!(until(&mut automatic, &mut smooth, Method::GaussLanes), 12 + 1);
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
    until(&mut automatic, &mut system, Method::GaussLanes);
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
    until(&mut automatic, &mut slow, Method::Adams);
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
