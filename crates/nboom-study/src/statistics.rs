//! Statistics of a table of cases, from its rows, each seen once.
//!
//! Counts, means, deviations and extremes are of all rows. Percentiles, histograms, rank correlations and
//! curves need values at hand. They are of all rows as long as these fit; of a larger table they are of the rows
//! of a random share of draws, chosen by their seeds: every second draw of a grid or of a Sobol sequence would
//! be no fair share. Statistics of results are of cases that ran, those of variables of all cases: what was drawn
//! includes what makes no scene. Those of faults stand apart from those without.

mod compliance;
mod confidence;
mod extremes;
mod histogram;
mod latch;
mod meaning;
mod moments;
mod older;
mod percentile;
mod rank;
mod sample;
mod summary;

use nboom_tables::Cell;

use crate::Requirement;
use crate::row::{Outcome, Status};
use crate::wanted::Wanted;
use compliance::{Met, Required};
use extremes::Extremes;
pub use meaning::Meaning;
use moments::Moments;
use rank::Ranked;
use sample::Sample;
pub use summary::{
    Compliance, Counts, Driver, Extreme, Histogram, Latch, LatchTime, Percentile, Points,
    Proportion, Spread, Summary, SummaryColumn, Trouble, Worse,
};

/// Larger numbers count as gaps, so that squares and sums are finite.
const LARGEST: f64 = 1e150;

/// Cases that did not run and are listed one by one.
const MOST_TROUBLES: usize = 100;

/// A column of a table of cases.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// The name of the column.
    pub name: String,
    /// What people call it: of a result its text, else the name.
    pub label: String,
    /// What its numbers mean.
    pub description: String,
    /// The unit of its numbers.
    pub unit: Option<String>,
    /// What it is for.
    pub role: Role,
    /// What it is, if it is a result.
    pub meaning: Meaning,
}

impl Field {
    /// A column that people call `label`, by which a result is known, without a description.
    pub fn new(name: &str, label: &str, unit: Option<String>, role: Role) -> Self {
        let meaning =
            if role == Role::Result { Wanted::meaning(label) } else { Meaning::default() };
        let (name, label) = (name.to_owned(), label.to_owned());
        Self { name, label, description: String::new(), unit, role, meaning }
    }
}

/// What a column of a table of cases is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The number of the case.
    Case,
    /// The seed, which cases of the same draw share.
    Seed,
    /// The name of the fault; empty where there is none.
    Fault,
    /// A number that is drawn.
    Variable,
    /// A number of the run; empty where there is none.
    Result,
    /// `ok`, perhaps with what is wrong with the run, or why there is none.
    Status,
}

/// Statistics of the rows seen so far.
#[derive(Clone, Debug)]
pub struct Statistics {
    fields: Vec<Field>,
    /// Where variables and results stand in a row.
    places: Vec<usize>,
    counts: Counts,
    troubles: Vec<Trouble>,
    /// Cases without fault, then those of each fault.
    groups: Vec<Group>,
    /// Of each variable and result.
    extremes: Vec<Extremes>,
    required: Vec<Required>,
    sample: Sample,
    /// The relative tolerance of the runs.
    rtol: f64,
}

/// Cases with the same fault.
#[derive(Clone, Debug)]
struct Group {
    fault: String,
    cases: u64,
    /// Those of them that ran.
    ran: u64,
    /// Of each variable and result.
    moments: Vec<Moments>,
    met: Met,
}

/// What a row says beside its numbers.
struct Head<'a> {
    case: u64,
    seed: u64,
    fault: &'a str,
    status: &'a str,
}

impl Statistics {
    /// Statistics of no rows yet, of a table with these columns, of whose results this is required.
    /// Requirements of results that the table does not have are left out.
    pub fn new(fields: Vec<Field>, requirements: &[Requirement]) -> Self {
        let is_number = |field: &Field| matches!(field.role, Role::Variable | Role::Result);
        let places: Vec<usize> = (0..fields.len()).filter(|i| is_number(&fields[*i])).collect();
        let columns = places.len();
        let required = |requirement: &Requirement| {
            let is_of = |&place: &usize| {
                let Field { role, label, .. } = &fields[place];
                *role == Role::Result && *label == requirement.result
            };
            let column = places.iter().position(is_of)?;
            Some(Required { requirement: requirement.clone(), column })
        };
        let required: Vec<_> = requirements.iter().filter_map(required).collect();
        Self {
            fields,
            places,
            counts: Counts::default(),
            troubles: Vec::new(),
            groups: vec![Group::new("", columns, required.len())],
            required,
            extremes: vec![Extremes::default(); columns],
            sample: Sample::new(columns),
            rtol: 0.0,
        }
    }

