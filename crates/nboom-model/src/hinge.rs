use nboom_scalar::{Mat3, Vec3};

use crate::Stops;

/// Where a hinge sits on its inboard body, and how the body axes stand at hinge angle zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mount {
    /// The hinge point from the inboard body's origin, inboard body's axes.
    pub point: Vec3<f64>,
    /// Turns the outboard body's components at hinge angle zero into the inboard body's.
    pub rot_inboard_from_hinge: Mat3<f64>,
}

impl Mount {
    /// A hinge at `point` (inboard axes) whose axes are parallel to the inboard body's.
    pub fn at(point: Vec3<f64>) -> Self {
        Self { point, rot_inboard_from_hinge: Mat3::identity() }
    }
}

/// Hinge spring of eq. (6.1): torque κ₁(β + θ)² + κ₂(β + θ); restoring when κ₂ is negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spring {
    /// κ₁ \[torque/rad²\].
    pub quadratic: f64,
    /// κ₂ \[torque/rad\].
    pub linear: f64,
    /// θ, the preload angle \[rad\].
    pub preload_angle: f64,
}

/// Hinge dashpot of eq. (6.1): torque q₁τ² + q₂τ + q₃(β + γ)² + q₄(β + γ); damping when q₂ is
/// negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dashpot {
    /// q₁ \[torque·T²/rad²\].
    pub rate_quadratic: f64,
    /// q₂ \[torque·T/rad\].
    pub rate_linear: f64,
    /// q₃ \[torque/rad²\].
    pub angle_quadratic: f64,
    /// q₄ \[torque/rad\].
    pub angle_linear: f64,
    /// γ, the preload angle \[rad\].
    pub preload_angle: f64,
}

/// A spring that pushes a body off the main body until it has reached its limit length,
/// eqs. (6.9), (6.10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KickOffSpring {
    /// Attachment on the main body, from O, main-body axes.
    pub main_body_point: Vec3<f64>,
    /// Attachment on the hinged body, from its hinge, body axes.
    pub body_point: Vec3<f64>,
    /// Force a₀ + a₁x + a₂x² + a₃x³ in the spring's length x.
    pub coefficients: [f64; 4],
    /// Length beyond which the force is zero.
    pub limit_length: f64,
}

/// Angles closer than this \[rad\], and travels closer than this share of their
/// [size](crate::Scene::coordinate_scale), are the same when a lock angle serves as a release angle.
pub const SAME_ANGLE: f64 = 1e-12;

/// When a hinge that starts unreleased becomes free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Release {
    /// At this time \[T\], or at the initial time when that is later.
    Time(f64),
    /// When the relative angle of hinge number `hinge` passes `angle` \[rad\] either way.
    Angle {
        /// Index of the triggering hinge, from 0.
        hinge: usize,
        /// The relative angle of that hinge \[rad\].
        angle: f64,
    },
    /// When hinge number `hinge` has been locked for `delay` \[T\]; with a delay of zero in the instant
    /// in which it locks. A hinge that starts locked counts as locked at the initial time.
    AfterLock {
        /// Index of the hinge that locks, from 0.
        hinge: usize,
        /// Time from its lock-up to the release \[T\], zero or more.
        delay: f64,
    },
    /// Not during the run.
    Never,
}

/// Whether a hinge turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum HingeState {
    /// Held in its stowed position, to be released.
    Unreleased,
    /// Free to turn.
    Free,
    /// Held by its latch for good.
    Locked,
    /// At rest and held by friction or against a stop, until more acts about it than friction bears, or draws it off the
    /// stop. No hinge starts so: one that starts free and at rest sticks at once if it has to.
    Stuck,
}

impl HingeState {
    /// Those in which a hinge may start, in the order of messages.
    pub const AT_START: [Self; 3] = [Self::Free, Self::Unreleased, Self::Locked];

    /// Its name in scenes.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Free => "free",
            Self::Unreleased => "held",
            Self::Locked => "locked",
            Self::Stuck => "stuck",
        }
    }

    /// The state of this name in which a hinge may start.
    pub fn named(name: &str) -> Option<Self> {
        Self::AT_START.into_iter().find(|state| state.name() == name)
    }

    /// −1 unreleased, 0 free, 1 locked: the report's state vector; 2 stuck.
    pub fn code(self) -> i8 {
        match self {
            Self::Unreleased => -1,
            Self::Free => 0,
            Self::Locked => 1,
            Self::Stuck => 2,
        }
    }
}

/// How a hinge starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeStart {
    /// β, angle relative to the inboard body \[rad\].
    pub angle: f64,
    /// τ, rate relative to the inboard body \[rad/T\]; zero unless the hinge starts free.
    pub rate: f64,
    /// Unreleased, free or locked.
    pub state: HingeState,
}

/// What acts about a hinge, and when it is released and locks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// Spring about the hinge axis.
    pub spring: Spring,
    /// Dashpot about the hinge axis.
    pub dashpot: Dashpot,
    /// The torque of Coulomb's friction about the hinge axis, of a slide its force; zero or more. It acts against
    /// the motion, and at rest against what would move the hinge, up to as much.
    pub friction: f64,
    /// Where its motion ends.
    pub stops: Stops,
    /// Kick-off spring between the outboard body and the main body.
    pub kick_off: Option<KickOffSpring>,
    /// When the hinge becomes free, if it starts unreleased.
    pub release: Release,
    /// Relative angle at which the hinge locks \[rad\]; `None` never locks.
    pub lock_angle: Option<f64>,
    /// Angle, rate and state at the initial time.
    pub start: HingeStart,
}

impl Release {
    /// Index of the hinge that it waits for, from 0.
    pub fn trigger(self) -> Option<usize> {
        match self {
            Self::Angle { hinge, .. } | Self::AfterLock { hinge, .. } => Some(hinge),
            Self::Time(_) | Self::Never => None,
        }
    }
}

impl Hinge {
    /// A free hinge at angle zero and at rest, with nothing about it.
    pub fn free() -> Self {
        Self {
            spring: Spring::default(),
            dashpot: Dashpot::default(),
            friction: 0.0,
            stops: Stops::NONE,
            kick_off: None,
            release: Release::Never,
            lock_angle: None,
            start: HingeStart { angle: 0.0, rate: 0.0, state: HingeState::Free },
        }
    }

    /// Whether it starts free or something may release it.
    pub fn can_turn(&self) -> bool {
        match self.start.state {
            HingeState::Free => true,
            HingeState::Locked | HingeState::Stuck => false,
            HingeState::Unreleased => self.release != Release::Never,
        }
    }

    /// Whether friction or a stop may hold it at rest.
    pub fn may_stick(&self) -> bool {
        self.friction > 0.0 || !self.stops.is_none()
    }

    /// Whether it has a latch or stops, which end its motion by an impulse if it ever turns.
    pub fn has_latch_or_stop(&self) -> bool {
        self.lock_angle.is_some() || !self.stops.is_none()
    }

    /// Whether an impulse may act about it: it turns, and has a latch or stops.
    pub fn may_be_struck(&self) -> bool {
        self.can_turn() && self.has_latch_or_stop()
    }

    /// Whether it may lock: it has a latch and turns.
    pub fn can_latch(&self) -> bool {
        self.lock_angle.is_some() && self.can_turn()
    }
}
