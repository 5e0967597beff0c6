//! The table of a rotor.

use super::super::keys::Holds::{Angle, AnglesOverTime, Direction, Number};
use super::super::keys::TableKind;
use super::{choice, optional, required};

pub(super) static ROTOR: TableKind = choice(
    "rotor",
    "A balanced rotor, such as a momentum wheel, whose speed relative to its body a motor commands. Its mass \
     and its inertia across the axis belong to the body.",
    &[
        required("axis", Direction, "Its axis, body axes; it turns by the right hand."),
        required("inertia", Number, "Inertia about its axis, which is not in that of the body."),
        optional("speed", Angle, "Speed relative to the body, always the same."),
        optional(
            "speed_over_time",
            AnglesOverTime,
            "Speeds relative to the body at ascending times, as a list of pairs of time and speed; straight \
             between them, constant before the first and after the last.",
        ),
    ],
    &["speed", "speed_over_time"],
);
