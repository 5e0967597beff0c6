use super::RungeKutta;
use crate::System;

impl RungeKutta {
    /// A first step from the times in which the first and the second derivative change the variables
    /// by what they are, after Hairer, Nørsett, Wanner, Section II.4, who measure them in units of
    /// time; infinite where nothing moves.
    pub(super) fn first_step(&mut self, system: &mut dyn System) -> f64 {
        let n = self.size();
        let size = self.norm(|i| self.window.magnitude(i));
        let by_slope = size / self.norm(|i| self.stages[i]);
        if !by_slope.is_finite() {
            return f64::INFINITY;
        }
        let guess = 0.01 * by_slope;
        for i in 0..n {
            self.stage_state[i] = self.window.state[i] + guess * self.stages[i];
        }
        let second = &mut self.stages[self.stride..][..n];
        system.derivative(self.window.time + guess, &self.stage_state[..n], second);
        self.window.counts.evaluations += 1;
        let stride = self.stride;
        let curvature = self.norm(|i| self.stages[stride + i] - self.stages[i]) / guess;
        let by_curvature = (size / curvature).sqrt();
        by_slope.min(by_curvature) * (0.01 / size).powf(self.tableau.control.exponent)
    }
}
