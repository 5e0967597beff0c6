//! Writes crates of generated code, and builds simulators around it.
//!
//! [`generate`] writes a crate with the routines of one scene. It needs nothing but Rust: the
//! crate `nboom-scalar` goes with it, and so does a certificate, with tests that hold the compiled
//! code to it. [`is_current`] compares such a crate with what would be written now. [`compile`]
//! builds the command `nboom`, without its generator, around the routines of a scene.
//!
//! The same scene and the same choices give the same bytes. What somebody else has written or
//! changed is not overwritten.

mod certificate;
mod checks;
mod choices;
mod compile;
mod error;
mod generate;
mod library;
mod listing;
mod manifest;
mod sources;

pub use certificate::TOLERANCE;
pub use choices::Choices;
pub use compile::{Build, Built, compile};
pub use error::PackageError;
pub use generate::{Written, generate, is_current};
pub use nboom_codegen::{Level, Numbers, Standing};
