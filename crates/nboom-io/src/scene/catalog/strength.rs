//! Materials, stations and sections.

use super::super::keys::Holds::{Inertia, Number, Numbers, Rows, Table};
use super::super::keys::TableKind;
use super::{INERTIA, choice, optional, required, table};

pub(super) static MATERIAL: TableKind = table(
    "material",
    "An isotropic material. Where its strength is known, so are margins of the bodies made of it.",
    &[
        required("youngs_modulus", Number, "Young's modulus, positive; no result depends on it."),
        optional(
            "poissons_ratio",
            Number,
            "Poisson's ratio, above -1 and at most 0.5; by default 0.3. No result depends on it.",
        ),
        optional("yield_stress", Number, "Stress at which it yields, for margins."),
        optional("ultimate_stress", Number, "Stress at which it breaks, for margins."),
    ],
);

pub(super) static STATION: TableKind = table(
    "station",
    "A section across the body's y axis, and the slice of the body from it to the next station \
     outboard. The last station is at the hinge.",
    &[
        required("at", Number, "Distance from the hinge along y."),
        required("mass", Number, "Mass of the slice; may be 0."),
        optional(
            "mass_centre",
            Numbers(3),
            "Mass centre of the slice, from the hinge; by default there.",
        ),
        optional("inertia", Inertia(&INERTIA), "Inertia of the slice about it; by default 0."),
        required("section", Table(&SECTION), "The thin walls."),
    ],
);

static SECTION: TableKind = choice(
    "section",
    "A closed thin-walled section.",
    &[
        optional("tube", Table(&TUBE), "A circular tube."),
        optional(
            "polygon",
            Rows(3),
            "Corners in order, each [x, z, thickness of the wall to the next one], from the y axis.",
        ),
    ],
    &["tube", "polygon"],
);

static TUBE: TableKind = table(
    "tube",
    "A circular tube.",
    &[
        required("radius", Number, "To the middle of the wall."),
        required("thickness", Number, "Of the wall."),
    ],
);
