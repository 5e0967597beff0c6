use nboom_scalar::Eight;

/// A system of ordinary differential equations ẏ = f(t, y).
pub trait System {
    /// Writes f(t, y) to `dy`, which has the length of `y`.
    fn derivative(&mut self, t: f64, y: &[f64], dy: &mut [f64]);

    /// Writes the natural size of each variable to `sizes`, of which [`Tolerance::absolute`] is a
    /// share; asked where each step starts, at `y`. Sizes in proportion to the units that the variables
    /// are in make steps independent of units.
    fn sizes(&mut self, _y: &[f64], sizes: &mut [f64]) {
        sizes.fill(1.0);
    }

    /// Writes ∂f/∂y at (t, y) to `out`, row by row, and returns `true`; a system that returns
    /// `false` leaves it to the method to take differences. Only implicit methods ask.
    fn jacobian(&mut self, _t: f64, _y: &[f64], _out: &mut [f64]) -> bool {
        false
    }

    /// Writes the power series of the solution through (t, y) to `out` and returns `true`:
    /// y⁽ᵏ⁾/k! of all variables for k = 0, then for k = 1, and so on up to `order`. A system that
    /// returns `false` has none, and [`Taylor`](crate::Taylor) refuses it. Nobody else asks.
    fn series(&mut self, _t: f64, _y: &[f64], _order: usize, _out: &mut [f64]) -> bool {
        false
    }

    /// Writes f(t, y) of eight states to `dy` and returns `true`; a system that returns `false`
    /// leaves it to the method to take one state after the other. What is written for integrals
    /// ([`rate_of`](Self::rate_of)) is not read. [`GaussLanes`](crate::GaussLanes) and [`Radau`](crate::Radau) ask.
    fn derivatives(&mut self, _t: &Eight, _y: &[Eight], _dy: &mut [Eight]) -> bool {
        false
    }

    /// Whether [`derivatives`](Self::derivatives) takes eight states at once from now to the next start, for
    /// which it is made ready. Asked where [`GaussLanes`](crate::GaussLanes) or [`Radau`](crate::Radau) starts.
    fn takes_eight(&mut self) -> bool {
        false
    }

    /// What evaluations cost; asked by [`Automatic`](crate::Automatic), where a motion goes on and, under very tight
    /// tolerances, where it starts.
    fn pace(&mut self) -> Pace {
        if self.takes_eight() { Pace::SideBySide } else { Pace::Slow }
    }

    /// The variable that is the derivative of variable `i`, as the rate of an angle is; asked at a start,
    /// by implicit methods. That variable is controlled ([`Stepper::start`](crate::Stepper::start)), has no such variable
    /// itself, and is that of no other.
    fn rate_of(&self, _i: usize) -> Option<usize> {
        None
    }
}

/// What evaluations cost, beside one another and beside the rest of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pace {
    /// Eight at once cost far less than one after the other, so methods with many side by side pay.
    SideBySide,
    /// One costs little more than the sums over a few stages or steps.
    Fast,
    /// One costs far more than these, so methods with few evaluations pay.
    Slow,
}

/// Error allowed in a step: `absolute · size + relative · |y|` for each variable, whose natural
/// size [`System::sizes`] tells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Relative part.
    pub relative: f64,
    /// Absolute part, as a share of the variable's natural size.
    pub absolute: f64,
}

impl Tolerance {
    /// The error allowed in a variable of natural size `size` whose value is `value`.
    pub(crate) fn allowed(self, size: f64, value: f64) -> f64 {
        self.absolute * size + self.relative * value.abs()
    }
}

/// What integration has cost so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Steps accepted.
    pub accepted: usize,
    /// Steps rejected.
    pub rejected: usize,
    /// Evaluations of the derivative, those for differences included, or of power series.
    pub evaluations: usize,
    /// Evaluations of the Jacobian.
    pub jacobians: usize,
    /// Factorisations of iteration matrices.
    pub factorizations: usize,
}
