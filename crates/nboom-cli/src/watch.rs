use std::io;

use nboom_results::RunDirectory;
use nboom_sim::{
    Event, EventKind, InstantMotion, OutputTimes, Recorder, Snapshot, StepMotion, Witness,
};

use crate::interrupt::Interrupt;
use crate::progress::Progress;

/// Passes everything on to the files, shows the progress on the terminal, and keeps the first
/// events for it.
pub(crate) struct Watch {
    pub(crate) files: RunDirectory,
    pub(crate) progress: Progress,
    pub(crate) events: Vec<Event>,
    pub(crate) events_to_keep: usize,
    pub(crate) interrupt: Interrupt,
    /// The results to compare with a reference run, if there will be one.
    pub(crate) witness: Option<Witness>,
}

impl Recorder for Watch {
    fn needs_detail(&self) -> bool {
        self.files.needs_detail()
    }

    fn output_times(&self) -> Option<&OutputTimes> {
        self.files.output_times()
    }

    fn interrupted(&self) -> bool {
        self.interrupt.came()
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.progress.reach(snapshot.time);
        if let Some(witness) = &mut self.witness {
            witness.sample(snapshot)?;
        }
        self.files.sample(snapshot)
    }

    fn needs_instants(&self) -> bool {
        self.files.needs_instants()
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        self.files.instant(instant)
    }

    fn needs_steps(&self) -> bool {
        self.files.needs_steps()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        self.files.step(step)
    }

    fn event(&mut self, event: &Event, after: &Snapshot) -> io::Result<()> {
        self.progress.reach(event.time);
        if let Some(witness) = &mut self.witness {
            witness.event(event, after)?;
        }
        if self.events.len() < self.events_to_keep && event.kind != EventKind::End {
            self.events.push(*event);
        }
        self.files.event(event, after)
    }
}
