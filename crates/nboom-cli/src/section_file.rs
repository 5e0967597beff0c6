//! The file that `nboom section` reads.

use std::path::{Path, PathBuf};

use nboom_io::{InputError, read_text};
use nboom_scalar::{Vec3, Wrench};
use nboom_sections::{Point, Polygon, Section, SectionError, Tube};
use serde_json::error::Category;
use serde_json::{Map, Value};

use crate::unique_keys::UniqueKeys;

/// The longest file that is read \[bytes\].
const LARGEST_FILE: u64 = 4 << 20;

/// Most of a wrong value that a message shows \[characters\].
const MOST_SHOWN: usize = 40;

/// Most defects that a message shows.
const MOST_DEFECTS: usize = 50;

/// The keys of a file: its sections, and what an answer says of itself.
pub(crate) const OF_FILE: [&str; 2] = ["cases", "convention"];

/// The keys that any section may have beside its description: a load, and keys that are only passed on.
const KEYS: [&str; 7] = ["id", "kind", "P", "Q", "name", "tags", "expect"];

/// The keys that describe a section of each kind.
const OF_KIND: [(&str, [&str; 2]); 2] =
    [("circular", ["R", "t"]), ("polygon", ["vertices", "thickness"])];

/// Why sections cannot be computed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SectionFileError {
    /// The file cannot be read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The file is not JSON.
    #[error("{}: not JSON", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        #[source]
        source: serde_json::Error,
    },
    /// An object of the file has a key more than once.
    #[error("{}: a key that stands twice", path.display())]
    RepeatedKey {
        /// The file.
        path: PathBuf,
        /// Which, and where.
        #[source]
        source: serde_json::Error,
    },
    /// The file has no list of sections.
    #[error("{}: no list `cases` of sections found", path.display())]
    NoCases {
        /// The file.
        path: PathBuf,
    },
    /// Everything that is wrong with the sections, in their order.
    #[error("{}", listing(.0))]
    Sections(Vec<SectionDefect>),
}

/// What is wrong with which section of a file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}: section {section}: {defect}", path.display())]
pub struct SectionDefect {
    /// The file.
    pub path: PathBuf,
    /// The section's `id`, or its number from 1 where it has none.
    pub section: String,
    /// What is wrong.
    pub defect: Defect,
}

/// What is wrong with a section of a file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Defect {
    /// A value is missing or of the wrong kind.
    #[error("{place}: found {found}, expected {expected}")]
    Value {
        /// The key, and the place in a list, from 1.
        place: String,
        /// What was found.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// The key has no meaning here.
    #[error("{key}: found a key without meaning, expected one of {}", expected.join(", "))]
    Key {
        /// The key.
        key: String,
        /// The keys of a section of its kind.
        expected: Vec<&'static str>,
    },
    /// It is not a section of a known kind.
    #[error(
        "kind: found {found}, expected \"circular\" or \"polygon\"; solid and open sections and \
         those with several cells are not covered"
    )]
    Kind {
        /// The kind that it claims.
        found: String,
    },
    /// It is not a thin-walled section with one cell.
    #[error(transparent)]
    Section(SectionError),
    /// Stresses under the load are infinite.
    #[error("P and Q: found a load whose stresses exceed the range of numbers")]
    Load,
}

/// The first defects, one to a line, and how many more there are.
fn listing(defects: &[SectionDefect]) -> String {
    let mut lines: Vec<String> =
        defects.iter().take(MOST_DEFECTS).map(ToString::to_string).collect();
    if defects.len() > MOST_DEFECTS {
        lines.push(format!("and {} more", defects.len() - MOST_DEFECTS));
    }
    lines.join("\n")
}

/// A section of a file.
pub(crate) struct Case {
    /// The text in the file.
    pub(crate) given: Map<String, Value>,
    pub(crate) section: Section,
    pub(crate) load: Option<Wrench<f64>>,
}

/// What a file has.
pub(crate) struct SectionFile {
    pub(crate) cases: Vec<Case>,
    /// Keys beside its sections that have no meaning.
    pub(crate) ignored: Vec<String>,
}

/// All sections of a file.
pub(crate) fn read(path: &Path) -> Result<SectionFile, SectionFileError> {
    let text = read_text(path, LARGEST_FILE)?;
    let path_of = || path.to_owned();
    let UniqueKeys(mut file) =
        serde_json::from_str(&text).map_err(|source| match source.classify() {
            Category::Data => SectionFileError::RepeatedKey { path: path_of(), source },
            _ => SectionFileError::Json { path: path_of(), source },
        })?;
    let Some(Value::Array(list)) = file.get_mut("cases").map(Value::take) else {
        return Err(SectionFileError::NoCases { path: path_of() });
    };
    let keys = file.as_object().into_iter().flat_map(Map::keys);
    let ignored = keys.filter(|key| !OF_FILE.contains(&key.as_str())).cloned().collect();
    let (mut cases, mut defects) = (Vec::new(), Vec::new());
    for (i, value) in list.into_iter().enumerate() {
        let id = value["id"].as_str().map_or_else(|| format!("number {}", i + 1), str::to_owned);
        match case(value) {
            Ok(case) => cases.push(case),
            Err(found) => defects.extend(found.into_iter().map(|defect| SectionDefect {
                path: path.to_owned(),
                section: id.clone(),
                defect,
            })),
        }
    }
    if defects.is_empty() {
        Ok(SectionFile { cases, ignored })
    } else {
        Err(SectionFileError::Sections(defects))
    }
}

