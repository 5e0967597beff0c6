use std::path::PathBuf;

use clap::{Args, Command, CommandFactory};
use clap_mangen::Man;
use nboom_results::write_file;

use crate::{Cli, CliError};

/// Options of `nboom man`.
#[derive(Args, Debug)]
pub struct ManArgs {
    /// Directory for the pages, created if needed.
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
}

/// Writes the manual pages, and returns the text for standard output.
pub(crate) fn man(args: &ManArgs) -> Result<String, CliError> {
    let mut command = Cli::command().disable_help_subcommand(true);
    command.build();
    let commands: Vec<Command> = command.get_subcommands().cloned().collect();
    let pages = [command].into_iter().chain(commands);
    let written: Result<Vec<String>, CliError> =
        pages.map(|command| write(args, command)).collect();
    Ok(written?.concat())
}

fn write(args: &ManArgs, command: Command) -> Result<String, CliError> {
    let page = Man::new(command);
    let path = args.output.join(page.get_filename());
    let mut text = Vec::new();
    page.render(&mut text).expect("memory can be written");
    write_file(&path, &String::from_utf8_lossy(&text))?;
    Ok(format!("{}\n", path.display()))
}
