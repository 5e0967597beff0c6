//! Hinges that friction stops and holds.
//!
//! A hinge that sticks is held, as a locked one is, until the torque that holds it is more than its friction
//! ([slip.rs](super::slip)). When something happens, all hinges that do not move are looked at together, after
//! everything else.

use nboom_elements::Kind;
use nboom_model::{HingeState, Mode, Scene, piece_of_friction};

use super::Run;
use crate::equations::at_rest::Onset;
use crate::equations::totals::Totals;
use crate::events::event::{Event, EventKind};
use crate::events::situation::Situation;

/// Share of the fastest rate at which a hinge counts as one that does not move.
const AT_REST: f64 = 1e-11;

/// The hinges with friction, and what is known of them.
#[derive(Debug, Default)]
pub(crate) struct Friction {
    /// All of the scene, ascending.
    pub hinges: Vec<usize>,
    /// How each was before the present instant: its state and the piece of its friction.
    before: Vec<(HingeState, usize)>,
    resting: Vec<usize>,
}

impl Friction {
    /// At the beginning of a run of `scene`.
    pub fn begin(&mut self, scene: &Scene) {
        self.hinges.clear();
        self.hinges.extend(scene.hinges_with_friction());
    }

    /// Whether it holds a hinge in `mode`.
    pub fn holds(&self, mode: &Mode) -> bool {
        self.hinges.iter().any(|&i| mode.hinges[i] == HingeState::Stuck)
    }

    /// Whether no hinge has friction.
    pub fn is_none(&self) -> bool {
        self.hinges.is_empty()
    }
}

impl Run<'_> {
    /// Notes how the hinges with friction are before an instant, and brings those to rest that come to it. Friction
    /// bears no impulse: where a hinge locks, those that stick are free.
    pub(super) fn loosen(&mut self) {
        if self.friction.is_none() {
            return;
        }
        let Self { friction, situation, equations, invariants, .. } = self;
        let Situation { state, mode, arrivals, .. } = &mut **situation;
        equations.book_friction(state);
        let pieces = &mode.pieces[equations.scene.friction_pieces()];
        let of = |(&i, &piece): (&usize, &usize)| (mode.hinges[i], piece);
        friction.before.clear();
        friction.before.extend(friction.hinges.iter().zip(pieces).map(of));
        for &i in arrivals.stops() {
            state.tau[i] = 0.0;
            *invariants = None;
        }
        if !arrivals.locks().is_empty() && friction.holds(mode) {
            for &i in &friction.hinges {
                if mode.hinges[i] == HingeState::Stuck {
                    mode.hinges[i] = HingeState::Free;
                }
            }
            equations.go_to(mode, state);
        }
    }

    /// Finds which hinges stick after an instant, and which way the others move.
    pub(super) fn settle_friction(&mut self) {
        if self.friction.is_none() {
            return;
        }
        let slow = AT_REST * self.equations.fastest();
        let Self { friction, situation, equations, .. } = self;
        let Situation { state, mode, outcome, .. } = &mut **situation;
        let first = equations.scene.friction_pieces().start;
        friction.resting.clear();
        for (k, &i) in friction.hinges.iter().enumerate() {
            let is_loose = matches!(mode.hinges[i], HingeState::Free | HingeState::Stuck);
            if is_loose {
                mode.hinges[i] = HingeState::Free;
                if state.tau[i].abs() <= slow * equations.scene.coordinate_scale(i) {
                    state.tau[i] = 0.0;
                    friction.resting.push(i);
                }
            }
            mode.pieces[first + k] = piece_of_friction(if is_loose { state.tau[i] } else { 0.0 });
        }
        outcome.gradual.clear();
        if friction.resting.is_empty() {
            return;
        }
        // Where nothing has inertia about a hinge, none sticks, and the mode is refused; so it is where friction is
        // nothing beside what acts, which goes on without it.
        let onsets = equations.at_rest(state, mode, &friction.resting).onsets();
        for (&i, onset) in friction.resting.iter().zip(onsets.unwrap_or_default()) {
            match onset {
                Onset::Sticks => mode.hinges[i] = HingeState::Stuck,
                Onset::Moves { up, gradually } => {
                    let place = friction.hinges.binary_search(&i);
                    let place = place.expect("hinges at rest are among those with friction");
                    mode.pieces[first + place] = usize::from(up);
                    outcome.gradual.extend(gradually.then_some(i));
                }
            }
        }
    }

    /// Looks again at the hinges with friction after a control law has changed what it commands.
    pub(super) fn settle_commanded(&mut self) {
        if self.friction.is_none() {
            return;
        }
        self.settle_friction();
        let Self { situation, equations, variables, .. } = self;
        let Situation { state, mode, .. } = &mut **situation;
        equations.enter(mode, state, variables);
    }

    /// Adds to the events of the present instant what friction has changed; a run `begins` with hinges that never
    /// moved.
    pub(super) fn tell_friction(&mut self, begins: bool) {
        if self.friction.is_none() {
            return;
        }
        let found = self.invariants();
        let Self { friction, situation, equations, .. } = self;
        let Situation { state, mode, outcome, .. } = &mut **situation;
        let pieces = &mode.pieces[equations.scene.friction_pieces()];
        let totals = Totals::of(state, &found);
        for ((&i, &(was, before)), &now) in friction.hinges.iter().zip(&friction.before).zip(pieces)
        {
            let kind = match (was, mode.hinges[i]) {
                (HingeState::Stuck, HingeState::Stuck) => continue,
                (HingeState::Stuck, HingeState::Free) => EventKind::Slip,
                (_, HingeState::Stuck) => EventKind::Stick,
                (HingeState::Free, HingeState::Free) if now != before && !begins => match now {
                    0 => EventKind::Fall(Kind::Friction),
                    _ => EventKind::Rise(Kind::Friction),
                },
                _ => continue,
            };
            let (time, hinge) = (state.time, Some(i));
            let event = Event { time, kind, hinge, impulse: None, before: totals, after: totals };
            outcome.events.push(event);
        }
    }
}
