use crate::max_von_mises::{Square, max_von_mises};
use crate::shear_flow::UnitFlows;
use crate::{Point, Stress};

/// A plane wall of a polygon, from one vertex to the next; places on it are fractions x of its
/// length from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall {
    start: Point,
    along: Point,
    length: f64,
    thickness: f64,
    /// Shear flow under unit loads.
    pub(crate) flows: UnitFlows,
}

impl Wall {
    pub(crate) fn new(start: Point, end: Point, thickness: f64) -> Self {
        let along = end - start;
        Self { start, along, length: along.norm(), thickness, flows: UnitFlows::NONE }
    }

    /// The vertex at which it starts.
    pub fn start(&self) -> Point {
        self.start
    }

    /// The vector from its start to its end.
    pub fn along(&self) -> Point {
        self.along
    }

    /// Its length.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Its thickness.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// The place `x` of it.
    pub fn at(&self, x: f64) -> Point {
        self.start + self.along * x
    }

    /// The place of it that is nearest to a point.
    pub fn nearest(&self, point: Point) -> f64 {
        let x = (point - self.start).dot(self.along) / self.along.dot(self.along);
        x.clamp(0.0, 1.0)
    }

    pub(crate) fn area(&self) -> f64 {
        self.length * self.thickness
    }
}

/// Stress along a wall: normal stress is linear, shear stress quadratic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WallStress {
    /// Coefficients of the normal stress in x, the constant first; tension is positive.
    pub normal: [f64; 2],
    /// Coefficients of the shear stress in x, positive along the wall.
    pub shear: [f64; 3],
    /// Unit vector along the wall.
    pub direction: Point,
}

impl WallStress {
    /// Shear stress at `x`, positive along the wall.
    pub fn shear_at(&self, x: f64) -> f64 {
        let [a, b, c] = self.shear;
        a + x * (b + x * c)
    }

    /// The stress at `x`.
    pub fn at(&self, x: f64) -> Stress {
        let shear = self.direction * self.shear_at(x);
        let normal = self.normal[0] + x * self.normal[1];
        Stress { normal, shear_xi: shear.xi, shear_zeta: shear.zeta }
    }

    /// Where the von Mises stress is largest.
    pub fn max_von_mises(&self) -> f64 {
        let (normal, shear) = (self.normal_ordinates(), self.shear_ordinates());
        let unit = normal.iter().chain(&shear).fold(f64::MIN_POSITIVE, |most, c| most.max(c.abs()));
        let square = Square { normal: normal.map(|c| c / unit), shear: shear.map(|c| c / unit) };
        let (_, x) = max_von_mises(std::iter::once(square));
        x
    }

    /// Coefficients of the normal stress in Bernstein's basis, the values at both ends.
    pub(crate) fn normal_ordinates(&self) -> [f64; 2] {
        let [a, b] = self.normal;
        [a, a + b]
    }

    /// Coefficients of the shear stress in Bernstein's basis.
    pub(crate) fn shear_ordinates(&self) -> [f64; 3] {
        let [a, b, c] = self.shear;
        [a, a + 0.5 * b, a + b + c]
    }
}
