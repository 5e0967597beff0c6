use std::any::Any;

use nboom_dynamics::Recursive;
use nboom_elements::Commands;
use nboom_model::{Mode, RotorMotion, Scene};
use nboom_scalar::{Dual, Eight, EightNumbers, Real, Vec3, WorkOnEight, in_vector_registers};

use crate::equations::layout::VariableLayout;
use crate::equations::rates::{ByRecursion, Rates};
use crate::equations::state::State;

/// Derivatives of the equations of one mode with respect to its variables: the recursion over
/// dual numbers, by eight variables at a time where there are vector registers, else by one.
///
/// They are exact whatever code computes the accelerations, as all code computes the same ones.
pub(crate) struct Jacobian {
    /// [`Columns`] over numbers that fill the registers of this processor, or over `f64`.
    columns: Box<dyn Any + Send + Sync>,
}

/// Derivatives by several variables, one in each number of an `R`.
struct Columns<R> {
    dynamics: Recursive<Dual<R>>,
    rates: Rates<Dual<R>>,
    variables: Vec<Dual<R>>,
    derivatives: Vec<Dual<R>>,
}

impl Jacobian {
    /// Of `mode`, which is that of `dynamics`.
    pub fn new(scene: &Scene, mode: &Mode, dynamics: &Recursive<f64>) -> Self {
        let columns = in_vector_registers(Make { scene, mode, dynamics });
        Self { columns: columns.unwrap_or_else(Make::over::<f64>) }
    }

    /// Holds `commands` in place of those that it held.
    pub fn command(&mut self, commands: &Commands) {
        self.go_on(Origin::Commands(commands));
    }

    /// Makes the rotors go on from `state`.
    pub fn spin_from(&mut self, state: &State) {
        self.go_on(Origin::Rotors(state));
    }

    fn go_on(&mut self, from: Origin<'_>) {
        let done = in_vector_registers(GoOn { jacobian: self, from });
        done.unwrap_or_else(GoOn::over::<f64>);
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
        let done = in_vector_registers(Write { jacobian: self, layout, time, carried, y, out });
        done.unwrap_or_else(|write| write.over::<f64, 1>(|_| 1.0, |of_one| [of_one]));
    }

    #[inline(always)]
    fn columns<R: Real>(&mut self) -> &mut Columns<R> {
        self.columns.downcast_mut().expect("a processor has the same registers as before")
    }
}

struct Make<'a> {
    scene: &'a Scene,
    mode: &'a Mode,
    dynamics: &'a Recursive<f64>,
}

impl Make<'_> {
    fn over<R: Real + Send + Sync>(self) -> Box<dyn Any + Send + Sync> {
        let rates = Rates::new(self.scene, VariableLayout::of_no_hinges());
        let dynamics = self.dynamics.over(self.mode);
        Box::new(Columns::<R> { dynamics, rates, variables: Vec::new(), derivatives: Vec::new() })
    }
}

impl WorkOnEight for Make<'_> {
    type Output = Box<dyn Any + Send + Sync>;

    fn carry_out<R: EightNumbers>(self) -> Self::Output {
        self.over::<R>()
    }
}

/// What derivatives go on from, besides the mode.
enum Origin<'a> {
    Commands(&'a Commands),
    Rotors(&'a State),
}

struct GoOn<'a> {
    jacobian: &'a mut Jacobian,
    from: Origin<'a>,
}

impl GoOn<'_> {
    fn over<R: Real>(self) {
        let dynamics = &mut self.jacobian.columns::<R>().dynamics;
        match self.from {
            Origin::Commands(commands) => dynamics.command(commands),
            Origin::Rotors(state) => {
                let motions = state.rotors.iter().map(RotorMotion::of_constant);
                dynamics.spin_from(Real::constant(state.time), motions);
            }
        }
    }
}

impl WorkOnEight for GoOn<'_> {
    type Output = ();

    fn carry_out<R: EightNumbers>(self) {
        self.over::<R>();
    }
}

