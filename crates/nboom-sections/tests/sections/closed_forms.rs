//! Sections whose properties and stresses are known in closed form.

use std::f64::consts::TAU;

use nboom_scalar::{Vec3, Wrench};
use nboom_sections::{Point, Polygon, Section, SectionWarning, Tube};

use super::random::wrench_at;

/// A few dozen roundings.
const ROUNDING: f64 = 1e-14;

#[track_caller]
fn near(found: f64, expected: f64) {
    let off = (found - expected).abs();
    assert!(off <= ROUNDING * (1.0 + expected.abs()), "{found} found, {expected} expected");
}

fn regular(count: usize, radius: f64, thickness: f64) -> Polygon {
    let angle = |i: usize| TAU * i as f64 / count as f64;
    let vertex = |i| Point { xi: radius * angle(i).cos(), zeta: radius * angle(i).sin() };
    let vertices: Vec<Point> = (0..count).map(vertex).collect();
    Polygon::new(&vertices, &vec![thickness; count]).expect("a section")
}

fn rectangle(width: f64, height: f64, thickness: [f64; 4]) -> Polygon {
    let (x, z) = (0.5 * width, 0.5 * height);
    let vertices = [(x, z), (-x, z), (-x, -z), (x, -z)].map(|(xi, zeta)| Point { xi, zeta });
    Polygon::new(&vertices, &thickness).expect("a section")
}

#[test]
fn a_square_tube() {
    let (side, t) = (3.0, 0.05);
    let found = *rectangle(side, side, [t; 4]).properties();
    near(found.area, 4.0 * side * t);
    near(found.enclosed_area, side * side);
    near(found.torsion_constant, side.powi(3) * t);
    for inertia in [found.centreline_inertia.xi_xi, found.centreline_inertia.zeta_zeta] {
        near(inertia, 2.0 / 3.0 * side.powi(3) * t);
    }
    // Two walls stand and two lie; those that lie have side · t³ / 12 of their own.
    near(found.inertia.xi_xi, 2.0 / 3.0 * side.powi(3) * t + side * t.powi(3) / 6.0);
    near(found.inertia.xi_zeta, 0.0);
    near(found.shear_centre.xi, 0.0);
    near(found.shear_centre.zeta, 0.0);
}

#[test]
fn an_equilateral_triangle() {
    let (side, t) = (2.0, 0.03);
    let polygon = regular(3, side / 3.0_f64.sqrt(), t);
    let found = polygon.properties();
    near(found.area, 3.0 * side * t);
    near(found.enclosed_area, 3.0_f64.sqrt() / 4.0 * side * side);
    near(found.torsion_constant, side.powi(3) * t / 4.0);
    near(found.centreline_inertia.xi_xi, side.powi(3) * t / 4.0);
    near(found.centreline_inertia.zeta_zeta, side.powi(3) * t / 4.0);
    near(found.centreline_inertia.xi_zeta, 0.0);
    near(found.shear_centre.xi, 0.0);
    near(found.shear_centre.zeta, 0.0);
}

/// Shear force along a symmetry axis: q = V S / (2 I) in each of two equal webs, none where the axis
/// cuts the flanges.
#[test]
fn a_rectangular_tube_under_shear() {
    let (width, height, flange, web) = (4.0, 2.0, 0.03, 0.05);
    let polygon = rectangle(width, height, [flange, web, flange, web]);
    let load = Wrench { force: Vec3::new(0.0, 0.0, 7.0), moment: Vec3::zero() };
    let stresses = polygon.stresses(&load);
    let inertia = polygon.properties().centreline_inertia.xi_xi;
    near(inertia, 0.5 * flange * width * height * height + web * height.powi(3) / 6.0);
    let corner = 7.0 * flange * width * height / 2.0 / (2.0 * inertia);
    let middle = corner + 7.0 * web * height * height / 4.0 / (2.0 * inertia);
    // The outboard part is pushed along +ζ; so stress on the outboard face points along −ζ.
    for wall in [1, 3] {
        near(stresses.wall(wall).at(0.0).shear_zeta, -corner / web);
        near(stresses.wall(wall).at(0.5).shear_zeta, -middle / web);
    }
    near(stresses.wall(0).shear_at(0.5), 0.0);
    near(stresses.wall(2).shear_at(0.5), 0.0);
}