    /// The same of results of runs with this relative tolerance, whose errors are no differences.
    pub fn of_runs_within(self, rtol: f64) -> Self {
        Self { rtol, ..self }
    }

    /// Takes a row, a cell for each column.
    pub fn row(&mut self, cells: &[Cell<'_>]) {
        let head = self.head(cells);
        let group = self.group(head.fault);
        let ran = self.count(&head, group);
        let told = |column: usize| match ran || self.field(column).role == Role::Variable {
            true => number(cells.get(self.places[column])),
            false => f64::NAN,
        };
        let numbers: Vec<f64> = (0..self.places.len()).map(told).collect();
        for (column, value) in numbers.iter().enumerate() {
            let extreme = Extreme { case: head.case, fault: group, value: *value };
            if !value.is_nan() {
                self.groups[group].moments[column].add(*value);
                self.extremes[column].add(extreme);
            } else if ran && self.lock(column).is_some() {
                self.extremes[column].add_never(extreme);
            }
        }
        if ran {
            self.groups[group].met.add(head.case, &numbers, &self.required);
        }
        self.sample.offer(head.case, head.seed, (group, ran), &numbers);
    }

    /// Counts a case, and says whether it ran.
    fn count(&mut self, head: &Head<'_>, group: usize) -> bool {
        let status = Status::parse(head.status);
        // An unknown text does not say that the case ran.
        let outcome = status.as_ref().map_or(Outcome::Failed, Status::outcome);
        let counts = &mut self.counts;
        let of_outcome = match outcome {
            Outcome::Ok => &mut counts.ok,
            Outcome::Rejected => &mut counts.rejected,
            Outcome::Failed => &mut counts.failed,
        };
        *of_outcome += 1;
        counts.cases += 1;
        self.groups[group].cases += 1;
        if outcome != Outcome::Ok {
            if self.troubles.len() < MOST_TROUBLES {
                let status = head.status.to_owned();
                self.troubles.push(Trouble { case: head.case, fault: group, status });
            }
            return false;
        }
        self.groups[group].ran += 1;
        let flagged = match status {
            Some(Status::Runaway) => Some((&mut counts.runaway, &mut counts.first_runaway)),
            Some(Status::Poor) => Some((&mut counts.poor, &mut counts.first_poor)),
            Some(Status::Doubtful) => Some((&mut counts.doubtful, &mut counts.first_doubtful)),
            _ => None,
        };
        if let Some((count, first)) = flagged {
            *count += 1;
            first.get_or_insert(head.case);
        }
        true
    }

    /// What the rows say.
    pub fn finish(self) -> Summary {
        let variables: Vec<usize> =
            (0..self.places.len()).filter(|i| self.field(*i).role == Role::Variable).collect();
        let bare = self.sample.rows_that_ran(0);
        let ranked = |column: usize| {
            let values = self.sample.column(column);
            let ranked = match self.lock(column) {
                Some(_) => Ranked::with_none_last(values, &bare),
                None => Ranked::new(values, &bare),
            };
            let is_constant = self.is_constant(column, &self.sample.sorted(column, 0));
            match self.field(column).role {
                _ if is_constant => ranked.tied(),
                Role::Result => ranked.rounded(),
                _ => ranked,
            }
        };
        let causes: Vec<_> = variables.iter().map(|column| (*column, ranked(*column))).collect();
        let columns = (0..self.places.len()).map(|column| {
            let is_result = self.field(column).role == Role::Result;
            let drivers = if is_result { rank::drivers(&causes, &ranked(column)) } else { vec![] };
            self.column(column, drivers)
        });
        Summary {
            columns: columns.collect(),
            latches: self.latches(),
            requirements: self.compliance(),
            meet_all: self.meet_all(),
            counts: self.counts,
            held: self.sample.len() as u64,
            share: self.sample.share(),
            faults: self.groups[1..].iter().map(|group| group.fault.clone()).collect(),
            points: self.sample.points(),
            troubles: self.troubles,
        }
    }

    fn head<'a>(&self, cells: &[Cell<'a>]) -> Head<'a> {
        let (case, status) = (self.counts.cases + 1, Status::Ok.name());
        let mut head = Head { case, seed: 0, fault: "", status };
        let mut seed = None;
        for (field, cell) in self.fields.iter().zip(cells) {
            match (field.role, *cell) {
                (Role::Case, Cell::Integer(case)) => head.case = case.unsigned_abs(),
                (Role::Seed, Cell::Integer(found)) => seed = Some(found.unsigned_abs()),
                (Role::Fault, Cell::Text(fault)) => head.fault = fault,
                (Role::Status, Cell::Text(status)) => head.status = status,
                _ => {}
            }
        }
        head.seed = seed.unwrap_or(head.case);
        head
    }

    /// The number of the fault's group, which is made if it is new.
    fn group(&mut self, fault: &str) -> usize {
        self.groups.iter().position(|group| group.fault == fault).unwrap_or_else(|| {
            self.groups.push(Group::new(fault, self.places.len(), self.required.len()));
            self.groups.len() - 1
        })
    }

    fn field(&self, column: usize) -> &Field {
        &self.fields[self.places[column]]
    }

    /// The hinge of whose lock-ups a column has the times.
    fn lock(&self, column: usize) -> Option<&str> {
        self.field(column).meaning.hinge_that_locks()
    }

    /// Whether these ascending numbers of a column are one; those of results have errors of runs.
    fn is_constant(&self, column: usize, sorted: &[f64]) -> bool {
        let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) else { return true };
        let is_result = self.field(column).role == Role::Result;
        low == high || (is_result && summary::are_errors_of_runs(low, high, self.rtol))
    }

    fn column(&self, column: usize, drivers: Vec<Driver>) -> SummaryColumn {
        let field = self.field(column);
        let (mut histogram, mut is_constant) = (None, true);
        let spreads = self.groups.iter().enumerate().map(|(number, group)| {
            let mut sorted = self.sample.sorted(column, number);
            if number == 0 {
                is_constant = self.is_constant(column, &sorted);
                histogram = histogram::histogram(&sorted, is_constant);
            }
            if self.lock(column).is_some() {
                sorted.resize(self.sample.rows_that_ran(number).len(), f64::INFINITY);
            }
            let moments = &group.moments[column];
            Spread {
                cases: if field.role == Role::Result { group.ran } else { group.cases },
                count: moments.count(),
                mean: moments.mean(),
                deviation: moments.deviation(),
                percentiles: percentile::percentiles(&sorted),
            }
        });
        SummaryColumn {
            spreads: spreads.collect(),
            name: field.name.clone(),
            label: field.label.clone(),
            meaning: field.meaning.clone(),
            description: field.description.clone(),
            unit: field.unit.clone(),
            is_result: field.role == Role::Result,
            worse_by_requirement: self.worse_by_requirement(column),
            is_constant,
            histogram,
            drivers,
            smallest: self.extremes[column].smallest().to_vec(),
            largest: self.extremes[column].largest().to_vec(),
        }
    }

    fn latches(&self) -> Vec<Latch> {
        let bare = self.sample.rows_that_ran(0).len();
        let latch = |column: usize| {
            let hinge = self.lock(column)?.to_owned();
            let by_end =
                |group: &Group| confidence::proportion(group.moments[column].count(), group.ran);
            Some(Latch {
                hinge,
                unit: self.field(column).unit.clone(),
                times: latch::times(&self.sample.sorted(column, 0), bare),
                by_end: self.groups.iter().map(by_end).collect(),
            })
        };
        (0..self.places.len()).filter_map(latch).collect()
    }

    fn worse_by_requirement(&self, column: usize) -> Option<Worse> {
        self.required.iter().find(|of| of.column == column)?.worse()
    }

    fn compliance(&self) -> Vec<Compliance> {
        let groups = || self.groups.iter().map(|group| (&group.met, group.ran));
        let of = |(number, required): (usize, &Required)| required.compliance(number, groups());
        self.required.iter().enumerate().map(of).collect()
    }

    fn meet_all(&self) -> Vec<Proportion> {
        let groups = self.groups.iter().filter(|_| !self.required.is_empty());
        groups.map(|group| group.met.all(group.ran)).collect()
    }
}

impl Group {
    fn new(fault: &str, columns: usize, requirements: usize) -> Self {
        let moments = vec![Moments::default(); columns];
        Self { fault: fault.to_owned(), cases: 0, ran: 0, moments, met: Met::new(requirements) }
    }
}

/// The number in a cell; NaN where there is none.
fn number(cell: Option<&Cell<'_>>) -> f64 {
    let value = match cell {
        Some(Cell::Number(value)) => *value,
        Some(Cell::Integer(value)) => *value as f64,
        _ => f64::NAN,
    };
    if value.abs() <= LARGEST { value } else { f64::NAN }
}
