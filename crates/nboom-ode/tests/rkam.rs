//! The 1970 integrator: what its settings do, on problems whose differences of predictor and
//! corrector are known.

use nboom_ode::{Bound, Rkam, RkamSettings, StepError, Stepper, System, Tolerance};

/// (ċ, ṡ) = (−φ̇ s, φ̇ c), whose solution is (cos φ, sin φ): with φ = t + `swing` · atan(t − 5) it
/// turns at unit rate but for the time around 5.
///
/// At unit rate the predictor misses by 251/720 h⁵, the corrector by −19/720 h⁵, in a direction
/// that turns; the larger of the two differences is between 0.7 and 1 times 270/720 h⁵.
#[derive(Clone, Copy)]
struct Turning {
    swing: f64,
}

const UNIFORM: Turning = Turning { swing: 0.0 };

impl Turning {
    fn exact(&self, t: f64) -> [f64; 2] {
        let phase = t + self.swing * (t - 5.0).atan();
        [phase.cos(), phase.sin()]
    }

    fn error(&self, stepper: &Rkam) -> f64 {
        let exact = self.exact(stepper.window().time);
        let differences = stepper.window().state.iter().zip(exact).map(|(y, e)| (y - e).abs());
        differences.fold(0.0, f64::max)
    }
}

impl System for Turning {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        let rate = 1.0 + self.swing / (1.0 + (t - 5.0).powi(2));
        (dy[0], dy[1]) = (-rate * y[1], rate * y[0]);
    }
}

fn absolute(bound: f64) -> Bound {
    Bound::Number(bound)
}

/// Bounds between which steps of 0.1 stay: 270/720 · 0.1⁵ = 3.75e-6, and 32 times less at half.
fn settled_at_a_tenth(first_step: f64) -> RkamSettings {
    RkamSettings {
        first_step: Some(first_step),
        shortest: 0.0,
        longest: f64::INFINITY,
        upper: absolute(1e-5),
        lower: absolute(2e-7),
    }
}

fn always(step: f64) -> RkamSettings {
    let (upper, lower) = (absolute(1e300), absolute(0.0));
    RkamSettings { first_step: Some(step), shortest: step, longest: step, upper, lower }
}

fn started(settings: RkamSettings, mut problem: Turning) -> Rkam {
    let mut stepper = Rkam::new(settings);
    let start = problem.exact(0.0);
    stepper.start(&mut problem, 0.0, &start, 2);
    stepper
}

/// Steps until `limit`.
fn run(stepper: &mut Rkam, mut problem: Turning, limit: f64) -> Result<Vec<f64>, StepError> {
    let mut lengths = Vec::new();
    while stepper.window().time < limit {
        stepper.step(&mut problem, limit)?;
        lengths.push(stepper.window().length());
        stepper.advance();
    }
    Ok(lengths)
}

fn near(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    let same = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9);
    assert!(same, "{found:?}, not {expected:?}");
}

#[test]
fn predictor_and_corrector_are_of_order_4_at_two_evaluations() {
    let with_steps = |count: u32| {
        let mut stepper = started(always(4.0 / f64::from(count)), UNIFORM);
        assert_eq!(run(&mut stepper, UNIFORM, 4.0).expect("never refused").len(), count as usize);
        // The start, three steps of four, and two for each of the others, the last one too.
        let evaluations = 1 + 3 * 4 + 2 * (count as usize - 3);
        assert_eq!(stepper.window().counts.evaluations, evaluations);
        UNIFORM.error(&stepper)
    };
    let (coarse, fine) = (with_steps(80), with_steps(160));
    let order = (coarse / fine).log2();
    assert!((3.8..4.4).contains(&order), "{order}: {coarse:e} {fine:e}");
    // Each step is off by 19/720 h⁵ and the direction of that turns with the solution.
    let expected = 19.0 / 720.0 * 0.025_f64.powi(4) * 4.0;
    assert!((fine / expected - 1.0).abs() < 0.3, "{fine:e} {expected:e}");
}

#[test]
fn small_differences_double_once_seven_derivatives_are_known() {
    let mut stepper = started(settled_at_a_tenth(0.025), UNIFORM);
    let lengths = run(&mut stepper, UNIFORM, 0.3 + 2.0).expect("met");
    near(&lengths, &[[0.025; 6].as_slice(), &[0.05; 3], &[0.1; 20]].concat());
    assert_eq!(stepper.window().counts.rejected, 0);
    let of_long_steps = 20.0 * 19.0 / 720.0 * 0.1_f64.powi(5);
    assert!(UNIFORM.error(&stepper) < 1.3 * of_long_steps, "{:e}", UNIFORM.error(&stepper));
}

