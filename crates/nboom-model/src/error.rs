mod quantities;

use std::fmt;

use crate::{
    ExternalKind, ExternalPart, Finding, HingeLabel, HingeState, Joint, MassDefect, RotorPart,
    shown,
};

pub use quantities::{BaseQuantity, HingeQuantity, SceneQuantity, UnitQuantity};

/// Which body a message is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BodyName {
    /// The main body.
    MainBody,
    /// The body outboard of this hinge.
    Segment(HingeLabel),
}

impl fmt::Display for BodyName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MainBody => write!(f, "main body"),
            Self::Segment(label) => write!(f, "segment {label}"),
        }
    }
}

/// Why a description is not a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.finding_at_place())]
#[non_exhaustive]
pub enum ModelError {
    /// No rigid body has these mass properties.
    Mass {
        /// The body.
        body: BodyName,
        /// What is wrong with it.
        defect: MassDefect,
    },
    /// A number of the scene or of its main body is infinite or not a number.
    NotFinite {
        /// Which number.
        quantity: SceneQuantity,
    },
    /// A number of a hinge is infinite or not a number.
    NotFiniteInHinge {
        /// The hinge.
        label: HingeLabel,
        /// Which number.
        quantity: HingeQuantity,
    },
    /// Bodies are not listed branch by branch, inboard before outboard.
    Order {
        /// The hinge.
        label: HingeLabel,
        /// Index of the inboard body, from 0.
        inboard: usize,
    },
    /// A main body that is held starts otherwise than it is held.
    HeldBase {
        /// What starts otherwise.
        quantity: BaseQuantity,
        /// Its components.
        found: [f64; 3],
        /// What they would be.
        expected: [f64; 3],
    },
    /// A prescribed motion of the main body is none.
    Drive {
        /// What is wrong with it.
        finding: Finding,
    },
    /// A hinge axis is not a unit vector.
    Axis {
        /// The hinge.
        label: HingeLabel,
        /// Length of the given axis.
        length: f64,
    },
    /// A mount is not a rotation.
    MountRotation {
        /// The hinge.
        label: HingeLabel,
        /// Largest departure.
        defect: f64,
    },
    /// A release refers to a hinge that does not exist, or to itself.
    Trigger {
        /// The hinge.
        label: HingeLabel,
        /// Index of the trigger, from 0.
        trigger: usize,
        /// How many hinges there are.
        count: usize,
    },
    /// A hinge is to be released before the lock-up that it waits for.
    ReleaseDelay {
        /// The hinge.
        label: HingeLabel,
        /// The given delay.
        delay: f64,
    },
    /// A hinge that starts held has a rate.
    HeldRate {
        /// The hinge.
        label: HingeLabel,
        /// The given rate.
        rate: f64,
    },
    /// Friction drives a hinge.
    NegativeFriction {
        /// The hinge.
        label: HingeLabel,
        /// The given friction.
        friction: f64,
    },
    /// Stops between which a hinge can not be.
    Stops {
        /// The hinge.
        label: HingeLabel,
        /// What was found and what expected.
        finding: Finding,
    },
    /// A hinge rebounds faster than it comes, or not away from its stop.
    Restitution {
        /// The hinge.
        label: HingeLabel,
        /// The given share.
        restitution: f64,
    },
    /// A hinge starts in a state in which none starts.
    StartState {
        /// The hinge.
        label: HingeLabel,
        /// The given state.
        state: HingeState,
    },
    /// A kick-off spring acts up to a length below zero.
    KickOffLimit {
        /// The hinge.
        label: HingeLabel,
        /// The length.
        limit: f64,
    },
    /// The direction of gravity or the initial attitude does not have length 1.
    NotUnit {
        /// Which of the two.
        quantity: UnitQuantity,
        /// Its length.
        length: f64,
    },
    /// The run ends before it starts.
    EndTime {
        /// Initial time.
        start: f64,
        /// End time.
        end: f64,
    },
    /// A torque table is of no hinge, or of one that has a table already.
    TableHinge {
        /// Index of the table, from 0.
        table: usize,
        /// Index of the hinge, from 0.
        hinge: usize,
        /// How many hinges there are.
        count: usize,
    },
    /// A torque table, of a slide a force table, does not have two points with finite numbers, or they do not
    /// ascend.
    TablePoints {
        /// That on which it acts.
        joint: Joint,
        /// Index of the table, from 0.
        table: usize,
        /// What was found.
        defect: String,
    },
    /// A coupling that is not between two hinges, or whose numbers are not finite.
    Coupling {
        /// The first hinge, or that of the first body where there is none.
        label: HingeLabel,
        /// What is wrong with it.
        finding: Finding,
    },
    /// A rotor is in no body of the scene, or its numbers are those of none.
    Rotor {
        /// Its place in [`SceneDescription::rotors`](crate::SceneDescription::rotors).
        rotor: usize,
        /// The body that carries it; `None` is the main body.
        body: Option<usize>,
        /// What of it is wrong.
        part: RotorPart,
        /// What is wrong with it.
        finding: Finding,
    },
    /// A force or torque from outside acts on no body of the scene, or its numbers or times are wrong.
    External {
        /// Its place in [`SceneDescription::externals`](crate::SceneDescription::externals).
        index: usize,
        /// A force or a torque.
        kind: ExternalKind,
        /// What of it is wrong.
        part: ExternalPart,
        /// What is wrong with it.
        finding: Finding,
    },
}

