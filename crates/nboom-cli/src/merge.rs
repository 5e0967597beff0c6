use std::path::PathBuf;

use clap::Args;

use crate::sweep::{SweepError, SweepOutputs, finish_sweep};
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
    let SweepOutputs { csv, accept_difference, .. } = args.outputs;
    let merged = nboom_study::merge(&args.directories, &args.output, csv, accept_difference);
    let report = merged.map_err(SweepError::Study)?;
    finish_sweep(&args.output, &report, &args.outputs, routines, &Interrupt::watch)
}
