/// Why no step could be taken.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum StepError {
    /// The step that meets the tolerance is too short to change the time.
    #[error("the step size fell to {step:e} at time {time}")]
    Underflow {
        /// Time of the step's start.
        time: f64,
        /// The step size.
        step: f64,
        /// The variable with the largest error.
        variable: usize,
    },
    /// The derivative is infinite or not a number.
    #[error("the derivative is not finite at time {time}")]
    NotFinite {
        /// Time of the step's start.
        time: f64,
        /// The first variable concerned.
        variable: usize,
    },
    /// The method needs power series, and the system has none.
    #[error("the system gives no power series at time {time}")]
    NoSeries {
        /// Time of the step's start.
        time: f64,
    },
}

impl StepError {
    /// The step that meets the tolerance is too short; the variable with the largest error is one of `variables`.
    pub(crate) fn underflow(
        time: f64,
        step: f64,
        variables: impl Iterator<Item = usize>,
        error_of: impl Fn(usize) -> f64,
    ) -> Self {
        let larger = |&a: &usize, &b: &usize| error_of(a).total_cmp(&error_of(b));
        let variable = variables.max_by(larger).unwrap_or(0);
        Self::Underflow { time, step, variable }
    }
}
