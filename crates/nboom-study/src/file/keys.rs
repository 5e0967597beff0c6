//! What a study may say: one list, for the reader, its messages and the schema.

use nboom_io::MOST_SAMPLES;
use nboom_sim::{Form, Method as Integrator, Path as Code};
use nboom_strength::PulseShape;
use serde_json::{Map, Value, json};

use crate::plan::MOST_DRAWS;
use crate::study::{FailureMode, Relation};

/// A table of a study.
#[derive(Debug)]
pub(super) struct Table {
    pub about: &'static str,
    pub keys: &'static [Key],
}

/// A key of a table.
#[derive(Debug)]
pub(super) struct Key {
    pub name: &'static str,
    pub holds: Holds,
    pub about: &'static str,
    pub is_required: bool,
}

/// What a key holds.
#[derive(Debug)]
pub(super) enum Holds {
    Text,
    Texts,
    OneOf(fn() -> Vec<&'static str>),
    Number,
    Numbers,
    /// Between these, ends included.
    Whole(u64, u64),
    Flag,
    Table(&'static Table),
    /// One table, or a list of them.
    Some(&'static Table),
    Tables(&'static Table),
}

/// The largest seed, which tables in any format keep.
pub(super) const LARGEST_SEED: u64 = 1 << 53;

/// Methods of draws by their names.
pub(super) fn methods() -> Vec<&'static str> {
    crate::Method::ALL.map(crate::Method::name).into()
}

fn relations() -> Vec<&'static str> {
    Relation::ALL.map(Relation::name).into()
}

fn integrators() -> Vec<&'static str> {
    Integrator::ALL.map(Integrator::name).into()
}

fn forms() -> Vec<&'static str> {
    Form::all().map(Form::name).collect()
}

fn codes() -> Vec<&'static str> {
    Code::ALL.map(Code::name).into()
}

fn pulses() -> Vec<&'static str> {
    PulseShape::ALL.map(PulseShape::name).into()
}

const fn key(name: &'static str, holds: Holds, about: &'static str) -> Key {
    Key { name, holds, about, is_required: false }
}

const fn required(name: &'static str, holds: Holds, about: &'static str) -> Key {
    Key { name, holds, about, is_required: true }
}

const fn failing(mode: FailureMode) -> Key {
    key(mode.name(), Holds::Texts, mode.about())
}

/// A study.
pub(super) const STUDY: Table = Table {
    about: "a study: a scene that is run many times with varied numbers",
    keys: &[
        required("scene", Holds::Text, "the scene, from the folder of the study"),
        key("name", Holds::Text, "its name, and that of its directory; by default the file's"),
        key("expanded", Holds::Flag, "whether each body of a repeat has numbers of its own"),
        key("seed", Holds::Whole(0, LARGEST_SEED), "of everything random; by default 1"),
        key("method", Holds::OneOf(methods), "how draws are made; by default monte_carlo"),
        key("draws", Holds::Whole(1, MOST_DRAWS), "how many draws there are, but of a grid"),
        key("results", Holds::Texts, "what stands in the table of each run"),
        key("trajectories", Holds::Flag, "whether tables of states of all cases are wanted"),
        key("run", Holds::Table(&RUN), "options of the runs"),
        key("vary", Holds::Tables(&VARY), "numbers that vary"),
        key("correlation", Holds::Tables(&CORRELATION), "variables that vary together"),
        key("fault", Holds::Tables(&FAULT), "what may be broken"),
        key("requirement", Holds::Tables(&REQUIREMENT), "bounds that results should keep"),
    ],
};

pub(super) const RUN: Table = Table {
    about: "options of nboom run",
    keys: &[
        key("rtol", Holds::Number, "relative error allowed in a step"),
        key("atol", Holds::Number, "absolute error allowed in a step, as a share of natural sizes"),
        key("integrator", Holds::OneOf(integrators), "method of integration"),
        key("formulation", Holds::OneOf(forms), "form of the equations of motion"),
        key("path", Holds::OneOf(codes), "which code computes accelerations"),
        key("max_step", Holds::Number, "longest step"),
        key("max_steps", Holds::Whole(1, u32::MAX as u64), "steps after which a run is given up"),
        key("max_events", Holds::Whole(1, u32::MAX as u64), "events after which a run is given up"),
        key("samples", Holds::Whole(1, MOST_SAMPLES as u64), "output times after the initial one"),
        key("end_time", Holds::Number, "end of the runs, instead of the scene's"),
        key("stresses", Holds::Flag, "whether stresses are computed if the scene asks for them"),
        key("hinge_loads", Holds::Flag, "whether loads of hinges are computed for any scene"),
        key("yield_stress", Holds::Number, "stress at which all parts yield, for margins"),
        key("safety_factor", Holds::Number, "factor on stresses in margins to yielding"),
        key("ultimate_factor", Holds::Number, "factor on stresses in margins to breaking"),
        key("amplification", Holds::Number, "peak of a response over that of a pulse"),
        key("pulses", Holds::OneOf(pulses), "how pulses that act together add up"),
        key(
            "lanes",
            Holds::Flag,
            "whether steps of eight runs are taken side by side; by default true",
        ),
    ],
};

