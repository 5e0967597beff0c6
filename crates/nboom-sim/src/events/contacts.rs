//! About which hinges impulses act in one instant.

use nboom_dynamics::{Impulses, Recursive, Struck};
use nboom_model::Scene;
use nboom_scalar::Number;

use crate::equations::state::State;
use crate::events::arrivals::Arrivals;
use crate::events::event::EventKind;

/// Share of the largest impulse, or of the rates that add up, below which one is rounding.
const ROUNDING: f64 = 1e-12;

/// Times that each hinge at a stop may begin or end to press against it, before what was found counts.
const MOST_CHANGES: usize = 100;

/// The hinges about which impulses act: those that lock, and those that press against their stops.
#[derive(Clone, Debug, Default)]
pub(crate) struct Contacts {
    locking: usize,
    /// Those that lock, and after them those that press.
    struck: Vec<Struck>,
    at_stops: Vec<AtStop>,
}

/// A hinge at a stop.
#[derive(Clone, Copy, Debug)]
struct AtStop {
    struck: Struck,
    /// The sign of the rates that lead away.
    away: f64,
    presses: bool,
}

impl Contacts {
    /// Makes it that of no hinge.
    pub fn clear(&mut self) {
        self.locking = 0;
        self.struck.clear();
        self.at_stops.clear();
    }

    /// The positions of the hinges about which impulses act, as the impulses are listed, and whether each locks or
    /// presses.
    pub fn struck(&self) -> impl Iterator<Item = (usize, EventKind)> {
        let locks = self.locking;
        let kind = move |k| if k < locks { EventKind::LockUp } else { EventKind::Impact };
        self.struck.iter().enumerate().map(move |(k, of)| (of.position, kind(k)))
    }

    /// The share of its rate at which the `free` hinge at this position rebounds, if an impulse acts about it.
    pub fn restitution(&self, position: usize) -> Option<f64> {
        self.struck.iter().find(|struck| struck.position == position).map(|of| of.restitution)
    }

    /// Finds the hinges among those that are `free` that lock, come to stops, or rest at them.
    pub fn find<R: Number>(
        &mut self,
        scene: &Scene,
        arrivals: &Arrivals,
        free: &[usize],
        state: &State<R>,
    ) {
        self.clear();
        let Self { locking, struck, at_stops } = self;
        let position = |hinge: usize| free.iter().position(|&i| i == hinge);
        let locks = arrivals.locks().iter().filter_map(|&i| position(i));
        struck.extend(locks.map(Struck::locks));
        *locking = struck.len();
        at_stops.extend(arrivals.impacts().iter().filter_map(|impact| {
            let struck =
                Struck { position: position(impact.hinge)?, restitution: impact.restitution };
            Some(AtStop { struck, away: impact.stop.away, presses: true })
        }));
        for (position, &i) in free.iter().enumerate() {
            let stop = scene.bodies[i].hinge.stops.at(state.beta[i].to_f64());
            let rests = stop.filter(|_| state.tau[i] == R::zero());
            let Some(stop) = rests.filter(|_| !arrivals.locks().contains(&i)) else { continue };
            if at_stops.iter().all(|of| of.struck.position != position) {
                let struck = Struck { position, restitution: 0.0 };
                at_stops.push(AtStop { struck, away: stop.away, presses: false });
            }
        }
    }

    /// Finds the impulses, which at stops only press: a hinge on which none acts rebounds at least as fast as by its
    /// restitution (Newton). As in [`AtRest::onsets`](crate::equations::at_rest::AtRest), hinges begin and end to press
    /// one at a time, each time the first that is wrong, so that no set of them comes back.
    ///
    /// # Errors
    /// The position of the first hinge that is struck, where nothing has inertia about one.
    pub fn strike<R: Number>(
        &mut self,
        dynamics: &mut Recursive<R>,
        state: &mut State<R>,
        impulses: &mut Impulses<R>,
    ) -> Result<(), Option<usize>> {
        let motion = state.motion(dynamics);
        for _ in 0..MOST_CHANGES * self.at_stops.len() + 1 {
            self.struck.truncate(self.locking);
            let pressing = self.at_stops.iter().filter(|of| of.presses);
            self.struck.extend(pressing.map(|of| of.struck));
            let first = self.struck.first().map(|of| of.position);
            let found = dynamics.strike(motion.beta, motion.tau, &self.struck, impulses);
            found.map_err(|_| first)?;
            match self.wrong(motion.tau, impulses) {
                Some(wrong) => self.at_stops[wrong].presses ^= true,
                None => break,
            }
        }
        Ok(())
    }

    /// The first hinge at a stop that would be drawn to it by its impulse, or goes beyond it without one.
    fn wrong<R: Number>(&self, tau: &[R], impulses: &Impulses<R>) -> Option<usize> {
        let torques = impulses.torques.iter().map(|torque| torque.to_f64());
        let largest = torques.clone().fold(0.0_f64, |most, torque| most.max(torque.abs()));
        let mut at_stops = torques.skip(self.locking);
        self.at_stops.iter().position(|of| {
            let Struck { position, restitution } = of.struck;
            if of.presses {
                return at_stops.next().is_some_and(|p| p * of.away < -ROUNDING * largest);
            }
            let [before, change] =
                [tau[position], impulses.delta_tau[position]].map(|rate| rate.to_f64());
            let beyond = (before + change + restitution * before) * of.away;
            beyond < -ROUNDING * (before.abs() + change.abs())
        })
    }
}
