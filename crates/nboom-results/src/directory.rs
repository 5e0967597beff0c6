use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use nboom_model::{HingeLabel, Scene};
use nboom_sim::{Event, Recorder, Snapshot, Summary};

use crate::rows::{self, Output};
use crate::{
    EVENTS_FILE, EventsWriter, LISTING_FILE, ListingWriter, ResultsError, RunDescription,
    STATES_FILE, SUMMARY_FILE, StatesWriter, SummaryFile, TRUST_FILE, with_causes,
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
        remove_stale(&path.join(LISTING_FILE))?;
        remove_stale(&path.join(TRUST_FILE))?;
        SummaryFile::unfinished(&run).replace(&path.join(SUMMARY_FILE))?;
        let labels: Vec<_> = (0..scene.bodies.len()).map(|i| scene.label(i)).collect();
        let states = open(path, STATES_FILE, |out| StatesWriter::new(out, &labels))?;
        let events = open(path, EVENTS_FILE, |out| EventsWriter::new(out, labels.clone()))?;
        let listing = listing.then(|| open_listing(path, &run, labels)).transpose()?;
        Ok(Self { path: path.to_owned(), run, states, events, listing, instant: None })
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
        let tables = instant.and(states).and(listing);
        let of_tables = tables.as_ref().err().map(|error| with_causes(error));
        let error = outcome.error.as_deref().or(of_tables.as_deref());
        let summary = SummaryFile::ended(&self.run, &outcome.summary, outcome.wall_seconds, error);
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
        let Some(listing) = &mut self.listing else { return Ok(()) };
        // A printout that fills the disk must not take the room of rows that wait in memory.
        let flushed = self.states.flush();
        let listed = listing.write(snapshot);
        flushed.map_err(self.writing(STATES_FILE))?;
        listed.map_err(self.writing(LISTING_FILE))
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
        self.listing.is_some()
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
    open(directory, LISTING_FILE, |out| ListingWriter::new(out, &run.scene, hinges, run.units))
}

fn remove_stale(path: &Path) -> Result<(), ResultsError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(ResultsError::writing(path)(error))
        }
        _ => Ok(()),
    }
}
