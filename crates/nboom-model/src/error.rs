mod quantities;

use std::fmt;

use crate::{ExternalKind, ExternalPart, HingeLabel, Joint, MassDefect, RotorPart, shown};

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
#[non_exhaustive]
pub enum ModelError {
    /// No rigid body has these mass properties.
    #[error("{body}: {defect}")]
    Mass {
        /// The body.
        body: BodyName,
        /// What is wrong with it.
        defect: MassDefect,
    },
    /// A number of the scene or of its main body is infinite or not a number.
    #[error("{}{quantity} that is not finite found, finite numbers expected", place(*quantity))]
    NotFinite {
        /// Which number.
        quantity: SceneQuantity,
    },
    /// A number of a hinge is infinite or not a number.
    #[error("segment {label}: {quantity} that is not finite found, finite numbers expected")]
    NotFiniteInHinge {
        /// The hinge.
        label: HingeLabel,
        /// Which number.
        quantity: HingeQuantity,
    },
    /// Bodies are not listed branch by branch, inboard before outboard.
    #[error(
        "segment {label}: inboard body {inboard} found, an earlier body of the same branch expected"
    )]
    Order {
        /// The hinge.
        label: HingeLabel,
        /// Index of the inboard body, from 0.
        inboard: usize,
    },
    /// A main body that is held starts otherwise than it is held.
    #[error(
        "main body: {quantity} of {found:?} found, {expected:?} of a main body that is held expected"
    )]
    HeldBase {
        /// What starts otherwise.
        quantity: BaseQuantity,
        /// Its components.
        found: [f64; 3],
        /// What they would be.
        expected: [f64; 3],
    },
    /// A prescribed motion of the main body is none.
    #[error("main body: prescribed motion with {defect} found, {expected} expected")]
    Drive {
        /// What is wrong with it.
        defect: String,
        /// What would be right.
        expected: &'static str,
    },
    /// A hinge axis is not a unit vector.
    #[error("segment {label}: hinge axis of length {} found, 1 expected", shown(*length))]
    Axis {
        /// The hinge.
        label: HingeLabel,
        /// Length of the given axis.
        length: f64,
    },
    /// A mount is not a rotation.
    #[error(
        "segment {label}: mounting axes that depart by {} from a right-handed orthonormal triad found, \
         such a triad expected",
        shown(*defect)
    )]
    MountRotation {
        /// The hinge.
        label: HingeLabel,
        /// Largest departure.
        defect: f64,
    },
    /// A release refers to a hinge that does not exist, or to itself.
    #[error(
        "segment {label}: release by hinge number {} found, another of the {count} hinges expected",
        number(*trigger)
    )]
    Trigger {
        /// The hinge.
        label: HingeLabel,
        /// Index of the trigger, from 0.
        trigger: usize,
        /// How many hinges there are.
        count: usize,
    },
    /// A hinge is to be released before the lock-up that it waits for.
    #[error(
        "segment {label}: release {} time units after a lock-up found, zero or more expected",
        shown(*delay)
    )]
    ReleaseDelay {
        /// The hinge.
        label: HingeLabel,
        /// The given delay.
        delay: f64,
    },
    /// A hinge that starts held has a rate.
    #[error("segment {label}: rate {} found, zero expected of a hinge that starts held", shown(*rate))]
    HeldRate {
        /// The hinge.
        label: HingeLabel,
        /// The given rate.
        rate: f64,
    },
    /// The direction of gravity or the initial attitude does not have length 1.
    #[error("{quantity} of length {} found, 1 expected", shown(*length))]
    NotUnit {
        /// Which of the two.
        quantity: UnitQuantity,
        /// Its length.
        length: f64,
    },
    /// The run ends before it starts.
    #[error(
        "end time {} found, a time not before the initial time {} expected",
        shown(*end),
        shown(*start)
    )]
    EndTime {
        /// Initial time.
        start: f64,
        /// End time.
        end: f64,
    },
    /// A torque table is of no hinge, or of one that has a table already.
    #[error(
        "torque table {}: hinge number {} found, one of the {count} hinges without another table expected",
        number(*table),
        number(*hinge)
    )]
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
    #[error(
        "{} table {}: {defect} found, two or more points of finite numbers at ascending {} expected",
        joint.force_name(),
        number(*table),
        if joint.slides() { "travels" } else { "angles" }
    )]
    TablePoints {
        /// That on which it acts.
        joint: Joint,
        /// Index of the table, from 0.
        table: usize,
        /// What was found.
        defect: String,
    },
    /// A coupling that is not between two hinges, or whose numbers are not finite.
    #[error("segment {label}: coupling {defect} found, {expected} expected")]
    Coupling {
        /// The first hinge, or that of the first body where there is none.
        label: HingeLabel,
        /// What was found.
        defect: String,
        /// What would have been right.
        expected: &'static str,
    },
    /// A rotor is in no body of the scene, or its numbers are those of none.
    #[error("rotor {}: {defect} found, {expected} expected", number(*rotor))]
    Rotor {
        /// Its place in [`SceneDescription::rotors`](crate::SceneDescription::rotors).
        rotor: usize,
        /// The body that carries it; `None` is the main body.
        body: Option<usize>,
        /// What of it is wrong.
        part: RotorPart,
        /// What was found.
        defect: String,
        /// What would have been right.
        expected: &'static str,
    },
    /// A force or torque from outside acts on no body of the scene, or its numbers or times are wrong.
    #[error("{} {defect} found, {expected} expected", .kind.name())]
    External {
        /// Its place in [`SceneDescription::externals`](crate::SceneDescription::externals).
        index: usize,
        /// A force or a torque.
        kind: ExternalKind,
        /// What of it is wrong.
        part: ExternalPart,
        /// What was found.
        defect: String,
        /// What would have been right.
        expected: &'static str,
    },
}

/// The beginning of a message about a number of the main body.
fn place(quantity: SceneQuantity) -> String {
    let body = quantity.is_of_main_body().then_some(BodyName::MainBody);
    body.map_or_else(String::new, |body| format!("{body}: "))
}

/// What users call the index of something.
fn number(index: usize) -> usize {
    index.saturating_add(1)
}
