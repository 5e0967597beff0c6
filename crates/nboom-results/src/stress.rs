use std::io::{self, Write};
use std::path::{Path, PathBuf};

use nboom_model::HingeLabel;
use nboom_sim::{InstantMotion, Snapshot, StepMotion};
use nboom_strength::{Cause, StressAnalysis, Worst, WorstHingeLoad};

use crate::composer::{Composed, Composer, ComposerThread, Entry};
use crate::heads::{Head, Headings};
use crate::load_heads;
use crate::number::{field, number};
use crate::package::TableHeads;
use crate::row_text::{RowText, load_fields, place_fields, stress_fields};
use crate::rows::{self, LongTable, Output};
use crate::signs::StressSigns;
use crate::{
    ENVELOPE_FILE, HINGE_ENVELOPE_FILE, HINGE_LOADS_FILE, LATCH_IMPULSES_FILE, ResultsError,
    STRESS_FILE,
};

/// The driver of a station that carries no load.
const UNLOADED: &str = "unloaded";

/// How stresses are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StressTables {
    /// Output times from one computation to the next; 0 counts as 1.
    pub every: usize,
    /// Which sign they have.
    pub signs: StressSigns,
}

/// Writes `hinge_loads.csv`, `latch_impulses.csv` and, if there are stations, `stress.csv` during a
/// run, and the envelopes at its end.
///
/// Forces and moments act on what is outboard of a station or hinge, in segment axes, moments about
/// the point of the station on the η axis or about the hinge point. A row with the event `lock_up`
/// has peaks, the sum over the motion and the pulses. They are known when the pulses are over;
/// until then rows of later output times wait.
#[derive(Debug)]
pub(crate) struct StressWriter {
    directory: PathBuf,
    pub analysis: StressAnalysis,
    /// Output times from one computation to the next.
    every: usize,
    samples: usize,
    hinges: Vec<HingeLabel>,
    signs: StressSigns,
    composer: ComposerThread,
    /// Where there are stations.
    stresses: Option<LongTable>,
    hinge_loads: LongTable,
    latch_impulses: LongTable,
    headings: Headings,
    /// Columns of the tables that have been made.
    tables: Vec<TableHeads>,
}

impl StressWriter {
    pub fn create(
        directory: &Path,
        hinges: Vec<HingeLabel>,
        analysis: StressAnalysis,
        StressTables { every, signs }: StressTables,
        headings: Headings,
    ) -> Result<Self, ResultsError> {
        let mut tables = Vec::new();
        let mut table = |file, heads: Vec<Head>| {
            let made = LongTable::create(directory, file, &headings.line(&heads));
            tables.push(TableHeads { file, heads });
            made
        };
        let stresses =
            analysis.has_stations().then(|| table(STRESS_FILE, load_heads::stress(signs)));
        let text = RowText::new(signs, &hinges);
        let composer = Composer::new(hinges.clone(), analysis.stations().clone(), text);
        Ok(Self {
            directory: directory.to_owned(),
            stresses: stresses.transpose()?,
            hinge_loads: table(HINGE_LOADS_FILE, load_heads::hinge_loads())?,
            latch_impulses: table(LATCH_IMPULSES_FILE, load_heads::latch_impulses())?,
            analysis,
            every: every.max(1),
            samples: 0,
            composer: ComposerThread::start(composer).map_err(ResultsError::writing(directory))?,
            signs,
            hinges,
            headings,
            tables,
        })
    }

    /// Whether loads are written at the coming output time.
    pub fn is_due(&self) -> bool {
        self.samples.is_multiple_of(self.every)
    }

    /// Computes the loads of an output time, if they are due.
    pub fn sample(&mut self, snapshot: &Snapshot) -> Result<(), ResultsError> {
        let due = self.is_due();
        self.samples += 1;
        let Some(detail) = snapshot.detail.as_ref().filter(|_| due) else { return Ok(()) };
        self.analysis.motion(snapshot, detail)?;
        self.compose(Entry::Sample {
            time: snapshot.time,
            waits: self.analysis.awaits_peaks(),
            stations: self.analysis.station_loads().to_vec(),
            hinge_loads: self.analysis.hinge_loads().to_vec(),
        })
    }

    /// The largest loads of a step, for the envelopes.
    pub fn step(&mut self, step: &mut dyn StepMotion) -> Result<(), ResultsError> {
        self.analysis.step(step)?;
        self.tell_peaks()
    }

    /// Computes both sides of an instant, and the impulses if hinges lock or hit stops.
    pub fn instant(&mut self, instant: &InstantMotion) -> Result<(), ResultsError> {
        self.analysis.instant(instant)?;
        self.tell_peaks()?;
        let time = instant.after.snapshot.time;
        let impulses = self.analysis.latch_impulses().to_vec().into_iter();
        impulses.map(|found| Entry::Impulses(time, found)).try_for_each(|entry| self.compose(entry))
    }

    fn tell_peaks(&mut self) -> Result<(), ResultsError> {
        let settled = self.analysis.settled().into_iter();
        settled.map(Entry::Peaks).try_for_each(|entry| self.compose(entry))
    }

    /// Gives rows to the composer, and takes those that it has composed meanwhile; these wait for
    /// [`Self::write`].
    fn compose(&mut self, entry: Entry) -> Result<(), ResultsError> {
        let is_doubtful = entry.is_doubtful(self.analysis.stations());
        if let Some(composed) = self.composer.add(entry) {
            self.take(composed)?;
        }
        // A number that is refused ends the run at its time.
        if is_doubtful { self.take_rest() } else { Ok(()) }
    }

