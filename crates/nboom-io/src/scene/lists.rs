//! Lists of any length.

use super::fields::{Fields, Reader};
use super::sources::Place;
use super::tree::{Node, Value};

impl Reader<'_, '_> {
    /// Any count of numbers.
    pub fn list(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<Vec<f64>> {
        let node = fields.node(key)?;
        let Value::List(nodes) = &node.value else {
            self.error(&node.at, key, node.value.kind(), "a list of numbers");
            return None;
        };
        let numbers: Vec<_> = nodes.iter().map(|node| self.number_in(key, node)).collect();
        numbers.into_iter().collect()
    }

    /// Texts with their places; one alone may stand without a list.
    pub fn texts<'t>(&mut self, fields: &Fields<'t>, key: &'static str) -> Vec<(&'t str, Place)> {
        let Some(node) = fields.node(key) else { return Vec::new() };
        let nodes = match &node.value {
            Value::List(nodes) => &nodes[..],
            _ => std::slice::from_ref(node),
        };
        let mut texts = Vec::new();
        for Node { value, at } in nodes {
            match value {
                Value::Text(text) => texts.push((text.as_str(), at.clone())),
                other => self.error(at, key, other.kind(), "a text in quotes"),
            }
        }
        texts
    }
}
