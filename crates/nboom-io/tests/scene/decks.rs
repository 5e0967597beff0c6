//! Scenes as decks: what survives, and what is said of scenes that no deck can say.

use nboom_io::{Format, SceneFile, parse_deck, read_scene, write_deck, write_scene};
use nboom_model::{Posture, Release, Scene, SceneDescription};
use nboom_scalar::{Mat3, Vec3};

use super::written::{decks, files, meaning};
use super::{BUS, body, read, right};

/// The deck of a scene, read again.
fn through_a_deck(file: &SceneFile) -> SceneFile {
    let deck = write_deck(file).unwrap_or_else(|obstacles| panic!("{obstacles:#?}"));
    let read = parse_deck("a.nml", &deck.text, &file.scene.name);
    read.unwrap_or_else(|error| panic!("{error}\n{}", deck.text))
}

/// [`meaning`], without rest angles of dampers that do not depend on the angle.
fn meaning_of_deck(file: &SceneFile) -> SceneDescription {
    let mut scene = meaning(file);
    for dashpot in scene.bodies.iter_mut().map(|body| &mut body.hinge.dashpot) {
        if [dashpot.angle_quadratic, dashpot.angle_linear] == [0.0; 2] {
            dashpot.preload_angle = 0.0;
        }
    }
    scene
}

#[test]
fn a_deck_that_became_a_scene_becomes_the_deck_again() {
    for path in decks() {
        let deck = read_scene(&path).unwrap_or_else(|error| panic!("{error}"));
        let scene = read(&write_scene(&deck)).unwrap_or_else(|error| panic!("{error}"));
        let again = through_a_deck(&scene);
        assert!(meaning_of_deck(&again) == meaning_of_deck(&deck), "{}", path.display());
        assert_eq!(again.structure, scene.structure, "{}", path.display());
        let direct = through_a_deck(&deck);
        assert_eq!(direct.legacy, deck.legacy, "{}", path.display());
        assert_eq!(direct.structure, deck.structure, "{}", path.display());
        assert_eq!(direct.format, Format::Nml);
    }
}

/// Distance of two points, as a share of the largest distance from O.
fn apart(a: Vec3<f64>, b: Vec3<f64>) -> f64 {
    (a - b).norm() / a.norm().max(1.0)
}

/// Whether hinges, axes, outer ends, mass centres and inertias of two scenes are in the same places at the
/// start and when all is locked, whatever axes their bodies have.
fn are_alike(one: &Scene, other: &Scene) {
    let scenes = [one, other];
    // Every body adds products of rotations, each rounded by some 1e-16.
    let rounding = 1e-14 * one.bodies.len() as f64;
    for posture in [Posture::at_start, Posture::locked] {
        let [ours, theirs] = scenes.map(|scene| posture(scene).hinges);
        assert_eq!(ours.len(), theirs.len());
        for (i, (a, b)) in ours.iter().zip(&theirs).enumerate() {
            let [m, n] = scenes.map(|scene| scene.bodies[i].mass_properties);
            let misses = [
                apart(a.point, b.point),
                apart(a.axis, b.axis),
                apart(a.tip, b.tip),
                apart(a.kick_off, b.kick_off),
                apart(a.body_axes * m.center_of_mass, b.body_axes * n.center_of_mass),
            ];
            assert!(misses.into_iter().all(|miss| miss < rounding), "{i}: {misses:?}");
            let [m, n] = [m.inertia.rotated(&a.body_axes), n.inertia.rotated(&b.body_axes)];
            assert!((m - n).largest_entry() < rounding * m.largest_entry(), "{i}");
        }
    }
}

