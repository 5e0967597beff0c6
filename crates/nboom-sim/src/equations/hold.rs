//! What may hold a hinge at rest: friction, and stops.

use std::cell::OnceCell;

use nboom_model::Hinge;

use crate::equations::Equations;
use crate::equations::state::State;

/// A hinge slips when more than its friction acts about it, by this share of the friction.
const BEYOND_FRICTION: f64 = 1e-10;

/// A hinge leaves its stop when it is drawn off by this share of what cancels about it.
const OFF_STOP: f64 = 1e-12;

/// The torques that hold a hinge at rest, as shares of a unit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hold {
    pub(super) unit: Unit,
    pub(super) least: f64,
    pub(super) most: f64,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Unit {
    /// The friction.
    Friction(f64),
    /// Of a hinge without friction the sizes of what may cancel: torques, and accelerations by rates and gravity.
    Sizes { torque: f64, acceleration: f64 },
}

impl Hold {
    /// What friction and stops bear about a hinge at an angle. Where it has no friction, the sizes of a torque and an
    /// acceleration tell what is rounding.
    pub fn of(hinge: &Hinge, angle: f64, sizes: impl FnOnce() -> [f64; 2]) -> Self {
        let (unit, friction) = match hinge.friction {
            0.0 => {
                let [torque, acceleration] = sizes();
                (Unit::Sizes { torque, acceleration }, 0.0)
            }
            friction => (Unit::Friction(friction), 1.0),
        };
        let (mut least, mut most) = (-friction, friction);
        match hinge.stops.at(angle) {
            Some(stop) if stop.away > 0.0 => most = f64::INFINITY,
            Some(_) => least = f64::NEG_INFINITY,
            None => {}
        }
        Self { unit, least, most }
    }

    /// The share at which a torque of this sign does not hold the hinge any more.
    pub fn edge(&self, sign: f64) -> f64 {
        if sign > 0.0 { self.most + self.beyond() } else { self.least - self.beyond() }
    }

    /// How far beyond the least and the most the torque is when the hinge moves.
    pub fn beyond(&self) -> f64 {
        match self.unit {
            Unit::Friction(_) => BEYOND_FRICTION,
            Unit::Sizes { .. } => OFF_STOP,
        }
    }

    /// How far a share is inside the least and the most; zero beyond them.
    pub fn margin(&self, share: f64) -> f64 {
        (-self.excess(share)).max(0.0)
    }

    /// How far a share is beyond the least or the most; which is rounding up to half of [`beyond`](Self::beyond).
    pub(super) fn excess(&self, share: f64) -> f64 {
        (share - self.most).max(self.least - share)
    }

    /// The share at which a hinge moves up, or down.
    pub(super) fn moving(&self, up: bool) -> f64 {
        if up { self.least } else { self.most }
    }
}

impl Equations {
    /// What friction and stops bear about these hinges where they are.
    pub fn holds(&self, hinges: &[usize], state: &State) -> Vec<Hold> {
        let Self { scene, gravity, reach, .. } = self;
        let of_all = OnceCell::new();
        let find = || {
            let once = 1.0 / (scene.end_time - scene.initial.time);
            let rate = self.speed(state) + once;
            [self.torque_magnitude(state), rate * rate + gravity.norm() / reach]
        };
        let hold = |&hinge: &usize| {
            let sizes = || {
                let ([torques, accelerations], size) =
                    (of_all.get_or_init(find), scene.coordinate_scale(hinge));
                [torques / size, accelerations * size]
            };
            Hold::of(&scene.bodies[hinge].hinge, state.beta[hinge], sizes)
        };
        hinges.iter().map(hold).collect()
    }

    /// How fast bodies turn, all together. However fast a balanced wheel turns, it accelerates no other body.
    pub fn speed(&self, state: &State) -> f64 {
        let rates = state.tau.iter().enumerate().filter(|(i, _)| !self.is_balanced[*i]);
        let sizes = rates.map(|(i, tau)| tau.abs() / self.scene.coordinate_scale(i));
        state.omega_body.norm() + sizes.sum::<f64>()
    }

    /// Torques about hinges and from outside, each term by its magnitude and times the size of its hinge: an energy.
    /// Friction and the motors of rotors are left out.
    fn torque_magnitude(&self, state: &State) -> f64 {
        let Self { scene, entered, own, reach, .. } = self;
        let State { beta, tau, .. } = state;
        let size = |i: usize| scene.coordinate_scale(i);
        let lengths = |line| state.length_of(&entered.dynamics, line);
        let of_own = own.iter().map(|law| (law.hinge, law.torque(beta[law.hinge], tau[law.hinge])));
        entered.dynamics.elements().magnitude([beta, tau], lengths, size, *reach)
            + of_own.map(|(i, torque)| torque.abs() * size(i)).sum::<f64>()
    }
}
