//! Scenes whose numbers are set, against texts that are edited by hand.

use std::fs;
use std::path::{Path, PathBuf};

use nboom_io::{
    InputError, ReadOptions, SceneDocument, SceneFile, ScenePart, UnknownPath, read_scene,
};
use proptest::prelude::*;

const MAIN: &str = r#"
include = ["part.toml"]
run = { end = 10.0 }
output = { samples = 50 }

[parameters]
spring = 2.0
half = "$spring / 2"

[main_body]
mass = 100.0
inertia = [40.0, 30.0, "10 * $spring"]

[[main_body.thruster]]
force = [1.0, 2.0, 3.0]
point = [0.0, 0.1, 0.2]

[[body]]
name = "boom v1.2"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.1, 1.0]

[body.hinge]
at = [0.0, 2.0, 0.0]
axis = "x"
start_deg = 90.0
latch_deg = "$angle / 3"
spring = { stiffness = "$spring" }
torque_deg = [[-10.0, 1.0], [100.0, "$half"]]

[[body]]
name = "panel +x"
repeat = { count = 2, about = "z" }
mass = 1.0
mass_centre = [0.5, 0.0, 0.0]
inertia = [0.1, 0.1, 0.2]

[body.hinge]
at = [1.0, 0.0, 0.0]
axis = "-y"
start_deg = 90.0
latch_deg = 0.0
spring = { stiffness = "$half", rest_deg = -10.0 }
"#;

const PART: &str = r#"
[parameters]
angle = 30.0

[[body]]
name = "7"
mass = 2.0
mass_centre = [0.0, 0.0, 0.25]
inertia = [1.0, 1.0, 1.0]

[body.slide]
at = [0.0, 0.0, 1.0]
axis = [0.0, 0.6, 0.8]
start = 0.125
"#;

/// A path, what the scene says there, and the text of it, with strokes around the number.
const PLACES: [(&str, f64, &str); 15] = [
    ("run.end", 10.0, "end = |10.0|"),
    ("output.samples", 50.0, "samples = |50|"),
    ("parameters.spring", 2.0, "spring = |2.0|"),
    ("parameters.half", 1.0, "half = |\"$spring / 2\"|"),
    ("parameters.angle", 30.0, "angle = |30.0|"),
    ("main_body.inertia[3]", 20.0, "|\"10 * $spring\"|]"),
    ("main_body.thruster[1].point[2]", 0.1, "point = [0.0, |0.1|, 0.2]"),
    ("body.'boom v1.2'.hinge.latch_deg", 10.0, "latch_deg = |\"$angle / 3\"|"),
    ("body.\"boom v1.2\".hinge.spring.stiffness", 2.0, "stiffness = |\"$spring\"|"),
    ("body[1].hinge.torque_deg[2][2]", 1.0, "[100.0, |\"$half\"|]"),
    ("body.panel +x.hinge.spring.rest_deg", -10.0, "rest_deg = |-10.0|"),
    ("body . panel +x . mass_centre[1]", 0.5, "mass_centre = [|0.5|, 0.0"),
    ("body.7.mass", 2.0, "mass = |2.0|"),
    ("body[3].slide.start", 0.125, "start = |0.125|"),
    ("body.7.mass_centre[3]", 0.25, "0.0, |0.25|]"),
];

/// A folder of this test with these two files.
fn folder(name: &str, main: &str, part: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("document").join(name);
    fs::create_dir_all(&folder).expect("writable");
    fs::write(folder.join("scene.toml"), main).expect("writable");
    fs::write(folder.join("part.toml"), part).expect("writable");
    folder.join("scene.toml")
}

