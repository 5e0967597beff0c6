//! What the stages of a step say of it.

use super::RungeKutta;
use crate::weighted_sum::sum_up;

/// Sums of squares over the controlled variables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Squares {
    /// Of estimated errors in units of the tolerance, and of those of lower order.
    pub errors: [f64; 2],
    /// Of the differences of the last two slopes and of their arguments in units of the variables' sizes.
    pub differences: [f64; 2],
}

impl RungeKutta {
    /// Estimated error of the step in units of the tolerance.
    pub(super) fn error_norm(&mut self, step: f64) -> f64 {
        let known = self.squares.map(|squares| squares.errors);
        let [error, lower] = known.unwrap_or_else(|| self.squares_of_errors());
        let finite = self.window.end_state.iter().all(|y| y.is_finite());
        if !finite || !(error + lower).is_finite() {
            return f64::INFINITY;
        }
        let count = self.controlled.max(1) as f64;
        if self.tableau.lower_error.is_empty() {
            return step.abs() * (error / count).sqrt();
        }
        let denominator = error + 0.01 * lower;
        if denominator <= 0.0 {
            return 0.0;
        }
        step.abs() * error / (denominator * count).sqrt()
    }

    /// Estimates the errors of the step; the [sums](Squares::errors) of their squares.
    fn squares_of_errors(&mut self) -> [f64; 2] {
        let Self { tableau, stages, sums: [errors, lowers], .. } = self;
        sum_up(stages, tableau.error, 1.0, errors);
        sum_up(stages, tableau.lower_error, 1.0, lowers);
        let mut squares = [0.0; 2];
        for i in 0..self.controlled {
            let inverse = 1.0 / self.scale_of(i);
            for (square, sums) in squares.iter_mut().zip(&self.sums) {
                *square += (sums[i] * inverse).powi(2);
            }
        }
        squares
    }

    /// The last step times about the magnitude of the fastest motion's eigenvalue, from the two
    /// derivatives at the step's end, of which one is at the last stage's argument.
    pub(crate) fn stiffness(&mut self) -> f64 {
        let known = self.squares.map(|squares| squares.differences);
        let [of_slopes, of_states] = known.unwrap_or_else(|| self.squares_of_differences());
        if of_states > 0.0 { self.step * (of_slopes / of_states).sqrt() } else { 0.0 }
    }

    /// The [sums](Squares::differences) of the squares of the last two slopes' and their arguments'
    /// differences.
    fn squares_of_differences(&mut self) -> [f64; 2] {
        let last = self.tableau.stages;
        self.combine(last - 1, self.step);
        let mut squares = [0.0; 2];
        for i in 0..self.controlled {
            let slope = |stage: usize| self.stages[stage * self.stride + i];
            let size = self.window.sizes[i];
            squares[0] += ((slope(last) - slope(last - 1)) / size).powi(2);
            squares[1] += ((self.window.end_state[i] - self.stage_state[i]) / size).powi(2);
        }
        squares
    }

    /// What [`stiffness`](Self::stiffness) may be without steps being bounded by it.
    pub(crate) fn stability_limit(&self) -> f64 {
        self.tableau.stability_limit
    }
}
