//! Stops of hinges and slides: what they mean, how they are written, and what is said of wrong ones.

use std::f64::consts::PI;

use nboom_io::words::{body as body_of, hinge, main_body, scene, slide};
use nboom_io::{Format, ReadOptions, SceneDocument, SceneFile, schema, write_scene};
use nboom_model::Stops;

use super::idle::warnings;
use super::{BUS, body, right, wrong};

const NO_STOP: f64 = f64::INFINITY;

fn boom(hinge: &str) -> String {
    BUS.to_owned() + &body("boom", "", hinge)
}

fn mast(slide: &str) -> String {
    boom(slide).replacen("[body.hinge]", "[body.slide]", 1)
}

fn stops(file: &SceneFile) -> Stops {
    file.scene.bodies[0].hinge.stops
}

#[test]
fn stops_are_angles_or_travels_and_infinite_ones_are_none() {
    let from = |text: String| stops(&right(&text));
    let with = |lower, upper| Stops { lower, upper, restitution: 0.0 };
    assert_eq!(from(boom("")), Stops::NONE);
    assert_eq!(from(boom("stops_rad = [-0.5, 1.5]")), with(-0.5, 1.5));
    let [lower, upper] = [-30.0_f64, 95.0].map(f64::to_radians);
    assert_eq!(from(boom("stops_deg = [-30, 95.0]")), with(lower, upper));
    assert_eq!(from(boom("stops_deg = [-inf, 95]")), with(-NO_STOP, upper));
    assert_eq!(
        from(boom("stops_rad = [-0.5, inf]\nrestitution = 0.25")),
        Stops { restitution: 0.25, ..with(-0.5, NO_STOP) }
    );
    // Those of a slide are lengths.
    assert_eq!(from(mast("stops = [0, 1.25]")), with(0.0, 1.25));
    assert_eq!(
        from(mast("stops = [0, +inf]\nrestitution = 1")),
        Stops { restitution: 1.0, ..with(0.0, NO_STOP) }
    );
    // A start and a latch at a stop are at it to the last bit.
    let file = right(&boom("start_deg = 77.7\nlatch_deg = -3.3\nstops_deg = [-3.3, 77.7]"));
    let hinge = file.scene.bodies[0].hinge;
    assert!(hinge.stops.at(hinge.start.angle).is_some());
    assert!(hinge.stops.at(hinge.lock_angle.expect("given")).is_some());
}

#[test]
fn expressions_may_stand_in_stops() {
    let text = "[parameters]\nend = 30.0\n".to_owned()
        + &boom("stops_deg = [\"-$end / 2\", \"$end\"]\nrestitution = \"$end / 100\"");
    let [lower, upper] = [-15.0_f64, 30.0].map(f64::to_radians);
    assert_eq!(stops(&right(&text)), Stops { lower, upper, restitution: 0.3 });
}

#[test]
fn wrong_stops_are_told_at_their_place() {
    let hinges = [
        (
            "stops_deg = [90, -30]",
            "stops_deg: found stops at 90 deg and -30 deg, expected the lower",
        ),
        ("stops_deg = [10, 10]", "stops_deg: found stops at 10 deg and 10 deg"),
        ("stops_rad = [inf, inf]", "stops_rad: found stops at inf deg and inf deg"),
        (
            "stops_deg = [10, inf]",
            "stops_deg: found stops at 10 deg and inf deg, expected the start, 0 deg, between them",
        ),
        ("stops_deg = [-5, 5]\nlatch_deg = 6", "expected the latch, 6 deg, between them"),
        ("stops_deg = [nan, 5]", "stops_deg: found NaN, expected a finite number"),
        ("stops_deg = [\"1 / 0\", 5]", "stops_deg: found inf, expected a finite number"),
        ("stops_deg = [-5, 5, 6]", "stops_deg: found a list of 3, expected a list of 2 numbers"),
        ("stops_deg = 5", "stops_deg: found a number, expected a list of 2 numbers"),
        ("stops_deg = [-5, true]", "stops_deg: found true or false, expected a number"),
        (
            "stops = [-5, 5]",
            "stops: found `stops` in hinge, expected a key of this table; did you mean `stops_deg`?",
        ),
    ];
    let of_hinges = hinges.map(|(line, words)| (boom(line), line, words));
    let slides = [
        (
            "stops = [1, 0]",
            "stops: found stops at 1 and 0, expected the lower one first, and below the upper one",
        ),
        (
            "stops = [0.5, 1]",
            "stops: found stops at 0.5 and 1, expected the start, 0, between them",
        ),
        ("stops_deg = [0, 1]", "stops_deg: found `stops_deg` in slide"),
    ];
    let of_slides = slides.map(|(line, words)| (mast(line), line, words));
    let shares = ["-0.1", "1.5"].map(|share| format!("stops_deg = [-5, 5]\nrestitution = {share}"));
    let of_shares = shares
        .each_ref()
        .map(|lines| (boom(lines), lines.as_str(), "restitution: found restitution"));
    for (text, line, words) in of_hinges.into_iter().chain(of_slides).chain(of_shares) {
        let told = wrong(&text);
        let key = if words.starts_with("restitution") { "restitution" } else { "stops" };
        let number = 1 + text.lines().position(|line| line.starts_with(key)).expect("it is there");
        let place = format!("a.toml:{number}:");
        assert!(
            told.len() == 1 && told[0].contains(words) && told[0].contains(&place),
            "{line}: {told:?}"
        );
    }
    let told = wrong(&boom("stops_deg = [-5, 5]\nrestitution = inf"));
    assert!(told.len() == 1 && told[0].contains("expected a finite number"), "{told:?}");
    // Only stops may be infinite.
    for line in ["latch_deg = inf", "start_deg = -inf", "torque_deg = [[0, 1], [inf, 1]]"] {
        let told = wrong(&boom(line));
        assert!(told.len() == 1 && told[0].contains("expected a finite number"), "{told:?}");
    }
}

