//! What a run writes.

use super::super::keys::Holds::{Choice, Count, List, Number, Texts};
use super::super::keys::TableKind;
use super::{ANGLE_UNITS, optional, table};

pub(super) static OUTPUT: TableKind = table(
    "output",
    "What is written, and at which times. The initial time and the end are always output times; the \
     others are given by `samples`, `every` or `times`.",
    &[
        optional(
            "samples",
            Count,
            "Output times after the initial one, uniform to the end; by default 200.",
        ),
        optional("every", Number, "Time from one output time to the next."),
        optional("times", List, "Output times, ascending."),
        optional(
            "columns",
            Texts,
            "Columns of output.csv, a table of its own beside states.csv: a quantity as \"omega\", that \
             of a hinge as \"beta of NAME\" or \"beta of 1,2\", or a column of states.csv; by default all.",
        ),
        optional(
            "angles",
            Choice(ANGLE_UNITS),
            "What angles and rates of output.csv are in; by default radians. With `columns` or \
             degrees that table is written.",
        ),
        optional(
            "files",
            Texts,
            "Files beside those of every run: \"hinge_loads\" (as --hinge-loads), \"listing\" (as \
             --listing).",
        ),
        optional(
            "stress_every",
            Count,
            "Stresses at every so many output times; by default at all.",
        ),
    ],
);
