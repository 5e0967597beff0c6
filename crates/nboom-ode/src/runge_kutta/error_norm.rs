//! How large the error of a step is.

use nboom_scalar::{Work, vectorised};

use super::RungeKutta;
use crate::tableau::Row;
use crate::weighted_sum::sum_up;
use crate::{Tolerance, Window};

impl RungeKutta {
    /// Estimated error of the step in units of the tolerance.
    pub(super) fn error_norm(&mut self, step: f64) -> f64 {
        let Self { tableau, stages, sums: [errors, lowers], .. } = self;
        sum_up(stages, tableau.error, 1.0, errors);
        sum_up(stages, tableau.lower_error, 1.0, lowers);
        vectorised(Squares {
            tolerance: self.tolerance,
            window: &self.window,
            errors: &mut errors[..self.controlled],
            lowers: &mut lowers[..self.controlled],
        });
        let [error, lower]: [f64; 2] =
            [errors, lowers].map(|squares| squares[..self.controlled].iter().sum());
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

    pub(super) fn estimate(&self, weights: Row, i: usize) -> f64 {
        weights.iter().map(|&(j, e)| e * self.stages[j * self.stride + i]).sum()
    }

    pub(super) fn scale_of(&self, i: usize) -> f64 {
        let Window { state, end_state, sizes, .. } = &self.window;
        scale(self.tolerance, sizes[i], state[i], end_state[i])
    }

    /// Root mean square of `values` over the controlled variables, in units of the tolerance.
    pub(super) fn norm(&self, values: impl Fn(usize) -> f64) -> f64 {
        let square = |i: usize| (values(i) / self.scale_of(i)).powi(2);
        ((0..self.controlled).map(square).sum::<f64>() / self.controlled.max(1) as f64).sqrt()
    }
}

/// The error allowed in a variable of this natural size over a step from one value to another.
#[inline(always)]
fn scale(tolerance: Tolerance, size: f64, start: f64, end: f64) -> f64 {
    tolerance.allowed(size, start.abs().max(end.abs()))
}

/// Makes of estimated errors their squares in units of the tolerance.
struct Squares<'a> {
    tolerance: Tolerance,
    window: &'a Window,
    errors: &'a mut [f64],
    lowers: &'a mut [f64],
}

impl Work for Squares<'_> {
    #[inline(always)]
    fn carry_out(self) {
        let Self { tolerance, window: Window { state, end_state, sizes, .. }, errors, lowers } =
            self;
        let values = sizes.iter().zip(state.iter().zip(end_state));
        for ((error, lower), (size, (start, end))) in errors.iter_mut().zip(lowers).zip(values) {
            let inverse = 1.0 / scale(tolerance, *size, *start, *end);
            (*error, *lower) = ((*error * inverse).powi(2), (*lower * inverse).powi(2));
        }
    }
}
