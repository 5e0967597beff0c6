//! A tree as TOML.

use crate::scene::tree::{Table, Value};

/// The text of a scene's tree. Comments and the order of keys are not kept.
pub(super) fn of(root: &Table) -> String {
    toml::to_string(&table(root)).expect("keys are texts")
}

fn table(table: &Table) -> toml::Table {
    table.0.iter().map(|entry| (entry.key.clone(), value(&entry.node.value))).collect()
}

fn value(found: &Value) -> toml::Value {
    match found {
        Value::Number(number) => toml::Value::Float(*number),
        Value::Text(text) => toml::Value::String(text.clone()),
        Value::List(nodes) => {
            toml::Value::Array(nodes.iter().map(|node| value(&node.value)).collect())
        }
        Value::Table(inner) => toml::Value::Table(table(inner)),
        Value::Other(kind) => toml::Value::String((*kind).to_owned()),
    }
}
