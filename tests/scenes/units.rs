//! No unit is hidden anywhere: a scene written in other units of time, mass and length has the same
//! events and impulses.
//!
//! In units that differ by powers of two (of four, for square roots) all numbers differ by powers of
//! two, so that every result is the same to the last bit. In others roundings differ.

use nboom::model::{
    Appendage, Course, Dashpot, External, ExternalAxes, ExternalKind, Hinge, HingeStart,
    HingeState, Joint, MassProperties, Mount, Scene, SceneDescription, Segment, Spring,
};
use nboom::scalar::{Sym3, Vec3};
use nboom::sim::{EventKind, Method, Options};

use crate::catalog::Reference;
use crate::collect::{Collected, run};
use crate::random_scene;
use crate::scaled::Units;

/// Of time 1e-8 to 1e8, of mass and length 1e-9 to 1e9, each alone and together.
const DECIMAL: [Units; 8] = [
    Units { time: 1e8, mass: 1.0, length: 1.0 },
    Units { time: 1e-8, mass: 1.0, length: 1.0 },
    Units { time: 1e-6, mass: 1.0, length: 1.0 },
    Units { time: 1.0, mass: 1e9, length: 1.0 },
    Units { time: 1.0, mass: 1.0, length: 1e9 },
    Units { time: 1.0, mass: 1.0, length: 1e-9 },
    Units { time: 1e8, mass: 1e-9, length: 1e9 },
    Units { time: 1e-8, mass: 1e9, length: 1e-9 },
];

/// About the same by powers of four.
fn binary() -> [Units; 4] {
    let four = |power: i32| 4.0_f64.powi(power);
    [
        Units { time: four(13), mass: 1.0, length: 1.0 },
        Units { time: four(-13), mass: 1.0, length: 1.0 },
        Units { time: four(13), mass: four(-15), length: four(15) },
        Units { time: four(-13), mass: four(15), length: four(-15) },
    ]
}

fn checked(description: SceneDescription) -> Scene {
    Scene::new(description).expect("a physical scene")
}

/// Kind, hinge, time and impulse of each event, in the units of the scene before.
fn events(
    scene: &SceneDescription,
    found: &Collected,
    units: Units,
) -> Vec<(EventKind, Option<usize>, f64, f64)> {
    let of = |event: &nboom::sim::Event| {
        let joint = event.hinge.map_or(Joint::Revolute, |hinge| scene.bodies[hinge].joint);
        let impulse = event.impulse.unwrap_or(0.0) / units.impulse(joint);
        (event.kind, event.hinge, event.time / units.time, impulse)
    };
    found.events.iter().map(|(event, _)| of(event)).collect()
}

fn same_to_the_last_bit(scene: &SceneDescription, options: &Options) {
    let one = Units { time: 1.0, mass: 1.0, length: 1.0 };
    let (expected, steps) = run(&checked(scene.clone()), options);
    for units in binary() {
        let told = format!("{} by {}, {units:?}", scene.name, options.integrator);
        let (found, summary) = run(&checked(units.scene(scene)), options);
        assert_eq!(events(scene, &found, units), events(scene, &expected, one), "{told}");
        assert_eq!(summary.steps_accepted, steps.steps_accepted, "{told}");
        for (a, b) in found.samples.iter().zip(&expected.samples) {
            let coordinates = scene.bodies.iter().map(|body| units.coordinate(body.joint));
            let beta: Vec<f64> = a.beta.iter().zip(coordinates).map(|(a, one)| a / one).collect();
            assert_eq!(beta, b.beta, "{told} at {}", b.time);
            assert_eq!(a.attitude, b.attitude, "{told} at {}", b.time);
            assert_eq!(a.omega_body * units.time, b.omega_body, "{told} at {}", b.time);
            let position = a.position_inertial * (1.0 / units.length);
            assert_eq!(position, b.position_inertial, "{told} at {}", b.time);
        }
    }
}

