use nboom_model::Scene;
use nboom_ode::Bernstein;
use nboom_scalar::Number;

/// Share of the largest coefficient below which a first rate counts as zero.
const AT_REST: f64 = 1e-13;

/// On which side of its lock angle a hinge is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LockSide {
    Below,
    Above,
}

impl LockSide {
    /// That of `hinge` at the angle `beta`; none where it has no lock angle or is on it.
    pub fn of<R: Number>(scene: &Scene, hinge: usize, beta: R) -> Option<Self> {
        let angle = scene.bodies[hinge].hinge.lock_angle?;
        Self::of_sign((beta - R::constant(angle)).to_f64())
    }

    pub fn of_sign(from_lock: f64) -> Option<Self> {
        match from_lock {
            below if below < 0.0 => Some(Self::Below),
            above if above > 0.0 => Some(Self::Above),
            _ => None,
        }
    }

    /// The sign of the angle less the lock angle.
    pub fn sign(self) -> f64 {
        match self {
            Self::Below => -1.0,
            Self::Above => 1.0,
        }
    }
}

/// On which side of zero a guard is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Side {
    /// It has this sign.
    Known(f64),
    /// It is zero now. `sign`: that of the side it moves to, if known. `zeros`: how many of its value, rate,
    /// acceleration and so on are zero, of an angle one in motion and two at rest. `gradually`: one more may be zero.
    Leaving { sign: Option<f64>, zeros: usize, gradually: bool },
}

impl Side {
    /// Where on [0, 1] a guard that starts on this side of `level` leaves it.
    pub fn change(self, polynomial: &Bernstein, level: f64) -> Option<f64> {
        match self {
            Self::Known(sign) => polynomial.leaves(level, sign),
            Self::Leaving { sign, zeros, gradually } => {
                let from_level = polynomial.minus(level);
                let from_here = from_level.minus(from_level.coefficients()[0]);
                let mut moved = from_here.without_root_at_start();
                let largest = moved.coefficients().iter().fold(0.0_f64, |m, c| m.max(c.abs()));
                if zeros > 1 {
                    moved = moved.without_root_at_start();
                }
                let first = moved.coefficients()[0];
                let is_rounding = first.abs() <= AT_REST * largest;
                let is_against = sign.is_none_or(|sign| first * sign < 0.0);
                if zeros == 1 && is_rounding || gradually && (is_rounding || is_against) {
                    moved = moved.without_root_at_start();
                }
                moved.leaves_side(sign.unwrap_or(moved.coefficients()[0].signum()))
            }
        }
    }
}
