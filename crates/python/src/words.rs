//! Options of runs: keyword arguments in Python, words of the command here.

use std::ffi::OsString;

use clap::{CommandFactory, Parser};
use nboom_cli::{Cli, Command, RunArgs};
use pyo3::prelude::*;

use crate::error::wrong_input;

/// The options of a run of the scene `name`, without messages on standard error.
///
/// # Errors
/// `InputError` of a wrong value.
pub(crate) fn run_args(name: &str, words: &[OsString]) -> PyResult<RunArgs> {
    let fixed = ["nboom", "run", "--quiet"].map(OsString::from).into_iter();
    let words = fixed.chain(words.iter().cloned()).chain(["--", name].map(OsString::from));
    match Cli::try_parse_from(words).map(|cli| cli.command) {
        Ok(Command::Run(args)) => Ok(*args),
        Ok(_) => Err(wrong_input("options of another command found".to_owned())),
        Err(error) => {
            let text = error.render().to_string();
            let text = text.strip_prefix("error: ").unwrap_or(&text);
            let reason = text.split("\n\nUsage").next().unwrap_or(text);
            let reason = reason.split("\n\nFor more").next().unwrap_or(reason);
            // Words of a command line have other ways out.
            let reason = reason.split("\n\n  tip: to pass").next().unwrap_or(reason).trim();
            // What the standard library says of numbers.
            let reason = reason
                .replace("invalid digit found in string", "a whole number expected")
                .replace("invalid float literal", "a number expected");
            Err(wrong_input(reason))
        }
    }
}

/// The names of all options of a run.
#[pyfunction]
pub(crate) fn options() -> Vec<String> {
    let command = Cli::command();
    let run = command.find_subcommand("run").map(clap::Command::get_arguments);
    let long = run.into_iter().flatten().filter_map(clap::Arg::get_long);
    long.map(|name| name.replace('-', "_")).collect()
}
