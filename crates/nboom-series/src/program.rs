use std::ops::Range;

use nboom_expr::Graph;
use nboom_scalar::Real;

use crate::compiler::{Compiler, Instruction, Kind};
use crate::schedule::{Run, schedule};

/// Products that are summed side by side, so that the compiler makes vector code of them.
const LANES: usize = 4;

/// A graph as a list of instructions that is gone through once for each power of time.
///
/// A value is a node's coefficient of the present power. Only what products, quotients, roots
/// and sines go back to has a history: all coefficients so far in ascending order, and the same
/// in descending order, so that a Cauchy product runs forward through both.
#[derive(Clone, Debug)]
pub(crate) struct Program<R> {
    order: usize,
    instructions: Vec<Instruction>,
    runs: Vec<Run<Kind>>,
    values: Vec<R>,
    /// Value of each constant that is part of a sum or the numerator of a quotient.
    constants: Vec<(usize, R)>,
    /// Factors of [`Kind::Scale`].
    factors: Vec<R>,
    /// Values that are inputs, and which.
    inputs: Vec<(usize, usize)>,
    outputs: Vec<usize>,
    ascending: Vec<R>,
    descending: Vec<R>,
    stride: usize,
}

impl<R: Real> Program<R> {
    pub fn new(graph: &Graph, order: usize) -> Self {
        let stride = (order + LANES).next_multiple_of(LANES);
        let mut compiler = Compiler::new(graph, stride);
        graph.nodes().for_each(|(id, node)| compiler.compile(id, node));
        let Compiler { tasks, values, constants, factors, inputs, histories, .. } = compiler;
        let (instructions, runs) = schedule(&tasks);
        Self {
            order,
            instructions,
            runs,
            values: vec![R::zero(); values],
            constants,
            factors,
            inputs,
            outputs: graph.outputs().iter().map(|id| id.index()).collect(),
            ascending: vec![R::zero(); histories * stride],
            descending: vec![R::zero(); histories * stride],
            stride,
        }
    }

    /// Computes all coefficients of `power` from those of y and t; those of lower powers must
    /// have been computed just before.
    pub fn run(&mut self, power: usize, y: &[R], t: R) {
        for &(to, input) in &self.inputs {
            self.values[to] = y.get(input).copied().unwrap_or(t);
        }
        for &(to, value) in &self.constants {
            self.values[to] = if power == 0 { value } else { R::zero() };
        }
        for run in 0..self.runs.len() {
            let Run { kind, places } = self.runs[run].clone();
            match kind {
                Kind::Add => self.each(places, |values, _, at| values[at.a] + values[at.b]),
                Kind::Sub => self.each(places, |values, _, at| values[at.a] - values[at.b]),
                Kind::Neg => self.each(places, |values, _, at| -values[at.a]),
                Kind::Scale => {
                    self.each(places, |values, factors, at| values[at.a] * factors[at.b]);
                }
                _ => places.for_each(|i| self.carry_out(kind, self.instructions[i], power)),
            }
        }
    }

    /// The coefficients of the outputs for the power last computed.
    pub fn outputs(&self) -> impl Iterator<Item = R> {
        self.outputs.iter().map(|&i| self.values[i])
    }

    #[inline(always)]
    fn each(
        &mut self,
        places: Range<usize>,
        value: impl Fn(&[R], &[R], &Instruction) -> R,
    ) {
        for at in &self.instructions[places] {
            self.values[at.to] = value(&self.values, &self.factors, at);
        }
    }

    #[inline(always)]
    fn carry_out(&mut self, kind: Kind, at: Instruction, power: usize) {
        match kind {
            Kind::Keep => self.keep(at.history, power, self.values[at.a]),
            Kind::Mul => self.values[at.to] = self.product(at.a, at.b, power),
            Kind::Div => self.divide(at, power),
            Kind::Sqrt => self.root(at, power),
            _ => self.sine_and_cosine(at, power),
        }
    }

    /// The value `a` by the history `b`; the quotient q, q b = a, has a history.
    fn divide(&mut self, at: Instruction, power: usize) {
        let (a, first) = (self.values[at.a], self.ascending[at.b]);
        self.keep(at.history, power, R::zero());
        let quotient = (a - self.product(at.history, at.b, power)) / first;
        self.keep(at.history, power, quotient);
        self.values[at.to] = quotient;
    }

    /// Of the value `a`; the root r, r r = a, has a history.
    fn root(&mut self, at: Instruction, power: usize) {
        let a = self.values[at.a];
        let root = if power == 0 {
            a.sqrt()
        } else {
            let first = self.ascending[at.history];
            self.keep(at.history, power, R::zero());
            (a - self.product(at.history, at.history, power)) / (first + first)
        };
        self.keep(at.history, power, root);
        self.values[at.to] = root;
    }

    /// Of the value `a`: ṡ = ȧ c and ċ = −ȧ s. The history's neighbours after it are those of s
    /// and c; it is that of ȧ itself. Values `to` and `b` are s and c.
    fn sine_and_cosine(&mut self, at: Instruction, power: usize) {
        let (rate, sine, cosine) =
            (at.history, at.history + self.stride, at.history + 2 * self.stride);
        let a = self.values[at.a];
        let (s, c) = match power.checked_sub(1) {
            None => a.sin_cos(),
            Some(before) => {
                let power = R::constant(power as f64);
                self.keep(rate, before, a * power);
                let by = R::one() / power;
                let (s, c) =
                    (self.product(rate, cosine, before), self.product(rate, sine, before));
                (s * by, -(c * by))
            }
        };
        self.keep(sine, power, s);
        self.keep(cosine, power, c);
        (self.values[at.to], self.values[at.b]) = (s, c);
    }

    #[inline(always)]
    fn keep(&mut self, history: usize, power: usize, value: R) {
        if power.is_multiple_of(LANES) {
            // Sums of whole lanes look ahead.
            self.ascending[history + power..][..LANES].fill(R::zero());
        }
        self.ascending[history + power] = value;
        self.descending[history + self.order - power] = value;
    }

    /// Σ a_j b_(power − j). Behind the end of a descending history there are zeros, so that sums
    /// may be a whole number of lanes long.
    #[inline(always)]
    fn product(&self, a: usize, b: usize, power: usize) -> R {
        let length = (power + 1).next_multiple_of(LANES);
        let a = &self.ascending[a..][..length];
        let b = &self.descending[b + self.order - power..][..length];
        let mut sums = [R::zero(); LANES];
        for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
            for lane in 0..LANES {
                sums[lane] += a[lane] * b[lane];
            }
        }
        (sums[0] + sums[1]) + (sums[2] + sums[3])
    }
}
