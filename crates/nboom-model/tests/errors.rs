//! What is no scene is refused, each defect by its own words.

use std::error::Error;

use nboom_model::{
    Appendage, Course, External, ExternalKind, Finding, Gravity, Hinge, HingeState, Joint,
    KickOffSpring, MassProperties, Mount, Release, Scene, SceneDescription, Segment, TorqueTable,
};
use nboom_scalar::{Sym3, Vec3};

/// A hub with a boom of two segments, under gravity and thrust.
fn sound() -> SceneDescription {
    let body = MassProperties::new(2.0, Vec3::unit_y(), Sym3::diagonal(1.0, 0.5, 1.0));
    let segment = Segment { length: 1.0, mass_properties: body, hinge: Hinge::free() };
    let mut scene = SceneDescription::at_rest("sound", body, 1.0);
    let mount = Mount::at(Vec3::unit_x());
    scene.attach(&Appendage::Regular { mount, segments: vec![segment.clone(), segment] });
    scene.gravity = Some(Gravity { acceleration: 9.8, up: Vec3::unit_z() });
    let thrust = External::thrust(Vec3::unit_x(), Vec3::unit_y(), [0.2, 0.4]);
    scene.externals = vec![External { body: Some(1), ..thrust.clone() }, thrust];
    scene
}

fn told(change: impl Fn(&mut SceneDescription)) -> Vec<String> {
    let mut scene = sound();
    change(&mut scene);
    let errors = Scene::new(scene).err();
    errors.into_iter().flatten().map(|error| error.to_string()).collect()
}

#[test]
fn a_sound_scene_is_one() {
    assert_eq!(told(|_| {}), [""; 0]);
}

/// `?` takes all errors of a scene to whoever called.
#[test]
fn the_errors_of_a_scene_are_an_error_of_a_line_each() {
    let read =
        |scene: SceneDescription| -> Result<Scene, Box<dyn Error>> { Ok(Scene::new(scene)?) };
    let mut scene = sound();
    (scene.main_body.mass, scene.end_time) = (-1.0, -1.0);
    let told = read(scene).expect_err("two errors").to_string();
    let beginnings = ["main body: mass -1 found", "end time -1 found"];
    assert_eq!(told.lines().count(), beginnings.len());
    for (line, beginning) in told.lines().zip(beginnings) {
        assert!(line.starts_with(beginning), "{told}");
    }
}

#[test]
fn errors_of_another_description_name_the_bodies() {
    let names = ["inner", "outer"].map(str::to_owned).to_vec();
    let scene = Scene::new(sound()).expect("sound").with_names(names);
    let mut other = sound();
    other.bodies[1].mass_properties.mass = -1.0;
    let told = scene.with_description(other).expect_err("no mass").to_string();
    assert!(told.starts_with("segment 1,2 (outer): mass -1 found"), "{told}");
}

/// Whatever words a name has.
#[test]
fn what_was_found_and_what_expected_stand_apart_from_the_place() {
    let names = ["inner", "a: mass found, none expected"].map(str::to_owned).to_vec();
    let scene = Scene::new(sound()).expect("sound").with_names(names);
    let mut other = sound();
    other.bodies[1].mass_properties.mass = -1.0;
    other.externals[0].course = Course::Pulse { on: 0.2, off: 0.1 };
    let errors = scene.with_description(other).expect_err("two errors");
    let [of_thrust, of_mass] = &errors[..] else { panic!("{errors}") };
    assert_eq!(of_mass.finding(), Finding::new("mass -1", "a positive finite mass"));
    let place = "segment 1,2 (a: mass found, none expected)";
    assert_eq!(of_mass.place().as_deref(), Some(place));
    assert_eq!(of_mass.to_string(), format!("{place}: {}", of_mass.finding()));
    assert_eq!(of_thrust.place(), None);
    assert_eq!(of_thrust.finding().found, "thrust from 0.2 to 0.1");
}

