use nboom_scalar::{Eight, EightNumbers, WorkOnEight, in_registers};

use super::{RungeKutta, Squares};
use crate::Tolerance;
use crate::tableau::{Row, Tableau};

mod ends;

use ends::{Dense, Estimates, sum_of};

/// Steps of eight systems side by side, each from its own start and of its own length: an explicit method's stages,
/// its estimates of errors and terms of dense output, one lane of a register for each system.
///
/// Nothing goes from one lane to another, so a step does not depend on the others.
#[derive(Clone, Debug)]
pub struct EightSteps {
    tableau: &'static Tableau,
    tolerance: Tolerance,
    /// Variables of each system.
    size: usize,
    /// How many of these are controlled.
    controlled: usize,
    /// Stages that are evaluated, the one at the start included.
    count: usize,
    times: Eight,
    lengths: Eight,
    start: Vec<Eight>,
    /// Natural sizes of the variables.
    sizes: Vec<Eight>,
    /// The stages one after the other.
    stages: Vec<Eight>,
    argument: Vec<Eight>,
    /// The argument of the last stage but one of the step.
    before_end: Vec<Eight>,
    end: Vec<Eight>,
    /// Estimated errors.
    errors: Vec<Eight>,
    /// [`Squares`], those of errors first.
    squares: [Eight; 4],
    /// Terms of dense output, variable by variable; none without its stages.
    dense: Vec<Eight>,
}

impl EightSteps {
    /// Steps like those of `one`, `with_dense` with the stages for dense output, too.
    pub fn like(one: &RungeKutta, with_dense: bool) -> Self {
        let (tableau, size) = (one.tableau, one.size());
        let (count, terms) =
            if with_dense { (tableau.c.len(), one.terms()) } else { (tableau.stages + 1, 0) };
        let zeros = |count| vec![Eight::default(); count];
        Self {
            tableau,
            tolerance: one.tolerance,
            size,
            controlled: one.controlled,
            count,
            times: Eight::default(),
            lengths: Eight::default(),
            start: zeros(size),
            sizes: zeros(size),
            stages: zeros(size * count),
            argument: zeros(size),
            before_end: zeros(size),
            end: zeros(size),
            errors: zeros(size),
            squares: [Eight::default(); 4],
            dense: zeros(size * terms),
        }
    }

    /// Whether a step of `one` may be among them.
    pub fn are_like(&self, one: &RungeKutta, with_dense: bool) -> bool {
        self.tableau.method == one.tableau.method
            && self.tolerance == one.tolerance
            && [self.size, self.controlled] == [one.size(), one.controlled]
            && self.dense.is_empty() != with_dense
    }

    /// Variables of each system.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Evaluations of each step.
    pub fn evaluations(&self) -> usize {
        self.count - 1
    }

    /// Puts the step of `one` that has this length into a lane.
    pub fn put(&mut self, lane: usize, one: &RungeKutta, length: f64) {
        self.times.0[lane] = one.window.time;
        self.lengths.0[lane] = length;
        let variables = self.start.iter_mut().zip(&mut self.stages);
        for ((start, slope), (y, dy)) in variables.zip(one.window.state.iter().zip(&one.stages)) {
            (start.0[lane], slope.0[lane]) = (*y, *dy);
        }
        for (sizes, size) in self.sizes.iter_mut().zip(&one.window.sizes) {
            sizes.0[lane] = *size;
        }
    }

    /// Puts into the lanes from this one on what the first one has.
    pub fn repeat_first_from(&mut self, lane: usize) {
        let places = [&mut self.times, &mut self.lengths].into_iter();
        let stages = self.stages[..self.size].iter_mut();
        for numbers in places.chain(&mut self.start).chain(&mut self.sizes).chain(stages) {
            let first = numbers.0[0];
            numbers.0[lane..].fill(first);
        }
    }

    /// Takes the steps; `derivatives` writes f(t, y) of eight states.
    pub fn take(&mut self, mut derivatives: impl FnMut(&Eight, &[Eight], &mut [Eight])) {
        let Self { tableau, size, count, times, lengths, start, stages, argument, .. } = self;
        for stage in 1..*count {
            let (before, after) = stages.split_at_mut(stage * *size);
            let weights = tableau.a[stage];
            in_registers(Argument { start, stages: before, weights, lengths, out: argument });
            if stage + 1 == tableau.stages {
                self.before_end.copy_from_slice(argument);
            } else if stage == tableau.stages {
                self.end.copy_from_slice(argument);
            }
            let share = tableau.c[stage];
            let time = |lane: usize| times.0[lane] + share * lengths.0[lane];
            derivatives(&Eight(std::array::from_fn(time)), argument, &mut after[..*size]);
        }
        in_registers(Estimates(self));
        if !self.dense.is_empty() {
            in_registers(Dense(self));
        }
    }

