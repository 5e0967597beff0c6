use nboom_dynamics::Invariants;
use nboom_scalar::{Number, Vec3};

use crate::equations::state::State;

/// Energy and momenta of all bodies together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Totals {
    /// Kinetic energy.
    pub kinetic_energy: f64,
    /// Linear momentum, inertial axes.
    pub linear_momentum_inertial: Vec3<f64>,
    /// Angular momentum about the system mass centre, inertial axes.
    pub angular_momentum_inertial: Vec3<f64>,
}

impl Totals {
    /// Those of `state`, whose invariants along main-body axes are `found`.
    pub(crate) fn of<R: Number>(state: &State<R>, found: &Invariants<R>) -> Self {
        let to_inertial = state.attitude.to_matrix();
        Self {
            kinetic_energy: found.kinetic_energy.to_f64(),
            linear_momentum_inertial: (to_inertial * found.linear_momentum).to_f64(),
            angular_momentum_inertial: (to_inertial * found.angular_momentum).to_f64(),
        }
    }
}
