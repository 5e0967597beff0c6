//! Scenes in TOML, from the first word to the results.

use std::path::{Path, PathBuf};
use std::{fs, io};

use nboom_io::words::{at, body, hinge, main_body, scene, spring};
use nboom_results::StatesWriter;
use nboom_sim::{Options, Path as RunPath, Recorder, Snapshot, simulate};

use crate::json_schema::JsonSchema;
use crate::{Place, code, refused, stderr, stdout};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn files_of(folder: &str) -> Vec<PathBuf> {
    let files = fs::read_dir(root().join(folder)).expect("the folder is in the clone");
    let paths = files.map(|file| file.expect("an entry").path());
    paths.filter(|path| path.extension().is_some_and(|e| e == "nml")).collect()
}

/// Runs a file, and returns the bytes of its tables by name.
fn results(place: &Place, scene: &str, output: &str) -> Vec<(String, Vec<u8>)> {
    let run = place.nboom(&["run", scene, "-o", output, "--quiet", "--samples", "20"]);
    assert_eq!(code(&run), 0, "{scene}: {}", stderr(&run));
    let files = fs::read_dir(place.path(output)).expect("results");
    let names =
        files.map(|file| file.expect("an entry").file_name().into_string().expect("a name"));
    let mut tables: Vec<String> = names.filter(|name| name.ends_with(".csv")).collect();
    tables.sort();
    let read = |name: String| {
        let bytes = fs::read(place.path(output).join(&name)).expect("a table");
        (name, bytes)
    };
    tables.into_iter().map(read).collect()
}

/// Converts a file without loss of what a run reads.
fn converted(place: &Place, from: &str, to: &str) {
    let converted = place.nboom(&["convert", from, "-o", to, "--force"]);
    assert_eq!(code(&converted), 0, "{from}: {}", stderr(&converted));
}

#[test]
fn a_converted_deck_gives_the_same_bytes_there_and_back() {
    let place = Place::new();
    let decks = ["examples", "tests/data/scenes"].map(files_of).concat();
    assert!(decks.len() > 10);
    for deck in decks {
        let deck = deck.to_str().expect("a path");
        converted(&place, deck, "scene.toml");
        converted(&place, "scene.toml", "deck.nml");
        let before = results(&place, deck, "before");
        assert!(before.iter().any(|(name, _)| name == "states.csv"));
        for other in ["scene.toml", "deck.nml"] {
            let after = results(&place, other, "after");
            assert_eq!(names(&before), names(&after), "{deck} as {other}");
            // Named, for the assertion would print all bytes.
            for ((name, before), (_, after)) in before.iter().zip(after) {
                assert!(*before == after, "{name} of {deck} as {other}");
            }
        }
    }
}

fn names(tables: &[(String, Vec<u8>)]) -> Vec<&str> {
    tables.iter().map(|(name, _)| name.as_str()).collect()
}

#[test]
fn a_scene_in_words_of_a_program_gives_the_bytes_of_its_file() {
    let place = Place::new();
    let file = r#"
[run]
end = 4.0

[main_body]
mass = 100.0
inertia = [40.0, 30.0, 20.0]

[[body]]
name = "boom"
mass = 3.0
mass_centre = [1.0, 0.0, 0.0]
inertia = [0.01, 1.0, 1.0]

[body.hinge]
at = [0.5, 0.0, 0.0]
axis = "z"
start_deg = 90.0
release = { at = 0.5 }
latch_deg = 0.0
spring = { stiffness = 2.0, rest_deg = -10.0 }
"#;
    fs::write(place.path("boom.toml"), file).expect("writable");
    let run =
        place.nboom(&["run", "boom.toml", "-o", "out", "--path", "generic", "--samples", "20"]);
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    let hinge = hinge().at([0.5, 0.0, 0.0]).axis("z").start_deg(90.0).release(at(0.5));
    let hinge = hinge.latch_deg(0.0).spring(spring(2.0).rest_deg(-10.0));
    let boom = body("boom").mass(3.0).mass_centre([1.0, 0.0, 0.0]).inertia([0.01, 1.0, 1.0]);
    let scene = scene("boom")
        .end(4.0)
        .main_body(main_body().mass(100.0).inertia([40.0, 30.0, 20.0]))
        .body(boom.hinge(hinge))
        .build()
        .expect("the words of the file");
    let options = Options { samples: 20, path: RunPath::Generic, ..Options::default() };
    let mut by_words = Vec::new();
    let mut states = States(StatesWriter::new(&mut by_words, scene.labels()).expect("memory"));
    simulate(&scene, &options, &mut states).expect("a run");
    let by_file = fs::read(place.path("out/states.csv")).expect("a table");
    assert!(by_file == by_words, "states.csv");
}

