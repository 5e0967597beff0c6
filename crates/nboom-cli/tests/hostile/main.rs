//! The whole program on bad input: the exit code, a message that a stranger understands, and
//! little time and memory, whatever the file holds; and what is left on disk when a
//! computation fails half way, is interrupted or killed.
#![cfg(unix)]

mod disk;
mod failures;
mod files;
mod interrupts;
mod kills;
mod place;
mod refusals;
mod sweeps;
mod terminal;