#[test]
fn numbers_that_are_none_are_refused() {
    let nan = f64::NAN;
    let bad = Vec3::new(0.0, nan, 0.0);
    type Change = fn(&mut SceneDescription, f64, Vec3<f64>);
    let cases: [(&str, Change); 12] = [
        ("initial time", |s, nan, _| s.initial.time = nan),
        ("initial position", |s, _, bad| s.initial.position_inertial = bad),
        ("initial velocity", |s, _, bad| s.initial.velocity_inertial = bad),
        ("initial angular rate", |s, _, bad| s.initial.omega_body = bad),
        ("end time", |s, nan, _| s.end_time = nan),
        ("gravity", |s, nan, _| s.gravity.as_mut().expect("given").acceleration = nan),
        ("hinge point", |s, _, bad| s.bodies[1].mount.point = bad),
        ("hinge spring", |s, nan, _| s.bodies[1].hinge.spring.linear = nan),
        ("hinge dashpot", |s, nan, _| s.bodies[1].hinge.dashpot.rate_quadratic = nan),
        ("lock angle", |s, nan, _| s.bodies[1].hinge.lock_angle = Some(nan)),
        ("release", |s, nan, _| s.bodies[1].hinge.release = Release::Time(nan)),
        ("release", |s, delay, _| {
            s.bodies[1].hinge.release = Release::AfterLock { hinge: 0, delay };
        }),
    ];
    let beyond = told(|scene| (scene.initial.time, scene.end_time) = (-1e308, 1e308));
    assert!(matches!(&beyond[..], [one] if one.contains("time from the initial to the end time")));
    for (quantity, change) in cases {
        let found = told(|scene| change(scene, nan, bad));
        let ending = "that is not finite found, finite numbers expected";
        let is_told = |error: &String| error.contains(quantity) && error.ends_with(ending);
        assert!(found.len() == 1 && is_told(&found[0]), "{quantity}: {found:?}");
    }
}

#[test]
fn what_contradicts_itself_is_refused() {
    let waits_for = |hinge: usize| {
        move |scene: &mut SceneDescription| {
            scene.bodies[1].hinge.start.state = HingeState::Unreleased;
            scene.bodies[1].hinge.release = Release::Angle { hinge, angle: 0.1 };
        }
    };
    let after_lock = |hinge: usize, delay: f64| {
        move |s: &mut SceneDescription| {
            s.bodies[1].hinge.release = Release::AfterLock { hinge, delay };
        }
    };
    assert_eq!(told(waits_for(0)), [""; 0]);
    assert_eq!(told(after_lock(0, 0.0)), [""; 0]);
    let kick_off = |limit_length: f64| {
        let (main_body_point, body_point) = (Vec3::unit_y(), Vec3::unit_z());
        let coefficients = [10.0, 0.0, 0.0, 0.0];
        let spring = KickOffSpring { main_body_point, body_point, coefficients, limit_length };
        move |s: &mut SceneDescription| s.bodies[1].hinge.kick_off = Some(spring)
    };
    assert_eq!(told(kick_off(0.0)), [""; 0]);
    for (found, words) in [
        (told(waits_for(1)), "release by hinge number 2 found, another of the 2 hinges"),
        (told(waits_for(2)), "release by hinge number 3 found, another of the 2 hinges"),
        (told(waits_for(usize::MAX)), "another of the 2 hinges"),
        (told(after_lock(1, 0.5)), "release by hinge number 2 found, another of the 2 hinges"),
        (told(after_lock(0, -0.5)), "release -0.5 time units after a lock-up found, zero or more"),
        (told(kick_off(-0.5)), "kick-off spring up to length -0.5 found, a length not below zero"),
        (told(|s| s.end_time = -1.0), "end time -1 found, a time not before the initial time 0"),
        (told(|s| s.gravity.as_mut().expect("given").up = Vec3::unit_z() * 1.1), "of length 1.1"),
        (told(|s| s.bodies[0].axis = Vec3::unit_x() * 2.0), "hinge axis of length 2 found"),
        (told(|s| s.bodies[0].inboard = Some(1)), "inboard body 1 found, an earlier body"),
        (told(|s| s.main_body.mass = -1.0), "main body: mass -1 found"),
        (told(|s| s.bodies[1].hinge.start = held_at_rate(0.5)), "rate 0.5 found, zero of a hinge"),
    ] {
        assert!(found.len() == 1 && found[0].contains(words), "{words}: {found:?}");
    }
}

