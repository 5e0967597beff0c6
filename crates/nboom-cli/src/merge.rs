use std::path::PathBuf;

use clap::Args;

use crate::sweep::{Asked, SweepError, SweepOutputs, finish_sweep};
use crate::{CliError, Interrupt, Routines};

/// Options of `nboom merge`.
#[derive(Args, Debug)]
pub struct MergeArgs {
    /// Directories of all shards of a sweep, in any order.
    #[arg(value_name = "DIR", required = true)]
    pub directories: Vec<PathBuf>,

    /// Directory for the results, created if needed.
    #[arg(short, long, value_name = "DIR", required = true)]
    pub output: PathBuf,

    /// What is the same for a sweep and its parts put together.
    #[command(flatten)]
    pub outputs: SweepOutputs,
}

/// Puts shards together, and returns the text for standard output.
pub(crate) fn merge(args: &MergeArgs, routines: &Routines) -> Result<String, CliError> {
    let interrupt = Interrupt::patient()?;
    let SweepOutputs { csv, accept_difference, .. } = args.outputs;
    let merged = nboom_study::merge(&args.directories, &args.output, csv, accept_difference);
    let report = merged.map_err(SweepError::Study)?;
    let asked = Asked { of_all: &interrupt, of_a_run: &Interrupt::watch };
    finish_sweep(&args.output, &report, &args.outputs, routines, asked)
}
