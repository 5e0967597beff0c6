use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use nboom_model::{HingeLabel, Scene};
use nboom_sim::{Event, InstantMotion, Recorder, Snapshot, StepMotion, Summary};
use nboom_strength::StressAnalysis;

use crate::rows::{self, Output};
use crate::stress::StressWriter;
use crate::{
    ENVELOPE_FILE, EVENTS_FILE, EventsWriter, HINGE_ENVELOPE_FILE, HINGE_LOADS_FILE,
    LATCH_IMPULSES_FILE, LISTING_FILE, ListingWriter, ResultsError, RunDescription, STATES_FILE,
    STRESS_FILE, SUMMARY_FILE, StatesWriter, StressTables, SummaryFile, TRUST_FILE, WorstLoads,
    with_causes,
};

/// The directory of one run: creates it, writes its tables while the run goes on, and its
/// summary at the end.
///
/// From its creation until [`RunDirectory::finish`] the directory holds a summary marked
/// incomplete, whatever an earlier run left there and however this one is stopped.
#[derive(Debug)]
pub struct RunDirectory {
    path: PathBuf,
    run: RunDescription,
    states: StatesWriter<Output>,
    events: EventsWriter<Output>,
    listing: Option<ListingWriter<Output>>,
    stresses: Option<StressWriter>,
    /// Events whose instant may not be over, and the motion after them.
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
}

impl RunDirectory {
    /// Creates the directory at `path`, if need be, and in it the files of a run of `scene`;
    /// files of an earlier run are replaced or removed.
    ///
    /// # Errors
    /// When the directory or a file in it cannot be made.
    pub fn create(
        path: &Path,
        scene: &Scene,
        run: RunDescription,
        listing: bool,
    ) -> Result<Self, ResultsError> {
        fs::create_dir_all(path)
            .map_err(|source| ResultsError::Directory { path: path.to_owned(), source })?;
        remove_stale(&path.join(SUMMARY_FILE))?;
        let of_loads = [HINGE_LOADS_FILE, LATCH_IMPULSES_FILE, HINGE_ENVELOPE_FILE];
        let of_stresses = [STRESS_FILE, ENVELOPE_FILE];
        let optional = [LISTING_FILE, TRUST_FILE].into_iter().chain(of_loads).chain(of_stresses);
        { optional }.try_for_each(|file| remove_stale(&path.join(file)))?;
        SummaryFile::unfinished(&run).replace(&path.join(SUMMARY_FILE))?;
        let labels: Vec<_> = (0..scene.bodies.len()).map(|i| scene.label(i)).collect();
        let states = open(path, STATES_FILE, |out| StatesWriter::new(out, &labels))?;
        let events = open(path, EVENTS_FILE, |out| EventsWriter::new(out, labels.clone()))?;
        let listing = listing.then(|| open_listing(path, &run, labels)).transpose()?;
        let path = path.to_owned();
        Ok(Self { path, run, states, events, listing, stresses: None, instant: None })
    }

    /// Also writes stresses, at output times as `tables` says and at lock-ups, and the worst of them
    /// and of both sides of all events.
    ///
    /// # Errors
    /// When a file cannot be made.
    pub fn with_stresses(
        mut self,
        scene: &Scene,
        analysis: StressAnalysis,
        tables: StressTables,
    ) -> Result<Self, ResultsError> {
        let hinges = (0..scene.bodies.len()).map(|i| scene.label(i)).collect();
        self.run.stresses = Some((tables, analysis.generated_for()));
        self.stresses = Some(StressWriter::create(&self.path, hinges, analysis, tables)?);
        SummaryFile::unfinished(&self.run).replace(&self.path.join(SUMMARY_FILE))?;
        Ok(self)
    }

    /// The worst stresses and hinge loads when the run is over; nothing where none are computed.
    pub fn worst_loads(&mut self) -> WorstLoads {
        let Some(stresses) = &mut self.stresses else { return WorstLoads::default() };
        // Whatever is wrong, `finish` comes upon it again.
        match stresses.analysis.finish() {
            Ok(()) => WorstLoads::of(&stresses.analysis),
            Err(_) => WorstLoads::default(),
        }
    }

    /// Writes what is left and the summary.
    ///
    /// The summary says that the run is complete only when `outcome` has no error and every
    /// table could be written to its end.
    ///
    /// # Errors
    /// The first file that cannot be written; the others are written nevertheless.
    pub fn finish(mut self, outcome: &Outcome) -> Result<(), ResultsError> {
        let instant = self.close_instant();
        let states = self.states.flush().map_err(self.writing(STATES_FILE));
        let listing = self.flush_listing();
        let stresses = self.stresses.as_mut().map_or(Ok(()), StressWriter::finish);
        let tables = instant.and(states).and(listing).and(stresses);
        let of_tables = tables.as_ref().err().map(|error| with_causes(error));
        let error = outcome.error.as_deref().or(of_tables.as_deref());
        let worst = self.worst_loads();
        let Outcome { summary, wall_seconds, .. } = outcome;
        let summary = SummaryFile::ended(&self.run, summary, &worst, *wall_seconds, error);
        tables.and(summary.replace(&self.path.join(SUMMARY_FILE)))
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
        if let Some(stresses) = &mut self.stresses {
            stresses.sample(snapshot)?;
            self.write_stresses()?;
        }
        let Some(listing) = &mut self.listing else { return Ok(()) };
        // A printout that fills the disk must not take the room of rows that wait in memory.
        let flushed = self.states.flush();
        let listed = listing.write(snapshot);
        flushed.map_err(self.writing(STATES_FILE))?;
        listed.map_err(self.writing(LISTING_FILE))
    }

    fn write_stresses(&mut self) -> Result<(), ResultsError> {
        let Some(stresses) = &mut self.stresses else { return Ok(()) };
        if !stresses.is_full() {
            return Ok(());
        }
        // Long tables that fill the disk must not take the room of rows that wait in memory.
        self.states.flush().map_err(ResultsError::writing(&self.path.join(STATES_FILE)))?;
        stresses.write()
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
        ResultsError::writing(&self.path.join(file))
    }
}

impl Recorder for RunDirectory {
    fn needs_detail(&self) -> bool {
        self.listing.is_some() || self.stresses.as_ref().is_some_and(StressWriter::is_due)
    }

    fn needs_instants(&self) -> bool {
        self.stresses.is_some()
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
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
    let path = directory.join(file);
    let started = rows::create(&path).and_then(start);
    started.map_err(ResultsError::writing(&path))
}

fn open_listing(
    directory: &Path,
    run: &RunDescription,
    hinges: Vec<HingeLabel>,
) -> Result<ListingWriter<Output>, ResultsError> {
    open(directory, LISTING_FILE, |out| {
        let listing = ListingWriter::new(out, &run.scene, hinges, run.units)?;
        Ok(listing.thinned(run.print_interval))
    })
}

fn remove_stale(path: &Path) -> Result<(), ResultsError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(ResultsError::writing(path)(error))
        }
        _ => Ok(()),
    }
}
