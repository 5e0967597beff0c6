//! The command `nboom`, which comes with the package.

use clap::Parser;
use nboom_cli::{Cli, execute, refuse};
use pyo3::prelude::*;

/// Runs the command with these words, of which the first is its name; returns its exit code.
#[pyfunction]
pub(crate) fn main(py: Python<'_>, words: Vec<String>) -> u8 {
    py.detach(|| {
        let code = match Cli::try_parse_from(words) {
            Ok(cli) => execute(&cli),
            Err(error) => refuse(&error),
        };
        // `ExitCode` does not tell its number, but its two forms can be compared.
        (0..=u8::MAX).find(|number| code == std::process::ExitCode::from(*number)).unwrap_or(1)
    })
}
