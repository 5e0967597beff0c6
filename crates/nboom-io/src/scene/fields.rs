//! A table of a scene that is being read: values by key, each error at its place.

use nboom_scalar::Vec3;

use super::expression;
use super::keys::{ENDINGS, Key, TableKind};
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
}

/// A table whose keys are those of its kind.
#[derive(Clone)]
pub(crate) struct Fields<'t> {
    pub kind: &'static TableKind,
    table: &'t Table,
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
}

impl<'t> Fields<'t> {
    /// The entry of a key, and its ending if it is one of an angle.
    fn entry(&self, key: &str) -> Option<(&'t Entry, &'static str)> {
        let with = |ending: &'static str| {
            let entry =
                self.table.0.iter().find(|entry| entry.key.strip_suffix(ending) == Some(key));
            entry.map(|entry| (entry, ending))
        };
        self.table.get(key).map(|entry| (entry, "")).or_else(|| ENDINGS.into_iter().find_map(with))
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
        let Value::Table(table) = &node.value else {
            let expected = format!("a table of a {}", kind.name);
            self.error(&node.at, symbol, node.value.kind(), &expected);
            return None;
        };
        Some(self.fields(kind, table, &node.at))
    }

    /// A table, checked as by [`open`](Self::open).
    pub fn fields<'t>(
        &mut self,
        kind: &'static TableKind,
        table: &'t Table,
        at: &Place,
    ) -> Fields<'t> {
        let mut meant = Vec::new();
        for Entry { key, key_at, .. } in &table.0 {
            if kind.key(key).is_none() {
                let names: Vec<String> = kind.keys.iter().flat_map(Key::names).collect();
                let near = suggest::nearest(key, names.iter().map(String::as_str));
                meant.extend(near.and_then(|near| kind.key(near)).map(|key| key.name));
                let found = format!("{} in {}", quoted(key), kind.name);
                let (expected, help) = ("a key of this table", near.map(suggest::question));
                self.report.error_with_help(self.sources, key_at, key, &found, expected, help);
            }
        }
        for key in kind.keys {
            let given: Vec<&Entry> =
                table.0.iter().filter(|entry| key.is_called(&entry.key)).collect();
            if let [_, second] = given[..] {
                let found = format!("{} beside {}", quoted(&second.key), quoted(&given[0].key));
                self.error(&second.key_at, &second.key, &found, "one of them");
            }
            // A key that is nearly there has been told.
            if given.is_empty() && key.is_required && !meant.contains(&key.name) {
                let found = format!("none in {}", kind.name);
                self.error(at, &key.names().join(" or "), &found, &in_a_sentence(key.about));
            }
        }
        let fields = Fields { kind, table, at: at.clone() };
        let given: Vec<&str> =
            kind.one_of.iter().copied().filter(|key| fields.entry(key).is_some()).collect();
        let is_nearly_there = given.is_empty() && kind.one_of.iter().any(|key| meant.contains(key));
        if !kind.one_of.is_empty() && given.len() != 1 && !is_nearly_there {
            let found = if given.is_empty() { "none".to_owned() } else { given.join(" and ") };
            let expected = format!("exactly one of {}", kind.one_of.join(", "));
            self.error(at, kind.name, &found, &expected);
        }
        fields
    }

    pub fn table<'t>(&mut self, fields: &Fields<'t>, key: &'static str) -> Option<Fields<'t>> {
        let kind = fields.kind.key_called(key)?.holds.table()?;
        self.open(kind, key, fields.node(key)?)
    }

    pub fn tables<'t>(&mut self, fields: &Fields<'t>, key: &'static str) -> Vec<Fields<'t>> {
        let (Some(known), Some(node)) = (fields.kind.key_called(key), fields.node(key)) else {
            return Vec::new();
        };
        let Some(kind) = known.holds.table() else { return Vec::new() };
        let Value::List(nodes) = &node.value else {
            let expected = format!("a list of tables, each under [[{key}]]");
            self.error(&node.at, key, node.value.kind(), &expected);
            return Vec::new();
        };
        nodes.iter().filter_map(|node| self.open(kind, key, node)).collect()
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

    pub(super) fn numbers_in<const N: usize>(
        &mut self,
        symbol: &str,
        node: &Node,
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
        for (number, node) in numbers.iter_mut().zip(nodes) {
            match self.number_in(symbol, node) {
                Some(value) => *number = value,
                None => are_right = false,
            }
        }
        are_right.then_some(numbers)
    }
}

/// A sentence without its point and with a small first letter, unless it begins with a name.
fn in_a_sentence(about: &str) -> String {
    let (first, rest) = about.split_at(about.chars().next().map_or(0, char::len_utf8));
    let is_name = about.starts_with("Young") || about.starts_with("Poisson");
    let first = if is_name { first.to_owned() } else { first.to_lowercase() };
    first + rest.strip_suffix('.').unwrap_or(rest)
}

fn is_degrees(ending: &str) -> bool {
    ending == ENDINGS[0]
}

/// An angle or rate in radians; the second says whether it is in degrees.
fn in_radians((value, degrees): (f64, bool)) -> f64 {
    if degrees { value.to_radians() } else { value }
}
