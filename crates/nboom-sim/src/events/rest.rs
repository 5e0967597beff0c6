//! Hinges at rest that friction or stops hold.
//!
//! A hinge that sticks is held, as a locked one is, until the torque that holds it is more than its friction, or of
//! the sign that its stop does not bear; the main loop finds when. When something happens, all hinges that do not move
//! are looked at together, after everything else.

use nboom_elements::Kind;
use nboom_model::{Body, HingeState, Mode, Scene, piece_of_friction};

use crate::equations::Equations;
use crate::equations::at_rest::{Onset, Undecided};
use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::events::arrivals::Impact;
use crate::events::event::{Event, EventKind};
use crate::events::situation::Situation;

/// Share of the fastest rate at which a hinge counts as one that does not move.
const AT_REST: f64 = 1e-11;

/// Share of the rate of its fastest impact so far below which a hinge does not rebound.
const LAST_REBOUND: f64 = 1e-3;

/// Share of the rates of all bodies below which no hinge rebounds.
const NO_REBOUND: f64 = 1e-7;

/// Height of a flight from a stop and back, as a share of the hinge's size, up to which it is rounding.
const NO_FLIGHT: f64 = 1e-14;

/// The hinges that may stick, and what is known of them.
#[derive(Debug, Default)]
pub(crate) struct Rest {
    /// All of the scene, ascending.
    hinges: Vec<Sticky>,
    resting: Vec<usize>,
    /// The one that was to move where the last step ended, if one was.
    pub slipped: Option<usize>,
}

/// A hinge that may stick.
#[derive(Clone, Copy, Debug)]
struct Sticky {
    hinge: usize,
    /// The place of its friction among the pieces of a mode, if it has friction.
    piece: Option<usize>,
    /// How it was before the present instant.
    before: Before,
    /// The largest rate at which it has come to a stop.
    fastest_impact: f64,
    /// The last instant at which it was at one.
    last_at_stop: f64,
}

/// How a hinge was that may stick.
#[derive(Clone, Copy, Debug)]
struct Before {
    state: HingeState,
    /// The piece of its friction.
    piece: usize,
    is_at_stop: bool,
}

impl Rest {
    /// At the beginning of a run of `scene`.
    pub fn begin(&mut self, scene: &Scene) {
        let mut pieces = scene.friction_pieces();
        let sticky = |(hinge, body): (usize, &Body)| {
            let piece = (body.hinge.friction > 0.0).then(|| pieces.next()).flatten();
            let before = Before { state: body.hinge.start.state, piece: 0, is_at_stop: false };
            let (fastest_impact, last_at_stop) = (0.0, f64::NEG_INFINITY);
            body.hinge.may_stick().then_some(Sticky {
                hinge,
                piece,
                before,
                fastest_impact,
                last_at_stop,
            })
        };
        self.slipped = None;
        self.hinges.clear();
        self.hinges.extend(scene.bodies.iter().enumerate().filter_map(sticky));
    }

    /// Whether a hinge sticks in `mode`.
    pub fn holds(&self, mode: &Mode) -> bool {
        self.hinges.iter().any(|of| mode.hinges[of.hinge] == HingeState::Stuck)
    }

    /// Whether no hinge may stick.
    pub fn is_none(&self) -> bool {
        self.hinges.is_empty()
    }

    /// The hinges that stick in `mode`, ascending.
    pub fn stuck(&self, mode: &Mode) -> Vec<usize> {
        let is_stuck = |&i: &usize| mode.hinges[i] == HingeState::Stuck;
        self.hinges.iter().map(|of| of.hinge).filter(is_stuck).collect()
    }

    /// The torques that hold the hinges `stuck` at `state` in `mode`, which is that of `equations`, as shares of their
    /// units.
    pub fn holding(
        &self,
        equations: &mut Equations,
        mode: &Mode,
        state: &mut State,
        stuck: &[usize],
    ) -> Vec<f64> {
        let mut loose = mode.clone();
        for of in self.hinges.iter().filter(|of| mode.hinges[of.hinge] == HingeState::Stuck) {
            loose.hinges[of.hinge] = HingeState::Free;
            if let Some(piece) = of.piece {
                loose.pieces[piece] = piece_of_friction(0.0);
            }
        }
        let shares = equations.at_rest(state, &loose, stuck).holding();
        equations.go_to(mode, state);
        shares
    }

