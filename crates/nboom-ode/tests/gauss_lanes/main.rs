//! Gauss's method with its stages side by side, against closed forms.

use nboom_ode::{Counts, GaussLanes, Stepper, System, Tolerance};
use nboom_scalar::Eight;

mod free_body;

fn tolerance(relative: f64) -> Tolerance {
    Tolerance { relative, absolute: relative }
}

/// Takes steps until `end` and hands each to `look`, with dense output prepared.
fn follow(
    stepper: &mut dyn Stepper,
    system: &mut dyn System,
    end: f64,
    mut look: impl FnMut(&dyn Stepper),
) -> Counts {
    while stepper.window().time < end {
        stepper.step(system, end).expect("a smooth problem");
        stepper.prepare_dense(system);
        look(stepper);
        stepper.advance();
    }
    stepper.window().counts
}

/// A planet about a sun, its place before its velocity.
#[derive(Clone, Copy)]
struct Kepler {
    /// Whether it says that its place is the integral of its velocity.
    tells_rates: bool,
    /// Whether it takes eight states at once.
    has_lanes: bool,
    states_seen: usize,
}

const PLAIN: Kepler = Kepler { tells_rates: false, has_lanes: false, states_seen: 0 };
const WITH_RATES: Kepler = Kepler { tells_rates: true, ..PLAIN };

fn attraction([x, y]: [f64; 2]) -> [f64; 2] {
    let squared = x * x + y * y;
    let factor = -1.0 / (squared * squared.sqrt());
    [factor * x, factor * y]
}

impl System for Kepler {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        self.states_seen += 1;
        (dy[0], dy[1]) = (y[2], y[3]);
        [dy[2], dy[3]] = attraction([y[0], y[1]]);
    }

    fn derivatives(&mut self, _t: &Eight, y: &[Eight], dy: &mut [Eight]) -> bool {
        if !self.has_lanes {
            return false;
        }
        self.states_seen += 8;
        (dy[0], dy[1]) = (y[2], y[3]);
        for lane in 0..8 {
            [dy[2].0[lane], dy[3].0[lane]] = attraction([y[0].0[lane], y[1].0[lane]]);
        }
        true
    }

    fn rate_of(&self, i: usize) -> Option<usize> {
        (self.tells_rates && i < 2).then_some(i + 2)
    }
}

/// The orbit of eccentricity `e`, `t` after the passage of the perihelion (Kepler's equation).
fn orbit(e: f64, t: f64) -> [f64; 4] {
    let turns = (t / std::f64::consts::TAU).round();
    let mean = t - turns * std::f64::consts::TAU;
    let mut angle = mean + e * mean.sin();
    for _ in 0..50 {
        angle -= (angle - e * angle.sin() - mean) / (1.0 - e * angle.cos());
    }
    let (sin, cos) = angle.sin_cos();
    let (minor, rate) = ((1.0 - e * e).sqrt(), 1.0 / (1.0 - e * cos));
    [cos - e, minor * sin, -sin * rate, minor * cos * rate]
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn errors_inside_steps_and_at_their_ends_follow_the_tolerance() {
    for relative in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12] {
        for (e, begin) in [(0.05, 0.0), (0.2, 1.0), (0.35, 2.0), (0.5, -3.0), (0.6, 2.5)] {
            let (mut stepper, mut system) = (GaussLanes::new(tolerance(relative)), WITH_RATES);
            stepper.start(&mut system, begin, &orbit(e, begin), 4);
            let (mut inside, mut at_end) = (0.0_f64, 0.0_f64);
            let mut y = [0.0; 4];
            follow(&mut stepper, &mut system, begin + 6.0, |stepper| {
                let window = stepper.window();
                at_end = at_end.max(distance(&window.end_state, &orbit(e, window.end_time)));
                for i in 0..20 {
                    let x = f64::from(i) / 20.0;
                    stepper.interpolate(x, &mut y);
                    inside = inside.max(distance(&y, &orbit(e, window.time + x * window.length())));
                }
            });
            // In one turn a local error is magnified by about 6 π / (1 − e)².
            let magnified = 20.0 / (1.0 - e).powi(2);
            let rounding = 1e-14 * magnified;
            assert!(at_end < magnified * relative + rounding, "{relative:e} {e}: {at_end:e}");
            assert!(inside < magnified * relative + rounding, "{relative:e} {e}: {inside:e}");
        }
    }
}

