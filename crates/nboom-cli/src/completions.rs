use clap::{Args, CommandFactory};
use clap_complete::{Shell, generate};

use crate::Cli;

/// Options of `nboom completions`.
#[derive(Args, Debug)]
pub struct CompletionsArgs {
    /// The shell.
    #[arg(value_name = "SHELL", value_enum)]
    pub shell: Shell,
}

/// What makes a shell complete the command line, for standard output.
pub(crate) fn completions(args: &CompletionsArgs) -> String {
    let mut command = Cli::command();
    let name = command.get_name().to_owned();
    let mut text = Vec::new();
    generate(args.shell, &mut command, name, &mut text);
    String::from_utf8(text).expect("the help is text")
}
