//! `tests/data/section_cases.json`: properties and stresses computed independently, in part checked
//! there with finite elements.

use std::fs;
use std::path::Path;

use nboom_scalar::{Vec3, Wrench};
use nboom_sections::{Point, Polygon, Section, Stress, Tube, report};
use serde_json::Value;

/// Given in the data as the accuracy of its properties.
const PROPERTY: f64 = 1e-9;

/// The data's maxima are from a dense search, good to 2e-8 by its own account where they are inside
/// of a wall, which is within 1e-8 in the cases that it lists.
const MAXIMUM: f64 = 1e-8;

/// A wall lies on the level here, but for rounding of its vertices, by which the data cut it in two.
const CUT_BY_ROUNDING: [&str; 2] = ["\"C26\" at 270: Q_zeta", "\"C28\" at 180: Q_xi"];

fn cases(kind: &str) -> Vec<Value> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/section_cases.json");
    let text = fs::read_to_string(path).expect("the data are in the clone");
    let data: Value = serde_json::from_str(&text).expect("JSON");
    let all = data["cases"].as_array().expect("a list").iter();
    let found: Vec<Value> = all.filter(|case| case["kind"] == kind).cloned().collect();
    assert!(found.len() > 5, "{kind}");
    found
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

fn load(case: &Value) -> Wrench<f64> {
    let vector = |value: &Value| {
        let numbers = numbers(value);
        Vec3::new(numbers[0], numbers[1], numbers[2])
    };
    Wrench { force: vector(&case["P"]), moment: vector(&case["Q"]) }
}

fn polygon(case: &Value) -> Polygon {
    let vertices = case["vertices"].as_array().expect("a list").iter();
    let vertices: Vec<Point> =
        vertices.map(numbers).map(|pair| Point { xi: pair[0], zeta: pair[1] }).collect();
    Polygon::new(&vertices, &numbers(&case["thickness"])).expect("a section")
}

#[track_caller]
fn near(told: &str, found: f64, expected: &Value, scale: f64, tolerance: f64) {
    let off = (found - number(expected)).abs();
    assert!(off <= tolerance * scale, "{told}: {found} found, {expected} expected");
}

#[test]
fn properties_of_polygons() {
    for case in cases("polygon") {
        let (polygon, expect, id) = (polygon(&case), &case["expect"], &case["id"]);
        let found = polygon.properties();
        let size = polygon.walls().iter().map(|wall| wall.length()).fold(0.0, f64::max);
        let [largest, smallest] = found.inertia.principal();
        let (own, line) = (found.inertia, found.centreline_inertia);
        let [k1, k2, k3] = report::bending_constants(&own);
        for (key, value, scale) in [
            ("A", found.area, found.area),
            ("C_xi", found.centroid.xi, size),
            ("C_zeta", found.centroid.zeta, size),
            ("I_xixi", own.xi_xi, largest),
            ("I_zetazeta", own.zeta_zeta, largest),
            ("I_xizeta", own.xi_zeta, largest),
            ("I_max", largest, largest),
            ("I_min", smallest, largest),
            ("I_xixi_centreline", line.xi_xi, largest),
            ("I_zetazeta_centreline", line.zeta_zeta, largest),
            ("I_xizeta_centreline", line.xi_zeta, largest),
            ("enclosed_area", found.enclosed_area, found.enclosed_area),
            ("signed_area", polygon.signed_area(), found.enclosed_area),
            ("J_bredt", found.torsion_constant, found.torsion_constant),
            ("shear_centre_xi", found.shear_centre.xi, size),
            ("shear_centre_zeta", found.shear_centre.zeta, size),
            ("k1", k1, 1.0),
            ("k2", k2, 1.0),
            ("k3", k3, 1.0),
        ] {
            near(&format!("{id} {key}"), value, &expect[key], scale, PROPERTY);
        }
    }
}

