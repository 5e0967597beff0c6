use super::RungeKutta;

impl RungeKutta {
    /// The last step times about the magnitude of the fastest motion's eigenvalue, from the two
    /// derivatives at the step's end, of which one is at the last stage's argument.
    pub(crate) fn stiffness(&mut self) -> f64 {
        let last = self.tableau.stages;
        self.combine(last - 1, self.step);
        let (mut of_slopes, mut of_states) = (0.0, 0.0);
        for i in 0..self.controlled {
            let slope = |stage: usize| self.stages[stage * self.stride + i];
            let size = self.window.sizes[i];
            of_slopes += ((slope(last) - slope(last - 1)) / size).powi(2);
            of_states += ((self.window.end_state[i] - self.stage_state[i]) / size).powi(2);
        }
        if of_states > 0.0 { self.step * (of_slopes / of_states).sqrt() } else { 0.0 }
    }

    /// What [`stiffness`](Self::stiffness) may be without steps being bounded by it.
    pub(crate) fn stability_limit(&self) -> f64 {
        self.tableau.stability_limit
    }
}
