//! The answer of `nboom section`: the keys of `expect` in `tests/data/section_cases.json`, in its
//! sign convention.

use nboom_scalar::Wrench;
use nboom_sections::{
    Annulus, Polygon, PolygonStresses, Section, Stress, Tube, TubeStresses, report,
};
use serde_json::{Value, json};

/// The meaning of the numbers, for the file.
pub(crate) const CONVENTION: &str = "axes (xi, eta, zeta); P and Q act on the outboard part about \
    the point on the eta axis; compression and the traction on the outboard part are positive, \
    shear flow along the numbering, torsion_shear_flow against it; units are those of the input: lengths L and forces F give areas \
    L^2, moments of area L^4, moments F L, shear flow F/L, stresses F/L^2; I_* count the walls' own thickness, *_centreline do not; angles \
    are from xi towards zeta, in degrees for axis points, in radians for theta; \
    docs/sections.md says what each key is";

/// The answer for a section; stresses where there is a load.
pub(crate) fn of(section: &Section, load: Option<&Wrench<f64>>) -> Value {
    match section {
        Section::Tube(tube) => joined(of_tube(tube), load.map(|load| tube_stresses(tube, load))),
        Section::Polygon(polygon) => {
            joined(of_polygon(polygon), load.map(|load| polygon_stresses(polygon, load)))
        }
    }
}

fn joined(mut properties: Value, stresses: Option<Value>) -> Value {
    if let (Some(all), Some(Value::Object(more))) = (properties.as_object_mut(), stresses) {
        all.extend(more);
    }
    properties
}

fn of_tube(tube: &Tube) -> Value {
    let found = tube.properties();
    let Annulus { area, inertia, torsion_constant } = tube.annulus();
    json!({
        "A": found.area,
        "I": found.inertia.xi_xi,
        "J": found.torsion_constant,
        "S": tube.torsion_modulus(),
        "annulus_A": area,
        "annulus_I": inertia,
        "annulus_J": torsion_constant,
    })
}

fn tube_stresses(tube: &Tube, load: &Wrench<f64>) -> Value {
    let stresses = tube.stresses(load);
    let of_report = |theta: f64| report::tube_stress(&stresses, theta);
    let axis_point = |(number, theta): (usize, f64)| {
        json!({
            "angle": 90 * number,
            "sigma": of_report(theta).in_report_signs(),
            "sigma_true": stresses.at(theta).stress.in_report_signs(),
        })
    };
    let largest = |theta: f64, stress: Stress| {
        json!({
            "theta": theta,
            "vm": stress.von_mises(),
            "sigma": stress.in_report_signs(),
            "principal": principal(stress),
        })
    };
    let (tangential, absolute) =
        (stresses.max_von_mises(), report::max_von_mises_of_tube(&stresses));
    json!({
        "axis_points": Tube::AXIS_ANGLES.into_iter().enumerate().map(axis_point).collect::<Vec<_>>(),
        "max_von_mises_tangential_shear": largest(tangential, at(&stresses, tangential)),
        "max_von_mises_report_abs_shear": largest(absolute, of_report(absolute)),
    })
}

fn at(stresses: &TubeStresses, theta: f64) -> Stress {
    stresses.at(theta).stress
}

fn of_polygon(polygon: &Polygon) -> Value {
    let found = polygon.properties();
    let (own, line) = (found.inertia, found.centreline_inertia);
    let [largest, smallest] = own.principal();
    let [k1, k2, k3] = report::bending_constants(&own);
    json!({
        "A": found.area,
        "C_xi": found.centroid.xi,
        "C_zeta": found.centroid.zeta,
        "I_xixi": own.xi_xi,
        "I_zetazeta": own.zeta_zeta,
        "I_xizeta": own.xi_zeta,
        "I_max": largest,
        "I_min": smallest,
        "I_xixi_centreline": line.xi_xi,
        "I_zetazeta_centreline": line.zeta_zeta,
        "I_xizeta_centreline": line.xi_zeta,
        "enclosed_area": found.enclosed_area,
        "signed_area": polygon.signed_area(),
        "J_bredt": found.torsion_constant,
        "shear_centre_xi": found.shear_centre.xi,
        "shear_centre_zeta": found.shear_centre.zeta,
        "k1": k1,
        "k2": k2,
        "k3": k3,
    })
}

