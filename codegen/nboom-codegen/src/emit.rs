//! Rust from traced equations.

mod blocks;
mod comment;
mod driver;
mod expression;
mod file;
mod fusion;
mod hinges;
mod inputs;
mod item;
mod module;
mod order;
mod places;
mod rolled;
mod routine;
mod stage;
mod statements;
mod stores;
mod straight;
mod sweeps;
mod text;

pub use file::Standing;
pub use module::Module;
pub use routine::{Generated, generate, source};
