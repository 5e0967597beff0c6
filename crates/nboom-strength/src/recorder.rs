use std::io;

use nboom_sim::{InstantMotion, Recorder, StepMotion};

use crate::StressAnalysis;

/// Sees the whole run and needs no output times.
impl Recorder for StressAnalysis {
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
