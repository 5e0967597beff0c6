use nboom_scalar::{Eight, EightNumbers, WorkOnEight, in_registers};

use super::collocation::Collocation;
use crate::System;
use crate::gauss::coefficients::STAGES;
use crate::side_by_side::{SideBySide, Variables, load, product};

/// The stages of a step side by side: for each variable one number of each.
#[derive(Clone, Debug, Default)]
pub(super) struct Stages {
    pub variables: Variables,
    /// K = h f(Y), but of integrals.
    pub slopes: Vec<Eight>,
    /// Y, and f(Y) but of integrals.
    pub states: SideBySide,
}

/// Where a step begins, and how long it is.
#[derive(Clone, Copy)]
pub(super) struct Start<'a> {
    pub state: &'a [f64],
    /// What rounding has taken from the variables.
    pub lost: &'a [f64],
    pub step: f64,
}

impl Stages {
    pub fn start(&mut self, system: &dyn System, size: usize) {
        self.variables.assign(system, size, size);
        self.states.resize(size);
        self.slopes.clear();
        self.slopes.resize(size, Eight::default());
    }

    /// Guesses slopes from those of another step, whose polynomial is continued from a fraction of it
    /// over `ratio` times its length.
    pub fn predict(&mut self, known: &[Eight], from: f64, ratio: f64, collocation: &Collocation) {
        let Self { variables, slopes, .. } = self;
        in_registers(Predict { variables, known, from, ratio, collocation, slopes });
    }

    /// Puts the stages where their slopes place them.
    pub fn place(&mut self, start: Start<'_>, collocation: &Collocation) {
        let Self { variables, slopes, states } = self;
        let values = &mut states.values;
        in_registers(Place { variables, start, collocation, slopes, values });
    }

    /// Takes the derivatives for its slopes and places the stages there; returns the change of each
    /// stage's slopes, as the sum of squares over all variables, each by its part of `weights`.
    pub fn absorb(
        &mut self,
        start: Start<'_>,
        weights: &[f64],
        collocation: &Collocation,
    ) -> Eight {
        let Self { variables, slopes, states: SideBySide { values, derivatives, .. } } = self;
        in_registers(Absorb { variables, start, collocation, weights, derivatives, slopes, values })
    }
}

struct Predict<'a> {
    variables: &'a Variables,
    known: &'a [Eight],
    from: f64,
    ratio: f64,
    collocation: &'a Collocation,
    slopes: &'a mut [Eight],
}

impl WorkOnEight for Predict<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let matrix = self.collocation.continuation::<R>(self.from, self.ratio);
        for &i in &self.variables.evaluated {
            product(&matrix, &self.known[i].0).store(&mut self.slopes[i]);
        }
    }
}

struct Place<'a> {
    variables: &'a Variables,
    start: Start<'a>,
    collocation: &'a Collocation,
    slopes: &'a [Eight],
    values: &'a mut [Eight],
}

impl WorkOnEight for Place<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let Self { variables, start: Start { state, lost, step }, collocation, slopes, values } =
            self;
        let matrix = load::<R, STAGES>(&collocation.stages);
        for &i in &variables.evaluated {
            let increment = R::constant(lost[i]) + product(&matrix, &slopes[i].0);
            (R::constant(state[i]) + increment).store(&mut values[i]);
        }
        let matrix = load::<R, STAGES>(&collocation.stages_twice);
        let (nodes, step) = (R::load(&collocation.nodes), R::constant(step));
        for &(i, rate) in &variables.integrals {
            let inner = product(&matrix, &slopes[rate].0);
            let mean_rate = nodes.mul_add(R::constant(state[rate] + lost[rate]), inner);
            let increment = step.mul_add(mean_rate, R::constant(lost[i]));
            (R::constant(state[i]) + increment).store(&mut values[i]);
        }
    }
}

struct Absorb<'a> {
    variables: &'a Variables,
    start: Start<'a>,
    collocation: &'a Collocation,
    weights: &'a [f64],
    derivatives: &'a [Eight],
    slopes: &'a mut [Eight],
    values: &'a mut [Eight],
}

impl WorkOnEight for Absorb<'_> {
    type Output = Eight;

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) -> Eight {
        let Self { variables, start, collocation, weights, derivatives, slopes, values } = self;
        let (step, mut squares) = (R::constant(start.step), R::zero());
        for &i in &variables.evaluated {
            let slope = step * R::load(&derivatives[i]);
            let change = (slope - R::load(&slopes[i])) * R::constant(weights[i]);
            squares = change.mul_add(change, squares);
            slope.store(&mut slopes[i]);
        }
        Place { variables, start, collocation, slopes, values }.carry_out::<R>();
        let mut of_stages = Eight::default();
        squares.store(&mut of_stages);
        of_stages
    }
}