fn polygon_stresses(polygon: &Polygon, load: &Wrench<f64>) -> Value {
    let stresses = polygon.stresses(load);
    let at_vertex = |wall: usize| stresses.wall(wall).at(0.0).in_report_signs()[0];
    let flow = |wall: usize, x: f64| {
        Traction::at(&stresses, wall, x).along_wall * polygon.walls()[wall].thickness()
    };
    let walls = 0..polygon.walls().len();
    let places = polygon.axis_points().into_iter().enumerate();
    let axis_points: Vec<Value> = places
        .filter_map(|(number, place)| Some(axis_point(polygon, &stresses, 90 * number, place?)))
        .collect();
    json!({
        "Q_star": polygon.about_centroid(load).moment.to_array(),
        "sigma22_at_vertices": walls.clone().map(at_vertex).collect::<Vec<_>>(),
        "torsion_shear_flow": stresses.torsion_flow(),
        "shear_flow_start_mid_end":
            walls.map(|wall| [0.0, 0.5, 1.0].map(|x| flow(wall, x))).collect::<Vec<_>>(),
        "max_von_mises": largest(&stresses),
        "axis_points": axis_points,
    })
}

/// Stress at a place of a wall in the report's signs.
struct Traction {
    s22: f64,
    s21: f64,
    s23: f64,
    /// Shear stress along the numbering.
    along_wall: f64,
}

impl Traction {
    fn at(stresses: &PolygonStresses<'_>, wall: usize, x: f64) -> Self {
        let wall = stresses.wall(wall);
        let [s22, s21, s23] = wall.at(x).in_report_signs();
        let along_wall = s21 * wall.direction.xi + s23 * wall.direction.zeta;
        Self { s22, s21, s23, along_wall }
    }
}

fn largest(stresses: &PolygonStresses<'_>) -> Value {
    let (wall, x) = stresses.max_von_mises();
    let (found, traction) = (stresses.at(wall, x), Traction::at(stresses, wall, x));
    json!({
        "vm": found.stress.von_mises(),
        "plate": wall + 1,
        "s": x,
        "xi": found.place.xi,
        "zeta": found.place.zeta,
        "s22": traction.s22,
        "tau": traction.along_wall,
        "s21": traction.s21,
        "s23": traction.s23,
        "principal": principal(found.stress),
    })
}

fn axis_point(
    polygon: &Polygon,
    stresses: &PolygonStresses<'_>,
    angle: usize,
    (wall, x): (usize, f64),
) -> Value {
    let (found, traction) = (stresses.at(wall, x), Traction::at(stresses, wall, x));
    let [q_xi, q_zeta] = report::static_moments(polygon, found.place);
    // In the report q_t is positive against the numbering.
    let torsion = -stresses.torsion_flow() / polygon.walls()[wall].thickness();
    let direction = stresses.wall(wall).direction;
    json!({
        "angle": angle,
        "plate": wall + 1,
        "xi": found.place.xi,
        "zeta": found.place.zeta,
        "sigma22": traction.s22,
        "sigma21_torsion": torsion * direction.xi,
        "sigma23_torsion": torsion * direction.zeta,
        "tau_total_closed_cell": traction.along_wall,
        "Q_xi": q_xi,
        "Q_zeta": q_zeta,
        "principal": principal(found.stress),
    })
}

/// The principal stresses other than zero, in the report's signs: the largest first.
fn principal(stress: Stress) -> [f64; 2] {
    let [normal, shear_xi, shear_zeta] = stress.in_report_signs();
    Stress { normal, shear_xi, shear_zeta }.principal()
}