pub(super) const VARY: Table = Table {
    about: "a number that varies",
    keys: &[
        key("name", Holds::Text, "the name of its column; by default its path"),
        key("path", Holds::Text, "its place in the scene"),
        key("paths", Holds::Texts, "several places that get the same number"),
        key("as", Holds::OneOf(relations), "how it changes the scene's; by default value"),
        key("uniform", Holds::Table(&UNIFORM), "all numbers between two alike"),
        key("points", Holds::Whole(2, MOST_DRAWS), "in a grid: points of `uniform`, ends included"),
        key("normal", Holds::Table(&NORMAL), "by Gauss"),
        key("log_normal", Holds::Table(&LOG_NORMAL), "the logarithm by Gauss"),
        key("values", Holds::Numbers, "one of these"),
        key("weights", Holds::Numbers, "in what proportion these come; by default alike"),
    ],
};

pub(super) const UNIFORM: Table = Table {
    about: "all numbers between two alike",
    keys: &[
        required("from", Holds::Number, "the least"),
        required("to", Holds::Number, "the largest"),
    ],
};

pub(super) const NORMAL: Table = Table {
    about: "numbers by Gauss",
    keys: &[
        required("mean", Holds::Number, "mean"),
        required("deviation", Holds::Number, "standard deviation"),
        key("from", Holds::Number, "the least, below which it is cut off"),
        key("to", Holds::Number, "the largest"),
    ],
};

pub(super) const LOG_NORMAL: Table = Table {
    about: "numbers whose logarithms are by Gauss",
    keys: &[
        required("median", Holds::Number, "median"),
        required("sigma", Holds::Number, "standard deviation of the natural logarithm"),
        key("from", Holds::Number, "the least, below which it is cut off"),
        key("to", Holds::Number, "the largest"),
    ],
};

pub(super) const CORRELATION: Table = Table {
    about: "two variables that vary together",
    keys: &[
        required("between", Holds::Texts, "their names"),
        required("coefficient", Holds::Number, "correlation of their normal scores"),
    ],
};

pub(super) const FAULT: Table = Table {
    about: "something that is broken",
    keys: &[
        required("name", Holds::Text, "what it is called"),
        failing(FailureMode::Stuck),
        failing(FailureMode::MissedRelease),
        key("late_release", Holds::Some(&LATE_RELEASE), "hinges that are released late"),
        failing(FailureMode::FailedLatch),
        failing(FailureMode::BrokenSpring),
        key("change", Holds::Tables(&CHANGE), "other numbers of the scene"),
    ],
};

pub(super) const LATE_RELEASE: Table = Table {
    about: "a release that comes late",
    keys: &[
        required("hinge", Holds::Text, "the hinge"),
        required("by", Holds::Number, "by how much"),
    ],
};

pub(super) const CHANGE: Table = Table {
    about: "another number at a place of the scene",
    keys: &[
        required("path", Holds::Text, "the place"),
        key("value", Holds::Number, "takes the place of the number that is there"),
        key("factor", Holds::Number, "multiplies it"),
        key("offset", Holds::Number, "is added to it"),
    ],
};

pub(super) const REQUIREMENT: Table = Table {
    about: "bounds that a result should keep",
    keys: &[
        required("result", Holds::Text, "the result, one of those in the table"),
        key("at_least", Holds::Number, "the smallest number that meets it"),
        key("at_most", Holds::Number, "the largest number that meets it"),
    ],
};

impl Table {
    pub fn key(&self, name: &str) -> Option<&Key> {
        self.keys.iter().find(|key| key.name == name)
    }
}

impl Holds {
    /// In words.
    pub fn words(&self) -> String {
        match self {
            Self::Text => "a text".to_owned(),
            Self::Texts => "a list of texts".to_owned(),
            Self::OneOf(names) => format!("one of {}", names().join(", ")),
            Self::Number => "a number".to_owned(),
            Self::Numbers => "a list of numbers".to_owned(),
            Self::Whole(from, to) => format!("a whole number from {from} to {to}"),
            Self::Flag => "true or false".to_owned(),
            Self::Table(_) => "a table".to_owned(),
            Self::Some(_) => "a table or a list of tables".to_owned(),
            Self::Tables(_) => "a list of tables".to_owned(),
        }
    }

    fn schema(&self) -> Value {
        let list = |items: Value| json!({ "type": "array", "items": items });
        match self {
            Self::Text => json!({ "type": "string" }),
            Self::Texts => list(json!({ "type": "string" })),
            Self::OneOf(names) => json!({ "enum": names() }),
            Self::Number => json!({ "type": "number" }),
            Self::Numbers => list(json!({ "type": "number" })),
            Self::Whole(from, to) => json!({ "type": "integer", "minimum": from, "maximum": to }),
            Self::Flag => json!({ "type": "boolean" }),
            Self::Table(table) => table.schema(),
            Self::Some(table) => json!({ "anyOf": [table.schema(), list(table.schema())] }),
            Self::Tables(table) => list(table.schema()),
        }
    }
}

impl Table {
    fn schema(&self) -> Value {
        let property = |key: &Key| {
            let mut schema = key.holds.schema();
            schema["description"] = json!(key.about);
            (key.name.to_owned(), schema)
        };
        let needed: Vec<&str> =
            self.keys.iter().filter(|key| key.is_required).map(|key| key.name).collect();
        json!({
            "type": "object",
            "description": self.about,
            "properties": self.keys.iter().map(property).collect::<Map<_, _>>(),
            "required": needed,
            "additionalProperties": false,
        })
    }
}

/// The JSON schema of a study, for editors.
pub fn schema() -> Value {
    let mut schema = STUDY.schema();
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("A study of nboom");
    schema
}
