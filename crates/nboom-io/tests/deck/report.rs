//! The deck of Section 17 against the printed echo of the input in Section 18.
//!
//! The echo prints what a 32-bit machine made of the deck, for instance 0.3599998 for .4 (a
//! misprint of 0.3999998); expected values are the deck's, and agree with the echo within its
//! digits.

use nboom_model::{HingeState, Material, Release, SectionShape, Vertex};
use nboom_scalar::{Sym3, Vec3};

use super::{REPORT_DECK, lines, read};

fn degrees(value: f64) -> f64 {
    value.to_radians()
}

#[test]
fn values_given_twice_and_slices_that_are_not_the_segment_are_worth_a_warning() {
    let file = read(REPORT_DECK);
    let is_about_slices = |line: &String| line.contains("found slices");
    let (slices, twice): (Vec<_>, Vec<_>) =
        lines(&file.warnings).into_iter().partition(is_about_slices);
    assert_eq!(
        twice,
        [
            "a.nml:53:12: DELM(1,2): found 0.001 after 0 in line 51, expected one value; the \
             later one holds",
            "a.nml:53:27: DELM(1,3): found 0.001 after 0 in line 51, expected one value; the \
             later one holds",
        ]
    );
    // The deck puts 0.001 at the tips of two segments for the sake of a division, gives the
    // paddle 0.2 of its 0.5, and adds inertias of segment 1,2 as if its halves were 6.4 apart.
    let symbols: Vec<_> = slices.iter().filter_map(|line| line.split(": ").nth(1)).collect();
    let expected = [
        "DELC2(1,1)",
        "DELC3(1,1)",
        "DELM(1,4)",
        "DELM(1,2)",
        "DELM(1,3)",
        "DLI21(1,1)",
        "DLI31(1,1)",
    ];
    assert_eq!(symbols, expected);
    let of_paddle = "found slices of mass 0.2 in all, expected 0.5 of the segment (0.3 away)";
    assert!(slices[2].ends_with(of_paddle), "{}", slices[2]);
    let moments = file.structure.expect("the deck asks for stresses").segments()[1]
        .mass_properties()
        .expect("the segment has stations")
        .inertia;
    // Two masses of 0.2 at 5 from the middle and a thousandth at 10.
    let centre = (0.2 * 15.0 + 0.2 * 5.0 + 0.001 * 20.0) / 0.401;
    let square = |y: f64| (y - centre).powi(2);
    let apart = 0.2 * (square(15.0) + square(5.0)) + 0.001 * square(20.0);
    for (found, own) in [(moments.xx, 20.0), (moments.yy, 40.0), (moments.zz, 60.0)] {
        let expected = own + if own == 40.0 { 0.0 } else { apart };
        assert!((found - expected).abs() < 1e-13 * expected, "{found}, {expected}");
    }
}

#[test]
fn the_bodies_of_pages_18_9_and_18_10() {
    let scene = read(REPORT_DECK).scene;
    assert_eq!(scene.main_body.mass, 25.0);
    assert_eq!(scene.main_body.center_of_mass, Vec3::zero());
    assert_eq!(scene.main_body.inertia, Sym3::diagonal(4000.0, 2000.0, 2000.0));
    let properties = scene.bodies.iter().map(|body| body.mass_properties);
    let (masses, rest): (Vec<_>, Vec<_>) =
        properties.map(|p| (p.mass, (p.center_of_mass.to_array(), p.inertia))).unzip();
    assert_eq!(masses, [0.5, 0.4, 0.5, 0.5]);
    assert_eq!(
        rest,
        [
            ([0.0, 10.0, 0.0], Sym3::diagonal(10.0, 5.0, 10.0)),
            ([0.0, 10.0, 0.0], Sym3::diagonal(45.0, 40.0, 85.0)),
            ([0.0, 10.0, 0.0], Sym3::diagonal(10.0, 5.0, 10.0)),
            ([0.0, 20.0, 0.0], Sym3::diagonal(20.0, 10.0, 20.0)),
        ]
    );
}