/// Bodies get other axes in a deck, and are where they were.
#[test]
fn bodies_of_examples_are_where_they_were() {
    let mut told = 0;
    for path in files("examples", "toml") {
        let file = read_scene(&path).unwrap_or_else(|error| panic!("{error}"));
        let Ok(deck) = write_deck(&file) else { continue };
        told += 1;
        assert!(deck.left_out.iter().any(|what| what.starts_with("names of bodies")));
        assert!(deck.text.contains("! Segment 1: "), "{}", deck.text);
        let again = through_a_deck(&file);
        let messages: Vec<String> = again.warnings.iter().map(ToString::to_string).collect();
        assert_eq!(messages, Vec::<String>::new());
        are_alike(&file.scene, &again.scene);
    }
    assert_eq!(told, 4, "boom, cubesat, n-boom and wing; the others have what decks cannot say");
}

/// The scene with other axes of its bodies.
fn with_other_axes(scene: &Scene, seed: f64) -> Scene {
    let mut description = (**scene).clone();
    let turns: Vec<Mat3<f64>> = (0..scene.bodies.len())
        .map(|i| seed + i as f64)
        .map(|t| Mat3::from_euler_121(7.0 * t.sin(), 5.0 * (2.0 * t).cos(), 3.0 * t.cos()))
        .collect();
    for (turn, body) in turns.iter().zip(&mut description.bodies) {
        let inboard = body.inboard.map_or_else(Mat3::identity, |inboard| turns[inboard]);
        let mount = &mut body.mount;
        mount.point = inboard * mount.point;
        mount.rot_inboard_from_hinge = inboard * mount.rot_inboard_from_hinge * turn.transpose();
        body.axis = *turn * body.axis;
        body.tip = *turn * body.tip;
        body.mass_properties.center_of_mass = *turn * body.mass_properties.center_of_mass;
        body.mass_properties.inertia = body.mass_properties.inertia.rotated(turn);
        if let Some(spring) = &mut body.hinge.kick_off {
            spring.body_point = *turn * spring.body_point;
        }
    }
    Scene::new(description).expect("the bodies are those of the scene")
}

/// A deck's appendages may be written along any axes.
#[test]
fn axes_of_bodies_do_not_matter() {
    for path in decks() {
        let deck = read_scene(&path).unwrap_or_else(|error| panic!("{error}"));
        for seed in [0.3, 1.7] {
            let scene = with_other_axes(&deck.scene, seed);
            let turned = SceneFile { scene, structure: None, ..deck.clone() };
            let again = through_a_deck(&turned);
            are_alike(&deck.scene, &turned.scene);
            are_alike(&turned.scene, &again.scene);
        }
    }
}

#[test]
fn paddles_come_last_and_releases_follow_them() {
    let arm = body("arm", "", "state = \"held\"");
    let paddle = on("arm", "paddle", "").replace("\"x\"", "\"y\"");
    let boom = body("boom", "", "release = { when = \"paddle\", passes_deg = 10.0 }");
    let file = right(&(BUS.to_owned() + &arm + &paddle + &boom));
    let deck = write_deck(&file).expect("a deck has chains and paddles");
    assert!(deck.left_out.iter().any(|what| what.starts_with("the order of appendages")));
    let hinges = through_a_deck(&file).scene.bodies.clone();
    let angle = 10_f64.to_radians();
    assert_eq!(hinges[0].hinge.release, Release::Angle { hinge: 2, angle });
    let axes: Vec<Vec3<f64>> = hinges.iter().map(|body| body.axis).collect();
    assert_eq!(axes, [Vec3::unit_x(), Vec3::unit_x(), Vec3::unit_y()]);
}

/// What is said of these bodies on a bus, in one line each.
fn obstacles(bodies: &str) -> Vec<String> {
    let file = right(&(BUS.to_owned() + bodies));
    let obstacles = write_deck(&file).expect_err("no deck can say it");
    obstacles.iter().map(ToString::to_string).collect()
}

/// A body on another one, at the end of it.
fn on(inboard: &str, name: &str, hinge: &str) -> String {
    body(name, &format!("on = \"{inboard}\""), hinge)
}