/// Asserts equal events, times within 1e-11 of the span and impulses within 1e-11 of the largest.
fn same_events_and_impulses(scene: &SceneDescription, options: &Options) {
    let one = Units { time: 1.0, mass: 1.0, length: 1.0 };
    let expected = events(scene, &run(&checked(scene.clone()), options).0, one);
    let span = scene.end_time - scene.initial.time;
    let largest = expected.iter().fold(0.0_f64, |most, event| most.max(event.3.abs()));
    for units in DECIMAL {
        let told = format!("{} by {}, {units:?}", scene.name, options.integrator);
        let found = events(scene, &run(&checked(units.scene(scene)), options).0, units);
        let names = |events: &[(EventKind, Option<usize>, f64, f64)]| -> Vec<_> {
            events.iter().map(|event| (event.0, event.1)).collect()
        };
        assert_eq!(names(&found), names(&expected), "{told}");
        for (a, b) in found.iter().zip(&expected) {
            assert!((a.2 - b.2).abs() <= 1e-11 * span, "{told}: {a:?} {b:?}");
            assert!((a.3 - b.3).abs() <= 1e-11 * largest, "{told}: {a:?} {b:?}");
        }
    }
}

/// A boom that locks on a hub, and another one behind it.
fn boom(moment: f64, arm: f64, hinge: Hinge) -> Segment {
    let inertia = Sym3::diagonal(moment, moment, moment);
    Segment {
        length: 1.0,
        mass_properties: MassProperties::new(2.0, Vec3::unit_y() * arm, inertia),
        hinge,
    }
}

/// Two latches that arrive `apart` time units after each other at 2 rad per time unit: the time in which
/// these hinges turn by 1e-11 is 5e-12.
fn two_latches(apart: f64) -> SceneDescription {
    let hub = MassProperties::new(5.0, Vec3::zero(), Sym3::diagonal(4.0, 4.0, 4.0));
    let mut scene = SceneDescription::at_rest("two latches", hub, 1.0);
    for late in [0.0, apart] {
        let start = HingeStart { angle: -1.0 - 2.0 * late, rate: 2.0, state: HingeState::Free };
        let hinge = Hinge { lock_angle: Some(0.0), start, ..Hinge::free() };
        let segments = vec![boom(1.0, 0.0, hinge)];
        scene.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
    }
    scene
}

/// From rest, and driven by everything but kick-off springs.
fn driven() -> SceneDescription {
    let hub = MassProperties::new(5.0, Vec3::new(0.1, 0.2, -0.1), Sym3::diagonal(4.0, 5.0, 6.0));
    let mut scene = SceneDescription::at_rest("driven", hub, 4.0);
    let start = HingeStart { angle: 1.5, rate: 0.0, state: HingeState::Free };
    let spring = Spring { quadratic: 0.1, linear: -1.0, preload_angle: 0.2 };
    let dashpot = Dashpot { rate_linear: -0.3, rate_quadratic: -0.1, ..Dashpot::default() };
    let hinge = Hinge { spring, dashpot, start, lock_angle: Some(0.0), ..Hinge::free() };
    let segments = vec![boom(1.0, 0.6, hinge), boom(0.5, 0.4, hinge)];
    scene.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
    let (force, point) = (Vec3::new(1.0, 0.5, -0.3), Vec3::new(0.0, 0.3, 0.1));
    scene.externals = vec![External::thrust(force, point, [0.5, 1.5])];
    scene
}

/// The same under more from outside: on its booms, along inertial axes, over time.
fn pushed() -> SceneDescription {
    let mut scene = driven();
    let thrust = scene.externals[0].clone();
    let course = Course::Table(vec![[0.25, 0.5], [1.0, -1.0], [2.5, 0.25]]);
    let (kind, axes) = (ExternalKind::Torque, ExternalAxes::Inertial);
    let torque = External { body: Some(1), kind, axes, course, ..thrust.clone() };
    scene.externals.extend([torque, External { body: Some(0), ..thrust }]);
    scene.name = "pushed".to_owned();
    scene
}

