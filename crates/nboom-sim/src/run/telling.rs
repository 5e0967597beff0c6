//! What a run tells its recorder, and when.

use nboom_dynamics::Invariants;

use super::Run;
use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::events::event::{Event, EventKind};
use crate::run::finite;
use crate::run::output_times::OutputTimes;
use crate::run::record::{Detail, InstantMotion, Side};
use crate::run::snapshot;
use crate::run::step_motion::DenseStep;
use crate::run::verdict::Miss;

/// The sides of an instant.
const BEFORE: usize = 0;
const AFTER: usize = 1;

impl Run<'_> {
    pub(super) fn sample_time(&self) -> f64 {
        let span = [self.equations.scene.initial.time, self.equations.scene.end_time];
        let (listed, samples) = (self.recorder.output_times(), self.options.samples);
        OutputTimes::nth(listed, samples, span, self.next_sample)
    }

    /// Records the output times before `until` (and not in its instant) from dense output over
    /// a step of length `full`.
    pub(super) fn sample_within(&mut self, full: f64, until: f64) -> Result<(), SimError> {
        while self.is_before(self.sample_time(), until) {
            let time = self.sample_time();
            self.variables.resize(self.equations.variables.layout.len(), 0.0);
            let fraction = (time - self.stepper.window().time) / full;
            self.stepper.interpolate(fraction, self.variables);
            self.equations.read(time, self.variables, self.shown);
            let found = self.shown.invariants(&mut self.equations.entered.dynamics);
            self.sample(&found)?;
        }
        Ok(())
    }

    /// Notes how near hinges have come to their lock angles in the step just taken, whose dense output is over a
    /// step of length `full`.
    pub(super) fn note_misses(&mut self, full: f64) {
        let Self { situation, equations, stepper, summary, .. } = self;
        let (start, length) = (stepper.window().time, stepper.window().length());
        for (hinge, [fraction, by]) in situation.guards.nearest(equations, length / full) {
            let time = start + fraction * full;
            summary.verdict.note_distance(hinge, Miss { by, time });
        }
    }

    /// Shows the recorder the step just taken, whose dense output is over a step of length `full`.
    pub(super) fn tell_step(&mut self, full: f64) -> Result<(), SimError> {
        if !self.recorder.needs_steps() {
            return Ok(());
        }
        let goes_on = !std::mem::replace(&mut self.begins_anew, false);
        let Self { situation, equations, stepper, room, recorder, .. } = self;
        let mode = (&*situation.mode.hinges, goes_on);
        let time = stepper.window().end_time;
        let mut step = DenseStep::new(mode, equations, *stepper, full, room);
        recorder.step(&mut step).map_err(|source| SimError::Record { time, source })
    }

    /// Records the output time that the present instant coincides with, if there is one.
    pub(super) fn sample_here(&mut self) -> Result<(), SimError> {
        while !self.is_before(self.situation.state.time, self.sample_time()) {
            let time = self.sample_time();
            let found = self.show_present();
            self.shown.time = time;
            self.sample(&found)?;
        }
        Ok(())
    }

    /// Shows the present state; returns its energy and momenta.
    pub(super) fn show_present(&mut self) -> Invariants<f64> {
        self.shown.copy_from(&self.situation.state);
        self.invariants()
    }

    /// Records an output time at the state shown, whose energy and momenta are `found`.
    fn sample(&mut self, found: &Invariants<f64>) -> Result<(), SimError> {
        let time = self.shown.time;
        self.check_interrupt(time)?;
        self.next_sample += 1;
        self.look(found)?;
        let kept = self.recorder.sample(self.seen);
        kept.map_err(|source| SimError::Record { time, source })
    }

    /// Enters the state shown in the ledger and sees all of it that the recorder wants.
    fn look(&mut self, found: &Invariants<f64>) -> Result<(), SimError> {
        let account = self.ledger.check(self.equations, self.shown, found)?;
        self.unseen_steps = 0;
        self.see(found, self.recorder.needs_detail(), None)?;
        self.seen.account = Some(account);
        Ok(())
    }

    /// Sees the state shown, whose energy and momenta are `found`, on one side of an instant if `side` says so.
    pub(super) fn see(
        &mut self,
        found: &Invariants<f64>,
        detailed: bool,
        side: Option<usize>,
    ) -> Result<(), SimError> {
        let Self { situation, equations, shown, seen, sides, room, .. } = self;
        let seen = match side {
            Some(side) => &mut sides[side],
            None => &mut **seen,
        };
        snapshot::write(&equations.scene, &situation.mode, shown, found, seen);
        if detailed {
            let detail = seen.detail.get_or_insert_with(Detail::empty);
            snapshot::write_detail(equations, shown, found.mass_center, room, detail);
        } else {
            seen.detail = None;
        }
        seen.account = None;
        let (scene, window) = (&equations.scene, self.stepper.window());
        seen.steps = window.counts.accepted;
        seen.next_step = window.next_step.min(scene.end_time - scene.initial.time);
        finite::check_snapshot(scene, seen)
    }

    /// Sees the present motion in detail, on one side of an instant.
    fn see_side(&mut self, side: usize) -> Result<(), SimError> {
        let found = self.show_present();
        self.see(&found, true, Some(side))
    }

    /// Sees the motion before an instant; returns whether there is one and the recorder wants it.
    pub(super) fn before_instant(&mut self) -> Result<bool, SimError> {
        let is_first = self.situation.is_at_start(&self.equations.scene);
        let has_moved = !is_first || self.situation.arrivals.has_impulses();
        let is_wanted = has_moved && self.recorder.needs_instants();
        if is_wanted {
            self.see_side(BEFORE)?;
        }
        Ok(is_wanted)
    }

    pub(super) fn tell_instant(&mut self, has_before: bool) -> Result<(), SimError> {
        if self.situation.outcome.events.is_empty() || !self.recorder.needs_instants() {
            return Ok(());
        }
        self.see_side(AFTER)?;
        let Self { situation, equations, sides, recorder, .. } = self;
        let jumps: Vec<_> = situation.outcome.jumps(equations.scene.bodies.len()).collect();
        let [before, after] = sides.each_ref().map(|snapshot| {
            let detail = snapshot.detail.as_ref()?;
            Some(Side { snapshot, detail })
        });
        let after = after.expect("sides are seen in detail");
        let before = before.filter(|_| has_before);
        let kept = recorder.instant(&InstantMotion { before, jumps: &jumps, after });
        kept.map_err(|source| SimError::Record { time: situation.state.time, source })
    }

    /// Records the events of the instant just passed.
    pub(super) fn report(&mut self) -> Result<(), SimError> {
        if self.situation.outcome.events.is_empty() {
            return Ok(());
        }
        if let Some(before) = &self.situation.outcome.before_impulses {
            self.ledger.note_motion(before);
        }
        let found = self.show_present();
        self.look(&found)?;
        for event in &self.situation.outcome.events {
            self.summary.events += 1;
            self.summary.verdict.note(&self.equations.scene, event);
            if let (EventKind::Stick | EventKind::Rest, Some(hinge)) = (event.kind, event.hinge) {
                self.summary.verdict.note_stick(
                    &self.equations.scene,
                    hinge,
                    &self.shown.beta,
                    event.time,
                );
            }
            let kept = self.recorder.event(event, self.seen);
            kept.map_err(|source| SimError::Record { time: event.time, source })?;
        }
        Ok(())
    }

    /// Tells the end.
    pub(super) fn finish(&mut self) -> Result<(), SimError> {
        self.summary.runaway = self.runaway();
        let found = self.invariants();
        let now = Totals::of(&self.situation.state, &found);
        let end = Event {
            time: self.situation.state.time,
            kind: EventKind::End,
            hinge: None,
            impulse: None,
            before: now,
            after: now,
        };
        self.situation.outcome.reset();
        self.situation.outcome.events.push(end);
        self.report()
    }
}
