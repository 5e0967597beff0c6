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
#[derive(Clone, Debug, Default)]
pub(crate) struct Largest {
    omega: f64,
    rho: f64,
    v: f64,
    /// Of each hinge.
    beta: Vec<f64>,
    tau: Vec<f64>,
    impulse: Vec<f64>,
}

impl Largest {
    /// Notes a motion.
    pub fn saw(&mut self, snapshot: &Snapshot) {
        let pairs = [
            (&mut self.omega, &snapshot.omega_body.to_array()[..]),
            (&mut self.rho, &snapshot.position_inertial.to_array()),
            (&mut self.v, &snapshot.velocity_inertial.to_array()),
        ];
        for (largest, values) in pairs {
            *largest = values.iter().fold(*largest, |largest, value| largest.max(value.abs()));
        }
        let hinges = snapshot.beta.len();
        for (largest, values) in [(&mut self.beta, &snapshot.beta), (&mut self.tau, &snapshot.tau)]
        {
            largest.resize(hinges, 0.0);
            largest.iter_mut().zip(values).for_each(|(most, value)| *most = most.max(value.abs()));
        }
    }

    /// Notes the impulse of a lock-up or an impact of a hinge.
    pub fn saw_impulse(&mut self, hinge: usize, impulse: f64) {
        self.impulse.resize(self.impulse.len().max(hinge + 1), 0.0);
        self.impulse[hinge] = self.impulse[hinge].max(impulse.abs());
    }
}

/// Natural sizes of the quantities of a run: the largest value of each, or where that is rounding what
/// the motion as a whole makes of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Scales {
    /// Of the time since the beginning.
    pub time: f64,
    /// Of ω.
    pub omega: f64,
    /// Of β of each hinge: a fast wheel is no measure of a slow boom.
    pub beta: Vec<f64>,
    /// Of τ of each hinge.
    pub tau: Vec<f64>,
    /// Of the position of O.
    pub rho: f64,
    /// Of the velocity of O.
    pub v: f64,
    /// Of impulsive torques; of forces, those times the size of their hinge.
    pub impulse: f64,
    /// Size of each hinge's β: a radian, or a stroke.
    pub of_hinges: Vec<f64>,
    /// Of forces, as the motion makes them.
    pub force: f64,
    /// Of moments, as the motion makes them.
    pub moment: f64,
}

impl Scales {
    /// The scales of a run of `scene` with these largest values. A motion that turns nothing is
    /// measured by one radian in the whole run.
    pub(crate) fn of(scene: &Scene, largest: &Largest) -> Self {
        let Largest { omega, rho, v, .. } = *largest;
        let of_hinges: Vec<f64> =
            (0..scene.bodies.len()).map(|i| scene.coordinate_scale(i)).collect();
        let most = |of: &mut dyn Iterator<Item = f64>| of.fold(0.0, f64::max);
        let pairs = |values| of_hinges.iter().zip::<&Vec<f64>>(values);
        let tau = most(&mut pairs(&largest.tau).map(|(size, value)| value / size));
        let impulse = most(&mut pairs(&largest.impulse).map(|(size, value)| value * size));
        let time = scene.end_time - scene.initial.time;
        let rate = natural(omega.max(tau) * time, 1.0) / time;
        let length = reach(scene);
        let of_run = |(size, largest): (&f64, &f64)| natural(*largest, *size);
        let beta: Vec<f64> = pairs(&largest.beta).map(of_run).collect();
        let of_rate = |(beta, largest): (&f64, &f64)| natural(*largest, beta / time);
        let tau = beta.iter().zip(&largest.tau).map(of_rate).collect();
        let momentum = scene.total_mass() * length * length * rate;
        Self {
            time,
            omega: natural(omega, rate),
            beta,
            tau,
            rho: natural(rho, length),
            v: natural(v, length * rate),
            impulse: natural(impulse, momentum),
            of_hinges,
            force: scene.total_mass() * length * rate * rate,
            moment: momentum * rate,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fast_hinge_is_no_measure_of_slow_ones() {
        let path =
            concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/scenes/s03_chain3_general.nml");
        let scene = nboom_io::read_scene(path.as_ref()).expect("reference decks are valid").scene;
        let span = scene.end_time - scene.initial.time;
        let mut largest = Largest::default();
        // A wheel, a boom that hardly moves, and rounding.
        let (beta, tau) = (vec![6e5, 7e-4, 1e-13], vec![6e3, -4e-6, 1e-13]);
        largest.saw(&Snapshot { beta, tau, ..Snapshot::empty() });
        let Scales { beta, tau, .. } = Scales::of(&scene, &largest);
        assert_eq!(beta, [6e5, 7e-4, 1.0]);
        assert_eq!(tau, [6e3, 4e-6, 1.0 / span]);
    }
}
