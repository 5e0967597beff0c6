use nboom_dynamics::Invariants;
use nboom_elements::KickOffLaw;
use nboom_model::Scene;
use nboom_scalar::{Number, Vec3};

use crate::equations::Equations;
use crate::record::{Conservation, Totals};
use crate::state::State;

/// Keeps account of momentum and energy, and of what should have changed them.
pub(crate) struct Ledger {
    start_time: f64,
    start: Totals,
    start_energy: f64,
    residuals: Conservation,
    scales: Conservation,
}

impl Ledger {
    pub fn new(scene: &Scene, equations: &mut Equations, state: &State) -> Self {
        let start = totals(state, &state.invariants(&mut equations.dynamics));
        let (potential, _) = potential(scene, equations, state);
        Self {
            start_time: state.time,
            start,
            start_energy: start.kinetic_energy + potential,
            residuals: Conservation::default(),
            scales: Conservation::default(),
        }
    }

    pub fn residuals(&self) -> Conservation {
        let (found, scales) = (&self.residuals, &self.scales);
        let relative =
            |residual: f64, scale: f64| if residual > 0.0 { residual / scale } else { 0.0 };
        Conservation {
            linear_momentum: relative(found.linear_momentum, scales.linear_momentum),
            angular_momentum: relative(found.angular_momentum, scales.angular_momentum),
            energy: relative(found.energy, scales.energy),
        }
    }

    /// Compares `state` with what impulses and work account for.
    pub fn check(&mut self, scene: &Scene, equations: &mut Equations, state: &State) {
        let invariants = state.invariants(&mut equations.dynamics);
        let now = totals(state, &invariants);
        let work = &state.work;
        let weight = equations.gravity() * scene.total_mass();
        let impulse = weight * (state.time - self.start_time) + work.thrust_impulse;
        let linear = now.linear_momentum_inertial - self.start.linear_momentum_inertial - impulse;
        let angular = now.angular_momentum_inertial
            - self.start.angular_momentum_inertial
            - work.thrust_angular_impulse;
        let (potential, potential_scale) = potential(scene, equations, state);
        let energy = now.kinetic_energy + potential - work.dashpots - work.thrust + work.lock_ups
            - self.start_energy;
        let energy_scale = now.kinetic_energy + potential_scale;
        let (largest, scales) = (&mut self.residuals, &mut self.scales);
        let pairs = [
            (&mut largest.linear_momentum, linear.norm()),
            (&mut largest.angular_momentum, angular.norm()),
            (&mut largest.energy, energy.abs()),
            (&mut scales.linear_momentum, invariants.linear_momentum_scale),
            (&mut scales.angular_momentum, invariants.angular_momentum_scale),
            (&mut scales.energy, energy_scale),
        ];
        for (largest, value) in pairs {
            *largest = largest.max(value);
        }
    }
}

/// Energy and momenta in inertial axes.
pub(crate) fn totals<R: Number>(state: &State<R>, found: &Invariants<R>) -> Totals {
    let to_inertial = state.attitude.to_matrix();
    Totals {
        kinetic_energy: found.kinetic_energy.to_f64(),
        linear_momentum_inertial: (to_inertial * found.linear_momentum).to_f64(),
        angular_momentum_inertial: (to_inertial * found.angular_momentum).to_f64(),
    }
}

/// Potential energy, and the sum of the magnitudes of its parts.
fn potential(scene: &Scene, equations: &mut Equations, state: &State) -> (f64, f64) {
    let (mut sum, mut scale) = (0.0, 0.0);
    let mut add = |part: f64| {
        sum += part;
        scale += part.abs();
    };
    for (law, &beta) in equations.laws().iter().zip(&state.beta) {
        add(law.potential(beta));
    }
    if equations.gravity() != Vec3::zero() {
        add(-scene.total_mass() * equations.gravity().dot(state.center.position));
    }
    for (i, body) in scene.bodies.iter().enumerate() {
        let Some(spring) = body.hinge.kick_off else { continue };
        let length = state.spring_length(&mut equations.dynamics, i)[0].min(spring.limit_length);
        add(KickOffLaw::new(spring.coefficients).potential(length));
    }
    (sum, scale)
}
