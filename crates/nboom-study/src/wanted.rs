//! Results of a run, by their texts.

mod hinge;
mod motion;
mod seek;
mod summary;

use nboom_io::SceneFile;
use nboom_model::HingeLabel;
use nboom_results::{SummaryFile, WorstLoads};
use nboom_sim::Summary;
use nboom_strength::Loads;
use nboom_tables::Column;

use crate::hinges;
use crate::row::Value;
use crate::statistics::Meaning;
pub(crate) use hinge::Happened;
pub(crate) use motion::Extreme;

/// A number of a run that is wanted in a table, by its text.
#[derive(Clone, Debug)]
pub struct Wanted {
    text: String,
    column: Column,
    what: What,
    needs: Needs,
}

#[derive(Clone, Debug, PartialEq)]
enum What {
    /// Of a hinge, by its index.
    Hinge(hinge::Kind, usize),
    /// Of a column of the table of states.
    Motion(Extreme),
    /// A number of `summary.json`, by its JSON pointer.
    Summary(String),
}

/// A text that names no result of a run.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("result `{found}` found, {expected} expected")]
pub struct UnknownResult {
    /// The text.
    pub found: String,
    /// What would have been right.
    pub expected: String,
    /// A result whose text is like it.
    pub nearest: Option<String>,
}

/// What a result takes that not every run has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Needs {
    Nothing,
    FreeBody,
    HingeLoads,
    Stresses,
    Strengths,
    /// The loads that runs of the study find, if any: it counts evaluations, those for loads too.
    Effort,
}

/// What a run has found.
pub(crate) struct Found<'r> {
    pub labels: &'r [HingeLabel],
    pub hinges: &'r [Happened],
    /// Those of the wanted extremes, in their order.
    pub extremes: &'r [f64],
    pub summary: &'r Summary,
    pub worst: &'r WorstLoads,
    /// The content of `summary.json`, if [`Wanted::of_summary`] is true of any.
    pub keys: Option<&'r SummaryFile<'r>>,
}

impl Needs {
    /// What is missing for it, in words.
    fn missing(self, file: &SceneFile, loads: Loads) -> Option<&'static str> {
        let (is_there, missing) = match self {
            Self::Nothing | Self::Effort => return None,
            Self::FreeBody => (!file.scene.base.is_held(), "a main body that moves freely"),
            Self::HingeLoads => (
                loads > Loads::None,
                "a run with loads of hinges, as by `hinge_loads = true` of `run`",
            ),
            Self::Stresses => (loads >= Loads::Stations, "a run with stresses"),
            Self::Strengths => (
                loads == Loads::Margins,
                "a run with stresses, of a material with a yield or ultimate stress or with `yield_stress`",
            ),
        };
        (!is_there).then_some(missing)
    }

    /// Whether a run without loads may be without it, or with another one.
    fn depends_on_loads(self) -> bool {
        !matches!(self, Self::Nothing | Self::FreeBody)
    }
}

impl Wanted {
    /// The result that a text names, of runs of a scene which compute these loads.
    ///
    /// # Errors
    /// When there is no such result.
    pub fn named(text: &str, file: &SceneFile, loads: Loads) -> Result<Self, UnknownResult> {
        // Names of bodies may begin and end with blanks.
        let (whole, text) = (text.trim_start(), plain(text));
        let found = match (whole.split_once(' '), whole.split_once(" of ")) {
            (Some((word, column)), _) if motion::WORDS.contains(&word) => {
                motion::named(word, column.trim_start(), file)
            }
            (_, Some((word, body))) => hinge::named(word.trim(), body, file, loads),
            _ => summary::named(&text, file, loads),
        };
        match found {
            Ok((what, column, needs)) => {
                let column = Column { name: name_of_result(&text), ..column };
                Ok(Self { text, column, what, needs })
            }
            Err((expected, nearest)) => Err(UnknownResult { found: text, expected, nearest }),
        }
    }

    /// What a text that names a result makes of it for statistics.
    pub(crate) fn meaning(text: &str) -> Meaning {
        let word = text.split_once(' ').and_then(|(word, _)| motion::meaning(word));
        let of_hinge = || hinge::meaning(text.split_once(" of ")?);
        word.or_else(of_hinge).unwrap_or_else(|| summary::meaning(text))
    }