fn case(value: Value) -> Result<Case, Vec<Defect>> {
    let Value::Object(given) = value else {
        return Err(vec![Defect::value("section", &value, "an object")]);
    };
    let mut fields = Fields { given: &given, defects: Vec::new() };
    fields.check_keys();
    let section = fields.section();
    let load = fields.load();
    let (Some(section), []) = (section, &fields.defects[..]) else {
        return Err(fields.defects);
    };
    if load
        .is_some_and(|load| !section.stresses(&load).max_von_mises().stress.von_mises().is_finite())
    {
        return Err(vec![Defect::Load]);
    }
    Ok(Case { given, section, load })
}

/// The keys of one section, and the defects of those read so far.
struct Fields<'a> {
    given: &'a Map<String, Value>,
    defects: Vec<Defect>,
}

impl<'a> Fields<'a> {
    fn check_keys(&mut self) {
        let kind =
            self.value("kind").as_str().filter(|kind| OF_KIND.iter().any(|of| of.0 == *kind));
        let of_kind = OF_KIND.iter().filter(|of| kind.is_none_or(|kind| of.0 == kind));
        let expected = || KEYS.into_iter().chain(of_kind.clone().flat_map(|of| of.1));
        let unknown = self.given.keys().filter(|key| expected().all(|known| known != **key));
        self.defects.extend(
            unknown.map(|key| Defect::Key { key: key.clone(), expected: expected().collect() }),
        );
        if !self.value("id").is_string() {
            self.expected("id", self.value("id"), "a text");
        }
    }

    /// `None` if a defect was found.
    fn section(&mut self) -> Option<Section> {
        match self.value("kind").as_str() {
            Some("circular") => {
                let (radius, thickness) = (self.number("R"), self.number("t"));
                let tube = Tube::new(radius?, thickness?).map(Section::Tube);
                tube.map_err(|error| self.defects.push(Defect::Section(error))).ok()
            }
            Some("polygon") => {
                let (vertices, thickness) = (self.vertices(), self.numbers("thickness"));
                let polygon = Polygon::new(&vertices?, &thickness?).map(Section::Polygon);
                let wrapped = |errors: Vec<_>| errors.into_iter().map(Defect::Section);
                polygon.map_err(|errors| self.defects.extend(wrapped(errors))).ok()
            }
            _ => {
                self.defects.push(Defect::Kind { found: shown(self.value("kind")) });
                None
            }
        }
    }

    /// `None` if there is no load; missing parts of a load are zero.
    fn load(&mut self) -> Option<Wrench<f64>> {
        let [force, moment] = ["P", "Q"].map(|key| {
            let components = self.given.contains_key(key).then(|| self.numbers(key))??;
            match components[..] {
                [xi, eta, zeta] => Some(Vec3::new(xi, eta, zeta)),
                _ => {
                    self.expected(key, self.value(key), "three components");
                    None
                }
            }
        });
        let is_loaded = force.is_some() || moment.is_some();
        let or_none = |vector: Option<Vec3<f64>>| vector.unwrap_or(Vec3::zero());
        is_loaded.then(|| Wrench { force: or_none(force), moment: or_none(moment) })
    }

    fn vertices(&mut self) -> Option<Vec<Point>> {
        let list = self.list("vertices")?;
        let vertex = |(i, value): (usize, &Value)| {
            let pair = value.as_array().and_then(|pair| match &pair[..] {
                [xi, zeta] => Some(Point { xi: xi.as_f64()?, zeta: zeta.as_f64()? }),
                _ => None,
            });
            if pair.is_none() {
                self.expected(&format!("vertex {}", i + 1), value, "two numbers [xi, zeta]");
            }
            pair
        };
        let found: Vec<Option<Point>> = list.iter().enumerate().map(vertex).collect();
        found.into_iter().collect()
    }

    fn numbers(&mut self, key: &str) -> Option<Vec<f64>> {
        let list = self.list(key)?;
        let number = |(i, value): (usize, &Value)| {
            if value.as_f64().is_none() {
                self.expected(&format!("{key} {}", i + 1), value, "a number");
            }
            value.as_f64()
        };
        let found: Vec<Option<f64>> = list.iter().enumerate().map(number).collect();
        found.into_iter().collect()
    }

    fn list(&mut self, key: &str) -> Option<&'a [Value]> {
        let value = self.value(key);
        if !value.is_array() {
            self.expected(key, value, "a list");
        }
        value.as_array().map(Vec::as_slice)
    }

    fn number(&mut self, key: &str) -> Option<f64> {
        let value = self.value(key);
        if value.as_f64().is_none() {
            self.expected(key, value, "a number");
        }
        value.as_f64()
    }

    fn value(&self, key: &str) -> &'a Value {
        self.given.get(key).unwrap_or(&Value::Null)
    }

    fn expected(&mut self, place: &str, found: &Value, expected: &'static str) {
        self.defects.push(Defect::value(place, found, expected));
    }
}

impl Defect {
    fn value(place: &str, found: &Value, expected: &'static str) -> Self {
        Self::Value { place: place.to_owned(), found: shown(found), expected }
    }
}

/// A value for a message, on one line and shortened to it.
fn shown(value: &Value) -> String {
    if value.is_null() {
        return "nothing".to_owned();
    }
    let text = value.to_string();
    let cut = text.chars().count() > MOST_SHOWN;
    let start: String = text.chars().take(MOST_SHOWN).collect();
    if cut { start + "..." } else { start }
}