#[test]
fn stops_that_are_none_are_told() {
    let told = |hinge: &str| warnings(&boom(hinge), &[]);
    for lines in ["stops_deg = [0, 90]\nrestitution = 0.5", "stops_deg = [-inf, 90]"] {
        assert_eq!(told(lines), [""; 0]);
    }
    let without =
        "a.toml:19:15: restitution: found a restitution without stops, expected stops beside it";
    let found = told("restitution = 0.5");
    assert!(found.len() == 1 && found[0].contains(without), "{found:?}");
    let neither = "stops_rad: found stops on neither side, expected a number on one side at least";
    let found = told("stops_rad = [-inf, inf]");
    assert!(found.len() == 1 && found[0].contains(neither), "{found:?}");
}

#[test]
fn stops_of_a_joint_that_never_moves_are_told() {
    let joints = [
        ("stops_deg = [-5, 90]", boom as fn(&str) -> String, "hinge"),
        ("stops = [-1, 2]", mast, "slide"),
    ];
    for (stops, text, joint) in joints {
        let told = |lines: &str| warnings(&text(&format!("{stops}\n{lines}")), &[]);
        for lines in ["", "state = \"free\"", "release = { at = 1.0 }"] {
            assert_eq!(told(lines), [""; 0], "{lines}");
        }
        let key = stops.split(' ').next().expect("a key");
        let expected = format!(
            "{key}: found stops of a {joint} that never moves, expected one that starts free or is released"
        );
        for state in ["held", "locked"] {
            let found = told(&format!("state = \"{state}\""));
            assert!(found.len() == 1 && found[0].contains(&expected), "{state}: {found:?}");
        }
    }
}

#[test]
fn stops_survive_being_written() {
    for text in [
        boom("stops_deg = [-12.5, 90]\nrestitution = 0.3"),
        boom("stops_rad = [-0.1, inf]"),
        boom("stops_deg = [-inf, 0]"),
        boom(&format!("stops_rad = [-1e-17, {:?}]", PI * 0.77)),
        boom("restitution = 0.5"),
        mast("stops = [-0.25, 1e-30]\nrestitution = 1"),
        mast("stops = [-inf, 3]"),
    ] {
        let file = right(&text);
        let written = write_scene(&file);
        let again = right(&written);
        assert_eq!(*again.scene, *file.scene, "{written}");
        assert_eq!(write_scene(&again), written);
    }
    let written = write_scene(&right(&boom("stops_deg = [-inf, 90]\nrestitution = 0.3")));
    assert!(written.contains("\nstops_deg = [-inf, 90.0]\nrestitution = 0.3\n"), "{written}");
    assert!(!write_scene(&right(&boom(""))).contains("stops"));
}

#[test]
fn words_say_the_same_as_texts() {
    let bus = || main_body().mass(100.0).inertia([40.0, 30.0, 20.0]);
    let arm = || body_of("boom").mass(3.0).mass_centre([0.0, 1.0, 0.0]).inertia([1.0, 0.1, 1.0]);
    let hinge = || hinge().at([0.0, 2.0, 0.0]).axis("x");
    let slide = || slide().at([0.0, 2.0, 0.0]).axis("x");
    for (words, text) in [
        (
            arm().hinge(hinge().stops_deg([-30.0, 95.0]).restitution(0.25)),
            boom("stops_deg = [-30, 95]\nrestitution = 0.25"),
        ),
        (
            arm().hinge(hinge().restitution(0.25).stops_rad([f64::NEG_INFINITY, 0.5])),
            boom("stops_rad = [-inf, 0.5]\nrestitution = 0.25"),
        ),
        (
            arm().slide(slide().stops([0.0, NO_STOP]).restitution(0.5)),
            mast("stops = [0, inf]\nrestitution = 0.5"),
        ),
    ] {
        let built = scene("a").end(10.0).main_body(bus()).body(words).build();
        let built = built.unwrap_or_else(|errors| panic!("{errors}"));
        assert_eq!(*built, *right(&text).scene, "{text}");
    }
    let wrong =
        scene("a").end(10.0).main_body(bus()).body(arm().hinge(hinge().stops_deg([10.0, 20.0])));
    let wrong = wrong.build();
    let told = wrong.expect_err("it starts outside").to_string();
    assert!(told.contains("`boom`") && told.contains("the start, 0 deg, between them"), "{told}");
}

