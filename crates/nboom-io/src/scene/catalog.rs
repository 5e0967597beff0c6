//! The tables of a scene and their keys.

mod coupling;
mod drive;
mod external;
mod laws;
mod output;
mod rotor;
mod shape;
mod slide;
mod strength;

use nboom_model::HingeState;

use super::keys::Holds::{
    Angle, AnglePairs, Angles, Choice, ChoiceOr, Count, Direction, Inertia, Named, NamedNumbers,
    Number, Numbers, Rows, Table, Tables, Text, Texts,
};
use super::keys::{Holds, Key, TableKind};
pub(crate) use coupling::ACTS_ON;
use coupling::COUPLING;
use drive::DRIVE;
pub(crate) use external::ALONG;
use external::{THRUSTER, TORQUE};
use laws::{DAMPER, KICK_OFF, SPRING};
use output::OUTPUT;
use rotor::ROTOR;
use shape::SHAPE;
use slide::SLIDE;
use strength::{MATERIAL, STATION};

const fn optional(name: &'static str, holds: Holds, about: &'static str) -> Key {
    Key { name, holds, is_required: false, about }
}

const fn required(name: &'static str, holds: Holds, about: &'static str) -> Key {
    Key { name, holds, is_required: true, about }
}

const fn table(name: &'static str, about: &'static str, keys: &'static [Key]) -> TableKind {
    TableKind { name, about, keys, one_of: &[] }
}

const fn choice(
    name: &'static str,
    about: &'static str,
    keys: &'static [Key],
    one_of: &'static [&'static str],
) -> TableKind {
    TableKind { name, about, keys, one_of }
}

/// The names of the unit sets.
pub(crate) const UNIT_SETS: &[&str] = &["none", "SI", "ft-lbf-s", "in-lbf-s"];

/// In what angles of a table that is asked for may be.
pub(crate) const ANGLE_UNITS: &[&str] = &["radians", "degrees"];

/// What a body may say of its slices.
pub(crate) const SLICES: &[&str] = &["differ"];

/// Files that a run writes if they are asked for.
pub(crate) const FILES_ON_REQUEST: &[&str] = &["hinge_loads", "listing"];

/// How a main body is held.
pub(crate) const BASES: &[&str] = &["free", "fixed"];

/// What the key of a hinge and of a slide is about.
const RESTITUTION: &str =
    "Share of its rate at which it rebounds from its stops, from 0 to 1; by default 0.";

/// The states in which a hinge may start.
pub(crate) const STATES: &[&str] = &{
    let [first, second, third] = HingeState::AT_START;
    [first.name(), second.name(), third.name()]
};

/// A scene.
pub static SCENE: TableKind = table(
    "scene",
    "What a file of a scene contains.",
    &[
        optional("name", Text, "What the scene is called; by default the name of the file."),
        optional(
            "units",
            ChoiceOr(UNIT_SETS, &UNITS),
            "The units of all numbers, which must be consistent: SI, ft-lbf-s, in-lbf-s, none (the \
         default), or a table with labels. They name numbers in results and convert none.",
        ),
        optional(
            "include",
            Texts,
            "Files with further parameters, materials and bodies, relative to this one.",
        ),
        optional(
            "parameters",
            NamedNumbers,
            "Numbers for expressions: \"$name\", with + - * / and brackets, stands for a number \
         anywhere. The command line sets them with --set name=value.",
        ),
        required("run", Table(&RUN), "When the run starts and ends."),
        optional("output", Table(&OUTPUT), "What is written, and at which times."),
        required("main_body", Table(&MAIN_BODY), "The body that carries all others."),
        optional(
            "initial",
            Table(&INITIAL),
            "Motion of the main body at the start; by default at rest.",
        ),
        optional("gravity", Table(&GRAVITY), "Uniform gravity."),
        optional(
            "thrust",
            Table(&THRUST),
            "A thrust fixed in the main body: short for a thruster of it.",
        ),
        optional("materials", Named(&MATERIAL), "Materials by name."),
        optional("body", Tables(&BODY), "The hinged bodies."),
    ],
);

/// A file that a scene includes.
pub(crate) static PART: TableKind = table(
    "included file",
    "What an included file contains.",
    &[
        optional("include", Texts, "Files with further parameters, materials and bodies."),
        optional("parameters", NamedNumbers, "Numbers for expressions."),
        optional("materials", Named(&MATERIAL), "Materials by name."),
        optional("body", Tables(&BODY), "Hinged bodies."),
    ],
);

