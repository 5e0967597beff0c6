//! What of a scene an error is about, where that is more than a body.

use std::fmt;

/// Numbers of the scene or of its main body that have to be finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SceneQuantity {
    /// The time at which the run starts.
    InitialTime,
    /// Where O starts.
    InitialPosition,
    /// The velocity with which O starts.
    InitialVelocity,
    /// The angular rate with which the main body starts.
    InitialRate,
    /// The time at which the run ends.
    EndTime,
    /// The time from its start to its end.
    Duration,
    /// The acceleration of gravity.
    Gravity,
}

/// Numbers of a hinge, or of the body that it carries, that have to be finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HingeQuantity {
    /// Where the hinge sits, or the outer end of its body.
    Points,
    /// The spring.
    Spring,
    /// The dashpot.
    Dashpot,
    /// The friction.
    Friction,
    /// The angle or the rate with which it starts.
    Start,
    /// The angle at which it locks.
    LockAngle,
    /// The time, the angle or the delay of its release.
    Release,
    /// The kick-off spring.
    KickOff,
}

/// What has to have length 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitQuantity {
    /// The quaternion of the attitude with which the main body starts.
    InitialAttitude,
    /// The direction up.
    GravityDirection,
}

/// What a main body that is held has to start with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BaseQuantity {
    /// Its angular rate.
    AngularRate,
    /// The velocity of O.
    Velocity,
}

impl SceneQuantity {
    /// Whether it is one of the main body.
    pub fn is_of_main_body(self) -> bool {
        match self {
            Self::InitialPosition | Self::InitialVelocity | Self::InitialRate => true,
            Self::InitialTime | Self::EndTime | Self::Duration | Self::Gravity => false,
        }
    }
}

impl fmt::Display for SceneQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::InitialTime => "initial time",
            Self::InitialPosition => "initial position",
            Self::InitialVelocity => "initial velocity",
            Self::InitialRate => "initial angular rate",
            Self::EndTime => "end time",
            Self::Duration => "time from the initial to the end time",
            Self::Gravity => "gravity",
        })
    }
}

impl fmt::Display for HingeQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Points => "hinge point or outer end",
            Self::Spring => "hinge spring",
            Self::Dashpot => "hinge dashpot",
            Self::Friction => "hinge friction",
            Self::Start => "initial angle or rate",
            Self::LockAngle => "lock angle",
            Self::Release => "release",
            Self::KickOff => "kick-off spring",
        })
    }
}

impl fmt::Display for UnitQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::InitialAttitude => "initial attitude",
            Self::GravityDirection => "direction of gravity",
        })
    }
}

impl fmt::Display for BaseQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::AngularRate => "angular rate",
            Self::Velocity => "velocity",
        })
    }
}
