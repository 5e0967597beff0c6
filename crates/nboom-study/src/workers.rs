//! Threads that run cases, and the one that writes their rows to the journal.

use std::any::Any;
use std::collections::VecDeque;
use std::ops::RangeInclusive;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, SyncSender};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::cases::Cases;
use crate::frame::{Batch, Columns};
use crate::journal::Journal;
use crate::{Row, StudyError, Watcher};

/// Runs cases until there are no more.
pub(crate) type Worker<'a> = Box<dyn FnMut(&Cases<'_>) + 'a>;

/// How long a batch takes, unless there are many threads.
const BATCH: Duration = Duration::from_millis(250);

/// The least time from batch to batch of all threads, each of which waits for the disk.
const INTERVAL: Duration = Duration::from_millis(25);

/// The most cases of a batch.
const MOST_CASES: u64 = 10_000;

/// The text after which a batch ends \[bytes\].
const MOST_BYTES: usize = 1 << 23;

/// How missing cases are run.
pub(crate) struct Crew<'a, 'w> {
    /// Of the rows.
    pub columns: Columns<'a>,
    /// Makes what runs cases in one thread.
    pub worker: &'a (dyn Fn() -> Worker<'w> + Sync),
    /// Threads.
    pub jobs: usize,
    /// Who waits.
    pub watcher: &'a dyn Watcher,
}

/// Cases that nobody has taken.
struct Queue {
    ranges: Mutex<VecDeque<RangeInclusive<u64>>>,
    jobs: u64,
}

impl Queue {
    /// Takes consecutive cases: so many, or fewer towards the end, so that all threads end together.
    fn take(&self, most: u64) -> Option<RangeInclusive<u64>> {
        let mut ranges = self.ranges.lock().unwrap_or_else(PoisonError::into_inner);
        let left: u64 = ranges.iter().map(count).sum();
        let range = ranges.pop_front()?;
        let share = most.min(left.div_ceil(self.jobs)).min(count(&range));
        let (first, last) = (*range.start(), range.start() + share - 1);
        if last < *range.end() {
            ranges.push_front(last + 1..=*range.end());
        }
        Some(first..=last)
    }
}

impl Crew<'_, '_> {
    /// Runs the cases that a journal lacks, or some of them if it is interrupted.
    ///
    /// # Errors
    /// When the journal cannot be written, when a thread cannot be started, and when a case panics. What was
    /// written stays.
    pub fn fill(&self, journal: &mut Journal, total: u64) -> Result<(), StudyError> {
        let missing = journal.missing();
        let done = total - missing.iter().map(count).sum::<u64>();
        self.watcher.progress(done, total);
        let jobs = self.jobs.max(1);
        let queue = Queue { ranges: Mutex::new(missing.into()), jobs: jobs as u64 };
        let stop = AtomicBool::new(false);
        let (sender, batches) = mpsc::sync_channel(jobs);
        let gate = Mutex::new(());
        thread::scope(|scope| {
            let mut threads = Vec::new();
            let mut all_started = Ok(());
            // Nothing is begun before all threads are there, which takes the memory that they need.
            let closed = gate.lock();
            for number in 1..=jobs {
                let (sender, thread) = (sender.clone(), thread::Builder::new());
                let work = || {
                    drop(gate.lock());
                    self.work(&queue, &stop, sender)
                };
                match thread.spawn_scoped(scope, work) {
                    Ok(thread) => threads.push(thread),
                    Err(source) => {
                        stop.store(true, Ordering::Relaxed);
                        all_started = Err(StudyError::Threads { number, jobs, source });
                        break;
                    }
                }
            }
            drop((sender, closed));
            let written = self.write(journal, batches, done, total);
            stop.store(true, Ordering::Relaxed);
            let join = |thread: thread::ScopedJoinHandle<'_, _>| match thread.join() {
                Ok(worked) => worked,
                Err(panic) => std::panic::resume_unwind(panic),
            };
            let worked = threads.into_iter().map(join).fold(Ok(()), Result::and);
            all_started.and(written).and(worked)
        })
    }

    /// Writes batches as they come, until all threads have ended.
    fn write(
        &self,
        journal: &mut Journal,
        batches: Receiver<Batch>,
        mut done: u64,
        total: u64,
    ) -> Result<(), StudyError> {
        let mut journal = journal.writer()?;
        for batch in batches {
            journal.append(&batch.frame(), batch.range())?;
            done += batch.cases;
            self.watcher.progress(done, total);
        }
        Ok(())
    }

    /// Runs cases until there are no more, or something stops all threads.
    fn work(
        &self,
        queue: &Queue,
        stop: &AtomicBool,
        sender: SyncSender<Batch>,
    ) -> Result<(), StudyError> {
        let time = BATCH.max(INTERVAL * u32::try_from(self.jobs).unwrap_or(u32::MAX));
        let interrupted = || stop.load(Ordering::Relaxed) || self.watcher.interrupted();
        if stop.load(Ordering::Relaxed) {
            return Ok(());
        }
        let mut worker = (self.worker)();
        let mut size = 1;
        while let Some(range) = queue.take(size) {
            let (began, cases) = (Instant::now(), count(&range));
            if !self.run(range, &mut worker, &interrupted, &sender).inspect_err(|_| {
                stop.store(true, Ordering::Relaxed);
            })? {
                break;
            }
            size = fitting(time, began.elapsed(), cases);
        }
        Ok(())
    }

    /// Runs consecutive cases and hands on their rows; false if it was interrupted, or nobody takes them.
    fn run(
        &self,
        range: RangeInclusive<u64>,
        worker: &mut Worker<'_>,
        interrupted: &dyn Fn() -> bool,
        sender: &SyncSender<Batch>,
    ) -> Result<bool, StudyError> {
        let mut batch = Batch::from_case(*range.start());
        let hand_on = |batch: Batch| batch.cases == 0 || sender.send(batch).is_ok();
        let mut take = |row: Row| {
            batch.push(&row, &self.columns);
            if batch.bytes() < MOST_BYTES {
                return true;
            }
            let next = Batch::from_case(batch.range().end() + 1);
            hand_on(std::mem::replace(&mut batch, next))
        };
        let cases = Cases::new(range, interrupted, &mut take);
        let ran = catch_unwind(AssertUnwindSafe(|| worker(&cases)));
        let (case, are_done) = (cases.present(), cases.are_done());
        let is_taken = hand_on(batch);
        match ran {
            Ok(()) => Ok(is_taken && are_done),
            Err(panic) => Err(StudyError::Panic { case, found: told(panic.as_ref()) }),
        }
    }
}

/// How many cases take so long, if so many took so long.
fn fitting(time: Duration, elapsed: Duration, cases: u64) -> u64 {
    let most = u128::from(cases) * time.as_nanos() / elapsed.as_nanos().max(1);
    u64::try_from(most).unwrap_or(MOST_CASES).clamp(1, MOST_CASES)
}

fn count(range: &RangeInclusive<u64>) -> u64 {
    range.end() - range.start() + 1
}

/// What a panic says.
fn told(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("it does not say why").to_owned()
}
