//! The table of a spring and a damper between two hinges.

use super::super::keys::Holds::{Angle, Choice, Number, Text};
use super::super::keys::TableKind;
use super::{optional, required, table};

/// On which hinges a coupling may act.
pub(crate) const ACTS_ON: &[&str] = &["both", "this"];

pub(super) static COUPLING: TableKind = table(
    "coupling",
    "A spring and a damper between this hinge and another one, anywhere in the tree: the torque −stiffness \
     (β − ratio β′ − rest) − damping (τ − ratio τ′) on this hinge and −ratio times that on the \
     other, whose angle and rate are β′ and τ′. With acts_on = \"this\" it follows the other hinge and \
     acts on this one alone: −stiffness (ratio β′ − rest) − damping ratio τ′.",
    &[
        required("to", Text, "Name of the other body."),
        optional(
            "ratio",
            Number,
            "How far this hinge goes for each unit of the other; by default 1.",
        ),
        optional(
            "stiffness",
            Number,
            "Torque per radian (of a slide force per length), positive if it drives towards rest; by \
             default 0.",
        ),
        optional("rest", Angle, "Angle without torque, of a hinge that turns; by default 0."),
        optional("rest_length", Number, "Travel without force, of a slide; by default 0."),
        optional(
            "damping",
            Number,
            "Torque or force per rate, positive if it brakes; by default 0.",
        ),
        optional("acts_on", Choice(ACTS_ON), "Both hinges (the default) or this one alone."),
    ],
);
