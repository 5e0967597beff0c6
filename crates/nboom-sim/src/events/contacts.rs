//! The hinges about which impulses act in one instant.

use nboom_dynamics::{ImpulseError, Impulses, Recursive, Struck};
use nboom_model::Scene;
use nboom_scalar::Number;

use crate::equations::state::State;
use crate::events::arrivals::{Arrivals, Impact};
use crate::events::event::EventKind;

/// Share of the largest impulse, or of the fastest rate, below which one is rounding.
const ROUNDING: f64 = 1e-12;

/// Share of the energies that impulses exchange by which rebounds may seem to make some.
const MADE: f64 = 1e-10;

/// Changes for each hinge at a stop, from pressing to not and back, after which the search is given up.
const MOST_CHANGES: usize = 100;

/// Why no impulses are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NoImpulses {
    /// Nothing has inertia about a hinge that is struck.
    Singular,
    /// Rounding hides whether the free hinge at this position presses against its stop.
    Undecided(usize),
}

impl From<ImpulseError> for NoImpulses {
    fn from(_: ImpulseError) -> Self {
        Self::Singular
    }
}

/// The hinges about which impulses act: those that lock, and those that press against their stops.
#[derive(Clone, Debug)]
pub(crate) struct Contacts<R> {
    locking: usize,
    /// Those that lock, and after them those that press.
    struck: Vec<Struck<R>>,
    at_stops: Vec<AtStop<R>>,
    /// The sizes by which rates of the free hinges compare, where some are at stops.
    scales: Vec<f64>,
}

/// A hinge at a stop.
#[derive(Clone, Copy, Debug)]
struct AtStop<R> {
    position: usize,
    /// The sign of the rates that lead away.
    away: f64,
    restitution: f64,
    /// τ after the impulse if its stop presses; if not, it leaves at least so fast.
    after: R,
    presses: bool,
    /// Whether an impulse of either sign keeps it at its stop, since its flight was rounding.
    stays: bool,
}

impl<R: Number> Contacts<R> {
    /// That of no hinge.
    pub fn of_none() -> Self {
        Self { locking: 0, struck: Vec::new(), at_stops: Vec::new(), scales: Vec::new() }
    }

    /// Makes it that of no hinge.
    pub fn clear(&mut self) {
        self.locking = 0;
        self.struck.clear();
        self.at_stops.clear();
        self.scales.clear();
    }

    /// The positions of the hinges about which impulses act, as the impulses are listed, and whether each locks or
    /// presses.
    pub fn struck(&self) -> impl Iterator<Item = (usize, EventKind)> {
        let locks = self.locking;
        let kind = move |k| if k < locks { EventKind::LockUp } else { EventKind::Impact };
        self.struck.iter().enumerate().map(move |(k, of)| (of.position, kind(k)))
    }

    /// The rate after of the free hinge at this position, if an impulse acts about it.
    pub fn after(&self, position: usize) -> Option<R> {
        self.struck.iter().find(|struck| struck.position == position).map(|of| of.after)
    }

    /// Finds the hinges among those that are `free` that lock, come to stops, or rest at them.
    pub fn find(&mut self, scene: &Scene, arrivals: &Arrivals, free: &[usize], state: &State<R>) {
        self.clear();
        let Self { locking, struck, at_stops, scales } = self;
        let position = |hinge: usize| free.iter().position(|&i| i == hinge);
        let locks = arrivals.locks().iter().filter_map(|&i| position(i));
        struck.extend(locks.map(Struck::locks));
        *locking = struck.len();
        let at_stop = |position, away, restitution, stays| {
            let (after, presses) = (R::zero(), false);
            AtStop { position, away, restitution, after, presses, stays }
        };
        at_stops.extend(arrivals.impacts().iter().filter_map(|impact| {
            let Impact { hinge, stop, restitution, stays } = *impact;
            Some(at_stop(position(hinge)?, stop.away, restitution, stays))
        }));
        // Impacts that are rounding send no other hinge off: two would send each other off for ever.
        let all_stay =
            arrivals.locks().is_empty() && arrivals.impacts().iter().all(|impact| impact.stays);
        for (position, &i) in free.iter().enumerate() {
            let stop = scene.bodies[i].hinge.stops.at(state.beta[i].to_f64());
            let rests = stop.filter(|_| state.tau[i] == R::zero());
            let Some(stop) = rests.filter(|_| !arrivals.locks().contains(&i)) else { continue };
            if at_stops.iter().all(|of| of.position != position) {
                at_stops.push(at_stop(position, stop.away, 0.0, all_stay));
            }
        }
        if !at_stops.is_empty() {
            scales.extend(free.iter().map(|&i| scene.coordinate_scale(i)));
        }
    }

