//! A run again, from its record.

use std::fs;

use serde_json::Value;

use crate::{BOOM, Place, code, refused, stderr};

fn nboom(place: &Place, words: &[&str]) -> String {
    let output = place.nboom(words);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    stderr(&output)
}

fn record(place: &Place, directory: &str) -> Value {
    let text = fs::read_to_string(place.path(directory).join("run.json")).expect("a record");
    serde_json::from_str(&text).expect("JSON")
}

/// All files of a run but the record, without clock times.
fn files(place: &Place, directory: &str) -> Vec<(String, String)> {
    let wall = place.summary(directory)["wall_seconds"].to_string();
    let entries = fs::read_dir(place.path(directory)).expect("a directory");
    let mut files: Vec<(String, String)> = entries
        .map(|entry| entry.expect("readable").path())
        .map(|path| {
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            (name, fs::read_to_string(&path).expect("text").replace(&wall, "0"))
        })
        .filter(|(name, _)| name != "run.json")
        .collect();
    files.sort();
    files
}

fn assert_same(place: &Place, [one, other]: [&str; 2]) {
    let (one, other) = (files(place, one), files(place, other));
    let names =
        |files: &[(String, String)]| files.iter().map(|file| file.0.clone()).collect::<Vec<_>>();
    assert_eq!(names(&one), names(&other));
    for ((name, one), (_, other)) in one.iter().zip(&other) {
        assert!(one == other, "{name} differs");
    }
}

#[test]
fn a_run_is_repeated_to_the_last_byte() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    place.write("times.txt", "0.25 1.5");
    let options = [
        "--times",
        "times.txt",
        "--integrator",
        "dop853",
        "--rtol=1e-10",
        "--path",
        "generic",
        "--formulation",
        "recursive",
        "--listing",
        "--degrees",
        "--columns",
        "beta,omega_x",
        "--hinge-loads",
        "--end-time",
        "4",
        "--units-in-headers",
    ];
    nboom(&place, &[&["run", "wing.toml", "-o", "first"][..], &options].concat());
    // What the file of times says later does not matter.
    place.write("times.txt", "1 2 3");
    assert_eq!(nboom(&place, &["run", "first/run.json"]), "");
    assert_same(&place, ["first", "first-repeated"]);
    assert_eq!(nboom(&place, &["run", "first-repeated/run.json", "-o", "third"]), "");
    assert_same(&place, ["first", "third"]);
    let record = record(&place, "first");
    assert_eq!(record["options"]["rtol"], "1e-10");
    assert_eq!(record["options"]["atol"], "1e-12", "defaults are options too");
    assert_eq!(record["options"]["listing"], true);
    assert_eq!(record["options"]["times"], "0.25,1.5");
    assert_eq!(record["input"]["path"], "wing.toml");
    assert_eq!(record["input"]["sha256"], place.summary("first")["input_sha256"]);
    assert_eq!(record["command"][1], "run");
}

#[test]
fn options_given_now_take_the_place_of_recorded_ones() {
    let place = Place::new();
    nboom(&place, &["run", "boom.nml", "-o", "first", "--rtol", "1e-6", "--samples", "4"]);
    nboom(&place, &["run", "first/run.json", "-o", "second", "--rtol", "1e-11"]);
    let summary = place.summary("second");
    assert_eq!((&summary["rtol"], &summary["samples"]), (&1e-11.into(), &4.into()));
    nboom(&place, &["run", "boom.nml", "-o", "third", "--rtol", "1e-11", "--samples", "4"]);
    assert_same(&place, ["second", "third"]);
}

#[test]
fn an_option_given_now_takes_the_place_of_one_that_it_excludes() {
    let place = Place::new();
    let run = |from: &str, into: &str, options: &[&str]| {
        nboom(&place, &[&["run", from, "-o", into], options].concat());
        record(&place, into)["options"].clone()
    };
    let times = run("boom.nml", "times", &["--times", "0.25,1"]);
    assert_eq!(times["times"], "0.25,1");
    let samples = run("times/run.json", "samples", &["--samples", "5"]);
    assert_eq!((&samples["times"], &samples["samples"]), (&Value::Null, &"5".into()));
    let times = run("samples/run.json", "again", &["--times", "0.25,1"]);
    assert_eq!((&times["times"], &times["samples"]), (&"0.25,1".into(), &Value::Null));
    let sample = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/n-boom-1970.nml");
    let none = run(sample, "none", &["--no-stresses", "--listing"]);
    assert_eq!(none["no-stresses"], true);
    let some = run("none/run.json", "some", &["--report-signs"]);
    assert_ne!(some["no-stresses"], true);
    // What excludes nothing stays.
    assert_eq!((&some["report-signs"], &some["listing"]), (&true.into(), &true.into()));
}

