use std::path::PathBuf;

use clap::builder::TypedValueParser;
use clap::{Args, Parser, Subcommand, value_parser};
use nboom_io::MOST_SAMPLES;
use nboom_model::UnitSystem;
use nboom_sim::{Form, Method, Path, Reference};

use crate::{
    BenchArgs, CheckArgs, ConvertArgs, Given, MergeArgs, PlotArgs, ReportArgs, SceneArgs,
    SchemaArgs, SectionArgs, SlipArgs, StressArgs, SweepArgs, TableArgs, TablesArgs, choice,
    examples,
};
#[cfg(feature = "generator")]
use crate::{CompileArgs, CompletionsArgs, GenerateArgs, ManArgs, NewArgs};

/// Simulates spacecraft that unfold.
#[derive(Debug, Parser)]
#[command(name = "nboom", version, after_help = examples::nboom())]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Simulate a scene and write what happens.
    ///
    /// Writes states.csv, events.csv, summary.json and other tables, report.html that shows them in a
    /// browser, and prints a short summary. The files are written in DIR.partial and moved to DIR when the run is complete; docs/results.md says what
    /// happens to them otherwise. The first Ctrl-C or SIGTERM ends the run in order, the second at
    /// once. SCENE may be the run.json of a run: it is then repeated, with the options given now in place of its
    /// own, into -o or the directory's name with -repeated.
    #[command(after_help = examples::RUN)]
    Run(Box<RunArgs>),
    /// Run a scene many times with varied numbers.
    ///
    /// STUDY is a file that says which numbers of a scene vary and how, what may be broken, and what is wanted
    /// of each run; docs/studies.md says how. Writes cases.parquet, a row for each case, study.json,
    /// statistics.json, report.html with histograms, drivers and chances, and the runs of the worst cases.
    /// A case that cannot be run is a row with the reason. Each batch of finished cases is safe on the
    /// disk: a sweep that was killed goes on with --resume, and ends with the same table. Results depend neither on
    /// --jobs nor on --shard.
    #[command(after_help = examples::SWEEP)]
    Sweep(SweepArgs),
    /// Put the shards of a sweep together.
    ///
    /// DIR are the directories of all shards, each finished. The table is that of a sweep in one go.
    #[command(after_help = examples::MERGE)]
    Merge(MergeArgs),
    /// Make the page of a run from its files, or one page that compares several runs.
    ///
    /// The page of a run is report.html in its directory; it needs a browser and no network. Of a run that is
    /// not complete it has what is there, and names what is missing. Several runs share axes: designs,
    /// formulations, a run with --as-1970 beside one without.
    #[command(after_help = examples::REPORT)]
    Report(ReportArgs),
    /// Write the tables of a complete run for other programs.
    ///
    /// Parquet has a file for each table, with nulls where a field is empty; HDF5 is one file, run.h5, with a
    /// group for each table, a dataset for each column, and NaN there. Both have units and meanings of all
    /// columns, and the summary. Numbers keep all their bits.
    #[command(after_help = examples::TABLES)]
    Tables(TablesArgs),
    /// Read and validate a scene, and say what it contains.
    ///
    /// No motion is computed. Also says what the scene does not pay for because it lacks it, what
    /// code generated for it assumes, and which code a run begins with.
    #[command(after_help = examples::CHECK)]
    Check(CheckArgs),
    /// Compare all code that computes accelerations, on random states.
    ///
    /// In half of the states all hinges are free; in the others one or more random hinges are held
    /// at random angles. The thrust is on and kick-off springs are disengaged. The whole mass
    /// matrix, factored by Cholesky's method (dense), closed forms and generated routines, including one of a larger topology if a run takes it, are compared with
    /// the recursion in f64. All code is compared with the recursion in double-double, which has 32
    /// digits. A deviation from the recursion in f64 does not count where that is itself farther from
    /// double-double than the code. Deviations of accelerations are relative to the largest one. Where rounding is
    /// magnified more than 1e4 times, they are divided by how much more it is: by the inverse of the mass matrix of what
    /// moves freely; docs/validation.md has the terms. If a formulation has a
    /// mass matrix and forcing, they are compared with those of the recursion for its unknowns, with O at the inertial origin.
    /// Deviations of an entry of the matrix are relative to the root of the product of the inertias that its row and its
    /// column move, those of the forcing to its largest entry. The
    /// scales of accelerations and forcing are at least a thousandth of the natural size of the terms, for
    /// accelerations the square of the rates, so that results that cancel to zero are compared too. The exit
    /// code is 1 if a deviation is above the tolerance; the file is written even then.
    #[command(after_help = examples::VERIFY)]
    Verify(VerifyArgs),
    /// Time all code that computes accelerations.
    ///
    /// Prints nanoseconds per evaluation, in samples of 64 random states with all hinges free: the
    /// shortest and the median sample. For code that takes eight states at once it is an eighth of
    /// the time. The time of the recursion includes the springs and dashpots of the hinges; other
    /// code gets their torques as input.
    #[command(after_help = examples::BENCH)]
    Bench(BenchArgs),
    #[cfg(feature = "generator")]
    /// Write a commented scene to start from.
    ///
    /// KIND is boom, wing, gimbal or n-boom. A file that exists is left alone.
    #[command(after_help = examples::NEW)]
    New(NewArgs),
    /// Write a scene in another format.
    ///
    /// The ending of each name says its format: .nml is a legacy deck, .toml a scene. A deck becomes a
    /// scene with the same motion, to the last bit. A scene with parameters and includes becomes one
    /// that stands alone. A scene becomes a deck if a deck can say it; otherwise every body that it
    /// cannot is named, with the reason.
    #[command(after_help = examples::CONVERT)]
    Convert(ConvertArgs),
    /// Print the JSON schema of scenes or studies, for editors.
    #[command(after_help = examples::SCHEMA)]
    Schema(SchemaArgs),
    /// List formulations, integrators, laws, joints, outputs and stock routines.
    #[command(after_help = examples::LIST)]
    List,
    /// Compute properties and stresses of cross sections.
    ///
    /// FILE is JSON with a list `cases`. A section has an id, and kind "circular" with R and t, or
    /// "polygon" with vertices, a list of pairs [xi, zeta], and thickness, a list of numbers; wall
    /// l is from vertex l to the next. P and Q, force and moment on the outboard part about the
    /// point on the eta axis, are optional; with one of them the answer has stresses. The answer is
    /// the list with an object `expect` added to each section. Compression is positive in it, as in
    /// the report; docs/sections.md says what each of its keys is.
    #[command(after_help = examples::SECTION)]
    Section(SectionArgs),
    /// Write a crate with routines specialised for the scene.
    ///
    /// The crate needs only Rust: all that its code uses is in a module of it. CERTIFICATE.json
    /// says how far the formulation of each routine is from the recursion on random states, and the
    /// crate's tests compare the compiled code with the recursion in double-double and print its
    /// largest deviation. An up-to-date crate is left alone; a file that was changed, or not
    /// written by this command, is not overwritten.
    #[cfg(feature = "generator")]
    #[command(after_help = examples::GENERATE)]
    Generate(GenerateArgs),
    /// Build a stand-alone simulator around the scene's routines.
    ///
    /// The program takes SCENE and the options of nboom run; run, check, verify, bench and
    /// section as first word do what they do here. It has routines with the scene's numbers, with numbers at run time,
    /// and for states with held hinges: all of them with up to 10 hinges; with more, those in which
    /// all appendages are held in step; at most 32. By articulated it also has a routine that assumes
    /// nothing, in which other states and changed scenes are embedded. All else runs by
    /// the recursion. Cargo, which comes with Rust, builds it in a folder that is kept, so that the
    /// next build is quicker.
    #[cfg(feature = "generator")]
    #[command(after_help = examples::COMPILE)]
    Compile(CompileArgs),
    /// Print what lets a shell complete commands and options.
    ///
    /// For all later sessions save it, for bash, as nboom in ~/.local/share/bash-completion/completions; for zsh as
    /// _nboom in a folder of $fpath; for fish as nboom.fish in ~/.config/fish/completions; elvish and powershell
    /// evaluate it in rc.elv and $PROFILE.
    #[cfg(feature = "generator")]
    #[command(after_help = examples::COMPLETIONS)]
    Completions(CompletionsArgs),
    /// Write manual pages: nboom.1, and one for each command.
    ///
    /// In ~/.local/share/man/man1, man finds them: man nboom, man nboom-run. The names of the files are printed.
    #[cfg(feature = "generator")]
    #[command(after_help = examples::MAN)]
    Man(ManArgs),
}

