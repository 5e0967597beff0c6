//! Parameters of a scene: numbers by name, which expressions use.

use std::collections::HashMap;

use super::expression::{self, ExpressionError};
use super::fields::Reader;
use super::sources::Sources;
use super::suggest;
use super::tree::{Entry, Value};
use crate::diagnostic::{Report, quoted};

/// The values of all parameters.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parameters {
    values: HashMap<String, f64>,
}

impl Parameters {
    pub fn get(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }

    /// All of them, by name.
    pub fn all(&self) -> Vec<(String, f64)> {
        let mut all: Vec<_> =
            self.values.iter().map(|(name, value)| (name.clone(), *value)).collect();
        all.sort_by(|a, b| a.0.cmp(&b.0));
        all
    }

    /// The names of those that have other values elsewhere.
    pub fn other_than(&self, elsewhere: &Self) -> Vec<&str> {
        let bits = |value: Option<f64>| value.map(f64::to_bits);
        let names = self.values.iter().map(|(name, value)| (name.as_str(), bits(Some(*value))));
        let other = names.filter(|(name, value)| *value != bits(elsewhere.get(name)));
        other.map(|(name, _)| name).collect()
    }

    /// What was found and expected instead of an unknown name.
    pub fn unknown(&self, name: &str) -> (String, String) {
        unknown(name, self.values.keys().map(String::as_str))
    }

    /// The values of `entries`, of which `set` replaces some.
    pub fn read(
        entries: &[&Entry],
        set: &[(String, f64)],
        sources: &Sources,
        report: &mut Report<'_>,
    ) -> Self {
        let none = Self::default();
        let mut reader = Reader { sources, report, parameters: &none, are_keys_right: true };
        let mut known: HashMap<&str, &Entry> = HashMap::new();
        for &entry in entries {
            if !expression::is_name(&entry.key) {
                let expected = "a name of letters, digits and _, not a digit first";
                reader.error(&entry.key_at, &entry.key, &quoted(&entry.key), expected);
            }
            if known.insert(&entry.key, entry).is_some() {
                reader.error(&entry.key_at, &entry.key, "a name twice", "each name once");
            }
        }
        let mut values: HashMap<String, f64> = HashMap::new();
        values.extend(set.iter().filter(|(name, _)| known.contains_key(name.as_str())).cloned());
        let mut solver = Solver { known, values, under_way: Vec::new() };
        for entry in entries {
            if let Err(error) = solver.value(&entry.key) {
                match &entry.node.value {
                    Value::Text(_) => reader.wrong_expression(&entry.key, &entry.node.at, &error),
                    _ => reader.error(&entry.node.at, &entry.key, &error.found, &error.expected),
                }
                // Once is enough: what depends on it is not wrong.
                solver.values.insert(entry.key.clone(), 1.0);
            }
        }
        Self { values: solver.values }
    }
}

fn unknown<'n>(name: &str, known: impl Iterator<Item = &'n str> + Clone) -> (String, String) {
    let mut names: Vec<&str> = known.clone().collect();
    names.sort_unstable();
    let found = format!("`${name}`, which is no parameter");
    let expected = match (suggest::nearest(name, known), &names[..]) {
        (Some(near), _) => format!("a parameter; {}", suggest::question(near)),
        (None, []) => "a parameter; the scene has no table [parameters]".to_owned(),
        (None, few @ ([_] | [_, _] | [_, _, _])) => format!("one of {}", few.join(", ")),
        (None, _) => "a parameter of the table [parameters]".to_owned(),
    };
    (found, expected)
}

/// Longest chain of parameters that are defined by others.
const DEEPEST: usize = 100;

struct Solver<'t> {
    known: HashMap<&'t str, &'t Entry>,
    values: HashMap<String, f64>,
    /// Names whose values are being computed.
    under_way: Vec<String>,
}

impl Solver<'_> {
    fn value(&mut self, name: &str) -> Result<f64, ExpressionError> {
        if let Some(value) = self.values.get(name) {
            return Ok(*value);
        }
        let wrong = |found: String, expected: String| ExpressionError { at: 0, found, expected };
        let Some(entry) = self.known.get(name).copied() else {
            let (found, expected) = unknown(name, self.known.keys().copied());
            return Err(wrong(found, expected));
        };
        if self.under_way.iter().any(|other| other == name) {
            let expected = "parameters that do not depend on each other in a circle".to_owned();
            return Err(wrong(format!("`${name}` on the way to itself"), expected));
        }
        if self.under_way.len() == DEEPEST {
            let expected = format!("chains of at most {DEEPEST} parameters");
            return Err(wrong(format!("`${name}` after {DEEPEST} others"), expected));
        }
        let value = match &entry.node.value {
            Value::Number(number) => *number,
            Value::Text(text) => {
                self.under_way.push(name.to_owned());
                let value = expression::evaluate(text, &mut |name| {
                    self.value(name).map_err(|error| (error.found, error.expected))
                });
                self.under_way.pop();
                value?
            }
            other => return Err(wrong(other.kind().to_owned(), "a number".to_owned())),
        };
        if !value.is_finite() {
            return Err(wrong(value.to_string(), "a finite number".to_owned()));
        }
        self.values.insert(name.to_owned(), value);
        Ok(value)
    }
}
