//! What a sweep prints.

use std::fmt::Write;
use std::path::Path;

use nboom_study::Method;
use nboom_study::Report;
use nboom_study::statistics::{Driver, Percentile, Proportion, Spread, Summary, Worse};

use crate::format::short;

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
    if !of.vary_together.is_empty() {
        let names = of.vary_together.join(", ");
        let _ = writeln!(text, "{names} vary together: each may seem to drive what another does");
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
        shares(&format!("{} is met", statistics.in_words(&of.requirement)), &of.met);
    }
    if statistics.requirements.len() > 1 {
        shares("all requirements are met", &statistics.meet_all);
    }
    let _ = writeln!(text, "files  {}", directory.display());
    text
}

/// Of each result of cases without fault its percentiles, if these are drawn those of the worse side with bounds, and what
/// drives it most.
fn rows(statistics: &Summary, is_drawn: bool) -> Vec<[String; 5]> {
    let of = if statistics.faults.is_empty() { "" } else { "of cases without fault" };
    let head = [of, "5 %", "median", if is_drawn { BOUNDED } else { "95 %" }, "driven by"];
    let mut rows = vec![head.map(str::to_owned)];
    for column in statistics.columns.iter().filter(|column| column.is_result) {
        // Cases without fault are always there, if only as none.
        let Some(spread) = column.spreads.first() else { continue };
        let of = |percent: f64| spread.percentiles.iter().find(|of| of.percent == percent);
        let [low, median, high] = PERCENTS.map(of);
        // A latch that does not close is later than all others.
        let has_gaps = spread.count < spread.cases && column.meaning.hinge_that_locks().is_none();
        let left_out = if has_gaps {
            format!(", {} of {} cases", spread.count, spread.cases)
        } else {
            String::new()
        };
        let [low, high] = [(low, Worse::Large), (high, Worse::Small)]
            .map(|(of, better)| told(spread, of, is_drawn && column.worse() != better));
        // Chance has no part in what was chosen.
        let may_be_chance = |driver: &Driver| is_drawn && driver.coefficient.abs() <= driver.bound;
        let driver = column.drivers.first().filter(|driver| !may_be_chance(driver));
        let driver = driver.and_then(|driver| {
            let coefficient = of_correlation(driver.coefficient)?;
            Some(format!("{} {coefficient}", statistics.columns[driver.variable].label))
        });
        let median = told(spread, median, false);
        let driver = driver.unwrap_or_default();
        rows.push([format!("{}{left_out}", column.title()), low, median, high, driver]);
    }
    rows
}

/// A percentile, with its bounds or without.
fn told(spread: &Spread, of: Option<&Percentile>, has_bounds: bool) -> String {
    let Some(&Percentile { value, low, high, .. }) = of else { return "-".to_owned() };
    let number = |value| number(spread, value);
    let end = |end: Option<f64>| end.map_or_else(|| "no bound".to_owned(), number);
    match (low, high) {
        _ if !has_bounds => number(value),
        (None, None) => format!("{} (no bounds)", number(value)),
        // It is never for sure.
        (Some(f64::INFINITY), _) => number(value),
        _ => format!("{} ({} to {})", number(value), end(low), end(high)),
    }
}

/// A rank correlation, unless its two decimals are zero.
fn of_correlation(coefficient: f64) -> Option<String> {
    let told = format!("{coefficient:+.2}");
    (!told.ends_with("0.00")).then_some(told)
}

/// Five digits, or as many as tell the number from others of its column; or never.
fn number(spread: &Spread, value: f64) -> String {
    match value == f64::INFINITY {
        true => "never".to_owned(),
        false => short(value, spread.digits(value, 5)),
    }
}

#[cfg(test)]
mod tests {
    use nboom_study::statistics::{Field, Role, Statistics};
    use nboom_tables::Cell;

    use super::*;

    #[test]
    fn numbers_that_lie_close_together_far_from_zero_are_told_apart() {
        let label = "lock_time of boom";
        let field = Field::new(label, label, None, Role::Result);
        let mut statistics = Statistics::new(vec![field], &[]);
        // Percentiles of 0 to 100 in steps of one are themselves.
        let number = |i: u32| 5000.0 + 1e-3 * f64::from(i);
        (0..=100).for_each(|i| statistics.row(&[Cell::Number(number(i))]));
        let rows = rows(&statistics.finish(), false);
        let told = rows[1][1..4].iter().map(|cell| cell.parse::<f64>().expect("a number"));
        for (told, expected) in told.zip([5, 50, 95].map(number)) {
            assert!((told - expected).abs() < 5e-4, "{told} for {expected}");
        }
    }

    /// What is printed of a result of so many cases, which is its variable: 0, 1, 2 and so on.
    fn row_of(cases: u32, is_drawn: bool) -> [String; 5] {
        let fields = [("x", Role::Variable), ("evaluations", Role::Result)];
        let fields = fields.map(|(label, role)| Field::new(label, label, None, role));
        let mut statistics = Statistics::new(fields.into(), &[]);
        (0..cases).for_each(|i| statistics.row(&[Cell::Number(i.into()), Cell::Number(i.into())]));
        rows(&statistics.finish(), is_drawn)[1].clone()
    }

    #[test]
    fn an_end_that_an_interval_does_not_have_is_said() {
        // Of 101 draws 90 or fewer lie below the percentile with probability 0.012, 91 or fewer with 0.030, 99 or fewer
        // with 0.964 and 100 or fewer with 0.994. Of 60 all do with 0.046, of one none does with 0.05.
        for (cases, ends) in [(101, "95 (90 to 100)"), (60, "to no bound)"), (1, "0 (no bounds)")] {
            let told = &row_of(cases, true)[3];
            assert!(told.ends_with(ends), "{told}");
            assert!(!row_of(cases, false)[3].contains('('));
        }
    }

    #[test]
    fn chance_hides_no_driver_of_a_grid() {
        // Three cases have no coefficient that cannot be chance.
        for (is_drawn, told) in [(true, ""), (false, "x +1.00")] {
            assert_eq!(row_of(3, is_drawn)[4], told);
        }
        assert_eq!(row_of(101, true)[4], "x +1.00");
    }

    #[test]
    fn a_correlation_that_rounds_to_zero_has_no_sign_and_drives_nothing() {
        for coefficient in [-0.004, -0.0, 0.0, 0.004] {
            assert_eq!(of_correlation(coefficient), None);
        }
        assert_eq!(of_correlation(-0.006).as_deref(), Some("-0.01"));
        assert_eq!(of_correlation(0.7).as_deref(), Some("+0.70"));
    }
}
