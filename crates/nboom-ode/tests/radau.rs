//! Radau's methods on stiff problems with known solutions.

use std::ops::Range;

use nboom_ode::{Counts, Method, StepError, Stepper, System, Tolerance};

const ALL: [Method; 3] = [Method::Radau5, Method::Radau9, Method::Radau13];

fn tolerance(relative: f64) -> Tolerance {
    Tolerance { relative, absolute: 1e-3 * relative }
}

/// Integrates from 0 to each of `times`; returns the variables there and what it cost.
fn integrate(
    stepper: &mut dyn Stepper,
    system: &mut dyn System,
    start: &[f64],
    times: &[f64],
) -> (Vec<Vec<f64>>, Counts) {
    stepper.start(system, 0.0, start, start.len());
    let mut found = Vec::new();
    for &time in times {
        while stepper.window().time < time {
            stepper.step(system, time).expect("a solvable problem");
            stepper.advance();
        }
        found.push(stepper.window().state.clone());
    }
    (found, stepper.window().counts)
}

fn relative_error(found: &[f64], expected: &[f64]) -> f64 {
    found.iter().zip(expected).map(|(f, e)| (f / e - 1.0).abs()).fold(0.0, f64::max)
}

/// Van der Pol's oscillator with ε = 1e-6.
struct VanDerPol;

const EPSILON: f64 = 1e-6;

impl System for VanDerPol {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = y[1];
        dy[1] = ((1.0 - y[0] * y[0]) * y[1] - y[0]) / EPSILON;
    }

    fn jacobian(&mut self, _t: f64, y: &[f64], out: &mut [f64]) -> bool {
        let slope = [(-2.0 * y[0] * y[1] - 1.0) / EPSILON, (1.0 - y[0] * y[0]) / EPSILON];
        out.copy_from_slice(&[0.0, 1.0, slope[0], slope[1]]);
        true
    }
}

/// At t = 1 and 2, as Hairer and Wanner give it for their driver of RADAU5.
const VAN_DER_POL: [[f64; 2]; 2] = [
    [-0.186_364_625_480_813e1, 0.753_543_086_543_546],
    [0.170_616_773_217_048_3e1, -0.892_809_701_024_797_5],
];

#[test]
fn van_der_pol_follows_the_tolerance() {
    let problem = |method: Method, relative: f64| {
        let mut stepper = method.stepper(tolerance(relative));
        let (found, counts) = integrate(&mut *stepper, &mut VanDerPol, &[2.0, 0.0], &[1.0, 2.0]);
        let errors = [0, 1].map(|i| relative_error(&found[i], &VAN_DER_POL[i]));
        println!("{method} {relative:e}: {errors:?} {counts:?}");
        // Steep parts of the cycle amplify the error of a step some ten times.
        assert!(errors.iter().all(|error| *error < 10.0 * relative), "{relative:e}: {errors:?}");
        counts
    };
    for (relative, most) in [(1e-4, 3000), (1e-6, 5000), (1e-8, 9000), (1e-10, 25_000)] {
        let counts = ALL.map(|method| problem(method, relative));
        assert!(counts[0].evaluations < most, "{relative:e}: {:?}", counts[0]);
        let steps = counts.map(|counts| counts.factorizations);
        assert!(steps[1] < steps[0] && steps[2] < steps[1], "{relative:e}: {steps:?}");
    }
    // Estimates are compared with 0.1 · 1e-10^(2/3) = 2e-8, whose roots are 0.012, 0.05 and 0.11.
    let steps = ALL.map(|method| problem(method, 1e-10).accepted);
    assert!(4 * steps[1] < steps[0] && 8 * steps[2] < steps[0], "{steps:?}");
}

/// Robertson's reactions, without a Jacobian.
struct Robertson;

impl System for Robertson {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let (first, second) = (0.04 * y[0] - 1e4 * y[1] * y[2], 3e7 * y[1] * y[1]);
        (dy[0], dy[1], dy[2]) = (-first, first - second, second);
    }
}

#[test]
fn robertson_without_a_jacobian() {
    // At t = 40: Hairer and Wanner, Section IV.10.
    let expected = [0.715_827_068_719_394, 0.918_553_476_455_742_6e-5, 0.284_163_745_745_841_3];
    for (method, most) in ALL.into_iter().zip([1500, 900, 1000]) {
        let mut stepper = method.stepper(Tolerance { relative: 1e-8, absolute: 1e-14 });
        let (found, counts) = integrate(&mut *stepper, &mut Robertson, &[1.0, 0.0, 0.0], &[40.0]);
        let error = relative_error(&found[0], &expected);
        println!("{method} {error:e} {counts:?}");
        assert!(error < 1e-8, "{method}: {error:e}");
        assert!(counts.evaluations < most, "{method}: {counts:?}");
    }
}

