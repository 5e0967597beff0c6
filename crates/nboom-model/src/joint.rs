use nboom_scalar::{Mat3, Real, Twist, Vec3, Wrench};

/// What a joint leaves free: one coordinate β about or along one axis that is fixed in both bodies.
///
/// Other documents call either a hinge; β and τ of one that slides are its travel \[L\] and speed
/// \[L/T\], and what acts at it is a force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Joint {
    /// The outboard body turns about the axis.
    #[default]
    Revolute,
    /// The outboard body slides along the axis and does not turn.
    Prismatic,
}

impl Joint {
    /// Both of them.
    pub const ALL: [Self; 2] = [Self::Revolute, Self::Prismatic];

    /// Turns outboard components into those at β = 0, at the coordinate `beta`; `axis` is the joint's unit
    /// vector.
    #[inline(always)]
    pub fn turn<R: Real>(self, axis: Vec3<R>, beta: R) -> Mat3<R> {
        match self {
            Self::Revolute => Mat3::about_axis(axis, beta),
            Self::Prismatic => Mat3::identity(),
        }
    }

    /// How far the outboard body's origin is from where it is at β = 0, along the axes of `axis`.
    #[inline(always)]
    pub fn travel<R: Real>(self, axis: Vec3<R>, beta: R) -> Vec3<R> {
        match self {
            Self::Revolute => Vec3::zero(),
            Self::Prismatic => axis * beta,
        }
    }

    /// Motion of the outboard body's origin relative to the inboard body at the rate `tau`.
    #[inline(always)]
    pub fn motion<R: Real>(self, axis: Vec3<R>, tau: R) -> Twist<R> {
        match self {
            Self::Revolute => Twist { angular: axis * tau, linear: Vec3::zero() },
            Self::Prismatic => Twist { angular: Vec3::zero(), linear: axis * tau },
        }
    }

    /// The share of a wrench on the outboard body, about its origin, that acts on β: its power at a rate of
    /// one.
    #[inline(always)]
    pub fn along<R: Real>(self, axis: Vec3<R>, wrench: &Wrench<R>) -> R {
        match self {
            Self::Revolute => axis.dot(wrench.moment),
            Self::Prismatic => axis.dot(wrench.force),
        }
    }

    /// What scenes and messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Revolute => "hinge",
            Self::Prismatic => "slide",
        }
    }

    /// What its outboard body does.
    pub fn does(self) -> &'static str {
        match self {
            Self::Revolute => "turns",
            Self::Prismatic => "slides",
        }
    }

    /// What scenes call its rate.
    pub fn rate_name(self) -> &'static str {
        match self {
            Self::Revolute => "rate",
            Self::Prismatic => "speed",
        }
    }

    /// What it does to a coordinate that releases another joint.
    pub fn passes_name(self) -> &'static str {
        match self {
            Self::Revolute => "passes",
            Self::Prismatic => "reaches",
        }
    }

    /// What scenes call numbers of its damper: on the squared rate, on the coordinate, and on its square.
    pub fn damper_names(self) -> [&'static str; 3] {
        match self {
            Self::Revolute => ["rate_squared", "angle", "angle_squared"],
            Self::Prismatic => ["speed_squared", "travel", "travel_squared"],
        }
    }

    /// What acts on its coordinate.
    pub fn force_name(self) -> &'static str {
        match self {
            Self::Revolute => "torque",
            Self::Prismatic => "force",
        }
    }

    /// What its coordinate is counted in.
    pub fn unit_name(self) -> &'static str {
        match self {
            Self::Revolute => "radian",
            Self::Prismatic => "unit of length",
        }
    }

    /// Whether it slides.
    #[inline(always)]
    pub fn slides(self) -> bool {
        self == Self::Prismatic
    }
}
