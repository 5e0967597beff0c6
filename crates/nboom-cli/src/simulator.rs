use std::ffi::OsString;
use std::path::Path;
use std::process::ExitCode;

use clap::{Command, CommandFactory, FromArgMatches};
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
    let command = program(&name.unwrap_or_default().to_string_lossy(), about);
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

/// The command line of a program of this name, by which its help and examples call it.
fn program(name: &str, about: &'static str) -> Command {
    let renamed = |command: Command| {
        let Some(help) = command.get_after_help().map(ToString::to_string) else { return command };
        command.after_help(help.replace("nboom ", &format!("{name} ")))
    };
    let mut command = renamed(Cli::command()).mut_subcommands(renamed);
    command = command.bin_name(name.to_owned()).about(about);
    command.build();
    command
}

/// Whether a first word is the name of a command or an option of the program itself.
fn is_known(command: &Command, word: &OsString) -> bool {
    let is_option = |word: &str| ["-h", "--help", "-V", "--version"].contains(&word);
    word.to_str().is_some_and(|word| is_option(word) || command.find_subcommand(word).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::examples;

    /// Without the feature `generator`, as in such programs, examples have no commands of the generator.
    #[test]
    fn examples_are_commands_of_the_program() {
        let command = program("simulate", "Ours.");
        let helps = command.get_subcommands().chain([&command]).filter_map(Command::get_after_help);
        let helps: String = helps.map(|help| examples::commands(&help.to_string())).collect();
        let commands = helps.split(['\n', '|', '&', ';']).map(str::trim);
        let called = commands.filter_map(|line| line.strip_prefix("simulate "));
        let called: Vec<&str> = called.filter_map(|line| line.split(' ').next()).collect();
        assert!(called.len() > 10 && !helps.contains("nboom "), "{helps}");
        for word in called {
            assert!(is_known(&command, &word.into()), "{word} of {helps}");
        }
    }

    #[test]
    fn a_scene_is_told_from_a_command() {
        let command = program("simulate", "Ours.");
        for word in ["run", "check", "verify", "bench", "help", "--help", "-V"] {
            assert!(is_known(&command, &word.into()), "{word}");
        }
        for word in ["scene.nml", "./run", "--quiet", ""] {
            assert!(!is_known(&command, &word.into()), "{word}");
        }
    }
}
