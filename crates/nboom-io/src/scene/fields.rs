//! A table of a scene that is being read: values by key, each error at its place.

use nboom_scalar::Vec3;

use super::expression;
use super::keys::{ENDINGS, TableKind};
use super::parameters::Parameters;
use super::sources::{Place, Sources};
use super::suggest;
use super::tree::{Entry, Node, Table, Value};
use crate::diagnostic::{Report, quoted};

/// Reads values; what is wrong is reported.
pub(crate) struct Reader<'s, 'f> {
    pub sources: &'s Sources,
    pub report: &'s mut Report<'f>,
    pub parameters: &'s Parameters,
    /// Whether the keys of all tables have been checked; numbers do not change them.
    pub are_keys_right: bool,
}

/// A table whose keys are those of its kind.
#[derive(Clone)]
pub(crate) struct Fields<'t> {
    pub kind: &'static TableKind,
    pub(super) table: &'t Table,
    pub at: Place,
}

impl Fields<'_> {
    /// Where the value of a key stands; the table where it is not given.
    pub fn place(&self, key: &str) -> Place {
        self.entry(key).map_or_else(|| self.at.clone(), |(entry, _)| entry.node.at.clone())
    }

    pub fn has(&self, key: &str) -> bool {
        self.entry(key).is_some()
    }

    /// A key as the table has it: that of an angle with its unit.
    pub fn written<'a>(&'a self, key: &'a str) -> &'a str {
        self.entry(key).map_or(key, |(entry, _)| &*entry.key)
    }
}

impl<'t> Fields<'t> {
    /// The entry of a key, and its ending if it is one of an angle.
    pub(super) fn entry(&self, key: &str) -> Option<(&'t Entry, &'static str)> {
        let endings = ["", ENDINGS[0], ENDINGS[1]];
        let called_so = |entry: &'t Entry| {
            let ending = entry.key.strip_prefix(key)?;
            Some((endings.iter().position(|known| *known == ending)?, entry))
        };
        let found = self.table.0.iter().filter_map(called_so);
        let (ending, entry) = found.min_by_key(|(ending, _)| *ending)?;
        Some((entry, endings[ending]))
    }

    /// The table of a key, unchecked.
    pub fn inner(&self, key: &str) -> Option<Self> {
        self.entry(key).and_then(|(entry, _)| self.of_node(key, &entry.node))
    }

    /// The table number `number` in the list of a key, unchecked.
    pub fn nth(&self, key: &str, number: usize) -> Option<Self> {
        match &self.entry(key)?.0.node.value {
            Value::List(nodes) => self.of_node(key, nodes.get(number)?),
            _ => None,
        }
    }

    fn of_node(&self, key: &str, node: &'t Node) -> Option<Self> {
        let kind = self.kind.key_called(key)?.holds.table()?;
        match &node.value {
            Value::Table(table) => Some(Self { kind, table, at: node.at.clone() }),
            _ => None,
        }
    }

    pub(super) fn node(&self, key: &str) -> Option<&'t Node> {
        self.entry(key).map(|(entry, _)| &entry.node)
    }
}

impl Reader<'_, '_> {
    pub fn error(&mut self, at: &Place, symbol: &str, found: &str, expected: &str) {
        self.report.error_at(self.sources, at, symbol, found, expected);
    }

