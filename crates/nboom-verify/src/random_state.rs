use nboom_dynamics::Motion;
use nboom_scalar::Vec3;

use crate::random::Rng;

/// One random state: rates and angles, in the order of the scene's free hinges.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomState {
    /// ω, main-body axes \[rad/T\].
    pub omega: Vec3<f64>,
    /// β, any angle \[rad\], or a travel of some strokes \[L\].
    pub beta: Vec<f64>,
    /// τ \[rad/T, L/T\].
    pub tau: Vec<f64>,
}

impl RandomState {
    /// Angles of any size for hinges whose coordinates have these natural sizes, and rates up to `rate`.
    pub(crate) fn random(dice: &mut Rng, sizes: &[f64], rate: f64) -> Self {
        let [x, y, z] = std::array::from_fn(|_| dice.between(-rate, rate));
        let tau = sizes.iter().map(|size| size * dice.between(-rate, rate)).collect();
        let beta = sizes.iter().map(|size| size * dice.angle()).collect();
        Self { omega: Vec3::new(x, y, z), beta, tau }
    }

    /// The state as the recursion takes it.
    pub fn motion(&self) -> Motion<'_, f64> {
        Motion { omega_body: self.omega, beta: &self.beta, tau: &self.tau }
    }
}