/// ẏ = −λ (y − cos t) − sin t, whose solution cos t has nothing of λ (Prothero and Robinson).
struct ToTheCosine {
    lambda: f64,
}

impl System for ToTheCosine {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = -self.lambda * (y[0] - t.cos()) - t.sin();
    }

    fn jacobian(&mut self, _t: f64, _y: &[f64], out: &mut [f64]) -> bool {
        out[0] = -self.lambda;
        true
    }
}

#[test]
fn stiffness_costs_nothing() {
    // Where stages are stiff only the order of the estimate is left, and its tolerance of 4.6e-7, which a
    // filtered estimate may exceed.
    for (method, most) in ALL.into_iter().zip([1e-7, 2e-6, 1e-7]) {
        let evaluations = [1e2, 1e5, 1e8].map(|lambda| {
            let mut stepper = method.stepper(tolerance(1e-8));
            let system = &mut ToTheCosine { lambda };
            let (found, counts) = integrate(&mut *stepper, system, &[1.0], &[10.0]);
            let error = (found[0][0] - 10.0_f64.cos()).abs();
            println!("{method} {lambda:e}: {error:e} {counts:?}");
            assert!(error < most, "{method} {lambda:e}: {error:e}");
            counts.evaluations
        });
        assert!(evaluations.iter().all(|count| *count < 1000), "{method}: {evaluations:?}");
    }
    let mut explicit = Method::Dop853.stepper(tolerance(1e-8));
    let system = &mut ToTheCosine { lambda: 1e5 };
    let (_, counts) = integrate(&mut *explicit, system, &[1.0], &[10.0]);
    println!("dop853 {counts:?}");
    assert!(counts.evaluations > 1_000_000, "{counts:?}");
}

/// ÿ = −y − cẏ, and the work of the damping as an integral that does not decide on steps.
struct Damped {
    with_jacobian: bool,
    /// Whether it tells that y is the integral of ẏ.
    tells_integral: bool,
}

const DAMPING: f64 = 1e6;

impl System for Damped {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1]) = (y[1], -y[0] - DAMPING * y[1]);
        dy[2] = DAMPING * y[1] * y[1];
    }

    fn jacobian(&mut self, _t: f64, y: &[f64], out: &mut [f64]) -> bool {
        let of_work = 2.0 * DAMPING * y[1];
        out.copy_from_slice(&[0.0, 1.0, 0.0, -1.0, -DAMPING, 0.0, 0.0, of_work, 0.0]);
        self.with_jacobian
    }

    fn rate_of(&self, i: usize) -> Option<usize> {
        (self.tells_integral && i == 0).then_some(1)
    }
}

#[test]
fn energy_of_a_damped_oscillator_goes_into_work() {
    for (method, tells_integral) in
        ALL.into_iter().flat_map(|method| [(method, false), (method, true)])
    {
        let costs = [true, false].map(|with_jacobian| {
            let mut stepper = method.stepper(tolerance(1e-9));
            let system = &mut Damped { with_jacobian, tells_integral };
            let (found, counts) = integrate_two(&mut *stepper, system, 1e5);
            let energy = 0.5 * (found[0] * found[0] + found[1] * found[1]) + found[2];
            println!("{method} {tells_integral}: {found:?} {energy} {counts:?}");
            // The slow root −1/c + … of s² + cs + 1, with the share of the fast one left out.
            let expected = (-1e5_f64 / DAMPING).exp();
            assert!((found[0] - expected).abs() < 1e-8, "{method}: {} {expected}", found[0]);
            // An integral that decides on no step is as good as the estimate: 0.1 · 1e-9^(2/3).
            assert!((energy - 0.5).abs() < 1e-7, "{method}: {energy}");
            counts
        });
        let differences = costs[1].evaluations - costs[0].evaluations;
        assert!(differences >= costs[1].jacobians, "{method}: {costs:?}");
    }
}

/// Integrates to `end` from one, at rest, with two variables that decide on steps.
fn integrate_two(
    stepper: &mut dyn Stepper,
    system: &mut dyn System,
    end: f64,
) -> (Vec<f64>, Counts) {
    stepper.start(system, 0.0, &[1.0, 0.0, 0.0], 2);
    while stepper.window().time < end {
        stepper.step(system, end).expect("a solvable problem");
        stepper.advance();
    }
    (stepper.window().state.clone(), stepper.window().counts)
}

/// A pendulum with a damper, ÿ = −10 sin y − ẏ, and the work of that.
struct Pendulum;

impl System for Pendulum {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1]) = (y[1], -10.0 * y[0].sin() - y[1]);
        dy[2] = -y[1] * y[1];
    }

    fn rate_of(&self, i: usize) -> Option<usize> {
        (i == 0).then_some(1)
    }
}

