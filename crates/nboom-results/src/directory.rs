use std::io::{self, Write};
use std::path::Path;

use nboom_model::{HingeLabel, Scene, WantedTable};
use nboom_sim::{Event, InstantMotion, OutputTimes, Recorder, Snapshot, StepMotion, Summary};
use nboom_strength::StressAnalysis;

use crate::destination::Destination;
use crate::ledger::LedgerWriter;
use crate::package::{self, TableHeads};
use crate::rows::{self, Output};
use crate::stress::StressWriter;
use crate::whole::Draft;
use crate::{
    EVENTS_FILE, EventsWriter, INSTANTS_FILE, Kept, LEDGER_FILE, LISTING_FILE, ListingWriter,
    OUTPUT_FILE, PACKAGE_FILE, PARQUET_FILES, RUN_FILE, ResultsError, RunDescription, SCENE_FILE,
    STATES_FILE, SUMMARY_FILE, StatesWriter, StressDescription, StressTables, SummaryFile,
    TRUST_FILE, WorstLoads, with_causes,
};

/// Space on disk reserved for the summary, which must be able to report a full disk \[bytes\].
const ROOM: usize = 1 << 14;

/// The directory of one run: creates its files, writes tables while the run goes on, and the
/// summary at the end.
///
/// The files of a run into DIR are written in `DIR.partial`, with a summary that is marked
/// incomplete, until [`RunDirectory::finish`]; no other run can write there.
#[derive(Debug)]
pub struct RunDirectory {
    place: Destination,
    run: RunDescription,
    /// The summary to come; taken when it is written.
    draft: Option<Draft>,
    states: StatesWriter<Output>,
    /// The motion on both sides of each instant.
    instants: StatesWriter<Output>,
    ledger: LedgerWriter<Output>,
    /// The table that is asked for.
    output: Option<StatesWriter<Output>>,
    events: EventsWriter<Output>,
    listing: Option<ListingWriter<Output>>,
    stresses: Option<StressWriter>,
    /// Columns of all tables but those of stresses.
    tables: Vec<TableHeads>,
    /// Names that are written when the summary is.
    expected: Vec<&'static str>,
    /// Events whose instant may still last, and the motion after them.
    instant: Option<(Vec<Event>, Snapshot)>,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// What was computed, to the end or to the failure.
    pub summary: Summary,
    /// Wall-clock time of the run \[s\].
    pub wall_seconds: f64,
    /// Why the run failed, if it did.
    pub error: Option<String>,
    /// Why its results are not to be trusted, or not to be liked.
    pub troubles: Vec<String>,
}

impl RunDirectory {
    /// Locks the place of the results `directory` and creates in `directory.partial` the files of a
    /// run of `scene`.
    ///
    /// # Errors
    /// When the place is refused ([`ResultsError::is_refusal`]) or a file cannot be made; what is
    /// in `directory` is as it was then.
    pub fn create(
        directory: &Path,
        scene: &Scene,
        run: RunDescription,
    ) -> Result<Self, ResultsError> {
        let place = Destination::take(directory)?;
        let draft = announce(&place, &run)?;
        let path = place.partial();
        let labels = scene.labels().to_vec();
        for (file, text) in [(SCENE_FILE, &run.scene_text), (RUN_FILE, &run.record)] {
            text.as_ref().map_or(Ok(()), |text| write_whole(path, file, text.as_bytes()))?;
        }
        let headings = &run.output.headings;
        let motion = |file, table: WantedTable| {
            open(path, file, |out| StatesWriter::of(out, &labels, table, headings))
        };
        let states = motion(STATES_FILE, WantedTable::states(labels.len()))?;
        let instants = motion(INSTANTS_FILE, WantedTable::states(labels.len()))?;
        let ledger = open(path, LEDGER_FILE, |out| LedgerWriter::new(out, scene, headings))?;
        let output =
            run.output.table.clone().map(|table| motion(OUTPUT_FILE, table)).transpose()?;
        let events =
            open(path, EVENTS_FILE, |out| EventsWriter::new(out, labels.clone(), headings))?;
        let tables = package::tables(scene, &run);
        let listing =
            run.output.listing.then(|| open_listing(path, scene, &run, labels)).transpose()?;
        Ok(Self {
            place,
            run,
            draft: Some(draft),
            states,
            instants,
            ledger,
            output,
            events,
            listing,
            stresses: None,
            tables,
            expected: Vec::new(),
            instant: None,
        })
    }

    /// Whether complete results of an earlier run, killed before they took their place, have now
    /// been put there.
    pub fn has_put_right(&self) -> bool {
        self.place.has_put_right
    }

    /// Expects [`Kept::add_trust`].
    pub fn with_trust(self) -> Self {
        self.expecting([TRUST_FILE])
    }

    /// Expects [`Kept::add_made`] of these names; of those that are made from tables, where the run has the table.
    pub fn expecting(mut self, names: impl IntoIterator<Item = &'static str>) -> Self {
        self.expected.extend(names);
        self
    }

