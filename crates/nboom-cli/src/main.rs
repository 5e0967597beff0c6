//! The command `nboom`.

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match nboom_cli::Cli::try_parse() {
        Ok(cli) => nboom_cli::execute(&cli),
        Err(error) => nboom_cli::refuse(&error),
    }
}