#[test]
fn tables_that_give_no_torque_are_refused() {
    let with = |hinges: &[usize], points: &[[f64; 2]]| {
        let points = points.to_vec();
        let table = |&hinge: &usize| TorqueTable { hinge, points: points.clone() };
        let tables: Vec<TorqueTable> = hinges.iter().map(table).collect();
        told(|scene| scene.torque_tables.clone_from(&tables))
    };
    let fine = [[-1.0, 2.0], [0.5, -3.0]];
    assert_eq!(with(&[0, 1], &fine), [""; 0]);
    for (found, words) in [
        (with(&[2], &fine), "torque table 1: hinge number 3 found, one of the 2 hinges"),
        (with(&[1, 1], &fine), "torque table 2: hinge number 2 found, one of the 2 hinges without"),
        (with(&[0], &[]), "torque table 1: 0 points found, two or more"),
        (with(&[0], &fine[..1]), "torque table 1: 1 points found, two or more"),
        (with(&[0], &[fine[0], [0.5, f64::NAN]]), "point 2 at 0.5, NaN found"),
        (with(&[0], &[[f64::INFINITY, 1.0], fine[1]]), "point 1 at inf, 1 found"),
        (with(&[0], &[fine[1], fine[0]]), "point 2 at -1, 2 found, two or more points of finite"),
        (with(&[0], &[fine[0], fine[0]]), "point 2 at -1, 2 found"),
    ] {
        assert!(found.len() == 1 && found[0].contains(words), "{words}: {found:?}");
    }
}

#[test]
fn what_acts_from_outside_is_checked() {
    let with = |change: fn(&mut External)| told(|scene| change(&mut scene.externals[0]));
    let over = |points: &[[f64; 2]]| {
        told(|scene| scene.externals[1].course = Course::Table(points.to_vec()))
    };
    let fine = [[0.0, 2.0], [0.5, -3.0]];
    assert_eq!(over(&fine), [""; 0]);
    assert_eq!(with(|one| one.course = Course::ALWAYS), [""; 0]);
    for (found, words) in [
        (with(|one| one.body = Some(2)), "thrust on a body that is not there found, one on a body"),
        (with(|one| one.amount.y = f64::NAN), "thrust [1.0, NaN, 0.0] at [0.0, 1.0, 0.0] found"),
        (with(|one| one.point.z = f64::INFINITY), "at [0.0, 1.0, inf] found, finite numbers"),
        (
            told(|scene| {
                scene.externals[0].kind = ExternalKind::Torque;
                scene.externals[0].body = Some(9);
            }),
            "torque on a body that is not there found",
        ),
        (
            with(|one| one.course = Course::Pulse { on: 0.2, off: 0.1 }),
            "thrust from 0.2 to 0.1 found",
        ),
        (
            with(|one| one.course = Course::Pulse { on: f64::NAN, off: 0.1 }),
            "from NaN to 0.1 found",
        ),
        (over(&[]), "thrust over 0 points found, two or more points"),
        (over(&fine[..1]), "thrust over 1 points found, two or more points"),
        (over(&[fine[0], [0.5, f64::NAN]]), "point 2 at 0.5, NaN found"),
        (over(&[[f64::NEG_INFINITY, 1.0], fine[1]]), "point 1 at -inf, 1 found"),
        (over(&[fine[1], fine[0]]), "point 2 at 0, 2 found, two or more points of finite"),
        (over(&[fine[0], fine[0]]), "point 2 at 0, 2 found"),
    ] {
        assert!(found.len() == 1 && found[0].contains(words), "{words}: {found:?}");
    }
}

/// Times of what never does anything are not looked at.
#[test]
fn what_never_acts_from_outside_is_left_out() {
    let mut scene = sound();
    scene.externals[0].amount = Vec3::zero();
    scene.externals[0].course = Course::Pulse { on: 1.0, off: 0.0 };
    let kept = scene.externals[1].clone();
    assert_eq!(Scene::new(scene).expect("sound").externals, [kept]);
}

fn held_at_rate(rate: f64) -> nboom_model::HingeStart {
    nboom_model::HingeStart { angle: 0.0, rate, state: HingeState::Locked }
}

#[test]
fn a_table_of_a_slide_has_forces_at_travels() {
    let told = |joint| {
        told(|scene| {
            scene.bodies[0].joint = joint;
            scene.torque_tables = vec![TorqueTable { hinge: 0, points: Vec::new() }];
        })
    };
    for (joint, table, places) in [
        (Joint::Revolute, "torque table 1: ", "angles"),
        (Joint::Prismatic, "force table 1: ", "travels"),
    ] {
        let found = told(joint);
        let ascending = format!("at ascending {places} expected");
        assert!(found.len() == 1 && found[0].starts_with(table), "{found:?}");
        assert!(found[0].ends_with(&ascending), "{found:?}");
    }
}