#[test]
fn stresses_of_polygons() {
    for case in cases("polygon") {
        let (polygon, load, expect) = (polygon(&case), load(&case), &case["expect"]);
        let told = |what: &str| format!("{} {what}", case["id"]);
        let stresses = polygon.stresses(&load);
        let section = Section::Polygon(polygon.clone());
        let worst = section.stresses(&load).max_von_mises().stress.von_mises();
        near(&told("maximum"), worst, &expect["max_von_mises"]["vm"], worst, MAXIMUM);
        let moment = polygon.about_centroid(&load).moment;
        let scale = moment.norm().max(load.force.norm());
        for (value, right) in moment.to_array().iter().zip(expect["Q_star"].as_array().unwrap()) {
            near(&told("Q*"), *value, right, scale, PROPERTY);
        }
        let (torsion, flow) = (stresses.torsion_flow(), &expect["torsion_shear_flow"]);
        near(&told("torsion"), torsion, flow, torsion.abs(), PROPERTY);
        for (i, wall) in polygon.walls().iter().enumerate() {
            let stress = stresses.wall(i);
            let [normal, _, _] = stress.at(0.0).in_report_signs();
            near(&told("vertex"), normal, &expect["sigma22_at_vertices"][i], worst, PROPERTY);
            for (place, x) in [0.0, 0.5, 1.0].into_iter().enumerate() {
                let flow = -stress.shear_at(x) * wall.thickness();
                let right = &expect["shear_flow_start_mid_end"][i][place];
                near(&told("flow"), flow, right, worst * wall.thickness(), PROPERTY);
            }
        }
    }
}

#[test]
fn axis_points_of_polygons() {
    let mut compared = 0;
    for case in cases("polygon").iter().filter(|case| case["expect"]["axis_points"].is_array()) {
        let (polygon, load) = (polygon(case), load(case));
        let size = polygon.properties().enclosed_area.sqrt();
        let worst =
            Section::Polygon(polygon.clone()).stresses(&load).max_von_mises().stress.von_mises();
        let stresses = polygon.stresses(&load);
        let places = polygon.axis_points().into_iter().flatten();
        for ((wall, x), expect) in places.zip(case["expect"]["axis_points"].as_array().unwrap()) {
            let told = |what: &str| format!("{} at {}: {what}", case["id"], expect["angle"]);
            let found = stresses.at(wall, x);
            assert_eq!(wall + 1, number(&expect["plate"]) as usize, "{}", told("wall"));
            near(&told("xi"), found.place.xi, &expect["xi"], size, PROPERTY);
            near(&told("zeta"), found.place.zeta, &expect["zeta"], size, PROPERTY);
            let [normal, _, _] = found.stress.in_report_signs();
            near(&told("normal"), normal, &expect["sigma22"], worst, PROPERTY);
            let shear = -stresses.wall(wall).shear_at(x);
            near(&told("shear"), shear, &expect["tau_total_closed_cell"], worst, PROPERTY);
            let [q_xi, q_zeta] = report::static_moments(&polygon, found.place);
            let scale = polygon.properties().area * size;
            for (key, value) in [("Q_xi", q_xi), ("Q_zeta", q_zeta)] {
                if !CUT_BY_ROUNDING.iter().any(|cut| told(key).ends_with(cut)) {
                    near(&told(key), value, &expect[key], scale, PROPERTY);
                }
            }
            compared += 1;
        }
    }
    assert_eq!(compared, 4 * 19);
}

#[test]
fn tubes() {
    for case in cases("circular") {
        let tube = Tube::new(number(&case["R"]), number(&case["t"])).expect("a tube");
        let (load, expect) = (load(&case), &case["expect"]);
        let told = |what: &str| format!("{} {what}", case["id"]);
        let (found, annulus) = (tube.properties(), tube.annulus());
        for (key, value) in [
            ("A", found.area),
            ("I", found.inertia.xi_xi),
            ("I", found.inertia.zeta_zeta),
            ("J", found.torsion_constant),
            ("S", tube.torsion_modulus()),
            ("annulus_A", annulus.area),
            ("annulus_I", annulus.inertia),
            ("annulus_J", annulus.torsion_constant),
        ] {
            near(&told(key), value, &expect[key], value, PROPERTY);
        }
        let stresses = tube.stresses(&load);
        let worst = stresses.at(stresses.max_von_mises()).stress.von_mises();
        let right = &expect["max_von_mises_tangential_shear"]["vm"];
        near(&told("maximum"), worst, right, worst, MAXIMUM);
        let angle = report::max_von_mises_of_tube(&stresses);
        let of_report = report::tube_stress(&stresses, angle).von_mises();
        let right = &expect["max_von_mises_report_abs_shear"]["vm"];
        near(&told("maximum of the report"), of_report, right, of_report, MAXIMUM);
        for (angle, expect) in
            Tube::AXIS_ANGLES.into_iter().zip(expect["axis_points"].as_array().unwrap())
        {
            let compare = |stress: Stress, right: &Value| {
                for (value, right) in stress.in_report_signs().iter().zip(numbers(right)) {
                    near(&told("axis point"), *value, &right.into(), worst, PROPERTY);
                }
            };
            compare(stresses.at(angle).stress, &expect["sigma_true"]);
            compare(report::tube_stress(&stresses, angle), &expect["sigma"]);
        }
    }
}
