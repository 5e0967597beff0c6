mod forces;
mod geometry;
mod masses;
mod outside;
mod releases;
mod rotors;
mod tables;

use std::f64::consts::TAU;
use std::fmt;

use crate::external::when;
use crate::{BodyName, ExternalKind, HingeLabel, Scene, shown};

/// Something a scene may do but its author probably does not want.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModelWarning {
    /// These hinges wait for each other's angles or lock-ups, and none can move first.
    ReleaseCircle(Vec<HingeLabel>),
    /// This hinge waits for the angle or the lock-up of a hinge that never turns.
    TriggerNeverTurns {
        /// The waiting hinge.
        hinge: HingeLabel,
        /// The hinge it waits for.
        trigger: HingeLabel,
    },
    /// This hinge waits for an angle beyond that at which the other one locks.
    TriggerLocksBefore {
        /// The waiting hinge.
        hinge: HingeLabel,
        /// The hinge it waits for.
        trigger: HingeLabel,
    },
    /// This hinge waits for an angle beyond a stop of the other one.
    TriggerStopsBefore {
        /// The waiting hinge.
        hinge: HingeLabel,
        /// The hinge it waits for.
        trigger: HingeLabel,
    },
    /// This hinge waits for the lock-up of a hinge that has no lock angle.
    TriggerNeverLocks {
        /// The waiting hinge.
        hinge: HingeLabel,
        /// The hinge it waits for.
        trigger: HingeLabel,
    },
    /// This hinge waits for an angle on the side of the trigger's start on which its lock angle is not.
    TriggerOtherWay {
        /// The waiting hinge.
        hinge: HingeLabel,
        /// The hinge it waits for.
        trigger: HingeLabel,
        /// The angle \[rad\].
        angle: f64,
        /// Where the trigger starts \[rad\].
        start: f64,
        /// The trigger's lock angle \[rad\].
        lock: f64,
    },
    /// This hinge is released after the end of the run.
    ReleasedAfterEnd {
        /// The hinge.
        hinge: HingeLabel,
        /// The time of its release.
        release: f64,
        /// The end.
        end: f64,
    },
    /// This hinge may turn and starts at its lock angle, so that it locks only when it comes back there; or so near
    /// it that rounding may be all that is between.
    StartsAtLock {
        /// The hinge.
        hinge: HingeLabel,
        /// Whether it is held at first.
        is_held: bool,
        /// Its lock angle less its angle \[rad\], or lengths where it slides.
        apart: f64,
    },
    /// This hinge starts more than two turns away from zero.
    ManyTurns {
        /// The hinge.
        hinge: HingeLabel,
        /// Where it starts \[rad\].
        start: f64,
    },
    /// This hinge starts locked, but away from the angle at which it locks.
    LockedElsewhere(HingeLabel),
    /// The dashpot pushes along with the motion instead of against it.
    DashpotFeeds {
        /// The hinge.
        hinge: HingeLabel,
        /// The coefficient that has the wrong sign, and the power of the rate that it belongs to.
        coefficient: (f64, u8),
        /// Rate beyond which it does \[rad/T\].
        beyond: f64,
    },
    /// The damper between two hinges pushes along with their motion instead of against it.
    CouplingFeeds {
        /// The hinges.
        hinges: [HingeLabel; 2],
        /// Its coefficient, below zero.
        damping: f64,
    },
    /// The torque of spring and dashpot grows with the distance from an angle and points away from it, and no stop is
    /// there.
    SpringWithoutRest {
        /// The hinge.
        hinge: HingeLabel,
        /// Torque per angle \[torque/rad\], positive.
        stiffness: f64,
        /// The angle \[rad\].
        away_from: f64,
    },
    /// The torque of spring and dashpot drives the hinge on and on, and it has no lock angle or stop there.
    SpringDrivesOn {
        /// The hinge.
        hinge: HingeLabel,
        /// Where it starts \[rad\].
        start: f64,
    },
    /// Beyond an end of its torque table, where the hinge comes from rest, the torque drives it on, the harder the
    /// farther, and it has no lock angle or stop there.
    TableDrivesOn {
        /// The hinge.
        hinge: HingeLabel,
        /// Where it starts \[rad\].
        start: f64,
        /// The last point on that side \[rad\].
        end: f64,
        /// Torque per angle beyond, with that of the spring \[torque/rad\], positive.
        stiffness: f64,
    },
    /// Where the hinge starts, springs, tables and couplings together drive it away from its lock angle.
    DrivenFromLock {
        /// The hinge.
        hinge: HingeLabel,
        /// Where it starts \[rad\].
        start: f64,
        /// Its lock angle \[rad\].
        lock: f64,
    },
    /// Where the hinge starts at rest, friction is no less than what springs, tables and couplings do together.
    FrictionHolds {
        /// The hinge.
        hinge: HingeLabel,
        /// Its friction.
        friction: f64,
        /// What drives it there.
        torque: f64,
    },
    /// A kick-off spring pulls its ends together at the start.
    KickOffPulls {
        /// The hinge.
        hinge: HingeLabel,
        /// Its force, negative.
        force: f64,
        /// Its length.
        length: f64,
    },
    /// The ends of a kick-off spring meet at the start, so that its force has no direction.
    KickOffWithoutLength(HingeLabel),
    /// A kick-off spring is longer than its limit at the start and with all lock angles reached.
    KickOffNeverPushes {
        /// The hinge.
        hinge: HingeLabel,
        /// Its length at the start.
        length: f64,
        /// The length up to which it pushes.
        limit: f64,
    },
    /// A force or torque from outside acts at no time of the run.
    NeverActs {
        /// What.
        kind: ExternalKind,
        /// The body it is on.
        body: BodyName,
        /// When it acts.
        span: [f64; 2],
        /// The time of the run.
        run: [f64; 2],
    },
    /// A rotor changes its speed after the end of the run.
    SpeedAfterEnd {
        /// The body that carries it.
        body: BodyName,
        /// From when on.
        from: f64,
        /// The end.
        end: f64,
    },
    /// At its lock angle a body lies folded back on its inboard body.
    FoldsBack {
        /// The body's hinge.
        hinge: HingeLabel,
        /// That of the inboard body.
        inboard: HingeLabel,
        /// The lock angle \[rad\].
        lock: f64,
    },
    /// Masses of two bodies are so unequal that many digits of the motion are lost.
    UnequalMasses {
        /// The lightest body that has a mass, with it.
        least: (BodyName, f64),
        /// The heaviest one, with its mass.
        largest: (BodyName, f64),
    },
    /// With all lock angles reached the outer end of a body is back at a hinge inboard of it.
    EndsAtHinge {
        /// The body's hinge.
        hinge: HingeLabel,
        /// The hinge it is back at.
        at: HingeLabel,
    },
}

