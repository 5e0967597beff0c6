use nboom_scalar::{Mat3, Vec3};

/// What a body looks like in pictures; no motion depends on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyShape {
    /// What it is.
    pub solid: Solid,
    /// Its middle, from the body's origin, body axes \[L\].
    pub middle: Vec3<f64>,
    /// Its own axes as columns, body axes.
    pub axes: Mat3<f64>,
}

impl BodyShape {
    /// A solid around this place, along the body's axes.
    pub fn around(middle: impl Into<Vec3<f64>>, solid: Solid) -> Self {
        Self { solid, middle: middle.into(), axes: Mat3::identity() }
    }
}

/// A simple solid around its middle, along its own axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// A box with these sides along x, y and z \[L\].
    Box(Vec3<f64>),
    /// A flat rectangle with these sides along x, y and z \[L\], one of which is zero.
    Panel(Vec3<f64>),
    /// A circular cylinder.
    Cylinder {
        /// \[L\]
        radius: f64,
        /// \[L\]
        length: f64,
        /// Unit vector along its axis.
        along: Vec3<f64>,
    },
}

/// The shapes of the bodies that have one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shapes {
    /// Of the main body.
    pub main_body: Option<BodyShape>,
    /// Of the hinged bodies; those beyond the last entry have none.
    pub bodies: Vec<Option<BodyShape>>,
}

impl Shapes {
    /// That of hinged body `i`.
    pub fn of(&self, i: usize) -> Option<&BodyShape> {
        self.bodies.get(i).and_then(Option::as_ref)
    }
}
