use std::io;

use nboom_sim::{Event, InstantMotion, Recorder, Snapshot, StepMotion};

use crate::StressAnalysis;

/// Sees the whole of a run and needs no output times.
impl Recorder for StressAnalysis {
    fn needs_detail(&self) -> bool {
        false
    }

    fn sample(&mut self, _snapshot: &Snapshot) -> io::Result<()> {
        Ok(())
    }

    fn event(&mut self, _event: &Event, _after: &Snapshot) -> io::Result<()> {
        Ok(())
    }

    fn needs_instants(&self) -> bool {
        true
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        self.instant(instant).map_err(io::Error::other)
    }

    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        self.step(step).map_err(io::Error::other)
    }
}
