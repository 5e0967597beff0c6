//! The whole program on bad input: the exit code, a message that a stranger understands, and
//! little time and memory, whatever the file holds; and what is left on disk when a
//! computation fails half way.
#![cfg(unix)]

mod failures;
mod place;
mod refusals;
