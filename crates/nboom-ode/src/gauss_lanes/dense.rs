use nboom_scalar::{Eight, EightNumbers, Work, WorkOnEight, in_registers, vectorised};
use rule::{KNOWN, MIDDLE, NODES, Rule, Spectrum, integrals, node, second_integrals};

use super::collocation::{Collocation, dot};
use super::stages::Stages;
use crate::gauss::coefficients::STAGES;
use crate::side_by_side::{Variables, load, product};
use crate::{Bernstein, System};

mod rule;

/// The motion inside a step, as accurate as at its end.
///
/// The collocation polynomial errs inside a step by its own order, far more than at the end. The
/// derivatives at both ends show most of that: with them it is a polynomial of two degrees more,
/// at whose values the derivatives are evaluated once again, at eight new nodes. Together with the
/// ends and the increment of the step, which stands for the value in the middle, these give the
/// polynomial of degree 10 of h u̇.
#[derive(Clone, Debug)]
pub(super) struct Dense {
    rule: Rule,
    step: f64,
    /// Variables at the start of the step.
    state: Vec<f64>,
    /// Legendre coefficients of h u̇.
    spectra: Vec<Spectrum>,
}

/// A step that has been taken.
#[derive(Clone, Copy)]
pub(super) struct Taken<'a> {
    pub time: f64,
    pub step: f64,
    pub state: &'a [f64],
    /// K of the stages.
    pub known: &'a [Eight],
    /// f at the start and at the end.
    pub ends: [&'a [f64]; 2],
    /// Gauss's weights.
    pub weights: &'a Eight,
}

impl Taken<'_> {
    #[inline(always)]
    fn of(&self, i: usize) -> [f64; KNOWN] {
        let mut known = [0.0; KNOWN];
        known[..STAGES].copy_from_slice(&self.known[i].0);
        for (known, slope) in known[STAGES..].iter_mut().zip(self.ends) {
            *known = self.step * slope[i];
        }
        known
    }
}

impl Dense {
    pub fn new(collocation: &Collocation) -> Self {
        Self { rule: Rule::new(collocation), step: 0.0, state: Vec::new(), spectra: Vec::new() }
    }

    pub fn start(&mut self, state: &[f64]) {
        self.step = 0.0;
        self.state.clear();
        self.state.extend_from_slice(state);
        self.spectra.clear();
        self.spectra.resize(state.len(), [0.0; NODES]);
    }

    /// Finds the polynomials of a step.
    pub fn prepare(&mut self, system: &mut dyn System, stages: &mut Stages, taken: Taken<'_>) {
        let Self { rule, step, state, spectra } = self;
        *step = taken.step;
        state.copy_from_slice(taken.state);
        let times = Eight(rule.nodes.0.map(|x| taken.time + x * taken.step));
        let (variables, values) = (&stages.variables, &mut stages.states.values[..]);
        in_registers(Place { rule, taken, variables, values });
        stages.states.evaluate(system, &times, STAGES);
        let (variables, derivatives) = (&stages.variables, &stages.states.derivatives[..]);
        vectorised(Fit { rule, taken, variables, derivatives, spectra });
    }

    /// Length of the step it was prepared for; zero where that is not the last one.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Another step was taken.
    pub fn forget(&mut self) {
        self.step = 0.0;
    }

    pub fn interpolate(&self, variables: &Variables, x: f64, out: &mut [f64]) {
        let (first, second): (Spectrum, Spectrum) = (integrals(x), second_integrals(x));
        for &i in &variables.evaluated {
            out[i] = self.state[i] + dot(&self.spectra[i], &first);
        }
        for &(i, of) in &variables.integrals {
            let inner = dot(&self.spectra[of], &second);
            out[i] = self.state[i] + self.step * (x * self.state[of] + inner);
        }
    }

    pub fn polynomial(&self, variables: &Variables, i: usize) -> Bernstein {
        let integral = variables.integrals.iter().find(|&&(angle, _)| angle == i);
        let of = integral.map_or(i, |&(_, rate)| rate);
        let mut found = [0.0; NODES + 2];
        for (row, c) in self.rule.bernstein.iter().zip(&self.spectra[of]) {
            for (sum, weight) in found.iter_mut().zip(row) {
                *sum += c * weight;
            }
        }
        integrate(&mut found[..=NODES], self.state[of], 1.0);
        if integral.is_some() {
            integrate(&mut found, self.state[i], self.step);
        }
        Bernstein::new(&found[..NODES + 1 + usize::from(integral.is_some())])
    }
}

/// Replaces Bernstein coefficients, all but the last, by those of start + scale · ∫ of the polynomial.
fn integrate(coefficients: &mut [f64], start: f64, scale: f64) {
    let share = scale / (coefficients.len() - 1) as f64;
    let mut sum = start;
    for c in coefficients {
        let slope = std::mem::replace(c, sum);
        sum += share * slope;
    }
}

/// Writes the variables at the nodes, as far as they are known before the evaluation there.
struct Place<'a> {
    rule: &'a Rule,
    taken: Taken<'a>,
    variables: &'a Variables,
    values: &'a mut [Eight],
}

impl WorkOnEight for Place<'_> {
    type Output = ();

    #[inline(always)]
    fn carry_out<R: EightNumbers>(self) {
        let Self { rule, taken, variables, values } = self;
        let matrix = load::<R, KNOWN>(&rule.once);
        for &i in &variables.evaluated {
            let increment = product(&matrix, &taken.of(i));
            (R::constant(taken.state[i]) + increment).store(&mut values[i]);
        }
        let (matrix, nodes) = (load::<R, KNOWN>(&rule.twice), R::load(&rule.nodes));
        for &(i, rate) in &variables.integrals {
            let inner = product(&matrix, &taken.of(rate));
            let mean_rate = nodes.mul_add(R::constant(taken.state[rate]), inner);
            let value = mean_rate.mul_add(R::constant(taken.step), R::constant(taken.state[i]));
            value.store(&mut values[i]);
        }
    }
}

/// Finds the polynomials from the derivatives at the nodes.
struct Fit<'a> {
    rule: &'a Rule,
    taken: Taken<'a>,
    variables: &'a Variables,
    derivatives: &'a [Eight],
    spectra: &'a mut [Spectrum],
}

impl Work for Fit<'_> {
    #[inline(always)]
    fn carry_out(self) {
        let Self { rule, taken, variables, derivatives, spectra } = self;
        for &i in &variables.evaluated {
            let mut values = [0.0; NODES];
            let [start, end] = taken.ends;
            (values[0], values[NODES - 1]) = (taken.step * start[i], taken.step * end[i]);
            for (lane, derivative) in derivatives[i].0.into_iter().enumerate() {
                values[node(lane)] = taken.step * derivative;
            }
            let increment = taken.weights.dot(&taken.known[i]);
            values[MIDDLE] = (increment - dot(&rule.weights, &values)) / rule.weights[MIDDLE];
            let mut spectrum = [0.0; NODES];
            for (column, value) in rule.spectrum.iter().zip(values) {
                for k in 0..NODES {
                    spectrum[k] += column[k] * value;
                }
            }
            spectra[i] = spectrum;
        }
    }
}
