use nboom_dynamics::Invariants;
use nboom_elements::gravity_potential;
use nboom_scalar::Vec3;

use crate::equations::Equations;
use crate::equations::state::State;
use crate::equations::totals::Totals;
use crate::error::SimError;
use crate::run::account::Account;
use crate::run::conservation::Conservation;
use crate::run::finite::Check;

/// Share of the momentum that the energy could make, below which bodies' own momenta are rounding.
const ROUNDING: f64 = 1e-7;

/// Numbers of the three laws.
#[derive(Default)]
struct Balances {
    linear_momentum: f64,
    angular_momentum: f64,
    energy: f64,
}

/// Keeps account of momentum and energy, and of what should have changed them.
pub(crate) struct Ledger {
    start_time: f64,
    start: Totals,
    start_energy: f64,
    start_rotor_energy: f64,
    /// Largest ones so far.
    residuals: Balances,
    /// Largest ones so far.
    scales: Balances,
    /// The largest angular momentum so far.
    angular_momentum: f64,
    /// The most work so far, whatever its sign.
    work: f64,
    /// Whether what holds the main body changes the momenta.
    held: bool,
    /// Whether nothing but gravity can move the mass centre. Its energy is no matter of the balance then, so that
    /// this does not depend on who looks on.
    falls: bool,
    mass: f64,
    reach: f64,
}

impl Ledger {
    /// At `state`, whose invariants are given; a control law may push the main body.
    pub fn new(
        equations: &Equations,
        state: &State,
        invariants: &Invariants<f64>,
        is_controlled: bool,
    ) -> Self {
        let start = Totals::of(state, invariants);
        let is_pushed = is_controlled || !equations.scene.externals.is_empty();
        let falls = !is_pushed && state.held.is_none();
        Self {
            start_time: state.time,
            start,
            start_energy: kinetic(falls, invariants) + potential(equations, state).kept(falls),
            start_rotor_energy: invariants.rotor_energy,
            residuals: Balances::default(),
            scales: Balances::default(),
            angular_momentum: 0.0,
            work: 0.0,
            held: state.held.is_some(),
            falls,
            mass: equations.scene.total_mass(),
            reach: equations.reach,
        }
    }

    /// Takes the potential energy of `state` out of the balance, until it is [taken
    /// up](Self::take_up) again: commands that change it do no work in an instant.
    pub fn set_aside(&mut self, equations: &Equations, state: &State) {
        self.start_energy -= potential(equations, state).kept(self.falls);
    }

    /// Takes the potential energy of `state` into the balance.
    pub fn take_up(&mut self, equations: &Equations, state: &State) {
        self.start_energy += potential(equations, state).kept(self.falls);
    }

    /// Takes note of how large energy and momenta are in a motion that is not compared: residuals are relative to
    /// the largest ones, whatever the output times.
    pub fn note_motion(&mut self, invariants: &Invariants<f64>) {
        let scales = &mut self.scales;
        for (largest, value) in [
            (&mut scales.linear_momentum, invariants.linear_momentum_scale),
            (&mut scales.angular_momentum, invariants.angular_momentum_scale),
            (&mut scales.energy, kinetic(self.falls, invariants)),
        ] {
            *largest = if value.is_finite() { largest.max(value) } else { *largest };
        }
    }

    /// The largest residuals so far.
    pub fn residuals(&self) -> Conservation {
        self.relative(&self.residuals)
    }

    /// Whether an angular momentum was more than rounding so far.
    pub fn has_angular_momentum(&self) -> bool {
        self.angular_momentum > ROUNDING * self.momentum_of_energy() * self.reach
    }

    /// All of the energy in the linear motion of a point.
    fn momentum_of_energy(&self) -> f64 {
        (2.0 * self.mass).sqrt() * self.scales.energy.sqrt()
    }

    /// Residuals relative to the largest scales so far.
    fn relative(&self, found: &Balances) -> Conservation {
        let scales = &self.scales;
        let momentum = self.momentum_of_energy();
        let relative = |residual: f64, scale: f64, of_energy: f64| {
            if residual == 0.0 { 0.0 } else { residual / scale.max(ROUNDING * of_energy) }
        };
        let (linear, angular) = (scales.linear_momentum, scales.angular_momentum);
        let of_free = |residual| (!self.held).then_some(residual);
        let of_reach = momentum * self.reach;
        Conservation {
            linear_momentum: of_free(relative(found.linear_momentum, linear, momentum)),
            angular_momentum: of_free(relative(found.angular_momentum, angular, of_reach)),
            // A motion that begins and ends between two checks shows in its work alone.
            energy: match scales.energy {
                0.0 => relative(found.energy, self.work, 0.0),
                energy => relative(found.energy, energy, 0.0),
            },
        }
    }

