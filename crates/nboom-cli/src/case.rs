//! One case of a study as a run with all its files.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Parser;
use nboom_io::SceneFile;
use nboom_sim::Method;
use nboom_strength::{ActsOn, Idle, Settings};
use nboom_study::{RunSettings, Study, require_as_swept};

use crate::scene_args::{SceneArgs, read_options};
use crate::{Cli, CliError, Command, RunArgs, SweepError};

/// Why a case of a study cannot be run.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    /// An option says what a study says.
    #[error(
        "{option} with --case: found an option of scenes, expected none; the study says all of the scene"
    )]
    NotOfAStudy {
        /// The option.
        option: &'static str,
    },
    /// The study has fewer cases.
    #[error("{}: --case {found} found, a number from 1 to {cases} expected", path.display())]
    NoSuchCase {
        /// The study.
        path: PathBuf,
        /// What is asked for.
        found: u64,
        /// How many there are.
        cases: u64,
    },
    /// What is drawn makes no scene.
    #[error(
        "{}: case {case} is rejected: {why}; scene.toml is the scene as a sweep writes it out",
        path.display()
    )]
    Rejected {
        /// The study.
        path: PathBuf,
        /// The case.
        case: u64,
        /// Why.
        why: String,
    },
}

/// The arguments and the scene of case number `case` of the study that `args` name: its options are those of
/// the study, changed by those of `args`.
///
/// # Errors
/// When the study is wrong or has no such case, and when its numbers make no scene.
pub(crate) fn case(args: &RunArgs, case: u64) -> Result<(RunArgs, SceneFile), CliError> {
    let path = &args.scene.scene;
    let SceneArgs { set, format, fixed_base, .. } = &args.scene;
    let given =
        [("--set", !set.is_empty()), ("--format", format.is_some()), ("--fixed-base", *fixed_base)];
    if let Some((option, _)) = given.into_iter().find(|(_, is_given)| *is_given) {
        return Err(CaseError::NotOfAStudy { option }.into());
    }
    let study = read_study(path, args.scene.include_anywhere)?;
    let cases = study.cases();
    if !(1..=cases).contains(&case) {
        return Err(CaseError::NoSuchCase { path: path.clone(), found: case, cases }.into());
    }
    let file = study.named_scene_of(&study.case(case)).map_err(|rejection| {
        CaseError::Rejected { path: path.clone(), case, why: rejection.to_string() }
    })?;
    let of_inputs = format!("{}{}", nboom_io::sha256(study.text.as_bytes()), file.sha256);
    let file = SceneFile { sha256: nboom_io::sha256(of_inputs.as_bytes()), ..file };
    let again = with_settings(args, &study.run, &file)?;
    let by_default = || Path::new("out").join(format!("{}-case-{case}", study.name));
    let output = again.output.clone().unwrap_or_else(by_default);
    Ok((RunArgs { output: Some(output), ..again }, file))
}

/// Reads a study; one in the directory of a sweep has to be as the sweep wrote it.
pub(crate) fn read_study(path: &Path, include_anywhere: bool) -> Result<Study, CliError> {
    require_as_swept(path).map_err(SweepError::Study)?;
    Ok(Study::read_with(path, &read_options(include_anywhere))?)
}

/// The arguments with the settings of a study in place of defaults for a case with this scene.
///
/// # Errors
/// When an option acts on stresses that the study leaves out.
fn with_settings(
    args: &RunArgs,
    settings: &RunSettings,
    file: &SceneFile,
) -> Result<RunArgs, CliError> {
    let stresses = &args.stresses;
    let on_stresses = [
        ("--yield-stress", stresses.yield_stress.is_some()),
        ("--report-signs", stresses.report_signs),
    ];
    if let Some((option, _)) =
        on_stresses.into_iter().find(|(_, given)| *given && !settings.stresses)
    {
        return Err(CliError::idle(option, Idle::NoStresses));
    }
    let mut settings = settings.clone();
    settings.hinge_loads |= stresses.hinge_loads;
    if stresses.no_stresses {
        let Settings { amplification, pulses, .. } = settings.strength;
        settings.strength = Settings { amplification, pulses, ..Settings::default() };
        settings.stresses = false;
    }
    let of_study = arguments(args, words_of_settings(&settings, file)).given;
    Ok(arguments(args, of_study.changed_by(&args.given).words()))
}

/// The arguments of a run of the study of `args` with these options.
fn arguments(args: &RunArgs, options: Vec<String>) -> RunArgs {
    let mut words: Vec<OsString> = vec!["nboom".into(), "run".into()];
    words.extend(options.into_iter().map(OsString::from));
    words.extend(["--".into(), args.scene.scene.clone().into()]);
    match Cli::try_parse_from(&words).map(|cli| cli.command) {
        Ok(Command::Run(args)) => *args,
        other => unreachable!("a study has options of a run: {words:?}, {other:?}"),
    }
}

/// The settings of a study as options of `nboom run`, as far as they act on the scene of a case: a fault may leave no
/// latch or stop whose pulses could be amplified.
pub fn words_of_settings(settings: &RunSettings, file: &SceneFile) -> Vec<String> {
    let RunSettings { stresses, hinge_loads, lanes, integrator, .. } = *settings;
    let lanes = lanes && integrator.is_none_or(Method::takes_explicit_steps);
    let (strength, usual) = (&settings.strength, Settings::default());
    let has_pulses = settings.wanted_loads(file, &file.scene).idle(ActsOn::Pulses).is_none();
    let amplification = Some(strength.amplification).filter(|_| has_pulses);
    let pulses = Some(strength.pulses).filter(|&shape| has_pulses && shape != usual.pulses);
    let other = |factor: f64, usual: f64| (factor != usual).then(|| factor.to_string());
    let options = [
        ("rtol", settings.rtol.map(|rtol| rtol.to_string())),
        ("atol", settings.atol.map(|atol| atol.to_string())),
        ("integrator", integrator.map(|method| method.name().to_owned())),
        ("formulation", settings.formulation.map(|form| form.name().to_owned())),
        ("path", settings.path.map(|path| path.name().to_owned())),
        ("max-step", settings.max_step.map(|step| step.to_string())),
        ("max-steps", settings.max_steps.map(|steps| steps.to_string())),
        ("max-events", settings.max_events.map(|events| events.to_string())),
        ("samples", settings.samples.map(|samples| samples.to_string())),
        ("end-time", settings.end_time.map(|time| time.to_string())),
        ("yield-stress", strength.yield_stress.map(|stress| stress.to_string())),
        ("safety-factor", other(strength.safety_factor, usual.safety_factor)),
        ("ultimate-factor", other(strength.ultimate_factor, usual.ultimate_factor)),
        ("amplification", amplification.and_then(|of| other(of, usual.amplification))),
        ("pulses", pulses.map(|shape| shape.name().to_owned())),
    ];
    let given = options.into_iter().filter_map(|(name, word)| Some(format!("--{name}={}", word?)));
    let flags = [("--no-stresses", !stresses), ("--hinge-loads", hinge_loads), ("--lanes", lanes)];
    let flags = flags.into_iter().filter(|(_, is_on)| *is_on).map(|(flag, _)| flag.to_owned());
    given.chain(flags).collect()
}
