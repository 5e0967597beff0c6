//! Shapes for pictures.

use nboom_model::{BodyShape, Solid};
use nboom_scalar::{Mat3, Vec3};

use super::{BUS, body, right, wrong};

fn with(shape: &str) -> String {
    BUS.to_owned() + &body("boom", &format!("shape = {{ {shape} }}"), "")
}

#[test]
fn a_shape_is_around_the_mass_centre_unless_it_says_where() {
    let shape = |text: &str| *right(&with(text)).scene.shapes().of(0).expect("a shape");
    let (middle, axes) = (Vec3::unit_y(), Mat3::identity());
    let solid = Solid::Box(Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(shape("box = [1, 2, 3]"), BodyShape { solid, middle, axes });
    let solid = Solid::Panel(Vec3::new(1.0, 2.0, 0.0));
    let found = shape("panel = [1, 2, 0], at = [0, 0, 3]");
    assert_eq!(found, BodyShape { solid, middle: Vec3::unit_z() * 3.0, axes });
    let solid = Solid::Cylinder { radius: 0.5, length: 2.0, along: Vec3::unit_y() };
    let turned = "axes = { turn = { about = \"z\", by_deg = 90 } }";
    let found =
        shape(&format!("cylinder = {{ radius = 0.5, length = 2, along = \"y\" }}, {turned}"));
    assert_eq!((found.solid, found.axes.column(0)), (solid, Vec3::unit_y()));
}

#[test]
fn every_copy_and_the_main_body_may_have_one() {
    let text = BUS.to_owned() + "shape = { box = [1, 1, 1] }\n";
    let repeated = "shape = { panel = [1, 2, 0] }\nrepeat = { count = 3, about = \"z\" }";
    let scene = right(&(text + &body("wing", repeated, "") + &body("boom", "", ""))).scene;
    let shapes = scene.shapes();
    assert!(shapes.main_body.is_some());
    assert!((0..3).all(|i| shapes.of(i).is_some() && shapes.of(i) == shapes.of(0)));
    assert_eq!(shapes.of(3), None);
}

#[test]
fn solids_that_are_none_are_refused() {
    for (shape, told) in [
        ("box = [1, 2, 0]", "box: found sides 1, 2, 0, expected three positive lengths"),
        ("panel = [1, 2, 3]", "expected two positive lengths and a 0, across the panel"),
        ("panel = [-1, 2, 3]", "panel: found sides -1, 2, 3"),
        ("at = [0, 0, 0]", "shape: found none, expected exactly one of box, panel, cylinder"),
        (
            "cylinder = { radius = 0, length = 1, along = \"x\" }",
            "radius: found 0, expected a positive length",
        ),
    ] {
        let errors = wrong(&with(shape));
        assert_eq!(errors.len(), 1, "{errors:#?}");
        assert!(errors[0].contains(told), "{told}: {}", errors[0]);
    }
}
