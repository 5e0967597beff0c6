/// Equal steps to a limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    limit: f64,
    origin: f64,
    pub step: f64,
    steps: f64,
    /// How many of them have been taken.
    taken: f64,
}

/// Share of a step by which all may be longer to make one fewer.
const STRETCH: f64 = 1e-6;

impl Default for Plan {
    /// No limit is known.
    fn default() -> Self {
        Self { limit: f64::NAN, origin: 0.0, step: 0.0, steps: 0.0, taken: 0.0 }
    }
}

impl Plan {
    /// Plans steps of at most `longest` from `time` to `limit`, unless that is the plan already.
    pub fn head_for(&mut self, limit: f64, time: f64, longest: f64) {
        if limit != self.limit {
            let span = limit - time;
            let steps = (span / longest - STRETCH).ceil().max(1.0);
            *self = Self { limit, origin: time, step: span / steps, steps, taken: 0.0 };
        }
    }

    /// Where the next step ends; times do not add up rounding errors.
    pub fn end(&self) -> f64 {
        let taken = self.taken + 1.0;
        if taken == self.steps { self.limit } else { self.origin + taken * self.step }
    }

    pub fn advance(&mut self) {
        self.taken += 1.0;
    }
}
