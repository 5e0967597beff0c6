//! What is said of scenes in the words of a program that are wrong.

use nboom_io::words::{
    Axes, BodyWords, KickOff, Thrust, after, at, body, coupling, hinge, initial, main_body, rotor,
    scene, spring, thruster, torque,
};
use nboom_model::HingeState;

use super::words::{bus, rod, told};

#[test]
fn everything_that_is_missing_is_said_at_once() {
    let expected = [
        "scene: end: found none, expected a value",
        "main_body: mass: found none, expected a value",
        "main_body: inertia: found none, expected a value",
        "body `boom`: mass: found none, expected a value",
        "body `boom`: mass_centre: found none, expected a value",
        "body `boom`: inertia: found none, expected a value",
        "body `boom`, hinge: at: found none, expected a value",
        "body `boom`, hinge: axis: found none, expected a value",
    ];
    assert_eq!(told(scene("a").body(body("boom"))), expected);
}

#[test]
fn wrong_words_are_told() {
    let hinge = || hinge().at([0.0, 2.0, 0.0]);
    let (main_body_end, end) = ([0.0, 1.0, 0.0], [0.0, 0.5, 0.0]);
    let kick_off = KickOff { main_body_end, end, force: [1.0, 0.0, 0.0, 0.0], limit: -0.5 };
    let cases = [
        (
            bus().body(rod("a").hinge(hinge().axis("w"))),
            "body `a`, hinge: axis: found `w`, expected \"x\", \"-x\"",
        ),
        (
            bus().body(rod("a").hinge(hinge().axis([0.0, f64::NAN, 0.0]))),
            "body `a`, hinge: axis: found a vector without direction",
        ),
        (
            bus().body(rod("a").hinge(hinge().axis("x").rate_deg(1.0).release(at(1.0)))),
            "body `a`, hinge: rate: found a rate of a hinge that starts held, expected zero",
        ),
        (
            bus().body(rod("a").kick_off(kick_off).hinge(hinge().axis("x"))),
            "body `a`, kick_off: limit: found kick-off spring up to length -0.5, expected a length not below zero",
        ),
        (
            bus().body(rod("a").on("b found, c expected").hinge(hinge().axis("x"))),
            "body `a`: found inboard body `b found, c expected`, expected the name of another",
        ),
        (
            bus()
                .body(rod("a").hinge(hinge().axis("x").state(HingeState::Locked).release(at(1.0)))),
            "body `a`, hinge: release: found a release of a hinge that starts locked",
        ),
        (
            bus().body(rod("a").hinge(hinge().axis("x").axes(Axes::columns([[2.0; 3]; 3])))),
            "body `a`, hinge: axes: found axes that depart from a rotation by",
        ),
        (
            bus().initial(initial().attitude(Axes::quaternion([1.0; 4]))),
            "initial: attitude: found a quaternion of norm 2, expected norm 1",
        ),
        (bus().gravity(-9.81, "z"), "gravity: acceleration: found -9.81, expected none below zero"),
        (bus().gravity(9.81, "up"), "gravity: up: found `up`, expected"),
        (
            bus().gravity(f64::NAN, "z"),
            "gravity: acceleration: found gravity that is not finite, expected finite numbers",
        ),
        (
            bus().body(rod("a").repeat(0, "z")),
            "body `a`: repeat: found 0, expected a number of copies from 1 to 10000",
        ),
        (
            bus().body(rod("a").repeat(2, "y")),
            "body `a`: found repetition about an axis through hinge and outer end",
        ),
        (
            bus().body(rod("a").on("b")),
            "body `a`: found inboard body `b`, expected the name of another body",
        ),
        (bus().body(rod("a")).body(rod("a")), "body `a`: found name `a` of two bodies"),
        (
            bus().body(rod("")),
            "body ``: name: found ``, expected 1 to 200 bytes of text in one line",
        ),
        (
            bus().body(rod("a\nb")),
            "body `a\u{fffd}b`: name: found `a\u{fffd}b`, expected 1 to 200 bytes",
        ),
        (
            bus().body(rod("a").on("b\nc")),
            "body `a`: found inboard body `b\u{fffd}c`, expected the name of another body",
        ),
        (
            scene("../../x").end(1.0).main_body(main_body().mass(1.0).inertia([1.0; 3])),
            "scene: name: found `../../x`, expected the name of a folder: 1 to 200 bytes",
        ),
        (
            bus().body(rod("a").hinge(hinge().axis("x").release(after("b")))),
            "body `a`: found release by `b`, expected the name of another body",
        ),
    ];
    for (words, expected) in cases {
        let told = told(words);
        assert!(told.len() == 1 && told[0].starts_with(expected), "{told:?}\n{expected}");
    }
}

