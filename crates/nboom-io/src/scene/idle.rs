//! What a scene says in vain: probably a mistake, and no error.

use super::fields::{Fields, Reader};
use super::include::Parts;
use super::sources::Sources;
use super::tree::{Node, Table, Value};
use crate::deck::shown;
use crate::diagnostic::Report;
use crate::words::HingeWords;

/// Warns of parameters that are set more than once, and of those that are set and of materials, where nothing uses
/// them. A scene that is not written to its end
/// has parameters for later, and a file that it includes may serve others.
pub(super) fn check_use(
    parts: &Parts,
    set: &[(String, f64)],
    sources: &Sources,
    report: &mut Report<'_>,
) {
    let materials = parts.root().get("materials").map(|entry| &entry.node.value);
    let is_own =
        |name: &str| matches!(materials, Some(Value::Table(table)) if table.get(name).is_some());
    for entry in parts.entries("parameters") {
        let name = entry.key.as_str();
        let values: Vec<f64> =
            set.iter().filter(|(set, _)| set == name).map(|(_, value)| *value).collect();
        if let [_, .., last] = values[..] {
            let found =
                format!("values of `{name}`, of which the last one, {}, holds", shown(last));
            report.warn_at(sources, &entry.key_at, "--set", &found, "one value of a parameter");
        }
        if !values.is_empty() && !parts.iter().any(|(_, table, _)| table.mentions(&[name])) {
            let expected = format!("one of which some number is an expression, as `${name}`");
            let found = "a parameter that nothing uses";
            report.warn_at(sources, &entry.key_at, "--set", found, &expected);
        }
    }
    for entry in parts.entries("materials") {
        let name = entry.key.as_str();
        if is_own(name) && !parts.iter().any(|(_, table, _)| is_used(table, name)) {
            let expected = format!("one of some body, as `material = \"{name}\"`");
            let found = "a material that nothing uses";
            report.warn_at(sources, &entry.key_at, name, found, &expected);
        }
    }
}

impl Reader<'_, '_> {
    /// Warns of an empty list, or of a table without any of the keys that count.
    pub fn warn_if_idle(&mut self, fields: &Fields<'_>, key: &'static str, keys: &[&str]) {
        let Some((entry, _)) = fields.entry(key) else { return };
        let (found, expected) = match &entry.node.value {
            Value::List(nodes) if nodes.is_empty() => {
                ("an empty list", "at least one entry".to_owned())
            }
            Value::Table(table)
                if !keys.is_empty() && keys.iter().all(|key| table.get(key).is_none()) =>
            {
                ("a table that has no effect", format!("at least one of {}", keys.join(", ")))
            }
            _ => return,
        };
        self.report.warn_at(self.sources, &entry.node.at, &entry.key, found, &expected);
    }

    /// Warns of stops of a joint that are on neither side or never reached, and of a restitution that is one of none.
    pub fn warn_if_stops_are_idle(&mut self, joint: &Fields<'_>, words: &HingeWords) {
        let mut warn = |key, found: &str, expected: &str| {
            if let Some((entry, _)) = joint.entry(key) {
                self.report.warn_at(self.sources, &entry.node.at, &entry.key, found, expected);
            }
        };
        if words.stops.is_none() {
            warn("stops", "stops on neither side", "a number on one side at least");
            warn("restitution", "a restitution without stops", "stops beside it");
        } else if !words.can_move() {
            let found = format!("stops of a {} that never moves", words.joint.name());
            warn("stops", &found, "one that starts free or is released");
        }
    }

    /// Warns of a force or torque of zero in numbers; parameters may have other values.
    pub fn warn_if_zero(&mut self, fields: &Fields<'_>, key: &'static str) {
        let Some(Node { value: Value::List(numbers), at }) = fields.node(key) else { return };
        if numbers.iter().all(is_zero) {
            let found = format!("a {key} of zero");
            self.report.warn_at(self.sources, at, key, &found, "one that acts, or none");
        }
    }

    /// Warns of a table of rows in which all is zero behind the first number, likewise.
    pub fn warn_if_zero_throughout(&mut self, fields: &Fields<'_>, key: &'static str) {
        let Some((entry, _)) = fields.entry(key) else { return };
        let Value::List(rows) = &entry.node.value else { return };
        let is_idle = |row: &Node| match &row.value {
            Value::List(numbers) => numbers.len() > 1 && numbers[1..].iter().all(is_zero),
            _ => false,
        };
        if !rows.is_empty() && rows.iter().all(is_idle) {
            let (found, expected) = ("a table that is zero throughout", "one that acts, or none");
            self.report.warn_at(self.sources, &entry.node.at, &entry.key, found, expected);
        }
    }
}

fn is_zero(node: &Node) -> bool {
    matches!(node.value, Value::Number(0.0))
}

/// Whether a body of a file is of this material.
fn is_used(file: &Table, material: &str) -> bool {
    let bodies = file.get("body").map(|entry| &entry.node.value);
    let Some(Value::List(bodies)) = bodies else { return false };
    bodies.iter().any(|body| {
        let Value::Table(body) = &body.value else { return false };
        let of = body.get("material").map(|entry| &entry.node.value);
        matches!(of, Some(Value::Text(name)) if name == material)
    })
}
