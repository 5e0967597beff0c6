use nboom_dynamics::{Impulses, Invariants, Recursive, VelocityJump};
use nboom_model::{External, HingeState, Mode, Release, Rotor, SAME_ANGLE, Scene};
use nboom_scalar::Number;

use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::events::arrivals::Arrivals;
use crate::events::bound::Bound;
use crate::events::contacts::{Contacts, NoImpulses};
use crate::events::event::{Event, EventKind, Jump};
use crate::events::guard::GuardKind;
use crate::events::pieces::set_pieces_at_time;
use crate::events::schedule::Schedule;

/// Angle \[rad\] through which the fastest arriving hinge turns in one instant; where it slides,
/// its travel as a share of its stroke; for a line, its change of length as a share of the length
/// at which it arrives.
const ONE_INSTANT: f64 = 1e-11;

/// Spacings of `f64` that an instant lasts at least.
const SPACINGS: f64 = 4.0;

/// Share of the span that an instant lasts at most, however slowly something arrives.
const LONGEST: f64 = 1e-6;

/// How long after the first arrival at `time` an instant lasts, when the fastest to arrive goes at
/// `pace`, radians, strokes or lengths at a bound per time unit; zero where nothing moves.
pub(crate) fn duration(scene: &Scene, time: f64, pace: f64) -> f64 {
    let spacings = SPACINGS * (time.abs().next_up() - time.abs());
    if pace == 0.0 {
        return spacings;
    }
    let longest = LONGEST * (scene.end_time - scene.initial.time);
    (ONE_INSTANT / pace).min(longest).max(spacings)
}

/// The result of an instant: events in the order in which they are reported, and the elements that
/// have just passed a bound of their law, with the bound.
#[derive(Clone, Debug)]
pub(crate) struct Outcome<R> {
    pub events: Vec<Event>,
    crossed: Vec<Bound>,
    /// The hinges at rest that start to move without an acceleration, as friction or a stop lets them go.
    pub gradual: Vec<usize>,
    /// The hinges that become free.
    pub released: Vec<usize>,
    /// The hinges that were free before.
    free: Vec<usize>,
    /// Those of them about which impulses act.
    contacts: Contacts<R>,
    /// Energy and momenta just before impulses.
    pub before_impulses: Option<Invariants<R>>,
    impulses: Impulses<R>,
}

impl<R: Number> Outcome<R> {
    /// That of an instant in which nothing happens.
    pub fn nothing() -> Self {
        Self {
            events: Vec::new(),
            crossed: Vec::new(),
            gradual: Vec::new(),
            released: Vec::new(),
            free: Vec::new(),
            contacts: Contacts::of_none(),
            before_impulses: None,
            impulses: Impulses::of_none(),
        }
    }

    /// Makes it that of an instant in which nothing happens.
    pub fn reset(&mut self) {
        self.events.clear();
        self.crossed.clear();
        self.gradual.clear();
        self.released.clear();
        self.free.clear();
        self.contacts.clear();
        self.before_impulses = None;
        self.impulses.reset(0, 0);
    }

