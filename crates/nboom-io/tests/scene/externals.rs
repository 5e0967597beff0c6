//! Forces and torques from outside.

use nboom_io::words::{self, thruster, torque};
use nboom_io::{write_deck, write_scene};
use nboom_model::{Course, External, ExternalAxes, ExternalKind};
use nboom_scalar::Vec3;

use super::{BUS, body, read, right, wrong};

const THRUSTERS: &str = "
[[main_body.thruster]]
force = [1.0, 2.0, 3.0]
point = [0.1, 0.2, 0.3]
axes = \"inertial\"
from = 1.0

[[main_body.torque]]
torque = [0.0, 0.5, 0.0]
over_time = [[0.5, 0], [1, \"2 * 0.5\"], [4.0, -1.0]]

[[body]]
name = \"panel\"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]
repeat = { count = 2, about = \"x\" }

[body.hinge]
at = [0.0, 2.0, 0.0]
axis = \"x\"

[[body.thruster]]
force = [0.0, 0.0, 5.0]
point = [0.0, 2.0, 0.0]
from = 0.5
until = 2.5
";

fn expected() -> [External; 4] {
    let thrust = External::thrust(Vec3::unit_z() * 5.0, Vec3::unit_y() * 2.0, [0.5, 2.5]);
    let first = External {
        axes: ExternalAxes::Inertial,
        ..External::thrust(Vec3::new(1.0, 2.0, 3.0), Vec3::new(0.1, 0.2, 0.3), [1.0, f64::INFINITY])
    };
    let torque = External {
        body: None,
        kind: ExternalKind::Torque,
        amount: Vec3::unit_y() * 0.5,
        axes: ExternalAxes::Body,
        point: Vec3::zero(),
        course: Course::Table(vec![[0.5, 0.0], [1.0, 1.0], [4.0, -1.0]]),
    };
    let [one, two] = [0, 1].map(|i| External { body: Some(i), ..thrust.clone() });
    [first, torque, one, two]
}

#[test]
fn they_act_on_their_bodies_and_on_copies_of_them() {
    let file = right(&(BUS.to_owned() + THRUSTERS));
    assert_eq!(file.scene.externals, expected());
    let again = right(&write_scene(&file));
    assert_eq!(again.scene.externals, expected());
}

#[test]
fn words_mean_what_the_text_means() {
    let panel = words::body("panel").mass(3.0).mass_centre([0.0, 1.0, 0.0]);
    let panel = panel.inertia([1.0, 0.1, 1.0]).repeat(2, "x");
    let hinge = words::hinge().at([0.0, 2.0, 0.0]).axis("x");
    let push = thruster([0.0, 0.0, 5.0], [0.0, 2.0, 0.0]).from(0.5).until(2.5);
    let first = thruster([1.0, 2.0, 3.0], [0.1, 0.2, 0.3]).along_inertial_axes().from(1.0);
    let second = torque([0.0, 0.5, 0.0]).over_time(vec![[0.5, 0.0], [1.0, 1.0], [4.0, -1.0]]);
    let bus = words::main_body().mass(100.0).inertia([40.0, 30.0, 20.0]);
    let scene = words::scene("a").end(10.0).main_body(bus.external(first).external(second));
    let scene = scene.body(panel.hinge(hinge).external(push)).build().expect("a right scene");
    assert_eq!(scene.externals, expected());
}

#[test]
fn a_thrust_is_a_thruster_of_the_main_body() {
    let short = "\n[thrust]\nforce = [1, 0, 0]\npoint = [0, 1, 0]\nfrom = 1\nuntil = 2\n";
    let long = short.replace("[thrust]", "[[main_body.thruster]]");
    let [short, long] = [short, &long].map(|text| right(&(BUS.to_owned() + text)).scene);
    assert_eq!(short.externals, long.externals);
}

#[test]
fn what_is_wrong_with_one_is_told_at_its_place() {
    let ok = "force = [0, 0, 1]\npoint = [0, 0, 0]\n";
    let torque = "\n[[main_body.torque]]\ntorque = [0, 0, 1]\n";
    let thrusters = |more: &str| format!("\n[[main_body.thruster]]\n{ok}{more}\n");
    for (text, expected) in [
        (
            thrusters("from = 2\nuntil = 1"),
            "a.toml:13:9: until: found thrust from 2 to 1, expected",
        ),
        (
            thrusters("") + torque + "over_time = [[0, 1], [0, 2]]",
            "a.toml:16:13: over_time: found torque point 2 at 0, 2, expected two or more points",
        ),
        (
            thrusters("over_time = [[0, 1]]"),
            "a.toml:12:13: over_time: found thrust over 1 points, expected two or more points",
        ),
        (
            thrusters("from = 1\nover_time = [[0, 1], [1, 2]]"),
            "a.toml:12:8: from: found `from` beside over_time, expected one of them",
        ),
        (
            format!("\n[[main_body.thruster]]\n{ok}axes = \"inertia\"\n"),
            "a.toml:12:8: axes: found `inertia`, expected one of body, inertial; did you mean \
             `inertial`?",
        ),
        (
            torque.to_owned() + &body("a", "", "") + "\n[[body.thruster]]\nforce = [0, 0, 1]\n",
            "a.toml:24:1: point: found none in thruster, expected",
        ),
        (thrusters("over_time = [[0, 1, 2]]"), "expected a list of 2 numbers"),
    ] {
        let told = wrong(&(BUS.to_owned() + &text));
        assert!(told.len() == 1 && told[0].contains(expected), "{expected}\n{told:#?}\n{text}");
    }
}

#[test]
fn a_deck_has_one_thrust_of_the_main_body() {
    let file = right(&(BUS.to_owned() + THRUSTERS));
    let told: Vec<String> =
        write_deck(&file).expect_err("no deck").iter().map(ToString::to_string).collect();
    let expected = "expected at most one force, fixed in the main body and constant while it is on";
    for found in [
        "main_body: thruster: found a force along inertial axes",
        "main_body: torque: found a torque from outside",
        "`panel 1`: thruster: found a force on a hinged body",
        "`panel 2`: thruster: found a force on a hinged body",
    ] {
        assert!(told.contains(&format!("{found}, {expected}")), "{found}\n{told:#?}");
    }
    let thruster = "\n[[main_body.thruster]]\nforce = [1, 0, 0]\npoint = [0, 1, 0]\n";
    let always = right(&(BUS.to_owned() + thruster));
    assert!(write_deck(&always).expect("a deck").text.contains("FT="));
    assert!(
        read(&(BUS.to_owned() + thruster + thruster)).is_ok_and(|two| write_deck(&two).is_err())
    );
}
