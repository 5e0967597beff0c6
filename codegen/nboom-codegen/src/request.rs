//! What is asked of the generator, and what of a scene its code assumes.

mod assumptions;
mod error;
mod links;
mod names;
mod output;
mod right_sides;
mod routine;
mod scene;
mod stresses;

pub use error::CodegenError;
pub use links::links;
pub(crate) use names::{Names, identifier};
pub use output::Output;
pub use routine::{HINGE_LIMIT, Level, Request, STRAIGHT_HINGE_LIMIT};
pub use scene::{Numbers, held_at};
pub use stresses::StressRequest;
