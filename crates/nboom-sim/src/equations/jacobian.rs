use nboom_dynamics::Recursive;
use nboom_elements::Commands;
use nboom_model::{Mode, Scene};
use nboom_scalar::{Dual, Real, Vec3};

use crate::equations::layout::VariableLayout;
use crate::equations::rates::Rates;

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
    /// Of `mode`, in which held hinges have their angles in `beta` (all hinges).
    pub fn new(scene: &Scene, mode: &Mode, beta: &[f64]) -> Self {
        let mut dynamics = Recursive::new(scene);
        let beta: Vec<Dual<f64>> = beta.iter().map(|&angle| Dual::constant(angle)).collect();
        dynamics.set_mode(mode, &beta);
        let rates = Rates::new(scene, VariableLayout::of_no_hinges());
        Self { rates, dynamics, variables: Vec::new(), derivatives: Vec::new() }
    }

    /// Holds `commands` in place of those that it held.
    pub fn command(&mut self, commands: &Commands) {
        self.dynamics.command(commands);
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
        rates.write(dynamics, Recursive::accelerations, at, variables, derivatives);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equations::Equations;
    use crate::equations::state::State;
    use crate::options::{Form, Options};
    use nboom_elements::OwnLaws;
    use nboom_formulation::Formulation;
    use nboom_model::{Course, External, ExternalAxes, ExternalKind, HingeState, SceneDescription};
    use nboom_ode::System;

    /// A reference scene, in motion, with every hinge free and every force acting.
    fn in_motion(name: &str, formulation: Option<Form>) -> (Equations, Vec<f64>) {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/scenes");
        let path = std::path::Path::new(folder).join(name).with_extension("nml");
        let deck = nboom_io::read_scene(&path).expect("reference decks are valid").scene;
        let mut description = SceneDescription::clone(&deck);
        let thrust = External::thrust(Vec3::new(0.3, -0.2, 0.5), Vec3::unit_y(), [0.0, 1.0]);
        let course = Course::Table(vec![[0.0, 1.0], [2.0, -0.5]]);
        let (axes, body) = (ExternalAxes::Inertial, description.bodies.len().checked_sub(1));
        description.externals.push(External { axes, body, course, ..thrust.clone() });
        description.externals.push(External { kind: ExternalKind::Torque, body, ..thrust });
        let scene = Scene::new(description).expect("a valid deck under more forces");
        let mut state = State::initial(&scene);
        for (i, (beta, tau)) in state.beta.iter_mut().zip(&mut state.tau).enumerate() {
            *beta += 0.2 + 0.1 * i as f64;
            *tau = 0.7 - 0.3 * i as f64;
        }
        state.omega_body += Vec3::new(0.3, -0.2, 0.5);
        let mode = Mode {
            hinges: vec![HingeState::Free; scene.bodies.len()],
            pieces: vec![0; Mode::at_start(&scene).pieces.len()],
            externals: vec![1; scene.externals.len()],
            drive: 0,
        };
        let options = Options { formulation, ..Options::default() };
        let (mut equations, mut y) =
            (Equations::new(&scene, OwnLaws::default(), &options), Vec::new());
        equations.enter(&mode, &mut state, &mut y);
        y.iter_mut().skip(equations.variables.layout.hinge_motion().end).for_each(|y| *y = 0.4);
        (equations, y)
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
        for name in [
            "s01_rigid_body",
            "s03_chain3_general",
            "s04_paddle_general",
            "s06_gravity_thrust",
            "s07_quadratic_terms",
            "s08_kickoff_disengage",
        ] {
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
