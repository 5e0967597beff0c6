use nboom_ode::{Bernstein, Stepper};

/// The angles of the free hinges over a step, each made when it is first asked for.
#[derive(Default)]
pub(crate) struct Angles(Vec<Option<Bernstein>>);

impl Angles {
    /// Those of another step of a mode with so many free hinges.
    pub fn begin(&mut self, free: usize) {
        self.0.clear();
        self.0.resize(free, None);
    }

    /// That of the free hinge `position`; variable `first` is that of the first one.
    pub fn of(&mut self, position: usize, first: usize, stepper: &dyn Stepper) -> &Bernstein {
        self.0[position].get_or_insert_with(|| stepper.polynomial(first + position))
    }

    /// That of the free hinge `position`, if it was asked for.
    pub fn known(&self, position: usize) -> Option<&Bernstein> {
        self.0[position].as_ref()
    }
}
