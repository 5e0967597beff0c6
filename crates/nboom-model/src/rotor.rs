use nboom_scalar::{Mat3, Real, Sym3, Vec3};

use crate::{Finding, over_time, shown};

/// A balanced rotor in a body, a momentum wheel or the like, whose speed relative to the body a
/// motor commands: a gyrostat. Its mass and its inertia across the axis belong to the body.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotor {
    /// Index of the hinged body that carries it; `None` is the main body.
    pub body: Option<usize>,
    /// Unit vector along its axis, body axes.
    pub axis: Vec3<f64>,
    /// J: inertia about its axis, which is not in that of the body.
    pub inertia: f64,
    /// Ω: speed relative to the body over time; a control law may accelerate it beside.
    pub speed: RotorSpeed,
}

/// A part of a [`Rotor`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RotorPart {
    /// The body.
    Body,
    /// The axis.
    Axis,
    /// The inertia.
    Inertia,
    /// The speed.
    Speed,
}

/// The speed of a rotor relative to its body over time \[rad/T\].
#[derive(Clone, Debug, PartialEq)]
pub enum RotorSpeed {
    /// Always the same.
    Constant(f64),
    /// Speeds at one or more ascending times \[T\]: straight between them, constant before the
    /// first and after the last.
    Table(Vec<[f64; 2]>),
}

/// How fast a rotor turns relative to its body, and how that changes until the mode ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotorMotion<R> {
    /// Ω \[rad/T\].
    pub speed: R,
    /// Its rate of change, a constant of the mode \[rad/T²\].
    pub acceleration: f64,
}

/// Angular momentum of rotors relative to what carries them, and how fast their motors change it;
/// axes of the carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin<R> {
    /// h̄ = Σ J Ω ā.
    pub momentum: Vec3<R>,
    /// Σ J (dΩ/dt) ā.
    pub rate: Vec3<R>,
}

impl Rotor {
    /// Σ J ā āᵀ of those of `body` among all: what they add to the inertia of the body, body axes.
    pub fn inertia_of(all: &[Self], body: Option<usize>) -> Sym3<f64> {
        let of_body = all.iter().filter(|rotor| rotor.body == body);
        of_body.fold(Sym3::zero(), |sum, rotor| sum + Sym3::outer(rotor.axis) * rotor.inertia)
    }
}

impl From<f64> for RotorSpeed {
    fn from(speed: f64) -> Self {
        Self::Constant(speed)
    }
}

impl RotorSpeed {
    /// The speed at `time`.
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant(speed) => *speed,
            Self::Table(points) => {
                over_time::value_at(over_time::around(points, self.piece_at(time)), time)
            }
        }
    }

    /// The piece that holds at `time`: 0 before the first time of a table.
    pub fn piece_at(&self, time: f64) -> usize {
        over_time::piece_at(self.points(), time)
    }

    /// When a piece ends, unless it is the last one.
    pub fn end_of(&self, piece: usize) -> Option<f64> {
        over_time::end_of(self.points(), piece)
    }

    /// The rate of change of the speed in a piece \[rad/T²\].
    pub fn acceleration(&self, piece: usize) -> f64 {
        match self {
            Self::Constant(_) => 0.0,
            Self::Table(points) => over_time::slope(over_time::around(points, piece)),
        }
    }

    /// The points of a table.
    fn points(&self) -> &[[f64; 2]] {
        match self {
            Self::Constant(_) => &[],
            Self::Table(points) => points,
        }
    }

    /// What is wrong with it.
    pub(crate) fn defect(&self) -> Option<Finding> {
        match self {
            Self::Constant(speed) => {
                let wrong = || Finding::new(format!("speed {}", shown(*speed)), "a finite speed");
                (!speed.is_finite()).then(wrong)
            }
            Self::Table(points) => {
                let ascend = points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
                let are_finite = points.iter().flatten().all(|number| number.is_finite());
                // Slopes beyond all numbers would be the speeds of the next instant.
                let are_slopes =
                    (0..points.len()).all(|piece| self.acceleration(piece).is_finite());
                let is_right = !points.is_empty() && ascend && are_finite && are_slopes;
                let expected = "finite speeds at ascending times, at least one";
                (!is_right).then(|| Finding::new(format!("times and speeds {points:?}"), expected))
            }
        }
    }
}