/// The table of states in memory.
struct States<'t>(StatesWriter<&'t mut Vec<u8>>);

impl Recorder for States<'_> {
    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.0.write(snapshot)
    }
}

/// The last row of a table of states.
fn last_row(tables: &[(String, Vec<u8>)]) -> Vec<f64> {
    let states = tables.iter().find(|(name, _)| name == "states.csv").expect("states");
    let text = String::from_utf8(states.1.clone()).expect("text");
    let row = text.lines().last().expect("a row").split(',');
    row.map(|number| number.parse().expect("a number")).collect()
}

#[test]
fn a_scene_becomes_a_deck_that_moves_alike() {
    let place = Place::new();
    for kind in ["boom", "wing", "n-boom"] {
        let scene = root().join(format!("examples/{kind}.toml"));
        let scene = scene.to_str().expect("a path");
        converted(&place, scene, "deck.nml");
        let check = place.nboom(&["check", "deck.nml"]);
        assert_eq!((code(&check), stderr(&check)), (0, String::new()), "{kind}");
        let [before, after] =
            [(scene, "before"), ("deck.nml", "after")].map(|(file, to)| results(&place, file, to));
        // The deck has other axes of bodies, so numbers differ by rounding, which the motion magnifies.
        for (i, (a, b)) in last_row(&before).iter().zip(last_row(&after)).enumerate() {
            assert!((a - b).abs() <= 1e-9 * a.abs().max(1.0), "{kind}, column {i}: {a}, {b}");
        }
    }
}

#[test]
fn a_scene_that_no_deck_can_say_is_told_body_by_body() {
    let place = Place::new();
    let gimbal = root().join("examples/gimbal.toml");
    let refused = place.nboom(&["convert", gimbal.to_str().expect("a path"), "-o", "gimbal.nml"]);
    assert_eq!(code(&refused), 2);
    let told = stderr(&refused);
    let expected = [
        "error: `dish`: hinge.at: found it off the line along its axis",
        "error: `dish`: hinge.torque: found a torque over the angle",
    ];
    for (line, expected) in told.lines().zip(expected) {
        assert!(line.starts_with(expected), "{told}");
    }
    assert_eq!(told.lines().count(), expected.len(), "{told}");
    assert!(!place.path("gimbal.nml").exists());
    let nameless = place.nboom(&["convert", "gimbal.toml", "-o", "gimbal"]);
    assert_eq!(code(&nameless), 2);
    assert!(stderr(&nameless).contains("a scene NAME.toml or a deck NAME.nml"));
}

