//! Checks whether walls are the outline of one cell.

use crate::{Point, SectionError, Wall};

/// Distances below this share of the outline's length count as zero.
const COINCIDENCE: f64 = 1e-12;

/// Every wall is compared with every other one.
const MOST_VERTICES: usize = 1000;

/// The walls between given vertices.
pub(crate) fn walls(vertices: &[Point], thickness: &[f64]) -> Result<Vec<Wall>, Vec<SectionError>> {
    let mut errors = Vec::new();
    if vertices.len() < 3 {
        errors.push(SectionError::TooFewVertices { found: vertices.len() });
    }
    if vertices.len() > MOST_VERTICES {
        let (found, most) = (vertices.len(), MOST_VERTICES);
        return Err(vec![SectionError::TooManyVertices { found, most }]);
    }
    if thickness.len() != vertices.len() {
        let (found, expected) = (thickness.len(), vertices.len());
        errors.push(SectionError::ThicknessCount { found, expected });
    }
    for (vertex, &Point { xi, zeta }) in vertices.iter().enumerate() {
        if !(Point { xi, zeta }).is_finite() {
            errors.push(SectionError::Vertex { vertex, xi, zeta });
        }
    }
    for (wall, &thickness) in thickness.iter().enumerate() {
        let is_positive = thickness > 0.0 && thickness.is_finite();
        if !is_positive {
            errors.push(SectionError::Thickness { wall, thickness });
        }
    }
    if !errors.is_empty() {
        return Err(errors);
    }
    let ends = vertices.iter().cycle().skip(1);
    let pairs = vertices.iter().zip(ends).zip(thickness);
    let walls: Vec<Wall> = pairs.map(|((&start, &end), &t)| Wall::new(start, end, t)).collect();
    let errors = defects(&walls);
    if errors.is_empty() { Ok(walls) } else { Err(errors) }
}

/// The length below which lengths count as zero.
pub(crate) fn coincidence(walls: &[Wall]) -> f64 {
    COINCIDENCE * walls.iter().map(Wall::length).sum::<f64>()
}

/// Area inside the outline, positive where it is numbered from ξ towards ζ; eq. (12.9), corrected:
/// note 23.
pub(crate) fn signed_area(walls: &[Wall]) -> f64 {
    let from = walls[0].start();
    0.5 * walls.iter().map(|wall| (wall.start() - from).cross(wall.along())).sum::<f64>()
}

fn defects(walls: &[Wall]) -> Vec<SectionError> {
    let none = coincidence(walls);
    if !none.is_finite() {
        return vec![SectionError::Range];
    }
    let mut errors: Vec<SectionError> = (0..walls.len())
        .filter(|&wall| walls[wall].length() <= none)
        .map(|wall| SectionError::ZeroLengthWall { wall, next: (wall + 1) % walls.len() })
        .collect();
    if errors.is_empty() && !is_flat(walls, none) {
        errors = crossings(walls, none);
    }
    let (area, perimeter) = (signed_area(walls).abs(), none / COINCIDENCE);
    let encloses = area > none * perimeter;
    if errors.is_empty() && !encloses {
        errors.push(SectionError::NoEnclosedArea { area });
    }
    errors
}

/// Whether all vertices are on one line.
fn is_flat(walls: &[Wall], none: f64) -> bool {
    let from = walls[0].start();
    let farthest = |a: Point, b: Point| if b.norm() > a.norm() { b } else { a };
    let way = walls.iter().map(|wall| wall.start() - from).fold(Point::ORIGIN, farthest);
    walls.iter().all(|wall| way.cross(wall.start() - from).abs() <= none * way.norm())
}

fn crossings(walls: &[Wall], none: f64) -> Vec<SectionError> {
    let first_met = |wall: usize| {
        let other = (wall + 1..walls.len()).find(|&other| meet(walls, wall, other, none))?;
        Some(SectionError::Crossing { wall, other })
    };
    (0..walls.len()).filter_map(first_met).collect()
}

/// Whether two walls meet at a point other than their common vertex.
fn meet(walls: &[Wall], wall: usize, other: usize, none: f64) -> bool {
    let (a, b) = (&walls[wall], &walls[other]);
    let is_next = other == wall + 1;
    if is_next || (wall == 0 && other == walls.len() - 1) {
        let folded = a.along().dot(b.along()) < 0.0;
        return folded && a.along().cross(b.along()).abs() <= none * a.length().max(b.length());
    }
    let side = |of: &Wall, point: Point| {
        let turn = of.along().cross(point - of.start());
        if turn.abs() <= none * of.length() { 0 } else { turn.signum() as i32 }
    };
    let sides = [side(a, b.start()), side(a, b.at(1.0)), side(b, a.start()), side(b, a.at(1.0))];
    if sides == [0; 4] {
        let along = |point: Point| a.along().dot(point - a.start()) / a.length();
        let (from, to) = (along(b.start()), along(b.at(1.0)));
        return from.max(to) >= -none && from.min(to) <= a.length() + none;
    }
    sides[0] * sides[1] <= 0 && sides[2] * sides[3] <= 0
}
