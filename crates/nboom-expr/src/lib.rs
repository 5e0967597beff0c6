//! A scalar that records: running a formulation on [`Expr`] leaves behind the graph of what it
//! computes.
//!
//! Equal nodes are stored once. Folding changes no value but at most the sign of a zero, given
//! that inputs are finite: operands commute, x + 0 and x · 1 are x, x · 0 is 0, signs move
//! outward. The [`Graph`] can be interpreted, counted, and split into what depends on
//! parameters alone and what depends on the state.
//!
//! ```
//! use nboom_expr::{Expr, Graph};
//! use nboom_scalar::Real;
//!
//! let graph = Graph::trace(2, |inputs| {
//!     let (s, c) = inputs[0].sin_cos();
//!     vec![s * s + c * c * Expr::one(), inputs[1] * Expr::zero()]
//! });
//! assert_eq!(graph.evaluate(&[0.3, 7.0]), [0.3_f64.sin().powi(2) + 0.3_f64.cos().powi(2), 0.0]);
//! assert_eq!(graph.operations().multiplications, 2);
//! ```

mod count;
mod expr;
mod fold;
mod graph;
mod interpret;
mod regroup;

pub use count::Operations;
pub use expr::Expr;
pub use graph::{Graph, Id, Node};