/// Options of `nboom run`.
#[derive(Args, Debug)]
pub struct RunArgs {
    /// All options in words.
    #[command(flatten)]
    pub given: Given,

    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// Directory for the results, created if needed; by default out/ and the scene's name.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,

    /// SCENE is a study, and this the number of its case, from 1: the run that nboom sweep makes of it, bit for
    /// bit, by the options of the study. By default into out/, the study's name, -case- and the number.
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..),
          allow_negative_numbers = true)]
    pub case: Option<u64>,

    /// Output times after the initial one, uniform to the end time; they never change the steps. By
    /// default as many as the scene says, or 200.
    #[arg(long, value_name = "N", value_parser = samples_parser(), allow_negative_numbers = true)]
    pub samples: Option<usize>,

    /// Form of the equations of motion: report, relative, symmetric, articulated, momentum or
    /// recursive; by default articulated in generated code, recursive in library code.
    #[arg(long, value_name = "NAME", value_parser = choice::formulation)]
    pub formulation: Option<Form>,

    /// Method of integration: auto takes dopri5 for loose tolerances, dop853 for tight ones,
    /// gauss_lanes or adams where a smooth motion lasts, radau9 or radau13 while it is stiff; taylor
    /// is for errors down to rounding, gauss for long free spin, rkam the original's.
    #[arg(long, value_name = "NAME", default_value = "auto",
          value_parser = choice::integrator)]
    pub integrator: Method,

    /// Relative error allowed in a step, from 1e-14 to below 1.
    #[arg(long, value_name = "R", default_value = "1e-9", value_parser = choice::rtol,
          allow_negative_numbers = true)]
    pub rtol: f64,

    /// Absolute error allowed in a step, as a share of each variable's natural size.
    #[arg(long, value_name = "A", default_value = "1e-12", value_parser = choice::positive,
          allow_negative_numbers = true)]
    pub atol: f64,

    /// Longest step; by default steps are as long as the errors allow.
    #[arg(long, value_name = "H", value_parser = choice::positive, allow_negative_numbers = true)]
    pub max_step: Option<f64>,

    /// Steps after which the run is given up; by default 10000000, of a deck under rkam as LSTEP says.
    #[arg(long, value_name = "N", value_parser = count_parser(), allow_negative_numbers = true)]
    pub max_steps: Option<usize>,

    /// Events after which the run is given up, since a spring at its limit length may chatter or a hinge
    /// bounce at its stop on and on.
    #[arg(long, value_name = "N", default_value = "20000", value_parser = count_parser(),
          allow_negative_numbers = true)]
    pub max_events: usize,

    /// Which code computes the accelerations; auto takes generated code if there is any, and
    /// recursive if the formulation does not cover the scene.
    #[arg(long, value_name = "PATH", default_value = "auto", value_parser = choice::path())]
    pub path: Path,

    /// End of the run, instead of the scene's.
    #[arg(long, value_name = "T", value_parser = choice::finite, allow_negative_numbers = true)]
    pub end_time: Option<f64>,

    /// Labels of the units: none, SI, ft-lbf-s or in-lbf-s, instead of the scene's; no number is
    /// converted.
    #[arg(long, value_name = "NAME", value_parser = choice::units)]
    pub units: Option<UnitSystem>,

    /// Also write listing.txt, a printout at the output times and at every event.
    #[arg(long)]
    pub listing: bool,

    /// Run again with tolerances a thousand times tighter, or in double-double, and say how many
    /// digits of event times, impulses, the final state and the largest loads can be trusted; also
    /// writes certificate.json. Without a name it is tighter-tolerance; the other is double-double.
    #[arg(long, value_name = "REFERENCE", num_args = 0..=1, require_equals = true,
          default_missing_value = Reference::default().name(), value_parser = choice::reference)]
    pub certify: Option<Reference>,

    /// Tables, their times and columns.
    #[command(flatten)]
    pub tables: TableArgs,

    /// Slips of the original program.
    #[command(flatten)]
    pub slips: SlipArgs,

    /// Stresses, where the scene asks for them.
    #[command(flatten)]
    pub stresses: StressArgs,

    /// Write no report.html, the page that shows the run.
    #[arg(long)]
    pub no_report: bool,

    /// Take explicit steps as nboom sweep takes those of eight runs side by side: with the numbers of its tables,
    /// to the last bit.
    #[arg(long)]
    pub lanes: bool,

    /// Figures for documents.
    #[command(flatten)]
    pub plots: PlotArgs,

    /// Print no summary, no progress and no warnings about the scene; errors, and warnings that the
    /// results are poor or a part fails, are still printed.
    #[arg(long)]
    pub quiet: bool,
}

