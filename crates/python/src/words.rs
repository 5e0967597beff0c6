//! Options of runs: keyword arguments in Python, words of the command here.

use std::error::Error;
use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue, ErrorKind};
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
        Err(error) => Err(wrong_input(told(&error))),
    }
}

/// What is wrong, in the words of the package.
fn told(error: &clap::Error) -> String {
    let context = |kind| error.get(kind).map(ContextValue::to_string).unwrap_or_default();
    // `--end-time <T>`
    let keyword = |kind| {
        let option = context(kind);
        let name = option.trim_start_matches('-').split([' ', '[']).next().unwrap_or_default();
        name.replace('-', "_")
    };
    let (name, value) = (keyword(ContextKind::InvalidArg), context(ContextKind::InvalidValue));
    match (error.kind(), error.source()) {
        (ErrorKind::ValueValidation, Some(source)) => {
            let expected = expected(&source.to_string(), &value);
            // Tolerances and steps say themselves what is found.
            if expected.contains(" found, ") {
                format!("{name}: {expected}")
            } else {
                format!("{name}: `{value}` found, {expected}")
            }
        }
        (ErrorKind::InvalidValue, _) => {
            let valid = context(ContextKind::ValidValue);
            format!("{name}: `{value}` found, one of {valid} expected")
        }
        (ErrorKind::ArgumentConflict, _) => {
            let prior = keyword(ContextKind::PriorArg);
            format!("{name}: found beside {prior}, one of them expected")
        }
        _ => {
            let text = error.render().to_string();
            let text = text.strip_prefix("error: ").unwrap_or(&text);
            text.split("\n\n").next().unwrap_or(text).trim().to_owned()
        }
    }
}

/// What the readers of options say, in words where the standard library and clap say it of numbers.
fn expected(said: &str, value: &str) -> String {
    let range = said.strip_prefix(value).and_then(|said| said.strip_prefix(" is not in "));
    if let Some((least, most)) = range.and_then(|range| range.split_once("..=")) {
        return format!("a number from {least} to {most} expected");
    }
    said.replace("unknown name,", "one of")
        .replace("invalid digit found in string", "a whole number expected")
        .replace("number too large to fit in target type", "a smaller number expected")
        .replace("number too small to fit in target type", "a larger number expected")
        .replace("invalid float literal", "a number expected")
}

/// The names of all options of a run; whether each is said by its name alone, and whether with a value.
#[pyfunction]
pub(crate) fn options() -> Vec<(String, bool, bool)> {
    let command = Cli::command();
    let run = command.find_subcommand("run").map(clap::Command::get_arguments);
    let option = |arg: &clap::Arg| {
        let takes_value = arg.get_action().takes_values();
        let needs_value = takes_value && arg.get_num_args().is_none_or(|n| n.min_values() > 0);
        Some((arg.get_long()?.replace('-', "_"), !needs_value, takes_value))
    };
    run.into_iter().flatten().filter_map(option).collect()
}
