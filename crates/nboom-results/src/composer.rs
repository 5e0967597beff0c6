//! Rows of the tables of loads, composed by a thread of its own while the motion goes on.
//!
//! The thread finds stresses, composes text and touches no file, so files are written where and in the order that
//! the run says. It answers block by block, and what it is told last is asked for only when two
//! more blocks are complete: what is in the tables at any time does not depend on how fast it is.
//! Only an entry with a number that may be refused is asked for at once.

use std::io;
use std::mem;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

use nboom_model::HingeLabel;
use nboom_scalar::Wrench;
use nboom_strength::{LatchImpulses, PulsePeaks, StationLoad, Stations};

use crate::row_text::RowText;
use crate::{LATCH_IMPULSES_FILE, STRESS_FILE};

/// Rows of a block, which are worth waking a thread.
const BLOCK: usize = 256;

/// Most blocks that are with the thread.
const AHEAD: usize = 2;

/// Loads and von Mises stresses below this are of numbers that can be written.
const LARGE: f64 = 1e150;

/// Most rows that are held \[bytes\]; more do not wait for peaks.
const MOST_HELD: usize = 1 << 20;

/// What is to be written, in the order of the run.
#[derive(Debug)]
pub(crate) enum Entry {
    /// Loads at an output time; those that wait follow the peaks of the last lock-up or impact.
    Sample { time: f64, waits: bool, stations: Vec<StationLoad>, hinge_loads: Vec<Wrench<f64>> },
    /// Peaks of a lock-up or an impact, now that they are known.
    Peaks(PulsePeaks),
    /// The impulses by which a hinge locks or hits its stop, and when.
    Impulses(f64, LatchImpulses),
    /// No more peaks are to come.
    End,
}

impl Entry {
    fn rows(&self) -> usize {
        let rows = |stations: &[StationLoad], loads: &[_]| 5 * stations.len() + loads.len();
        match self {
            Self::Sample { stations, hinge_loads, .. } => rows(stations, hinge_loads),
            Self::Peaks(peaks) => rows(&peaks.stations, &peaks.hinge_loads),
            Self::Impulses(_, of) => of.hinges.len(),
            Self::End => 0,
        }
    }

    /// Whether it may have a number that cannot be written, or stresses of loads at `all` stations that
    /// cannot.
    pub fn is_doubtful(&self, all: &Stations) -> bool {
        match self {
            Self::Sample { stations, hinge_loads, .. }
            | Self::Peaks(PulsePeaks { stations, hinge_loads, .. }) => {
                let is_bounded = all.bound(stations) < LARGE;
                let of_stations = stations.iter().map(|station| &station.load);
                !is_bounded || of_stations.chain(hinge_loads).any(is_large)
            }
            Self::Impulses(_, of) => of.hinges.iter().any(is_large),
            Self::End => false,
        }
    }
}

fn is_large(load: &Wrench<f64>) -> bool {
    let numbers = [load.force, load.moment].map(|vector| vector.to_array());
    !numbers.iter().flatten().all(|number| number.abs() < LARGE)
}

/// Whole rows of each table.
#[derive(Debug, Default)]
pub(crate) struct Lines {
    pub stresses: Vec<u8>,
    pub hinge_loads: Vec<u8>,
    pub latch_impulses: Vec<u8>,
}

/// What has become of a block: its rows, up to the first number that cannot be written, and the
/// table that this number belongs to.
#[derive(Debug)]
pub(crate) struct Composed {
    pub lines: Lines,
    pub refused: Option<(&'static str, io::Error)>,
}

/// Composes rows, in order.
#[derive(Debug)]
pub(crate) struct Composer {
    hinges: Vec<HingeLabel>,
    stations: Stations,
    text: RowText,
    lines: Lines,
    /// Rows of stresses and of hinge loads after a lock-up or an impact whose peaks are still to come.
    held: [Vec<u8>; 2],
}

impl Composer {
    pub fn new(hinges: Vec<HingeLabel>, stations: Stations, text: RowText) -> Self {
        let held = [Vec::new(), Vec::new()];
        Self { hinges, stations, text, lines: Lines::default(), held }
    }

    fn compose(&mut self, block: &[Entry]) -> Composed {
        let mut entries = block.iter();
        let refused = entries.find_map(|entry| {
            let file =
                if let Entry::Impulses(..) = entry { LATCH_IMPULSES_FILE } else { STRESS_FILE };
            self.add(entry).err().map(|error| (file, error))
        });
        Composed { lines: mem::take(&mut self.lines), refused }
    }