    /// Finds the impulses. Lock-ups come first, and hinges rebound by the rates that these leave. Stops only press: a
    /// hinge on which no impulse acts leaves at least as fast as its restitution says (Newton). Where rebounds would make
    /// energy, as they may if they press hinges back that a lock-up sends off, there are none.
    ///
    /// # Errors
    /// Where no impulses are found.
    pub fn strike(
        &mut self,
        dynamics: &mut Recursive<R>,
        state: &mut State<R>,
        impulses: &mut Impulses<R>,
    ) -> Result<(), NoImpulses> {
        let motion = state.motion(dynamics);
        dynamics.strike(motion.beta, motion.tau, &self.struck, impulses)?;
        if self.at_stops.is_empty() {
            return Ok(());
        }
        for of in &mut self.at_stops {
            let comes = motion.tau[of.position] + impulses.delta_tau[of.position];
            of.presses = comes.to_f64() * of.away < 0.0;
            let share = if of.presses && !of.stays { -of.restitution } else { 0.0 };
            of.after = comes * R::constant(share);
        }
        let fastest = self.fastest(motion.tau, impulses);
        for of in &mut self.at_stops {
            let comes = motion.tau[of.position] + impulses.delta_tau[of.position];
            of.presses &= comes.to_f64().abs() > ROUNDING * fastest * self.scales[of.position];
            of.presses |= of.stays;
        }
        let after_locks = impulses.delta_energy.to_f64();
        self.press(dynamics, motion.beta, motion.tau, impulses)?;
        let sizes = self.struck.iter().zip(&impulses.torques).map(|(of, torque)| {
            let rates = motion.tau[of.position].to_f64().abs() + of.after.to_f64().abs();
            torque.to_f64().abs() * rates
        });
        if impulses.delta_energy.to_f64() - after_locks > MADE * sizes.sum::<f64>() {
            self.at_stops.iter_mut().for_each(|of| of.after = R::zero());
            self.press(dynamics, motion.beta, motion.tau, impulses)?;
        }
        Ok(())
    }

    /// Finds which hinges at stops press, from those that do at first: a linear complementarity problem, by principal
    /// pivoting. One hinge at a time changes between pressing and not, always the first that is wrong, so that no set
    /// comes back (Murty).
    fn press(
        &mut self,
        dynamics: &mut Recursive<R>,
        beta: &[R],
        tau: &[R],
        impulses: &mut Impulses<R>,
    ) -> Result<(), NoImpulses> {
        let mut changes = 0..MOST_CHANGES * self.at_stops.len();
        loop {
            self.struck.truncate(self.locking);
            let pressing = self.at_stops.iter().filter(|of| of.presses);
            self.struck
                .extend(pressing.map(|of| Struck { position: of.position, after: of.after }));
            dynamics.strike(beta, tau, &self.struck, impulses)?;
            let Some(wrong) = self.wrong(tau, impulses) else { return Ok(()) };
            let wrong = &mut self.at_stops[wrong];
            changes.next().ok_or(NoImpulses::Undecided(wrong.position))?;
            wrong.presses ^= true;
        }
    }

    /// The fastest of the rates that are there or change, in sizes per time unit.
    fn fastest(&self, tau: &[R], impulses: &Impulses<R>) -> f64 {
        let rates = tau.iter().zip(&impulses.delta_tau).zip(&self.scales);
        let sizes = rates
            .map(|((tau, change), scale)| tau.to_f64().abs().max(change.to_f64().abs()) / scale);
        sizes.fold(0.0, f64::max)
    }

    /// The first hinge at a stop that would be drawn to it by its impulse, or goes beyond it without one.
    fn wrong(&self, tau: &[R], impulses: &Impulses<R>) -> Option<usize> {
        let torques = impulses.torques.iter().map(|torque| torque.to_f64());
        let largest = torques.clone().fold(0.0_f64, |most, torque| most.max(torque.abs()));
        let fastest = self.fastest(tau, impulses);
        let mut pressing = torques.skip(self.locking);
        self.at_stops.iter().position(|of| {
            if of.presses {
                let presses = pressing.next().is_none_or(|p| p * of.away >= -ROUNDING * largest);
                return !(presses || of.stays);
            }
            let rate = tau[of.position] + impulses.delta_tau[of.position];
            let beyond = (rate - of.after).to_f64() * of.away;
            beyond < -ROUNDING * fastest * self.scales[of.position]
        })
    }
}