fn document(name: &str) -> SceneDocument {
    let path = folder(name, MAIN, PART);
    SceneDocument::read(&path, &ReadOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

/// A text in which the number of a place is another.
fn edited(text: &str, place: &str, number: f64) -> String {
    let parts: Vec<&str> = place.split('|').collect();
    let [before, _, after] = parts[..] else { panic!("two strokes in {place}") };
    assert!(text.matches(&parts.concat()).count() <= 1, "{place}");
    text.replace(&parts.concat(), &format!("{before}{number:?}{after}"))
}

fn same(a: &SceneFile, b: &SceneFile) {
    assert_eq!(a.scene, b.scene);
    assert_eq!(a.structure, b.structure);
    assert_eq!(a.settings, b.settings);
    assert_eq!(a.legacy, b.legacy);
}

#[test]
fn without_values_it_is_the_scene_of_the_file() {
    let path = folder("plain", MAIN, PART);
    let read = read_scene(&path).expect("right");
    let found = document("plain").scene(&[]).expect("right");
    same(&found, &read);
    assert_eq!((found.sha256, found.included), (read.sha256, read.included));
    for example in ["cubesat.toml", "n-boom-1970.nml", "four-wings.nml", "mast.toml"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(example);
        let (read, options) = (read_scene(&path).expect("right"), ReadOptions::default());
        let document = SceneDocument::read(&path, &options).expect("right");
        let found = document.scene(&[]).expect("right");
        assert_eq!(*found.scene, *read.scene, "{example}");
        assert_eq!(found.structure, read.structure);
        assert_eq!((document.sha256(), &found.sha256), (&*read.sha256, &read.sha256));
    }
}

#[test]
fn numbers_are_what_the_scene_says() {
    let document = document("numbers");
    for (path, number, _) in PLACES {
        let slot = document.slot(path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(document.number(&slot), number, "{path}");
        let other = document.with(&[(&slot, 2.5)]);
        assert_eq!(other.number(&slot), 2.5, "{path}");
    }
    // What depends on a parameter follows it.
    let [spring, half] = ["parameters.spring", "body.panel +x.hinge.spring.stiffness"]
        .map(|path| document.slot(path).expect("a number"));
    assert_eq!(document.with(&[(&spring, 5.0)]).number(&half), 2.5);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn values_are_those_of_a_text_edited_by_hand(
        drawn in prop::collection::vec((0..PLACES.len(), 0.5..1.5_f64), 0..6),
    ) {
        let mut drawn = drawn;
        drawn.sort_by_key(|(place, _)| *place);
        drawn.dedup_by_key(|(place, _)| *place);
        let document = document("property");
        let (mut main, mut part, mut slots) = (MAIN.to_owned(), PART.to_owned(), Vec::new());
        for (i, factor) in drawn {
            let (path, number, place) = PLACES[i];
            let value = if path == "output.samples" { (number * factor).floor() } else { number * factor };
            (main, part) = (edited(&main, place, value), edited(&part, place, value));
            slots.push((document.slot(path).expect("a number"), value));
        }
        prop_assert!(slots.is_empty() || (main.as_str(), part.as_str()) != (MAIN, PART));
        let values: Vec<_> = slots.iter().map(|(slot, value)| (slot, *value)).collect();
        let found = document.scene(&values).map_err(|error| TestCaseError::fail(error.to_string()))?;
        let by_hand = read_scene(&folder("property-by-hand", &main, &part)).expect("right");
        same(&found, &by_hand);
        // Both texts of it stand alone.
        let read = |text: &str| super::read(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let alone = read(&document.with(&values).text());
        prop_assert_eq!(&alone.scene.bodies, &by_hand.scene.bodies);
        prop_assert_eq!(&alone.settings, &by_hand.settings);
        let written = read(&document.text_with(&values).expect("right"));
        prop_assert_eq!(&written.scene, &by_hand.scene);
    }
}

#[test]
fn places_have_the_unit_that_their_key_says() {
    let main = MAIN.replace(
        "[[main_body.thruster]]",
        "[initial]\nrate_rad = [0.1, 0.0, 0.0]\n[[main_body.thruster]]",
    );
    let main = main.replace("angle / 3\"", "angle / 3\"\nrate_deg = 1.0");
    let path =
        folder("units", &main, &PART.replace("[parameters]", "[parameters]\ntilt_deg = 3.0"));
    let document = SceneDocument::read(&path, &ReadOptions::default()).expect("right");
    for (path, unit) in [
        ("body.\"boom v1.2\".hinge.start_deg", Some("deg")),
        ("body.\"boom v1.2\".hinge.latch_deg", Some("deg")),
        ("body.\"boom v1.2\".hinge.rate_deg", Some("deg/T")),
        ("body.panel +x.hinge.spring.rest_deg", Some("deg")),
        ("initial.rate_rad[1]", Some("rad/T")),
        // Of a pair of angle and torque neither.
        ("body.\"boom v1.2\".hinge.torque_deg[1][2]", None),
        ("body.\"boom v1.2\".hinge.at[2]", None),
        ("main_body.thruster[1].force[2]", None),
        // Whatever a parameter is called.
        ("parameters.tilt_deg", None),
    ] {
        let slot = document.slot(path).expect("a number");
        assert_eq!(document.unit(&slot), unit, "{path}");
        assert_eq!(document.path(&slot), path);
    }
}

#[test]
fn its_text_is_that_of_the_file_or_stands_alone() {
    let path = folder("alone", &MAIN.replace("include = [\"part.toml\"]", ""), PART);
    fs::write(
        &path,
        MAIN.replace("include = [\"part.toml\"]", "# A remark.").replace("$angle", "30"),
    )
    .expect("writable");
    let alone = SceneDocument::read(&path, &ReadOptions::default()).expect("right");
    assert_eq!(alone.text(), fs::read_to_string(&path).expect("readable"));
    let text = document("parts").text();
    assert!(text.contains("[parameters]") && text.contains("repeat"), "{text}");
    assert_eq!(super::right(&text).scene.bodies.len(), 4);
}

#[test]
fn parameters_of_the_options_are_said_and_can_be_set() {
    let set = vec![("spring".to_owned(), 4.0)];
    let options = ReadOptions { set, ..ReadOptions::default() };
    let path = folder("set", MAIN, PART);
    let document = SceneDocument::read(&path, &options).expect("right");
    let [spring, half] =
        ["parameters.spring", "parameters.half"].map(|path| document.slot(path).expect("a number"));
    assert_eq!([&spring, &half].map(|slot| document.number(slot)), [4.0, 2.0]);
    let stiffness =
        |values: &[_]| document.scene(values).expect("right").scene.bodies[0].hinge.spring.linear;
    assert_eq!((stiffness(&[]), stiffness(&[(&spring, 3.0)])), (-4.0, -3.0));
    assert_eq!(super::right(&document.text()).scene.bodies[0].hinge.spring.linear, -4.0);
    let unknown = ReadOptions { set: vec![("mass".to_owned(), 1.0)], ..ReadOptions::default() };
    assert!(SceneDocument::read(&path, &unknown).is_err());
}

fn unknown(document: &SceneDocument, path: &str) -> UnknownPath {
    document.slot(path).expect_err(path)
}

#[test]
fn unknown_paths_have_the_nearest() {
    let document = document("unknown");
    for (path, nearest) in [
        ("body.panel +x.hinge.spring.stifness", "body.panel +x.hinge.spring.stiffness"),
        ("body.pannel +x.mass", "body.panel +x.mass"),
        ("body.\"boom v1.3\".hinge.start", "body.\"boom v1.2\".hinge.start_deg"),
        ("bodi[9].mass", "body.7.mass"),
        ("main_body.mass_center", "main_body.mass"),
        ("main_body.inertia", "main_body.inertia[1]"),
        ("main_body.inertia[4]", "main_body.inertia[3]"),
        ("main_body.mass.value", "main_body.mass"),
        ("parameters.sprung", "parameters.spring"),
        ("panel +x.mass", "body.panel +x.mass"),
        ("thrust.force[3]", "main_body.thruster[1].force[3]"),
        ("zzz.thruster.force[2]", "main_body.thruster[1].force[2]"),
        ("zzz.end", "run.end"),
        ("panel +x.spring.stiffness", "body.panel +x.hinge.spring.stiffness"),
    ] {
        let error = unknown(&document, path);
        assert_eq!(error.nearest.as_deref(), Some(nearest), "{path}");
        document.slot(nearest).expect("a number");
        assert!(error.to_string().contains(nearest), "{error}");
    }
    // Another body's number is not what is meant by a body that has none.
    let of_known =
        ["main_body.spring.stiffness", "body.7.hinge.spring.stiffness", "run.spring.stiffness"];
    let of_none =
        ["body.panel +x.colour", "zzz", "name", "body.7.name.length", "zzz.mass", "zzz[3]"];
    for path in [of_known.as_slice(), &of_none].concat() {
        assert_eq!(unknown(&document, path).nearest, None, "{path}");
    }
    // A name is no number, even if it looks like one.
    assert_ne!(unknown(&document, "body.7.name").nearest.as_deref(), Some("body.7.name"));
    for path in
        ["", ".", "run.", ".end", "run.end[0]", "run.end[-1]", "run.end[x]", "run[", "\"run"]
    {
        let error = unknown(&document, path);
        assert!(error.expected.starts_with("keys with dots"), "{path}: {error}");
    }
}

/// Its numbers go by the paths of the scene that is made of it.
#[test]
fn unknown_paths_of_a_deck_have_the_nearest_of_its_scene() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let document = SceneDocument::read(&examples.join("n-boom-1970.nml"), &ReadOptions::default());
    let document = document.expect("right");
    for (path, nearest) in [
        ("EMM", None),
        ("thrust.force[3]", None),
        ("body.1,2.mass", Some("body.segment 1,2.mass")),
        ("segment 1,2.mass", Some("body.segment 1,2.mass")),
        ("hinge.start_deg", Some("body.segment 1,1.hinge.start_deg")),
        ("kickoff.force[3]", Some("body.segment 1,1.kick_off.force[3]")),
    ] {
        let error = unknown(&document, path);
        assert_eq!(error.nearest.as_deref(), nearest, "{path}");
        let told = "the scene in TOML that nboom convert makes of the file expected";
        assert!(error.to_string().contains(told), "{error}");
        nearest.into_iter().for_each(|nearest| drop(document.slot(nearest).expect("a number")));
    }
}

#[test]
fn bodies_made_by_repeat_are_there_when_expanded() {
    let document = document("expanded");
    let error = unknown(&document, "body.panel +x 2.mass");
    assert!(error.expected.starts_with("`expanded = true`"), "{error}");
    let before = document.scene(&[]).expect("right");
    let hash = document.sha256().to_owned();
    let expanded = document.expanded().expect("right");
    assert_eq!(expanded.scene(&[]).expect("right").scene, before.scene);
    assert_eq!(expanded.sha256(), hash);
    let mass = expanded.slot("body.panel +x 2.mass").expect("a number");
    let masses = |file: SceneFile| {
        file.scene.bodies.iter().map(|body| body.mass_properties.mass).collect::<Vec<_>>()
    };
    assert_eq!(masses(before), [3.0, 1.0, 1.0, 2.0]);
    assert_eq!(masses(expanded.scene(&[(&mass, 1.5)]).expect("right")), [3.0, 1.0, 1.5, 2.0]);
    unknown(&expanded, "parameters.spring");
}

#[test]
fn wrong_values_are_told_at_their_places() {
    let document = document("wrong");
    for (path, value, told) in [
        (
            "body.7.mass",
            -2.0,
            "part.toml:7:8: mass: found mass -2, expected a positive finite mass",
        ),
        ("run.end", f64::NAN, "scene.toml:3:15: end: found NaN, expected a finite number"),
        ("output.samples", 2.5, "expected a whole number from 1 to"),
        ("parameters.spring", f64::INFINITY, "spring: found inf, expected a finite number"),
    ] {
        let slot = document.slot(path).expect("a number");
        match document.scene(&[(&slot, value)]) {
            Err(InputError::Content(errors)) => {
                let error = errors[0].to_string();
                assert!(error.contains(told), "{told}: {error}");
            }
            other => panic!("{path}: {other:?}"),
        }
    }
    // One wrong scene leaves no trace.
    document.scene(&[]).expect("right");
}

#[test]
fn threads_can_share_a_document() {
    fn shared<T: Clone + Send + Sync>(_: &T) {}
    let document = document("shared");
    shared(&document);
    shared(&document.slot("run.end").expect("a number"));
}

#[test]
fn parts_of_a_scene_have_the_lines_of_their_tables() {
    let part = format!(
        "{PART}\n[[body.rotor]]\naxis = \"z\"\ninertia = 0.1\nspeed_rad = 10.0\n\n\
         [[body.thruster]]\nforce = [1.0, 0.0, 0.0]\npoint = [0.0, 0.0, 0.0]\n"
    );
    let path = folder("lines", MAIN, &part);
    let document = SceneDocument::read(&path, &ReadOptions::default()).expect("right");
    let scene = document.scene(&[]).expect("right").scene;
    for (part_of_scene, place) in [
        (ScenePart::External(0), Some(("scene.toml", MAIN, "[[main_body.thruster]]"))),
        (ScenePart::External(1), Some(("part.toml", &part, "[[body.thruster]]"))),
        (ScenePart::Rotor(0), Some(("part.toml", &part, "[[body.rotor]]"))),
        (ScenePart::KickOff(0), None),
        (ScenePart::Couplings(0), None),
    ] {
        let found = document.line_of(&scene, part_of_scene);
        assert_eq!(found.is_some(), place.is_some(), "{part_of_scene:?}");
        let Some(((file, line), (name, text, header))) = found.zip(place) else { continue };
        assert!(file.ends_with(name), "{part_of_scene:?}: {file}");
        assert_eq!(text.lines().nth(line - 1), Some(header), "{part_of_scene:?}: {line}");
    }
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let deck = SceneDocument::read(&examples.join("n-boom-1970.nml"), &ReadOptions::default());
    let deck = deck.expect("right");
    let scene = deck.scene(&[]).expect("right").scene;
    assert_eq!(deck.line_of(&scene, ScenePart::KickOff(0)), None);
}