#[test]
fn the_tree_of_section_17() {
    let scene = read(REPORT_DECK).scene;
    let [a, b, c, d] = scene.bodies[..] else { panic!("four bodies expected") };
    assert_eq!([a.inboard, b.inboard, c.inboard, d.inboard], [None, Some(0), None, Some(2)]);
    assert_eq!(a.mount.point, Vec3::new(10.0, 0.0, 20.0));
    assert_eq!(b.mount.point, Vec3::new(0.0, 20.0, 0.0));
    assert_eq!(c.mount.point, Vec3::new(-10.0, 20.0, 0.0));
    assert_eq!(d.mount.point, Vec3::new(0.0, 20.0, 0.0));
    assert_eq!([a.axis, b.axis, c.axis], [Vec3::unit_x(); 3]);
    assert_eq!(d.axis, Vec3::unit_y());
    // (17.2): R_x(90) R_y(90) sends e1 to y, e2 to z, e3 to x; R_y(90) sends e1 to -z, e3 to x.
    let columns =
        |body: nboom_model::Body| [0, 1, 2].map(|j| body.mount.rot_inboard_from_hinge.column(j));
    assert_eq!(columns(a), [Vec3::unit_y(), Vec3::unit_z(), Vec3::unit_x()]);
    assert_eq!(columns(c), [-Vec3::unit_z(), Vec3::unit_y(), Vec3::unit_x()]);
}

#[test]
fn the_hinges_of_pages_18_10_to_18_12() {
    let scene = read(REPORT_DECK).scene;
    let hinges: Vec<_> = scene.bodies.iter().map(|body| body.hinge).collect();
    let of = |f: &dyn Fn(&nboom_model::Hinge) -> f64| hinges.iter().map(f).collect::<Vec<_>>();
    assert_eq!(of(&|h| h.dashpot.rate_linear), [-0.001; 4]);
    assert_eq!(of(&|h| h.dashpot.rate_quadratic), [0.0; 4]);
    assert_eq!(of(&|h| h.dashpot.preload_angle), [0.0; 4]);
    assert_eq!(of(&|h| h.spring.quadratic), [0.0; 4]);
    assert_eq!(of(&|h| h.spring.linear), [-0.4, -0.1, -0.4, -0.4]);
    let preload = [-20.0, -320.0, -20.0, -150.0].map(degrees);
    assert_eq!(of(&|h| h.spring.preload_angle), preload);
    // The relative angle of segment 2 is 270 - 90; a paddle's second body keeps its own.
    assert_eq!(of(&|h| h.start.angle), [90.0, 180.0, 90.0, 90.0].map(degrees));
    assert_eq!(of(&|h| h.start.rate), [0.0; 4]);
    assert!(hinges.iter().all(|h| h.start.state == HingeState::Unreleased));
    assert_eq!(of(&|h| h.lock_angle.unwrap()), [0.0, 360.0, 0.0, 180.0].map(degrees));
    let by = |hinge, angle: f64| Release::Angle { hinge, angle: angle.to_radians() };
    let releases: Vec<_> = hinges.iter().map(|h| h.release).collect();
    assert_eq!(releases, [Release::Time(0.007), by(0, 89.5), by(0, 89.51), by(1, 181.0)]);
}

#[test]
fn the_kick_off_springs_of_pages_18_10_and_18_11() {
    let scene = read(REPORT_DECK).scene;
    let springs: Vec<_> = scene
        .bodies
        .iter()
        .map(|body| body.hinge.kick_off.expect("every segment has a spring"))
        .map(|k| {
            (k.main_body_point.to_array(), k.body_point.to_array(), k.coefficients, k.limit_length)
        })
        .collect();
    assert_eq!(
        springs,
        [
            ([20.0, 0.0, 10.0], [0.0, 10.0, 2.0], [10.0, -0.2, 0.0, 0.0], 9.0),
            ([10.0, 0.0, 10.0], [0.0, 20.0, 0.0], [4.0, -0.5, 0.05, 0.0], 11.0),
            ([10.0, 18.0, 0.0], [0.0, 20.0, 0.0], [1.0, -0.02, 0.0, 0.0], 50.0),
            ([10.0, 18.0, -5.0], [0.0, 0.0, 5.0], [20.0, -0.6, 0.0, 0.0], 3.0),
        ]
    );
}

