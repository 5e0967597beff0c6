//! The command line of nboom: reads arguments, runs the command and prints the outcome.
//!
//! Other programs may use its parts: [`RunArgs::prepare`] makes a run of options and a scene, [`finish_sweep`] the
//! pages of a sweep. Whoever calls them says by an [`Interrupt`] when they shall stop, and [hears](hear()) what they
//! warn of.
//!
//! Results go to standard output, everything else to standard error. Options are defined once, in
//! [`Cli`]; the help texts and `docs/cli.md` are made from them. The crates below read, simulate
//! and write files.
//!
//! ```
//! use clap::Parser;
//! use nboom_cli::{Cli, Command};
//!
//! let cli = Cli::try_parse_from(["nboom", "run", "boom.nml", "--samples", "10"])?;
//! let Command::Run(args) = cli.command else { panic!("run was asked for") };
//! assert_eq!(args.samples, Some(10));
//! # Ok::<(), clap::Error>(())
//! ```

mod args;
mod bench;
mod case;
mod certify;
mod check;
mod choice;
#[cfg(feature = "generator")]
mod compile;
#[cfg(feature = "generator")]
mod completions;
mod convert;
mod error;
mod examples;
mod format;
#[cfg(feature = "generator")]
mod generate;
mod given;
mod ignored;
mod interrupt;
mod list;
#[cfg(feature = "generator")]
mod man;
mod merge;
#[cfg(feature = "generator")]
mod new;
mod output;
mod picture;
mod plots;
mod print_run;
mod print_scene;
mod print_structure;
mod progress;
mod record;
mod reference;
mod repeat;
mod report;
mod run;
mod scene_args;
mod schema;
mod section;
mod section_answer;
mod section_file;
mod simulator;
mod slips;
mod stresses;
mod sweep;
mod sweep_account;
mod table_args;
mod tables;
mod terminal;
mod unique_keys;
mod verdict;
mod verify;
mod watch;
mod work_precision;
mod worst_cases;

use std::process::ExitCode;

use nboom_scalar::{Batch, InstructionSet, Kernel};

pub use args::{Cli, Command, RunArgs, VerifyArgs};
pub use bench::BenchArgs;
pub use case::{CaseError, words_of_settings};
pub use check::{CheckArgs, warnings};
pub use choice::ChoiceError;
#[cfg(feature = "generator")]
pub use compile::CompileArgs;
#[cfg(feature = "generator")]
pub use completions::CompletionsArgs;
pub use convert::ConvertArgs;
pub use error::CliError;
#[cfg(feature = "generator")]
pub use generate::GenerateArgs;
pub use given::Given;
pub use ignored::{idle_formulation, idle_formulation_of};
pub use interrupt::{Interrupt, Interrupts, Left};
#[cfg(feature = "generator")]
pub use man::ManArgs;
pub use merge::MergeArgs;
#[cfg(feature = "generator")]
pub use new::{Kind, NewArgs};
pub use picture::svg;
pub use plots::PlotArgs;
pub use record::RecordError;
pub use reference::reference;
pub use report::ReportArgs;
pub use run::PreparedRun;
pub use scene_args::SceneArgs;
pub use schema::{SchemaArgs, SchemaKind};
pub use section::SectionArgs;
pub use section_file::{Defect, SectionDefect, SectionFileError};
pub use simulator::simulator;
pub use slips::SlipArgs;
pub use stresses::StressArgs;
pub use sweep::{Asked, SweepArgs, SweepError, SweepOutputs, finish_sweep, warn_of_the_scene};
pub use table_args::{TableArgs, Times};
pub use tables::TablesArgs;
pub use terminal::{hear, refuse};
pub use verdict::troubles;

use terminal::{print, say};

/// Generated routines that commands choose from.
#[derive(Clone, Copy, Debug)]
pub struct Routines {
    /// Those that runs take, for accelerations and right sides, and for stresses.
    pub for_runs: &'static [Kernel],
    /// Those for the matrix and the right side of a formulation.
    pub equations: &'static [Kernel],
    /// Those for accelerations of eight states at once.
    pub batches: &'static [Batch],
    /// Right sides of eight states at once.
    pub right_sides_of_eight: &'static [Batch],
}

/// Runs the command and returns its exit code: 0 done, 1 a comparison failed, 2 the input is wrong,
/// 3 the computation or the writing failed or was interrupted.
#[cfg(feature = "generator")]
pub fn execute(cli: &Cli) -> ExitCode {
    let routines = Routines {
        for_runs: nboom_routines::for_runs(),
        equations: nboom_routines::equations(),
        batches: nboom_routines::batches(),
        right_sides_of_eight: nboom_routines::right_sides_of_eight(),
    };
    execute_with(cli, &routines)
}

/// Runs the command like `execute`, with other routines than the stock ones.
pub fn execute_with(cli: &Cli, routines: &Routines) -> ExitCode {
    let of_command = || match &cli.command {
        Command::Run(args) => run::run(args, routines, &Interrupt::watch),
        Command::Report(args) => report::report(args),
        Command::Tables(args) => tables::tables(args),
        Command::Check(args) => check::check(args, routines),
        Command::Verify(args) => verify::verify(args, routines),
        Command::Bench(args) => bench::bench(args, routines),
        #[cfg(feature = "generator")]
        Command::New(args) => new::new(args),
        Command::Convert(args) => convert::convert(args),
        Command::Sweep(args) => sweep::sweep(args, routines),
        Command::Merge(args) => merge::merge(args, routines),
        Command::Schema(args) => Ok(schema::schema(args)),
        Command::List => Ok(list::text(routines)),
        Command::Section(args) => section::section(args),
        #[cfg(feature = "generator")]
        Command::Generate(args) => generate::generate(args),
        #[cfg(feature = "generator")]
        Command::Compile(args) => compile::compile(args),
        #[cfg(feature = "generator")]
        Command::Completions(args) => Ok(completions::completions(args)),
        #[cfg(feature = "generator")]
        Command::Man(args) => man::man(args),
    };
    match check_instructions().and_then(|()| of_command()).and_then(|text| print(&text)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            error.lines().iter().for_each(|line| say("error", line));
            ExitCode::from(error.exit_code())
        }
    }
}

/// # Errors
/// When the environment names an instruction set that there is not.
fn check_instructions() -> Result<(), CliError> {
    match std::env::var(InstructionSet::VARIABLE) {
        Ok(found) if InstructionSet::named(&found).is_none() => {
            Err(CliError::Instructions { found })
        }
        _ => Ok(()),
    }
}
