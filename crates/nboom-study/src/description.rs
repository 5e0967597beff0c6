//! `study.json`: what a sweep is, by which it is told from others.

use std::collections::BTreeMap;

use nboom_io::sha256;
use nboom_model::visible;
use nboom_results::Maker;
use nboom_tables::{Column, Kind};
use serde::{Deserialize, Serialize};

use crate::Shard;
use crate::frame::Columns;
use crate::requirement::Requirement;
use crate::statistics::{Counts, Field, Role};

/// The form of a sweep's directory.
const VERSION: u32 = 1;

/// The most cases, whose numbers all formats keep.
const MOST_CASES: u64 = 1 << 53;

/// What a sweep is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Description {
    /// The form of the directory.
    pub version: u32,
    /// The name of the study.
    pub name: String,
    /// What it was begun by.
    pub made_by: Maker,
    /// What else computed some of its cases.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub also_made_by: Vec<Maker>,
    /// The study, the file `study.toml` beside this one.
    pub study: Source,
    /// The study as it would be with any number of draws.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub study_but_draws: Option<Source>,
    /// The scene with all that it includes, the file `scene.toml` beside this one.
    pub scene: Source,
    /// The seed of everything random.
    pub seed: u64,
    /// How draws are made.
    pub method: String,
    /// How many draws there are.
    pub draws: u64,
    /// How many cases there are, of all shards.
    pub cases: u64,
    /// Which part this is; none if it is all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<Shard>,
    /// The relative tolerance of the runs.
    #[serde(default)]
    pub rtol: f64,
    /// Columns of the table of cases.
    pub columns: Vec<Column>,
    /// Variables that are drawn to vary together.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vary_together: Vec<String>,
    /// Columns of the table of trajectories; none if they are not wanted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub trajectory_columns: Vec<Column>,
    /// What is wanted of each run, as the study says it.
    pub results: Vec<String>,
    /// Bounds that some of these should keep.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub requirements: Vec<Requirement>,
    /// Whether all cases are done.
    pub complete: bool,
    /// Whether its tables are to be in CSV too once all cases are done; then `tables` says which there are.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub csv: bool,
    /// How long the files of its tables are \[bytes\]; a shard has none.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub tables: BTreeMap<String, u64>,
    /// SHA-256 of these files; none of those that were written before there were sums.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub sums: BTreeMap<String, String>,
    /// What became of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub counts: Option<Counts>,
}

/// A text that a sweep wrote.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Source {
    /// Of the file's bytes, in hexadecimal digits.
    pub sha256: String,
}

impl Source {
    pub(crate) fn of(text: &str) -> Self {
        Self { sha256: sha256(text.as_bytes()) }
    }
}

impl Description {
    /// The version of [`Self::version`] that is written.
    pub(crate) const VERSION: u32 = VERSION;