static UNITS: TableKind = table(
    "units",
    "Labels of units of the scene's own.",
    &[
        required("length", Text, "Label of lengths."),
        required("time", Text, "Label of times."),
        required("force", Text, "Label of forces."),
    ],
);

static RUN: TableKind = table(
    "run",
    "When the run starts and ends.",
    &[
        optional("start", Number, "Initial time; by default 0."),
        required("end", Number, "Time at which the run ends."),
    ],
);

static MAIN_BODY: TableKind = table(
    "main_body",
    "The body that carries all others. Its origin is the point O, its axes are those of all \
     positions on it.",
    &[
        required("mass", Number, "Mass of the main body."),
        optional("mass_centre", Numbers(3), "Mass centre, from O; by default O."),
        required("inertia", Inertia(&INERTIA), "Inertia about the mass centre."),
        optional(
            "base",
            Choice(BASES),
            "How it is held: \"free\" (the default), or \"fixed\" to the ground, as on a test rig.",
        ),
        optional("drive", Table(&DRIVE), "The motion that is prescribed for it."),
        optional("rotor", Tables(&ROTOR), "Rotors in it, as momentum wheels."),
        optional("thruster", Tables(&THRUSTER), "Forces on it from outside."),
        optional("torque", Tables(&TORQUE), "Torques on it from outside."),
        optional("shape", Table(&SHAPE), "What it looks like in pictures."),
    ],
);

static INERTIA: TableKind = table(
    "inertia",
    "Moments and products of inertia about the mass centre, body axes. Products have the sign of \
     the tensor: xy is the integral of −x y dm.",
    &[
        required("xx", Number, "Moment about x."),
        required("yy", Number, "Moment about y."),
        required("zz", Number, "Moment about z."),
        optional("xy", Number, "Product of x and y; by default 0."),
        optional("xz", Number, "Product of x and z; by default 0."),
        optional("yz", Number, "Product of y and z; by default 0."),
    ],
);

static INITIAL: TableKind = table(
    "initial",
    "Motion of the main body at the start.",
    &[
        optional(
            "attitude",
            Table(&AXES),
            "How its axes stand to the inertial ones; by default alike.",
        ),
        optional("rate", Angles(3), "Angular rate, main-body axes; by default zero."),
        optional("position", Numbers(3), "Inertial position of O; by default the inertial origin."),
        optional("velocity", Numbers(3), "Inertial velocity of O, inertial axes; by default zero."),
    ],
);

static AXES: TableKind = choice(
    "axes",
    "A rotation, in one of four ways.",
    &[
        optional(
            "euler_xyx",
            Angles(3),
            "Three turns: about x, then about the new y, then about the new x.",
        ),
        optional("turn", Table(&TURN), "One turn about an axis."),
        optional("columns", Rows(3), "The turned x, y and z axes as three lists of three numbers."),
        optional("quaternion", Numbers(4), "Unit quaternion, scalar first."),
    ],
    &["euler_xyx", "turn", "columns", "quaternion"],
);

static TURN: TableKind = table(
    "turn",
    "A turn about an axis by the right hand.",
    &[required("about", Direction, "The axis."), required("by", Angle, "The angle.")],
);

static GRAVITY: TableKind = table(
    "gravity",
    "Uniform gravity.",
    &[
        required("acceleration", Number, "Magnitude of the acceleration."),
        required("up", Direction, "Direction away from the attracting body, inertial axes."),
    ],
);

static THRUST: TableKind = table(
    "thrust",
    "A thrust fixed in the main body.",
    &[
        required("force", Numbers(3), "Force on the main body, its axes."),
        required("point", Numbers(3), "Where it acts, from O, main-body axes."),
        required("from", Number, "Time at which it starts."),
        required("until", Number, "Time at which it stops."),
    ],
);