    /// Also writes hinge loads, and stresses where there are stations: at output times as `tables`
    /// says, at lock-ups and at impacts, and the worst of the whole motion.
    ///
    /// # Errors
    /// When a file cannot be made.
    pub fn with_stresses(
        mut self,
        scene: &Scene,
        analysis: StressAnalysis,
        tables: StressTables,
    ) -> Result<Self, ResultsError> {
        let hinges = scene.labels().to_vec();
        let headings = self.run.output.headings.clone();
        self.run.stresses = StressDescription::of(&analysis, tables.signs);
        self.run.latch_pulses = Some(analysis.has_pulses());
        self.run.judged_by = analysis.settings().in_words();
        let stresses =
            StressWriter::create(self.place.partial(), hinges, analysis, tables, headings)?;
        self.stresses = Some(stresses);
        Ok(self)
    }

    /// Where the files are until they are complete.
    pub fn unfinished(&self) -> &Path {
        self.place.partial()
    }

    /// The worst stresses and hinge loads when the run is over; nothing where none are computed.
    pub fn worst_loads(&mut self) -> WorstLoads {
        let Some(stresses) = &mut self.stresses else { return WorstLoads::default() };
        // `finish` meets any error again.
        match stresses.analysis.finish() {
            Ok(()) => WorstLoads::of(&stresses.analysis),
            Err(_) => WorstLoads::default(),
        }
    }

    /// Writes what is left and the summary, and moves the results to their place. Complete ones
    /// replace earlier ones; others move only where there is no finished result.
    ///
    /// The summary says that the run is complete only when `outcome` has no error and every
    /// table could be written to its end.
    pub fn finish(mut self, outcome: &Outcome) -> Kept {
        let instant = self.close_instant();
        let states = self.states.flush().map_err(self.writing(STATES_FILE));
        let instants = self.instants.flush().map_err(self.writing(INSTANTS_FILE));
        let ledger = self.ledger.flush().map_err(self.writing(LEDGER_FILE));
        let output = self.output.as_mut().map_or(Ok(()), StatesWriter::flush);
        let output = output.map_err(self.writing(OUTPUT_FILE));
        let listing = self.flush_listing();
        let stresses = self.stresses.as_mut().map_or(Ok(()), StressWriter::finish);
        let tables =
            instant.and(states).and(instants).and(ledger).and(output).and(listing).and(stresses);
        let tables = tables.and_then(|()| self.write_package());
        let of_tables = tables.as_ref().err().map(|error| with_causes(error));
        let error = outcome.error.as_deref().or(of_tables.as_deref());
        let summary = self.write_summary(outcome, error);
        let settled = self.place.settle().map(Path::to_owned);
        let partial = || self.place.partial().to_owned();
        let directory = settled.as_ref().map_or_else(|_| partial(), Clone::clone);
        let written = tables.and(summary).and(settled.map(|_| ()));
        Kept { place: self.place, directory, written }
    }

    fn write_summary(
        &mut self,
        outcome: &Outcome,
        error: Option<&str>,
    ) -> Result<(), ResultsError> {
        let mut files: Vec<_> = self.place.files().collect();
        let tables = files.clone();
        let lacks_its_table = |name: &&str| {
            PARQUET_FILES.iter().any(|(table, made)| made == name && !tables.contains(table))
        };
        files.extend(self.expected.iter().filter(|name| !lacks_its_table(name)));
        let worst = self.worst_loads();
        let Outcome { summary, wall_seconds, troubles, .. } = outcome;
        let ended =
            SummaryFile::ended(&self.run, summary, &worst, *wall_seconds, error, files.clone())
                .with_troubles(troubles);
        let without_room = |why: &io::Error| {
            let why = why.to_string();
            SummaryFile::failed(&self.run, error.unwrap_or(&why), files).text()
        };
        let path = self.place.partial().join(SUMMARY_FILE);
        let draft = self.draft.take().expect("there is one until the end");
        let written = draft.publish_or(&path, &ended.text(), without_room);
        written.map_err(ResultsError::writing(&path))
    }

    /// Says what the columns of all tables are.
    fn write_package(&self) -> Result<(), ResultsError> {
        let of_stresses = self.stresses.as_ref().map_or(&[][..], StressWriter::tables);
        let tables: Vec<TableHeads> = self.tables.iter().chain(of_stresses).cloned().collect();
        let RunDescription { scene, output, units, .. } = &self.run;
        let text = package::text(scene, &tables, &output.headings, units);
        write_whole(self.place.partial(), PACKAGE_FILE, &text)
    }

    fn flush_listing(&mut self) -> Result<(), ResultsError> {
        let flushed = self.listing.as_mut().map_or(Ok(()), ListingWriter::flush);
        flushed.map_err(self.writing(LISTING_FILE))
    }