#[test]
fn every_kind_of_new_scene_runs() {
    let place = Place::new();
    for kind in ["boom", "wing", "gimbal", "n-boom"] {
        let file = format!("{kind}.toml");
        let made = place.nboom(&["new", kind]);
        assert_eq!(code(&made), 0, "{}", stderr(&made));
        assert!(stdout(&made).contains(&file), "{}", stdout(&made));
        let check = place.nboom(&["check", &file]);
        assert_eq!((code(&check), stderr(&check)), (0, String::new()), "{kind}");
        let run = place.nboom(&["run", &file]);
        assert_eq!(code(&run), 0, "{kind}: {}", stderr(&run));
        let hinges = place.summary(&format!("out/{kind}"))["verdict"]["hinges"].clone();
        let hinges = hinges.as_array().expect("a list").iter();
        let states: Vec<i64> =
            hinges.map(|hinge| hinge["state"].as_i64().expect("a code")).collect();
        // The hinges of the gimbal turn on, all others lock.
        let expected = i64::from(kind != "gimbal");
        assert!(states.iter().all(|state| *state == expected), "{kind}: {states:?}");
        // A second time nothing is overwritten.
        let again = place.nboom(&["new", kind]);
        assert_eq!(code(&again), 2);
        assert!(stderr(&again).contains("-o names another one"), "{}", stderr(&again));
    }
    // Under these names nobody would read it as what it is.
    for name in ["scene.nml", "scene", "scene.urdf"] {
        refused(&place.nboom(&["new", "boom", "-o", name]), 2, &[name, "a scene NAME.toml"]);
        assert!(!place.path(name).exists());
    }
}

#[test]
fn bodies_are_called_by_their_names_where_people_read() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    let run = place.nboom(&["run", "wing.toml", "--certify"]);
    let account = stdout(&run);
    for told in [
        "lock up  1,1 (inner panel 1)",
        "1,3 (outer panel 1) at 9.55",
        "in hinge 1,2 (middle panel 1), at 8.16",
    ] {
        assert!(account.contains(told), "{told}: {account}");
    }
    let verdict = &place.summary("out/wing")["verdict"];
    let names: Vec<_> = (0..6).map(|i| verdict["hinges"][i]["name"].as_str()).collect();
    let of_wing =
        |number| ["inner", "middle", "outer"].map(|place| Some(format!("{place} panel {number}")));
    let expected = [of_wing(1), of_wing(2)].concat();
    assert_eq!(names, expected.iter().map(Option::as_deref).collect::<Vec<_>>());
    assert_eq!(verdict["largest_impulse_at"]["name"], "middle panel 1");
    let trust = fs::read_to_string(place.path("out/wing/certificate.json")).expect("a certificate");
    assert!(trust.contains("\"name\": \"outer panel 2\""), "{trust}");
    let events = fs::read_to_string(place.path("out/wing/events.csv")).expect("a table");
    assert!(!events.contains("panel"), "columns of numbers stay");
    // Warnings too.
    let wing = fs::read_to_string(place.path("wing.toml")).expect("a scene");
    place.write("never.toml", &wing.replace("passes_deg = 45.0", "passes_deg = -10.0"));
    let check = place.nboom(&["check", "never.toml"]);
    let told = "hinge 1,2 (middle panel 1) waits for an angle of hinge 1,1 (inner panel 1), which \
                locks before it comes there";
    assert!(stderr(&check).contains(told), "{}", stderr(&check));
}

#[test]
fn parameters_are_set_on_the_command_line() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "boom"])), 0);
    let last_of = |set: &[&str]| -> f64 {
        let value = set.last().and_then(|word| word.strip_prefix("stiffness="));
        value.expect("an assignment").parse().expect("a number")
    };
    let latch = |set: &[&str]| {
        let args = [&["run", "boom.toml", "--quiet"], set].concat();
        let run = place.nboom(&args);
        assert_eq!(code(&run), 0, "{}", stderr(&run));
        let summary = place.summary("out/boom");
        let told = summary["parameters"]["stiffness"].as_f64();
        assert_eq!(told, Some(if set.is_empty() { 1.5 } else { last_of(set) }));
        let hinges = summary["verdict"]["hinges"].clone();
        hinges[0]["time"].as_f64().expect("a latch")
    };
    let (soft, stiff) = (latch(&[]), latch(&["--set", "stiffness=6"]));
    assert!(stiff < soft, "{stiff} and {soft}");
    assert_eq!(latch(&["--set", "stiffness=6", "--set", "stiffness=1.5"]), soft, "the last counts");
    for (set, told) in [
        ("stifness=6", "did you mean `stiffness`?"),
        ("stiffness", "NAME=VALUE expected"),
        ("stiffness=hard", "a number expected"),
    ] {
        let refused = place.nboom(&["run", "boom.toml", "--set", set]);
        assert_eq!(code(&refused), 2, "{set}");
        assert!(stderr(&refused).contains(told), "{}", stderr(&refused));
    }
    let deck = place.nboom(&["run", "boom.nml", "--set", "stiffness=6"]);
    assert_eq!(code(&deck), 2);
    assert!(
        stderr(&deck).contains("--set found, which only a scene in TOML with parameters can take")
    );
}

