//! The worst cases of a sweep, which are run again for pages of their own.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Parser;
use nboom_study::statistics::{Meaning, Summary};
use nboom_study::{STUDY_FILE, SweepDirectory};

use crate::run::run;
use crate::sweep::{Asked, SweepError};
use crate::{Cli, CliError, Command, Routines, say};

/// The folder of a sweep's directory with runs of its worst cases.
const WORST: &str = "worst";

/// Most cases that get pages of their own.
const MOST_PAGES: usize = 12;

/// Runs the cases with the worst results again, for their pages.
pub(crate) fn run_again(
    sweep: &SweepDirectory,
    directory: &Path,
    routines: &Routines,
    asked: Asked<'_>,
) -> Result<(), CliError> {
    let unfinished = || SweepError::WithoutPages { directory: directory.to_owned() };
    for case in of(&sweep.statistics().map_err(SweepError::Study)?) {
        if asked.of_all.came() {
            return Err(unfinished().into());
        }
        let (study, folder) = (directory.join(STUDY_FILE), folder(directory, case));
        let mut words: Vec<OsString> = vec!["nboom".into(), "run".into(), "--quiet".into()];
        words.extend([format!("--case={case}").into(), "-o".into(), folder.into()]);
        words.extend(["--".into(), study.into()]);
        match Cli::try_parse_from(&words).map(|cli| cli.command) {
            Ok(Command::Run(args)) => match run(&args, routines, asked.of_a_run) {
                Err(_) if asked.of_all.came() => return Err(unfinished().into()),
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
pub(crate) fn of(statistics: &Summary) -> Vec<u64> {
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

/// Where the run of a case is.
pub(crate) fn folder(directory: &Path, case: u64) -> PathBuf {
    directory.join(WORST).join(format!("case-{case}"))
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
        let found = of(&statistics.finish());
        assert_eq!((found.len(), &found[..4]), (MOST_PAGES, &[17, 20, 15, 1][..]));
    }
}
