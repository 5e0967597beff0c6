use std::path::PathBuf;
use std::time::Instant;

use nboom_io::{LegacySettings, Sampling, SceneFile, folder_name, write_scene};
use nboom_model::Scene;
use nboom_results::{
    Kept, Outcome, RunDescription, RunDirectory, StressDescription, StressTables, with_causes,
};
use nboom_sim::{
    Bound, Method, Options, Path as Code, RkamSettings, Tolerance, Witness, check_start, simulate,
};
use nboom_strength::StressAnalysis;

use crate::certify::Certifier;
use crate::ignored::{idle_formulation, ignored, refuse_idle};
use crate::interrupt::{Interrupt, Interrupts, Left};
use crate::progress::Progress;
use crate::record::Record;
use crate::repeat::{is_record, repeated};
use crate::watch::Watch;
use crate::{
    CliError, Routines, RunArgs, case, check, print, print_run, say, table_args, tables, troubles,
};

/// Simulates a scene, writes its files and returns the text for standard output.
pub(crate) fn run(
    args: &RunArgs,
    routines: &Routines,
    interrupts: Interrupts<'_>,
) -> Result<String, CliError> {
    let (args, file) = match args.case {
        _ if is_record(&args.scene.scene) => repeated(args)?,
        Some(number) => case::case(args, number)?,
        None => return run_scene(args, args.scene.read()?, routines, interrupts),
    };
    run_scene(&args, file, routines, interrupts)
}

fn run_scene(
    args: &RunArgs,
    file: SceneFile,
    routines: &Routines,
    interrupts: Interrupts<'_>,
) -> Result<String, CliError> {
    let prepared = args.prepare(file, routines)?;
    // Before what may take long.
    let interrupt = interrupts()?;
    prepared.check()?;
    if !args.quiet {
        prepared.run.told_before().for_each(|warning| say("warning", warning));
        prepared.ignored.iter().for_each(|ignored| say("note", ignored));
    }
    prepared.write(args, &interrupt)
}

/// A run that can begin if [`Self::check`] says so.
#[derive(Clone, Debug)]
pub struct PreparedRun {
    /// The scene, with slips and with the end of the run.
    pub scene: Scene,
    /// How it is run.
    pub options: Options,
    /// What is written of it.
    pub run: RunDescription,
    /// What finds its stresses and the loads of its hinges, if any are wanted.
    pub stresses: Option<StressAnalysis>,
    /// What it ignores of the scene and of the options, in one line.
    pub ignored: Option<String>,
    tables: StressTables,
}

impl RunArgs {
    /// Prepares the run of a scene, whose options are all but those that say where the scene is.
    ///
    /// # Errors
    /// When options and scene do not fit.
    pub fn prepare(&self, file: SceneFile, routines: &Routines) -> Result<PreparedRun, CliError> {
        let slips = self.slips.as_1970.unwrap_or_default();
        refuse_idle(self, &file)?;
        self.tables.formats.iter().try_for_each(|format| format.require())?;
        let ignored = ignored(&file, Some(self));
        let of_slips = self.slips.warning(&self.stresses.wanted((&file, &file.scene), slips));
        let scene_text = write_scene(&file);
        let file = SceneFile { scene: slips.scene(file.scene), ..file };
        let kernels = if self.path == Code::Generic { &[] } else { routines.for_runs };
        let scene = with_end_time(file.scene.clone(), self.end_time)?;
        let stresses = self.stresses.wanted((&file, &scene), slips).analysis(kernels)?;
        let mut warnings = check::warnings(&file, &scene);
        let sampling = file.settings.sampling_of_run(self.samples);
        let of_scene = sampling.as_ref().filter(|_| self.tables.times.is_none());
        warnings.extend(of_scene.and_then(|of| check::late_times(of, &scene)));
        warnings.extend(stresses.as_ref().and_then(StressAnalysis::without_margins));
        let options = options(self, routines, &file.legacy);
        let samples = sampling.as_ref().and_then(Sampling::samples).unwrap_or(options.samples);
        let options = Options { samples, ..options };
        let units = self.units.clone().or(file.settings.units.clone()).unwrap_or_default();
        let times = self.tables.times(&scene)?;
        let output = table_args::output(self, &file.settings, &scene, &units, times.as_deref())?;
        let record = Record::of(self, file.sha256.clone(), &scene_text, times.as_deref()).text();
        let (every, signs) = (file.legacy.stress_interval, self.stresses.signs());
        let tables = StressTables { every, signs };
        let run = RunDescription {
            stresses: stresses.as_ref().and_then(|of| StressDescription::of(of, signs)),
            latch_pulses: stresses.as_ref().map(StressAnalysis::has_pulses),
            judged_by: stresses.as_ref().and_then(|of| of.settings().in_words()),
            warnings,
            slips: of_slips,
            print_interval: file.legacy.print_interval.unwrap_or(1),
            input_sha256: Some(file.sha256),
            scene_text: Some(scene_text),
            record: Some(record),
            parameters: file.settings.parameters,
            output,
            ..RunDescription::new(&scene, &options, units)
        };
        Ok(PreparedRun { scene, options, run, stresses, ignored, tables })
    }
}

