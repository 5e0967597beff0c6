//! The table of a joint that slides.

use super::super::keys::Holds::{Choice, Direction, Number, Numbers, Rows, Table};
use super::super::keys::TableKind;
use super::{AXES, RELEASE, RESTITUTION, STATES, optional, required, table};

pub(super) static SLIDE: TableKind = table(
    "slide",
    "A joint that slides, as the stage of a telescopic mast. The travel counts along the axis and is zero \
     where the body is drawn; the body does not turn.",
    &[
        required(
            "at",
            Numbers(3),
            "Where the body's origin is on the inboard body at travel zero, from its origin, its axes.",
        ),
        required("axis", Direction, "Direction in which the travel grows, body axes."),
        optional("axes", Table(&AXES), "Turns the body's axes."),
        optional("start", Number, "Travel at the start; by default 0."),
        optional("speed", Number, "Speed at the start, of a free joint; by default 0."),
        optional(
            "state",
            Choice(STATES),
            "How it starts; by default held if it has a release, else free.",
        ),
        optional("release", Table(&RELEASE), "When a held joint becomes free; by default never."),
        optional("latch", Number, "Travel at which it locks for good; by default it never does."),
        optional(
            "stops",
            Numbers(2),
            "The least and the largest travel, at which its motion ends; -inf or inf for none on that side; by default none.",
        ),
        optional("restitution", Number, RESTITUTION),
        optional("spring", Table(&SLIDE_SPRING), "A spring along its axis."),
        optional("damper", Table(&SLIDE_DAMPER), "A damper along its axis."),
        optional("friction", Number, "Force of Coulomb's friction, zero or more; by default 0."),
        optional(
            "force",
            Rows(2),
            "Force by travel as a list of pairs, smooth between them, straight beyond the first and last; positive drives to larger travel.",
        ),
    ],
);

static SLIDE_SPRING: TableKind = table(
    "slide_spring",
    "Force −stiffness (β − rest) + quadratic (β − rest)² at the travel β.",
    &[
        required("stiffness", Number, "Force per length, positive if it drives towards rest."),
        optional("rest", Number, "Travel without force; by default 0."),
        optional("quadratic", Number, "Force per squared length; by default 0."),
    ],
);

static SLIDE_DAMPER: TableKind = table(
    "slide_damper",
    "Force −damping τ + speed_squared τ² + travel (β − rest) + travel_squared (β − rest)² at the travel β \
     and the speed τ.",
    &[
        optional("damping", Number, "Force per speed, positive if it brakes; by default 0."),
        optional("speed_squared", Number, "Force per squared speed; by default 0."),
        optional("travel", Number, "Force per length; by default 0."),
        optional("travel_squared", Number, "Force per squared length; by default 0."),
        optional("rest", Number, "Travel from which these two count; by default 0."),
    ],
);