impl ModelError {
    /// What of the scene it is about, as `segment 1,2`; none where what was found says so itself.
    pub fn place(&self) -> Option<String> {
        Some(match self {
            Self::Mass { body, .. } => body.to_string(),
            Self::NotFinite { quantity } if quantity.is_of_main_body() => {
                BodyName::MainBody.to_string()
            }
            Self::HeldBase { .. } | Self::Drive { .. } => BodyName::MainBody.to_string(),
            Self::NotFiniteInHinge { label, .. }
            | Self::Order { label, .. }
            | Self::Axis { label, .. }
            | Self::MountRotation { label, .. }
            | Self::Trigger { label, .. }
            | Self::ReleaseDelay { label, .. }
            | Self::HeldRate { label, .. }
            | Self::NegativeFriction { label, .. }
            | Self::Stops { label, .. }
            | Self::Restitution { label, .. }
            | Self::StartState { label, .. }
            | Self::KickOffLimit { label, .. }
            | Self::Coupling { label, .. } => format!("segment {label}"),
            Self::TableHinge { table, .. } => format!("torque table {}", number(*table)),
            Self::TablePoints { table, joint, .. } => {
                format!("{} table {}", joint.force_name(), number(*table))
            }
            Self::Rotor { rotor, .. } => format!("rotor {}", number(*rotor)),
            Self::NotFinite { .. }
            | Self::NotUnit { .. }
            | Self::EndTime { .. }
            | Self::External { .. } => return None,
        })
    }

    /// What was found and what expected, without the place.
    pub fn finding(&self) -> Finding {
        match self {
            Self::Mass { defect, .. } => defect.finding(),
            Self::NotFinite { quantity } => not_finite(quantity),
            Self::NotFiniteInHinge { quantity, .. } => not_finite(quantity),
            Self::Order { inboard, .. } => Finding::new(
                format!("inboard body {inboard}"),
                "an earlier body of the same branch",
            ),
            Self::HeldBase { quantity, found, expected } => Finding::new(
                format!("{quantity} of {found:?}"),
                format!("{expected:?} of a main body that is held"),
            ),
            Self::Drive { finding } => finding.clone().after("prescribed motion with "),
            Self::Axis { length, .. } => {
                Finding::new(format!("hinge axis of length {}", shown(*length)), "1")
            }
            Self::MountRotation { defect, .. } => Finding::new(
                format!(
                    "mounting axes that depart by {} from a right-handed orthonormal triad",
                    shown(*defect)
                ),
                "such a triad",
            ),
            Self::Trigger { trigger, count, .. } => Finding::new(
                format!("release by hinge number {}", number(*trigger)),
                format!("another of the {count} hinges"),
            ),
            Self::ReleaseDelay { delay, .. } => Finding::new(
                format!("release {} time units after a lock-up", shown(*delay)),
                "zero or more",
            ),
            Self::HeldRate { rate, .. } => {
                Finding::new(format!("rate {}", shown(*rate)), "zero of a hinge that starts held")
            }
            Self::NegativeFriction { friction, .. } => {
                Finding::new(format!("friction {}", shown(*friction)), "zero or more")
            }
            Self::Stops { finding, .. } => finding.clone(),
            Self::Restitution { restitution, .. } => {
                Finding::new(format!("restitution {}", shown(*restitution)), "a share from 0 to 1")
            }
            Self::StartState { state, .. } => {
                let states = HingeState::AT_START.map(HingeState::name).join(", ");
                Finding::new(
                    format!("the initial state {}", state.name()),
                    format!("one of {states}"),
                )
            }
            Self::KickOffLimit { limit, .. } => Finding::new(
                format!("kick-off spring up to length {}", shown(*limit)),
                "a length not below zero",
            ),
            Self::NotUnit { quantity, length } => {
                Finding::new(format!("{quantity} of length {}", shown(*length)), "1")
            }
            Self::EndTime { start, end } => Finding::new(
                format!("end time {}", shown(*end)),
                format!("a time not before the initial time {}", shown(*start)),
            ),
            Self::TableHinge { hinge, count, .. } => Finding::new(
                format!("hinge number {}", number(*hinge)),
                format!("one of the {count} hinges without another table"),
            ),
            Self::TablePoints { joint, defect, .. } => {
                let places = if joint.slides() { "travels" } else { "angles" };
                let expected =
                    format!("two or more points of finite numbers at ascending {places}");
                Finding::new(defect, expected)
            }
            Self::Coupling { finding, .. } => finding.clone().after("coupling "),
            Self::Rotor { finding, .. } => finding.clone(),
            Self::External { kind, finding, .. } => {
                finding.clone().after(format_args!("{} ", kind.name()))
            }
        }
    }

    /// What was found, with the place before it, and what expected.
    pub fn finding_at_place(&self) -> Finding {
        match self.place() {
            Some(place) => self.finding().after(format_args!("{place}: ")),
            None => self.finding(),
        }
    }
}

fn not_finite(quantity: impl fmt::Display) -> Finding {
    Finding::new(format!("{quantity} that is not finite"), "finite numbers")
}

/// What users call the index of something.
fn number(index: usize) -> usize {
    index.saturating_add(1)
}
