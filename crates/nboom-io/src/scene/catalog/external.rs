//! The tables of forces and torques from outside.

use super::super::keys::Holds::{Choice, Number, Numbers, Rows};
use super::super::keys::{Key, TableKind};
use super::{optional, required, table};

/// Along whose axes what acts from outside may be given.
pub(crate) const ALONG: &[&str] = &["body", "inertial"];

const AXES: Key = optional(
    "axes",
    Choice(ALONG),
    "Along whose axes it keeps its direction: those of the body (the default) or inertial ones.",
);
const FROM: Key =
    optional("from", Number, "Time at which it starts; by default it acts from the first.");
const UNTIL: Key = optional("until", Number, "Time at which it stops; by default it never does.");
const OVER_TIME: Key = optional(
    "over_time",
    Rows(2),
    "In place of `from` and `until`: its share at ascending times, as a list of pairs of time and share; straight \
     between them, and nothing before the first and from the last on.",
);

pub(super) static THRUSTER: TableKind = table(
    "thruster",
    "A force on a point of a body from outside.",
    &[
        required("force", Numbers(3), "The force."),
        required("point", Numbers(3), "Where it acts, from the body's origin, body axes."),
        AXES,
        FROM,
        UNTIL,
        OVER_TIME,
    ],
);

pub(super) static TORQUE: TableKind = table(
    "torque",
    "A torque on a body from outside.",
    &[
        required("torque", Numbers(3), "The torque."),
        optional(
            "point",
            Numbers(3),
            "Where it acts, from the body's origin, body axes, for the loads of stations; by default the origin.",
        ),
        AXES,
        FROM,
        UNTIL,
        OVER_TIME,
    ],
);
