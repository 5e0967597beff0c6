//! What statistics say, as it stands in `statistics.json`.

use serde::{Deserialize, Serialize};

use super::Meaning;
use crate::Requirement;

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
    /// What is required of results, and what came of it.
    #[serde(default)]
    pub requirements: Vec<Compliance>,
    /// Of each group how many cases meet all requirements; empty without any.
    #[serde(default)]
    pub meet_all: Vec<Proportion>,
    /// The first cases that did not run.
    pub troubles: Vec<Trouble>,
    /// Some cases one by one.
    pub points: Points,
}

impl Summary {
    /// A requirement in words, with the unit of its result.
    pub fn in_words(&self, required: &Requirement) -> String {
        let is_of = |column: &&SummaryColumn| column.is_result && column.label == required.result;
        let title =
            self.columns.iter().find(is_of).map_or(required.result.clone(), SummaryColumn::title);
        format!("{title} {}", required.bounds())
    }
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
    /// Those that ran to their end with energy that grew beyond all that their scenes have.
    #[serde(default)]
    pub runaway: u64,
    /// The first of these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_runaway: Option<u64>,
    /// Those that ran without keeping a conservation law, which is why their motion is not to be trusted.
    #[serde(default)]
    pub poor: u64,
    /// The first of these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_poor: Option<u64>,
    /// Those that ran, but in which errors may decide whether a hinge locks.
    #[serde(default)]
    pub doubtful: u64,
    /// The first of these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub first_doubtful: Option<u64>,
}

/// Statistics of a variable or a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SummaryColumn {
    /// Its name in the table.
    pub name: String,
    /// What people call it.
    pub label: String,
    /// What it is.
    #[serde(default)]
    pub meaning: Meaning,
    /// What it means: of a variable what becomes of its numbers.
    #[serde(default)]
    pub description: String,
    /// Its unit.
    pub unit: Option<String>,
    /// Whether it is a result; else it is a variable.
    pub is_result: bool,
    /// On which side its numbers are worse by what is required of it, if that is one bound.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub worse_by_requirement: Option<Worse>,
    /// Whether it is the same in all cases without fault, a result but for errors of runs; so too if none has a number.
    #[serde(default)]
    pub is_constant: bool,
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

/// On which side of their range numbers are worse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Worse {
    /// Margins, and what is smallest in a run.
    Small,
    /// Numbers that are not negative, and what is largest in a run.
    Large,
    /// Numbers with a sign, of which size counts.
    Both,
}

impl SummaryColumn {
    /// What people call it, with its unit.
    pub fn title(&self) -> String {
        let unit = self.unit.as_ref().map_or_else(String::new, |unit| format!(" [{unit}]"));
        format!("{}{unit}", self.label)
    }

    /// On which side its numbers are worse.
    pub fn worse(&self) -> Worse {
        let is_negative = |found: &Extreme| found.value < 0.0;
        if let Some(side) = self.worse_by_requirement {
            side
        } else {
            match self.meaning {
                Meaning::Margin | Meaning::Smallest => Worse::Small,
                Meaning::Largest => Worse::Large,
                _ if self.smallest.first().is_some_and(is_negative) => Worse::Both,
                _ => Worse::Large,
            }
        }
    }

    /// The worst numbers of all cases, worst first.
    pub fn worst(&self) -> Vec<Extreme> {
        match self.worse() {
            Worse::Small => self.smallest.clone(),
            Worse::Large => self.largest.clone(),
            Worse::Both => {
                let mut both = self.largest.clone();
                both.extend(self.smallest.iter().filter(|found| !self.largest.contains(found)));
                both.sort_by(|a, b| b.value.abs().total_cmp(&a.value.abs()));
                both.truncate(self.smallest.len());
                both
            }
        }
    }
}

/// How numbers spread.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Cases that ran; of a variable all.
    pub cases: u64,
    /// Those of them that have a number.
    pub count: u64,
    /// Arithmetic mean of these.
    pub mean: Option<f64>,
    /// Standard deviation of the population that the cases are drawn from.
    pub deviation: Option<f64>,
    /// In ascending order; empty if there are no numbers. Those of lock-up times are of all cases that ran.
    pub percentiles: Vec<Percentile>,
}

/// Digits beyond these are errors of runs, however tight their tolerance.
const MOST_DIGITS: i32 = 10;

/// The error of a result over the relative tolerance of its run, which seldom is more.
const MOST_ERROR: f64 = 100.0;
/// Numbers further apart than this share are told apart however loose the tolerance.
const LARGEST: f64 = 1e-3;

/// Whether all that tells numbers with these ends apart are errors of runs with this relative tolerance; counts have
/// none.
pub(super) fn are_errors_of_runs(low: f64, high: f64, rtol: f64) -> bool {
    let share = (MOST_ERROR * rtol).clamp(10_f64.powi(-MOST_DIGITS), LARGEST);
    let are_counts = low.fract() == 0.0 && high.fract() == 0.0;
    !are_counts && high - low <= share * low.abs().max(high.abs())
}

impl Spread {
    /// How many significant digits of a number tell it from others that spread so far, at least so many.
    pub fn digits(&self, value: f64, least: usize) -> usize {
        let order = |size: f64| size.log10().floor();
        let further = self
            .deviation
            .filter(|deviation| *deviation > 0.0)
            .map(|deviation| order(value.abs()) - order(deviation / 100.0) + 1.0);
        // A negative number, or that of zero, becomes 0.
        least.max(further.map_or(0, |digits| digits as usize).min(MOST_DIGITS as usize))
    }
}

/// A percentile with its interval of 95 % confidence, which assumes no distribution but independent draws.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Percentile {
    /// Which one \[%\].
    pub percent: f64,
    /// Its estimate; infinite, and `null` in a file, if a lock-up is never.
    #[serde(with = "never")]
    pub value: f64,
    /// Lower end; none, and not in a file, if there are too few cases for one; infinite, and `null`, if it is never.
    #[serde(default, skip_serializing_if = "Option::is_none", with = "never::end")]
    pub low: Option<f64>,
    /// Upper end, likewise.
    #[serde(default, skip_serializing_if = "Option::is_none", with = "never::end")]
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
    /// Its number; infinite, and `null` in a file, if a lock-up is never.
    #[serde(with = "never")]
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
    /// How many have latched before it. Those of them that had not by the time told before are not told one by one.
    pub before: u64,
    /// How many.
    #[serde(flatten)]
    pub latched: Proportion,
}

/// What is required of a result, and which cases meet it. A case without the number does not.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compliance {
    /// What is required.
    #[serde(flatten)]
    pub requirement: Requirement,
    /// Of each group how many cases meet it.
    pub met: Vec<Proportion>,
    /// Of each group the first case that does not.
    pub first_broken: Vec<Option<u64>>,
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
    /// Of each of `columns` their numbers, to six digits of how far these spread.
    pub values: Vec<Vec<Option<f64>>>,
}

/// Times that may be never, which JSON has no number for.
mod never {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub fn serialize<S: Serializer>(time: &f64, to: S) -> Result<S::Ok, S::Error> {
        Some(*time).filter(|time| time.is_finite()).serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
        Ok(Option::deserialize(from)?.unwrap_or(f64::INFINITY))
    }

    /// Of the ends of an interval those that there are.
    pub mod end {
        use serde::{Deserializer, Serializer};

        pub fn serialize<S: Serializer>(time: &Option<f64>, to: S) -> Result<S::Ok, S::Error> {
            super::serialize(&time.unwrap_or(f64::INFINITY), to)
        }

        pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
            super::deserialize(from).map(Some)
        }
    }
}