#[test]
fn what_a_deck_cannot_say_is_told_of_every_body() {
    let two = body("a", "", "state = \"held\"");
    let aslant = |text: String| text.replace("axis = \"x\"", "axis = [1.0, 1.0, 0.0]");
    let moved =
        |text: String, at: &str| text.replace("at = [0.0, 2.0, 0.0]", &format!("at = {at}"));
    let cases = [
        (
            two.clone() + &on("a", "b", "") + &on("a", "c", ""),
            "`a`: on: found `b`, `c` on it, expected one body",
        ),
        (
            two.clone() + &aslant(on("a", "b", "")),
            "`b`: hinge.axis: found an axis at 45 deg to that of the inboard hinge, expected 0, as in a chain, or 90 for a paddle",
        ),
        (
            two.clone() + &on("a", "b", "").replace("\"x\"", "\"-x\""),
            "`b`: hinge.axis: found an axis at 180 deg",
        ),
        (
            two.clone() + &on("a", "b", "") + &on("b", "c", "").replace("\"x\"", "\"y\""),
            "`c`: hinge.axis: found an axis at 90 deg to that of the inboard hinge, expected 0: hinge axes of a chain are parallel, and a paddle hangs on a single arm",
        ),
        (
            two.clone() + &moved(on("a", "b", ""), "[0.5, 2.0, 0.0]"),
            "`b`: hinge.at: found it 0.5 along the hinge axis, expected 0",
        ),
        (
            two.clone() + &on("a", "b", "") + &moved(on("b", "c", ""), "[0.0, 0.0, 2.0]"),
            "`c`: hinge.at: found the way to it at 90 deg to the body inboard at angle zero, expected 0",
        ),
        (
            two.clone() + &moved(on("a", "b", ""), "[0.0, 2.0, 0.5]").replace("\"x\"", "\"y\""),
            "`b`: hinge.at: found it off the line along its axis outward from the arm's hinge",
        ),
        (
            body("a", "", "torque_deg = [[0.0, 1.0], [90.0, 0.0]]"),
            "`a`: hinge.torque: found a torque over the angle, expected springs and dampers only",
        ),
        (body("a", "", "friction = 0.5"), "`a`: hinge.friction: found friction, expected none"),
        (body("a", "", "stops_deg = [-inf, 5]"), "`a`: hinge.stops: found stops, expected none"),
        (
            two.clone() + &body("b", "", "release = { after = \"a\", by = 2.0 }"),
            "`b`: hinge.release: found a release after a lock-up, expected one at a time or by an angle",
        ),
        (
            body("a", "", "latch_deg = 2e6"),
            "`a`: hinge.latch: found 2000000, expected less than 1e6, which in a deck means never",
        ),
    ];
    for (bodies, expected) in cases {
        let told = obstacles(&bodies);
        assert!(told.len() == 1 && told[0].starts_with(expected), "{told:#?}\n{expected}");
    }
    let many = body("a", "", "torque_deg = [[0.0, 1.0], [90.0, 0.0]]\nlatch_deg = 1e6")
        + &body("b", "", "release = { after = \"a\" }");
    assert_eq!(obstacles(&many).len(), 3);
}