    /// Notes how the hinges that may stick are before an instant, and brings those to rest that come to it. Where
    /// impulses act, those that stick are set free: friction bears no impulse, and stops are solved together.
    pub fn loosen(&mut self, equations: &mut Equations, situation: &mut Situation<f64>) {
        if self.is_none() {
            return;
        }
        let Situation { state, mode, .. } = &mut *situation;
        equations.book_friction(state);
        for of in &mut self.hinges {
            let piece = of.piece.map_or(0, |piece| mode.pieces[piece]);
            let stops = &equations.scene.bodies[of.hinge].hinge.stops;
            let is_at_stop = stops.at(state.beta[of.hinge]).is_some();
            of.before = Before { state: mode.hinges[of.hinge], piece, is_at_stop };
        }
        situation.halt();
        let Situation { state, mode, arrivals, .. } = situation;
        let speed = equations.speed(state);
        for Impact { hinge, stop, restitution, stays } in arrivals.impacts_mut() {
            let Some(of) = self.hinges.iter_mut().find(|of| of.hinge == *hinge) else { continue };
            let (rate, scale) = (state.tau[*hinge], equations.scene.coordinate_scale(*hinge));
            // The top of a parabola that comes back at this rate.
            let height = 0.25 * rate.abs() * (state.time - of.last_at_stop);
            *stays = rate * stop.away >= 0.0 || height <= NO_FLIGHT * scale;
            of.fastest_impact = of.fastest_impact.max(rate.abs());
            let slow = (NO_REBOUND * speed * scale).max(LAST_REBOUND * of.fastest_impact);
            if *stays || *restitution * rate.abs() <= slow {
                *restitution = 0.0;
            }
        }
        if arrivals.has_impulses() && self.holds(mode) {
            for of in &self.hinges {
                if mode.hinges[of.hinge] == HingeState::Stuck {
                    mode.hinges[of.hinge] = HingeState::Free;
                }
            }
            equations.go_to(mode, state);
        }
    }

    /// Finds which hinges stick after an instant, and which way the others move.
    ///
    /// # Errors
    /// When that cannot be told.
    pub fn find_sticking(
        &mut self,
        equations: &mut Equations,
        situation: &mut Situation<f64>,
    ) -> Result<(), SimError> {
        if self.is_none() {
            return Ok(());
        }
        let slow = AT_REST * equations.fastest();
        let Self { hinges, resting, .. } = self;
        let Situation { state, mode, outcome, .. } = situation;
        resting.clear();
        for &Sticky { hinge: i, piece, .. } in &*hinges {
            let is_loose = matches!(mode.hinges[i], HingeState::Free | HingeState::Stuck);
            if is_loose {
                mode.hinges[i] = HingeState::Free;
                let is_slow = state.tau[i].abs() <= slow * equations.scene.coordinate_scale(i);
                let is_at_stop =
                    || equations.scene.bodies[i].hinge.stops.at(state.beta[i]).is_some();
                if is_slow && (piece.is_some() || is_at_stop()) {
                    state.tau[i] = 0.0;
                    resting.push(i);
                }
            }
            if let Some(piece) = piece {
                mode.pieces[piece] = piece_of_friction(if is_loose { state.tau[i] } else { 0.0 });
            }
        }
        outcome.gradual.clear();
        if resting.is_empty() {
            return Ok(());
        }
        let onsets = equations.at_rest(state, mode, resting).onsets().map_err(|Undecided(i)| {
            let hinge = Some(equations.scene.label(resting[i]));
            SimError::Undecided { time: state.time, hinge }
        })?;
        // There are no onsets in two cases. A hinge has no inertia: `check_regular` refuses the mode. Friction is lost in
        // the rounding of what acts: the hinges move as if there were none.
        let onsets = onsets.unwrap_or_default();
        for (&i, onset) in resting.iter().zip(onsets) {
            match onset {
                Onset::Sticks => mode.hinges[i] = HingeState::Stuck,
                Onset::Moves { up, gradually } => {
                    let of = hinges.iter().find(|of| of.hinge == i);
                    if let Some(piece) = of.and_then(|of| of.piece) {
                        mode.pieces[piece] = usize::from(up);
                    }
                    outcome.gradual.extend(gradually.then_some(i));
                }
            }
        }
        Ok(())
    }

    /// Adds to the events of the present instant what friction and stops have changed.
    pub fn tell(&mut self, equations: &mut Equations, situation: &mut Situation<f64>) {
        if self.is_none() {
            return;
        }
        // Before it no hinge has moved.
        let begins = situation.is_at_start(&equations.scene);
        let found = situation.invariants(&mut equations.entered.dynamics);
        let Situation { state, mode, outcome, .. } = situation;
        let totals = Totals::of(state, &found);
        for of in &mut self.hinges {
            let &mut Sticky { hinge: i, piece, before, .. } = of;
            let now = piece.map_or(0, |piece| mode.pieces[piece]);
            let is_at_stop = equations.scene.bodies[i].hinge.stops.at(state.beta[i]).is_some();
            if is_at_stop {
                of.last_at_stop = state.time;
            }
            // The event of the impact says already that it turns.
            let turns = || now != before.piece && !begins && !is_at_stop;
            let kind = match (before.state, mode.hinges[i]) {
                (HingeState::Stuck, HingeState::Stuck) => continue,
                (HingeState::Stuck, HingeState::Free) if before.is_at_stop => EventKind::Leave,
                (HingeState::Stuck, HingeState::Free) => EventKind::Slip,
                (_, HingeState::Stuck) if is_at_stop => EventKind::Rest,
                (_, HingeState::Stuck) => EventKind::Stick,
                (HingeState::Free, HingeState::Free) if turns() => match now {
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
