//! Coefficients of explicit Runge-Kutta methods.

use crate::Method;

pub(crate) mod dop853;
pub(crate) mod dopri5;

pub(crate) use dop853::DOP853;
pub(crate) use dopri5::DOPRI5;

/// (stage, coefficient) where the coefficient is not zero.
pub(crate) type Row = &'static [(usize, f64)];

/// An explicit method whose last stage is the derivative at the new point, with dense output
/// y₀ + x (c₀ + x̄ (c₁ + x (c₂ + x̄ (…)))), x the fraction of the step and x̄ = 1 − x.
#[derive(Debug)]
pub(crate) struct Tableau {
    /// The method.
    pub method: Method,
    /// Stages of a step; this is also the number of the derivative at the new point.
    pub stages: usize,
    /// Times of the stages, in steps, those for dense output at the end.
    pub c: &'static [f64],
    /// Weights of a stage's argument; the row `stages` is the new point.
    pub a: &'static [Row],
    /// Weights of the error estimate.
    pub error: Row,
    /// Weights of a second estimate of lower order, which the first is divided by.
    pub lower_error: Row,
    /// Weights of dense output's terms after the first three.
    pub dense: &'static [Row],
    /// Step control.
    pub control: Control,
    /// Step times eigenvalue at which the method's stability begins to bound steps; its last
    /// stage stands at the step's end.
    pub stability_limit: f64,
}

/// How the next step follows from the error of the last ones (Gustafsson's PI controller).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Control {
    /// 1 / order of the error in the step size.
    pub exponent: f64,
    /// Share of the memory's weight that is taken off the exponent.
    pub compensation: f64,
    /// Smallest change of step size.
    pub shrink: f64,
    /// Largest change of step size.
    pub grow: f64,
}

/// Weight of the previous error.
const MEMORY: f64 = 0.04;
const SAFETY: f64 = 0.9;

impl Control {
    /// The factor from the step taken to the next one.
    pub fn factor(&self, error: f64, previous: f64) -> f64 {
        let exponent = self.exponent - self.compensation * MEMORY;
        let growth = SAFETY * previous.powf(MEMORY) / error.powf(exponent);
        growth.clamp(self.shrink, self.grow)
    }
}
