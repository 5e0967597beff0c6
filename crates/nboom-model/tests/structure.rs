//! Sections and slices of segments: what adds up, and what is refused where.

use nboom_model::{
    Appendage, Hinge, MassProperties, Material, Mount, Rotor, RotorSpeed, Scene, SceneDescription,
    SectionShape, Segment, SegmentStructure, Station, Structure, StructureError, Vertex,
};
use nboom_scalar::{Sym3, Vec3};

/// A uniform rod of mass 3 from the hinge to 2 along η.
fn rod() -> MassProperties {
    MassProperties::new(3.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.0, 1.0))
}

/// Two rods, one after the other.
fn scene() -> Scene {
    let hub = MassProperties::new(100.0, Vec3::zero(), Sym3::diagonal(40.0, 30.0, 20.0));
    let segment = || Segment { length: 2.0, mass_properties: rod(), hinge: Hinge::free() };
    let mut description = SceneDescription::at_rest("two rods", hub, 1.0);
    let segments = vec![segment(), segment()];
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    Scene::new(description).expect("rods are bodies")
}

/// The rod cut at these distances.
fn cut_at(distances: &[f64]) -> SegmentStructure {
    let mut outer = 2.0;
    let station = |&distance: &f64| {
        let (mass, middle, length) =
            (1.5 * (outer - distance), 0.5 * (outer + distance), outer - distance);
        outer = distance;
        let across = mass * length * length / 12.0;
        Station {
            distance_from_hinge: distance,
            slice: MassProperties::new(
                mass,
                Vec3::unit_y() * middle,
                Sym3::diagonal(across, 0.0, across),
            ),
            section: SectionShape::Tube { radius: 0.1, thickness: 0.01 },
        }
    };
    SegmentStructure {
        pulse_constant: 0.1,
        material: Material::elastic(7e10, 0.3),
        stations: distances.iter().map(station).collect(),
    }
}

fn messages(second: SegmentStructure) -> Vec<String> {
    match Structure::new(&scene(), vec![cut_at(&[0.0]), second]) {
        Ok(_) => Vec::new(),
        Err(errors) => errors.iter().map(StructureError::to_string).collect(),
    }
}

#[test]
fn slices_of_a_rod_make_the_rod() {
    for distances in [&[0.0][..], &[1.0, 0.0], &[2.0, 1.7, 0.3, 0.3, 0.0]] {
        let segment = cut_at(distances);
        let sum = segment.mass_properties().expect("there are stations");
        // A few roundings of numbers up to 3.
        assert!((sum.mass - 3.0).abs() < 1e-15 * 16.0);
        assert!((sum.center_of_mass - Vec3::unit_y()).norm() < 1e-14);
        assert!((sum.inertia + rod().inertia * -1.0).largest_entry() < 1e-14);
        for (part, &distance) in segment.outboard_of_stations().iter().zip(distances) {
            let length = 2.0 - distance;
            assert!((part.mass - 1.5 * length).abs() < 1e-14);
            assert!((part.center_of_mass.y - (2.0 - 0.5 * length)).abs() < 1e-14);
            assert!((part.inertia.zz - 1.5 * length.powi(3) / 12.0).abs() < 1e-14);
        }
        assert_eq!(messages(segment), [""; 0]);
    }
    assert_eq!(cut_at(&[]).mass_properties(), None);
}

#[test]
fn a_structure_without_stations_has_none() {
    let structure = Structure::new(&scene(), vec![cut_at(&[]), cut_at(&[])]).expect("allowed");
    assert!(!structure.has_stations());
    let structure = Structure::new(&scene(), vec![cut_at(&[]), cut_at(&[0.0])]).expect("allowed");
    assert!(structure.has_stations());
}