#[test]
fn what_rounds_leave_does_not_dominate_the_error() {
    let mut sum = 0.0;
    for relative in [1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11] {
        for e in [0.1, 0.2, 0.3, 0.4] {
            let (mut stepper, mut system) = (GaussLanes::new(tolerance(relative)), WITH_RATES);
            stepper.start(&mut system, 0.5, &orbit(e, 0.5), 4);
            follow(&mut stepper, &mut system, 12.0, |_| ());
            let error = distance(&stepper.window().state, &orbit(e, 12.0));
            sum += (error / relative).log10();
        }
    }
    // The mean of all errors is below a thirtieth of the tolerance.
    let mean = sum / 24.0;
    assert!(mean < -1.5, "{mean}");
}

#[test]
fn one_state_after_the_other_and_eight_at_once_give_the_same_bits() {
    let run = |mut system: Kepler| {
        let mut stepper = GaussLanes::new(tolerance(1e-10));
        stepper.start(&mut system, 0.0, &orbit(0.4, 0.0), 4);
        let (mut seen, mut y) = (Vec::new(), [0.0; 4]);
        let counts = follow(&mut stepper, &mut system, 9.0, |stepper| {
            stepper.interpolate(0.3, &mut y);
            seen.push((stepper.window().end_state.clone(), y));
        });
        assert_eq!(counts.evaluations, system.states_seen);
        (seen, counts)
    };
    for tells_rates in [false, true] {
        let scalar = Kepler { tells_rates, ..PLAIN };
        assert_eq!(run(scalar), run(Kepler { has_lanes: true, ..scalar }));
    }
}

#[test]
fn rates_change_the_way_to_a_solution_and_not_the_solution() {
    let end = |mut system: Kepler| {
        let mut stepper = GaussLanes::new(tolerance(1e-12));
        stepper.start(&mut system, 0.0, &orbit(0.4, 0.0), 4);
        let counts = follow(&mut stepper, &mut system, 9.0, |_| ());
        (stepper.window().state.clone(), counts.evaluations)
    };
    let ((plain, more), (with_rates, fewer)) = (end(PLAIN), end(WITH_RATES));
    assert!(distance(&plain, &with_rates) < 1e-10, "{plain:?} {with_rates:?}");
    assert!(fewer < more, "{fewer} {more}");
}

#[test]
fn a_step_is_taken_again_to_a_shorter_length_in_a_few_iterations() {
    let (mut stepper, mut system) = (GaussLanes::new(tolerance(1e-10)), WITH_RATES);
    stepper.start(&mut system, 0.0, &orbit(0.4, 0.0), 4);
    let (mut most, mut y) = (0, [0.0; 4]);
    while stepper.window().time < 9.0 {
        stepper.step(&mut system, 20.0).expect("a smooth problem");
        stepper.prepare_dense(&mut system);
        let (start, step) = (stepper.window().time, stepper.window().length());
        let before = stepper.window().counts.evaluations;
        stepper.retake(&mut system, 0.37 * step);
        most = most.max(stepper.window().counts.evaluations - before);
        let window = stepper.window();
        assert_eq!(window.end_time, start + 0.37 * step);
        // Dense output stays that of the whole step.
        for (time, found) in [
            (start + 0.37 * step, &window.end_state[..]),
            (start + 0.1 * step, {
                stepper.interpolate(0.1, &mut y);
                &y
            }),
        ] {
            let error = distance(found, &orbit(0.4, time));
            // Errors of one turn and a half.
            assert!(error < 2e-8, "{error:e} at {time}");
        }
        stepper.advance();
    }
    assert!(most <= 4 * 8, "{most} evaluations");
}

#[test]
fn a_refused_step_tells_the_shorter_one_where_to_begin() {
    let (mut stepper, mut system) = (GaussLanes::new(tolerance(1e-10)), WITH_RATES);
    stepper.start(&mut system, 0.0, &orbit(0.7, 0.0), 4);
    // Steps and their rounds, by how often they were refused, each time after four rounds: never, once, more.
    let mut of_steps = [[0; 2]; 3];
    while stepper.window().time < 60.0 {
        let before = stepper.window().counts;
        stepper.step(&mut system, f64::INFINITY).expect("a smooth problem");
        let after = stepper.window().counts;
        let [steps, rounds] = &mut of_steps[(after.rejected - before.rejected).min(2)];
        *steps += 1;
        *rounds += (after.evaluations - before.evaluations) / 8;
        stepper.advance();
    }
    let [[kept, rounds], [refused, with_first], _] = of_steps;
    assert!(refused > 5, "{refused}");
    let again = with_first as f64 / refused as f64 - 4.0;
    let usual = rounds as f64 / kept as f64;
    assert!(again < usual - 0.5, "{again} {usual}");
}

