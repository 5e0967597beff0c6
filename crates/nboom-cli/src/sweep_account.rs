//! What a sweep prints.

use std::fmt::Write;
use std::path::Path;

use nboom_study::Method;
use nboom_study::Report;
use nboom_study::statistics::{Percentile, Proportion, Summary, Worse};

/// The head of percentiles with bounds.
const BOUNDED: &str = "95 %, by 95 % confidence";

/// The percentiles that are printed.
const PERCENTS: [f64; 3] = [5.0, 50.0, 95.0];

/// The account of a part of a sweep.
pub(crate) fn of_a_shard(report: &Report, directory: &Path) -> String {
    let of = &report.description;
    let shard = of.shard.map_or_else(String::new, |shard| format!(" of shard {shard}"));
    let (name, cases, directory) = (&of.name, of.share(), directory.display());
    format!("{name}: {cases} cases{shard}, for nboom merge in {directory}\n")
}

/// The account of a whole sweep.
pub(crate) fn text(report: &Report, statistics: &Summary, directory: &Path) -> String {
    let (of, counts) = (&report.description, &statistics.counts);
    let faults = match statistics.faults.len() {
        0 => String::new(),
        1 => ", each also with a fault".to_owned(),
        n => format!(", each also with {n} faults"),
    };
    let mut text = format!(
        "{}: {} cases of {} draws by {}, seed {}{faults}; {} ok, {} rejected, {} failed\n\n",
        of.name,
        counts.cases,
        of.draws,
        of.method,
        of.seed,
        counts.ok,
        counts.rejected,
        counts.failed
    );
    // Points of a grid are chosen and not drawn.
    let is_drawn = of.method != Method::Grid.name();
    let rows: Vec<[String; 5]> = rows(statistics, is_drawn);
    let width = |i: usize| rows.iter().map(|row| row[i].chars().count()).max().unwrap_or(0);
    for row in &rows {
        let cells = row.iter().enumerate().map(|(i, cell)| format!("{cell:<0$}", width(i)));
        let _ = writeln!(text, "{}", cells.collect::<Vec<_>>().join("  ").trim_end());
    }
    let group = |fault: usize| match fault {
        0 => String::new(),
        fault => format!(" with {}", statistics.faults[fault - 1]),
    };
    text.push('\n');
    let mut shares = |what: &str, groups: &[Proportion]| {
        for (fault, share) in groups.iter().enumerate().filter(|(_, of)| of.of > 0) {
            let Proportion { count, of, low, high } = *share;
            let cases = if counts.ok == counts.cases { "cases" } else { "cases that ran" };
            let bounds = if is_drawn { format!(": {low:.4} to {high:.4}") } else { String::new() };
            let group = group(fault);
            let _ = writeln!(text, "{what} in {count} of {of} {cases}{group}{bounds}");
        }
    };
    for latch in &statistics.latches {
        shares(&format!("{} latches", latch.hinge), &latch.by_end);
    }
    for of in &statistics.requirements {
        shares(&format!("{} is met", of.requirement), &of.met);
    }
    if statistics.requirements.len() > 1 {
        shares("all requirements are met", &statistics.meet_all);
    }
    let _ = writeln!(text, "files  {}", directory.display());
    text
}

/// Of each result of cases without fault its percentiles, those of the worse side with bounds if there are
/// any, and what drives it most.
fn rows(statistics: &Summary, has_bounds: bool) -> Vec<[String; 5]> {
    let head = ["", "5 %", "median", if has_bounds { BOUNDED } else { "95 %" }, "driven by"];
    let mut rows = vec![head.map(str::to_owned)];
    for column in statistics.columns.iter().filter(|column| column.is_result) {
        let of = |percent: f64| {
            let spread = column.spreads.first()?;
            spread.percentiles.iter().find(|of| of.percent == percent).copied()
        };
        let [low, median, high] = PERCENTS.map(of);
        let gaps = column.spreads.first().filter(|spread| spread.count < spread.cases);
        // A latch that does not close is later than all others.
        let left_out = gaps.filter(|_| column.meaning.hinge_that_locks().is_none());
        let left_out = left_out.map_or_else(String::new, |spread| {
            format!(", {} of {} cases", spread.count, spread.cases)
        });
        let [low, high] = [(low, Worse::Large), (high, Worse::Small)]
            .map(|(of, better)| told(of, has_bounds && column.worse() != better));
        let driver =
            column.drivers.first().filter(|driver| driver.coefficient.abs() > driver.bound);
        let driver = driver.map_or_else(String::new, |driver| {
            format!("{} {:+.2}", statistics.columns[driver.variable].label, driver.coefficient)
        });
        let unit = column.unit.as_ref().map_or_else(String::new, |unit| format!(" [{unit}]"));
        let median = told(median, false);
        rows.push([format!("{}{unit}{left_out}", column.label), low, median, high, driver]);
    }
    rows
}

/// A percentile, with its bounds or without.
fn told(of: Option<Percentile>, has_bounds: bool) -> String {
    let Some(Percentile { value, low, high, .. }) = of else { return "-".to_owned() };
    match (low, high) {
        (Some(low), Some(high)) if has_bounds && low.is_finite() => {
            format!("{} ({} to {})", number(value), number(low), number(high))
        }
        _ => number(value),
    }
}

/// Five digits, or never.
fn number(value: f64) -> String {
    if value == f64::INFINITY { "never".to_owned() } else { crate::format::short(value, 5) }
}
