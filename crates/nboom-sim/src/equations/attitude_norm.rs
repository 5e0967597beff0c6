/// The norm of the attitude as if it were never put back to 1.
pub(crate) struct AttitudeNorm {
    /// The norm that the attitude has.
    present: f64,
    /// How far from 1 it would be.
    drift: f64,
    pub largest_drift: f64,
}

impl AttitudeNorm {
    pub fn new() -> Self {
        Self { present: 1.0, drift: 0.0, largest_drift: 0.0 }
    }

    /// Notes the norm after a step.
    pub fn follow(&mut self, norm: f64) {
        self.drift += norm - self.present;
        self.largest_drift = self.largest_drift.max(self.drift.abs());
        self.present = norm;
    }

    /// Notes that the attitude was scaled to norm 1.
    pub fn put_back(&mut self) {
        self.present = 1.0;
    }
}