    /// Takes all that was given to the composer.
    fn take_rest(&mut self) -> Result<(), ResultsError> {
        let rest: Vec<Composed> = self.composer.rest().collect();
        rest.into_iter().try_for_each(|composed| self.take(composed))
    }

    fn take(&mut self, Composed { mut lines, refused }: Composed) -> Result<(), ResultsError> {
        if let Some(table) = &mut self.stresses {
            table.lines.append(&mut lines.stresses);
        }
        self.hinge_loads.lines.append(&mut lines.hinge_loads);
        self.latch_impulses.lines.append(&mut lines.latch_impulses);
        refused.map_or(Ok(()), |(file, error)| {
            Err(ResultsError::writing(&self.directory.join(file))(error))
        })
    }

    /// Whether enough waits in memory to write it.
    pub fn is_full(&self) -> bool {
        let tables = self.stresses.iter().chain([&self.hinge_loads, &self.latch_impulses]);
        tables.into_iter().any(LongTable::is_long)
    }

    /// Writes what waits in memory.
    pub fn write(&mut self) -> Result<(), ResultsError> {
        let Self { stresses, hinge_loads, latch_impulses, .. } = self;
        let mut tables = stresses.iter_mut().chain([hinge_loads, latch_impulses]);
        tables.try_for_each(LongTable::write)
    }

    /// Continues the last pulses to their ends, and writes what waits in memory and the worst of
    /// each station and hinge.
    pub fn finish(&mut self) -> Result<(), ResultsError> {
        let finished = self.analysis.finish();
        let told = self.tell_peaks().and_then(|()| self.compose(Entry::End));
        let taken = self.take_rest();
        self.write()?;
        told.and(taken)?;
        finished?;
        if self.stresses.is_some() {
            let worst = self.analysis.envelope();
            // Without such a margin there is no such column.
            let breaks = worst.iter().any(|worst| worst.margins.on_ultimate.is_some());
            let heads = load_heads::envelope(self.signs, breaks);
            self.write_table(ENVELOPE_FILE, &heads, |out| {
                worst.iter().try_for_each(|worst| {
                    self.write_worst(out, worst)?;
                    if breaks {
                        margin_field(out, worst.margins.on_ultimate)?;
                    }
                    writeln!(out)
                })
            })?;
            self.tables.push(TableHeads { file: ENVELOPE_FILE, heads });
        }
        let worst = self.analysis.hinge_envelope();
        let heads = load_heads::hinge_envelope();
        self.write_table(HINGE_ENVELOPE_FILE, &heads, |out| {
            worst.iter().try_for_each(|worst| self.write_worst_of_hinge(out, worst))
        })?;
        self.tables.push(TableHeads { file: HINGE_ENVELOPE_FILE, heads });
        Ok(())
    }

    /// The tables that have been made.
    pub fn tables(&self) -> &[TableHeads] {
        &self.tables
    }

    fn write_table(
        &self,
        file: &str,
        heads: &[Head],
        rows: impl FnOnce(&mut Output) -> io::Result<()>,
    ) -> Result<(), ResultsError> {
        let path = self.directory.join(file);
        let written = rows::create(&self.directory, file).and_then(|mut out| {
            writeln!(out, "{}", self.headings.line(heads))?;
            rows(&mut out)?;
            out.flush()
        });
        written.map_err(ResultsError::writing(&path))
    }

    fn write_worst(&self, out: &mut Output, worst: &Worst) -> io::Result<()> {
        let [appendage, segment] = worst.segment.numbers();
        write!(out, "{appendage},{segment},{},", worst.station + 1)?;
        number(out, worst.time)?;
        self.event_fields(out, worst.cause)?;
        place_fields(out, worst.max_von_mises.place)?;
        stress_fields(out, self.signs.components(worst.max_von_mises.stress))?;
        field(out, worst.max_von_mises.stress.von_mises())?;
        write!(out, ",{}", worst.driver.map_or(UNLOADED, |driver| driver.name()))?;
        margin_field(out, worst.margins.on_yield)?;
        share_field(out, worst.cause)?;
        load_fields(out, &worst.load)
    }

    fn write_worst_of_hinge(&self, out: &mut Output, worst: &WorstHingeLoad) -> io::Result<()> {
        let [appendage, segment] = worst.hinge.numbers();
        write!(out, "{appendage},{segment},{},", worst.quantity.name())?;
        number(out, worst.time)?;
        self.event_fields(out, worst.cause)?;
        field(out, worst.magnitude())?;
        share_field(out, worst.cause)?;
        load_fields(out, &worst.load)?;
        writeln!(out)
    }

    /// The event that caused a load, and its hinge.
    fn event_fields(&self, out: &mut Output, cause: Cause) -> io::Result<()> {
        match cause {
            Cause::Motion => write!(out, ",,,"),
            Cause::Pulse { hinge, kind, .. } => {
                let [appendage, segment] = self.hinges[hinge].numbers();
                write!(out, ",{},{appendage},{segment}", kind.name())
            }
        }
    }
}

fn margin_field(out: &mut Output, margin: Option<f64>) -> io::Result<()> {
    match margin {
        Some(margin) => field(out, margin),
        None => write!(out, ","),
    }
}

fn share_field(out: &mut Output, cause: Cause) -> io::Result<()> {
    match cause {
        Cause::Motion => write!(out, ","),
        Cause::Pulse { share, .. } => field(out, share),
    }
}
