//! Directions and inertias in words.

use nboom_scalar::{Sym3, Vec3};

use super::fields::{Fields, Reader};
use super::tree::Value;
use crate::axes::{A_DIRECTION, axis_named, unit_vector};
use crate::diagnostic::quoted;

impl Reader<'_, '_> {
    /// A unit vector: an axis by name, or three numbers of any length but zero.
    pub fn direction(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<Vec3<f64>> {
        let node = fields.node(key)?;
        let expected = A_DIRECTION;
        let (found, vector) = match &node.value {
            Value::Text(text) => (quoted(text), axis_named(text)),
            Value::List(_) => {
                let vector = Vec3::from(self.numbers_in(key, node)?);
                ("a vector without direction".to_owned(), unit_vector(vector))
            }
            other => (other.kind().to_owned(), None),
        };
        if vector.is_none() {
            self.error(&node.at, key, &found, expected);
        }
        vector
    }

    /// An inertia: three moments, or a table.
    pub fn inertia(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<Sym3<f64>> {
        let node = fields.node(key)?;
        if matches!(node.value, Value::List(_)) {
            let [xx, yy, zz] = self.numbers_in(key, node)?;
            return Some(Sym3::diagonal(xx, yy, zz));
        }
        let table = self.table(fields, key)?;
        let moments = ["xx", "yy", "zz"].map(|key| self.number(&table, key));
        let products = ["xy", "xz", "yz"].map(|key| self.number(&table, key).unwrap_or(0.0));
        let ([Some(xx), Some(yy), Some(zz)], [xy, xz, yz]) = (moments, products) else {
            return None;
        };
        Some(Sym3 { xx, yy, zz, xy, xz, yz })
    }
}
