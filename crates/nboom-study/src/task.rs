//! A sweep from its directory to its tables, whatever runs its cases.

use std::path::{Path, PathBuf};

use crate::description::Description;
use crate::directory::{self, CASES_CSV_FILE, JOURNAL_FILE, Place, STATISTICS_FILE, State};
use crate::journal::Journal;
use crate::tables;
use crate::workers::{Crew, Worker};
use crate::{Selected, StudyError, Watcher, growth, space};

/// A sweep to be made.
pub(crate) struct Task<'a> {
    /// Where its files are.
    pub directory: &'a Path,
    /// What it is, not complete.
    pub description: Description,
    /// Its study.
    pub study: &'a str,
    /// Its scene, which stands alone.
    pub scene: &'a str,
    /// About how many rows a trajectory has.
    pub samples: u64,
    /// Threads in which cases run; none if they run elsewhere.
    pub jobs: usize,
    /// Whether what was begun is continued.
    pub resume: bool,
    /// Whether another program or machine may continue it.
    pub accept_difference: bool,
}

/// What a sweep came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// How it ended.
    pub end: End,
    /// What it is; with counts if it is complete.
    pub description: Description,
    /// Cases that are done.
    pub done: u64,
    /// Cases that were run now.
    pub computed: u64,
    /// The files that are there.
    pub files: Vec<PathBuf>,
    /// Which code computed the first of the cases that were run now and came to their ends, if the study asks for a
    /// formulation; none of cases that run elsewhere.
    pub selected: Option<Selected>,
}

/// How a sweep ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// All cases are done.
    Complete,
    /// All cases had been done before.
    WasComplete,
    /// It was interrupted and can be continued.
    Interrupted,
}

/// What became of a task that was begun.
#[derive(Debug)]
pub(crate) enum Begin {
    /// All cases had been done before.
    Complete(Box<Report>),
    /// Cases are missing.
    Open(Box<Begun>),
}

/// A sweep whose directory is taken.
#[derive(Debug)]
pub(crate) struct Begun {
    pub place: Place,
    /// What it is, not complete.
    pub what: Description,
    /// The cases that are done.
    pub journal: Journal,
    /// How many were done before.
    before: u64,
    /// The study and the scene.
    texts: [String; 2],
}

impl Begun {
    /// Makes the tables if all cases are done, and says what the sweep came to.
    ///
    /// # Errors
    /// When a file cannot be written, and when the journal cannot be read.
    pub fn finish(self) -> Result<Report, StudyError> {
        let Self { place, what, journal, before, texts: [study, scene] } = self;
        let done = journal.done();
        let report = if done < what.share() {
            let files = place.files();
            let (end, description) = (End::Interrupted, what);
            Report { end, description, done, computed: 0, files, selected: None }
        } else {
            finish(&place, what, &[journal], [&study, &scene])?
        };
        Ok(Report { computed: done - before, ..report })
    }
}