#[test]
fn the_motion_and_the_settings() {
    let file = read(REPORT_DECK);
    let initial = file.scene.initial;
    assert_eq!(initial.omega_body, Vec3::new(degrees(572.9577), 0.0, 0.0));
    assert_eq!(initial.attitude, nboom_scalar::Quaternion::identity());
    assert_eq!(initial.position_inertial, Vec3::zero());
    assert_eq!(initial.velocity_inertial, Vec3::zero());
    assert_eq!((initial.time, file.scene.end_time), (0.0, 1.0));
    assert!(file.scene.gravity.is_none() && file.scene.externals.is_empty());
    assert_eq!(
        file.legacy,
        nboom_io::LegacySettings {
            first_step: Some(0.001),
            upper_error: Some(0.5e-3),
            lower_error: Some(1e-5),
            min_step: Some(0.001),
            max_step: Some(1e5),
            max_steps: Some(150),
            print_interval: Some(2),
            stress_interval: 3,
            plots: Some(true),
        }
    );
}

#[test]
fn the_stations_of_section_17() {
    let stress = read(REPORT_DECK).structure.expect("the deck asks for stresses");
    let counts: Vec<_> = stress.segments().iter().map(|s| s.stations.len()).collect();
    assert_eq!(counts, [1, 3, 2, 1]);
    for segment in stress.segments() {
        assert_eq!(segment.pulse_constant, 0.1);
        assert_eq!(segment.material, Material::elastic(30.0e6, 0.3));
    }
    let distances = |i: usize| -> Vec<f64> {
        stress.segments()[i].stations.iter().map(|s| s.distance_from_hinge).collect()
    };
    assert_eq!(distances(1), [20.0, 10.0, 0.0]);
    assert_eq!(distances(2), [20.0, 0.0]);
    let slices: Vec<_> = stress.segments()[1]
        .stations
        .iter()
        .map(|s| (s.slice.mass, s.slice.center_of_mass.y, s.slice.inertia))
        .collect();
    let middle = Sym3::diagonal(10.0, 20.0, 30.0);
    assert_eq!(slices, [(0.001, 20.0, Sym3::zero()), (0.2, 15.0, middle), (0.2, 5.0, middle)]);
}

#[test]
fn the_sections_of_section_17() {
    let stress = read(REPORT_DECK).structure.expect("the deck asks for stresses");
    let section = |i: usize, j: usize| stress.segments()[i].stations[j].section.clone();
    let polygon = |xi: &[f64], zeta: &[f64], walls: &[f64]| {
        let corners = xi.iter().zip(zeta).zip(walls);
        let vertex = |((&xi, &zeta), &thickness)| Vertex { xi, zeta, thickness };
        SectionShape::Polygon(corners.map(vertex).collect())
    };
    let tube = SectionShape::Tube { radius: 2.0, thickness: 0.05 };
    assert_eq!([section(0, 0), section(2, 0), section(2, 1)], [tube.clone(), tube.clone(), tube]);
    let pentagon =
        polygon(&[2.15, 0.67, -1.74, -1.74, 0.67], &[0.0, 2.04, 1.26, -1.26, -2.04], &[0.15; 5]);
    assert_eq!([section(1, 0), section(1, 2)], [pentagon.clone(), pentagon]);
    let triangle = polygon(&[4.33, -4.33, -4.33], &[0.0, 5.0, -5.0], &[0.05; 3]);
    assert_eq!(section(1, 1), triangle);
    let rectangle =
        polygon(&[20.0, -20.0, -20.0, 20.0], &[1.0, 1.0, -1.0, -1.0], &[0.05, 0.1, 0.05, 0.1]);
    assert_eq!(section(3, 0), rectangle);
}
