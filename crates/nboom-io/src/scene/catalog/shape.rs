//! Shapes for pictures.

use super::super::keys::Holds::{Direction, Number, Numbers, Table};
use super::super::keys::TableKind;
use super::{AXES, choice, optional, required, table};

pub(super) static SHAPE: TableKind = choice(
    "shape",
    "What a body looks like in pictures; no motion depends on it.",
    &[
        optional("box", Numbers(3), "A box with these sides along x, y and z."),
        optional(
            "panel",
            Numbers(3),
            "A flat rectangle with these sides along x, y and z, one of which is 0.",
        ),
        optional("cylinder", Table(&CYLINDER), "A circular cylinder."),
        optional("at", Numbers(3), "Its middle, body axes; by default the mass centre."),
        optional(
            "axes",
            Table(&AXES),
            "How its x, y and z stand; by default along the body's axes.",
        ),
    ],
    &["box", "panel", "cylinder"],
);

static CYLINDER: TableKind = table(
    "cylinder",
    "A circular cylinder around its middle.",
    &[
        required("radius", Number, "Of its circles."),
        required("length", Number, "From one circle to the other."),
        required("along", Direction, "Direction of its axis."),
    ],
);
