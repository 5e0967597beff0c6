//! The tables of springs and dampers about a hinge, and of one that pushes its body off.

use super::super::keys::Holds::{Angle, Number, Numbers};
use super::super::keys::TableKind;
use super::{optional, required, table};

pub(super) static SPRING: TableKind = table(
    "spring",
    "Torque −stiffness (β − rest) + quadratic (β − rest)² at the angle β.",
    &[
        required("stiffness", Number, "Torque per radian, positive if it drives towards rest."),
        optional("rest", Angle, "Angle without torque; by default 0."),
        optional("quadratic", Number, "Torque per square radian; by default 0."),
    ],
);

pub(super) static DAMPER: TableKind = table(
    "damper",
    "Torque −damping τ + rate_squared τ² + angle (β − rest) + angle_squared (β − rest)² at the angle β \
     and the rate τ.",
    &[
        optional("damping", Number, "Torque per rate, positive if it brakes; by default 0."),
        optional("rate_squared", Number, "Torque per squared rate; by default 0."),
        optional("angle", Number, "Torque per radian; by default 0."),
        optional("angle_squared", Number, "Torque per square radian; by default 0."),
        optional("rest", Angle, "Angle from which these two count; by default 0."),
    ],
);

pub(super) static KICK_OFF: TableKind = table(
    "kick_off",
    "A spring between the main body and this one. Its force depends on its length and ends at a \
     limit.",
    &[
        required("main_body_end", Numbers(3), "Its end on the main body, from O."),
        required("end", Numbers(3), "Its end on this body, from the hinge, body axes."),
        required(
            "force",
            Numbers(4),
            "Force a + b x + c x² + d x³ at the length x, as [a, b, c, d].",
        ),
        required("limit", Number, "Length from which on it does not push, not below zero."),
    ],
);
