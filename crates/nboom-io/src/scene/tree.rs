//! The values of a TOML text, each with the place where it stands.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::sources::{Place, Sources};
use crate::diagnostic::Report;

/// A value and its place.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub value: Value,
    pub at: Place,
}

/// A value of TOML. All numbers of a scene are real.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Number(f64),
    Text(String),
    List(Vec<Node>),
    Table(Table),
    /// A kind of value that no scene has, in words.
    Other(&'static str),
}

/// Keys with their values, in the order of the text.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table(pub Vec<Entry>);

/// A key with its value.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub key: String,
    pub key_at: Place,
    pub node: Node,
}

impl Value {
    /// What it is, in words.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Text(_) => "a text",
            Self::List(_) => "a list",
            Self::Table(_) => "a table",
            Self::Other(kind) => kind,
        }
    }
}

impl Table {
    pub fn get(&self, key: &str) -> Option<&Entry> {
        self.0.iter().find(|entry| entry.key == key)
    }

    /// Adds an entry; what is in it joins a table or list that has its key already.
    pub fn absorb(&mut self, entry: Entry) {
        let Some(own) = self.0.iter_mut().find(|own| own.key == entry.key) else {
            return self.0.push(entry);
        };
        match (&mut own.node.value, entry.node.value) {
            (Value::Table(own), Value::Table(other)) => own.0.extend(other.0),
            (Value::List(own), Value::List(other)) => own.extend(other),
            _ => {}
        }
    }
}

/// The tree of file number `file`. Of what is not TOML the first is reported: the rest mostly follows from it.
pub(crate) fn parse(file: usize, sources: &Sources, report: &mut Report<'_>) -> Table {
    let text = sources.text(file);
    let (table, errors) = DeTable::parse_recoverable(text);
    if let Some(error) = errors.iter().min_by_key(|error| error.span().map(|span| span.start)) {
        let bytes = error.span().unwrap_or(text.len()..text.len());
        let message = error.message().lines().next().unwrap_or_default();
        let (found, expected) = message.split_once(", expected ").unwrap_or((message, "TOML"));
        report.error_at(sources, &Place { file, bytes }, "scene", found, expected);
    }
    let convert = Convert { file };
    convert.table(table.into_inner())
}

struct Convert {
    file: usize,
}

impl Convert {
    fn place(&self, bytes: Range<usize>) -> Place {
        Place { file: self.file, bytes }
    }

    fn table(&self, table: DeTable<'_>) -> Table {
        let entry = |(key, value): (Spanned<_>, Spanned<_>)| {
            let key_at = self.place(key.span());
            let key: std::borrow::Cow<'_, str> = key.into_inner();
            Entry { key: key.into_owned(), key_at, node: self.node(value) }
        };
        let mut entries: Vec<Entry> = table.into_iter().map(entry).collect();
        entries.sort_by_key(|entry| entry.key_at.bytes.start);
        Table(entries)
    }

    fn node(&self, value: Spanned<DeValue<'_>>) -> Node {
        let at = self.place(value.span());
        let value = match value.into_inner() {
            DeValue::String(text) => Value::Text(text.into_owned()),
            DeValue::Integer(number) => Value::Number(integer(number.as_str(), number.radix())),
            // Numbers that are none have a kind of their own.
            DeValue::Float(number) => Value::Number(number.as_str().parse().unwrap_or(f64::NAN)),
            DeValue::Boolean(_) => Value::Other("true or false"),
            DeValue::Datetime(_) => Value::Other("a date or time"),
            DeValue::Array(list) => {
                Value::List(list.into_iter().map(|value| self.node(value)).collect())
            }
            DeValue::Table(table) => Value::Table(self.table(table)),
        };
        Node { value, at }
    }
}

/// An integer of any length as the nearest number.
fn integer(digits: &str, radix: u32) -> f64 {
    match i128::from_str_radix(digits, radix) {
        Ok(integer) => integer as f64,
        Err(_) => digits.parse().unwrap_or(f64::NAN),
    }
}