    fn add(&mut self, entry: &Entry) -> io::Result<()> {
        let Self { hinges, stations: all, text, lines, held } = self;
        match entry {
            Entry::Sample { time, waits, stations, hinge_loads } => {
                let [held_stresses, held_loads] = held;
                let (of_stresses, of_loads) = if *waits {
                    (held_stresses, held_loads)
                } else {
                    (&mut lines.stresses, &mut lines.hinge_loads)
                };
                text.set_instant(*time, "")?;
                text.add_stresses(of_stresses, hinges, all.stresses(stations))?;
                text.add_hinge_loads(of_loads, hinge_loads)?;
                if self.held.iter().map(Vec::len).sum::<usize>() > MOST_HELD {
                    self.release();
                }
            }
            Entry::Peaks(PulsePeaks { time, kind, stations, hinge_loads }) => {
                text.set_instant(*time, kind.name())?;
                text.add_stresses(&mut lines.stresses, hinges, all.stresses(stations))?;
                text.add_hinge_loads(&mut lines.hinge_loads, hinge_loads)?;
                self.release();
            }
            Entry::Impulses(time, LatchImpulses { hinge, hinges: impulses }) => {
                text.set_struck(*time, &hinges[*hinge])?;
                text.add_hinge_loads(&mut lines.latch_impulses, impulses)?;
            }
            Entry::End => self.release(),
        }
        Ok(())
    }

    /// Moves rows that were held to the others.
    fn release(&mut self) {
        let Self { lines, held: [of_stresses, of_loads], .. } = self;
        lines.stresses.append(of_stresses);
        lines.hinge_loads.append(of_loads);
    }
}

/// A composer in a thread of its own, which ends when this is dropped.
#[derive(Debug)]
pub(crate) struct ComposerThread {
    /// The block to come, and its rows.
    block: Vec<Entry>,
    rows: usize,
    blocks: SyncSender<Vec<Entry>>,
    composed: Receiver<Composed>,
    /// Blocks that are with the thread.
    under_way: usize,
}

impl ComposerThread {
    /// # Errors
    /// When the system has no thread to give.
    pub fn start(mut composer: Composer) -> io::Result<Self> {
        let (blocks, to_compose) = sync_channel::<Vec<Entry>>(AHEAD);
        let (answers, composed) = sync_channel(AHEAD);
        let work = move || {
            let answer = to_compose.into_iter().map(|block| composer.compose(&block));
            // An answer that nobody takes is of a run that was given up.
            let _ = answer.map(|composed| answers.send(composed)).find(Result::is_err);
        };
        thread::Builder::new().name("tables".to_owned()).spawn(work)?;
        Ok(Self { block: Vec::new(), rows: 0, blocks, composed, under_way: 0 })
    }

    /// Adds an entry, and returns a block that was added earlier if one is due.
    pub fn add(&mut self, entry: Entry) -> Option<Composed> {
        self.rows += entry.rows();
        self.block.push(entry);
        if self.rows < BLOCK {
            return None;
        }
        let earlier = if self.under_way == AHEAD { self.next() } else { None };
        self.hand_over();
        earlier
    }

    /// The rest of all that was added, block by block.
    pub fn rest(&mut self) -> impl Iterator<Item = Composed> {
        let earlier = if self.under_way == AHEAD { self.next() } else { None };
        self.hand_over();
        earlier.into_iter().chain(std::iter::from_fn(|| self.next()))
    }

    fn hand_over(&mut self) {
        self.rows = 0;
        self.blocks.send(mem::take(&mut self.block)).expect("the thread lives as long as this");
        self.under_way += 1;
    }