impl<R: Real> RotorMotion<R> {
    /// `motion` in this scalar.
    pub fn of_constant(motion: &RotorMotion<f64>) -> Self {
        Self { speed: R::constant(motion.speed), acceleration: motion.acceleration }
    }

    /// The motion `duration` later in the same mode.
    pub fn after(self, duration: R) -> Self {
        if self.acceleration == 0.0 {
            return self;
        }
        Self { speed: self.speed + R::constant(self.acceleration) * duration, ..self }
    }
}

impl<R: Real> Spin<R> {
    /// Makes every number a scalar of this kind.
    pub(crate) fn constant(spin: Spin<f64>) -> Self {
        Self { momentum: Vec3::constant(spin.momentum), rate: Vec3::constant(spin.rate) }
    }

    /// Of rotors at rest.
    pub fn zero() -> Self {
        Self { momentum: Vec3::zero(), rate: Vec3::zero() }
    }

    /// Adds a rotor with the moment of inertia vector J ā that moves so.
    pub fn add(&mut self, along: Vec3<R>, motion: &RotorMotion<R>) {
        self.momentum += along * motion.speed;
        if motion.acceleration != 0.0 {
            self.rate += along * R::constant(motion.acceleration);
        }
    }

    /// The same along axes into which `rot` turns its components.
    #[inline(always)]
    pub fn rotated(&self, rot: &Mat3<R>) -> Self {
        Self { momentum: *rot * self.momentum, rate: *rot * self.rate }
    }

    /// ω̄ × h̄ + Σ J (dΩ/dt) ā: the moment that it takes to carry the rotors along at the rate
    /// `omega`, beside that of their inertia.
    #[inline(always)]
    pub fn moment(&self, omega: Vec3<R>) -> Vec3<R> {
        omega.cross(self.momentum) + self.rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_straight_between_its_times_and_constant_around_them() {
        let table = RotorSpeed::Table(vec![[1.0, 3.0], [2.0, 5.0], [4.0, -1.0]]);
        let of = [0.0, 1.0, 1.5, 2.0, 3.0, 4.0, 9.0];
        assert_eq!(of.map(|t| table.piece_at(t)), [0, 1, 1, 2, 2, 3, 3]);
        assert_eq!(of.map(|t| table.at(t)), [3.0, 3.0, 4.0, 5.0, 2.0, -1.0, -1.0]);
        assert_eq!([0, 1, 2, 3].map(|piece| table.acceleration(piece)), [0.0, 2.0, -3.0, 0.0]);
        let ends = [0, 1, 2, 3].map(|piece| table.end_of(piece));
        assert_eq!(ends, [Some(1.0), Some(2.0), Some(4.0), None]);
        let constant = RotorSpeed::from(7.0);
        assert_eq!((constant.at(3.0), constant.piece_at(3.0), constant.end_of(0)), (7.0, 0, None));
    }

    #[test]
    fn tables_that_are_none_are_refused() {
        let wrong = |points: &[[f64; 2]]| RotorSpeed::Table(points.to_vec()).defect().is_some();
        assert!(!wrong(&[[0.0, 1.0]]) && !wrong(&[[0.0, 1.0], [1.0, 2.0]]));
        assert!(wrong(&[]) && wrong(&[[0.0, 1.0], [0.0, 2.0]]) && wrong(&[[0.0, f64::NAN]]));
        assert!(wrong(&[[0.0, 1e300], [1e-200, -1e300]]));
    }
}