impl Task<'_> {
    /// Makes the sweep or continues it, in threads each with a worker of its own.
    ///
    /// # Errors
    /// When the directory is refused, and when it could not be finished. What is done stays, and can be
    /// continued.
    pub fn run<'w>(
        &self,
        worker: &(dyn Fn() -> Worker<'w> + Sync),
        watcher: &dyn Watcher,
    ) -> Result<Report, StudyError> {
        let mut begun = match self.begin()? {
            Begin::Complete(report) => return Ok(*report),
            Begin::Open(begun) => begun,
        };
        let Begun { what, journal, .. } = &mut *begun;
        Crew { columns: what.columns_of_tables(), worker, jobs: self.jobs, watcher }
            .fill(journal, what.share())?;
        begun.finish()
    }

    /// Takes the directory for a sweep whose cases are still to be run, some of them or all.
    ///
    /// # Errors
    /// When the directory is refused.
    pub fn begin(&self) -> Result<Begin, StudyError> {
        let place = Place::take(self.directory)?;
        // A sweep that goes on or grows keeps the tables that it has and those that it was to have.
        let was_to_have = place.found.as_ref().is_some_and(|found| found.csv);
        let csv = self.description.csv || was_to_have || place.file(CASES_CSV_FILE).exists();
        let now = Description { csv, ..self.description.clone() };
        let state = place.state(&now, self.accept_difference);
        let what = match state.map_err(|error| place.explained(error, [self.study, self.scene]))? {
            State::Complete(what) => {
                return Ok(Begin::Complete(settle(&place, what, csv)?.into()));
            }
            State::Open(what) => {
                let vary_together = now.vary_together.clone();
                Description { csv, rtol: now.rtol, vary_together, ..what }
            }
            State::Fewer(then) if self.resume => {
                self.require_growth(&then, &now)?;
                growth::continued(&place, then, &now)?
            }
            State::Fewer(then) => {
                let (directory, draws) = (self.directory.to_owned(), then.draws);
                return Err(StudyError::FewerDraws { directory, draws });
            }
        };
        let journal = directory::journal(self.directory, &what)?;
        let (before, cases) = (journal.done(), what.share());
        if place.found.is_some() && !self.resume {
            let directory = self.directory.to_owned();
            return Err(StudyError::Unfinished { directory, done: before, cases });
        }
        let missing = cases - before;
        let jobs = self.jobs as u64;
        space::require_memory(&what.columns_of_tables(), self.samples, missing, jobs)?;
        space::require(self.directory, self.bytes(&what, missing), cases)?;
        let texts = [self.study, self.scene].map(str::to_owned);
        place.begin(&what, self.study, self.scene)?;
        let begun = Begun { place, what, journal, before, texts };
        Ok(Begin::Open(begun.into()))
    }

    /// # Errors
    /// When memory or the disk is too small for the draws that come to those of a sweep.
    fn require_growth(&self, then: &Description, now: &Description) -> Result<(), StudyError> {
        let (cases, columns) = (now.cases, now.columns_of_tables());
        let (more, jobs) = (cases - then.cases, self.jobs as u64);
        space::require_memory(&columns, self.samples, more, jobs)?;
        // The cases of a finished sweep are written once more.
        let missing = if then.complete { cases } else { more };
        space::require(self.directory, self.bytes(now, missing), cases)
    }

    /// About how much is still to be written, if so many cases are missing.
    fn bytes(&self, what: &Description, missing: u64) -> u64 {
        let formats = if what.shard.is_some() { 0 } else { tables::formats(what.csv) };
        let rows = missing.saturating_add(formats.saturating_mul(what.cases));
        rows.saturating_mul(space::of_case(&what.columns_of_tables(), self.samples))
    }
}

/// Makes the tables of journals that together have all cases, says that the sweep is complete, and removes its
/// journal. A shard keeps its journal and has no tables.
///
/// After each of these steps a resume does the others.
///
/// # Errors
/// When a file cannot be written, and when a journal cannot be read.
pub(crate) fn finish(
    place: &Place,
    what: Description,
    journals: &[Journal],
    [study, scene]: [&str; 2],
) -> Result<Report, StudyError> {
    let (csv, statistics) = (what.csv, tables::statistics(&what, journals)?);
    let counts = Some(statistics.counts);
    let mut what = Description { complete: true, csv: false, counts, ..what };
    if what.shard.is_none() {
        let texts = [("study", study), ("scene", scene)];
        tables::write_tables(place, what.columns_of_tables(), journals, &texts, csv)?;
        tables::describe(place, tables::TWINS.as_flattened(), &mut what)?;
        place.sum_up(&statistics)?;
    }
    place.describe(&what)?;
    Ok(Report { end: End::Complete, ..settle(place, what, csv)? })
}

/// What a complete sweep came to, without the journal that it does not need and with the tables in CSV that are
/// asked for.
///
/// # Errors
/// When one of its files is not there or is not as long as it was, and when a table cannot be written.
pub(crate) fn settle(
    place: &Place,
    mut what: Description,
    csv: bool,
) -> Result<Report, StudyError> {
    if what.shard.is_none() {
        place.require([STATISTICS_FILE])?;
        tables::require(place, &what.tables)?;
        if csv && tables::add_csv(place, &mut what)? {
            place.describe(&what)?;
        }
        place.remove(JOURNAL_FILE)?;
    } else {
        place.require([JOURNAL_FILE])?;
    }
    let (done, files) = (what.share(), place.files());
    let (end, description) = (End::WasComplete, what);
    Ok(Report { end, description, done, computed: 0, files, selected: None })
}

#[cfg(test)]
mod tests;