/// Options of `nboom verify`.
#[derive(Args, Debug)]
pub struct VerifyArgs {
    /// The scene.
    #[command(flatten)]
    pub scene: SceneArgs,

    /// File for the deviations, in JSON, its folder created if needed; by default verify.json in
    /// out/ and the scene's name.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,

    /// Also compare code with the scene's numbers built in, which is compiled first and kept. Needs cargo.
    #[cfg(feature = "generator")]
    #[arg(long)]
    pub compiled: bool,

    /// Number of random states: angles of any size, rates as large as the scene's initial angular
    /// rate, or of order 1 if that is zero.
    #[arg(long, value_name = "N", default_value = "100", value_parser = states_parser(),
          allow_negative_numbers = true)]
    pub states: usize,

    /// Seed of the random states; the same seed gives the same states everywhere.
    #[arg(long, value_name = "S", default_value = "1970", allow_negative_numbers = true)]
    pub seed: u64,

    /// Largest deviation allowed.
    #[arg(long, value_name = "T", default_value = "1e-11", value_parser = choice::positive,
          allow_negative_numbers = true)]
    pub tol: f64,
}

fn samples_parser() -> impl TypedValueParser<Value = usize> {
    value_parser!(u32).range(1..=MOST_SAMPLES as i64).map(|n| n as usize)
}