#[test]
fn numbers_of_stops_can_be_set() {
    let text = boom("stops_deg = [-inf, 90]\nrestitution = 0.3");
    let read = |text: &str| {
        let source = ("a.toml", text);
        SceneDocument::of_text(Format::Toml, source, "a", None, &ReadOptions::default())
    };
    let document = read(&text).unwrap_or_else(|error| panic!("{error}"));
    let slot = |path: &str| document.slot(path).unwrap_or_else(|error| panic!("{error}"));
    let paths = ["stops_deg[1]", "stops_deg[2]", "restitution"];
    let [lower, upper, share] = paths.map(|path| slot(&format!("body.boom.hinge.{path}")));
    assert_eq!([&lower, &upper].map(|slot| document.unit(slot)), [Some("deg"); 2]);
    assert_eq!(document.number(&lower), f64::NEG_INFINITY);
    let set = [(&lower, -45.0), (&upper, 45.0), (&share, 0.5)];
    let right_angle = 45.0_f64.to_radians();
    let expected = Stops { lower: -right_angle, upper: right_angle, restitution: 0.5 };
    let file = document.scene(&set).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(stops(&file), expected);
    // An infinite one is kept where another number is set.
    let changed = document.with(&[(&upper, 45.0)]).text();
    let lower = f64::NEG_INFINITY;
    assert_eq!(stops(&right(&changed)), Stops { lower, restitution: 0.3, ..expected });
}

#[test]
fn the_schema_knows_stops() {
    let schema = schema();
    let of = |table: &str, key: &str| schema["$defs"][table]["properties"][key].clone();
    for (table, key) in [("hinge", "stops_deg"), ("hinge", "stops_rad"), ("slide", "stops")] {
        let found = of(table, key);
        assert_eq!((&found["type"], &found["minItems"]), (&"array".into(), &2.into()), "{key}");
        assert_eq!(found["maxItems"], 2, "{key}");
        assert!(of(table, "restitution")["description"].is_string());
    }
    let both = &schema["$defs"]["hinge"]["allOf"];
    let excluded = both.as_array().expect("conditions").iter();
    let pairs: Vec<String> = excluded.map(ToString::to_string).collect();
    assert!(pairs.iter().any(|pair| pair.contains("\"stops_deg\",\"stops_rad\"")), "{pairs:?}");
}

/// A rebound has a pulse, as a lock-up has.
#[test]
fn stops_of_a_body_with_stations_need_a_pulse_constant() {
    let station = "\n[[body.station]]\nat = 0.0\nmass = 3.0\nmass_centre = [0.0, 1.0, 0.0]\n\
                   inertia = [1.0, 0.1, 1.0]\nsection = { tube = { radius = 0.1, thickness = 0.001 } }\n";
    let with = |more: &str, hinge: &str| {
        let steel = "\n[materials.steel]\nyoungs_modulus = 1.0\n";
        format!("{BUS}{steel}{}{station}", body("boom", more, hinge))
    };
    let material = "material = \"steel\"";
    let both = &format!("{material}\npulse_constant = 0.02");
    let ends = "stops_deg = [-10, 10]";
    assert!(right(&with(material, "")).structure.is_some());
    let told = wrong(&with(material, ends));
    let words = "pulse_constant: found a body whose hinge has a latch or stops, without it";
    assert!(told.len() == 1 && told[0].contains(words), "{told:?}");
    // Nothing strikes a hinge that never turns.
    let locked = right(&with(material, &format!("{ends}\nstate = \"locked\"")));
    assert!(locked.structure.is_some());
    assert!(!write_scene(&locked).contains("pulse_constant"));
    let file = right(&with(both, ends));
    assert!(file.structure.is_some() && file.warnings.is_empty(), "{:?}", file.warnings);
    let written = write_scene(&file);
    assert!(written.contains("pulse_constant = 0.02"), "{written}");
    let long = warnings(&with(&both.replace("0.02", "20"), ends), &[]);
    assert!(long.len() == 1 && long[0].contains("found pulse constant 20"), "{long:?}");
}
