//! Many runs of one scene.

use std::fmt;
use std::path::{Path, PathBuf};
use std::thread;

use clap::{Args, value_parser};
use nboom_io::SceneFile;
use nboom_results::write_file;
use nboom_study::statistics::{Counts, Meaning, Summary, Trouble};
use nboom_study::{
    End, Facts, PAGE_FILE, Report, STUDY_FILE, SWEPT_SCENE_FILE, Shard, Study, StudyError, Sweep,
    SweepDirectory, Watcher,
};

use crate::case::read_study;
use crate::format::short;
use crate::ignored::{idle_formulation_of, left_out_of_studies};
use crate::interrupt::{Interrupt, Interrupts};
use crate::progress::Cases;
use crate::{CliError, Routines, check, say, sweep_account, worst_cases};

/// Options of `nboom sweep`.
#[derive(Args, Debug)]
pub struct SweepArgs {
    /// A study, a file NAME.toml.
    #[arg(value_name = "STUDY")]
    pub study: PathBuf,

    /// Directory for the results, created if needed; by default out/ and the study's name.
    #[arg(short, long, value_name = "DIR")]
    pub output: Option<PathBuf>,

    /// Go on with a sweep that was not finished, or that has fewer draws by monte_carlo or sobol; in a directory
    /// without one, start.
    #[arg(long)]
    pub resume: bool,

    /// Threads; by default as many as there are processors.
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..),
          allow_negative_numbers = true)]
    pub jobs: Option<u16>,

    /// Run one of n equal parts of the cases, the i-th, from 1; nboom merge puts parts together.
    #[arg(long, value_name = "i/n")]
    pub shard: Option<Shard>,

    /// Let the scene include files outside of its folder.
    #[arg(long)]
    pub include_anywhere: bool,

    /// What is the same for a sweep and its parts put together.
    #[command(flatten)]
    pub outputs: SweepOutputs,
}

/// Options of `nboom sweep` and `nboom merge`.
#[derive(Args, Clone, Copy, Debug)]
pub struct SweepOutputs {
    /// Write tables in CSV too, also those of a sweep that was finished without.
    #[arg(long)]
    pub csv: bool,

    /// Go on although some cases were run by another version or with other vector instructions, which may
    /// change last digits.
    #[arg(long)]
    pub accept_difference: bool,

    /// Write no report.html and do not run the worst cases again for their pages.
    #[arg(long)]
    pub no_report: bool,

    /// Print no account and no progress; errors and warnings are still printed.
    #[arg(long)]
    pub quiet: bool,
}

/// Why a sweep has no results yet.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// It is refused, or could not be finished.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// It was interrupted.
    #[error(
        "interrupted; {done} of {cases} cases are done and in {}; the same command with --resume does the others",
        directory.display()
    )]
    Interrupted {
        /// The directory.
        directory: PathBuf,
        /// Cases that are done.
        done: u64,
        /// Cases in all.
        cases: u64,
    },
    /// It was interrupted when all cases were done.
    #[error(
        "interrupted; all cases are done, with tables and statistics in {}, but not all pages; the same sweep with --resume makes them",
        directory.display()
    )]
    WithoutPages {
        /// The directory.
        directory: PathBuf,
    },
    /// All cases are done, and none of them ran.
    #[error(
        "none of {} cases ran: {} rejected, {} failed; {first}; the column status of the tables in {} says why of all",
        counts.cases, counts.rejected, counts.failed, directory.display()
    )]
    NoneRan {
        /// The directory.
        directory: PathBuf,
        /// How many cases there are.
        counts: Box<Counts>,
        /// The first of them, and why it did not run.
        first: String,
    },
}

impl SweepError {
    /// A sweep that was finished is not there any more.
    fn gone(directory: &Path) -> Self {
        let (path, found) = (directory.to_owned(), "nothing".to_owned());
        Self::Study(StudyError::NoSweep { path, found })
    }

    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Study(error) if error.is_refusal() => 2,
            Self::Study(_)
            | Self::Interrupted { .. }
            | Self::WithoutPages { .. }
            | Self::NoneRan { .. } => 3,
        }
    }
}