    /// The table in `node`; `None` if it is none. Keys that its kind does not have, that are missing or
    /// that contradict each other are reported.
    pub fn open<'t>(
        &mut self,
        kind: &'static TableKind,
        symbol: &str,
        node: &'t Node,
    ) -> Option<Fields<'t>> {
        let fields = self.unchecked_table(kind, symbol, node)?;
        self.check_keys(&fields);
        Some(fields)
    }

    fn unchecked_table<'t>(
        &mut self,
        kind: &'static TableKind,
        symbol: &str,
        node: &'t Node,
    ) -> Option<Fields<'t>> {
        let Value::Table(table) = &node.value else {
            let expected = format!("a table of a {}", kind.name);
            self.error(&node.at, symbol, node.value.kind(), &expected);
            return None;
        };
        Some(Fields { kind, table, at: node.at.clone() })
    }

    /// A table, checked as by [`open`](Self::open).
    pub fn fields<'t>(
        &mut self,
        kind: &'static TableKind,
        table: &'t Table,
        at: &Place,
    ) -> Fields<'t> {
        let fields = Fields { kind, table, at: at.clone() };
        self.check_keys(&fields);
        fields
    }

    pub fn table<'t>(&mut self, fields: &Fields<'t>, key: &'static str) -> Option<Fields<'t>> {
        let kind = fields.kind.key_called(key)?.holds.table()?;
        self.open(kind, key, fields.node(key)?)
    }

    pub fn tables<'t>(&mut self, fields: &Fields<'t>, key: &'static str) -> Vec<Fields<'t>> {
        let tables = self.unchecked(fields, key);
        tables.iter().for_each(|table| self.check_keys(table));
        tables
    }

    /// The tables in the list of a key, whose keys are not checked.
    pub fn unchecked<'t>(&mut self, fields: &Fields<'t>, key: &'static str) -> Vec<Fields<'t>> {
        let (Some(known), Some(node)) = (fields.kind.key_called(key), fields.node(key)) else {
            return Vec::new();
        };
        let Some(kind) = known.holds.table() else { return Vec::new() };
        let Value::List(nodes) = &node.value else {
            let expected = format!("a list of tables, each under [[{key}]]");
            self.error(&node.at, key, node.value.kind(), &expected);
            return Vec::new();
        };
        nodes.iter().filter_map(|node| self.unchecked_table(kind, key, node)).collect()
    }

    /// The entries of a table whose keys the scene chooses.
    pub fn named<'t>(&mut self, fields: &Fields<'t>, key: &'static str) -> &'t [Entry] {
        match fields.node(key) {
            Some(Node { value: Value::Table(table), .. }) => &table.0,
            Some(node) => {
                self.error(&node.at, key, node.value.kind(), "a table with a name for each value");
                &[]
            }
            None => &[],
        }
    }

    pub fn text<'t>(&mut self, fields: &Fields<'t>, key: &'static str) -> Option<&'t str> {
        let node = fields.node(key)?;
        match &node.value {
            Value::Text(text) => Some(text),
            other => {
                self.error(&node.at, key, other.kind(), "a text in quotes");
                None
            }
        }
    }

    /// One of several texts.
    pub fn choice(
        &mut self,
        fields: &Fields<'_>,
        key: &'static str,
        choices: &[&'static str],
    ) -> Option<&'static str> {
        let text = self.text(fields, key)?;
        let found = choices.iter().find(|choice| choice.eq_ignore_ascii_case(text)).copied();
        if found.is_none() {
            let help = suggest::nearest(text, choices.iter().copied()).map(suggest::question);
            let expected = format!("one of {}", choices.join(", "));
            let at = fields.place(key);
            self.report.error_with_help(self.sources, &at, key, &quoted(text), &expected, help);
        }
        found
    }

    pub fn number(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<f64> {
        self.number_in(key, fields.node(key)?)
    }

    /// A whole number from 1 to `most`.
    pub fn count(&mut self, fields: &Fields<'_>, key: &'static str, most: usize) -> Option<usize> {
        let number = self.number(fields, key)?;
        if number.fract() == 0.0 && (1.0..=most as f64).contains(&number) {
            return Some(number as usize);
        }
        let expected = format!("a whole number from 1 to {most}");
        self.error(&fields.place(key), key, &crate::deck::shown(number), &expected);
        None
    }

    pub(super) fn number_in(&mut self, symbol: &str, node: &Node) -> Option<f64> {
        let value = match &node.value {
            Value::Number(number) => *number,
            Value::Text(text) => self.expression(symbol, text, &node.at)?,
            other => {
                self.error(&node.at, symbol, other.kind(), "a number");
                return None;
            }
        };
        if !value.is_finite() {
            self.error(&node.at, symbol, &value.to_string(), "a finite number");
            return None;
        }
        Some(value)
    }

    fn expression(&mut self, symbol: &str, text: &str, at: &Place) -> Option<f64> {
        let parameters = self.parameters;
        let found = expression::evaluate(text, &mut |name| {
            parameters.get(name).ok_or_else(|| parameters.unknown(name))
        });
        found.map_err(|error| self.wrong_expression(symbol, at, &error)).ok()
    }

    /// Reports what is wrong with the expression in the text at `at`.
    pub fn wrong_expression(
        &mut self,
        symbol: &str,
        at: &Place,
        error: &expression::ExpressionError,
    ) {
        // After the quote; text with escapes may be some characters longer.
        let start = (at.bytes.start + 1 + error.at).min(at.bytes.end.saturating_sub(1));
        let place = Place { file: at.file, bytes: start..at.bytes.end.saturating_sub(1) };
        self.error(&place, symbol, &error.found, &error.expected);
    }

    /// An angle or rate in radians.
    pub fn angle(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<f64> {
        self.angle_as_given(fields, key).map(in_radians)
    }

    /// An angle as it is given, and whether it is in degrees.
    pub fn angle_as_given(
        &mut self,
        fields: &Fields<'_>,
        key: &'static str,
    ) -> Option<(f64, bool)> {
        let (entry, ending) = fields.entry(key)?;
        Some((self.number_in(&entry.key, &entry.node)?, is_degrees(ending)))
    }

    /// Three angles or rates as they are given, and whether they are degrees.
    pub fn angles_as_given(
        &mut self,
        fields: &Fields<'_>,
        key: &'static str,
    ) -> Option<([f64; 3], bool)> {
        let (entry, ending) = fields.entry(key)?;
        let numbers = self.numbers_in(&entry.key, &entry.node)?;
        Some((numbers, is_degrees(ending)))
    }

    /// Three angles or rates in radians.
    pub fn angles(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<Vec3<f64>> {
        let (numbers, degrees) = self.angles_as_given(fields, key)?;
        Some(Vec3::from(numbers.map(|number| in_radians((number, degrees)))))
    }

    /// Pairs of an angle in radians and a number.
    pub fn angle_pairs(&mut self, fields: &Fields<'_>, key: &'static str) -> Vec<[f64; 2]> {
        let Some((entry, ending)) = fields.entry(key) else { return Vec::new() };
        let rows = self.rows_in::<2>(&entry.key, &entry.node).into_iter();
        let degrees = is_degrees(ending);
        rows.map(|[angle, value]| [in_radians((angle, degrees)), value]).collect()
    }

    /// Pairs of a time and a rate, in radians.
    pub fn angles_over_time(&mut self, fields: &Fields<'_>, key: &'static str) -> Vec<[f64; 2]> {
        let Some((entry, ending)) = fields.entry(key) else { return Vec::new() };
        let rows = self.rows_in::<2>(&entry.key, &entry.node).into_iter();
        let degrees = is_degrees(ending);
        rows.map(|[time, rate]| [time, in_radians((rate, degrees))]).collect()
    }

    pub fn numbers<const N: usize>(
        &mut self,
        fields: &Fields<'_>,
        key: &'static str,
    ) -> Option<[f64; N]> {
        self.numbers_in(key, fields.node(key)?)
    }

    pub fn vector(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<Vec3<f64>> {
        self.numbers(fields, key).map(Vec3::from)
    }

    pub fn rows<const N: usize>(
        &mut self,
        fields: &Fields<'_>,
        key: &'static str,
    ) -> Vec<[f64; N]> {
        fields.node(key).map_or_else(Vec::new, |node| self.rows_in(key, node))
    }

    fn rows_in<const N: usize>(&mut self, symbol: &str, node: &Node) -> Vec<[f64; N]> {
        match &node.value {
            Value::List(rows) => {
                rows.iter().filter_map(|row| self.numbers_in(symbol, row)).collect()
            }
            other => {
                self.error(
                    &node.at,
                    symbol,
                    other.kind(),
                    &format!("a list of lists of {N} numbers"),
                );
                Vec::new()
            }
        }
    }

    /// Two limits of a coordinate, in radians where the key is one of angles. An infinite one is none on its side.
    pub fn limits(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<[f64; 2]> {
        let (entry, ending) = fields.entry(key)?;
        let limits = self.list_in(&entry.key, &entry.node, Self::limit_in)?;
        Some(limits.map(|limit| in_radians((limit, is_degrees(ending)))))
    }

    fn limit_in(&mut self, symbol: &str, node: &Node) -> Option<f64> {
        match node.value {
            Value::Number(limit) if limit.is_infinite() => Some(limit),
            _ => self.number_in(symbol, node),
        }
    }

    pub(super) fn numbers_in<const N: usize>(
        &mut self,
        symbol: &str,
        node: &Node,
    ) -> Option<[f64; N]> {
        self.list_in(symbol, node, Self::number_in)
    }

    /// A list of numbers, each of which `read` reads.
    fn list_in<const N: usize>(
        &mut self,
        symbol: &str,
        node: &Node,
        read: fn(&mut Self, &str, &Node) -> Option<f64>,
    ) -> Option<[f64; N]> {
        let expected = format!("a list of {N} numbers");
        let Value::List(nodes) = &node.value else {
            self.error(&node.at, symbol, node.value.kind(), &expected);
            return None;
        };
        if nodes.len() != N {
            self.error(&node.at, symbol, &format!("a list of {}", nodes.len()), &expected);
            return None;
        }
        let mut numbers = [0.0; N];
        let mut are_right = true;
        for (number, node) in numbers.iter_mut().zip(nodes.iter()) {
            match read(self, symbol, node) {
                Some(value) => *number = value,
                None => are_right = false,
            }
        }
        are_right.then_some(numbers)
    }
}

fn is_degrees(ending: &str) -> bool {
    ending == ENDINGS[0]
}

/// An angle or rate in radians; the second says whether it is in degrees.
fn in_radians((value, degrees): (f64, bool)) -> f64 {
    if degrees { value.to_radians() } else { value }
}
