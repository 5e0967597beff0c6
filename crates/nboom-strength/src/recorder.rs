use std::io;

use nboom_sim::{InstantMotion, Recorder, Snapshot, StepMotion};

use crate::StressAnalysis;

/// Sees the whole run and needs no output times, except in a run of no length, which has nothing else.
impl Recorder for StressAnalysis {
    fn needs_detail(&self) -> bool {
        self.is_moment
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        match &snapshot.detail {
            Some(detail) if self.is_moment => {
                self.motion(snapshot, detail).map_err(io::Error::other)
            }
            _ => Ok(()),
        }
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
