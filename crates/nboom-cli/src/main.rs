//! The command `nboom`.

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    nboom_cli::execute(&nboom_cli::Cli::parse())
}
