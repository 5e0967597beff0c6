use nboom_expr::Graph;
use nboom_scalar::{Real, Work, vectorised};

use crate::compiler::{Compiler, Instruction, Kind};
use crate::histories::{ANY, Histories, LANES};
use crate::schedule::{Run, schedule};

/// A graph as a list of instructions that runs once for each power of time.
///
/// A value is a node's coefficient of the current power. Only operands of products, quotients,
/// roots and sines have a history, all coefficients so far in ascending and in descending order.
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
    pub fn new(graph: &Graph, fixed: &[R], order: usize) -> Self {
        let stride = (order + LANES).next_multiple_of(LANES);
        let mut compiler = Compiler::new(graph, fixed, stride);
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
        vectorised(Pass { program: self, power });
    }

    /// The coefficients of the outputs for the power last computed.
    pub fn outputs(&self) -> impl Iterator<Item = R> {
        self.outputs.iter().map(|&i| self.values[i])
    }

    #[inline(always)]
    fn go_through<const CHUNKS: usize>(&mut self, power: usize) {
        let Self { order, runs, values: x, factors, ascending, descending, .. } = self;
        let mut histories = Histories { power, order: *order, ascending, descending };
        for Run { kind, places } in runs.iter() {
            // A loop for each kind, and no closures: only inlined code gets the processor's vector
            // instructions.
            macro_rules! each {
                ($to:ident, $a:ident, $b:ident, $history:ident => $act:expr) => {
                    for at in &self.instructions[places.clone()] {
                        let [$to, $a, $b, $history] =
                            [at.to, at.a, at.b, at.history].map(|i| i as usize);
                        $act
                    }
                };
            }
            match kind {
                Kind::Add => each!(to, a, b, _h => x[to] = x[a] + x[b]),
                Kind::Sub => each!(to, a, b, _h => x[to] = x[a] - x[b]),
                Kind::Neg => each!(to, a, _b, _h => x[to] = -x[a]),
                Kind::Scale => each!(to, a, b, _h => x[to] = x[a] * factors[b]),
                Kind::Keep => each!(_to, a, _b, h => histories.keep(h, x[a])),
                Kind::Mul => {
                    each!(to, a, b, _h => x[to] = histories.product::<CHUNKS>(a, b, power))
                }
                Kind::Div => {
                    each!(to, a, b, h => x[to] = histories.quotient::<CHUNKS>(x[a], b, h))
                }
                Kind::Sqrt => each!(to, a, _b, h => x[to] = histories.root::<CHUNKS>(x[a], h)),
                Kind::SinCos => each!(to, a, b, h => {
                    (x[to], x[b]) = histories.sine_and_cosine(x[a], h, self.stride);
                }),
            }
        }
    }
}

/// Runs a program for one power.
struct Pass<'a, R> {
    program: &'a mut Program<R>,
    power: usize,
}

impl<R: Real> Work for Pass<'_, R> {
    /// Most sums are short, so it pays that the compiler knows how short.
    #[inline(always)]
    fn carry_out(self) {
        let Self { program, power } = self;
        match (power + 1).div_ceil(LANES) {
            1 => program.go_through::<1>(power),
            2 => program.go_through::<2>(power),
            3 => program.go_through::<3>(power),
            4 => program.go_through::<4>(power),
            5 => program.go_through::<5>(power),
            6 => program.go_through::<6>(power),
            _ => program.go_through::<ANY>(power),
        }
    }
}