struct Write<'a> {
    jacobian: &'a mut Jacobian,
    layout: VariableLayout,
    time: f64,
    carried: Vec3<f64>,
    y: &'a [f64],
    out: &'a mut [f64],
}

impl Write<'_> {
    /// Finds `N` columns at a time: `unit` is one in the place of one of them and zero in the others, and `each`
    /// the numbers of all.
    #[inline(always)]
    fn over<R: Real, const N: usize>(
        self,
        unit: impl Fn(usize) -> R,
        each: impl Fn(R) -> [f64; N],
    ) {
        let Self { jacobian, layout, time, carried, y, out } = self;
        let Columns { dynamics, rates, variables, derivatives } = jacobian.columns::<R>();
        let size = layout.len();
        rates.set_layout(layout);
        variables.clear();
        variables.extend(y.iter().map(|&value| <Dual<R> as Real>::constant(value)));
        derivatives.resize(size, Dual::zero());
        let number = <Dual<R> as Real>::constant;
        let at = (number(time), Vec3::new(number(carried.x), number(carried.y), number(carried.z)));
        out.fill(0.0);
        // Nothing depends on the integrals that follow the controlled variables.
        for first in (0..layout.controlled()).step_by(N) {
            let columns = first..layout.controlled().min(first + N);
            for (of, variable) in variables[columns.clone()].iter_mut().enumerate() {
                variable.derivative = unit(of);
            }
            rates.write(dynamics, ByRecursion, at, variables, derivatives);
            for (row, rate) in derivatives.iter().enumerate() {
                let found = each(rate.derivative);
                let row = &mut out[row * size..][columns.clone()];
                row.copy_from_slice(&found[..columns.len()]);
            }
            for variable in &mut variables[columns] {
                variable.derivative = R::zero();
            }
        }
    }
}

impl WorkOnEight for Write<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let unit = |of: usize| {
            let mut unit = Eight::default();
            unit.0[of] = 1.0;
            R::load(&unit)
        };
        let each = |of_all: R| {
            let mut found = Eight::default();
            of_all.store(&mut found);
            found.0
        };
        self.over::<R, 8>(unit, each);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::Equations;
    use crate::equations::fixture::{SCENES, in_motion};
    use crate::options::Form;
    use nboom_formulation::Formulation;
    use nboom_ode::System;

    #[test]
    fn columns_side_by_side_are_those_of_one_after_the_other() {
        for name in SCENES {
            let (mut equations, y) = in_motion(name, None);
            let time = 0.7;
            let mut found = vec![f64::NAN; y.len() * y.len()];
            assert!(equations.jacobian(time, &y, &mut found));
            let carried = equations.variables.carried(time).velocity;
            let layout = equations.variables.layout;
            let Equations { scene, entered, variables, .. } = &mut equations;
            let make = Make { scene, mode: &entered.mode, dynamics: &entered.dynamics };
            let mut of_one = Jacobian { columns: make.over::<f64>() };
            let from = Origin::Rotors(&variables.origin);
            GoOn { jacobian: &mut of_one, from }.over::<f64>();
            let mut expected = vec![f64::NAN; y.len() * y.len()];
            let out = &mut expected[..];
            let write = Write { jacobian: &mut of_one, layout, time, carried, y: &y, out };
            write.over::<f64, 1>(|_| 1.0, |of_one| [of_one]);
            for (row, (found, expected)) in
                found.chunks(y.len()).zip(expected.chunks(y.len())).enumerate()
            {
                let scale = expected.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
                for (column, (a, b)) in found.iter().zip(expected).enumerate() {
                    // Products and sums are fused here, sines from a polynomial.
                    let close = (a - b).abs() < 1e-12 * scale;
                    assert!(close, "{name}: row {row}, column {column}: {a} {b}");
                }
            }
        }
    }

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
