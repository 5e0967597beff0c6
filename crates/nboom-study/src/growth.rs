//! More draws for a sweep: the cases that it has are the first of more.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

use nboom_tables::{Column, TablesError, read_table};

use crate::directory::{JOURNAL_FILE, PAGE_FILE, Place, STATISTICS_FILE, STUDY_FILE};
use crate::frame::{Batch, case_of, line};
use crate::journal::{Journal, Part};
use crate::{Description, Method, StudyError, tables};

/// Methods whose first draws are the same, however many there are.
const GROWING: [Method; 2] = [Method::MonteCarlo, Method::Sobol];

/// How long the rows of a frame are, but for those of its last case \[bytes\].
const FRAME: usize = 1 << 20;

/// Rows of trajectories that wait for their cases.
const WAITING: usize = 64;

impl Description {
    /// Whether this is another sweep with more draws, so that all of the other one's cases are its first ones.
    pub(crate) fn continues(&self, then: &Self) -> bool {
        let is_of_draws = |what: &str| ["study", "draws", "cases"].contains(&what);
        GROWING.iter().any(|method| method.name() == self.method)
            && self.draws > then.draws
            && self.shard.is_none()
            && self.study_but_draws.is_some()
            && self.study_but_draws == then.study_but_draws
            && then.compared(self).all(|(what, _, _)| is_of_draws(what))
    }
}

/// Leaves the directory of a sweep as if `now`, which continues it, had been begun there and had come as far.
///
/// Whenever it is killed, what is there is one of the two sweeps, and can be continued.
///
/// # Errors
/// When a table of a finished sweep is not what it wrote, and when a file cannot be read or written.
pub(crate) fn continued(
    place: &Place,
    then: Description,
    now: &Description,
) -> Result<Description, StudyError> {
    let (csv, tables, sums) = (now.csv, BTreeMap::new(), BTreeMap::new());
    let open = Description { complete: false, csv, tables, sums, counts: None, ..then.clone() };
    if then.complete {
        tables::require_unchanged(place, &then)?;
        // One that is there is of a process that was killed here.
        place.remove(JOURNAL_FILE)?;
        write_journal(place, &then)?;
    }
    place.describe(&open)?;
    // Those of fewer draws; beside a description of more draws the study would be another one.
    let tables = tables::TWINS.as_flattened().iter().copied();
    tables
        .chain([STATISTICS_FILE, PAGE_FILE, STUDY_FILE])
        .try_for_each(|name| place.remove(name))?;
    let Description { study, draws, cases, rtol, vary_together, .. } = now.clone();
    Ok(Description { study, draws, cases, rtol, vary_together, ..open.also_by(now) })
}

/// Writes a journal of all cases from the tables of a finished sweep.
fn write_journal(place: &Place, what: &Description) -> Result<(), StudyError> {
    let columns = what.columns_of_tables();
    let mut journal = Journal::read(&place.file(JOURNAL_FILE), what.range())?;
    let mut journal = journal.writer()?;
    thread::scope(|scope| {
        let (send, receive) = sync_channel(WAITING);
        let of_states = (!columns.states.is_empty()).then(|| {
            let path = tables::path(place.path(), Part::States);
            scope.spawn(move || send_states(&path, columns.states, &send))
        });
        let mut states = States { waiting: None, receive };
        let mut batch = Batch::from_case(1);
        let path = tables::path(place.path(), Part::Case);
        let altered = |found: String, expected: &str| {
            let (path, expected) = (path.clone(), expected.to_owned());
            StudyError::Altered { path, found, expected }
        };
        read_table(&path, columns.cases, |cells| -> Result<(), StudyError> {
            let (case, due) = (case_of(cells), batch.first + batch.cases);
            if case != due {
                return Err(altered(format!("case {case}"), &format!("case {due}")));
            }
            let states = states.of_case(case);
            let states = states.ok_or_else(|| altered(format!("case {case}"), OTHER_STATES))?;
            batch.push_cells(cells, states);
            if batch.bytes() >= FRAME {
                journal.append(&batch.frame(), batch.range())?;
                batch = Batch::from_case(batch.range().end() + 1);
            }
            Ok(())
        })?;
        if batch.cases > 0 {
            journal.append(&batch.frame(), batch.range())?;
        }
        let (done, is_all) = (batch.first + batch.cases - 1, states.next().is_none());
        // Nobody takes what is left.
        drop(states);
        match of_states.map(|thread| thread.join().expect("it does not panic")) {
            Some(Err(Unsent::Unreadable(error))) => Err(error.into()),
            _ if done != what.cases => {
                Err(altered(format!("{done} cases"), &format!("{} cases", what.cases)))
            }
            _ if !is_all => Err(altered(format!("{done} cases"), OTHER_STATES)),
            _ => Ok(()),
        }
    })
}

/// What a table of cases is not that a table of trajectories is beside.
const OTHER_STATES: &str = "the cases of the table of trajectories";

/// Why not all rows of trajectories were sent.
enum Unsent {
    Unreadable(TablesError),
    /// Nobody waits for them.
    Unwanted,
}

impl From<TablesError> for Unsent {
    fn from(error: TablesError) -> Self {
        Self::Unreadable(error)
    }
}

/// Sends the rows of a table of trajectories as lines, each with its case.
fn send_states(
    path: &Path,
    columns: &[Column],
    to: &SyncSender<(u64, Vec<u8>)>,
) -> Result<(), Unsent> {
    read_table(path, columns, |cells| {
        let mut text = Vec::new();
        line(&mut text, cells.iter().copied());
        to.send((case_of(cells), text)).map_err(|_| Unsent::Unwanted)
    })
}

/// Rows of trajectories in order of cases.
struct States {
    /// The first of a case that has not come yet.
    waiting: Option<(u64, Vec<u8>)>,
    receive: Receiver<(u64, Vec<u8>)>,
}

impl States {
    /// The rows of a case, which comes after all that were asked for; none if there are rows of an earlier one.
    fn of_case(&mut self, case: u64) -> Option<Vec<u8>> {
        let mut rows = Vec::new();
        while let Some((of, row)) = self.next() {
            match of.cmp(&case) {
                Ordering::Less => return None,
                Ordering::Equal => rows.extend(row),
                Ordering::Greater => {
                    self.waiting = Some((of, row));
                    break;
                }
            }
        }
        Some(rows)
    }

    /// The next row with its case, if there is one.
    fn next(&mut self) -> Option<(u64, Vec<u8>)> {
        self.waiting.take().or_else(|| self.receive.recv().ok())
    }
}
