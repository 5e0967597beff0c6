//! A sweep whose cases run elsewhere, in batches that come back in any order.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use nboom_results::Maker;
use nboom_scalar::{Batch as Lanes, Kernel};

use crate::cases::Cases;
use crate::description::Description;
use crate::directory::require_made_here;
use crate::frame::{Batch, Columns, Head};
use crate::selected::FirstSelected;
use crate::task::{Begin, Report};
use crate::{Row, Study, StudyError, columns, trajectory_columns};

/// The directory of a sweep that waits for batches of cases from elsewhere, see [`Study::run_batch`].
///
/// It ends with the bytes of a sweep in one process. What was added is not lost, whatever ends the program.
#[derive(Debug)]
pub struct Gathering {
    directory: PathBuf,
    begin: Begin,
    accept_difference: bool,
}

impl Gathering {
    pub(crate) fn new(begin: Begin, directory: &Path, accept_difference: bool) -> Self {
        Self { directory: directory.to_owned(), begin, accept_difference }
    }

    /// The cases that are not there, in order.
    pub fn missing(&self) -> Vec<RangeInclusive<u64>> {
        match &self.begin {
            Begin::Complete(_) => Vec::new(),
            Begin::Open(begun) => begun.journal.missing(),
        }
    }

    /// How many cases are there, and how many there are in all.
    pub fn done(&self) -> [u64; 2] {
        match &self.begin {
            Begin::Complete(report) => [report.done; 2],
            Begin::Open(begun) => [begun.journal.done(), begun.what.share()],
        }
    }

    /// Adds a batch that a program on a machine has run, and waits for the disk. A batch that is there
    /// already is left out.
    ///
    /// # Errors
    /// When it is no whole batch of missing cases, when it is of another program or instruction set and that is not
    /// accepted, and when it cannot be written.
    pub fn add(&mut self, batch: &[u8], by: &Maker) -> Result<(), StudyError> {
        let Begin::Open(begun) = &mut self.begin else { return Ok(()) };
        let wrong = |found: String| StudyError::NoBatch { found };
        let head = Head::of_whole(batch);
        let head = head.ok_or_else(|| wrong(format!("{} damaged bytes", batch.len())))?;
        let range = begun.what.range();
        if !range.contains(&head.first) || !range.contains(&head.last) {
            let [first, last] = [range.start(), range.end()];
            let found =
                format!("cases {} to {} of a sweep of {first} to {last}", head.first, head.last);
            return Err(wrong(found));
        }
        let missing = begun.journal.missing();
        let has_some = |missing: &RangeInclusive<u64>| {
            *missing.start() <= head.last && head.first <= *missing.end()
        };
        let has_all = |missing: &RangeInclusive<u64>| {
            missing.contains(&head.first) && missing.contains(&head.last)
        };
        if !missing.iter().any(has_some) {
            return Ok(());
        }
        if !missing.iter().any(has_all) {
            let Head { first, last, .. } = head;
            return Err(wrong(format!("cases {first} to {last}, of which some are there already")));
        }
        let also =
            Description { made_by: by.clone(), also_made_by: Vec::new(), ..begun.what.clone() };
        require_made_here(&self.directory, &begun.what, &also, self.accept_difference)?;
        let what = begun.what.clone().also_by(&also);
        if what != begun.what {
            begun.place.describe(&what)?;
            begun.what = what;
        }
        begun.journal.writer()?.append(&[batch], head.first..=head.last)
    }

    /// Makes the tables if all cases are there, and says what the sweep came to.
    ///
    /// # Errors
    /// When a file cannot be written, and when a batch has other rows than the sweep.
    pub fn finish(self) -> Result<Report, StudyError> {
        match self.begin {
            Begin::Complete(report) => Ok(*report),
            Begin::Open(begun) => begun.finish(),
        }
    }
}

impl Study {
    /// Runs consecutive cases, and returns the batch that a [`Gathering`] takes; `None` if it was interrupted.
    pub fn run_batch(
        &self,
        cases: RangeInclusive<u64>,
        kernels: &'static [Kernel],
        right_sides: &'static [Lanes],
        interrupted: &dyn Fn() -> bool,
    ) -> Option<Vec<u8>> {
        let of_cases = columns(self);
        let of_states = if self.trajectories { trajectory_columns(self) } else { Vec::new() };
        let tables = Columns { cases: &of_cases, states: &of_states };
        let mut batch = Batch::from_case(*cases.start());
        let mut take = |row: Row| {
            batch.push(&row, &tables);
            true
        };
        let cases = Cases::new(cases, interrupted, &mut take);
        // A batch is of rows alone.
        self.worker(kernels, right_sides, &FirstSelected::default())(&cases);
        let are_done = cases.are_done();
        are_done.then(|| batch.frame().concat())
    }
}
