use nboom_ode::{Bernstein, Stepper, Window};

/// The angles of the hinges over the step that is searched, each made when it is first asked for.
#[derive(Default)]
pub(crate) struct Angles {
    /// Start and length of the step.
    step: (f64, f64),
    over_step: Vec<Option<Bernstein>>,
}

impl Angles {
    /// Those of no step; room for so many hinges.
    pub fn forget(&mut self, hinges: usize) {
        self.step = (0.0, 0.0);
        self.over_step.clear();
        self.over_step.resize(hinges, None);
    }

    /// Those of another step.
    pub fn begin(&mut self, step: &Window) {
        self.step = (step.time, step.length());
        self.over_step.fill(None);
    }

    /// That of `hinge`, which is this variable.
    pub fn of(&mut self, hinge: usize, variable: usize, stepper: &dyn Stepper) -> &Bernstein {
        self.over_step[hinge].get_or_insert_with(|| stepper.polynomial(variable))
    }

    /// That of `hinge`, if it was asked for.
    pub fn known(&self, hinge: usize) -> Option<&Bernstein> {
        self.over_step[hinge].as_ref()
    }

    /// That of `hinge`, if it was asked for, at a time in the step or soon after it: angle, rate and acceleration.
    pub fn at(&self, hinge: usize, time: f64) -> Option<[f64; 3]> {
        let (start, length) = self.step;
        let [angle, rate, bend] = self.known(hinge)?.derivatives((time - start) / length);
        Some([angle, rate / length, bend / (length * length)])
    }

    /// The angle alone.
    pub fn angle_at(&self, hinge: usize, time: f64) -> Option<f64> {
        let (start, length) = self.step;
        Some(self.known(hinge)?.at((time - start) / length))
    }

    /// Length of the step.
    pub fn length(&self) -> f64 {
        self.step.1
    }
}
