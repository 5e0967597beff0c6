//! Natural sizes, by which errors are measured: a quantity that is nothing but rounding has no size of
//! its own.

use nboom_model::Scene;

use crate::equations::sizes::reach;
use crate::run::record::Snapshot;

/// Share of the motion below which a quantity is none: far above what rounding grows to, far below
/// what anybody asks about.
const NOTHING: f64 = 1e-9;

/// The natural size of what is `largest`: itself, unless it is nothing beside `of_motion`.
pub fn natural(largest: f64, of_motion: f64) -> f64 {
    if largest >= NOTHING * of_motion { largest } else { of_motion }
}

/// The largest values of a run.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Largest {
    omega: f64,
    beta: f64,
    tau: f64,
    rho: f64,
    v: f64,
    impulse: f64,
}

impl Largest {
    /// Notes a motion.
    pub fn saw(&mut self, snapshot: &Snapshot) {
        let pairs = [
            (&mut self.omega, &snapshot.omega_body.to_array()[..]),
            (&mut self.beta, &snapshot.beta),
            (&mut self.tau, &snapshot.tau),
            (&mut self.rho, &snapshot.position_inertial.to_array()),
            (&mut self.v, &snapshot.velocity_inertial.to_array()),
        ];
        for (largest, values) in pairs {
            *largest = values.iter().fold(*largest, |largest, value| largest.max(value.abs()));
        }
    }

    /// Notes the impulse of a lock-up.
    pub fn saw_impulse(&mut self, impulse: f64) {
        self.impulse = self.impulse.max(impulse.abs());
    }
}

/// Natural sizes of the quantities of a run: the largest value of each, or where that is rounding what
/// the motion as a whole makes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scales {
    /// Of the time since the beginning.
    pub time: f64,
    /// Of ω.
    pub omega: f64,
    /// Of β \[rad\].
    pub beta: f64,
    /// Of τ.
    pub tau: f64,
    /// Of the position of O.
    pub rho: f64,
    /// Of the velocity of O.
    pub v: f64,
    /// Of impulses.
    pub impulse: f64,
    /// Of forces, as the motion makes them.
    pub force: f64,
    /// Of moments, as the motion makes them.
    pub moment: f64,
}

impl Scales {
    /// Of a run of `scene` with these largest values. A motion that does not turn anything in the
    /// whole run is measured by one radian in it.
    pub(crate) fn of(scene: &Scene, largest: &Largest) -> Self {
        let Largest { omega, beta, tau, rho, v, impulse } = *largest;
        let time = scene.end_time - scene.initial.time;
        let rate = natural(omega.max(tau) * time, 1.0) / time;
        let length = reach(scene);
        let momentum = scene.total_mass() * length * length * rate;
        Self {
            time,
            omega: natural(omega, rate),
            beta: natural(beta, 1.0),
            tau: natural(tau, rate),
            rho: natural(rho, length),
            v: natural(v, length * rate),
            impulse: natural(impulse, momentum),
            force: scene.total_mass() * length * rate * rate,
            moment: momentum * rate,
        }
    }
}
