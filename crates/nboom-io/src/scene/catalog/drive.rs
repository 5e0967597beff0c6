//! The table of a prescribed motion.

use super::super::keys::Holds::{AnglesOverTime, Direction, Rows};
use super::super::keys::TableKind;
use super::{optional, required, table};

pub(super) static DRIVE: TableKind = table(
    "drive",
    "The motion that is prescribed for a main body: about an axis through O that keeps its direction, and along \
     it. The main body starts with it.",
    &[
        required("axis", Direction, "The axis, main-body axes."),
        optional(
            "rate",
            AnglesOverTime,
            "Rates about the axis at ascending times, as a list of pairs of time and rate; straight between them, \
             constant before the first and after the last. By default it does not turn.",
        ),
        optional(
            "speed",
            Rows(2),
            "Speeds along the axis, likewise as a list of pairs of time and speed. By default it does not slide.",
        ),
    ],
);
