use std::fmt;

use serde::{Deserialize, Serialize};

use crate::number;

/// What a column of a table is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// What it holds.
    #[serde(rename = "type")]
    pub kind: Kind,
    /// The unit of its numbers, where they have one for all rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// What it is, in one line.
    pub description: String,
    /// The body that it belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<String>,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Numbers.
    Number,
    /// Whole numbers.
    Integer,
    /// Words.
    #[serde(rename = "string")]
    Text,
}

/// What stands in a row and a column.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cell<'a> {
    /// Nothing.
    Empty,
    /// A number, which must be finite.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// Words.
    Text(&'a str),
}

/// The largest whole number up to which `f64` has all.
const LARGEST: i64 = 1 << f64::MANTISSA_DIGITS;

/// As in CSV: numbers are the shortest that read back to the same, words by RFC 4180 in quotes if need be.
impl fmt::Display for Cell<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => Ok(()),
            Self::Number(value) => f.write_str(zmij::Buffer::new().format(*value)),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Text(text) if text.contains([',', '"', '\n', '\r']) => {
                write!(f, "\"{}\"", text.replace('"', "\"\""))
            }
            Self::Text(text) => f.write_str(text),
        }
    }
}

impl Column {
    /// A column without a unit.
    pub fn new(name: impl Into<String>, kind: Kind, description: impl Into<String>) -> Self {
        let (name, description) = (name.into(), description.into());
        Self { name, kind, unit: None, description, body: None }
    }

    /// What a field of a table in CSV, without its quotes, says in this column.
    ///
    /// # Errors
    /// When it is something else.
    pub(crate) fn cell<'a>(&self, field: &'a str) -> Result<Cell<'a>, String> {
        self.kind.cell(field).map_err(|found| format!("column {}: {found}", self.name))
    }

    /// The same, with a unit.
    pub fn in_units_of(self, unit: impl Into<String>) -> Self {
        Self { unit: Some(unit.into()), ..self }
    }
}

impl Kind {
    /// What a field says in a column of this kind.
    ///
    /// # Errors
    /// When it is something else.
    fn cell(self, field: &str) -> Result<Cell<'_>, String> {
        Ok(match self {
            _ if field.is_empty() => Cell::Empty,
            Self::Number => Cell::Number(number(field)?),
            Self::Integer => Cell::Integer(integer(field)?),
            Self::Text => Cell::Text(field),
        })
    }

    /// # Errors
    /// When a column of this kind cannot hold the cell.
    pub(crate) fn admit(self, cell: &Cell<'_>) -> Result<(), String> {
        match (self, cell) {
            (_, Cell::Empty) | (Self::Integer, Cell::Integer(_)) | (Self::Text, Cell::Text(_)) => {
                Ok(())
            }
            (Self::Number, Cell::Number(value)) if value.is_finite() => Ok(()),
            (Self::Number, found) => Err(format!("{found:?} found, a finite number expected")),
            (Self::Integer, found) => Err(format!("{found:?} found, a whole number expected")),
            (Self::Text, found) => Err(format!("{found:?} found, words expected")),
        }
    }
}

/// A whole number that all formats keep; HDF5 has NaN where a field is empty, so it has numbers alone.
fn integer(field: &str) -> Result<i64, String> {
    let value: Option<i64> = field.parse().ok();
    value.filter(|value| value.abs() <= LARGEST).ok_or_else(|| {
        let found: String = field.chars().take(30).collect();
        format!("`{found}` found, a whole number up to {LARGEST} expected")
    })
}