#[test]
fn parameters_are_repeated_and_changed_like_options() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "wing"])), 0);
    let text = fs::read_to_string(place.path("wing.toml")).expect("a scene");
    let text = text.replace("[parameters]", "[parameters]\nend = 3.0");
    place.write("wing.toml", &text.replace("end = 30.0", "end = \"$end\""));
    nboom(&place, &["run", "wing.toml", "-o", "first", "--set", "end=2"]);
    nboom(&place, &["run", "first/run.json", "-o", "again"]);
    assert_same(&place, ["first", "again"]);
    nboom(&place, &["run", "first/run.json", "-o", "longer", "--set", "end=2.5"]);
    assert_eq!(place.summary("longer")["end_time"], 2.5);
    let wrong = place.nboom(&["run", "first/run.json", "-o", "wrong", "--set", "ende=2"]);
    let told = String::from_utf8_lossy(&wrong.stderr).into_owned();
    assert!(code(&wrong) == 2 && told.contains("`end`"), "{told}");
    assert!(!told.contains("is not what was read then"), "{told}");
    // Without the input the parameters are numbers in the scene as it was read.
    fs::remove_file(place.path("wing.toml")).expect("it is there");
    let told = nboom(&place, &["run", "first/run.json", "-o", "kept"]);
    assert!(told.contains("wing.toml is not there; this is a run of first/scene.toml"), "{told}");
    let table =
        |directory: &str| fs::read(place.path(directory).join("states.csv")).expect("a table");
    assert!(table("first") == table("kept"));
}

#[test]
fn what_is_not_as_it_was_is_said_or_refused() {
    let place = Place::new();
    nboom(&place, &["run", "boom.nml", "-o", "first"]);
    // Another input: the scene that was kept is run.
    place.write("boom.nml", &BOOM.replace("TF=4.0", "TF=2.0"));
    let told = nboom(&place, &["run", "first/run.json", "--quiet"]);
    assert!(told.contains("boom.nml is not what was read then"), "{told}");
    for table in ["states.csv", "events.csv", "instants.csv", "ledger.csv"] {
        let read = |directory: &str| fs::read(place.path(directory).join(table)).expect(table);
        assert!(read("first") == read("first-repeated"), "{table}");
    }
    place.write("boom.nml", BOOM);
    // Another version, another machine.
    let mut other = record(&place, "first");
    other["made_by"]["version"] = "0.0.7".into();
    other["made_by"]["instructions"] = "sse9".into();
    place.write("first/run.json", &other.to_string());
    let told = nboom(&place, &["run", "first/run.json", "-o", "second"]);
    for words in ["version 0.0.7 then", "instructions sse9 then"] {
        assert!(told.contains(words), "no {words} in {told}");
    }
    // Neither the input nor the scene.
    place.write("boom.nml", "");
    place.write("first/scene.toml", "");
    let run = place.nboom(&["run", "first/run.json"]);
    refused(&run, 2, &["found neither boom.nml nor first/scene.toml as they were read"]);
}

#[test]
fn what_is_no_record_is_refused() {
    let place = Place::new();
    nboom(&place, &["run", "boom.nml", "-o", "first"]);
    let good = record(&place, "first");
    let mut unknown = good.clone();
    unknown["options"]["warp"] = "9".into();
    let mut wrong = good.clone();
    wrong["options"]["rtol"] = "tight".into();
    let mut number = good;
    number["options"]["rtol"] = 7.into();
    for (text, told) in [
        ("{}".to_owned(), "no record of a run, one that nboom run has written"),
        ("{}".to_owned(), "missing field `command`"),
        ("nonsense".to_owned(), "no record of a run"),
        (String::new(), "no record of a run"),
        (number.to_string(), "no record of a run"),
        (unknown.to_string(), "unexpected argument '--warp'"),
        (wrong.to_string(), "invalid value 'tight' for '--rtol <R>'"),
    ] {
        place.write("other.json", &text);
        refused(&place.nboom(&["run", "other.json"]), 2, &["other.json", told]);
    }
    refused(&place.nboom(&["run", "nowhere.json"]), 2, &["nowhere.json"]);
}

