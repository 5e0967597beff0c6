//! Shapes for pictures in words.

use nboom_model::{BodyShape, MassProperties, Solid};
use nboom_scalar::{Mat3, Vec3};

use super::fields::{Fields, Reader};
use crate::deck::shown;

impl Reader<'_, '_> {
    /// The shape of a body that has these mass properties, if it says one.
    pub fn shape(&mut self, body: &Fields<'_>, of: &MassProperties) -> Option<BodyShape> {
        let shape = self.table(body, "shape")?;
        let solid = self.solid(&shape);
        let middle = self.vector(&shape, "at").unwrap_or(of.center_of_mass);
        let axes = self.table(&shape, "axes").and_then(|axes| self.rotation(&axes));
        Some(BodyShape { solid: solid?, middle, axes: axes.unwrap_or_else(Mat3::identity) })
    }

    fn solid(&mut self, shape: &Fields<'_>) -> Option<Solid> {
        if let Some(cylinder) = self.table(shape, "cylinder") {
            let [radius, length] = ["radius", "length"].map(|key| self.size(&cylinder, key));
            let along = self.direction(&cylinder, "along");
            return Some(Solid::Cylinder { radius: radius?, length: length?, along: along? });
        }
        if let Some(sides) = self.vector(shape, "panel") {
            return self.has_sides(shape, "panel", sides, 2).then_some(Solid::Panel(sides));
        }
        let sides = self.vector(shape, "box")?;
        self.has_sides(shape, "box", sides, 3).then_some(Solid::Box(sides))
    }

    /// A positive number.
    fn size(&mut self, fields: &Fields<'_>, key: &'static str) -> Option<f64> {
        let size = self.number(fields, key)?;
        if size <= 0.0 {
            self.error(&fields.place(key), key, &shown(size), "a positive length");
        }
        Some(size)
    }

    /// Whether so many sides are positive and the others zero; reports it if not.
    fn has_sides(
        &mut self,
        shape: &Fields<'_>,
        key: &'static str,
        sides: Vec3<f64>,
        count: usize,
    ) -> bool {
        let sides = sides.to_array();
        let positive = sides.iter().filter(|side| **side > 0.0).count();
        let is_right = positive == count && sides.iter().all(|side| *side >= 0.0);
        if !is_right {
            let found = format!("sides {}", sides.map(shown).join(", "));
            let expected = match count {
                2 => "two positive lengths and a 0, across the panel",
                _ => "three positive lengths",
            };
            self.error(&shape.place(key), key, &found, expected);
        }
        is_right
    }
}