#[test]
fn what_is_wrong_is_named_with_its_place() {
    type Change = fn(&mut SegmentStructure);
    let table: [(Change, &str); 15] = [
        (
            |s| s.pulse_constant = 0.0,
            "segment 1,2: pulse constant 0 found, a positive finite time expected",
        ),
        (
            |s| s.pulse_constant = f64::INFINITY,
            "segment 1,2: pulse constant inf found, a positive finite time expected",
        ),
        (
            |s| s.material.youngs_modulus = -1.0,
            "segment 1,2: Young's modulus -1 found, a positive finite modulus expected",
        ),
        (
            |s| s.material.poissons_ratio = f64::NAN,
            "segment 1,2: Poisson's ratio NaN found, a number above -1 and at most 0.5 expected",
        ),
        (
            |s| s.material.poissons_ratio = 0.7,
            "segment 1,2: Poisson's ratio 0.7 found, a number above -1 and at most 0.5 expected",
        ),
        (
            |s| s.material.poissons_ratio = 1e300,
            "segment 1,2: Poisson's ratio 1e300 found, a number above -1 and at most 0.5 expected",
        ),
        (
            |s| s.material.poissons_ratio = -1.0,
            "segment 1,2: Poisson's ratio -1 found, a number above -1 and at most 0.5 expected",
        ),
        (
            |s| s.stations[1].distance_from_hinge = 1.9,
            "segment 1,2, station 2: distance 1.9 after 1.5 found, at most that of the station \
             before expected",
        ),
        (
            |s| s.stations[2].distance_from_hinge = 0.1,
            "segment 1,2, station 3: last station 0.1 from the hinge found, 0 expected",
        ),
        (
            |s| s.stations[0].distance_from_hinge = f64::NAN,
            "segment 1,2, station 1: distance NaN found, a finite number expected",
        ),
        (
            |s| s.stations[0].slice.mass = -0.5,
            "segment 1,2, station 1: slice of mass -0.5 found, a finite mass not below zero \
             expected",
        ),
        (
            |s| s.stations[1].slice.inertia.yy = 1.0,
            "segment 1,2, station 2: slice with principal moments of inertia 0.125, 0.125, 1 \
             found, the largest at most the sum of the two others expected",
        ),
        (
            |s| s.stations[2].slice.center_of_mass.x = f64::NAN,
            "segment 1,2, station 3: slice with mass centre (NaN, 0.25, 0) found, finite \
             components expected",
        ),
        (
            |s| s.stations[2].section = SectionShape::Tube { radius: f64::NAN, thickness: 0.1 },
            "segment 1,2, station 3: radius NaN found, a finite number expected",
        ),
        (
            |s| {
                let corner = |xi| Vertex { xi, zeta: 0.0, thickness: 0.1 };
                s.stations[0].section = SectionShape::Polygon(vec![corner(0.0), corner(f64::NAN)]);
            },
            "segment 1,2, station 1, vertex 2: ξ NaN found, a finite number expected",
        ),
    ];
    for (change, expected) in table {
        let mut segment = cut_at(&[1.5, 0.5, 0.0]);
        change(&mut segment);
        assert_eq!(messages(segment), [expected]);
    }
}

#[test]
fn slices_that_are_not_the_segment_are_an_error_with_the_difference() {
    let mut heavy = cut_at(&[0.0]);
    heavy.stations[0].slice.mass = 3.5;
    assert_eq!(
        messages(heavy.clone()),
        ["segment 1,2: slices of mass 3.5 in all found, 3 of the segment (0.5 away) expected"]
    );
    let mut moved = cut_at(&[0.0]);
    moved.stations[0].slice.center_of_mass.z = 0.25;
    assert_eq!(
        messages(moved),
        ["segment 1,2: slices with mass centre (0, 1, 0.25) found, (0, 1, 0) of the segment \
          (0.25 away) expected"]
    );
    let mut slim = cut_at(&[0.0]);
    slim.stations[0].slice.inertia = Sym3::diagonal(0.5, 0.0, 0.5);
    assert_eq!(
        messages(slim),
        ["segment 1,2: slices with moments (0.5, 0, 0.5) and products (0, 0, 0) of inertia \
          found, (1, 0, 1) and (0, 0, 0) of the segment (up to 0.5 away) expected"]
    );

    let segments = vec![cut_at(&[0.0]), heavy];
    let (structure, differences) =
        Structure::with_differing_slices(&scene(), segments).expect("nothing else is wrong");
    assert_eq!((structure.segments().len(), differences.len()), (2, 1));
}

