use nboom_scalar::{Real, Vec3, Wrench};

use crate::{Finding, ModelError, SceneDescription, shown};

/// A force or a torque on one body from outside, over time, eqs. (6.4) to (6.8): note 5.
#[derive(Clone, Debug, PartialEq)]
pub struct External {
    /// Index of the hinged body it acts on; `None` is the main body.
    pub body: Option<usize>,
    /// What `amount` is of.
    pub kind: ExternalKind,
    /// Force \[F\] or torque \[FL\] where its course is 1.
    pub amount: Vec3<f64>,
    /// Along whose axes `amount` is given.
    pub axes: ExternalAxes,
    /// Where it acts, from the body's origin, body axes. A torque does the same to the motion wherever it acts,
    /// but not to stations.
    pub point: Vec3<f64>,
    /// How it goes over time.
    pub course: Course,
}

/// What acts from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExternalKind {
    /// A force, as of a thruster.
    Force,
    /// A torque.
    Torque,
}

impl ExternalKind {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Force, Self::Torque];

    /// What messages call it: in scenes all forces from outside are those of thrusters, on hinged bodies too.
    pub fn name(self) -> &'static str {
        match self {
            Self::Force => "thrust",
            Self::Torque => "torque",
        }
    }

    /// Its moment about the point from which `point`, where it acts, is seen, and its force; all along the same axes.
    #[inline(always)]
    pub fn wrench<R: Real>(self, point: Vec3<R>, amount: Vec3<R>) -> Wrench<R> {
        match self {
            Self::Force => Wrench::of_force(point, amount),
            Self::Torque => Wrench { moment: amount, force: Vec3::zero() },
        }
    }
}

/// Along whose axes a force or torque keeps its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExternalAxes {
    /// Those of the body it acts on.
    Body,
    /// Inertial ones.
    Inertial,
}

/// How a force or torque goes over time: as a share of its amount.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// All of it while `on <= t < off`; times may be infinite.
    Pulse {
        /// Time at which it starts \[T\].
        on: f64,
        /// Time at which it stops \[T\].
        off: f64,
    },
    /// Shares at two or more ascending times \[T\], straight between them; nothing before the first and from the last on.
    Table(Vec<[f64; 2]>),
}

impl Course {
    /// Always all of it.
    pub const ALWAYS: Self = Self::Pulse { on: f64::NEG_INFINITY, off: f64::INFINITY };

    /// Time number `i` at which a piece of it ends and the next one begins.
    fn time(&self, i: usize) -> Option<f64> {
        match self {
            Self::Pulse { on, off } => [*on, *off].get(i).copied(),
            Self::Table(points) => points.get(i).map(|point| point[0]),
        }
    }

    /// When it starts and when it is over.
    pub fn span(&self) -> [f64; 2] {
        match self {
            Self::Pulse { on, off } => [*on, *off],
            Self::Table(points) => [points[0][0], points[points.len() - 1][0]],
        }
    }

    /// When it acts, in words, with times as `told` writes them.
    pub fn when(&self, told: impl Fn(f64) -> String) -> String {
        when(self.span(), told)
    }

    /// The piece that holds at `time`: 0 before it starts, and the last one when it is over.
    pub fn piece_at(&self, time: f64) -> usize {
        (0..).take_while(|&i| self.time(i).is_some_and(|at| at <= time)).count()
    }

    /// When a piece ends, unless it is the last one.
    pub fn end_of(&self, piece: usize) -> Option<f64> {
        self.time(piece)
    }

    /// Whether anything acts in a piece.
    pub fn acts(&self, piece: usize) -> bool {
        piece > 0 && self.time(piece).is_some()
    }

    /// The two points between which a piece of a table that acts is straight.
    pub fn line(&self, piece: usize) -> Option<[[f64; 2]; 2]> {
        match self {
            Self::Table(points) if self.acts(piece) => Some([points[piece - 1], points[piece]]),
            _ => None,
        }
    }
}

/// A span of time in words, with times as `told` writes them; one without end has no time there.
pub(crate) fn when([on, off]: [f64; 2], told: impl Fn(f64) -> String) -> String {
    match [on, off].map(f64::is_finite) {
        [true, true] => format!("from {} to {}", told(on), told(off)),
        [true, false] => format!("from {} on", told(on)),
        [false, true] => format!("until {}", told(off)),
        [false, false] => "always".to_owned(),
    }
}