#[test]
fn a_wrong_scene_is_told_with_its_line() {
    let place = Place::new();
    place.write("wrong.toml", "[run]\nend = 1.0\n\n[main_body]\nmas = 3.0\ninertia = [1, 1, 1]\n");
    let check = place.nboom(&["check", "wrong.toml"]);
    assert_eq!(code(&check), 2);
    let told = stderr(&check);
    assert!(told.contains("wrong.toml:5:1: mas: found `mas` in main_body"), "{told}");
    assert!(told.contains("did you mean `mass`?") && told.contains("5 | mas = 3.0"), "{told}");
    assert!(told.contains("| ^^^"), "{told}");
}

#[test]
fn included_files_stay_in_the_folder_of_the_scene() {
    let place = Place::new();
    fs::create_dir(place.path("inner")).expect("writable");
    let bus = "[run]\nend = 1.0\n\n[main_body]\nmass = \"$m\"\ninertia = [1, 1, 1]\n";
    place.write("inner/scene.toml", &format!("include = [\"../outside.toml\"]\n{bus}"));
    place.write("outside.toml", "[parameters]\nm = 3.0\n");
    let refused = place.nboom(&["check", "inner/scene.toml"]);
    assert_eq!(code(&refused), 2);
    assert!(stderr(&refused).contains("which lies elsewhere"), "{}", stderr(&refused));
    let allowed = place.nboom(&["check", "inner/scene.toml", "--include-anywhere"]);
    assert_eq!(code(&allowed), 0, "{}", stderr(&allowed));
    // A circle of includes ends.
    place.write("outside.toml", "include = [\"inner/scene.toml\"]\n[parameters]\nm = 3.0\n");
    let circle = place.nboom(&["check", "inner/scene.toml", "--include-anywhere"]);
    assert_eq!(code(&circle), 2);
    assert!(stderr(&circle).contains("which is part of the scene already"), "{}", stderr(&circle));
}

/// As the schema says: every key of every example is in it.
#[test]
fn the_schema_knows_all_examples() {
    let place = Place::new();
    let printed = place.nboom(&["schema"]);
    let schema = JsonSchema::new(&serde_json::from_str(&stdout(&printed)).expect("JSON"));
    for kind in ["boom", "wing", "gimbal", "n-boom"] {
        let text = fs::read_to_string(root().join(format!("examples/{kind}.toml")));
        let scene: toml::Value = toml::from_str(&text.expect("an example")).expect("TOML");
        let scene = serde_json::to_value(scene).expect("a tree");
        assert_eq!(schema.take(&scene), Ok(()), "{kind}");
        // It would refuse a slip.
        let mut wrong = scene;
        wrong["body"][0]["mas"] = 3.0.into();
        assert!(schema.take(&wrong).is_err());
    }
}

#[test]
fn the_list_names_what_a_run_can_take() {
    let list = stdout(&Place::new().nboom(&["list"]));
    for name in ["articulated", "gauss_lanes", "kick_off", "hinge", "states.csv", "S2_P"] {
        assert!(list.contains(&format!("\n  {name}")), "{name}: {list}");
    }
}