/// A square with half sides of 1, walls of t and one web of 4t: I_ξξ = 22t/3. Cut where its walls
/// meet, an upward unit force has the flows s·t/I in the flanges and (s − s²/2) in the webs; they
/// twist by −5/I, which a circulating flow of 10t/(13 I) undoes. The webs then carry 200/286 and
/// 86/286, the flanges 6/13 · 3/22 each, whose moment is that of the force at ξ = −75/143.
#[test]
fn the_shear_centre_of_a_box_with_one_heavy_web() {
    let t = 0.02;
    let found = *rectangle(2.0, 2.0, [t, 4.0 * t, t, t]).properties();
    near(found.centreline_inertia.xi_xi, 22.0 * t / 3.0);
    near(found.shear_centre.xi, -75.0 / 143.0);
    near(found.shear_centre.zeta, 0.0);
}

/// Bredt: shear stress M / (2 A t), J = 4 A² / ∮ ds/t, in walls of different thickness.
#[test]
fn torsion() {
    let thickness = [0.02, 0.04, 0.03, 0.01];
    let polygon = rectangle(3.0, 2.0, thickness);
    let load = Wrench { force: Vec3::zero(), moment: Vec3::new(0.0, 5.0, 0.0) };
    let stresses = polygon.stresses(&load);
    for (i, t) in thickness.into_iter().enumerate() {
        for x in [0.0, 0.3, 1.0] {
            near(stresses.wall(i).at(x).shear(), 5.0 / (2.0 * 6.0 * t));
            near(stresses.wall(i).at(x).normal, 0.0);
        }
    }
    let flexibility = 3.0 / 0.02 + 2.0 / 0.04 + 3.0 / 0.03 + 2.0 / 0.01;
    near(polygon.properties().torsion_constant, 4.0 * 36.0 / flexibility);
    // The outboard part turns from ζ to ξ; stress on the outboard face points the other way.
    let top = stresses.wall(0).at(0.5);
    assert!(top.shear_xi < 0.0, "{top:?}");
}

#[test]
fn signs_of_normal_stress() {
    let section = Section::Polygon(rectangle(2.0, 2.0, [0.02; 4]));
    let points = |force, moment| {
        let all = section.stresses(&Wrench { force, moment }).axis_points();
        all.map(|point| point.expect("convex").stress.normal)
    };
    // A force that pushes the outboard part away presses.
    assert!(points(Vec3::new(0.0, 1.0, 0.0), Vec3::zero()).iter().all(|&s| s < 0.0));
    // About ξ: ζ × η = −ξ, so pressure at +ζ on the outboard part is a moment along −ξ.
    let [_, top, _, bottom] = points(Vec3::zero(), Vec3::new(1.0, 0.0, 0.0));
    assert!(top > 0.0 && bottom < 0.0);
    // About ζ: ξ × η = ζ, so pressure at +ξ is a moment along +ζ.
    let [right, _, left, _] = points(Vec3::zero(), Vec3::new(0.0, 0.0, 1.0));
    assert!(right < 0.0 && left > 0.0);
}

