use super::newton::Attempt;
use super::{GOOD, NOT_WORTH_IT, Radau, Verdict};
use crate::System;

const SAFETY: f64 = 0.9;
/// Limits of the change of step size.
const SHRINK: f64 = 0.2;
const GROW: f64 = 8.0;
/// An error this small does not speed up the next step any more.
const SMALL_ERROR: f64 = 1e-2;
/// An error below this one counts as this one.
const SMALLEST_ERROR: f64 = 1e-10;

impl Radau {
    /// Estimates the error of a step that took `count` corrections.
    pub(super) fn judge(
        &mut self,
        system: &mut dyn System,
        step: f64,
        count: usize,
        rejected: bool,
    ) -> Verdict {
        let first = self.last.length == 0.0;
        let mut error = self.estimate(step);
        if error >= 1.0 && (first || rejected) {
            error = self.filtered_estimate(system, step);
        }
        let most = self.coefficients.most_corrections();
        let effort = (1 + 2 * most) as f64 / (count + 2 * most) as f64;
        let factor = (SAFETY * effort.min(1.0) / error.powf(self.coefficients.exponent()))
            .clamp(SHRINK, GROW);
        if error < 1.0 {
            let Self { stages, window, scales, .. } = self;
            stages.follow(system, &mut Attempt { window, step, scales });
            self.accept(step, error, first, factor)
        } else if first {
            Verdict::Rejected(0.1)
        } else {
            Verdict::Rejected(factor.min(SAFETY))
        }
    }

    fn accept(&mut self, step: f64, error: f64, first: bool, factor: f64) -> Verdict {
        let trend = (step / self.last.length)
            * (self.last.error / error.powi(2)).powf(self.coefficients.exponent());
        let predicted = (SAFETY * trend).clamp(SHRINK, GROW);
        let factor = if first { factor } else { factor.min(predicted) };
        self.last.error = error.max(SMALL_ERROR);
        self.keep(step);
        let worth_it = self.stages.contraction > GOOD || !(1.0..=NOT_WORTH_IT).contains(&factor);
        Verdict::Accepted(if worth_it { factor } else { 1.0 })
    }

    fn estimate(&mut self, step: f64) -> f64 {
        self.tried = step;
        self.error.copy_from_slice(&self.slope);
        self.solve_for_error(step)
    }

    /// The estimate made anew with the slope where the first one leads: where the system is
    /// stiff, the first is far too large.
    fn filtered_estimate(&mut self, system: &mut dyn System, step: f64) -> f64 {
        let Self { window, stages, error, .. } = self;
        for (out, (y, e)) in stages.states.argument.iter_mut().zip(window.state.iter().zip(&*error))
        {
            *out = y + e;
        }
        system.derivative(window.time, &stages.states.argument, error);
        window.counts.evaluations += 1;
        self.solve_for_error(step)
    }

    /// Turns the slope in `error` into the estimated error.
    fn solve_for_error(&mut self, step: f64) -> f64 {
        let Self { coefficients, stages, matrix, error, room, .. } = self;
        for (e, z) in error.iter_mut().zip(&stages.z) {
            *e = step * *e + coefficients.error.dot(z);
        }
        matrix.solve(&stages.variables, error, room);
        let norm = self.norm(|i| self.error[i]);
        if norm.is_nan() { f64::INFINITY } else { norm.max(SMALLEST_ERROR) }
    }
}
