//! What is accepted but does nothing in a run, so that nobody waits for it.

use nboom_io::{LegacySettings, SceneFile};
use nboom_sim::Method;

use crate::RunArgs;

/// What a run by default, if there is no command line to say otherwise, takes no notice of: words of
/// the deck and options, each with its reason, in one line. `None` when there is nothing of the kind.
pub(crate) fn ignored(file: &SceneFile, args: Option<&RunArgs>) -> Option<String> {
    let by_rkam = args.is_some_and(|args| args.integrator == Method::Rkam);
    let listing = args.is_some_and(|args| args.listing);
    let stresses = file.structure.is_some() && !args.is_some_and(|args| args.stresses.no_stresses);
    let for_rkam = if by_rkam { Vec::new() } else { words_for_rkam(&file.legacy) };
    let reasons = [
        (for_rkam, "they steer --integrator rkam"),
        (words("IAX", !listing && file.legacy.print_interval.is_some()), "it thins out --listing"),
        (words("NOPLT=0", file.legacy.plots == Some(true)), "nothing is plotted"),
        (words("XNU, E", stresses), "no stress depends on them"),
        (words("--no-report", args.is_some_and(|args| args.no_report)), "no report is written"),
    ];
    let given = reasons.iter().filter(|(words, _)| !words.is_empty());
    let phrases: Vec<String> =
        given.map(|(words, reason)| format!("{} ({reason})", words.join(", "))).collect();
    (!phrases.is_empty()).then(|| format!("ignored: {}", phrases.join("; ")))
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