/// What is found when the scene is put together has its table and key, as in a file.
#[test]
fn mistakes_are_told_at_their_tables() {
    let hinge = || hinge().at([0.0, 2.0, 0.0]).axis("x");
    let wheel = || rotor("x", 0.1);
    let push = || thruster([1.0, 0.0, 0.0], [0.0; 3]);
    let main = || main_body().mass(100.0).inertia([40.0, 30.0, 20.0]);
    let beside = |body: BodyWords| bus().body(rod("other")).body(body);
    let thrust = Thrust { force: [1.0; 3], point: [0.0; 3], from: 2.0, until: 3.0 };
    let cases = [
        (
            bus().body(rod("a").mass(-1.0).repeat(3, "z")),
            "body `a`: mass: found mass -1, expected a positive finite mass",
        ),
        (
            bus().end(f64::NAN),
            "scene: end: found end time that is not finite, expected finite numbers",
        ),
        (bus().end(-1.0), "scene: end: found end time -1, expected a time not before the initial"),
        (
            bus().start(f64::NEG_INFINITY),
            "scene: start: found initial time that is not finite, expected finite numbers",
        ),
        (
            bus().start(-1e308).end(1e308),
            "scene: end: found time from the initial to the end time that is not finite",
        ),
        (
            bus().initial(initial().position([f64::NAN; 3])),
            "initial: position: found initial position that is not finite",
        ),
        (
            beside(rod("a").hinge(hinge().latch_rad(f64::NAN))),
            "body `a`, hinge: latch: found lock angle that is not finite",
        ),
        (
            beside(rod("a").hinge(hinge().spring(spring(f64::NAN)))),
            "body `a`, hinge: spring: found hinge spring that is not finite",
        ),
        (
            beside(rod("a").hinge(hinge().release(after("other").by(-1.0)))),
            "body `a`, hinge, release: by: found release -1 time units after a lock-up, expected",
        ),
        (
            beside(rod("a").hinge(hinge().torque_rad(&[[1.0, 0.0], [0.0, 1.0]]))),
            "body `a`, hinge: torque: found point 2 at 0, 1, expected two or more points",
        ),
        (
            beside(rod("a").coupling(coupling("other").stiffness(f64::NAN))),
            "body `a`: coupling: found coupling with ratio 1, stiffness NaN",
        ),
        (
            beside(rod("a").rotor(wheel()).rotor(rotor("x", -1.0))),
            "body `a`, rotor 2: inertia: found inertia -1, expected a positive finite inertia",
        ),
        (
            bus().main_body(main().rotor(wheel().speed_over_time_rad(vec![]))),
            "main_body, rotor 1: speed_over_time: found times and speeds [], expected",
        ),
        (
            bus().main_body(main().rotor(rotor("w", 1.0))),
            "main_body, rotor 1: axis: found `w`, expected",
        ),
        (
            bus().thrust(Thrust { until: 1.0, ..thrust }),
            "thrust: until: found thrust from 2 to 1, expected an end not before its start",
        ),
        (
            bus().main_body(main().external(push().from(2.0).until(1.0))).thrust(thrust),
            "main_body, thruster 1: until: found thrust from 2 to 1, expected",
        ),
        (
            beside(rod("a").external(push()).external(torque([1.0; 3]).over_time(vec![]))),
            "body `a`, torque 1: over_time: found torque over 0 points, expected two or more",
        ),
    ];
    for (words, expected) in cases {
        let told = told(words);
        assert!(told.len() == 1 && told[0].starts_with(expected), "{told:?}\n{expected}");
    }
}