#[test]
fn a_station_beyond_its_slice_is_told() {
    let warnings = |change: fn(&mut SegmentStructure)| -> Vec<String> {
        let mut segment = cut_at(&[1.5, 0.5, 0.0]);
        change(&mut segment);
        let segments = vec![cut_at(&[0.0]), segment];
        let (structure, _) = Structure::with_differing_slices(&scene(), segments).expect("allowed");
        structure.warnings(&scene()).iter().map(StructureError::to_string).collect()
    };
    // A slip of a digit for 1.5; the slice reaches from there to 2.
    let beyond = "segment 1,2, station 1: distance 15 of a station whose slice has its mass centre at 1.75 along \
                  the long axis found, a slice outboard of its station expected";
    assert_eq!(warnings(|s| s.stations[0].distance_from_hinge = 15.0), [beyond]);
    assert_eq!(warnings(|_| ()), [""; 0]);
    // Where its slice is a point mass, a station may be there; rounding decides on which side.
    assert_eq!(warnings(|s| s.stations[0].distance_from_hinge = 1.75 + 1e-15), [""; 0]);
    assert_eq!(warnings(|s| s.stations[2].slice.center_of_mass.y = -0.1), [""; 0]);
    let without_mass = |s: &mut SegmentStructure| {
        s.stations[0].distance_from_hinge = 15.0;
        s.stations[0].slice.mass = 0.0;
    };
    assert_eq!(warnings(without_mass), [""; 0]);
}

#[test]
fn stations_that_do_not_carry_a_rotor_are_told() {
    let told = |body: usize| -> Vec<String> {
        let mut description = SceneDescription::clone(&scene());
        let (axis, speed) = (Vec3::unit_y(), RotorSpeed::Constant(2.0));
        description.rotors = vec![Rotor { body: Some(body), axis, inertia: 0.1, speed }];
        let scene = Scene::new(description).expect("a rotor in a rod");
        let segments = vec![cut_at(&[0.0]), cut_at(&[1.5, 0.5, 0.0])];
        let structure = Structure::new(&scene, segments).expect("slices of rods");
        structure.warnings(&scene).iter().map(StructureError::to_string).collect()
    };
    assert_eq!(told(0), [""; 0]);
    let words = "segment 1,2: a rotor in a body with stations away from its hinge, 2 of them, which do not carry its \
                 moment found, a wheel as a body on a hinge expected";
    assert_eq!(told(1), [words]);
}

/// The run lasts 1.
#[test]
fn a_pulse_that_is_longer_than_the_run_is_told() {
    let told = |latch: Option<f64>, pulse_constant: f64| -> Vec<String> {
        let mut description = SceneDescription::clone(&scene());
        description.bodies[0].hinge.lock_angle = latch;
        let scene = Scene::new(description).expect("a latch");
        let segments = vec![
            SegmentStructure { pulse_constant, ..cut_at(&[0.0]) },
            SegmentStructure { pulse_constant, ..cut_at(&[0.0]) },
        ];
        let structure = Structure::new(&scene, segments).expect("slices of rods");
        structure.warnings(&scene).iter().map(StructureError::to_string).collect()
    };
    let words = "segment 1,1: pulse constant 20 found, one below the 1 that the run lasts expected";
    assert_eq!(told(Some(0.5), 20.0), [words]);
    assert_eq!(told(Some(0.5), 1.0), [""; 0]);
    assert_eq!(told(None, 20.0), [""; 0]);
}

#[test]
fn one_entry_for_each_segment() {
    let errors = Structure::new(&scene(), vec![cut_at(&[0.0])]).expect_err("one is missing");
    assert_eq!(
        errors[0].to_string(),
        "structure of 1 segments found, one for each of the 2 expected"
    );
}
