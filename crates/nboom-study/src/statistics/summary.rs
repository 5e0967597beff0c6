//! What statistics say, as it stands in `statistics.json`.

use serde::{Deserialize, Serialize};

/// Statistics of a table of cases. Where cases are grouped by fault, group 0 has no fault, and group `i` has
/// the fault `faults[i - 1]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// How many cases there are.
    pub counts: Counts,
    /// Cases whose values were at hand for percentiles, histograms, drivers and curves.
    pub held: u64,
    /// Of about so many draws one was at hand; 1 if all were.
    pub share: u64,
    /// Names of faults.
    pub faults: Vec<String>,
    /// Variables and results, in the order of the table.
    pub columns: Vec<SummaryColumn>,
    /// Hinges whose lock-up times are among the results.
    pub latches: Vec<Latch>,
    /// The first cases that did not run.
    pub troubles: Vec<Trouble>,
    /// Some cases one by one.
    pub points: Points,
}

/// Numbers of cases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// All.
    pub cases: u64,
    /// Those that ran to their end.
    pub ok: u64,
    /// Those whose scene is unphysical.
    pub rejected: u64,
    /// Those that could not be followed.
    pub failed: u64,
}

/// Statistics of a variable or a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SummaryColumn {
    /// Its name in the table.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// Its unit.
    pub unit: Option<String>,
    /// Whether it is a result; else it is a variable.
    pub is_result: bool,
    /// Of each group how its numbers spread.
    pub spreads: Vec<Spread>,
    /// Of cases without fault; none if there are no numbers.
    pub histogram: Option<Histogram>,
    /// Of a result what drives it in cases without fault, strongest first.
    pub drivers: Vec<Driver>,
    /// The smallest numbers of all cases, smallest first.
    pub smallest: Vec<Extreme>,
    /// The largest numbers of all cases, largest first.
    pub largest: Vec<Extreme>,
}

/// What starts the text of a result that is a margin.
const MARGINS: [&str; 4] = [
    "margin of ",
    "verdict.smallest_margin",
    "verdict.smallest_yield_margin",
    "verdict.smallest_ultimate_margin",
];

/// What starts that of the smallest of a run.
const SMALLEST: &str = "smallest ";

impl SummaryColumn {
    /// Whether it is a margin, which should not be negative.
    pub fn is_margin(&self) -> bool {
        MARGINS.iter().any(|start| self.label.starts_with(start))
    }

    /// Whether its smallest numbers are the worst; else the largest are.
    pub fn is_worst_if_small(&self) -> bool {
        self.is_margin() || self.label.starts_with(SMALLEST)
    }

    /// The worst numbers of all cases, worst first.
    pub fn worst(&self) -> &[Extreme] {
        if self.is_worst_if_small() { &self.smallest } else { &self.largest }
    }
}

/// How numbers spread.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Cases that ran.
    pub cases: u64,
    /// Those of them that have a number.
    pub count: u64,
    /// Arithmetic mean.
    pub mean: Option<f64>,
    /// Standard deviation of the population that the cases are drawn from.
    pub deviation: Option<f64>,
    /// In ascending order; empty if there are no numbers.
    pub percentiles: Vec<Percentile>,
}

/// A percentile with its interval of 95 % confidence, which assumes no distribution but independent draws.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Percentile {
    /// Which one \[%\].
    pub percent: f64,
    /// Its estimate.
    pub value: f64,
    /// Lower end; none if there are too few cases for one.
    pub low: Option<f64>,
    /// Upper end; none if there are too few cases for one.
    pub high: Option<f64>,
}

/// How many numbers lie where, in shares of equal width.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Histogram {
    /// Lower end of the first share.
    pub from: f64,
    /// Upper end of the last share.
    pub to: f64,
    /// Numbers in each share.
    pub counts: Vec<u64>,
}

/// How a variable drives a result.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Driver {
    /// The variable, a number in `columns`.
    pub variable: usize,
    /// Spearman's rank correlation.
    pub coefficient: f64,
    /// No variable that is independent of the result goes beyond this in 95 % of studies.
    pub bound: f64,
}

/// A case at the end of a range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Extreme {
    /// The case.
    pub case: u64,
    /// Its group.
    pub fault: usize,
    /// Its number.
    pub value: f64,
}

/// When a hinge latches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Latch {
    /// The hinge.
    pub hinge: String,
    /// The unit of times.
    pub unit: Option<String>,
    /// How many cases without fault have latched by some times, which ascend.
    pub times: Vec<LatchTime>,
    /// Of each group how many cases have latched by the end.
    pub by_end: Vec<Proportion>,
}

/// How many cases have latched by a time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LatchTime {
    /// The time \[T\].
    pub time: f64,
    /// How many.
    #[serde(flatten)]
    pub latched: Proportion,
}

/// A share of cases with its interval of 95 % confidence by Wilson.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Proportion {
    /// Cases.
    pub count: u64,
    /// Of so many.
    pub of: u64,
    /// Lower end of the share.
    pub low: f64,
    /// Upper end of the share.
    pub high: f64,
}

/// A case that did not run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Trouble {
    /// The case.
    pub case: u64,
    /// Its group.
    pub fault: usize,
    /// Why.
    pub status: String,
}

/// Some cases that ran, in the order of the table, for plots.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Points {
    /// Their numbers.
    pub cases: Vec<u64>,
    /// Their groups.
    pub faults: Vec<usize>,
    /// Of each of `columns` their numbers to six digits.
    pub values: Vec<Vec<Option<f64>>>,
}
