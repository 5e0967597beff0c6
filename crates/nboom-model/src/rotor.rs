use nboom_scalar::{Sym3, Vec3};

/// A balanced rotor in a body, a momentum wheel or the like, which a motor keeps at a constant speed relative to
/// the body: a gyrostat. Its mass and its inertia across the axis belong to the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotor {
    /// Index of the hinged body that carries it; `None` is the main body.
    pub body: Option<usize>,
    /// Unit vector along its axis, body axes.
    pub axis: Vec3<f64>,
    /// J: inertia about its axis, which is not in that of the body.
    pub inertia: f64,
    /// Ω: speed relative to the body \[rad/T\].
    pub speed: f64,
}

/// All rotors of one body together; body axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotors {
    /// Σ J ā āᵀ: what they add to the inertia of the body.
    pub inertia: Sym3<f64>,
    /// Σ J Ω ā: their angular momentum relative to the body.
    pub momentum: Vec3<f64>,
}

impl Rotors {
    /// Those of `body` among all.
    pub fn of(all: &[Rotor], body: Option<usize>) -> Self {
        let mut sum = Self { inertia: Sym3::zero(), momentum: Vec3::zero() };
        for Rotor { axis, inertia, speed, .. } in all.iter().filter(|rotor| rotor.body == body) {
            sum.inertia += Sym3::outer(*axis) * *inertia;
            sum.momentum += *axis * (*inertia * *speed);
        }
        sum
    }

    /// Σ ½ J Ω² of all.
    pub fn energy_of(all: &[Rotor]) -> f64 {
        all.iter().map(|rotor| 0.5 * rotor.inertia * rotor.speed * rotor.speed).sum()
    }
}
