use std::fmt;
use std::sync::Arc;

/// A torque about a hinge by a law that a program brings itself, beside the hinge's other torques.
///
/// It is a smooth function of the angle and the rate. It has no potential: all its work is accounted
/// for as it is done.
#[derive(Clone)]
pub struct OwnLaw {
    /// Index of the hinge, from 0.
    pub hinge: usize,
    law: Arc<dyn Fn(f64, f64) -> f64 + Send + Sync>,
}

impl OwnLaw {
    /// The torque `law` gives at the angle β \[rad\] and the rate τ \[rad/T\] of `hinge`; positive when it
    /// increases β.
    pub fn new(hinge: usize, law: impl Fn(f64, f64) -> f64 + Send + Sync + 'static) -> Self {
        Self { hinge, law: Arc::new(law) }
    }

    /// Torque at angle `beta` \[rad\] and rate `tau` \[rad/T\].
    pub fn torque(&self, beta: f64, tau: f64) -> f64 {
        (self.law)(beta, tau)
    }
}

impl fmt::Debug for OwnLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OwnLaw").field("hinge", &self.hinge).finish_non_exhaustive()
    }
}

/// The laws that a program brings itself, any number of them about a hinge.
#[derive(Clone, Debug, Default)]
pub struct OwnLaws(Arc<[OwnLaw]>);

impl OwnLaws {
    /// These.
    pub fn new(laws: Vec<OwnLaw>) -> Self {
        Self(laws.into())
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &OwnLaw> {
        self.0.iter()
    }

    /// Whether one acts about `hinge`.
    pub fn act_about(&self, hinge: usize) -> bool {
        self.0.iter().any(|law| law.hinge == hinge)
    }

    /// Adds their torques to those about the `hinges`, ascending, which stand at angles and rates.
    pub fn add_torques(&self, hinges: &[usize], [beta, tau]: [&[f64]; 2], torques: &mut [f64]) {
        for (j, law) in self.among(hinges) {
            torques[j] += law.torque(beta[j], tau[j]);
        }
    }

    /// Power of their torques about the `hinges`, ascending, which stand at angles and rates.
    pub fn power(&self, hinges: &[usize], [beta, tau]: [&[f64]; 2]) -> f64 {
        self.among(hinges).map(|(j, law)| law.torque(beta[j], tau[j]) * tau[j]).sum()
    }

    /// Those about the `hinges`, each with the place of its hinge among these.
    fn among(&self, hinges: &[usize]) -> impl Iterator<Item = (usize, &OwnLaw)> {
        self.0.iter().filter_map(move |law| Some((hinges.binary_search(&law.hinge).ok()?, law)))
    }
}
