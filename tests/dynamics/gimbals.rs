//! Bodies without mass between hinges: the rings of gimbals.

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::formulation::Formulation;
use nboom::model::{
    Body, BodyName, External, Hinge, InitialMotion, Joint, MassDefect, MassProperties, Mode,
    ModelError, Mount, Scene, SceneDescription,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{Form, Nobody, Options, SimError, simulate};

fn body(inboard: Option<usize>, at: f64, axis: Vec3<f64>, of: MassProperties) -> Body {
    let mount = Mount::at(Vec3::unit_x() * at);
    let hinge = Hinge::free();
    let (joint, tip) = (Joint::Revolute, Vec3::zero());
    Body { inboard, mount, joint, axis, mass_properties: of, tip, hinge }
}

/// Two fuel tanks on gimbals in a spinning stage under thrust: the sample INS of NASA's NBOD2 of 1982,
/// slugs, feet and seconds.
fn stage() -> Scene {
    let of = |mass, at, xx, yy| {
        MassProperties::new(mass, Vec3::unit_x() * at, Sym3::diagonal(xx, yy, yy))
    };
    let ring = MassProperties::nothing();
    let (y, z) = (Vec3::unit_y(), Vec3::unit_z());
    let scene = SceneDescription {
        bodies: vec![
            body(None, 7.115, z, ring),
            body(Some(0), 0.0, y, of(15.54, -0.186, 12.51, 10.08)),
            body(None, 4.146, y, ring),
            body(Some(2), 0.0, z, of(25.61, -0.186, 20.62, 16.62)),
        ],
        externals: vec![External::thrust(
            Vec3::unit_x() * 15000.0,
            Vec3::zero(),
            [0.0, f64::INFINITY],
        )],
        initial: InitialMotion {
            omega_body: Vec3::new(4.1888, 0.0495, 0.0),
            ..InitialMotion::at_rest()
        },
        ..SceneDescription::at_rest("stage", of(169.83, 0.0, 481.87, 1664.9), 0.01)
    };
    Scene::new(scene).expect("a ring carries a tank")
}

#[test]
fn two_tanks_on_gimbals_accelerate_as_nasa_printed_in_1982() {
    let scene = stage();
    let mut dynamics = Recursive::<f64>::new(&scene);
    let at_rest = [0.0; 4];
    dynamics.set_mode(&Mode { externals: vec![1], ..Mode::at_start(&scene) }, &at_rest);
    let motion = Motion { omega_body: scene.initial.omega_body, beta: &at_rest, tau: &at_rest };
    let mut found = Accelerations::for_hinges(4);
    dynamics.accelerations(&motion, &mut found);
    let Accelerations { omega_dot_body, origin_body, tau_dot } = found;
    // Eight digits are printed; what is printed as zero is zero but for rounding.
    for (found, printed, half_of_last_digit) in [
        (origin_body.x, 71.099215, 5e-7),
        (origin_body.y, -0.031517397, 5e-10),
        (origin_body.z, 0.0, 1e-13),
        (omega_dot_body.x, 0.0, 1e-15),
        (omega_dot_body.y, 0.0, 1e-15),
        (omega_dot_body.z, -0.16626456, 5e-9),
        (tau_dot[0], 0.27421043, 5e-9),
        (tau_dot[1], 0.0, 1e-13),
        (tau_dot[2], 0.0, 1e-13),
        (tau_dot[3], 0.24091687, 5e-9),
    ] {
        assert!((found - printed).abs() <= half_of_last_digit, "{found} {printed}");
    }
}

/// Before any hinge turns as far as dampers would matter, which are left out here.
#[test]
fn a_run_of_gimbals_keeps_its_balances() {
    let scene = stage();
    for form in [Form::Recursive, Form::Closed(Formulation::Symmetric)] {
        let options = Options { formulation: Some(form), ..Options::default() };
        let summary =
            simulate(&scene, &options, &mut Nobody).expect("the rings turn with the tanks");
        let found = summary.conservation;
        assert!(
            found.angular_momentum.is_some_and(|off| off < 1e-10) && found.energy < 1e-10,
            "{form:?} {found:?}"
        );
    }
}

#[test]
fn a_body_without_mass_carries_another_one() {
    let tip = body(None, 1.0, Vec3::unit_z(), MassProperties::nothing());
    let main = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let refused = |bodies: Vec<Body>| {
        let scene = SceneDescription { bodies, ..SceneDescription::at_rest("tip", main, 1.0) };
        Scene::new(scene).expect_err("nothing hangs on the last body")
    };
    for bodies in [vec![tip], vec![tip, body(Some(0), 1.0, Vec3::unit_y(), tip.mass_properties)]] {
        assert!(matches!(
            refused(bodies)[..],
            [ModelError::Mass { body: BodyName::Segment(_), defect: MassDefect::Mass(0.0) }]
        ));
    }
}

#[test]
fn a_ring_that_moves_along_the_axis_of_what_it_carries_is_told() {
    let point = MassProperties::new(1.0, Vec3::unit_x(), Sym3::zero());
    let main = MassProperties::new(10.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    for joint in [Joint::Revolute, Joint::Prismatic] {
        let along = |inboard, at, of| Body { joint, ..body(inboard, at, Vec3::unit_z(), of) };
        let bodies = vec![along(None, 1.0, MassProperties::nothing()), along(Some(0), 0.0, point)];
        let scene = SceneDescription { bodies, ..SceneDescription::at_rest("twice", main, 1.0) };
        let scene = Scene::new(scene).expect("each number is right");
        for formulation in [Form::Recursive, Form::Closed(Formulation::Articulated)] {
            let options = Options { formulation: Some(formulation), ..Options::default() };
            let failure = simulate(&scene, &options, &mut Nobody)
                .expect_err("nothing says how the ring moves");
            let SimError::SingularMassMatrix { hinge, .. } = &failure.error else {
                panic!("{joint:?}, {formulation:?}: {}", failure.error)
            };
            assert_eq!(*hinge, Some(scene.label(0)), "{joint:?}, {formulation:?}");
        }
    }
}
