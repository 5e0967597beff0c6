//! When a motion runs away: its energy grows beyond all that the scene has, and its end is out of reach.

use nboom_dynamics::Invariants;
use nboom_elements::{HingeLaw, stored};
use nboom_model::Scene;

use super::Run;
use crate::error::{Feeds, Runaway, SimError};
use crate::events::situation::Situation;

/// Kinetic energy beyond this many times what the scene has is fed without end: rates have grown a
/// hundredfold.
const GROWTH: f64 = 1e4;

/// Steps to the end at the present pace from which on such a motion is given up.
const TOO_FAR: f64 = 1e5;

/// Steps after which the energy is looked at again.
const INTERVAL: usize = 256;

/// What growth is measured by.
#[derive(Clone, Copy, Debug)]
pub(super) struct Resources {
    /// The kinetic energy about the mass centre at the initial time, and what springs store.
    energy: f64,
    /// The energy of rotors at the initial time, which their motors change.
    rotor_energy: f64,
    /// Number of steps when the motion was last looked at.
    looked_at: usize,
}

impl Resources {
    /// At the initial time, with these energies and momenta.
    pub fn of(scene: &Scene, invariants: &Invariants<f64>) -> Self {
        let energy = stored(scene) + turning(scene, invariants);
        Self { energy, rotor_energy: invariants.rotor_energy, looked_at: 0 }
    }
}

/// Kinetic energy about the mass centre.
fn turning(scene: &Scene, found: &Invariants<f64>) -> f64 {
    found.kinetic_energy - 0.5 * found.linear_momentum.norm_squared() / scene.total_mass()
}

impl Run<'_> {
    /// Gives up a motion that runs away and whose end is too far at its pace.
    pub(super) fn check_growth(&mut self) -> Result<(), SimError> {
        let window = self.stepper.window();
        let steps = window.counts.accepted + window.counts.rejected;
        if steps - self.resources.looked_at < INTERVAL {
            return Ok(());
        }
        self.resources.looked_at = steps;
        let is_far = self.equations.scene.end_time - window.time > TOO_FAR * window.next_step;
        match self.runaway().filter(|_| is_far) {
            Some(runaway) => Err(SimError::Runaway { time: self.situation.state.time, runaway }),
            None => Ok(()),
        }
    }

    /// That the motion runs away, if it does, and what feeds it most. Laws of a program's own may
    /// feed it as they like.
    pub(super) fn runaway(&mut self) -> Option<Runaway> {
        if self.sampling.is_some() || !self.equations.own.is_empty() {
            return None;
        }
        let found = self.invariants();
        let Self { situation: Situation { state, .. }, equations, .. } = self;
        let scene = &equations.scene;
        let Resources { energy, rotor_energy, .. } = self.resources;
        let motors = found.rotor_energy - rotor_energy + state.work.spin_up;
        let had = energy + state.work.thrust.abs() + motors.abs();
        let growth = turning(scene, &found) / had;
        if growth.is_nan() || growth <= GROWTH {
            return None;
        }
        let elements = equations.entered.dynamics.elements();
        let laws = || elements.torques().iter().enumerate();
        // A torque that stays the same is a motor's: rates grow with time, and not with themselves.
        let has_motor = |i: usize| {
            let mut tables = scene.torque_tables.iter().filter(|table| table.hinge == i);
            tables.any(|table| table.is_level_beyond(state.beta[i]))
        };
        let from_spring = laws().map(|(i, law)| {
            let hinge = &scene.bodies[i].hinge;
            let spring = HingeLaw::<f64>::new(&hinge.spring, &hinge.dashpot);
            let [before, now] = [hinge.start.angle, state.beta[i]];
            let by_spring = spring.potential(before) - spring.potential(now);
            if has_motor(i) {
                return (i, by_spring, Feeds::Spring);
            }
            let fed = law.potential(before) - law.potential(now);
            // The rest is of the table.
            let feeds = if by_spring < 0.5 * fed { Feeds::Table } else { Feeds::Spring };
            (i, fed, feeds)
        });
        // Runs with a motor come here again and again, and allocate nothing if they have no couplings.
        let at_start: Vec<f64> = match scene.couplings.is_empty() {
            true => Vec::new(),
            false => scene.bodies.iter().map(|body| body.hinge.start.angle).collect(),
        };
        let potentials = |beta| elements.coupling_potentials(beta);
        let by_coupling = potentials(&at_start)
            .zip(potentials(&state.beta))
            .map(|((i, before), (_, now))| (i, before - now, Feeds::Coupling));
        let from_dashpot = laws()
            .map(|(i, law)| (i, law.rate_torque(state.tau[i]) * state.tau[i], Feeds::Dashpot));
        let by_damping = elements
            .coupling_powers([&state.beta, &state.tau])
            .map(|(i, power)| (i, power, Feeds::Coupling));
        let larger = |a: &(usize, f64, Feeds), b: &(usize, f64, Feeds)| a.1.total_cmp(&b.1);
        let (spring, from_spring, by_spring) = from_spring.chain(by_coupling).max_by(larger)?;
        let (dashpot, _, by_dashpot) = from_dashpot.chain(by_damping).max_by(larger)?;
        let (fed, hinge, feeds) = if state.work.dashpots > from_spring {
            (state.work.dashpots, dashpot, by_dashpot)
        } else {
            (from_spring, spring, by_spring)
        };
        // Else gravity has, as it feeds a pendulum on the ground that falls from rest.
        let is_fed = fed > GROWTH * had;
        is_fed.then(|| Runaway { hinge: scene.label(hinge), feeds, growth })
    }
}
