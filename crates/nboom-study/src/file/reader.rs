//! Values of a study with their places, and what is wrong with them.

use std::ops::Range;

use nboom_io::{Diagnostic, Excerpt, nearest};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::keys::{Holds, Key, Table};
use crate::description::short;

/// Errors after which no more are kept.
const MOST_ERRORS: usize = 1000;

/// A text, and what is wrong with it.
pub(super) struct Reader<'t> {
    file: &'t str,
    text: &'t str,
    pub errors: Vec<Diagnostic>,
}

/// A table of the text.
#[derive(Clone, Copy)]
pub(super) struct Fields<'t> {
    table: &'t DeTable<'t>,
    kind: &'static Table,
    /// Where it stands.
    place: [usize; 2],
}

/// A value with its key and its place.
#[derive(Clone)]
pub(super) struct At<T> {
    pub value: T,
    pub key: &'static str,
    pub place: Range<usize>,
}

impl<'t> Reader<'t> {
    pub fn new(file: &'t str, text: &'t str) -> Self {
        Self { file, text, errors: Vec::new() }
    }

    /// Notes what is wrong at a place.
    pub fn error(
        &mut self,
        place: &Range<usize>,
        key: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) {
        self.error_like(place, key, found, expected, None);
    }

    /// Likewise, with what may have been meant.
    pub fn error_like(
        &mut self,
        place: &Range<usize>,
        key: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
        meant: Option<&str>,
    ) {
        if self.errors.len() >= MOST_ERRORS {
            return;
        }
        let start = boundary(self.text, place.start);
        let line_start = self.text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line = self.text[line_start..].lines().next().unwrap_or_default();
        let column = self.text[line_start..start].chars().count() + 1;
        let line_end = (line_start + line.len()).max(start);
        let end = boundary(self.text, place.end.clamp(start, line_end));
        let marked = self.text[start..end].chars().count();
        self.errors.push(Diagnostic {
            file: self.file.to_owned(),
            line: self.text[..line_start].matches('\n').count() + 1,
            column,
            symbol: key.to_owned(),
            found: found.into(),
            expected: expected.into(),
            excerpt: Excerpt::of(line, column, marked),
            help: meant.map(|meant| format!("did you mean `{meant}`?")),
        });
    }