/// The reference scenes have kick-off springs, releases, gravity and thrust.
fn references() -> impl Iterator<Item = SceneDescription> {
    Reference::all().map(|reference| SceneDescription::clone(&reference.scene()))
}

fn random() -> impl Iterator<Item = SceneDescription> {
    (0..12).map(|seed| {
        let mut scene = random_scene::description(1 + seed as usize % 5, seed);
        for body in &mut scene.bodies {
            let angle = body.hinge.start.angle;
            body.hinge.lock_angle = Some(angle + 0.3 * body.hinge.start.rate.signum());
        }
        scene
    })
}

fn by_default() -> Options {
    Options { samples: 10, ..Options::default() }
}

#[test]
fn units_by_powers_of_two_change_no_bit() {
    for scene in references().chain(random()).chain([two_latches(3e-12), driven(), pushed()]) {
        same_to_the_last_bit(&scene, &by_default());
    }
}

#[test]
fn no_integrator_has_units() {
    use Method::{Adams, Radau5, Radau9, Radau13, Taylor};
    for integrator in Method::ALL {
        // Rounding may decide on a round of Radau's iteration, which leaves sqrt(0.1 · rtol^(2/3)) of the
        // 0.1 · rtol^(2/3) that a step may err: 3e-12 at 1e-10.
        let is_radau = matches!(integrator, Radau5 | Radau9 | Radau13);
        // It may decide which order of Adams' method errs less, too, and of the twentieth of the tolerance that its steps
        // may err some are left: 1e-9 at 1e-7, 1e-12 at 1e-10.
        let rtol = if is_radau || integrator == Adams { 1e-10 } else { 1e-7 };
        let options = Options { integrator, rtol, ..by_default() };
        for scene in [driven(), two_latches(1e-11)] {
            // Roots of high order, as steps of power series are, and pivots are rounded otherwise.
            if !is_radau && integrator != Taylor {
                same_to_the_last_bit(&scene, &options);
            }
            same_events_and_impulses(&scene, &options);
        }
    }
}

#[test]
fn units_change_no_event_and_no_impulse() {
    for scene in references().chain(random()).chain([driven(), pushed()]) {
        same_events_and_impulses(&scene, &by_default());
    }
}

/// One instant or two: that decides on the impulses.
#[test]
fn latches_that_close_near_one_instant_do_so_in_any_unit() {
    for apart in [0.0, 2e-12, 4.9e-12, 5.1e-12, 1e-11, 1e-9] {
        let scene = two_latches(apart);
        let (found, _) = run(&checked(scene.clone()), &by_default());
        let times: Vec<f64> = found.happenings().iter().map(|event| event.2).collect();
        assert_eq!(times.len(), 2);
        assert_eq!(times[0] == times[1], apart < 5e-12, "{apart:e}");
        same_to_the_last_bit(&scene, &by_default());
        same_events_and_impulses(&scene, &by_default());
    }
}

/// A run in double-double has the same rule.
#[test]
fn references_in_double_double_have_no_units() {
    use nboom::sim::{Nobody, Reference as Truth, Witness, simulate, trust};
    for scene in [driven(), pushed(), two_latches(4e-12), two_latches(6e-12)] {
        let differences = |units: Units| {
            let (scene, mut witness) = (checked(units.scene(&scene)), Witness::new());
            simulate(&scene, &by_default(), &mut witness).expect("it runs to its end");
            let trust = trust(&scene, &by_default(), &witness, Truth::DoubleDouble, &mut Nobody);
            let trust = trust.expect("it can be followed");
            assert!(trust.same_events, "{} {units:?}", scene.name);
            let of_events = trust.events.iter().flat_map(|event| [Some(event.time), event.impulse]);
            let of_events = of_events.flatten().map(|digits| digits.difference);
            of_events.chain(trust.end.iter().map(|digits| digits.difference)).collect::<Vec<_>>()
        };
        let expected = differences(Units { time: 1.0, mass: 1.0, length: 1.0 });
        for units in binary() {
            assert_eq!(differences(units), expected, "{} {units:?}", scene.name);
        }
    }
}