#[test]
fn a_scene_from_standard_input_is_repeated_from_the_directory() {
    use std::io::Write;
    let place = Place::new();
    let mut command = place.command(&["run", "-", "--format", "nml", "-o", "first", "--quiet"]);
    let mut child = command.stdin(std::process::Stdio::piped()).spawn().expect("it starts");
    child.stdin.take().expect("a pipe").write_all(BOOM.as_bytes()).expect("it reads");
    assert!(child.wait().expect("it ends").success());
    let told = nboom(&place, &["run", "first/run.json", "--quiet"]);
    let kept = "standard input is not read again; this is a run of first/scene.toml";
    assert!(told.contains(kept), "{told}");
    let table =
        |directory: &str| fs::read(place.path(directory).join("states.csv")).expect("a table");
    assert!(table("first") == table("first-repeated"));
}

/// A scene of two parameters, in a file that includes another.
const MAIN: &str = "include = [\"laws.toml\"]\n\n[run]\nend = \"$end\"\n\n[main_body]\nmass = \"$mass\"\n\
                    inertia = [9.0, 9.0, 9.0]\n";
const LAWS: &str = "[parameters]\nend = 3.0\nmass = 4.0\n";

#[test]
fn a_parameter_given_now_leaves_the_others_as_they_were() {
    let place = Place::new();
    place.write("main.toml", MAIN);
    place.write("laws.toml", LAWS);
    let both = ["--set", "end=2", "--set", "mass=5"];
    nboom(&place, &[&["run", "main.toml", "-o", "first"][..], &both].concat());
    nboom(&place, &["run", "first/run.json", "-o", "second", "--set", "end=1"]);
    let parameters = place.summary("second")["parameters"].clone();
    assert_eq!(parameters, serde_json::json!({ "end": 1.0, "mass": 5.0 }));
}

#[test]
fn an_included_file_that_changed_is_not_taken_for_the_scene_that_names_it() {
    let place = Place::new();
    place.write("main.toml", MAIN);
    place.write("laws.toml", LAWS);
    nboom(&place, &["run", "main.toml", "-o", "first"]);
    // What is given now does not fit, though nothing has changed.
    let wrong = place.nboom(&["run", "first/run.json", "--set", "ende=1"]);
    refused(&wrong, 2, &["did you mean `end`"]);
    assert!(!stderr(&wrong).contains("read then"), "{}", stderr(&wrong));
    place.write("laws.toml", &LAWS.replace("4.0", "5.0"));
    let told = nboom(&place, &["run", "first/run.json"]);
    assert!(told.contains("main.toml or what it includes is not what was read then"), "{told}");
    let wrong = place.nboom(&["run", "first/run.json", "--set", "end=1"]);
    refused(&wrong, 2, &["--set: found first/scene.toml alone", "main.toml or what it includes"]);
}

#[test]
fn a_case_is_repeated_with_what_is_given_now() {
    let place = Place::new();
    place.write("scene.toml", &format!("{LAWS}{}", MAIN.split_once("\n\n").expect("two").1));
    let study = "scene = 'scene.toml'\ndraws = 6\n[[vary]]\npath = 'parameters.mass'\n\
                 uniform = { from = 4, to = 5 }\n";
    place.write("study.toml", study);
    let case = |number: &str, into: &str| {
        nboom(&place, &["run", "study.toml", "--case", number, "-o", into]);
    };
    case("5", "five");
    case("6", "six");
    nboom(&place, &["run", "five/run.json", "--case", "6", "-o", "again"]);
    assert_same(&place, ["six", "again"]);
    let wrong = place.nboom(&["run", "five/run.json", "--set", "mass=3"]);
    refused(&wrong, 2, &["--set with --case: found an option of scenes"]);
    assert!(!stderr(&wrong).contains("read then"), "{}", stderr(&wrong));
    place.write("study.toml", &study.replace("to = 5", "to = 6"));
    let told = nboom(&place, &["run", "five/run.json"]);
    assert!(told.contains("the study study.toml or its scene is not what was read then"), "{told}");
    // What was read is another file now, which summary and page tell.
    let motion = |of: &str| fs::read(place.path(of).join("states.csv")).expect("a table");
    assert_eq!(motion("five"), motion("five-repeated"));
    let wrong = place.nboom(&["run", "five/run.json", "--case", "6"]);
    refused(&wrong, 2, &["--case: found five/scene.toml alone", "or its scene is not what"]);
}
