//! The command line of nboom: reads arguments, runs what they ask for and prints the outcome.
//!
//! Results go to standard output, everything else to standard error. Options are defined once,
//! in [`Cli`]; the help texts and `docs/cli.md` are made from them. Nothing is read, simulated
//! or written to files here; the crates below do that.
//!
//! ```
//! use clap::Parser;
//! use nboom_cli::{Cli, Command};
//!
//! let cli = Cli::try_parse_from(["nboom", "run", "boom.nml", "--samples", "10"])?;
//! let Command::Run(args) = cli.command else { panic!("run was asked for") };
//! assert_eq!(args.samples, 10);
//! # Ok::<(), clap::Error>(())
//! ```

mod args;
mod bench;
mod check;
mod choice;
mod codes;
mod condition;
mod error;
mod format;
mod print_run;
mod print_scene;
mod progress;
mod random;
mod reference;
mod run;
mod verify;
mod watch;

use std::io::{self, Write};
use std::process::ExitCode;

pub use args::{BenchArgs, CheckArgs, Cli, Command, PathChoice, RunArgs, VerifyArgs};
pub use choice::ChoiceError;
pub use error::CliError;
pub use reference::reference;

/// Does what the command line asks for and tells how it went by the exit code: 0 done, 1 a
/// comparison failed, 2 the input is wrong, 3 the computation or the writing failed.
pub fn execute(cli: &Cli) -> ExitCode {
    let printed = match &cli.command {
        Command::Run(args) => run::run(args),
        Command::Check(args) => check::check(args),
        Command::Verify(args) => verify::verify(args),
        Command::Bench(args) => bench::bench(args),
    };
    match printed.and_then(|text| print(&text)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            error.lines().iter().for_each(|line| say("error", line));
            ExitCode::from(error.exit_code())
        }
    }
}

/// Writes to standard output; a reader who has left, as `head` does, has seen enough.
fn print(text: &str) -> Result<(), CliError> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(CliError::Stdout(error)),
        _ => Ok(()),
    }
}

/// Says something beside the results. When nobody can hear it there is nobody to tell.
fn say(kind: &str, line: &str) {
    let _ = writeln!(io::stderr(), "{kind}: {line}");
}