impl External {
    /// A force fixed in the main body at a point of it, both along main-body axes, from `on` to `off`.
    pub fn thrust(force: Vec3<f64>, point: Vec3<f64>, [on, off]: [f64; 2]) -> Self {
        Self {
            body: None,
            kind: ExternalKind::Force,
            amount: force,
            axes: ExternalAxes::Body,
            point,
            course: Course::Pulse { on, off },
        }
    }

    /// Whether it never does anything.
    pub(crate) fn is_nothing(&self) -> bool {
        self.amount == Vec3::zero()
    }

    /// What is wrong with it in a scene of so many hinged bodies, and with which part of it.
    fn defect(&self, bodies: usize) -> Option<(ExternalPart, Finding)> {
        if self.body.is_some_and(|body| body >= bodies) {
            let finding = Finding::new("on a body that is not there", "one on a body of the scene");
            return Some((ExternalPart::Body, finding));
        }
        if !(self.amount.is_finite() && self.point.is_finite()) {
            let [amount, point] = [self.amount, self.point].map(Vec3::to_array);
            let found = format!("{amount:?} at {point:?}");
            return Some((ExternalPart::Amount, Finding::new(found, "finite numbers")));
        }
        let (found, expected) = match &self.course {
            Course::Pulse { on, off } if on <= off => return None,
            Course::Pulse { on, off } => {
                (format!("from {} to {}", shown(*on), shown(*off)), "an end not before its start")
            }
            Course::Table(points) => {
                (wrong_points(points)?, "two or more points of finite numbers at ascending times")
            }
        };
        Some((ExternalPart::Course, Finding::new(found, expected)))
    }
}

/// Adds what is wrong with what acts on a scene from outside; one that never does anything is not looked at.
pub(crate) fn find(scene: &SceneDescription, errors: &mut Vec<ModelError>) {
    let externals = scene.externals.iter().enumerate().filter(|(_, one)| !one.is_nothing());
    errors.extend(externals.filter_map(|(index, one)| {
        let (part, finding) = one.defect(scene.bodies.len())?;
        Some(ModelError::External { index, kind: one.kind, part, finding })
    }));
}

fn wrong_points(points: &[[f64; 2]]) -> Option<String> {
    if points.len() < 2 {
        return Some(format!("over {} points", points.len()));
    }
    points.iter().enumerate().find_map(|(k, &[time, share])| {
        let is_finite = time.is_finite() && share.is_finite();
        let ascends = k == 0 || time > points[k - 1][0];
        (!(is_finite && ascends))
            .then(|| format!("point {} at {}, {}", k + 1, shown(time), shown(share)))
    })
}

/// A part of an [`External`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExternalPart {
    /// The body.
    Body,
    /// Force or torque, and its point.
    Amount,
    /// Its times.
    Course,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_begin_at_their_times() {
        let pulse = Course::Pulse { on: 1.0, off: 2.0 };
        let table = Course::Table(vec![[1.0, 0.0], [1.5, 2.0], [2.0, 1.0]]);
        for (course, last) in [(&pulse, 2), (&table, 3)] {
            assert_eq!([0.9, 1.0, 2.0, 9.0].map(|t| course.piece_at(t)), [0, 1, last, last]);
            assert_eq!((course.end_of(0), course.end_of(last)), (Some(1.0), None));
            assert!(!course.acts(0) && course.acts(1) && !course.acts(last));
        }
        assert_eq!((table.piece_at(1.5), table.end_of(1)), (2, Some(1.5)));
        assert_eq!(table.line(2), Some([[1.5, 2.0], [2.0, 1.0]]));
        assert_eq!((table.line(0), table.line(3), pulse.line(1)), (None, None, None));
        assert!(Course::ALWAYS.acts(Course::ALWAYS.piece_at(-1e300)));
        let never = Course::Pulse { on: 1.0, off: 1.0 };
        assert!(!never.acts(never.piece_at(0.0)) && !never.acts(never.piece_at(1.0)));
    }
}
