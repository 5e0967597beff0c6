//! Scenes as decks: what survives, and what is said of scenes that no deck can say.

use nboom_io::{Format, SceneFile, parse_deck, read_scene, write_deck, write_scene};
use nboom_model::{Posture, SceneDescription};
use nboom_scalar::Vec3;

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
        for posture in [Posture::at_start, Posture::locked] {
            let pair = [&file.scene, &again.scene].map(|scene| posture(scene).hinges);
            for (i, (a, b)) in pair[0].iter().zip(&pair[1]).enumerate() {
                let bodies =
                    [&file.scene, &again.scene].map(|scene| scene.bodies[i].mass_properties);
                let centers = [
                    a.body_axes * bodies[0].center_of_mass,
                    b.body_axes * bodies[1].center_of_mass,
                ];
                let misses = [
                    apart(a.point, b.point),
                    apart(a.axis, b.axis),
                    apart(a.tip, b.tip),
                    apart(a.kick_off, b.kick_off),
                    apart(centers[0], centers[1]),
                ];
                assert!(misses.into_iter().all(|miss| miss < 1e-14), "{misses:?}");
                let inertias = [
                    bodies[0].inertia.rotated(&a.body_axes),
                    bodies[1].inertia.rotated(&b.body_axes),
                ];
                let miss = (inertias[0] - inertias[1]).largest_entry();
                assert!(miss < 1e-14 * inertias[0].largest_entry());
            }
        }
    }
    assert_eq!(told, 3, "all examples but the gimbal, which has a torque over the angle");
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
        (
            two.clone() + &body("b", "", "release = { after = \"a\", by = 2.0 }"),
            "`b`: hinge.release: found a release after a lock-up, expected one at a time or by an angle",
        ),
        (
            body("a", "", "latch_deg = 2e6"),
            "`a`: hinge.latch: found 2000000, expected less than 1e6, which in a deck means never",
        ),
        (
            body(
                "a",
                "kick_off = { main_body_end = [0, 0, 0], end = [0, 1, 0], force = [1, 0, 0, 0], limit = -1 }",
                "",
            ),
            "`a`: kick_off.limit: found a limit of -1, expected none below zero",
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
        (before.thrust.expect("given").force, after.thrust.expect("given").force),
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