impl PreparedRun {
    /// # Errors
    /// When the motion cannot begin.
    pub fn check(&self) -> Result<(), CliError> {
        check_start(&self.scene, &self.options).map_err(CliError::Start)
    }

    /// Simulates, writes all files into the directory that the arguments name, and returns an account; prints it where
    /// the run is complete but cannot be certified.
    ///
    /// # Errors
    /// When the motion cannot be followed to its end, when files cannot be written, and when it is interrupted;
    /// what was computed is kept.
    pub fn write(self, args: &RunArgs, interrupt: &Interrupt) -> Result<String, CliError> {
        let Self { scene, options, run, stresses, tables, .. } = self;
        let stresses = stresses.map(|analysis| (analysis, tables));
        let account = simulate_into_files(&scene, &options, run, stresses, args, interrupt)?;
        Ok(if args.quiet { String::new() } else { account })
    }
}

fn with_end_time(scene: Scene, end_time: Option<f64>) -> Result<Scene, CliError> {
    match end_time {
        Some(end_time) => scene.ending_at(end_time).map_err(CliError::EndTime),
        None => Ok(scene),
    }
}

fn options(args: &RunArgs, routines: &Routines, legacy: &LegacySettings) -> Options {
    let RunArgs { integrator, rtol, atol, max_steps, max_events, formulation, lanes, .. } = *args;
    let (kernels, batches) = (routines.for_runs, routines.right_sides_of_eight);
    let defaults = Options::default();
    let mut options = Options {
        integrator,
        rtol,
        atol,
        max_step: args.max_step.unwrap_or(f64::INFINITY),
        max_steps: max_steps.unwrap_or(defaults.max_steps),
        max_events,
        path: args.path,
        formulation,
        kernels,
        batches,
        lanes,
        ..defaults
    };
    if integrator == Method::Rkam {
        options.rkam = Some(rkam(legacy, options.tolerance()));
        // What the command line says comes before the deck.
        if let Some(of_deck) = legacy.max_steps.filter(|_| max_steps.is_none()) {
            (options.max_steps, options.max_steps_by) = (of_deck, "LSTEP");
        }
    }
    options
}

/// Settings of a deck for `rkam`; the tolerance replaces missing ones.
fn rkam(legacy: &LegacySettings, tolerance: Tolerance) -> RkamSettings {
    let upper = legacy.upper_error.map_or(Bound::Within(tolerance), Bound::Number);
    let from_upper = RkamSettings::meeting(upper);
    RkamSettings {
        first_step: legacy.first_step,
        shortest: legacy.min_step.unwrap_or(from_upper.shortest),
        longest: legacy.max_step.unwrap_or(from_upper.longest),
        lower: legacy.lower_error.map_or(from_upper.lower, Bound::Number),
        ..from_upper
    }
}

fn simulate_into_files(
    scene: &Scene,
    options: &Options,
    run: RunDescription,
    stresses: Option<(StressAnalysis, StressTables)>,
    args: &RunArgs,
    interrupt: &Interrupt,
) -> Result<String, CliError> {
    let directory = directory(args, scene)?;
    let started = Instant::now();
    let analysis = stresses.as_ref().map(|(analysis, _)| analysis.clone());
    let certifier = Certifier { interrupt: interrupt.clone(), analysis };
    let files = || files(&directory, scene, run.clone(), stresses, args);
    let mut watch = Watch {
        files: interrupt.making(files, RunDirectory::unfinished)?,
        interrupt: interrupt.clone(),
        progress: Progress::of(scene, args.quiet),
        events: Vec::new(),
        events_to_keep: print_run::EVENTS_SHOWN,
        witness: args.certify.map(|_| Witness::new()),
    };
    let result = simulate(scene, options, &mut watch);
    watch.progress.finish();
    let (summary, failed) = match result {
        Ok(summary) => (summary, None),
        Err(failure) => (*failure.summary, Some(failure.error)),
    };
    let error = failed.as_ref().map(|error| with_causes(error));
    let wall_seconds = started.elapsed().as_secs_f64();
    let worst = watch.files.worst_loads();
    let troubles = troubles(scene, &summary, options.rtol, &worst);
    let outcome = Outcome { summary, wall_seconds, error, troubles };
    let kept = interrupt.finishing(
        || watch.files.finish(&outcome),
        |kept| match failed.is_none() && kept.written.is_ok() {
            true => Left::Complete(kept.directory.clone()),
            false => Left::Incomplete(kept.directory.clone()),
        },
    );
    let tabled = tables::add(&args.tables.formats, &kept);
    // Printed even with --quiet, since the results are not what they seem.
    warn_of_poor_results(args.case, &outcome.troubles);
    if !args.quiet
        && let Some(idle) = idle_formulation(options, &outcome.summary)
    {
        say("note", &idle);
    }
    // The error that stopped the run says more than one in writing the files afterwards.
    if let Some(error) = failed {
        let _ = show(args, &kept);
        return Err(CliError::Simulation { error, directory: Some(kept.directory) });
    }
    // The run has its page and its figures even if nothing can be said of its digits.
    let certified = match watch.witness.as_ref().zip(args.certify) {
        Some((witness, reference)) if kept.written.is_ok() => {
            certifier.certify(scene, options, reference, (witness, &worst), &kept).map(Some)
        }
        _ => Ok(None),
    };
    let shown = show(args, &kept);
    kept.written?;
    shown?;
    tabled?;
    let (outcome, events) = (&outcome, watch.events);
    let account = |certified| {
        let account = print_run::Account { scene, run: &run, outcome, events, worst, certified };
        account.text(&directory)
    };
    match certified {
        Ok(certified) => Ok(account(certified)),
        Err(error) => {
            if !args.quiet {
                print(&account(None))?;
            }
            Err(error)
        }
    }
}