    /// What each impulse changes, for the hinges that were [free](Self::free_before).
    pub fn velocity_jumps(&self) -> impl Iterator<Item = VelocityJump<'_, R>> {
        self.impulses.jumps()
    }

    /// The hinges that were free before impulses.
    pub fn free_before(&self) -> &[usize] {
        &self.free
    }

    /// What each impulse changes, for all hinges.
    pub fn jumps(&self, hinges: usize) -> impl Iterator<Item = Jump> {
        self.contacts.struck().zip(self.impulses.jumps()).map(move |((position, kind), jump)| {
            let mut tau = vec![0.0; hinges];
            for (&i, change) in self.free.iter().zip(jump.tau) {
                tau[i] = change.to_f64();
            }
            let (velocity_body, omega_body) =
                (jump.velocity_body.to_f64(), jump.omega_body.to_f64());
            Jump { hinge: self.free[position], kind, velocity_body, omega_body, tau }
        })
    }

    /// Whether an element has just passed this bound of its law, in either direction.
    pub fn has_crossed(&self, bound: Bound) -> bool {
        let is_it = |crossed: &Bound| {
            crossed.element.index == bound.element.index && crossed.number == bound.number
        };
        self.crossed.iter().any(is_it)
    }

    /// Whether a hinge starts to move without an acceleration.
    pub fn starts_gradually(&self, hinge: usize) -> bool {
        self.gradual.contains(&hinge)
    }

    /// Begins an instant at `time`: notes which hinges are released. Returns whether anything changes.
    pub fn release(
        &mut self,
        scene: &Scene,
        arrivals: &Arrivals,
        schedule: &Schedule<R>,
        mode: &Mode,
        time: f64,
    ) -> bool {
        self.reset();
        let end = time + arrivals.duration();
        let due = |i: &usize| {
            mode.hinges[*i] == HingeState::Unreleased
                && (schedule.releases_by(end, *i) || is_triggered(scene, arrivals, *i))
        };
        self.released.extend((0..scene.bodies.len()).filter(due));
        !(arrivals.is_empty() && self.released.is_empty() && goes_on(scene, mode, end))
    }

    /// Takes `state`, with energy and momenta `found_before`, and `mode` through the instant that
    /// [began](Self::release): lock-ups, then impacts, then releases, then force laws and what acts from outside.
    /// `dynamics` is in the mode before and is left there. Returns energy and momenta after it.
    ///
    /// # Errors
    /// When the impulses of lock-ups and impacts cannot be found.
    pub fn change(
        &mut self,
        scene: &Scene,
        dynamics: &mut Recursive<R>,
        arrivals: &Arrivals,
        state: &mut State<R>,
        mode: &mut Mode,
        found_before: Invariants<R>,
    ) -> Result<Invariants<R>, SimError> {
        let time = state.time.to_f64();
        let end = time + arrivals.duration();
        let before = Totals::of(state, &found_before);
        self.strike(scene, dynamics, arrivals, state, mode)?;
        self.before_impulses = arrivals.has_impulses().then_some(found_before);
        let found = if arrivals.has_impulses() { state.invariants(dynamics) } else { found_before };
        let after = Totals::of(state, &found);
        let Self { events, crossed, released, free, contacts, impulses, .. } = self;
        let event = |kind, hinge, impulse: Option<R>, before: Totals| {
            let impulse = impulse.map(Number::to_f64);
            Event { time, kind, hinge, impulse, before, after }
        };
        for ((position, kind), &impulse) in contacts.struck().zip(&impulses.torques) {
            events.push(event(kind, Some(free[position]), Some(impulse), before));
        }
        for &i in &*released {
            mode.hinges[i] = HingeState::Free;
            events.push(event(EventKind::Release, Some(i), None, after));
        }
        for &bound in arrivals.bounds() {
            let index = bound.element.index;
            mode.pieces[index] = bound.next_piece();
            crossed.push(bound);
            let kind = GuardKind::Bound(bound);
            events.push(event(kind.event(), Some(kind.hinge()), None, after));
        }
        for (one, &piece) in scene.externals.iter().zip(&mode.externals) {
            let before = one.course.acts(piece);
            if one.course.acts(one.course.piece_at(end)) != before {
                let kind = if before { EventKind::ThrustOff } else { EventKind::ThrustOn };
                events.push(event(kind, one.body, None, after));
            }
        }
        set_pieces_at_time(mode, scene, end);
        Ok(found)
    }

    /// Locks hinges and turns back those that come to stops, with the exact change of all velocities.
    fn strike(
        &mut self,
        scene: &Scene,
        dynamics: &mut Recursive<R>,
        arrivals: &Arrivals,
        state: &mut State<R>,
        mode: &mut Mode,
    ) -> Result<(), SimError> {
        if !arrivals.has_impulses() {
            return Ok(());
        }
        let Self { free, contacts, impulses, .. } = self;
        free.extend(dynamics.free_hinges());
        for &i in arrivals.locks() {
            if let Some(angle) = scene.bodies[i].hinge.lock_angle {
                state.beta[i] = R::constant(angle);
            }
        }
        for impact in arrivals.impacts() {
            state.beta[impact.hinge] = R::constant(impact.stop.angle);
        }
        let before = state.held.map(|_| state.invariants(dynamics));
        contacts.find(scene, arrivals, free, state);
        let (time, locks) = (state.time.to_f64(), arrivals.locks().first());
        let first = locks.or(arrivals.impacts().first().map(|impact| &impact.hinge));
        let hinge = first.map(|&i| scene.label(i));
        let found = contacts.strike(dynamics, state, impulses);
        found.map_err(|why| match why {
            NoImpulses::Singular => SimError::Impulse { time, hinge },
            NoImpulses::Undecided(position) => {
                SimError::Undecided { time, hinge: Some(scene.label(free[position])) }
            }
        })?;
        state.omega_body += impulses.delta_omega_body;
        for (position, (&i, &change)) in free.iter().zip(&impulses.delta_tau).enumerate() {
            match contacts.after(position) {
                Some(after) => state.tau[i] = after,
                None => state.tau[i] += change,
            }
        }
        state.work.lock_ups -= impulses.delta_energy;
        for &i in arrivals.locks() {
            mode.hinges[i] = HingeState::Locked;
        }
        state.follow_hinges(dynamics);
        if let Some(before) = before {
            // What moves the main body holds out against the impulse.
            let after = state.invariants(dynamics);
            let force = after.linear_momentum - before.linear_momentum;
            let moment =
                after.angular_momentum_about_origin() - before.angular_momentum_about_origin();
            state.work.thrust += force.dot(after.origin_velocity) + moment.dot(state.omega_body);
        }
        Ok(())
    }
}

/// Whether all that goes by a table over time is in the same piece at `time`.
fn goes_on(scene: &Scene, mode: &Mode, time: f64) -> bool {
    let acts_on = |(one, &piece): (&External, &usize)| one.course.piece_at(time) == piece;
    let turns_on = |(rotor, &piece): (&Rotor, &usize)| rotor.speed.piece_at(time) == piece;
    scene.externals.iter().zip(&mode.externals).all(acts_on)
        && scene.rotors.iter().zip(&mode.rotors).all(turns_on)
        && scene.base.piece_at(time) == mode.drive
}

/// Whether the angle has arrived that releases hinge `i`.
fn is_triggered(scene: &Scene, arrivals: &Arrivals, i: usize) -> bool {
    let locked_at = |hinge: usize, angle: f64| {
        let lock_angle = scene.bodies[hinge].hinge.lock_angle;
        let same = SAME_ANGLE * scene.coordinate_scale(hinge);
        arrivals.locks().contains(&hinge) && lock_angle.is_some_and(|at| (at - angle).abs() <= same)
    };
    match scene.bodies[i].hinge.release {
        Release::Angle { hinge, angle } => arrivals.has_triggered(i) || locked_at(hinge, angle),
        Release::Time(_) | Release::AfterLock { .. } | Release::Never => false,
    }
}
