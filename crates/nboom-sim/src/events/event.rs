use nboom_elements::Kind;
use nboom_scalar::Vec3;

use crate::equations::totals::Totals;

/// What happens in an instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum EventKind {
    /// A hinge reaches its lock angle and is held from then on.
    LockUp,
    /// The stop of a hinge that comes to it, or is at rest there, bears an impulse.
    Impact,
    /// An unreleased hinge becomes free.
    Release,
    /// A hinge that comes to rest, or becomes free at rest, is held by friction from then on.
    Stick,
    /// More acts about a hinge than friction bears that held it.
    Slip,
    /// A hinge at a stop is at rest and held there from then on.
    Rest,
    /// What acts about a hinge draws it off its stop.
    Leave,
    /// A length, angle or rate rises beyond a bound, at which the law of a force element goes on otherwise.
    Rise(Kind),
    /// It falls below such a bound.
    Fall(Kind),
    /// A force or torque from outside starts.
    ThrustOn,
    /// A force or torque from outside stops.
    ThrustOff,
    /// The run has reached its end time.
    End,
}

impl EventKind {
    /// The name used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::LockUp => "lock_up",
            Self::Impact => "impact",
            Self::Release => "release",
            Self::Stick => "stick",
            Self::Slip => "slip",
            Self::Rest => "rest",
            Self::Leave => "leave",
            Self::Rise(kind) => kind.names().rise.in_files,
            Self::Fall(kind) => kind.names().fall.in_files,
            Self::ThrustOn => "thrust_on",
            Self::ThrustOff => "thrust_off",
            Self::End => "end",
        }
    }
}

/// One event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Time.
    pub time: f64,
    /// What happens.
    pub kind: EventKind,
    /// Index of the hinge it happens to, if to one; of what acts from outside, that of the body it acts on.
    pub hinge: Option<usize>,
    /// Impulsive torque of a lock-up or an impact on the outboard side, positive along the hinge axis.
    pub impulse: Option<f64>,
    /// Energy and momenta before the event; for lock-ups and impacts of one instant, before all of them.
    pub before: Totals,
    /// Energy and momenta after the event; for lock-ups and impacts of one instant, after all of them.
    pub after: Totals,
}

/// Change of all velocities by the impulsive torque at one hinge that locks or presses against its stop.
#[derive(Clone, Debug, PartialEq)]
pub struct Jump {
    /// The hinge.
    pub hinge: usize,
    /// Whether it locks there, or presses against its stop.
    pub kind: EventKind,
    /// Of V, the inertial velocity of O, main-body axes.
    pub velocity_body: Vec3<f64>,
    /// Of ω, main-body axes \[rad/T\].
    pub omega_body: Vec3<f64>,
    /// Of τ, one entry for each hinge of the scene \[rad/T\].
    pub tau: Vec<f64>,
}