#[test]
fn work_is_that_of_the_motion_however_few_corrections_find_it() {
    let energy = |y: &[f64]| 0.5 * y[1] * y[1] - 10.0 * y[0].cos() - y[2];
    let start = [-0.7, 1.2, 0.0];
    for (method, relative) in
        ALL.into_iter().flat_map(|method| [1e-6, 1e-9, 1e-12].map(|relative| (method, relative)))
    {
        let mut stepper = method.stepper(tolerance(relative));
        let mut largest = 0.0_f64;
        stepper.start(&mut Pendulum, 0.0, &start, 2);
        for steps in 1.. {
            stepper.step(&mut Pendulum, 9.0).expect("a solvable problem");
            if steps % 3 == 0 {
                let length = stepper.window().length();
                stepper.retake(&mut Pendulum, 0.7 * length);
            }
            stepper.advance();
            largest = largest.max((energy(&stepper.window().state) - energy(&start)).abs());
            if stepper.window().time >= 9.0 {
                break;
            }
        }
        println!("{method} {relative:e}: {largest:e} {:?}", stepper.window().counts);
        // In energies of up to 10.
        assert!(largest < 10.0 * relative, "{method} {relative:e}: {largest:e}");
    }
}

/// ÿ = −k (y − cos t) − cẏ with a stiff spring, whose rate dies down as fast as it can.
struct OnASpring {
    /// Whether it tells that y is the integral of ẏ.
    tells_integral: bool,
}

impl System for OnASpring {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1]) = (y[1], -1e8 * (y[0] - t.cos()) - 2e4 * y[1]);
    }

    fn jacobian(&mut self, _t: f64, _y: &[f64], out: &mut [f64]) -> bool {
        out.copy_from_slice(&[0.0, 1.0, -1e8, -2e4]);
        true
    }

    fn rate_of(&self, i: usize) -> Option<usize> {
        (self.tells_integral && i == 0).then_some(1)
    }
}

#[test]
fn an_integral_that_is_no_unknown_changes_neither_steps_nor_motion() {
    for method in ALL {
        let of = |tells_integral| {
            let mut stepper = method.stepper(tolerance(1e-9));
            let system = &mut OnASpring { tells_integral };
            integrate(&mut *stepper, system, &[1.0, 0.0], &[10.0])
        };
        let [(without, counts), (with, counts_with)] = [of(false), of(true)];
        println!("{method}: {without:?} {counts:?} {with:?} {counts_with:?}");
        // To first order in the lag 2e4 / 1e8; the second is 4e-8.
        let expected = 10.0_f64.cos() + 2e-4 * 10.0_f64.sin();
        for found in [&without, &with] {
            assert!((found[0][0] - expected).abs() < 2e-7, "{method}: {} {expected}", found[0][0]);
        }
        // The linear algebra is the same; rounding may decide on a round of an iteration.
        let ratio = counts_with.evaluations as f64 / counts.evaluations as f64;
        assert!((0.8..1.25).contains(&ratio), "{method}: {counts:?} {counts_with:?}");
    }
}

/// ẏ = 1 at zero and on an island, and none elsewhere.
struct Island(Range<f64>);

impl System for Island {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        dy[0] = if y[0] == 0.0 || self.0.contains(&y[0]) { 1.0 } else { f64::NAN };
    }

    fn jacobian(&mut self, _t: f64, _y: &[f64], out: &mut [f64]) -> bool {
        out[0] = 0.0;
        true
    }
}

/// Late, so that the shortest steps are long.
const LATE: f64 = 1e9;

/// What was evaluated last when no step was short enough, and that step.
fn last_evaluated(method: Method, system: &mut Island) -> [f64; 2] {
    let mut stepper = method.stepper(tolerance(1e-6));
    stepper.start(system, LATE, &[0.0], 1);
    let error = stepper.step(system, LATE + 1.0).expect_err("there is no way");
    assert!(matches!(error, StepError::NotFinite { variable: 0, .. }), "{method}: {error}");
    // The next one would be half as long.
    [stepper.last_evaluated()[0], 2.0 * stepper.window().next_step]
}

#[test]
fn what_was_evaluated_last_is_the_first_stage_without_a_slope() {
    // Where the first stage is, as a share of the step.
    for (method, share) in ALL.into_iter().zip([0.155_051_025_7, 0.057_104_196_1, 0.029_316_427_2])
    {
        let [found, step] = last_evaluated(method, &mut Island(0.0..0.0));
        assert!((found / (share * step) - 1.0).abs() < 1e-6, "{method}: {found} {step}");
        // The last stage has a slope now.
        let island = &mut Island(0.99 * step..1.01 * step);
        assert_eq!(last_evaluated(method, island), [found, step], "{method}");
        // The first one has.
        let island = &mut Island(0.99 * found..1.01 * found);
        let [second, again] = last_evaluated(method, island);
        assert!(again == step && found < second && second < step, "{method}: {second} {step}");
    }
}