    /// Those of a study that does not say any: what became of latches, the nutation, conservation, and the
    /// worst stress and margin; as far as the scene has them.
    pub fn defaults(file: &SceneFile, loads: Loads) -> Vec<Self> {
        let labels = file.scene.labels();
        let columns: Vec<_> =
            labels.iter().map(|label| label.name.as_deref().map(name_of_result)).collect();
        // Names that are the same as those of columns, `panel +x` and `panel -x`, do not tell hinges apart.
        let is_alone = |i: usize| columns.iter().filter(|other| **other == columns[i]).count() == 1;
        let latches = file.scene.bodies.iter().zip(labels).enumerate();
        let latches = latches.filter(|(_, (body, _))| body.hinge.lock_angle.is_some());
        let name = |i: usize, label: &HingeLabel| match is_alone(i) {
            true => hinges::name(label),
            false => hinges::numbers(label),
        };
        let names = latches.map(|(i, (_, label))| name(i, label));
        let mut texts: Vec<String> = names
            .flat_map(|name| [format!("lock_time of {name}"), format!("impulse of {name}")])
            .collect();
        texts.extend(DEFAULTS.map(str::to_owned));
        texts.iter().filter_map(|text| Self::named(text, file, loads).ok()).collect()
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Its column in the table of cases.
    pub fn column(&self) -> &Column {
        &self.column
    }

    /// What is to be followed during the run, if it is an extreme of the motion.
    pub(crate) fn extreme(&self) -> Option<Extreme> {
        match self.what {
            What::Motion(extreme) => Some(extreme),
            _ => None,
        }
    }

    /// Whether the loads of the run have to be found for it.
    pub(crate) fn depends_on_loads(&self) -> bool {
        self.needs.depends_on_loads()
    }

    /// Whether it is a number of `summary.json`.
    pub(crate) fn of_summary(&self) -> bool {
        matches!(self.what, What::Summary(_))
    }

    /// What a run has found for each of these.
    pub(crate) fn values(all: &[Self], found: &Found<'_>) -> Vec<Value> {
        let mut extremes = found.extremes.iter();
        let value = |wanted: &Self| {
            let number = match &wanted.what {
                What::Hinge(kind, hinge) => kind.value(*hinge, found),
                What::Motion(of) => extremes.next().map(|&value| of.meant(value, found.summary)),
                What::Summary(pointer) => found.keys.and_then(|keys| seek::number(keys, pointer)),
            };
            match (number, wanted.column.kind) {
                (None, _) => Value::Empty,
                (Some(number), nboom_tables::Kind::Integer) => Value::Integer(number as i64),
                (Some(number), _) => Value::number(number),
            }
        };
        all.iter().map(value).collect()
    }
}

/// The text of a result without blanks that say nothing, as it is told and compared; those of a name stay.
pub(crate) fn plain(text: &str) -> String {
    let text = text.trim();
    match (text.split_once(' '), text.split_once(" of ")) {
        (Some((word, column)), _) if motion::WORDS.contains(&word) => {
            format!("{word} {}", column.trim_start())
        }
        (_, Some((word, body))) => format!("{} of {body}", word.trim_end()),
        _ => text.to_owned(),
    }
}

const DEFAULTS: [&str; 5] = [
    "final nutation",
    "conservation.angular_momentum",
    "conservation.energy",
    "verdict.worst_load",
    "verdict.smallest_margin",
];

/// What a text stands for and needs, or what is expected instead and what is like it.
type Named = Result<(What, Column, Needs), (String, Option<String>)>;

/// What is refused since something is missing for it.
fn refused(missing: &str) -> (String, Option<String>) {
    (missing.to_owned(), None)
}

/// The name of a column after the text of a result: each run of characters other than letters, digits and `_`
/// of any script becomes one `_`.
fn name_of_result(text: &str) -> String {
    let mut name = String::new();
    let mut is_inside = true;
    for c in text.chars() {
        let fits = c.is_alphanumeric() || c == '_';
        match (fits, is_inside) {
            (true, _) => name.push(c),
            (false, true) => name.push('_'),
            (false, false) => {}
        }
        is_inside = fits;
    }
    name
}
