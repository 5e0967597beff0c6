//! The values of a TOML text, each with the place where it stands.

use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::expression;
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
    List(Arc<Vec<Node>>),
    Table(Table),
    /// A kind of value that no scene has, in words.
    Other(&'static str),
}

/// Keys with their values, in the order of the text. Trees share what they have in common.
#[derive(Clone, Debug, Default)]
pub(crate) struct Table(pub Arc<Vec<Entry>>);

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

    /// Whether it is a table or list that two trees share.
    pub fn is_shared_with(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Table(own), Self::Table(other)) => Arc::ptr_eq(&own.0, &other.0),
            (Self::List(own), Self::List(other)) => Arc::ptr_eq(own, other),
            _ => false,
        }
    }

    /// Whether a text in it may have one of these parameters.
    pub fn mentions(&self, parameters: &[&str]) -> bool {
        !parameters.is_empty()
            && match self {
                Self::Text(text) => expression::names(text).any(|name| parameters.contains(&name)),
                Self::List(nodes) => nodes.iter().any(|node| node.value.mentions(parameters)),
                Self::Table(table) => table.mentions(parameters),
                Self::Number(_) | Self::Other(_) => false,
            }
    }
}

impl Table {
    /// Whether a text in it may have one of these parameters.
    pub fn mentions(&self, parameters: &[&str]) -> bool {
        self.0.iter().any(|entry| entry.node.value.mentions(parameters))
    }

    pub fn get(&self, key: &str) -> Option<&Entry> {
        self.0.iter().find(|entry| entry.key == key)
    }

    /// Adds an entry; what is in it joins a table or list that has its key already.
    pub fn absorb(&mut self, entry: Entry) {
        let entries = Arc::make_mut(&mut self.0);
        let Some(own) = entries.iter_mut().find(|own| own.key == entry.key) else {
            return entries.push(entry);
        };
        match (&mut own.node.value, entry.node.value) {
            (Value::Table(own), Value::Table(other)) => {
                Arc::make_mut(&mut own.0).extend(Arc::unwrap_or_clone(other.0));
            }
            (Value::List(own), Value::List(other)) => {
                Arc::make_mut(own).extend(Arc::unwrap_or_clone(other));
            }
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
        Table(entries.into())
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
                Value::List(Arc::new(list.into_iter().map(|value| self.node(value)).collect()))
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
