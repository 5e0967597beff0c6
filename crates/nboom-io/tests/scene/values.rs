//! Rotors, slides and couplings: what they mean, and what is said of wrong ones.

use nboom_io::words::{body as body_of, main_body, rotor, scene, slide};
use nboom_io::{write_deck, write_scene};
use nboom_model::{Quantity, RotorSpeed};
use nboom_scalar::Vec3;

use super::{BUS, body, read, right, wrong};

const ROTOR: &str = "\n[[main_body.rotor]]\naxis = \"y\"\ninertia = 0.05\n";

/// A mast that slides, and these lines about it.
fn mast(lines: &str) -> String {
    body("mast", "", lines).replacen("[body.hinge]", "[body.slide]", 1)
}

/// Two booms, of which the first has a coupling with these lines.
fn coupled(lines: &str) -> String {
    let coupling = format!("\n[[body.coupling]]\n{lines}");
    body("one", "", "") + &coupling + &body("two", "", "")
}

/// Each text is refused with such words.
fn told(cases: &[(String, &str)]) {
    for (text, words) in cases {
        let found = wrong(&(BUS.to_owned() + text));
        assert!(found.iter().any(|line| line.contains(words)), "{words}: {found:#?}");
    }
}

#[test]
fn a_rotor_has_one_speed_or_speeds_over_time() {
    let of = |speed: &str| right(&format!("{BUS}{ROTOR}{speed}\n")).scene.rotors[0].speed.clone();
    assert_eq!(of("speed_rad = 400.0"), RotorSpeed::Constant(400.0));
    assert_eq!(of("speed_deg = 180.0"), RotorSpeed::Constant(std::f64::consts::PI));
    let pi = std::f64::consts::PI;
    let table = RotorSpeed::Table(vec![[0.0, 0.0], [2.5, pi]]);
    assert_eq!(of("speed_over_time_deg = [[0, 0], [2.5, 180]]"), table);
    assert_eq!(of("speed_over_time_rad = [[1, 3]]"), RotorSpeed::Table(vec![[1.0, 3.0]]));

    let words = rotor("y", 0.05).speed_over_time_deg(vec![[0.0, 0.0], [2.5, 180.0]]);
    let main = main_body().mass(100.0).inertia([40.0, 30.0, 20.0]).rotor(words);
    let arm = body_of("arm").mass(1.0).mass_centre([0.0, 1.0, 0.0]).inertia([1.0, 1.0, 1.0]);
    let arm = arm.slide(slide().at([0.0, 1.0, 0.0]).axis("z"));
    let said = scene("a").end(10.0).main_body(main).body(arm).build().expect("a scene");
    assert_eq!((said.rotors[0].speed.clone(), said.rotors[0].axis), (table, Vec3::unit_y()));
}

