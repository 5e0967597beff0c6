use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

use clap::{CommandFactory, FromArgMatches};
use nboom_scalar::{Batch, Kernel};

use crate::{Cli, Routines, execute_with, refuse};

/// The command line of a stand-alone simulator with routines of its own: `run` may be left out.
/// `about` begins its help.
pub fn simulator(
    words: impl IntoIterator<Item = OsString>,
    about: &'static str,
    for_runs: &'static [Kernel],
    right_sides_of_eight: &'static [Batch],
) -> ExitCode {
    let mut words: Vec<OsString> = words.into_iter().collect();
    let name = words.first().map(|path| Path::new(path).file_name().unwrap_or(path));
    let name = name.unwrap_or_default().to_string_lossy().into_owned();
    let mut command = Cli::command().bin_name(name).about(about);
    command.build();
    if words.get(1).is_some_and(|word| !is_known(&command, word)) {
        words.insert(1, "run".into());
    }
    match command.try_get_matches_from(words).and_then(|found| Cli::from_arg_matches(&found)) {
        Ok(cli) => {
            let routines =
                Routines { for_runs, equations: &[], batches: &[], right_sides_of_eight };
            execute_with(&cli, &routines)
        }
        Err(error) => refuse(&error),
    }
}

/// Whether a first word is the name of a command or an option of the program itself.
fn is_known(command: &clap::Command, word: &OsString) -> bool {
    let is_option = |word: &str| ["-h", "--help", "-V", "--version"].contains(&word);
    word.to_str().is_some_and(|word| is_option(word) || command.find_subcommand(word).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_is_told_from_a_command() {
        let mut command = Cli::command();
        command.build();
        for word in ["run", "check", "verify", "bench", "help", "--help", "-V"] {
            assert!(is_known(&command, &word.into()), "{word}");
        }
        for word in ["scene.nml", "./run", "--quiet", ""] {
            assert!(!is_known(&command, &word.into()), "{word}");
        }
    }
}