/// Polygons with more and more walls become tubes, with an error in 1/n².
#[test]
fn many_walls_make_a_tube() {
    let (radius, t) = (1.5, 0.02);
    let tube = Tube::new(radius, t).expect("a tube");
    let load = Wrench { force: Vec3::new(3.0, -2.0, 5.0), moment: Vec3::new(1.0, -4.0, 2.0) };
    let errors = |count| {
        let polygon = regular(count, radius, t);
        let (found, right) = (*polygon.properties(), tube.properties());
        let worst = |section: Section| section.stresses(&load).max_von_mises().stress.von_mises();
        [
            found.area / right.area - 1.0,
            found.enclosed_area / right.enclosed_area - 1.0,
            found.centreline_inertia.xi_xi / right.inertia.xi_xi - 1.0,
            found.torsion_constant / right.torsion_constant - 1.0,
            worst(Section::Polygon(polygon)) / worst(Section::Tube(tube)) - 1.0,
        ]
    };
    let (coarse, fine) = (errors(90), errors(180));
    for (property, (coarse, fine)) in coarse.into_iter().zip(fine).enumerate() {
        assert!(fine.abs() < 6.0 / 180.0_f64.powi(2) * 4.0, "{property}: {fine}");
        // Properties have a series in 1/n²; the place of a maximum on the walls jumps about.
        if property < 4 {
            assert!((coarse / fine - 4.0).abs() < 0.01, "{property}: {coarse} and {fine}");
        }
    }
}

/// Stresses of a force at the centroid of a section far from the η axis are those of an axial force.
#[test]
fn an_axial_force_through_the_centroid_presses_evenly() {
    let polygon = rectangle(2.0, 1.0, [0.02, 0.05, 0.03, 0.01]);
    let load = wrench_at(polygon.properties().centroid, Vec3::new(0.0, 6.0, 0.0));
    for wall in 0..4 {
        let stress = polygon.stresses(&load).wall(wall).at(0.7);
        near(stress.normal, -6.0 / polygon.properties().area);
        near(stress.shear(), 0.0);
    }
}

#[test]
fn thick_walls_are_warned_of() {
    let polygon = Section::Polygon(rectangle(2.0, 0.4, [0.04, 0.05, 0.04, 0.05]));
    let told: Vec<String> = polygon.warnings().iter().map(SectionWarning::to_string).collect();
    // The cell has a mean radius of 1.6/4.8.
    let expected = "wall 2: thickness 0.150 of the mean radius of the cell found, at most 0.1 for thin-wall theory \
                    expected";
    assert_eq!(told, [expected]);
    let tube = |t| Section::Tube(Tube::new(1.0, t).expect("a tube")).warnings();
    assert_eq!(tube(0.1), []);
    assert_eq!(tube(0.2), [SectionWarning::ThickTube { ratio: 0.2 }]);
}

#[test]
fn walls_are_thin_or_thick_however_many_they_are() {
    let told = |corners: &[(f64, f64)], thickness: f64| {
        let corners: Vec<Point> = corners.iter().map(|&(xi, zeta)| Point { xi, zeta }).collect();
        let polygon = Polygon::new(&corners, &vec![thickness; corners.len()]).expect("one cell");
        polygon.warnings().len()
    };
    for count in [12, 60, 1000] {
        let corner = |i: usize| (TAU * i as f64 / count as f64).sin_cos();
        let circle: Vec<(f64, f64)> = (0..count).map(corner).collect();
        // As of the tube that it is like.
        assert_eq!([0.02, 0.09, 0.2].map(|t| told(&circle, t)), [0, 0, 1], "{count}");
    }
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    let in_pieces = [(0.0, 0.0), (0.001, 0.0), (0.5, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    assert_eq!([told(&square, 0.04), told(&in_pieces, 0.04)], [0, 0]);
    // Longer than thick, and nothing between them.
    assert_eq!(told(&[(0.0, 0.0), (1.0, 0.0), (0.5, 0.005)], 0.01), 1);
    assert_eq!(told(&[(-50.0, 0.0), (0.0, -0.5), (50.0, 0.0), (0.0, 0.5)], 2.0), 1);
}

#[test]
fn axis_points_of_an_l() {
    let corners = [(3.0, -1.0), (3.0, 0.0), (0.0, 0.0), (0.0, 3.0), (-1.0, 3.0), (-1.0, -1.0)];
    let corners = corners.map(|(xi, zeta)| Point { xi, zeta });
    let polygon = Polygon::new(&corners, &[0.05; 6]).expect("a section");
    // The centroid is outside, in the corner of the L: nothing is to the right of it or above.
    let places = polygon.axis_points().map(|place| place.map(|(wall, _)| wall));
    assert_eq!(places, [None, None, Some(4), Some(5)]);
}