    /// Reads what [`Self::text`] wrote.
    ///
    /// # Errors
    /// When it is anything else, in words.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let found: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        let Self { version, cases, .. } = found;
        if version != VERSION {
            return Err(format!("version {version} instead of {VERSION}"));
        }
        if cases > MOST_CASES {
            return Err(format!("{cases} cases, more than {MOST_CASES},"));
        }
        let is_of_cases = |column: &Column| column.name == "case" && column.kind == Kind::Integer;
        let states = &found.trajectory_columns;
        if found.complete && found.shard.is_none() && found.tables.is_empty() {
            return Err("a complete sweep without tables".to_owned());
        }
        let is_right = found.columns.first().is_some_and(is_of_cases)
            && found.columns.last().is_some_and(|column| column.kind == Kind::Text)
            && (states.is_empty() || is_of_cases(&states[0]));
        if is_right { Ok(found) } else { Err("a table without cases or status".to_owned()) }
    }

    /// The text of the file.
    pub(crate) fn text(&self) -> String {
        serde_json::to_string_pretty(self).expect("the keys are texts") + "\n"
    }

    pub(crate) fn columns_of_tables(&self) -> Columns<'_> {
        Columns { cases: &self.columns, states: &self.trajectory_columns }
    }

    /// What the columns of the table of cases are for.
    pub(crate) fn fields(&self) -> Vec<Field> {
        let first_result = self.columns.len().saturating_sub(1 + self.results.len());
        let field = |(i, column): (usize, &Column)| {
            let name = &column.name;
            let result = i.checked_sub(first_result).and_then(|i| self.results.get(i));
            let (role, label) = match (name.as_str(), result) {
                (_, Some(text)) => (Role::Result, text),
                ("case", None) => (Role::Case, name),
                ("seed", None) => (Role::Seed, name),
                ("fault", None) => (Role::Fault, name),
                ("status", None) => (Role::Status, name),
                _ => (Role::Variable, name),
            };
            let description = column.description.clone();
            Field { description, ..Field::new(name, label, column.unit.clone(), role) }
        };
        self.columns.iter().enumerate().map(field).collect()
    }

    /// The cases of this part.
    pub(crate) fn range(&self) -> std::ops::RangeInclusive<u64> {
        self.shard.map_or(1..=self.cases, |shard| shard.range(self.cases))
    }

    /// How many cases this part has.
    pub fn share(&self) -> u64 {
        let range = self.range();
        (range.end() + 1).saturating_sub(*range.start())
    }

    /// What is different about another, but for the programs and whether it is complete, in words.
    pub(crate) fn differences(&self, now: &Self) -> Vec<String> {
        self.compared(now).map(|(what, then, now)| told(what, &then, &now)).collect()
    }

    /// Likewise: what it is, this one's and the other's.
    pub(crate) fn compared(
        &self,
        now: &Self,
    ) -> impl Iterator<Item = (&'static str, String, String)> + use<> {
        let of = |is: &Self| {
            let shard = is.shard.map_or("all".to_owned(), |shard| shard.to_string());
            let names = |columns: &[Column]| {
                let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
                names.join(", ")
            };
            [
                ("study", is.study.sha256.clone()),
                ("scene", is.scene.sha256.clone()),
                ("name", is.name.clone()),
                ("seed", is.seed.to_string()),
                ("method", is.method.clone()),
                ("draws", is.draws.to_string()),
                ("cases", is.cases.to_string()),
                ("shard", shard),
                ("columns", names(&is.columns)),
                ("columns of trajectories", names(&is.trajectory_columns)),
            ]
        };
        let pairs = of(self).into_iter().zip(of(now)).filter(|(then, now)| then != now);
        pairs.map(|((what, then), (_, now))| (what, then, now))
    }

    /// The programs that did not compute any of this, in words.
    pub(crate) fn made_elsewhere(&self, now: &Self) -> Vec<String> {
        let strangers = now.makers().filter(|maker| !self.makers().any(|known| known == *maker));
        strangers.map(|maker| format!("{} then, {maker} now", self.made_by)).collect()
    }

    /// The same, also computed by these.
    pub(crate) fn also_by(mut self, other: &Self) -> Self {
        for maker in other.makers() {
            if !self.makers().any(|known| known == maker) {
                self.also_made_by.push(maker.clone());
            }
        }
        self
    }

    fn makers(&self) -> impl Iterator<Item = &Maker> {
        [&self.made_by].into_iter().chain(&self.also_made_by)
    }
}

/// How many characters of what is different are told.
const TOLD: usize = 60;

/// The first characters of a text, all of which can be seen.
pub(crate) fn short(text: &str) -> String {
    let short = visible(&text.chars().take(TOLD).collect::<String>());
    if text.chars().nth(TOLD).is_some() { short + "..." } else { short }
}

fn told(what: &str, then: &str, now: &str) -> String {
    match what {
        // Digits of a hash say nothing to anybody.
        "study" | "scene" => format!("another text of the {what}"),
        _ => format!("{what} {} then, {} now", short(then), short(now)),
    }
}