    /// A table of this kind, whose unknown and missing keys are reported.
    pub fn fields(
        &mut self,
        table: &'t DeTable<'t>,
        kind: &'static Table,
        at: Range<usize>,
    ) -> Fields<'t> {
        for (name, value) in table {
            if kind.key(name.get_ref()).is_none() {
                let known = kind.keys.iter().map(|key| key.name);
                let meant = nearest(name.get_ref(), known.clone());
                let names = known.collect::<Vec<_>>().join(", ");
                let (found, place) = (quoted(name.get_ref()), name.span());
                let place = if place.is_empty() { value.span() } else { place };
                self.error_like(&place, name.get_ref(), found, format!("one of {names}"), meant);
            }
        }
        for Key { name, holds, .. } in kind.keys.iter().filter(|key| key.is_required) {
            if table.get(*name).is_none() {
                self.error(&(at.start..at.start), name, "nothing", holds.words());
            }
        }
        Fields { table, kind, place: [at.start, at.end] }
    }

    fn value<T>(
        &mut self,
        of: &Fields<'t>,
        name: &'static str,
        take: impl FnOnce(&'t DeValue<'t>, &Holds) -> Option<T>,
    ) -> Option<At<T>> {
        let key = of.kind.key(name).expect("a key of the table");
        let value = of.table.get(name)?;
        let Some(taken) = take(value.get_ref(), &key.holds) else {
            self.error(&value.span(), name, kind(value.get_ref()), key.holds.words());
            return None;
        };
        Some(At { value: taken, key: key.name, place: value.span() })
    }

    pub fn text(&mut self, of: &Fields<'t>, name: &'static str) -> Option<At<&'t str>> {
        self.value(of, name, |value, _| text(value))
    }

    /// A text of a list, by its number in the list.
    pub fn choice(&mut self, of: &Fields<'t>, name: &'static str) -> Option<At<&'t str>> {
        let found = self.text(of, name)?;
        let Some(Key { holds: Holds::OneOf(names), .. }) = of.kind.key(name) else { return None };
        if names().contains(&found.value) {
            return Some(found);
        }
        let (meant, expected) = (nearest(found.value, names().into_iter()), Holds::OneOf(*names));
        self.error_like(&found.place, name, quoted(found.value), expected.words(), meant);
        None
    }

    pub fn number(&mut self, of: &Fields<'t>, name: &'static str) -> Option<At<f64>> {
        self.value(of, name, |value, _| number(value))
    }

    pub fn flag(&mut self, of: &Fields<'t>, name: &'static str) -> Option<bool> {
        let found = self.value(of, name, |value, _| match value {
            DeValue::Boolean(flag) => Some(*flag),
            _ => None,
        });
        found.map(|found| found.value)
    }

    pub fn whole(&mut self, of: &Fields<'t>, name: &'static str) -> Option<At<u64>> {
        self.value(of, name, |value, holds| match (value, holds) {
            (DeValue::Integer(found), Holds::Whole(from, to)) => {
                let found = u64::from_str_radix(found.as_str(), found.radix()).ok()?;
                (from..=to).contains(&&found).then_some(found)
            }
            _ => None,
        })
    }

    pub fn texts(&mut self, of: &Fields<'t>, name: &'static str) -> Option<Vec<At<&'t str>>> {
        self.list(of, name, text)
    }

    pub fn numbers(&mut self, of: &Fields<'t>, name: &'static str) -> Option<At<Vec<f64>>> {
        let place = of.table.get(name)?.span();
        let found = self.list(of, name, number)?;
        let value = found.into_iter().map(|of| of.value).collect();
        Some(At { value, key: name, place })
    }

    fn list<T>(
        &mut self,
        of: &Fields<'t>,
        name: &'static str,
        take: impl Fn(&'t DeValue<'t>) -> Option<T>,
    ) -> Option<Vec<At<T>>> {
        let items = self.value(of, name, |value, _| match value {
            DeValue::Array(items) => Some(items),
            _ => None,
        })?;
        let holds = of.kind.key(name).map_or_else(String::new, |key| key.holds.words());
        let item = |item: &'t Spanned<DeValue<'t>>| match take(item.get_ref()) {
            Some(value) => Some(At { value, key: items.key, place: item.span() }),
            None => {
                self.error(&item.span(), name, kind(item.get_ref()), holds.clone());
                None
            }
        };
        let found: Vec<_> = items.value.iter().map(item).collect();
        found.into_iter().collect()
    }

    /// A table below this one.
    pub fn table(&mut self, of: &Fields<'t>, name: &'static str) -> Option<Fields<'t>> {
        let found = self.value(of, name, |value, holds| match (value, holds) {
            (DeValue::Table(table), Holds::Table(kind)) => Some((table, *kind)),
            _ => None,
        })?;
        let (table, kind) = found.value;
        Some(self.fields(table, kind, found.place))
    }

    /// The tables of a list below this one, or the one that stands for a list.
    pub fn tables(&mut self, of: &Fields<'t>, name: &'static str) -> Vec<Fields<'t>> {
        let found = self.value(of, name, |value, holds| match (value, holds) {
            (DeValue::Table(table), Holds::Some(kind)) => Some((vec![(table, None)], *kind)),
            (DeValue::Array(items), Holds::Some(kind) | Holds::Tables(kind)) => {
                let table = |item: &'t Spanned<DeValue<'t>>| match item.get_ref() {
                    DeValue::Table(table) => Some((table, Some(item.span()))),
                    _ => None,
                };
                Some((items.iter().map(table).collect::<Option<_>>()?, *kind))
            }
            _ => None,
        });
        let Some(At { value: (tables, kind), place, .. }) = found else { return Vec::new() };
        let fields = |(table, at): (&'t DeTable<'t>, Option<Range<usize>>)| {
            self.fields(table, kind, at.unwrap_or_else(|| place.clone()))
        };
        tables.into_iter().map(fields).collect()
    }
}

impl Fields<'_> {
    /// Where the table stands.
    pub fn place(&self) -> Range<usize> {
        self.place[0]..self.place[1]
    }

    /// Where a key of it stands, or the table itself.
    pub fn place_of(&self, name: &str) -> Range<usize> {
        self.table.get(name).map_or_else(|| self.place(), Spanned::span)
    }

    pub fn has_empty_list(&self, name: &str) -> bool {
        let is_empty = |value: &Spanned<DeValue<'_>>| matches!(value.get_ref(), DeValue::Array(items) if items.is_empty());
        self.table.get(name).is_some_and(is_empty)
    }

    pub fn has(&self, name: &str) -> bool {
        self.table.get(name).is_some()
    }
}

/// The last boundary between characters up to a byte.
fn boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or_default()
}

fn text<'t>(value: &'t DeValue<'t>) -> Option<&'t str> {
    match value {
        DeValue::String(text) => Some(text),
        _ => None,
    }
}

/// A finite number.
fn number(value: &DeValue<'_>) -> Option<f64> {
    let found: f64 = match value {
        DeValue::Integer(found) => i64::from_str_radix(found.as_str(), found.radix()).ok()? as f64,
        DeValue::Float(found) => found.as_str().parse().ok()?,
        _ => return None,
    };
    found.is_finite().then_some(found)
}

/// What a value is, in words.
fn kind(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => quoted(text),
        DeValue::Integer(number) => number.to_string(),
        DeValue::Float(number) => number.to_string(),
        DeValue::Boolean(flag) => flag.to_string(),
        DeValue::Datetime(_) => "a date or time".to_owned(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// A piece of the text in quotes, shortened if it is long.
pub(super) fn quoted(text: &str) -> String {
    format!("`{}`", short(text))
}
