//! Power series in time of the solution of a differential equation, from the graph of its right
//! side.
//!
//! Each node's coefficients follow from those of its operands by the classical recurrences (Hairer,
//! Nørsett, Wanner, Section I.8): sums term by term, products by Cauchy, quotients, roots, sines
//! and cosines by comparing coefficients in the equations that define them. Order p costs about
//! p²/2 multiplications for each product, and p for a linear operation.
//!
//! This crate knows no bodies.

mod compiler;
mod histories;
mod program;
mod schedule;

use nboom_expr::Graph;
use nboom_scalar::Real;

use crate::program::Program;

/// The power series in time of the solution of ẏ = f(y, t), where a graph computes f.
///
/// ```
/// use nboom_expr::Graph;
/// use nboom_series::Series;
/// // ẏ = y t, whose solution from 1 at t = 0 is exp(t²/2).
/// let graph = Graph::trace(2, |inputs| vec![inputs[0] * inputs[1]]);
/// let mut coefficients = [0.0; 5];
/// Series::new(&graph, &[], 4).write(0.0, &[1.0], &mut coefficients);
/// assert_eq!(coefficients, [1.0, 0.0, 0.5, 0.0, 0.125]);
/// ```
#[derive(Clone, Debug)]
pub struct Series<R> {
    order: usize,
    program: Program<R>,
}

impl<R: Real> Series<R> {
    /// The series up to the power `order`. The graph's inputs are y, then t, then the numbers in
    /// `fixed`, which do not change; its outputs are ẏ.
    ///
    /// # Panics
    /// When the graph has another number of inputs.
    pub fn new(graph: &Graph, fixed: &[R], order: usize) -> Self {
        let expected = graph.outputs().len() + 1 + fixed.len();
        assert_eq!(graph.inputs(), expected, "y, t and what is fixed in, the rates of y out");
        Self { order, program: Program::new(graph, fixed, order) }
    }

    /// The highest power.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Writes the coefficients of the solution through `y` at `t` to `out`: those of power 0 for
    /// all variables, then those of power 1, and so on, (order + 1) times the number of variables
    /// in all. Allocates nothing.
    ///
    /// # Panics
    /// When `out` is shorter than that.
    pub fn write(&mut self, t: R, y: &[R], out: &mut [R]) {
        let (size, program) = (y.len(), &mut self.program);
        out[..size].copy_from_slice(y);
        let time = [t, R::one()];
        for power in 0..self.order {
            let (known, next) = out.split_at_mut((power + 1) * size);
            let of_time = time.get(power).copied().unwrap_or(R::zero());
            program.run(power, &known[power * size..], of_time);
            let by = R::one() / R::constant((power + 1) as f64);
            for (next, rate) in next[..size].iter_mut().zip(program.outputs()) {
                *next = rate * by;
            }
        }
    }
}