impl fmt::Display for ModelWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ReleaseCircle(hinges) => {
                let names: Vec<String> = hinges.iter().map(HingeLabel::to_string).collect();
                let names = names.join(" <- ");
                write!(f, "hinges release each other in a circle and never start: {names}")
            }
            Self::TriggerNeverTurns { hinge, trigger } => {
                write!(f, "hinge {hinge} waits for hinge {trigger}, which never turns")
            }
            Self::TriggerLocksBefore { hinge, trigger } => write!(
                f,
                "hinge {hinge} waits for an angle of hinge {trigger}, which locks before it comes there"
            ),
            Self::TriggerStopsBefore { hinge, trigger } => write!(
                f,
                "hinge {hinge} waits for an angle of hinge {trigger} that is beyond a stop of it"
            ),
            Self::TriggerNeverLocks { hinge, trigger } => {
                write!(f, "hinge {hinge} waits for hinge {trigger} to lock, which never does")
            }
            Self::TriggerOtherWay { hinge, trigger, angle, start, lock } => write!(
                f,
                "hinge {hinge} waits for {} of hinge {trigger}, which starts at {} and locks at {}, the \
                 other way",
                trigger.coordinate(*angle),
                trigger.coordinate(*start),
                trigger.coordinate(*lock)
            ),
            Self::ReleasedAfterEnd { hinge, release, end } => {
                write!(
                    f,
                    "hinge {hinge} is released at {release:?}, after the end of the run at {end:?}"
                )
            }
            Self::StartsAtLock { hinge, is_held, apart } => {
                let how = if *is_held { "is held until its release" } else { "starts free" };
                match *apart {
                    0.0 => write!(
                        f,
                        "hinge {hinge} {how} at its lock angle: it locks only when it comes back there"
                    ),
                    apart => write!(
                        f,
                        "hinge {hinge} {how} {apart:e} from its lock angle: it locks at once if it moves there, \
                         else only when it comes back"
                    ),
                }
            }
            Self::ManyTurns { hinge, start } => write!(
                f,
                "hinge {hinge} starts at {}, {:.1} turns away from zero",
                hinge.coordinate(*start),
                start.abs() / TAU
            ),
            Self::LockedElsewhere(hinge) => {
                write!(f, "hinge {hinge} starts locked, but not at its lock angle, and stays there")
            }
            Self::DashpotFeeds { hinge, coefficient: (value, 1), .. } => write!(
                f,
                "dashpot of hinge {hinge} feeds energy: a torque of {value:?} for each unit of rate, along the \
                 motion, found, one against it expected"
            ),
            Self::DashpotFeeds { hinge, coefficient: (value, _), beyond } => write!(
                f,
                "dashpot of hinge {hinge} feeds energy beyond a rate of {} per time unit: coefficient {value:?} of \
                 the squared rate found, which pushes one way however the hinge turns",
                hinge.coordinate(beyond.abs().copysign(*value))
            ),
            Self::CouplingFeeds { hinges: [a, b], damping } => write!(
                f,
                "coupling of hinges {a} and {b} feeds energy: damping {damping:?} found, no negative one expected"
            ),
            Self::SpringWithoutRest { hinge, stiffness, away_from } => write!(
                f,
                "spring of hinge {hinge} pushes the harder the farther it is from {}: a {} of \
                 {stiffness:?} for each {} away from there found, one back to it expected",
                hinge.coordinate(*away_from),
                hinge.joint.force_name(),
                hinge.joint.unit_name()
            ),
            Self::SpringDrivesOn { hinge, start } => write!(
                f,
                "spring of hinge {hinge} drives it on and on from {}, ever harder, and neither lock \
                 angle nor stop is there",
                hinge.coordinate(*start)
            ),
            Self::TableDrivesOn { hinge, start, end, stiffness } => write!(
                f,
                "{name} table of hinge {hinge} drives it on and on from {}: beyond its end at {} a {name} that grows \
                 by {stiffness:?} for each {} found, one that does not grow, a lock angle or a stop expected",
                hinge.coordinate(*start),
                hinge.coordinate(*end),
                hinge.joint.unit_name(),
                name = hinge.joint.force_name()
            ),
            Self::DrivenFromLock { hinge, start, lock } => write!(
                f,
                "{} of springs, tables and couplings on hinge {hinge} where it starts drives it away from its lock \
                 angle: from {}, not towards {}",
                hinge.joint.force_name(),
                hinge.coordinate(*start),
                hinge.coordinate(*lock)
            ),
            Self::FrictionHolds { hinge, friction, torque } => write!(
                f,
                "friction of hinge {hinge} is no less than what springs, tables and couplings do where it starts: {friction:?} \
                 against a {} of {}",
                hinge.joint.force_name(),
                shown(*torque)
            ),
            Self::KickOffPulls { hinge, force, length } => write!(
                f,
                "kick-off spring of hinge {hinge} pulls: force {force:?} at its length {length:?} found, \
                 a positive one pushes"
            ),
            Self::KickOffWithoutLength(hinge) => write!(
                f,
                "the ends of the kick-off spring of hinge {hinge} meet at the start: its force has no direction, and a \
                 run stops once the hinge is free"
            ),
            Self::KickOffNeverPushes { hinge, length, limit } => write!(
                f,
                "kick-off spring of hinge {hinge} pushes neither at the start nor with all hinges locked: its length is \
                 {length:?} at the start, and it pushes up to {limit:?}"
            ),
            Self::NeverActs { kind, body, span, run: [start, end] } => write!(
                f,
                "{} on the {body} acts at no time of the run: {} found, a time between {start:?} and {end:?} expected",
                kind.name(),
                when(*span, |time| format!("{time:?}"))
            ),
            Self::SpeedAfterEnd { body, from, end } => write!(
                f,
                "rotor on the {body}: a change of speed from {from:?} on found, one before the end of the run at \
                 {end:?} expected"
            ),
            Self::FoldsBack { hinge, inboard, lock } => write!(
                f,
                "segment {hinge}, locked at {}, lies folded back on segment {inboard}; at 0 deg it \
                 is straight",
                hinge.coordinate(*lock)
            ),
            Self::UnequalMasses { least: (light, least), largest: (heavy, largest) } => write!(
                f,
                "mass {} of {heavy} beside mass {} of {light} found: as many of the 16 digits of a motion may be \
                 lost as the masses differ by, about {:.0}",
                shown(*largest),
                shown(*least),
                (largest / least).log10()
            ),
            Self::EndsAtHinge { hinge, at } => write!(
                f,
                "with all hinges locked the outer end of segment {hinge} is back at hinge {at}"
            ),
        }
    }
}

pub(crate) fn find(scene: &Scene) -> Vec<ModelWarning> {
    let all = [
        releases::find,
        forces::find,
        tables::find,
        outside::find,
        rotors::find,
        geometry::find,
        masses::find,
    ];
    all.map(|find| find(scene)).concat()
}
