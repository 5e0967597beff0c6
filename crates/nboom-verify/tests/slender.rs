//! A slender boom that turns about its long axis: rounding in its other moments of inertia is much of that about the axis.

use nboom_model::{Appendage, Hinge, Mount};
use nboom_model::{Body, MassProperties, Scene, SceneDescription, Segment};
use nboom_scalar::{Sym3, Vec3};
use nboom_verify::{TestCase, certify, compare};

const TOLERANCE: f64 = 1e-11;

/// A boom that tilts, one of 20 m on its tip that turns about itself, and a light one that swings on that.
fn scene(about_itself: f64) -> Scene {
    let main_body = MassProperties::new(120.0, Vec3::zero(), Sym3::diagonal(22.0, 20.0, 25.0));
    let mut description = SceneDescription::at_rest("slender booms", main_body, 1.0);
    let boom = |mass, centre, across| {
        let inertia = Sym3::diagonal(about_itself, across, across);
        MassProperties::new(mass, Vec3::unit_x() * centre, inertia)
    };
    let booms = [boom(4.0, 1.0, 1.35), boom(4.0, 10.0, 130.35), boom(0.01, 10.0, 1.35)];
    let segment = |mass_properties| Segment { length: 1.0, mass_properties, hinge: Hinge::free() };
    let mount = Mount::at(Vec3::new(0.5, 0.0, -0.5));
    description.attach(&Appendage::Regular { mount, segments: booms.map(segment).to_vec() });
    let hung = [(-Vec3::unit_y(), 0.0), (Vec3::unit_x(), 2.0), (Vec3::unit_z(), 20.0)];
    for (body, (axis, along)) in description.bodies.iter_mut().zip(hung) {
        let mount = if body.inboard.is_some() { Mount::at(Vec3::unit_x() * along) } else { mount };
        *body = Body { axis, mount, ..*body };
    }
    Scene::new(description).expect("the bodies are physical")
}

#[test]
fn right_code_passes() {
    for exponent in [3, 5, 8, 11] {
        let scene = scene(10.0_f64.powi(-exponent));
        let held = TestCase::with_held_hinges(&scene, 200, 1970).expect("all numbers are finite");
        let free = TestCase::new(scene, 200, 1970).expect("all numbers are finite");
        let comparison = compare(&free, &held, &[], &[], TOLERANCE).expect("accelerations");
        assert!(comparison.passed(), "1e-{exponent}: {:?}", comparison.worst());
    }
}

#[test]
fn wrong_code_is_found() {
    let test_case = TestCase::new(scene(1e-3), 50, 1970).expect("all numbers are finite");
    let mut code = test_case.recursion();
    for (wrong, passes) in [(0.0, true), (1e-6, false)] {
        let certificate = certify(&test_case, |i| {
            let mut found = code.accelerations(i);
            found[7] *= 1.0 + wrong;
            found
        });
        let worst = certificate.expect("accelerations").worst;
        assert_eq!(worst <= TOLERANCE, passes, "{worst:e} where {wrong:e} is wrong");
    }
}

/// A boom of 30 g on a satellite of 3 t.
#[test]
fn right_code_passes_for_a_light_boom_on_a_heavy_body() {
    let main_body =
        MassProperties::new(3e3, Vec3::new(0.1, -0.2, 0.15), Sym3::diagonal(2e3, 2.2e3, 2.6e3));
    let mut description = SceneDescription::at_rest("a light boom", main_body, 1.0);
    let inertia = Sym3::diagonal(2.5e-6, 2.3e-3, 2.3e-3);
    let mass_properties = MassProperties::new(0.03, Vec3::unit_x() * 0.5, inertia);
    let segments = vec![Segment { length: 1.0, mass_properties, hinge: Hinge::free() }; 2];
    let mount = Mount::at(Vec3::new(0.7, -0.4, 0.3));
    description.attach(&Appendage::Regular { mount, segments });
    description.initial.omega_body = Vec3::new(0.1, 0.05, 0.2);
    let scene = Scene::new(description).expect("the bodies are physical");
    let held = TestCase::with_held_hinges(&scene, 200, 1970).expect("all numbers are finite");
    let free = TestCase::new(scene, 200, 1970).expect("all numbers are finite");
    let comparison = compare(&free, &held, &[], &[], TOLERANCE).expect("accelerations");
    assert!(comparison.passed(), "{:?}", comparison.worst());
}