/// The files of the run, made in the directory.
fn files(
    directory: &std::path::Path,
    scene: &Scene,
    run: RunDescription,
    stresses: Option<(StressAnalysis, StressTables)>,
    args: &RunArgs,
) -> Result<RunDirectory, CliError> {
    let mut files = RunDirectory::create(directory, scene, run)?;
    if files.has_put_right() && !args.quiet {
        let directory = directory.display();
        say("warning", &format!("{directory}: a finished run had not taken its place and now has"));
    }
    if args.certify.is_some() {
        files = files.with_trust();
    }
    if let Some((analysis, tables)) = stresses {
        files = files.with_stresses(scene, analysis, tables)?;
    }
    Ok(files.expecting(tables::names(&args.tables.formats)))
}

/// The directory of the results, in which nothing stands in the way of figures.
fn directory(args: &RunArgs, scene: &Scene) -> Result<PathBuf, CliError> {
    let directory = args.output.clone().unwrap_or_else(|| default_directory(&scene.name));
    args.plots.check(&directory)?;
    Ok(directory)
}

/// Warns of the run, or of the case of a study that it is: a sweep runs several for their pages.
fn warn_of_poor_results(case: Option<u64>, troubles: &[String]) {
    let of_case = case.map_or(String::new(), |case| format!("case {case}: "));
    for warning in troubles {
        say("warning", &format!("{of_case}{warning}"));
    }
}

/// The page and the figures of the run, made from its files, as far as somebody wants them.
fn show(args: &RunArgs, kept: &Kept) -> Result<(), CliError> {
    if args.no_report && !args.plots.are_wanted() {
        return Ok(());
    }
    let run = nboom_report::Run::read(&kept.directory)?;
    args.plots.draw(&run, &kept.directory)?;
    if args.no_report {
        return Ok(());
    }
    Ok(kept.add_report(&nboom_report::page(vec![run]))?)
}

/// `out/` and the scene's name, with characters replaced that a file name cannot have.
pub(crate) fn default_directory(scene: &str) -> PathBuf {
    PathBuf::from("out").join(folder_name(scene.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_deck_steers_rkam_and_the_tolerance_says_the_rest() {
        let tolerance = Tolerance { relative: 1e-6, absolute: 1e-8 };
        let silent = LegacySettings::default();
        assert_eq!(rkam(&silent, tolerance), RkamSettings::meeting(Bound::Within(tolerance)));
        let deck = LegacySettings {
            first_step: Some(0.1),
            upper_error: Some(0.2),
            min_step: Some(0.3),
            max_step: Some(0.4),
            ..silent
        };
        let (upper, lower) = (Bound::Number(0.2), Bound::Number(0.2 / 50.0));
        let first_step = Some(0.1);
        let expected = RkamSettings { first_step, shortest: 0.3, longest: 0.4, upper, lower };
        assert_eq!(rkam(&deck, tolerance), expected);
        let deck = LegacySettings { lower_error: Some(0.5), ..deck };
        assert_eq!(rkam(&deck, tolerance).lower, Bound::Number(0.5));
    }

    #[test]
    fn no_scene_name_leads_out_of_the_output_directory() {
        for (name, path) in [
            ("boom", "out/boom"),
            ("../boom", "out/_._boom"),
            ("..", "out/_."),
            ("", "out/scene"),
            ("/etc", "out/_etc"),
        ] {
            assert_eq!(default_directory(name), PathBuf::from(path));
        }
    }
}
