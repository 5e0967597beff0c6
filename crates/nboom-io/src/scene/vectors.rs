//! Directions and inertias in words.

use nboom_scalar::{Sym3, Vec3};

use super::fields::{Fields, Reader};
use super::tree::Value;
use crate::diagnostic::quoted;

impl Reader<'_, '_> {
    /// A unit vector: an axis by name, or three numbers of any length but zero.
    pub fn direction(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<Vec3<f64>> {
        let node = fields.node(key)?;
        let expected = "\"x\", \"-x\", \"y\", \"-y\", \"z\", \"-z\" or three numbers";
        let (found, vector) = match &node.value {
            Value::Text(text) => {
                let (sign, name) =
                    text.strip_prefix('-').map_or((1.0, text.as_str()), |n| (-1.0, n));
                let axis = ["x", "y", "z"].iter().position(|axis| axis.eq_ignore_ascii_case(name));
                let unit = |axis| [0, 1, 2].map(|i| if i == axis { sign } else { 0.0 });
                (quoted(text), axis.map(|axis| Vec3::from(unit(axis))))
            }
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

/// The vector with length 1; one that has this length but for rounding is left alone.
fn unit_vector(vector: Vec3<f64>) -> Option<Vec3<f64>> {
    let largest = vector.to_array().into_iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    if largest == 0.0 {
        return None;
    }
    if (vector.norm_squared() - 1.0).abs() <= 4.0 * f64::EPSILON {
        return Some(vector);
    }
    let scaled = vector.map(|c| c / largest);
    let length = scaled.norm();
    Some(scaled.map(|c| c / length))
}
