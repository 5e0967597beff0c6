//! A simulator, written by `nboom compile`.

use std::process::ExitCode;

mod routines;

/// What it says of itself; by it, `nboom compile` knows what it may replace.
const MADE: &str = "/*MADE*/";

fn main() -> ExitCode {
    nboom_cli::simulator(std::env::args_os(), MADE, routines::kernels(), routines::batches())
}