/// Evaluations for a step of an orbit that is `share` as long as the one before, where the method goes on and
/// where it starts anew.
fn evaluations_of_a_step(share: f64) -> [usize; 2] {
    let (mut system, step) = (WITH_RATES, 0.5);
    let [mut goes_on, mut starts] = [(); 2].map(|()| GaussLanes::new(tolerance(1e-10)));
    goes_on.start(&mut system, 0.0, &orbit(0.2, 0.0), 4);
    goes_on.retake(&mut system, step);
    goes_on.advance();
    starts.start(&mut system, step, &goes_on.window().state, 4);
    [goes_on, starts].map(|mut stepper| {
        let before = stepper.window().counts.evaluations;
        stepper.retake(&mut system, share * step);
        stepper.window().counts.evaluations - before
    })
}

#[test]
fn a_step_begins_with_the_polynomial_of_the_one_before() {
    // One over all of the next step tells its slopes better than the slope at its start.
    for share in [0.3, 0.6, 1.0] {
        let [goes_on, starts] = evaluations_of_a_step(share);
        assert!(goes_on < starts, "{share}: {goes_on} {starts}");
    }
}

#[test]
fn a_start_remembers_nothing() {
    let mut system = WITH_RATES;
    let (first, second) = (orbit(0.5, 0.0), orbit(0.1, 2.0));
    let after = |stepper: &mut GaussLanes, system: &mut Kepler| {
        stepper.start(system, 0.5, &second, 4);
        follow(stepper, system, 4.0, |_| ());
        (stepper.window().state.clone(), stepper.window().counts.accepted)
    };
    let mut used = GaussLanes::new(tolerance(1e-9));
    used.start(&mut system, 0.0, &first, 4);
    let before = follow(&mut used, &mut system, 3.0, |_| ()).accepted;
    let (state, count) = after(&mut used, &mut system);
    let (expected, fresh) = after(&mut GaussLanes::new(tolerance(1e-9)), &mut system);
    assert_eq!((state, count - before), (expected, fresh));
}

#[test]
fn the_tightest_tolerance_is_met_to_rounding() {
    for relative in [1e-14, 1e-15] {
        let (mut stepper, mut system) = (GaussLanes::new(tolerance(relative)), WITH_RATES);
        stepper.start(&mut system, 0.0, &orbit(0.2, 0.0), 4);
        let counts = follow(&mut stepper, &mut system, 12.0, |_| ());
        let error = distance(&stepper.window().state, &orbit(0.2, 12.0));
        // Two turns magnify errors about forty times.
        assert!(error < 40.0 * 1e-14, "{relative:e}: {error:e}");
        assert!(counts.rejected < 5 && counts.accepted < 60, "{counts:?}");
    }
}

/// Nothing moves before a time, and afterwards it does.
struct Waiting;

impl System for Waiting {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1]) = (y[1], 0.0);
    }

    fn rate_of(&self, i: usize) -> Option<usize> {
        (i == 0).then_some(1)
    }
}

#[test]
fn where_nothing_moves_the_next_step_is_infinite() {
    let mut stepper = GaussLanes::new(tolerance(1e-9));
    stepper.start(&mut Waiting, 0.0, &[0.3, 0.0], 2);
    assert_eq!(stepper.window().next_step, f64::INFINITY);
    let counts = follow(&mut stepper, &mut Waiting, 5.0, |_| ());
    assert_eq!(stepper.window().state, [0.3, 0.0]);
    assert!(counts.accepted < 30, "{counts:?}");
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
    let mut stepper = GaussLanes::new(tolerance(1e-10));
    stepper.start(&mut Clock, 0.0, &[0.0], 1);
    for _ in 0..count {
        stepper.retake(&mut Clock, step);
        stepper.advance();
    }
    // A plain sum is off by 1.9e-8; weights and steps are rounded, by the same in each step.
    let off = (stepper.window().state[0] - step * f64::from(count)).abs();
    assert!(off < 1e-16 * f64::from(count), "{off:e}");
}

/// y = t³ with ẏ as the second variable, whose derivative is straight.
struct Cubic;

impl System for Cubic {
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
        (dy[0], dy[1]) = (y[1], 6.0 * t);
    }
}

/// The first guess has the second variable then, so one round finds the first one, and another that this is all.
#[test]
fn a_start_goes_on_as_derivatives_change_there() {
    let mut stepper = GaussLanes::new(tolerance(1e-9));
    stepper.start(&mut Cubic, 1.0, &[1.0, 3.0], 2);
    let begun = stepper.window().counts.evaluations;
    stepper.step(&mut Cubic, 1.25).expect("a smooth motion");
    let window = stepper.window();
    assert_eq!(window.counts.evaluations - begun, 2 * 8);
    let error = (window.end_state[0] - window.end_time.powi(3)).abs();
    assert!(error < 1e-9, "{error:e}");
}
