//! Quantities that only the report has: intermediate ones of its bending formula, static moments,
//! its shear stress in tubes, and their errors in its program of 1970.

mod original;

use crate::harmonics::{Harmonics, largest_by_quadrant};
use crate::{Point, Polygon, SecondMoments, Stress, TubeStresses, outline};

pub use original::{Original, SectionSlips};

/// k₁ = I_ξζ / I_ζζ, k₂ = I_ξζ / I_ξξ and k₃ = 1 − k₁k₂ of eq. (11.8), corrected: note 22.
pub fn bending_constants(inertia: &SecondMoments) -> [f64; 3] {
    let (k1, k2) = (inertia.xi_zeta / inertia.zeta_zeta, inertia.xi_zeta / inertia.xi_xi);
    [k1, k2, 1.0 - k1 * k2]
}

/// Q_ξ and Q_ζ of eqs. (12.7) and (12.8): the moment about the centroid of the area beyond the level
/// of ξ, and of ζ, at `place`. A wall on the level is not beyond it.
pub fn static_moments(polygon: &Polygon, place: Point) -> [f64; 2] {
    let none = outline::coincidence(polygon.walls());
    let centroid = polygon.properties().centroid;
    let beyond = |coordinate: fn(Point) -> f64| {
        let moment = polygon.walls().iter().map(|wall| {
            let way = coordinate(wall.along());
            let start = coordinate(wall.start()) - coordinate(place);
            let end = start + way;
            let (least, most) = (start.min(end), start.max(end));
            if most <= none {
                return 0.0;
            }
            // The part of the wall beyond, and its middle above the level.
            let part = if least < 0.0 { most / (most - least) } else { 1.0 };
            let middle = 0.5 * (least.max(0.0) + most);
            let arm = middle + coordinate(place) - coordinate(centroid);
            wall.length() * wall.thickness() * part * arm
        });
        moment.sum::<f64>().abs()
    };
    [beyond(|p| p.xi), beyond(|p| p.zeta)]
}

/// The stress at θ of a tube by eqs. (11.1) to (11.4), with the shear stress of the forces in
/// absolute values as printed; it is right at the four axis points only, note 21.
pub fn tube_stress(stresses: &TubeStresses, theta: f64) -> Stress {
    let [normal, _, _] = stresses.at(theta).stress.in_report_signs();
    let (sin, cos) = theta.sin_cos();
    let [torsion, zeta, xi] = in_report_signs(stresses);
    let along_xi = xi * sin.abs() + torsion * sin;
    Stress::of_report_signs([normal, along_xi, zeta * cos.abs() - torsion * cos])
}

/// The θ, from 0 to 2π, at which the von Mises stress of [`tube_stress`] is largest.
pub fn max_von_mises_of_tube(stresses: &TubeStresses) -> f64 {
    let normal = stresses.normal;
    let [torsion, zeta, xi] = in_report_signs(stresses);
    let of_shear = [xi.abs() + torsion.abs(), zeta.abs() + torsion.abs()];
    let unit = normal.iter().chain(&of_shear).fold(0.0, |most: f64, c| most.max(c.abs()));
    let squares = |quadrant: usize| {
        let sign_of_sin = if quadrant < 2 { 1.0 } else { -1.0 };
        let sign_of_cos = if matches!(quadrant, 0 | 3) { 1.0 } else { -1.0 };
        let along_xi = [0.0, 0.0, (sign_of_sin * xi + torsion) / unit];
        let along_zeta = [0.0, (sign_of_cos * zeta - torsion) / unit, 0.0];
        Harmonics::of_square(normal.map(|c| c / unit))
            + Harmonics::of_square(along_xi) * 3.0
            + Harmonics::of_square(along_zeta) * 3.0
    };
    largest_by_quadrant(|theta| tube_stress(stresses, theta).von_mises(), squares)
}

/// Q₂/S, 2P₃/A and 2P₁/A.
fn in_report_signs(stresses: &TubeStresses) -> [f64; 3] {
    let [torsion, zeta, xi] = stresses.shear;
    [torsion, -zeta, xi]
}