    /// Gives `one` the step in a lane, which it put there.
    pub fn get(&self, lane: usize, one: &mut RungeKutta) {
        let last = self.tableau.stages;
        let slopes = &self.stages[last * self.size..];
        let variables = self.end.iter().zip(slopes).zip(&self.errors).enumerate();
        for (i, ((end, slope), error)) in variables {
            one.window.end_state[i] = end.0[lane];
            one.stage_state[i] = end.0[lane];
            one.stages[last * one.stride + i] = slope.0[lane];
            one.sums[0][i] = error.0[lane];
        }
        let [error, lower_error, slopes, arguments] = self.squares.map(|of| of.0[lane]);
        let squares = Squares { errors: [error, lower_error], differences: [slopes, arguments] };
        one.squares = Some(squares);
        for (term, found) in one.dense.iter_mut().zip(&self.dense) {
            *term = found.0[lane];
        }
        one.has_dense = !self.dense.is_empty();
        one.window.counts.evaluations += self.evaluations();
    }
}

/// The argument of a stage of eight systems: the start, and a weighted sum of the stages before.
struct Argument<'a> {
    start: &'a [Eight],
    stages: &'a [Eight],
    weights: Row,
    lengths: &'a Eight,
    out: &'a mut [Eight],
}

impl WorkOnEight for Argument<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let Self { start, stages, weights, lengths, out } = self;
        let (size, length) = (start.len(), R::load(lengths));
        let (start, stages, out) = (R::all(start), R::all(stages), R::all_mut(out));
        for i in 0..size {
            out[i] = sum_of(stages, weights, size, i).mul_add(length, start[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Stepper, System, Tolerance};

    /// Pendulums, each with a length of its own.
    struct Pendulum(f64);

    impl System for Pendulum {
        fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]) {
            (dy[0], dy[1]) = (y[1], -self.0 * y[0].sin() + 0.1 * t.cos());
        }
    }

    const LENGTHS: [f64; 8] = [0.7, 1.1, 0.3, 2.0, 1.7, 0.9, 1.3, 0.2];

    fn tolerance() -> Tolerance {
        Tolerance { relative: 1e-9, absolute: 1e-12 }
    }

    /// A started method at a time of its own.
    fn started(lane: usize, dopri5: bool) -> RungeKutta {
        let make = if dopri5 { RungeKutta::dopri5 } else { RungeKutta::dop853 };
        let mut one = make(tolerance());
        let start = [0.1 + 0.2 * lane as f64, 0.5];
        one.start(&mut Pendulum(LENGTHS[lane]), 0.3 * lane as f64, &start, 2);
        one
    }

    fn derivatives(t: &Eight, y: &[Eight], dy: &mut [Eight]) {
        derivatives_of(LENGTHS, t, y, dy);
    }

    fn derivatives_of(lengths: [f64; 8], t: &Eight, y: &[Eight], dy: &mut [Eight]) {
        for lane in 0..8 {
            let mut found = [0.0; 2];
            let one = [y[0].0[lane], y[1].0[lane]];
            Pendulum(lengths[lane]).derivative(t.0[lane], &one, &mut found);
            (dy[0].0[lane], dy[1].0[lane]) = (found[0], found[1]);
        }
    }

    #[test]
    fn a_step_side_by_side_is_that_of_the_method_alone() {
        for dopri5 in [false, true] {
            let mut steps = EightSteps::like(&started(0, dopri5), true);
            for lane in 0..8 {
                steps.put(lane, &started(lane, dopri5), 0.05 + 0.01 * lane as f64);
            }
            steps.take(derivatives);
            for lane in 0..8 {
                let (length, mut system) = (0.05 + 0.01 * lane as f64, Pendulum(LENGTHS[lane]));
                let (mut alone, mut beside) = (started(lane, dopri5), started(lane, dopri5));
                alone.retake(&mut system, length);
                steps.get(lane, &mut beside);
                beside.end_after(length);
                let before = beside.window().counts.evaluations;
                alone.prepare_dense(&mut system);
                beside.prepare_dense(&mut system);
                assert_eq!(beside.window().counts.evaluations, before, "stages were there");
                let (mut a, mut b) = ([0.0; 2], [0.0; 2]);
                for fraction in [0.0, 0.3, 0.8, 1.0] {
                    alone.interpolate(fraction, &mut a);
                    beside.interpolate(fraction, &mut b);
                    for (a, b) in a.iter().zip(&b) {
                        // Products and sums are fused or not.
                        assert!((a - b).abs() < 1e-15, "lane {lane}: {a} {b}");
                    }
                }
            }
        }
    }

    /// A number of the step beside others, less that of the step alone, as a share of it.
    fn departure(beside: f64, alone: f64) -> f64 {
        assert!(alone > 0.0 && alone.is_finite(), "{alone}");
        (beside / alone - 1.0).abs()
    }

    #[test]
    fn estimates_beside_others_are_those_of_the_method_alone() {
        for dopri5 in [false, true] {
            let mut steps = EightSteps::like(&started(0, dopri5), false);
            // Errors of so long steps are much larger than their rounding.
            let length = |lane: usize| 0.5 + 0.1 * lane as f64;
            (0..8).for_each(|lane| steps.put(lane, &started(lane, dopri5), length(lane)));
            steps.take(derivatives);
            for lane in 0..8 {
                let mut system = Pendulum(LENGTHS[lane]);
                let (mut alone, mut beside) = (started(lane, dopri5), started(lane, dopri5));
                alone.retake(&mut system, length(lane));
                steps.get(lane, &mut beside);
                beside.end_after(length(lane));
                let errors = [&mut beside, &mut alone].map(|one| one.error_norm(length(lane)));
                assert!(departure(errors[0], errors[1]) < 1e-4, "lane {lane}: {errors:?}");
                let stiffness = [&mut beside, &mut alone].map(RungeKutta::stiffness);
                assert!(departure(stiffness[0], stiffness[1]) < 1e-6, "lane {lane}: {stiffness:?}");
                for i in 0..2 {
                    let departure = departure(beside.error_of(i), alone.error_of(i));
                    assert!(departure < 1e-4, "lane {lane}, variable {i}: {departure}");
                }
            }
        }
    }

    #[test]
    fn dense_output_that_was_not_asked_for_is_made_afterwards() {
        let mut steps = EightSteps::like(&started(3, false), false);
        steps.put(0, &started(3, false), 0.1);
        steps.repeat_first_from(1);
        steps.take(|t, y, dy| derivatives_of([LENGTHS[3]; 8], t, y, dy));
        let mut system = Pendulum(LENGTHS[3]);
        let (mut alone, mut beside) = (started(3, false), started(3, false));
        alone.retake(&mut system, 0.1);
        alone.prepare_dense(&mut system);
        steps.get(0, &mut beside);
        beside.end_after(0.1);
        beside.prepare_dense(&mut system);
        let (mut a, mut b) = ([0.0; 2], [0.0; 2]);
        alone.interpolate(0.4, &mut a);
        beside.interpolate(0.4, &mut b);
        assert_eq!(a, b);
    }

    #[test]
    fn a_step_does_not_depend_on_those_beside_it() {
        let mut full = EightSteps::like(&started(0, false), false);
        for lane in 0..8 {
            full.put(lane, &started(lane, false), 0.1);
        }
        full.take(derivatives);
        let mut alone = EightSteps::like(&started(0, false), false);
        alone.put(0, &started(5, false), 0.1);
        alone.repeat_first_from(1);
        alone.take(|t, y, dy| {
            let of_fifth = |numbers: &Eight| Eight::splat(numbers.0[0]);
            let y: Vec<Eight> = y.iter().map(of_fifth).collect();
            derivatives(&of_fifth(t), &y, dy);
            let of_first: Vec<Eight> = dy.iter().map(|found| Eight::splat(found.0[5])).collect();
            dy.copy_from_slice(&of_first);
        });
        let (mut beside, mut by_itself) = (started(5, false), started(5, false));
        full.get(5, &mut beside);
        alone.get(0, &mut by_itself);
        assert_eq!(beside.window().end_state, by_itself.window().end_state);
        assert_eq!(beside.stages, by_itself.stages);
    }
}
