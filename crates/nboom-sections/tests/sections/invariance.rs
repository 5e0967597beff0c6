//! The same section told in other words.

use std::f64::consts::TAU;

use nboom_scalar::{Vec3, Wrench};
use nboom_sections::{Point, Polygon};
use proptest::prelude::*;

use super::random::{Description, cases, description, load};

/// What does not depend on axes, origin and numbering.
fn invariants(polygon: &Polygon, load: &Wrench<f64>) -> [f64; 7] {
    let found = polygon.properties();
    let [largest, smallest] = found.inertia.principal();
    let stresses = polygon.stresses(load);
    let (wall, x) = stresses.max_von_mises();
    [
        found.area,
        found.enclosed_area,
        largest,
        smallest,
        found.torsion_constant,
        (found.shear_centre - found.centroid).xi.hypot((found.shear_centre - found.centroid).zeta),
        stresses.at(wall, x).stress.von_mises(),
    ]
}

/// Rounding: lengths are about 1 and the origin at most some ten away, which moves the last digits of
/// coordinates; thin slivers magnify that by their ratio of inertias, up to some hundred.
fn agree(a: [f64; 7], b: [f64; 7]) -> Result<(), TestCaseError> {
    for (a, b) in a.iter().zip(b) {
        prop_assert!((a - b).abs() <= 1e-10 * (a.abs() + 1.0), "{a} and {b}");
    }
    Ok(())
}

fn turn(p: Point, angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    Point { xi: p.xi * cos - p.zeta * sin, zeta: p.xi * sin + p.zeta * cos }
}

fn turned(v: Vec3<f64>, angle: f64) -> Vec3<f64> {
    let Point { xi, zeta } = turn(Point { xi: v.x, zeta: v.z }, angle);
    Vec3::new(xi, v.y, zeta)
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn translation(
        description in description(), load in load(), xi in -9.0..9.0, zeta in -9.0..9.0,
    ) {
        let moved = description.map(|p| p + Point { xi, zeta });
        let same = load.seen_from(Vec3::new(xi, 0.0, zeta));
        agree(invariants(&description.polygon(), &load), invariants(&moved.polygon(), &same))?;
        let places = [&description, &moved].map(|d| d.polygon().properties().shear_centre);
        let way = places[1] - places[0] - Point { xi, zeta };
        prop_assert!(way.xi.hypot(way.zeta) < 1e-10);
    }

    #[test]
    fn rotation(description in description(), load in load(), angle in 0.0..TAU) {
        let moved = description.map(|p| turn(p, angle));
        let (force, moment) = (turned(load.force, angle), turned(load.moment, angle));
        let same = Wrench { force, moment };
        agree(invariants(&description.polygon(), &load), invariants(&moved.polygon(), &same))?;
        let [before, after] =
            [&description, &moved].map(|d| d.polygon().properties().inertia);
        let [largest, smallest] = before.principal();
        // The axis turns along, by half turns left open; it means something where it is distinct.
        if largest - smallest > 1e-3 * largest {
            let off = after.principal_angle() - before.principal_angle() - angle;
            prop_assert!(off.sin().abs() < 1e-9);
        }
    }

    #[test]
    fn renumbering(description in description(), load in load(), shift in 0_usize..9) {
        let mut moved = description.clone();
        let shift = shift % moved.vertices.len();
        moved.vertices.rotate_left(shift);
        moved.thickness.rotate_left(shift);
        agree(invariants(&description.polygon(), &load), invariants(&moved.polygon(), &load))?;
    }

    #[test]
    fn direction(description in description(), load in load()) {
        let mut moved = description.clone();
        moved.vertices.reverse();
        // Wall i joined vertices i and i + 1, which are the last but i and the one before it now.
        moved.thickness.reverse();
        moved.thickness.rotate_left(1);
        let [a, b] = [&description, &moved].map(Description::polygon);
        agree(invariants(&a, &load), invariants(&b, &load))?;
        prop_assert!((a.signed_area() + b.signed_area()).abs() < 1e-12 * a.signed_area().abs());
    }

    /// Lengths in other units: stresses from forces alone go with 1/L².
    #[test]
    fn units(description in description(), load in load(), power in -12..12) {
        let unit = 10.0_f64.powi(power);
        let moved = Description {
            vertices: description.vertices.iter().map(|&p| p * unit).collect(),
            thickness: description.thickness.iter().map(|t| t * unit).collect(),
        };
        let same = Wrench { force: load.force, moment: load.moment * unit };
        let scales = [2, 2, 4, 4, 4, 1, -2].map(|n| unit.powi(n));
        let found = invariants(&moved.polygon(), &same);
        let scaled = std::array::from_fn(|i| found[i] / scales[i]);
        agree(invariants(&description.polygon(), &load), scaled)?;
    }
}