/// Runs all cases of a study, and returns the text for standard output.
pub(crate) fn sweep(args: &SweepArgs, routines: &Routines) -> Result<String, CliError> {
    let study = read_study(&args.study, args.include_anywhere)?;
    warn_of_the_scene(&study, args.outputs.quiet);
    let directory = args.output.clone().unwrap_or_else(|| Path::new("out").join(&study.name));
    let processors = || thread::available_parallelism().map_or(1, usize::from);
    let sweep = Sweep {
        study: &study,
        directory: directory.clone(),
        jobs: args.jobs.map_or_else(processors, usize::from),
        resume: args.resume,
        shard: args.shard,
        csv: args.outputs.csv,
        accept_difference: args.outputs.accept_difference,
        kernels: routines.for_runs,
        right_sides: routines.right_sides_of_eight,
    };
    let watch = Watch { interrupt: Interrupt::patient()?, cases: Cases::new(args.outputs.quiet) };
    let report = sweep.run(&watch);
    watch.cases.finish();
    let report = report.map_err(SweepError::Study)?;
    if !args.outputs.quiet {
        let idle = report.selected.as_ref().and_then(idle_formulation_of);
        idle.iter().for_each(|note| say("note", note));
    }
    if report.end == End::Interrupted {
        let (done, cases) = (report.done, report.description.share());
        return Err(SweepError::Interrupted { directory, done, cases }.into());
    }
    let asked = Asked { of_all: &watch.interrupt, of_a_run: &Interrupt::watch };
    finish_sweep(&directory, &report, &args.outputs, routines, asked)
}

/// Warns of the scene as it stands, as a run of it does, of what each fault makes of it, and of loads that leave
/// pulses and margins that leave stations out; cases repeat its troubles. Notes what of it studies leave out, unless it
/// shall be `quiet`.
pub fn warn_of_the_scene(study: &Study, quiet: bool) {
    let warnings = |file: &SceneFile| Some(check::warnings(file, &study.run.scene(file).ok()?));
    let scene = study.document.as_read().unwrap_or(&study.nominal);
    warnings(scene).unwrap_or_default().iter().for_each(|warning| say("warning", warning));
    if let Some(sampling) = scene.settings.sampling_of_run(study.run.samples)
        && let Ok(run) = study.run.scene(scene)
        && let Some(late) = check::late_times(&sampling, &run)
    {
        say("warning", &late);
    }
    // The cases of a draw are that without a fault, and those with each.
    let of_case = |number| warnings(&study.scene_of(&study.case(number)).ok()?);
    let without_fault = of_case(1).unwrap_or_default();
    for (number, fault) in (2..).zip(&study.faults) {
        let found = of_case(number).unwrap_or_default();
        for warning in found.iter().filter(|warning| !without_fault.contains(warning)) {
            say("warning", &format!("with {}: {warning}", fault.name));
        }
    }
    // Where only some bodies lack it the reader of the scene says which.
    let is_told = scene.warnings.iter().any(|warning| warning.symbol == "pulse_constant");
    if study.leaves_pulses_out() && !is_told {
        say(
            "warning",
            "loads are without pulses of latches and stops, which need pulse_constant of each body they act on",
        );
    }
    study.without_margins().iter().for_each(|warning| say("warning", warning));
    if !quiet {
        left_out_of_studies(&scene.legacy).iter().for_each(|note| say("note", note));
    }
}

/// Who asks for an end while pages are made.
#[derive(Clone, Copy)]
pub struct Asked<'a> {
    /// Of the whole command, at any time since it began.
    pub of_all: &'a Interrupt,
    /// Of the run of one case, made as it begins.
    pub of_a_run: Interrupts<'a>,
}

impl fmt::Debug for Asked<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Asked").field("of_all", self.of_all).finish_non_exhaustive()
    }
}

