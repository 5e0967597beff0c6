use std::io;

use nboom_results::quantity;
use nboom_sim::{Event, EventKind, InstantMotion, OutputTimes, Recorder, Snapshot, StepMotion};
use nboom_strength::StressAnalysis;

use crate::wanted::{Extreme, Happened};

/// Sees of a run what its results are made of.
pub(crate) struct Observer<'o> {
    /// Output times in place of uniform ones.
    pub times: Option<OutputTimes>,
    pub interrupted: &'o dyn Fn() -> bool,
    pub analysis: Option<StressAnalysis>,
    pub hinges: Vec<Happened>,
    pub wanted: &'o [Extreme],
    /// Those of the wanted extremes; NaN before the first output time.
    pub extremes: Vec<f64>,
    /// Columns of trajectories, if they are wanted.
    pub columns: &'o [nboom_model::Column],
    pub states: Vec<Vec<f64>>,
}

impl Observer<'_> {
    fn follow(&mut self, snapshot: &Snapshot) {
        for (extreme, value) in self.wanted.iter().zip(&mut self.extremes) {
            extreme.follow(value, snapshot);
        }
    }
}

impl Recorder for Observer<'_> {
    fn needs_detail(&self) -> bool {
        let of_loads = self.analysis.as_ref().is_some_and(Recorder::needs_detail);
        of_loads || self.wanted.iter().any(Extreme::needs_detail)
    }

    fn output_times(&self) -> Option<&OutputTimes> {
        self.times.as_ref()
    }

    fn interrupted(&self) -> bool {
        (self.interrupted)()
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.follow(snapshot);
        if !self.columns.is_empty() {
            let row = self.columns.iter().map(|column| quantity(column, snapshot));
            self.states.push([snapshot.time].into_iter().chain(row).collect());
        }
        self.analysis.as_mut().map_or(Ok(()), |analysis| analysis.sample(snapshot))
    }

    fn event(&mut self, event: &Event, _after: &Snapshot) -> io::Result<()> {
        let Some(hinge) = event.hinge else { return Ok(()) };
        let happened = &mut self.hinges[hinge];
        match event.kind {
            EventKind::LockUp => {
                (happened.lock_up, happened.impulse) = (Some(event.time), event.impulse);
            }
            EventKind::Release => happened.release = Some(event.time),
            _ => {}
        }
        Ok(())
    }

    fn needs_instants(&self) -> bool {
        self.analysis.is_some() || self.wanted.iter().any(Extreme::needs_instants)
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        instant.sides().for_each(|side| self.follow(side.snapshot));
        self.analysis.as_mut().map_or(Ok(()), |analysis| Recorder::instant(analysis, instant))
    }

    fn needs_steps(&self) -> bool {
        self.analysis.is_some()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        self.analysis.as_mut().map_or(Ok(()), |analysis| Recorder::step(analysis, step))
    }
}
