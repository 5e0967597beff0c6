/// Settings of a deck for the original's integrator and printer (group &ROCK and flags), Table
/// 16.1.
///
/// Nothing here changes a scene. `None`: not given (or zero, where zero makes no sense).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LegacySettings {
    /// `HZO`: first step of the `rkam` integrator \[T\], positive.
    pub first_step: Option<f64>,
    /// `EU1` or `EU`: halve the step above this difference of predictor and corrector, positive.
    pub upper_error: Option<f64>,
    /// `EL1` or `EL`: double the step below this difference, not negative.
    pub lower_error: Option<f64>,
    /// `HMIN`: smallest step \[T\], not negative.
    pub min_step: Option<f64>,
    /// `HMAX`: largest step \[T\], positive.
    pub max_step: Option<f64>,
    /// `LSTEP`: most steps, positive.
    pub max_steps: Option<usize>,
    /// `IAX`: steps (output times) from one printout to the next after the twentieth, positive.
    pub print_interval: Option<usize>,
    /// `INSTR`: printouts from one stress computation to the next; 0 for no stresses.
    pub stress_interval: usize,
    /// `NOPLT`: whether plots are wanted.
    pub plots: Option<bool>,
}

impl LegacySettings {
    /// Whether the integrator of 1970 is steered by any of them.
    pub fn has_integrator_settings(&self) -> bool {
        let steps = [self.first_step, self.min_step, self.max_step];
        let errors = [self.upper_error, self.lower_error];
        steps.iter().chain(&errors).any(Option::is_some) || self.max_steps.is_some()
    }
}
