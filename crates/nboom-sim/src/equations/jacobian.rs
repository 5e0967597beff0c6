use nboom_dynamics::Recursive;
use nboom_elements::Commands;
use nboom_model::{Mode, RotorMotion, Scene};
use nboom_scalar::{Dual, Real, Vec3};

use crate::equations::layout::VariableLayout;
use crate::equations::rates::{ByRecursion, Rates};
use crate::equations::state::State;

/// Derivatives of the equations of one mode with respect to its variables: the recursion over
/// dual numbers, one variable at a time.
///
/// They are exact whatever code computes the accelerations, as all code computes the same ones.
pub(crate) struct Jacobian {
    dynamics: Recursive<Dual<f64>>,
    rates: Rates<Dual<f64>>,
    variables: Vec<Dual<f64>>,
    derivatives: Vec<Dual<f64>>,
}

impl Jacobian {
    /// Of `mode`, which is that of `dynamics`.
    pub fn new(scene: &Scene, mode: &Mode, dynamics: &Recursive<f64>) -> Self {
        let dynamics = dynamics.over(mode);
        let rates = Rates::new(scene, VariableLayout::of_no_hinges());
        Self { rates, dynamics, variables: Vec::new(), derivatives: Vec::new() }
    }

    /// Holds `commands` in place of those that it held.
    pub fn command(&mut self, commands: &Commands) {
        self.dynamics.command(commands);
    }

    /// Makes the rotors go on from `state`.
    pub fn spin_from(&mut self, state: &State) {
        let motions = state.rotors.iter().map(RotorMotion::of_constant);
        self.dynamics.spin_from(Dual::constant(state.time), motions);
    }

    /// Writes ∂ẏ/∂y at `y`, which stands as in `layout`, to `out`, row by row; at `time`
    /// `carried` is the velocity of what is [carried](Variables::carried), inertial axes.
    pub fn write(
        &mut self,
        layout: VariableLayout,
        (time, carried): (f64, Vec3<f64>),
        y: &[f64],
        out: &mut [f64],
    ) {
        let size = layout.len();
        self.rates.set_layout(layout);
        self.variables.resize(size, Dual::zero());
        self.derivatives.resize(size, Dual::zero());
        out.fill(0.0);
        for (variable, &value) in self.variables.iter_mut().zip(y) {
            *variable = Dual::constant(value);
        }
        // Nothing depends on the integrals that follow the controlled variables.
        for column in 0..layout.controlled() {
            self.variables[column] = Dual::variable(y[column]);
            self.differentiate(time, carried);
            for (row, rate) in self.derivatives.iter().enumerate() {
                out[row * size + column] = rate.derivative;
            }
            self.variables[column] = Dual::constant(y[column]);
        }
    }

    fn differentiate(&mut self, time: f64, carried: Vec3<f64>) {
        let Self { dynamics, rates, variables, derivatives, .. } = self;
        let at = (Dual::constant(time), Vec3::constant(carried));
        rates.write(dynamics, ByRecursion, at, variables, derivatives);
    }
}

#[cfg(test)]
mod tests {
    use crate::equations::Equations;
    use crate::equations::fixture::{SCENES, in_motion};
    use crate::options::Form;
    use nboom_formulation::Formulation;
    use nboom_ode::System;

    /// Central differences, row by row.
    fn differences(equations: &mut Equations, t: f64, y: &[f64]) -> Vec<f64> {
        let size = y.len();
        let mut found = vec![0.0; size * size];
        let (mut above, mut below) = (vec![0.0; size], vec![0.0; size]);
        for column in 0..size {
            let shift = 1e-5 * y[column].abs().max(0.1);
            let mut shifted = y.to_vec();
            shifted[column] = y[column] + shift;
            equations.derivative(t, &shifted, &mut above);
            shifted[column] = y[column] - shift;
            equations.derivative(t, &shifted, &mut below);
            for row in 0..size {
                found[row * size + column] = (above[row] - below[row]) / (2.0 * shift);
            }
        }
        found
    }

    #[test]
    fn derivatives_are_the_limits_of_differences() {
        for name in SCENES {
            for formulation in [None, Some(Form::Closed(Formulation::Momentum))] {
                are_the_limits_of_differences(name, formulation);
            }
        }
    }

    fn are_the_limits_of_differences(name: &str, formulation: Option<Form>) {
        let (mut equations, y) = in_motion(name, formulation);
        let t = 0.7;
        let mut exact = vec![0.0; y.len() * y.len()];
        assert!(equations.jacobian(t, &y, &mut exact));
        let expected = differences(&mut equations, t, &y);
        for (row, (exact, expected)) in
            exact.chunks(y.len()).zip(expected.chunks(y.len())).enumerate()
        {
            let scale = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for (column, (a, b)) in exact.iter().zip(expected).enumerate() {
                // Shifts squared, times a third derivative; and rounding over shifts.
                let close = (a - b).abs() < 1e-8 * scale;
                assert!(close, "{name}: row {row}, column {column}: {a} {b}");
            }
        }
    }
}