    /// The oldest block with the thread, when it is composed.
    fn next(&mut self) -> Option<Composed> {
        self.under_way = self.under_way.checked_sub(1)?;
        Some(self.composed.recv().expect("the thread answers every block"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{StressSigns, fixture};
    use nboom_scalar::Vec3;
    use nboom_sections::{AtStation, Section, Tube};
    use nboom_sim::EventKind;
    use nboom_strength::Slips;

    /// One, with a tube.
    fn stations() -> Stations {
        let here = Section::Tube(Tube::new(1.0, 0.1).expect("a tube"));
        Stations::new(vec![AtStation { segment: 0, station: 0, here }], Slips::default())
    }

    fn composer() -> Composer {
        let hinges = fixture::labels();
        Composer::new(hinges.clone(), stations(), RowText::new(StressSigns::default(), &hinges))
    }

    fn loads(size: f64) -> Vec<Wrench<f64>> {
        vec![Wrench { force: Vec3::unit_x() * size, moment: Vec3::zero() }; fixture::labels().len()]
    }

    fn sample(time: f64, waits: bool) -> Entry {
        Entry::Sample { time, waits, stations: Vec::new(), hinge_loads: loads(1.0) }
    }

    fn peaks(time: f64) -> Entry {
        let (kind, hinge_loads) = (EventKind::LockUp, loads(2.0));
        Entry::Peaks(PulsePeaks { time, kind, stations: Vec::new(), hinge_loads })
    }

    /// Time and event of each row of hinge loads, without repetition.
    fn rows(lines: &[u8]) -> Vec<String> {
        let text = std::str::from_utf8(lines).expect("digits are text");
        let start = |line: &str| line.split(',').take(2).collect::<Vec<_>>().join(" ");
        let mut rows: Vec<String> = text.lines().map(start).collect();
        rows.dedup();
        rows
    }

    #[test]
    fn rows_come_in_order_and_later_ones_wait_for_peaks() {
        let mut thread = ComposerThread::start(composer()).expect("a thread");
        let mut lines = Vec::new();
        let mut keep = |composed: Composed| {
            assert!(composed.refused.is_none());
            lines.extend(composed.lines.hinge_loads);
        };
        // Many blocks before the lock-up at 1000, and some while its peaks are awaited.
        for time in 0..3000 {
            thread.add(sample(f64::from(time), time > 1000)).map(&mut keep);
        }
        thread.add(peaks(1000.0)).map(&mut keep);
        thread.rest().for_each(&mut keep);
        let time = |time: i32| format!("{time}.0 ");
        let before = (0..=1000).map(time);
        let expected = before.chain(["1000.0 lock_up".to_owned()]).chain((1001..3000).map(time));
        assert!(rows(&lines).into_iter().eq(expected));
    }

    #[test]
    fn rows_that_wait_are_told_when_no_peaks_come() {
        let mut thread = ComposerThread::start(composer()).expect("a thread");
        for entry in [sample(1.0, true), Entry::End] {
            assert!(thread.add(entry).is_none());
        }
        let lines: Vec<u8> =
            thread.rest().flat_map(|composed| composed.lines.hinge_loads).collect();
        assert_eq!(rows(&lines), ["1.0 "]);
    }

    #[test]
    fn what_is_no_number_is_refused_after_the_rows_before_it() {
        let mut thread = ComposerThread::start(composer()).expect("a thread");
        thread.add(sample(1.0, false));
        let hinges = loads(f64::INFINITY);
        thread.add(Entry::Impulses(2.0, LatchImpulses { hinge: 0, hinges }));
        let all: Vec<Composed> = thread.rest().collect();
        let [Composed { lines, refused: Some((file, error)) }] = &all[..] else {
            panic!("one block with a refusal: {all:?}")
        };
        assert_eq!(rows(&lines.hinge_loads), ["1.0 "]);
        assert_eq!(*file, LATCH_IMPULSES_FILE);
        assert!(error.to_string().contains("inf found"), "{error}");
    }

    #[test]
    fn whatever_may_be_refused_is_doubtful() {
        let stations = stations();
        let is_doubtful = |size: f64| {
            let hinge_loads = loads(size);
            let (time, kind) = (1.0, EventKind::Impact);
            let peaks = PulsePeaks { time, kind, stations: Vec::new(), hinge_loads };
            Entry::Peaks(peaks).is_doubtful(&stations)
        };
        assert!([f64::NAN, -f64::INFINITY, f64::MAX].map(is_doubtful).iter().all(|doubt| *doubt));
        assert!(!is_doubtful(1e6));
        // A stress that can be written, with an equivalent one that cannot.
        for (shear, is_doubtful) in [(-f64::MAX, true), (1e149, false)] {
            let numbers = [0.0, 0.0, 0.0, shear, 0.0, 0.0];
            let loaded = vec![StationLoad { load: loads(1.0)[0], numbers }];
            let can_be_written = stations
                .stresses(&loaded)
                .all(|found| found.max_von_mises.stress.von_mises().is_finite());
            assert!(can_be_written != is_doubtful);
            let hinge_loads = Vec::new();
            let entry = Entry::Sample { time: 1.0, waits: false, stations: loaded, hinge_loads };
            assert_eq!(entry.is_doubtful(&stations), is_doubtful);
        }
    }
}
