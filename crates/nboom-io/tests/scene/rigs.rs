//! Main bodies that are fixed or driven.

use nboom_io::words::{body, drive, hinge, main_body, scene};
use nboom_io::{write_deck, write_scene};
use nboom_model::{Base, Drive, DrivePoint};
use nboom_scalar::Vec3;

use super::{BUS, read, right, wrong};

const DRIVEN: &str = "
[main_body.drive]
axis = \"z\"
rate_deg = [[0.0, 0.0], [4.0, 180.0]]
speed = [[1.0, 0.5], [2.0, 1.5]]
";

fn driven() -> Base {
    let pi = std::f64::consts::PI;
    let points = [(0.0, 0.0, 0.5), (1.0, 0.25 * pi, 0.5), (2.0, 0.5 * pi, 1.5), (4.0, pi, 1.5)];
    let point = |(time, rate, speed)| DrivePoint { time, rate, speed };
    Base::Driven(Drive { axis: Vec3::unit_z(), points: points.map(point).to_vec() })
}

#[test]
fn a_main_body_is_free_fixed_or_driven() {
    assert_eq!(right(BUS).scene.base, Base::Free);
    let fixed = right(&format!("{BUS}base = \"fixed\"\n"));
    assert_eq!(fixed.scene.base, Base::Fixed);
    let file = right(&(BUS.to_owned() + DRIVEN));
    assert_eq!(file.scene.base, driven());
    // It starts as it is driven.
    assert_eq!(file.scene.initial.omega_body, Vec3::zero());
    assert_eq!(file.scene.initial.velocity_inertial, Vec3::unit_z() * 0.5);
    for file in [fixed, file] {
        let again = read(&write_scene(&file)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again.scene, file.scene);
        assert!(write_deck(&file).is_err());
    }
}

/// A drive that a study varies is that of the written scene.
#[test]
fn a_written_rig_starts_as_it_is_driven_whatever_that_is() {
    let written = write_scene(&right(&(BUS.to_owned() + DRIVEN)));
    let (drive, rest) = written.split_once("[initial]").expect("an initial state");
    assert!(drive.contains("0.5"), "{drive}");
    let faster = format!("{}[initial]{rest}", drive.replace("0.5", "0.75"));
    let file = read(&faster).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(file.scene.initial.velocity_inertial, Vec3::unit_z() * 0.75);
}

#[test]
fn words_say_the_same() {
    let bus = || main_body().mass(100.0).inertia([40.0, 30.0, 20.0]);
    let arm = || {
        let place = hinge().at([0.0, 1.0, 0.0]).axis("z");
        body("arm").mass(1.0).mass_centre([0.0, 1.0, 0.0]).inertia([1.0, 1.0, 1.0]).hinge(place)
    };
    let of = |main| scene("a").end(10.0).main_body(main).body(arm()).build().expect("a scene");
    assert_eq!(of(bus().fixed()).base, Base::Fixed);
    let rate = vec![[0.0, 0.0], [4.0, 180.0]];
    let drive = drive("z").rate_deg(rate).speed(vec![[1.0, 0.5], [2.0, 1.5]]);
    let driven_scene = of(bus().driven(drive));
    assert_eq!(driven_scene.base, driven());
    assert_eq!(driven_scene.initial.velocity_inertial, Vec3::unit_z() * 0.5);
}

#[test]
fn what_is_wrong_with_a_rig_is_told_at_its_place() {
    let rows = |text: &str| wrong(&(BUS.to_owned() + text));
    for (text, words) in [
        ("base = \"fixd\"\n", "base: found `fixd`, expected one of free, fixed"),
        ("base = \"fixed\"\n[initial]\nrate_deg = [0, 0, 1]\n", "rate_deg: "),
        ("base = \"fixed\"\n[initial]\nvelocity = [0, 0, 1]\n", "velocity: "),
        (&format!("base = \"fixed\"\n{DRIVEN}"), "found `drive` beside `base`"),
        (&format!("{DRIVEN}[initial]\nvelocity = [0, 0, 0.6]\n"), "velocity: "),
        ("[main_body.drive]\naxis = \"z\"\n", "drive: "),
        ("[main_body.drive]\naxis = \"z\"\nspeed = [[1, 0], [0, 1]]\n", "ascending times"),
        (
            &format!("{DRIVEN}[gravity]\nacceleration = 9.8\nup = \"x\"\n"),
            "gravity across its axis",
        ),
        (
            "[output]\ncolumns = [\"reaction_force\"]\n",
            ":12: columns: found `reaction_force`, expected columns of a main body that moves freely",
        ),
    ] {
        let found = rows(text);
        assert!(found.iter().any(|line| line.contains(words)), "{words}: {found:#?}");
    }
}