/// Makes the page of a sweep that is complete, with runs of its worst cases, warns of its troubles, and
/// returns its account.
///
/// # Errors
/// When its files cannot be read or the page cannot be written, and when it is interrupted.
pub fn finish_sweep(
    directory: &Path,
    report: &Report,
    outputs: &SweepOutputs,
    routines: &Routines,
    asked: Asked<'_>,
) -> Result<String, CliError> {
    let counts = report.description.counts.unwrap_or_default();
    for (count, what) in [(counts.rejected, "rejected"), (counts.failed, "failed")] {
        if count > 0 {
            let cases = counts.cases;
            say("warning", &format!("{count} of {cases} cases {what}; the column status says why"));
        }
    }
    if report.description.shard.is_some() {
        warn_of_poor_cases(counts);
        let told = sweep_account::of_a_shard(report, directory);
        return Ok(if outputs.quiet { String::new() } else { told });
    }
    let sweep = finished(directory)?.ok_or_else(|| SweepError::gone(directory))?;
    let statistics = sweep.statistics().map_err(SweepError::Study)?;
    let has_page = |case: u64| worst_cases::folder(directory, case).join(PAGE_FILE).is_file();
    let are_there = directory.join(PAGE_FILE).exists()
        && worst_cases::of(&statistics).into_iter().all(has_page);
    let has_pages = report.end == End::WasComplete && are_there;
    if !(outputs.no_report || has_pages) {
        worst_cases::run_again(&sweep, directory, routines, asked)?;
        write_page(&sweep, directory, &directory.join(PAGE_FILE))?;
    }
    warn_of_negative_margins(&statistics);
    warn_of_poor_cases(counts);
    if counts.ok == 0 {
        let (directory, counts) = (directory.to_owned(), Box::new(counts));
        let told = |of: &Trouble| format!("case {} {}", of.case, of.status);
        let first = statistics.troubles.first().map(told).unwrap_or_default();
        return Err(SweepError::NoneRan { directory, counts, first }.into());
    }
    let told = sweep_account::text(report, &statistics, directory);
    Ok(if outputs.quiet { String::new() } else { told })
}

/// Warns also under `--quiet`, since results are not what they seem.
fn warn_of_poor_cases(counts: Counts) {
    let doubt = "errors of the run may decide whether a hinge locks";
    for (what, count, first, so) in [
        ("the motion runs away", counts.runaway, counts.first_runaway, ""),
        ("poor conservation", counts.poor, counts.first_poor, "; do not trust their motion"),
        (doubt, counts.doubtful, counts.first_doubtful, ""),
    ] {
        let Some(first) = first else { continue };
        let of = format!("{count} of {} cases that ran", counts.ok);
        say("warning", &format!("{what} in {of}, first in case {first}{so}"));
    }
}

fn warn_of_negative_margins(statistics: &Summary) {
    let margins = statistics.columns.iter().filter(|column| column.meaning == Meaning::Margin);
    for column in margins {
        if let Some(worst) = column.smallest.first().filter(|worst| worst.value < 0.0) {
            let (label, value, case) = (&column.label, short(worst.value, 3), worst.case);
            say("warning", &format!("{label}: negative, down to {value} in case {case}"));
        }
    }
}

/// The finished sweep in a directory, if one is there.
pub(crate) fn finished(directory: &Path) -> Result<Option<SweepDirectory>, CliError> {
    Ok(SweepDirectory::read(directory).map_err(SweepError::Study)?)
}

/// Writes the page of a sweep from its statistics; one in another folder than the sweep's has no links to pages of
/// cases, which it would not find.
pub(crate) fn write_page(
    sweep: &SweepDirectory,
    directory: &Path,
    page: &Path,
) -> Result<(), CliError> {
    let of = &sweep.description;
    let statistics = sweep.statistics().map_err(SweepError::Study)?;
    let is_beside = is_same_folder(page.parent().unwrap_or(directory), directory);
    let has_page =
        |case: &u64| is_beside && worst_cases::folder(directory, *case).join(PAGE_FILE).is_file();
    let facts = Facts {
        name: of.name.clone(),
        study: directory.join(STUDY_FILE).display().to_string(),
        scene: SWEPT_SCENE_FILE.to_owned(),
        method: of.method.clone(),
        seed: of.seed,
        draws: of.draws,
        vary_together: of.vary_together.clone(),
        version: of.made_by.version.clone(),
        reports: worst_cases::of(&statistics).into_iter().filter(has_page).collect(),
    };
    Ok(write_file(page, &nboom_study::page(&facts, &statistics))?)
}

fn is_same_folder(one: &Path, other: &Path) -> bool {
    let of = |path: &Path| Path::new(".").join(path).canonicalize().ok();
    of(one).is_some_and(|one| of(other) == Some(one))
}

/// Waits for a sweep on behalf of a terminal.
struct Watch {
    interrupt: Interrupt,
    cases: Cases,
}

impl Watcher for Watch {
    fn progress(&self, done: u64, total: u64) {
        self.cases.reach(done, total);
    }

    fn interrupted(&self) -> bool {
        self.interrupt.came()
    }
}
