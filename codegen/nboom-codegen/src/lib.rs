//! Turns a topology and a formulation into specialised Rust.
//!
//! The formulation is run on recording scalars; what it did becomes code. A small satellite
//! becomes one straight line; beyond [`STRAIGHT_LIMIT`] operations the sweeps over links become
//! loops, and equal appendages go through them side by side. Constants that depend on
//! parameters alone are computed once. The same request gives the same bytes.
//!
//! `request` says what is asked and what of a scene is assumed, `trace` runs the equations and
//! keeps graphs, `emit` writes them down; each uses those before it and none after it.
//!
//! ```
//! use nboom_codegen::{Level, Request, source};
//! use nboom_model::{Shape, Topology};
//!
//! let topology = Topology::new([Shape::Chain(2), Shape::Paddle]);
//! let code = source(&Request::new("S2P", topology, Level::Exact))?;
//! assert!(code.contains("impl Routine for S2P"));
//! # Ok::<(), nboom_codegen::CodegenError>(())
//! ```

mod emit;
mod hash;
mod request;
mod trace;

pub use emit::{Generated, Module, Standing, generate, source};
pub use hash::hash;
pub use request::{
    CodegenError, HINGE_LIMIT, Level, Numbers, Output, Request, STRAIGHT_HINGE_LIMIT,
    StressRequest, held_at, links,
};
pub use trace::{OPERATION_LIMIT, STRAIGHT_LIMIT, trace};