#[test]
fn large_differences_halve_after_the_untested_start() {
    let mut stepper = started(settled_at_a_tenth(0.4), UNIFORM);
    let lengths = run(&mut stepper, UNIFORM, 1.8 + 1.0).expect("met");
    near(&lengths, &[[0.4; 3].as_slice(), &[0.2; 3], &[0.1; 10]].concat());
    assert_eq!(stepper.window().counts.rejected, 2);
}

#[test]
fn the_longest_step_is_not_passed() {
    let settings = RkamSettings { longest: 0.05, ..settled_at_a_tenth(0.025) };
    let lengths = run(&mut started(settings, UNIFORM), UNIFORM, 1.15).expect("met");
    near(&lengths, &[[0.025; 6].as_slice(), &[0.05; 20]].concat());
}

#[test]
fn a_test_that_fails_at_the_shortest_step_is_an_error() {
    let settings = RkamSettings { shortest: 0.2, ..settled_at_a_tenth(0.4) };
    let mut stepper = started(settings, UNIFORM);
    let refused = run(&mut stepper, UNIFORM, 10.0).expect_err("1e-5 takes shorter steps");
    let StepError::Underflow { time, step, .. } = refused else { panic!("{refused:?}") };
    assert!((time - 1.8).abs() < 1e-12 && step == 0.2, "{time} {step}");
    assert_eq!(stepper.window().time, time, "the start is still there");
    // Half of 0.3 is below: the shortest step is tried before giving up.
    let settings = RkamSettings { shortest: 0.1, ..settled_at_a_tenth(0.15) };
    let lengths = run(&mut started(settings, UNIFORM), UNIFORM, 0.95).expect("met");
    near(&lengths, &[[0.15; 3].as_slice(), &[0.1; 5]].concat());
}

#[test]
fn steps_follow_the_rate_of_the_motion() {
    let mut problem = Turning { swing: 20.0 };
    let mut stepper = started(settled_at_a_tenth(0.01), problem);
    let mut shortest = f64::INFINITY;
    let mut last = 0.01;
    while stepper.window().time < 20.0 {
        stepper.step(&mut problem, 20.0).expect("met");
        let (time, length) = (stepper.window().time, stepper.window().length());
        let ratio = length / last;
        let power_of_two = [0.25, 0.5, 1.0, 2.0].iter().any(|r| (ratio - r).abs() < 1e-9);
        assert!(power_of_two || stepper.window().end_time == 20.0, "{ratio} at {time}");
        if (4.5..5.5).contains(&time) {
            shortest = length.min(shortest);
        }
        last = if power_of_two { length } else { last };
        stepper.advance();
    }
    // At rate φ̇ the difference is that of steps of φ̇ h at unit rate, which settle below 0.13.
    assert!(shortest < 0.13 / 17.0, "{shortest}");
    assert!(last > 4.0 * shortest, "{last} after {shortest}");
    assert!(problem.error(&stepper) < 1e-3, "{:e}", problem.error(&stepper));
}

#[test]
fn a_cut_step_loses_no_order() {
    let after_cuts = |step: f64| {
        let mut stepper = started(always(step), UNIFORM);
        for limit in [0.513, 1.7, 1.7001, 4.0] {
            run(&mut stepper, UNIFORM, limit).expect("never refused");
        }
        UNIFORM.error(&stepper)
    };
    let (coarse, fine) = (after_cuts(0.05), after_cuts(0.025));
    assert!((coarse / fine).log2() > 3.7, "{coarse:e} {fine:e}");
}

#[test]
fn bounds_from_a_tolerance_are_relative_to_the_variables() {
    let tolerance = Tolerance { relative: 1e-7, absolute: 0.0 };
    let steps_at_size = |size: f64| {
        let mut stepper = Rkam::new(RkamSettings::meeting(Bound::Within(tolerance)));
        stepper.start(&mut { UNIFORM }, 0.0, &[size, 0.3 * size], 2);
        run(&mut stepper, UNIFORM, 5.0).expect("met")
    };
    near(&steps_at_size(1024.0 * 1024.0), &steps_at_size(1.0));
}

#[test]
fn scaling_scales_the_past_too() {
    let mut plain = started(always(0.1), UNIFORM);
    run(&mut plain, UNIFORM, 1.0).expect("never refused");
    let mut scaled = plain.clone();
    scaled.scale(0..2, 2.0);
    for stepper in [&mut plain, &mut scaled] {
        run(stepper, UNIFORM, 2.0).expect("never refused");
    }
    let twice = plain.window().state.iter().map(|y| 2.0 * y);
    assert!(twice.eq(scaled.window().state.iter().copied()), "{scaled:?} {plain:?}");
}
