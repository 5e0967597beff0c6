//! Stresses added up over the section give the load back.

use std::f64::consts::TAU;

use nboom_scalar::{Vec3, Wrench};
use nboom_sections::{Point, Polygon, Tube};
use proptest::prelude::*;

use super::random::{cases, description, load, wrench_at};

/// Points and weights on 0..1, exact for polynomials of degree five: the flow times an arm has
/// degree three.
const GAUSS_3: [(f64, f64); 3] = [
    (0.112_701_665_379_258_31, 5.0 / 18.0),
    (0.5, 8.0 / 18.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// Gauss points for degree three, across the thickness.
const GAUSS_2: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// The load on the outboard part that shear stress stands for, on the middle line, and that of
/// normal stress, over the thickness.
fn resultants(polygon: &Polygon, load: &Wrench<f64>) -> (Wrench<f64>, Wrench<f64>) {
    let stresses = polygon.stresses(load);
    let (mut of_shear, mut of_normal) = (Wrench::zero(), Wrench::zero());
    for (i, wall) in polygon.walls().iter().enumerate() {
        let area = wall.length() * wall.thickness();
        let across = Point { xi: -wall.along().zeta, zeta: wall.along().xi };
        let across = across * (wall.thickness() / wall.length());
        for (x, weight) in GAUSS_3 {
            let (place, stress) = (wall.at(x), stresses.wall(i).at(x));
            let force = Vec3::new(stress.shear_xi, 0.0, stress.shear_zeta) * (-area * weight);
            of_shear.add(wrench_at(place, force));
            for y in GAUSS_2 {
                let beside = place + across * (y - 0.5);
                let normal = stresses.normal_at(beside);
                let force = Vec3::new(0.0, -normal * area * weight * 0.5, 0.0);
                of_normal.add(wrench_at(beside, force));
            }
        }
    }
    (of_shear, of_normal)
}

fn off(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    (a - b).norm()
}

proptest! {
    #![proptest_config(cases())]

    /// Rounding of a few dozen terms, each at most some ten times the load: polygons are up to five
    /// times longer than wide, and up to eight lengths from the η axis.
    #[test]
    fn of_polygons(description in description(), load in load()) {
        let polygon = description.polygon();
        let (of_shear, of_normal) = resultants(&polygon, &load);
        let (force, moment) = (load.force, load.moment);
        let scale = force.norm() + moment.norm();
        let shear_force = Vec3::new(force.x, 0.0, force.z);
        let axial_force = Vec3::new(0.0, force.y, 0.0);
        prop_assert!(off(of_shear.force, shear_force) < 1e-12 * scale, "{of_shear:?}");
        prop_assert!((of_shear.moment.y - moment.y).abs() < 1e-12 * scale, "{of_shear:?}");
        prop_assert!(off(of_normal.force, axial_force) < 1e-12 * scale, "{of_normal:?}");
        let bending = Vec3::new(moment.x, 0.0, moment.z);
        let found = Vec3::new(of_normal.moment.x, 0.0, of_normal.moment.z);
        prop_assert!(off(found, bending) < 1e-12 * scale, "{of_normal:?}");
    }

    /// Flow enters a vertex as it leaves it, and normal stress is one at a vertex.
    #[test]
    fn of_vertices(description in description(), load in load()) {
        let polygon = description.polygon();
        let (stresses, count) = (polygon.stresses(&load), polygon.walls().len());
        for i in 0..count {
            let next = (i + 1) % count;
            let flow = |wall: usize, x| stresses.wall(wall).shear_at(x) * polygon.walls()[wall].thickness();
            let normal = |wall: usize, x| stresses.wall(wall).at(x).normal;
            let (flow, scale) = (flow(i, 1.0) - flow(next, 0.0), flow(i, 1.0).abs());
            prop_assert!(flow.abs() < 1e-10 * (scale + load.force.norm()), "{i}");
            let (a, b) = (normal(i, 1.0), normal(next, 0.0));
            prop_assert!((a - b).abs() < 1e-10 * (a.abs() + b.abs() + 1.0), "{i}");
        }
    }

    /// Force through the shear centre: the twist ∮ q/t ds vanishes. Scale: the sum of its terms.
    #[test]
    fn nothing_twists_under_a_force_through_the_shear_centre(
        description in description(), angle in 0.0..TAU,
    ) {
        let polygon = description.polygon();
        let force = Vec3::new(angle.cos(), 0.0, angle.sin());
        let load = wrench_at(polygon.properties().shear_centre, force);
        let stresses = polygon.stresses(&load);
        let (mut twist, mut sum) = (0.0, 0.0);
        for (i, wall) in polygon.walls().iter().enumerate() {
            for (x, weight) in GAUSS_3 {
                let term = stresses.wall(i).shear_at(x) * wall.length() * weight;
                twist += term;
                sum += term.abs();
            }
        }
        prop_assert!(twist.abs() < 1e-10 * sum, "{twist} of {sum}");
    }

    /// Equal steps around the circle integrate trigonometric polynomials of degree three exactly.
    #[test]
    fn of_tubes(radius in 0.1..5.0, ratio in 0.001..1.0, load in load()) {
        let tube = Tube::new(radius, ratio * radius).expect("a tube");
        let stresses = tube.stresses(&load);
        let mut sum = Wrench::zero();
        for step in 0..8 {
            let found = stresses.at(TAU * f64::from(step) / 8.0);
            let stress = found.stress;
            let traction = Vec3::new(stress.shear_xi, stress.normal, stress.shear_zeta);
            sum.add(wrench_at(found.place, traction * (-tube.properties().area / 8.0)));
        }
        let scale = load.force.norm() * (1.0 + radius) + load.moment.norm() * (1.0 + 1.0 / radius);
        prop_assert!(off(sum.force, load.force) < 1e-12 * scale, "{sum:?}");
        prop_assert!(off(sum.moment, load.moment) < 1e-12 * scale, "{sum:?}");
    }
}