static BODY: TableKind = choice(
    "body",
    "A rigid body on a hinge or on a joint that slides, of which it has one. Its origin is the hinge. Its \
     axes are parallel to those of its inboard body when the hinge angle is zero, unless hinge.axes or \
     slide.axes turns them.",
    &[
        required("name", Text, "What messages, releases and other bodies call it; unique."),
        optional(
            "on",
            Text,
            "Name of the inboard body; by default the main body, which `main_body` means too if no body is \
             called so.",
        ),
        required("mass", Number, "Mass of the body; 0 of a gimbal ring or a wheel."),
        required("mass_centre", Numbers(3), "Mass centre, from the hinge, body axes."),
        required("inertia", Inertia(&INERTIA), "Inertia about the mass centre, body axes."),
        optional(
            "tip",
            Numbers(3),
            "The outer end, from the hinge, body axes; for pictures only. By default twice as far as \
             the mass centre.",
        ),
        optional(
            "shape",
            Table(&SHAPE),
            "What it looks like in pictures; by default a line to its tip.",
        ),
        optional("hinge", Table(&HINGE), "The hinge that joins it to its inboard body."),
        optional("slide", Table(&SLIDE), "The joint that slides along its inboard body."),
        optional("kick_off", Table(&KICK_OFF), "A spring that pushes it off the main body."),
        optional(
            "coupling",
            Tables(&COUPLING),
            "Springs and dampers between its hinge and others.",
        ),
        optional("rotor", Tables(&ROTOR), "Rotors in it, as momentum wheels."),
        optional("thruster", Tables(&THRUSTER), "Forces on it from outside."),
        optional("torque", Tables(&TORQUE), "Torques on it from outside."),
        optional(
            "repeat",
            Table(&REPEAT),
            "Makes several of it, with all that is outboard of it, evenly about an axis; for a body on \
             the main body. Copies are called \"name 1\", \"name 2\", …",
        ),
        optional("material", Text, "Name of its material; needed with stations."),
        optional(
            "pulse_constant",
            Number,
            "Impulse over peak, a time, of the pulses of its hinge's latch and stops; needed with stations if the hinge has either and turns.",
        ),
        optional(
            "slices",
            Choice(SLICES),
            "Says that slices need not add up to the body, as in some decks; by default they must.",
        ),
        optional(
            "station",
            Tables(&STATION),
            "Where stresses are wanted, outboard before inboard.",
        ),
    ],
    &["hinge", "slide"],
);

static HINGE: TableKind = table(
    "hinge",
    "A hinge. Angles are relative to the inboard body and zero as the body is drawn: write where \
     things are deployed and start at the stowed angle, or the reverse.",
    &[
        required("at", Numbers(3), "Where it is on the inboard body, from its origin, its axes."),
        required(
            "axis",
            Direction,
            "Direction of its axis, body axes; angles follow the right hand.",
        ),
        optional("axes", Table(&AXES), "Turns the body's axes at angle zero."),
        optional("start", Angle, "Angle at the start; by default 0."),
        optional("rate", Angle, "Rate at the start, of a free hinge; by default 0."),
        optional(
            "state",
            Choice(STATES),
            "How it starts; by default held if it has a release, else free.",
        ),
        optional("release", Table(&RELEASE), "When a held hinge becomes free; by default never."),
        optional("latch", Angle, "Angle at which it locks for good; by default it never does."),
        optional(
            "stops",
            Angles(2),
            "The least and the largest angle, at which its motion ends; -inf or inf for none on that side; by default none.",
        ),
        optional("restitution", Number, RESTITUTION),
        optional("spring", Table(&SPRING), "A spring about its axis."),
        optional("damper", Table(&DAMPER), "A damper about its axis."),
        optional("friction", Number, "Torque of Coulomb's friction, zero or more; by default 0."),
        optional(
            "torque",
            AnglePairs,
            "Torque by angle as a list of pairs, smooth between them, straight beyond the first and last; positive opens to larger angles.",
        ),
    ],
);

static RELEASE: TableKind = choice(
    "release",
    "When a held hinge becomes free.",
    &[
        optional("at", Number, "At this time."),
        optional(
            "when",
            Text,
            "When the hinge of this body passes the angle `passes`, or the travel `reaches`, either way.",
        ),
        optional("passes", Angle, "That angle; with `when`."),
        optional(
            "reaches",
            Number,
            "With `when`, of a body that slides: when its travel passes this one, either way.",
        ),
        optional("after", Text, "After the hinge of this body has latched."),
        optional("by", Number, "How long after; with `after`; by default 0, at the same instant."),
    ],
    &["at", "when", "after"],
);

static REPEAT: TableKind = table(
    "repeat",
    "Several bodies evenly about an axis through O.",
    &[
        required("count", Count, "How many, the first where it is written."),
        required("about", Direction, "The axis, main-body axes."),
    ],
);