fn count_parser() -> impl TypedValueParser<Value = usize> {
    value_parser!(u32).range(1..).map(|n| n as usize)
}

fn states_parser() -> impl TypedValueParser<Value = usize> {
    value_parser!(u32).range(1..=1_000_000).map(|n| n as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_sim::Options;

    fn run_args(extra: &[&str]) -> Result<RunArgs, clap::Error> {
        let words = ["nboom", "run", "scene.nml"].iter().chain(extra);
        match Cli::try_parse_from(words)?.command {
            Command::Run(args) => Ok(*args),
            _ => unreachable!("the words say run"),
        }
    }

    #[test]
    fn defaults_are_those_of_a_run() {
        let args = run_args(&[]).expect("a scene is enough");
        let defaults = Options::default();
        assert_eq!((args.rtol, args.atol), (defaults.rtol, defaults.atol));
        assert_eq!((args.max_step, args.max_steps), (None, None));
        assert_eq!(args.max_events, defaults.max_events);
        assert_eq!((args.samples, args.units), (None, None));
    }

    #[test]
    fn samples_have_limits() {
        assert_eq!(
            run_args(&["--samples", "10000000"]).map(|a| a.samples).ok(),
            Some(Some(10_000_000))
        );
        for wrong in ["0", "10000001", "-1", "2.5", "many"] {
            assert_eq!(run_args(&["--samples", wrong]).map_err(|e| e.exit_code()).err(), Some(2));
        }
    }

    #[test]
    fn end_time_may_be_negative() {
        let args = run_args(&["--end-time", "-2.5"]).expect("a time");
        assert_eq!(args.end_time, Some(-2.5));
    }
}
