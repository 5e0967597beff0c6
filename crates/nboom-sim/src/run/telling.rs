//! What a run tells its recorder, and when.

use super::Run;
use crate::equations::state::State;
use crate::error::SimError;
use crate::events::event::{Event, Jump};
use crate::events::instant::Arrivals;
use crate::events::situation::Situation;
use crate::run::finite;
use crate::run::record::{InstantMotion, Snapshot};
use crate::run::snapshot;
use crate::run::step_motion::DenseStep;

impl Run<'_> {
    pub(super) fn sample_time(&self) -> f64 {
        let (start, end) = (self.situation.scene.initial.time, self.situation.scene.end_time);
        let share = self.next_sample as f64 / self.options.samples as f64;
        match self.next_sample {
            n if n > self.options.samples => f64::INFINITY,
            n if n == self.options.samples => end,
            _ => start + (end - start) * share,
        }
    }

    /// Records the output times before `until` (and not in its instant) from dense output over
    /// a step of length `full`.
    pub(super) fn sample_within(&mut self, full: f64, until: f64) -> Result<(), SimError> {
        while self.is_before(self.sample_time(), until) {
            let time = self.sample_time();
            self.variables.resize(self.equations.variables.layout.len(), 0.0);
            let fraction = (time - self.stepper.window().time) / full;
            self.stepper.interpolate(fraction, &mut self.variables);
            self.equations.read(time, &self.variables, &mut self.scratch);
            let state = self.scratch.clone();
            self.sample(&state)?;
        }
        Ok(())
    }

    /// Shows the recorder the step just taken, whose dense output is over a step of length `full`.
    pub(super) fn tell_step(&mut self, full: f64) -> Result<(), SimError> {
        if !self.recorder.needs_steps() {
            return Ok(());
        }
        let Self { situation, equations, stepper, room, recorder, .. } = self;
        let mode = &situation.mode;
        let time = stepper.window().end_time;
        let mut step = DenseStep::new(&mode.hinges, equations, &**stepper, full, room);
        recorder.step(&mut step).map_err(|source| SimError::Record { time, source })
    }

    /// Records the output time that the present instant coincides with, if there is one.
    pub(super) fn sample_here(&mut self) -> Result<(), SimError> {
        while !self.is_before(self.situation.state.time, self.sample_time()) {
            let state = State { time: self.sample_time(), ..self.situation.state.clone() };
            self.sample(&state)?;
        }
        Ok(())
    }

    fn sample(&mut self, state: &State) -> Result<(), SimError> {
        self.check_interrupt(state.time)?;
        self.next_sample += 1;
        self.ledger.check(self.situation.scene, &mut self.equations, state)?;
        let snapshot = self.snapshot(state)?;
        let kept = self.recorder.sample(&snapshot);
        kept.map_err(|source| SimError::Record { time: state.time, source })
    }

    fn snapshot(&mut self, state: &State) -> Result<Snapshot, SimError> {
        let needs_detail = self.recorder.needs_detail();
        self.snapshot_with(state, needs_detail)
    }

    fn snapshot_with(&mut self, state: &State, needs_detail: bool) -> Result<Snapshot, SimError> {
        let Self { situation: Situation { scene, mode, .. }, equations, .. } = self;
        let seen = snapshot::take(scene, mode, &mut equations.dynamics, state);
        let detail = needs_detail.then(|| snapshot::detail(scene, equations, state));
        let (steps, next_step) =
            (self.stepper.window().counts.accepted, self.stepper.window().next_step);
        let next_step = next_step.min(scene.end_time - scene.initial.time);
        let seen = Snapshot { detail, steps, next_step, ..seen };
        finite::check_snapshot(scene, &seen)?;
        Ok(seen)
    }

    /// The motion before an instant, if there is one and the recorder wants it.
    pub(super) fn before_instant(
        &mut self,
        arrivals: &Arrivals,
    ) -> Result<Option<Snapshot>, SimError> {
        let has_moved =
            self.situation.state.time > self.situation.scene.initial.time || arrivals.lock();
        if !(has_moved && self.recorder.needs_instants()) {
            return Ok(None);
        }
        let state = self.situation.state.clone();
        self.snapshot_with(&state, true).map(Some)
    }

    pub(super) fn tell_instant(
        &mut self,
        before: Option<Snapshot>,
        jumps: Vec<Jump>,
    ) -> Result<(), SimError> {
        if !self.recorder.needs_instants() {
            return Ok(());
        }
        let state = self.situation.state.clone();
        let after = self.snapshot_with(&state, true)?;
        let kept = self.recorder.instant(&InstantMotion { before, jumps, after });
        kept.map_err(|source| SimError::Record { time: state.time, source })
    }

    pub(super) fn report(&mut self, events: &[Event]) -> Result<(), SimError> {
        if events.is_empty() {
            return Ok(());
        }
        let state = self.situation.state.clone();
        self.ledger.check(self.situation.scene, &mut self.equations, &state)?;
        let after = self.snapshot(&state)?;
        for event in events {
            self.events += 1;
            self.verdict.note(event);
            let kept = self.recorder.event(event, &after);
            kept.map_err(|source| SimError::Record { time: event.time, source })?;
        }
        Ok(())
    }
}
