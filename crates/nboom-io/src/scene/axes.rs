//! Rotations in words.

use nboom_scalar::{Mat3, Quaternion};

use super::fields::{Fields, Reader};
use crate::axes::{Rotation, Turns};

impl Reader<'_, '_> {
    /// The rotation that a table of axes describes.
    pub fn rotation(&mut self, axes: &Fields<'_>) -> Option<Mat3<f64>> {
        let (key, rotation) = self.given_rotation(axes)?;
        self.right(axes, key, rotation.matrix())
    }

    /// The attitude that a table of axes describes.
    pub fn attitude(&mut self, axes: &Fields<'_>) -> Option<Quaternion<f64>> {
        let (key, rotation) = self.given_rotation(axes)?;
        self.right(axes, key, rotation.attitude())
    }

    /// Reports what is wrong with the value of a key.
    fn right<T>(
        &mut self,
        axes: &Fields<'_>,
        key: &'static str,
        found: Result<T, (String, &'static str)>,
    ) -> Option<T> {
        found.map_err(|(found, expected)| self.error(&axes.place(key), key, &found, expected)).ok()
    }

    /// The key that says it, and the rotation.
    fn given_rotation(&mut self, axes: &Fields<'_>) -> Option<(&'static str, Rotation)> {
        fn turns<T>((angles, degrees): (T, bool)) -> Turns<T> {
            if degrees { Turns::Degrees(angles) } else { Turns::Radians(angles) }
        }
        if axes.has("euler_xyx") {
            let angles = self.angles_as_given(axes, "euler_xyx")?;
            return Some(("euler_xyx", Rotation::EulerXyx(turns(angles))));
        }
        if axes.has("turn") {
            let turn = self.table(axes, "turn")?;
            let (about, by) = (self.direction(&turn, "about"), self.angle_as_given(&turn, "by"));
            let (by, about) = (turns(by?), about?);
            return Some(("turn", Rotation::Turn { about, by }));
        }
        if axes.has("columns") {
            let rows = self.rows::<3>(axes, "columns");
            let &[x, y, z] = &rows[..] else {
                let found = format!("{} of three numbers", rows.len());
                let expected = "three lists of three numbers";
                self.error(&axes.place("columns"), "columns", &found, expected);
                return None;
            };
            return Some(("columns", Rotation::Columns([x, y, z])));
        }
        self.numbers(axes, "quaternion").map(|given| ("quaternion", Rotation::Quaternion(given)))
    }
}