    /// Compares `state`, whose invariants are given, with what impulses and work account for, and
    /// returns what became of them.
    ///
    /// # Errors
    /// When an energy or a momentum is not finite, so that nothing can be said about it.
    pub fn check(
        &mut self,
        equations: &Equations,
        state: &State,
        invariants: &Invariants<f64>,
    ) -> Result<Account, SimError> {
        let now = Totals::of(state, invariants);
        let work = &state.work;
        let weight = equations.gravity() * self.mass;
        let impulse = weight * (state.time - self.start_time) + work.thrust_impulse;
        let linear = now.linear_momentum_inertial - self.start.linear_momentum_inertial - impulse;
        let angular = now.angular_momentum_inertial
            - self.start.angular_momentum_inertial
            - work.thrust_angular_impulse;
        let potential = potential(equations, state);
        let check = Check { scene: &equations.scene, time: state.time };
        check.of(potential.beyond, "potential energy", potential.beyond.is_none())?;
        // The motors turn what they take from carriers into energy of the rotors, too.
        let motors = invariants.rotor_energy - self.start_rotor_energy + work.spin_up;
        let kinetic = kinetic(self.falls, invariants);
        let dissipated = work.dashpots + equations.friction_work(state);
        let energy = kinetic + potential.kept(self.falls) - motors - dissipated - work.thrust
            + work.lock_ups
            - self.start_energy;
        let energy_scale = kinetic + potential.scale(self.falls);
        self.work = self.work.max(dissipated.abs() + work.thrust.abs() + motors.abs());
        let angular_momentum = now.angular_momentum_inertial.norm();
        self.angular_momentum = self.angular_momentum.max(angular_momentum);
        let (largest, scales) = (&mut self.residuals, &mut self.scales);
        let pairs = [
            ("linear momentum", &mut scales.linear_momentum, invariants.linear_momentum_scale),
            ("angular momentum", &mut scales.angular_momentum, invariants.angular_momentum_scale),
            ("energy", &mut scales.energy, energy_scale),
            ("balance of linear momentum", &mut largest.linear_momentum, linear.norm()),
            ("balance of angular momentum", &mut largest.angular_momentum, angular.norm()),
            ("balance of energy", &mut largest.energy, energy.abs()),
        ];
        for (quantity, largest, value) in pairs {
            check.numbers(&[(quantity, value)])?;
            *largest = largest.max(value);
        }
        let residuals = self.relative(&Balances {
            linear_momentum: linear.norm(),
            angular_momentum: angular.norm(),
            energy: energy.abs(),
        });
        Ok(Account {
            potential_energy: potential.kept(false),
            dashpot_work: dissipated,
            thrust_work: work.thrust,
            motor_work: motors,
            lock_up_loss: work.lock_ups,
            residuals,
        })
    }
}

/// The kinetic energy in the balance, without that of the mass centre if it `falls`.
fn kinetic(falls: bool, invariants: &Invariants<f64>) -> f64 {
    if falls { invariants.energy_about_center } else { invariants.kinetic_energy }
}

/// Potential energy of all elements.
struct Potential {
    /// Of springs.
    sum: f64,
    /// Sum of the magnitudes of its parts.
    scale: f64,
    gravity: f64,
    /// The first hinge whose springs have one that is not finite.
    beyond: Option<usize>,
}

impl Potential {
    fn add(&mut self, part: f64, hinge: Option<usize>) {
        self.sum += part;
        self.scale += part.abs();
        self.beyond = self.beyond.or(hinge.filter(|_| !part.is_finite()));
    }

    /// The part in the balance, without gravity if the mass centre `falls`.
    fn kept(&self, falls: bool) -> f64 {
        self.sum + if falls { 0.0 } else { self.gravity }
    }

    /// The sum of the magnitudes in it.
    fn scale(&self, falls: bool) -> f64 {
        self.scale + if falls { 0.0 } else { self.gravity.abs() }
    }
}

fn potential(equations: &Equations, state: &State) -> Potential {
    let mut found = Potential { sum: 0.0, scale: 0.0, gravity: 0.0, beyond: None };
    let laws = equations.entered.dynamics.elements().torques();
    for (i, (law, &beta)) in laws.iter().zip(&state.beta).enumerate() {
        found.add(law.potential(beta), Some(i));
    }
    for (hinge, stored) in equations.entered.dynamics.elements().coupling_potentials(&state.beta) {
        found.add(stored, Some(hinge));
    }
    if equations.gravity() != Vec3::zero() {
        found.gravity = gravity_potential(&equations.scene, state.center.position);
    }
    let dynamics = &equations.entered.dynamics;
    for (number, line) in dynamics.elements().lines().iter().enumerate() {
        found.add(line.potential(state.length_of(dynamics, number)), Some(line.hinge));
    }
    found
}
