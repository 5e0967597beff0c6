//! Random sections and loads.

use std::f64::consts::TAU;

use nboom_scalar::{Vec3, Wrench};
use nboom_sections::{Point, Polygon};
use proptest::prelude::*;

/// What a polygon is made from.
#[derive(Clone, Debug)]
pub struct Description {
    pub vertices: Vec<Point>,
    pub thickness: Vec<f64>,
}

impl Description {
    pub fn polygon(&self) -> Polygon {
        Polygon::new(&self.vertices, &self.thickness).expect("a simple polygon")
    }

    /// With every vertex moved, and thicknesses left.
    pub fn map(&self, moved: impl Fn(Point) -> Point) -> Self {
        Self { vertices: self.vertices.iter().map(|&p| moved(p)).collect(), ..self.clone() }
    }
}

/// Polygons with 3 to 9 walls, in either direction, the η axis inside or outside. Vertices turn
/// about a point by less than half a turn from one to the next, so walls do not cross; radii are so
/// different that most of these polygons are not convex.
pub fn description() -> impl Strategy<Value = Description> {
    let wall = (0.0..0.4, 0.3..3.0, 0.01..0.08);
    let walls = prop::collection::vec(wall, 3..=9);
    (walls, -5.0..5.0, -5.0..5.0, any::<bool>()).prop_map(|(walls, xi, zeta, reversed)| {
        let count = walls.len() as f64;
        let vertex = |(i, (turn, radius, _)): (usize, &(f64, f64, f64))| {
            let angle = TAU * (i as f64 + turn) / count;
            Point { xi: xi + radius * angle.cos(), zeta: zeta + radius * angle.sin() }
        };
        let mut vertices: Vec<Point> = walls.iter().enumerate().map(vertex).collect();
        if reversed {
            vertices.reverse();
        }
        Description { vertices, thickness: walls.iter().map(|wall| wall.2).collect() }
    })
}

pub fn load() -> impl Strategy<Value = Wrench<f64>> {
    let component = -100.0..100.0;
    prop::array::uniform6(component).prop_map(|[a, b, c, d, e, f]| Wrench {
        force: Vec3::new(a, b, c),
        moment: Vec3::new(d, e, f),
    })
}

pub fn cases() -> ProptestConfig {
    ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(300) }
}

/// The force and moment that one exerts at a point of the section.
pub fn wrench_at(place: Point, force: Vec3<f64>) -> Wrench<f64> {
    Wrench::of_force(Vec3::new(place.xi, 0.0, place.zeta), force)
}
