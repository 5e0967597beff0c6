//! What a run tells its recorder, and when.

use nboom_dynamics::Invariants;

use super::Run;
use crate::equations::state::State;
use crate::error::SimError;
use crate::events::event::{Event, Jump};
use crate::events::instant::Arrivals;
use crate::events::situation::Situation;
use crate::run::finite;
use crate::run::record::{Detail, InstantMotion, Snapshot};
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
            let spare = self.spare.take();
            let mut state = spare.unwrap_or_else(|| self.situation.state.clone());
            self.equations.read(time, &self.variables, &mut state);
            self.sample(&state)?;
            self.spare = Some(state);
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
        self.look(state)?;
        let kept = self.recorder.sample(&self.seen);
        kept.map_err(|source| SimError::Record { time: state.time, source })
    }

    /// Enters `state` in the ledger and sees all of it that the recorder wants.
    fn look(&mut self, state: &State) -> Result<(), SimError> {
        let found = state.invariants(&mut self.equations.entered.dynamics);
        self.ledger.check(self.situation.scene, self.equations, state, &found)?;
        self.see(state, &found, self.recorder.needs_detail())
    }

    fn see(
        &mut self,
        state: &State,
        found: &Invariants<f64>,
        detailed: bool,
    ) -> Result<(), SimError> {
        let Self { situation: Situation { scene, mode, .. }, equations, seen, room, .. } = self;
        snapshot::write(scene, mode, state, found, seen);
        if detailed {
            let detail = seen.detail.get_or_insert_with(Detail::empty);
            snapshot::write_detail(scene, equations, state, found.mass_center, room, detail);
        } else {
            seen.detail = None;
        }
        let window = self.stepper.window();
        seen.steps = window.counts.accepted;
        seen.next_step = window.next_step.min(scene.end_time - scene.initial.time);
        finite::check_snapshot(scene, seen)
    }

    /// The present motion in detail.
    fn motion_here(&mut self) -> Result<Snapshot, SimError> {
        let state = self.situation.state.clone();
        let found = state.invariants(&mut self.equations.entered.dynamics);
        self.see(&state, &found, true)?;
        Ok(self.seen.clone())
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
        self.motion_here().map(Some)
    }

    pub(super) fn tell_instant(
        &mut self,
        before: Option<Snapshot>,
        jumps: Vec<Jump>,
    ) -> Result<(), SimError> {
        if !self.recorder.needs_instants() {
            return Ok(());
        }
        let (time, after) = (self.situation.state.time, self.motion_here()?);
        let kept = self.recorder.instant(&InstantMotion { before, jumps, after });
        kept.map_err(|source| SimError::Record { time, source })
    }

    pub(super) fn report(&mut self, events: &[Event]) -> Result<(), SimError> {
        if events.is_empty() {
            return Ok(());
        }
        let state = self.situation.state.clone();
        self.look(&state)?;
        for event in events {
            self.events += 1;
            self.verdict.note(event);
            let kept = self.recorder.event(event, &self.seen);
            kept.map_err(|source| SimError::Record { time: event.time, source })?;
        }
        Ok(())
    }
}