#[test]
fn tables_of_rotors_are_written_and_no_deck_has_them() {
    for speeds in ["deg = [[0, 0.1], [2.5, 180]]", "rad = [[0, 0.1], [2.5, 0.3]]"] {
        let file = right(&format!("{BUS}{ROTOR}speed_over_time_{speeds}\n"));
        let again = read(&write_scene(&file)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(again.scene, file.scene);
        let refused = write_deck(&file).expect_err("a deck has no rotors");
        let told: Vec<String> = refused.iter().map(ToString::to_string).collect();
        assert!(told.iter().any(|line| line.contains("found a rotor")), "{told:?}");
    }
}

#[test]
fn columns_of_rotors_have_their_numbers() {
    let columns = "\n[output]\ncolumns = [\"rotor_speed\", \"motor_torque_2\"]\n";
    let both = format!("{BUS}{ROTOR}speed_rad = 1.0\n{ROTOR}speed_rad = 2.0\n");
    let file = right(&(both + columns));
    let table = file.settings.table.expect("the scene asks for one");
    let names: Vec<String> = table.columns.iter().map(|column| column.name(&[])).collect();
    assert_eq!(names, ["rotor_speed_1", "rotor_speed_2", "motor_torque_2"]);
    assert_eq!(table.columns[2].quantity, Quantity::MotorTorque);
    told(&[(
        columns.to_owned(),
        "columns: found `rotor_speed`, expected columns of a scene without rotors",
    )]);
}

/// Bodies stand in any order, those that carry others last.
#[test]
fn rotors_are_numbered_as_they_stand_in_the_file() {
    let of_body = ROTOR.replace("main_body", "body");
    let one = |name: &str, on: &str, speed: f64| {
        body(name, on, "") + &of_body + &format!("speed_rad = {speed:?}\n")
    };
    let bodies = one("outer", "on = \"inner\"", 111.0) + &one("inner", "", 222.0);
    let file = right(&format!("{BUS}{bodies}{ROTOR}speed_rad = 7.0\n"));
    let speeds: Vec<_> = file.scene.rotors.iter().map(|rotor| rotor.speed.clone()).collect();
    assert_eq!(speeds, [7.0, 111.0, 222.0].map(RotorSpeed::Constant));
    assert_eq!(
        file.scene.rotors.iter().map(|of| of.body).collect::<Vec<_>>(),
        [None, Some(1), Some(0)]
    );
}

#[test]
fn what_is_wrong_with_a_rotor_is_told() {
    let with = |speed: &str| format!("{ROTOR}{speed}\n");
    let instead = |from: &str, to: &str| with("speed_rad = 1.0").replace(from, to);
    let both = "speed_rad = 1.0\nspeed_over_time_rad = [[0, 1]]";
    told(&[
        (with(""), "rotor: found none, expected exactly one of speed, speed_over_time"),
        (with(both), "found speed and speed_over_time, expected exactly one of"),
        (with("speed = 400.0"), "found `speed` in rotor, expected a key of this table"),
        (with("speed_rad = \"fast\""), "speed_rad: found "),
        (with("speed_over_time_rad = []"), "expected finite speeds at ascending times"),
        (with("speed_over_time_rad = [[1, 0], [1, 5]]"), "at ascending times, at least one"),
        (with("speed_over_time_rad = [[0, 0], [1e-300, 1e300]]"), "expected finite speeds"),
        (with("speed_over_time_deg = [[0, 1, 2]]"), "found a list of 3, expected a list of 2"),
        (with("speed_over_time_deg = 3"), "expected a list of lists of 2 numbers"),
        (instead("inertia = 0.05", "inertia = 0.0"), "expected a positive finite inertia"),
        (instead("inertia = 0.05", "inertia = -1.0"), "inertia -1, expected a positive finite"),
        (instead("inertia = 0.05\n", ""), "inertia: found none in rotor"),
        (instead("axis = \"y\"\n", ""), "axis: found none in rotor"),
        (instead("axis = \"y\"", "axis = [0, 0, 0]"), "axis: found "),
        (instead("[[main_body.rotor]]", "[main_body.rotor]"), "expected a list of tables"),
    ]);
    // That of the second of two, which is the last line.
    let text = BUS.to_owned() + &with("speed_rad = 1.0") + &with("speed_over_time_rad = []");
    let [error] = &wrong(&text)[..] else { panic!("one error") };
    assert!(error.contains(&format!(":{}:", text.lines().count())), "{error}");
}

#[test]
fn what_is_wrong_with_a_slide_is_told() {
    told(&[
        (mast("latch_deg = 90"), "found `latch_deg` in slide, expected a key of this table"),
        (mast("rate_deg = 3.0"), "found `rate_deg` in slide"),
        (mast("speed = 1.0\nstate = \"held\""), "speed: found "),
        (mast("start = \"far\""), "start: found "),
        (mast("spring = { rest = 1.0 }"), "stiffness: found none in slide_spring"),
        (mast("damper = { rate_squared = 1.0 }"), "found `rate_squared` in slide_damper"),
        (mast("force = [[0.0, 1.0], [0.0, 2.0]]"), "force: found "),
        (mast("torque_deg = [[0.0, 1.0]]"), "found `torque_deg` in slide"),
        (
            mast("release = { when = \"mast\", passes_deg = 3.0 }"),
            "(`passes`) of `mast`, which slides, expected a travel (`reaches`)",
        ),
        (mast("").replace("axis = \"x\"", "axis = [0, 0, 0]"), "axis: found "),
        (mast("").replace("at = [0.0, 2.0, 0.0]\n", ""), "at: found none in slide"),
        (mast("\n[body.hinge]\nat = [0.0, 2.0, 0.0]\naxis = \"x\"\n"), "hinge and slide"),
    ]);
}

#[test]
fn what_is_wrong_with_a_coupling_is_told() {
    let to_itself = wrong(&(BUS.to_owned() + &coupled("to = \"one\"")));
    assert!(!to_itself.iter().any(|line| line.contains("`one`?")), "{to_itself:?}");
    told(&[
        (coupled("stiffness = 1.0"), "to: found none in coupling"),
        (
            coupled("to = \"three\""),
            "to: found coupling to `three`, expected the name of another body",
        ),
        (
            coupled("to = \"one\"\nstiffness = 1.0"),
            "to: found coupling to `one`, expected another body",
        ),
        (coupled("to = \"two\"\nrest_length = 1.0"), "found `rest_length` of a joint that turns"),
        (coupled("to = \"two\"\nrest = 1.0"), "found `rest` in coupling"),
        (coupled("to = \"two\"\nacts_on = \"that\""), "acts_on: found `that`, expected one of"),
        (coupled("to = \"two\"\nratio = \"half\""), "ratio: found "),
        (coupled("to = \"two\"\nstifness = 1.0"), "found `stifness` in coupling"),
        (coupled("to = 2"), "to: found "),
        (
            coupled("to = \"two\"\nrest_deg = 3.0").replacen("[body.hinge]", "[body.slide]", 1),
            "found `rest` of a joint that slides, expected rest_length",
        ),
    ]);
}

#[test]
fn chains_of_parameters_have_a_limit_of_their_own() {
    let chain = |length: usize| {
        let links: String = (1..length).map(|i| format!("p{i} = \"$p{}\"\n", i + 1)).collect();
        format!("{BUS}\n[parameters]\n{links}p{length} = 1.0\n")
    };
    right(&chain(100));
    let told = wrong(&chain(101));
    let message = "found `$p101` after 100 others, expected chains of at most 100 parameters";
    assert!(told[0].contains(message), "{told:?}");
}
