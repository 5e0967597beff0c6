//! Settings without effect in a run: options that are refused, and settings that are accepted but
//! reported as ignored.

use nboom_io::{Format, LegacySettings, SceneFile};
use nboom_sim::{Form, Method, Options, Selection, Summary};
use nboom_strength::{ActsOn, Loads, PulseShape, Slips};
use nboom_study::Selected;

use crate::{CliError, RunArgs, StressArgs};

/// Refuses options that have no effect because of other options or of the scene.
pub(crate) fn refuse_idle(args: &RunArgs, file: &SceneFile) -> Result<(), CliError> {
    let RunArgs { integrator, formulation, path, .. } = *args;
    let code = Options { integrator, formulation, path, ..Options::default() };
    code.check_choices().map_err(|idle| CliError::idle(format!("--{}", idle.option()), idle))?;
    let stresses = &args.stresses;
    let wanted = stresses.wanted((file, &file.scene), Slips::default());
    let given = [
        ("--yield-stress", stresses.yield_stress.is_some(), ActsOn::Stresses),
        ("--safety-factor", stresses.safety_factor.is_some(), ActsOn::YieldMargins),
        ("--ultimate-factor", stresses.ultimate_factor.is_some(), ActsOn::UltimateMargins),
        ("--report-signs", stresses.report_signs, ActsOn::Stresses),
        ("--amplification", stresses.amplification.is_some(), ActsOn::Pulses),
        ("--pulses", stresses.pulses != PulseShape::default(), ActsOn::Pulses),
    ];
    let idle = |(option, is_given, acts_on): (&str, bool, ActsOn)| {
        let why = is_given.then(|| wanted.idle(acts_on)).flatten()?;
        Some(CliError::idle(option, why))
    };
    given.into_iter().find_map(idle).map_or(Ok(()), Err)
}

/// What a run ignores, by default or under these options: words of the deck and options, each with
/// its reason, in one line. `None` if there is nothing. `file` has the scene without slips.
pub(crate) fn ignored(file: &SceneFile, args: Option<&RunArgs>) -> Option<String> {
    let by_rkam = args.is_some_and(|args| args.integrator == Method::Rkam);
    let listing = args.is_some_and(|args| args.listing);
    let plots = args.is_some_and(|args| args.plots.are_wanted());
    let stresses = args.map_or_else(StressArgs::default, |args| args.stresses);
    let wanted = stresses.wanted((file, &file.scene), Slips::default());
    let stress_every = if file.format == Format::Nml { "INSTR" } else { "stress_every" };
    let thins_nothing = file.legacy.stress_interval > 1 && wanted.loads() == Loads::None;
    let for_rkam = if by_rkam { Vec::new() } else { words_for_rkam(&file.legacy) };
    let bounded = by_rkam && file.legacy.upper_error.is_some();
    let tolerances = args.filter(|_| bounded).map_or_else(Vec::new, given_tolerances);
    let slips = args.map_or_else(Vec::new, |args| args.slips.idle(&wanted));
    let of_deck = wanted.stressed().is_some() && file.format == Format::Nml;
    let implicit = args.is_some_and(|args| args.lanes && !args.integrator.takes_explicit_steps());
    let reasons = [
        (for_rkam, "they steer --integrator rkam"),
        (words("IAX", !listing && file.legacy.print_interval.is_some()), "it thins out --listing"),
        (words(stress_every, thins_nothing), "it thins out loads, and there are none"),
        (words("NOPLT=0", !plots && file.legacy.plots == Some(true)), "--plots asks for figures"),
        (words("XNU, E", of_deck), "no stress depends on them"),
        (tolerances, "EU1 of the deck bounds the errors of rkam"),
        (words("--lanes", implicit), "the integrator takes no explicit steps"),
        (slips, "nothing in this run shows these slips of 1970"),
    ];
    let given = reasons.iter().filter(|(words, _)| !words.is_empty());
    let phrases: Vec<String> =
        given.map(|(words, reason)| format!("{} ({reason})", words.join(", "))).collect();
    (!phrases.is_empty()).then(|| format!("ignored: {}", phrases.join("; ")))
}

/// The formulation that is asked for, where a run had another one since it does not cover the scene, or a mode of it.
pub fn idle_formulation(options: &Options, summary: &Summary) -> Option<String> {
    let idle = without_formulation(options.formulation?, &summary.selections)?;
    Some(format!("ignored: --formulation {idle}"))
}

/// The same of a study by its first case, which others are like but for what varies.
pub fn idle_formulation_of(selected: &Selected) -> Option<String> {
    let Selected { case, formulation, selections } = selected;
    let idle = without_formulation(*formulation, selections)?;
    Some(format!("ignored in case {case}: formulation {idle}"))
}

/// The name of a formulation with when and why another one took its place, if one did.
fn without_formulation(formulation: Form, selections: &[Selection]) -> Option<String> {
    let name = formulation.name();
    let others = || selections.iter().filter(|code| code.formulation != name);
    let first = others().next()?;
    let is_idle = others().count() == selections.len();
    let when = if is_idle { String::new() } else { format!(" at time {:?}", first.since) };
    Some(format!("{name}{when} ({})", first.reason))
}

/// What a deck says that does not reach the runs of a study, in one line: they run the scene that is made of it.
pub(crate) fn left_out_of_studies(legacy: &LegacySettings) -> Option<String> {
    let words = words_for_rkam(legacy);
    let told =
        || format!("left out: {} (a study takes no steps of rkam from a deck)", words.join(", "));
    (!words.is_empty()).then(told)
}

/// Those that differ from their defaults.
fn given_tolerances(args: &RunArgs) -> Vec<&'static str> {
    let defaults = Options::default();
    let given = [("--rtol", args.rtol != defaults.rtol), ("--atol", args.atol != defaults.atol)];
    given.into_iter().filter(|(_, given)| *given).map(|(option, _)| option).collect()
}

fn words(words: &'static str, are_ignored: bool) -> Vec<&'static str> {
    if are_ignored { vec![words] } else { Vec::new() }
}

fn words_for_rkam(legacy: &LegacySettings) -> Vec<&'static str> {
    let given = [
        ("HZO", legacy.first_step.is_some()),
        ("EU1", legacy.upper_error.is_some()),
        ("EL1", legacy.lower_error.is_some()),
        ("HMIN", legacy.min_step.is_some()),
        ("HMAX", legacy.max_step.is_some()),
        ("LSTEP", legacy.max_steps.is_some()),
    ];
    given.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name).collect()
}