#[test]
fn stations_that_a_deck_cannot_say_are_told() {
    let steel = "\n[materials.steel]\nyoungs_modulus = 1.0\n";
    let strength = "material = \"steel\"\npulse_constant = 0.1";
    let tube = "{ tube = { radius = 0.1, thickness = 0.001 } }";
    let corners: Vec<String> = (0..7)
        .map(|i| std::f64::consts::TAU * f64::from(i) / 7.0)
        .map(|angle| format!("[{}, {}, 0.001]", angle.cos(), angle.sin()))
        .collect();
    let polygon = format!("{{ polygon = [{}] }}", corners.join(", "));
    let station = |at: f64, section: &str| {
        format!(
            "\n[[body.station]]\nat = {at:?}\nmass = 1.5\nmass_centre = [0.0, 1.0, 0.0]\ninertia = [0.5, 0.05, 0.5]\nsection = {section}\n"
        )
    };
    let sections = [(2.0, tube), (0.0, &polygon[..])].map(|(at, section)| station(at, section));
    let bodies =
        steel.to_owned() + &body("a", strength, "") + &sections.concat() + &body("b", "", "");
    let expected = [
        "`a`: station: found tubes and polygons on one body, expected one kind",
        "`a`: station: found a section of 7 corners, expected at most 6",
        "`b`: station: found 0 stations, expected 1 to 5 for every body of a deck with stresses",
    ];
    assert_eq!(obstacles(&bodies), expected);
    let turned = body("a", strength, "").replace("axis = \"x\"", "axis = \"z\"");
    let told = obstacles(
        &(steel.to_owned()
            + &turned
            + &sections[0]
                .replace("2.0", "0.0")
                .replace("1.5", "3.0")
                .replace("[0.5, 0.05, 0.5]", "[1.0, 0.1, 1.0]")),
    );
    assert!(
        told.len() == 1
            && told[0].starts_with("`a`: station: found stations on a body with other axes"),
        "{told:?}"
    );
}

/// Attitudes, turned axes and positions are read as they were but for rounding.
#[test]
fn a_turned_main_body_is_where_it_was() {
    let text = BUS.to_owned()
        + "\n[initial]\nattitude = { turn = { about = [1.0, 2.0, -3.0], by_deg = 77.0 } }\n\
           rate_rad = [0.1, -0.2, 0.3]\nposition = [1.0, 2.0, 3.0]\nvelocity = [-0.4, 0.5, 0.6]\n\
           \n[gravity]\nacceleration = 0.7\nup = [1.0, -2.0, 0.5]\n\
           \n[thrust]\nforce = [1.0, 2.0, 3.0]\npoint = [0.1, 0.2, 0.3]\nfrom = 1.0\nuntil = 2.0\n";
    let file = right(&text);
    let [before, after] = [file.scene.clone(), through_a_deck(&file).scene];
    let (a, b) = (&before.initial, &after.initial);
    let vectors = [
        (a.attitude.vector, b.attitude.vector),
        (a.omega_body, b.omega_body),
        (a.position_inertial, b.position_inertial),
        (a.velocity_inertial, b.velocity_inertial),
        (before.gravity.expect("given").up, after.gravity.expect("given").up),
        (before.externals[0].amount, after.externals[0].amount),
    ];
    for (a, b) in vectors {
        assert!((a - b).norm() <= 2e-15 * a.norm(), "{a:?}, {b:?}");
    }
}

#[test]
fn times_that_a_deck_takes_for_never_are_those_that_never_come() {
    let late = |release: f64, end: f64| {
        let text = BUS.replace("end = 10.0", &format!("end = {end:?}"));
        right(&(text + &body("a", "", &format!("release = {{ at = {release:?} }}\nlatch_deg = 0"))))
    };
    // After the end of the run.
    let read = through_a_deck(&late(3e6, 10.0));
    assert!(!read.scene.bodies[0].hinge.can_turn() && read.warnings.is_empty());
    let read = through_a_deck(&late(4e6, 3e6));
    assert!(!read.scene.bodies[0].hinge.can_turn() && read.warnings.is_empty());
    assert!(write_deck(&late(2e6, 3e6)).is_err());
}

#[test]
fn times_long_before_the_start_are_times_of_a_deck() {
    let text = BUS.replace("end = 10.0", "start = -3e6\nend = 10.0");
    let file = right(&(text + &body("a", "", "release = { at = -2e6 }\nlatch_deg = 0")));
    let read = through_a_deck(&file);
    assert_eq!(read.scene.bodies[0].hinge.release, Release::Time(-2e6));
}
