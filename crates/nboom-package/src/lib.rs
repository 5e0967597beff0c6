//! Writes crates of generated code, and builds simulators around it.
//!
//! [`generate`] writes a crate with the routines of one scene. It needs nothing but Rust: what its
//! code uses is a module of it. A certificate says how far its formulation is from the truth, and
//! its tests measure the compiled code. [`is_current`] compares such a crate with what would be written now. [`compile`]
//! builds the command `nboom`, without its generator, around the routines of a scene. [`library`](fn@library) builds
//! a library of them, which a running program can [`load`](fn@load).
//!
//! One scene and one set of choices always give the same bytes. What somebody else has written or
//! changed is not overwritten.

mod cargo;
mod certificate;
mod certified;
mod checks;
mod choices;
mod compile;
mod error;
mod files;
mod generate;
mod library;
mod listing;
mod load;
mod manifest;
mod package;
mod program;
mod right_side;
mod shared;
mod sources;
mod stresses;

pub use certified::TOLERANCE;
pub use choices::Choices;
pub use compile::{Build, Built, Progress, compile};
pub use error::PackageError;
pub use generate::{Written, generate, is_current};
pub use load::{Loaded, load};
pub use nboom_codegen::{Level, Numbers, Standing};
pub use shared::{Library, library};
