//! The table of a rotor.

use super::super::keys::Holds::{Angle, Direction, Number};
use super::super::keys::TableKind;
use super::{required, table};

pub(super) static ROTOR: TableKind = table(
    "rotor",
    "A balanced rotor, such as a momentum wheel, that a motor keeps at a constant speed relative to its body. \
     Its mass and its inertia across the axis belong to the body.",
    &[
        required("axis", Direction, "Its axis, body axes; it turns by the right hand."),
        required("inertia", Number, "Inertia about its axis, which is not in that of the body."),
        required("speed", Angle, "Speed relative to the body."),
    ],
);
