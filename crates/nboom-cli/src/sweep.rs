//! Many runs of one scene.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::thread;

use clap::{Args, Parser, value_parser};
use nboom_io::SceneFile;
use nboom_results::write_file;
use nboom_study::statistics::{Counts, Meaning, Summary};
use nboom_study::{
    End, Facts, PAGE_FILE, Report, STUDY_FILE, SWEPT_SCENE_FILE, Shard, Study, StudyError, Sweep,
    SweepDirectory, Watcher,
};

use crate::case::read_study;
use crate::format::short;
use crate::ignored::left_out_of_studies;
use crate::interrupt::{Interrupt, Interrupts};
use crate::progress::Cases;
use crate::run::run;
use crate::{Cli, CliError, Command, Routines, check, say, sweep_account};

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
    /// All cases are done, and none of them ran.
    #[error(
        "none of {} cases ran: {} rejected, {} failed; the column status of the tables in {} says why",
        counts.cases, counts.rejected, counts.failed, directory.display()
    )]
    NoneRan {
        /// The directory.
        directory: PathBuf,
        /// How many cases there are.
        counts: Box<Counts>,
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
            Self::Study(_) | Self::Interrupted { .. } | Self::NoneRan { .. } => 3,
        }
    }
}

/// The folder of a sweep's directory with runs of its worst cases.
const WORST: &str = "worst";

/// Most cases that get pages of their own.
const MOST_PAGES: usize = 12;

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
    if report.end == End::Interrupted {
        let (done, cases) = (report.done, report.description.share());
        return Err(SweepError::Interrupted { directory, done, cases }.into());
    }
    finish_sweep(&directory, &report, &args.outputs, routines, &Interrupt::watch)
}

/// Warns of the scene as it stands, as a run of it does, of what each fault makes of it, and of loads that leave latches
/// out; cases repeat its troubles. Notes what of it studies leave out, unless it shall be `quiet`.
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
    // Where only some latches lack it the reader of the scene says which.
    let is_told = scene.warnings.iter().any(|warning| warning.symbol == "pulse_constant");
    if study.leaves_pulses_out() && !is_told {
        say("warning", "loads are without latches, which have no pulse_constant");
    }
    if !quiet {
        left_out_of_studies(&scene.legacy).iter().for_each(|note| say("note", note));
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
    interrupts: Interrupts<'_>,
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
    let has_page = |case: u64| page_folder(directory, case).join(PAGE_FILE).is_file();
    let are_there =
        directory.join(PAGE_FILE).exists() && worst(&statistics).into_iter().all(has_page);
    let has_pages = report.end == End::WasComplete && are_there;
    if !(outputs.no_report || has_pages) {
        run_worst(&sweep, directory, routines, interrupts)?;
        write_page(&sweep, directory, &directory.join(PAGE_FILE))?;
    }
    warn_of_negative_margins(&statistics);
    warn_of_poor_cases(counts);
    if counts.ok == 0 {
        let (directory, counts) = (directory.to_owned(), Box::new(counts));
        return Err(SweepError::NoneRan { directory, counts }.into());
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

/// Runs the cases with the worst results again, for their pages.
fn run_worst(
    sweep: &SweepDirectory,
    directory: &Path,
    routines: &Routines,
    interrupts: Interrupts<'_>,
) -> Result<(), CliError> {
    for case in worst(&sweep.statistics().map_err(SweepError::Study)?) {
        let (study, folder) = (directory.join(STUDY_FILE), page_folder(directory, case));
        let mut words: Vec<OsString> = vec!["nboom".into(), "run".into(), "--quiet".into()];
        words.extend([format!("--case={case}").into(), "-o".into(), folder.into()]);
        words.extend(["--".into(), study.into()]);
        match Cli::try_parse_from(&words).map(|cli| cli.command) {
            Ok(Command::Run(args)) => match run(&args, routines, interrupts) {
                // Its page has loads, which its row may be without.
                Err(error) if error.is_of_the_run() => {
                    let lines = error.lines().join("; ");
                    say("warning", &format!("case {case} has no whole page: {lines}"));
                }
                done => drop(done?),
            },
            other => unreachable!("these words are a run: {words:?}, {other:?}"),
        };
    }
    Ok(())
}

/// The first case that breaks each requirement, and those with the worst results of each kind, without repetition.
fn worst(statistics: &Summary) -> Vec<u64> {
    let broken =
        statistics.requirements.iter().filter_map(|of| of.first_broken.iter().flatten().min());
    let mut cases: Vec<u64> = Vec::new();
    for case in broken.take(MOST_PAGES) {
        if !cases.contains(case) {
            cases.push(*case);
        }
    }
    let results = statistics.columns.iter().filter(|column| column.is_result);
    let mut results: Vec<_> = results.map(|column| (column, column.worst())).collect();
    // There are not pages for many results: margins come first, then latches that do not close.
    results.sort_by_key(|(column, worst)| {
        let is_never = worst.first().is_some_and(|worst| worst.value == f64::INFINITY);
        (column.meaning != Meaning::Margin, !is_never)
    });
    // The first of all results, before the second of any.
    for rank in 0..MOST_PAGES {
        for extreme in results.iter().filter_map(|(_, worst)| worst.get(rank)) {
            if cases.len() < MOST_PAGES && !cases.contains(&extreme.case) {
                cases.push(extreme.case);
            }
        }
    }
    cases
}

fn page_folder(directory: &Path, case: u64) -> PathBuf {
    directory.join(WORST).join(format!("case-{case}"))
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
        |case: &u64| is_beside && page_folder(directory, *case).join(PAGE_FILE).is_file();
    let facts = Facts {
        name: of.name.clone(),
        study: directory.join(STUDY_FILE).display().to_string(),
        scene: SWEPT_SCENE_FILE.to_owned(),
        method: of.method.clone(),
        seed: of.seed,
        draws: of.draws,
        version: of.made_by.version.clone(),
        reports: worst(&statistics).into_iter().filter(has_page).collect(),
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

#[cfg(test)]
mod tests {
    use nboom_study::Requirement;
    use nboom_study::statistics::{Field, Role, Statistics};
    use nboom_tables::Cell;

    use super::*;

    #[test]
    fn broken_requirements_have_pages_first_then_margins_then_latches_that_do_not_close() {
        let result = |label: String| Field::new(&label, &label, None, Role::Result);
        let forces = (1..=20).map(|i| result(format!("peak_force of {i}")));
        let others = ["lock_time of boom", "margin of boom"].map(str::to_owned).map(result);
        // Broken by one case, whose force is as large as that of all others.
        let required = Requirement {
            result: "peak_force of 17".to_owned(),
            at_least: None,
            at_most: Some(0.5),
        };
        let mut statistics = Statistics::new(forces.chain(others).collect(), &[required]);
        for case in 1..=20 {
            // Each case has the largest force of one hinge.
            let force = |i: u32| Cell::Number(f64::from(u8::from(i == case)));
            let lock_time = if case == 15 { Cell::Empty } else { Cell::Number(1.0) };
            let margin = Cell::Number(if case == 20 { 0.1 } else { 0.5 });
            let cells: Vec<_> = (1..=20).map(force).chain([lock_time, margin]).collect();
            statistics.row(&cells);
        }
        let found = worst(&statistics.finish());
        assert_eq!((found.len(), &found[..4]), (MOST_PAGES, &[17, 20, 15, 1][..]));
    }
}