    /// Writes the events of the last instant, now that no more can join them.
    fn close_instant(&mut self) -> Result<(), ResultsError> {
        let Some((events, after)) = self.instant.take() else { return Ok(()) };
        self.events.write_instant(&events).map_err(self.writing(EVENTS_FILE))?;
        match &mut self.listing {
            Some(listing) => {
                let written = listing.write_instant(&events, &after);
                written.map_err(self.writing(LISTING_FILE))
            }
            None => Ok(()),
        }
    }

    fn write_sample(&mut self, snapshot: &Snapshot) -> Result<(), ResultsError> {
        self.close_instant()?;
        self.states.write(snapshot).map_err(self.writing(STATES_FILE))?;
        self.ledger.write(snapshot).map_err(self.writing(LEDGER_FILE))?;
        let output = self.output.as_mut().map_or(Ok(()), |output| output.write(snapshot));
        output.map_err(self.writing(OUTPUT_FILE))?;
        if let Some(stresses) = &mut self.stresses {
            stresses.sample(snapshot)?;
            self.write_stresses()?;
        }
        let Some(listing) = &mut self.listing else { return Ok(()) };
        // A printout that fills the disk must not take the space of rows that wait in memory.
        let flushed = self.states.flush();
        let listed = listing.write(snapshot);
        flushed.map_err(self.writing(STATES_FILE))?;
        listed.map_err(self.writing(LISTING_FILE))
    }

    fn write_stresses(&mut self) -> Result<(), ResultsError> {
        if !self.stresses.as_ref().is_some_and(StressWriter::is_full) {
            return Ok(());
        }
        // Long tables that fill the disk must not take the space of rows that wait in memory.
        self.states.flush().map_err(self.writing(STATES_FILE))?;
        self.stresses.as_mut().map_or(Ok(()), StressWriter::write)
    }

    fn add_event(&mut self, event: &Event, after: &Snapshot) -> Result<(), ResultsError> {
        if let Some((events, latest)) = &mut self.instant
            && events.iter().all(|earlier| earlier.time == event.time)
        {
            events.push(*event);
            latest.clone_from(after);
            return Ok(());
        }
        self.close_instant()?;
        self.instant = Some((vec![*event], after.clone()));
        Ok(())
    }

    fn writing(&self, file: &str) -> impl FnOnce(io::Error) -> ResultsError + use<> {
        ResultsError::writing(&self.place.partial().join(file))
    }
}

impl Recorder for RunDirectory {
    fn output_times(&self) -> Option<&OutputTimes> {
        self.run.output.times.as_ref()
    }

    fn needs_detail(&self) -> bool {
        let table_is_due = self.run.output.table.as_ref().is_some_and(WantedTable::needs_detail);
        let stresses_are_due = self.stresses.as_ref().is_some_and(StressWriter::is_due);
        table_is_due || self.listing.is_some() || stresses_are_due
    }

    fn needs_instants(&self) -> bool {
        true
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        instant.sides().try_for_each(|side| self.instants.write(side.snapshot))?;
        let Some(stresses) = &mut self.stresses else { return Ok(()) };
        stresses.instant(instant).map_err(ResultsError::into_io)?;
        self.write_stresses().map_err(ResultsError::into_io)
    }

    fn needs_steps(&self) -> bool {
        self.stresses.is_some()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        let Some(stresses) = &mut self.stresses else { return Ok(()) };
        stresses.step(step).map_err(ResultsError::into_io)
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.write_sample(snapshot).map_err(ResultsError::into_io)
    }

    fn event(&mut self, event: &Event, after: &Snapshot) -> io::Result<()> {
        self.add_event(event, after).map_err(ResultsError::into_io)
    }
}

fn open<T>(
    directory: &Path,
    file: &str,
    start: impl FnOnce(Output) -> io::Result<T>,
) -> Result<T, ResultsError> {
    let started = rows::create(directory, file).and_then(start);
    started.map_err(ResultsError::writing(&directory.join(file)))
}

/// Writes a file that is known from the start.
fn write_whole(directory: &Path, file: &str, text: &[u8]) -> Result<(), ResultsError> {
    open(directory, file, |mut out| {
        out.write_all(text)?;
        out.flush()
    })
}

fn open_listing(
    directory: &Path,
    scene: &Scene,
    run: &RunDescription,
    hinges: Vec<HingeLabel>,
) -> Result<ListingWriter<Output>, ResultsError> {
    open(directory, LISTING_FILE, |out| {
        let span = [scene.initial.time, scene.end_time];
        let listing = ListingWriter::new(out, &run.scene, hinges, run.units.clone(), span)?;
        Ok(listing.thinned(run.print_interval))
    })
}

/// Writes a summary that says that the run is not complete, and reserves space for another.
fn announce(place: &Destination, run: &RunDescription) -> Result<Draft, ResultsError> {
    let path = place.partial().join(SUMMARY_FILE);
    let first = place.draft()?.publish(&path, &SummaryFile::unfinished(run).text());
    first.map_err(ResultsError::writing(&path))?;
    let mut draft = place.draft()?;
    draft.reserve(ROOM).map_err(ResultsError::writing(&path))?;
    Ok(draft)
}
