//! What a scene asks a run to write.

use std::fs;
use std::process::Output;

use crate::{Place, code, refused, rows, stderr, stdout};

/// Runs the scene of `nboom new boom`, which ends at 10, with this table of outputs.
fn run(place: &Place, output: &str, options: &[&str]) -> Output {
    if !place.path("boom.toml").exists() {
        assert_eq!(code(&place.nboom(&["new", "boom"])), 0);
    }
    let boom = fs::read_to_string(place.path("boom.toml")).expect("a scene");
    place.write("asked.toml", &format!("{boom}\n[output]\n{output}\n"));
    let run = place.nboom(&[&["run", "asked.toml", "-o", "out"], options].concat());
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    run
}

/// Header and numbers of a table.
fn table(place: &Place, file: &str) -> (String, Vec<Vec<f64>>) {
    let lines = rows(&place.path("out").join(file));
    let numbers =
        |line: &String| line.split(',').map(|cell| cell.parse().expect("a number")).collect();
    (lines[0].clone(), lines[1..].iter().map(numbers).collect())
}

fn times(place: &Place, file: &str) -> Vec<f64> {
    table(place, file).1.iter().map(|row| row[0]).collect()
}

#[test]
fn output_times_are_those_asked_for_and_both_ends() {
    let place = Place::new();
    run(&place, "times = [0.5, 1.25, 7.0]", &["--end-time", "10"]);
    assert_eq!(times(&place, "states.csv"), [0.0, 0.5, 1.25, 7.0, 10.0]);
    assert_eq!(place.summary("out")["samples"], 4);
    assert!(!place.path("out/output.csv").exists(), "nobody asked for it");
    // Those beyond the end are left out.
    run(&place, "times = [0.5, 1.25, 7.0]", &["--end-time", "1.0"]);
    assert_eq!(times(&place, "states.csv"), [0.0, 0.5, 1.0]);
    assert_eq!(place.summary("out")["samples"], 2);
    run(&place, "times = [0.0, 0.5, 1.0]", &["--end-time", "1.0"]);
    assert_eq!(times(&place, "states.csv"), [0.0, 0.5, 1.0]);
    assert_eq!(place.summary("out")["samples"], 2);
    run(&place, "every = 0.5", &["--end-time", "1.75"]);
    assert_eq!(times(&place, "states.csv"), [0.0, 0.5, 1.0, 1.5, 1.75]);
    // The command line counts more.
    run(&place, "every = 0.5", &["--end-time", "2", "--samples", "2"]);
    assert_eq!(times(&place, "states.csv"), [0.0, 1.0, 2.0]);
}

#[test]
fn listed_output_times_after_the_end_are_told() {
    let place = Place::new();
    let told = "output times: 2 of 3 after the end of the run at 1.0 found, from 1.25 on; they are left out";
    let listed = "times = [0.5, 1.25, 7.0]";
    for (output, options, is_told) in [
        (listed, &["--end-time", "1"][..], true),
        (listed, &["--end-time", "7"], false),
        (listed, &["--end-time", "1", "--samples", "3"], false),
        (listed, &["--end-time", "1", "--times", "0.25"], false),
        ("every = 0.75", &["--end-time", "1"], false),
    ] {
        let run = run(&place, output, options);
        assert_eq!(stderr(&run).contains(told), is_told, "{options:?}: {}", stderr(&run));
        assert_eq!(place.summary("out")["warnings"].to_string().contains(told), is_told);
        let samples = options.iter().position(|option| *option == "--samples");
        let samples = samples.map_or("", |_| "samples = 3\n");
        let vary = "[[vary]]\npath = 'main_body.mass'\nas = 'factor'\nuniform = { from = 0.9, to = 1.1 }\n";
        let end = options[1];
        let of_runs = format!("[run]\nend_time = {end}\n{samples}");
        place.write("study.toml", &format!("scene = 'asked.toml'\ndraws = 2\n{of_runs}{vary}"));
        let sweep = place.nboom(&[
            "sweep",
            "study.toml",
            "--no-report",
            "-o",
            &format!("{output}{options:?}"),
        ]);
        assert_eq!(code(&sweep), 0, "{}", stderr(&sweep));
        if !options.contains(&"--times") {
            assert_eq!(
                stderr(&sweep).matches(told).count(),
                usize::from(is_told),
                "{}",
                stderr(&sweep)
            );
        }
    }
}

#[test]
fn more_output_times_than_a_run_may_have_are_refused() {
    let place = Place::new();
    run(&place, "every = 0.5", &[]);
    let run = place.nboom(&["run", "asked.toml", "--end-time", "1e9"]);
    refused(&run, 2, &["output times every 0.5 from 0 to 1000000000 found", "at most 10000000"]);
}

#[test]
fn a_table_has_the_columns_asked_for_in_degrees() {
    let place = Place::new();
    run(&place, "columns = [\"omega\", \"beta of boom\", \"nutation\"]\nangles = \"degrees\"", &[]);
    let (header, asked) = table(&place, "output.csv");
    assert_eq!(header, "t,omega_x_deg,omega_y_deg,omega_z_deg,beta_1_1_deg,nutation_deg");
    let (header, states) = table(&place, "states.csv");
    let columns: Vec<&str> = header.split(',').collect();
    let column = |name: &str| columns.iter().position(|column| *column == name).expect(name);
    let same = ["omega_x", "omega_y", "omega_z", "beta_1_1", "nutation"].map(column);
    assert_eq!(asked.len(), states.len());
    for (asked, states) in asked.iter().zip(&states) {
        assert_eq!(asked[0], states[0]);
        let in_degrees = same.map(|column| states[column].to_degrees());
        assert_eq!(asked[1..], in_degrees);
    }
    let files = place.summary("out")["files"].to_string();
    assert!(files.contains("output.csv"), "{files}");
    // A later run that does not ask for the table removes it.
    run(&place, "samples = 10", &[]);
    assert!(!place.path("out/output.csv").exists());
}

#[test]
fn files_on_request_are_those_of_the_command_line() {
    let place = Place::new();
    let wanted = ["listing.txt", "hinge_loads.csv", "hinge_load_envelope.csv"];
    let read = || wanted.map(|file| fs::read(place.path("out").join(file)).expect(file));
    run(&place, "files = [\"listing\", \"hinge_loads\"]", &[]);
    let by_scene = read();
    run(&place, "samples = 200", &["--listing", "--hinge-loads"]);
    assert!(by_scene == read(), "the bytes are the same");
}

#[test]
fn columns_that_nobody_has_are_refused() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "boom"])), 0);
    let boom = fs::read_to_string(place.path("boom.toml")).expect("a scene");
    place.write("asked.toml", &format!("{boom}\n[output]\ncolumns = [\"betta of boom\"]\n"));
    let check = place.nboom(&["check", "asked.toml"]);
    refused(&check, 2, &["columns: found `betta of boom`", "did you mean `beta of boom`?"]);
}

#[test]
fn times_that_count_from_long_ago_are_told_apart() {
    let place = Place::new();
    let boom = |name: &str, y: f64, release: &str| {
        format!(
            "[[body]]\nname = \"{name}\"\nmass = 3.0\nmass_centre = [0.0, 1.0, 0.0]\ninertia = [1.0, 0.1, 1.0]\n\
             hinge = {{ at = [0.0, {y}, 0.0], axis = \"x\", release = {{ at = {release} }}, spring = {{ stiffness = 2.0, \
             rest_rad = 1.0 }} }}\n"
        )
    };
    let releases = ["100000001.25", "100000001.75"];
    let scene = format!(
        "[run]\nstart = 1e8\nend = 100000004\n[main_body]\nmass = 100.0\ninertia = [40.0, 30.0, 20.0]\n{}{}",
        boom("a", 2.0, releases[0]),
        boom("b", -2.0, releases[1]),
    );
    place.write("late.toml", &scene);
    let run = place.nboom(&["run", "late.toml", "--samples", "1", "--listing"]);
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    let account = stdout(&run);
    let told = account.lines().filter(|line| line.contains("  release  "));
    let told: Vec<&str> = told.filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(told, releases, "{account}");
    let listing = fs::read_to_string(place.path("out/late/listing.txt")).expect("a printout");
    let times = listing.lines().filter_map(|line| line.strip_prefix("TIME ")?.split(' ').next());
    let times: Vec<f64> = times.map(|time| time.parse().expect("a number")).collect();
    assert_eq!(times, [1e8, 100_000_001.25, 100_000_001.75, 100_000_004.0], "{listing}");
    let check = stdout(&place.nboom(&["check", "late.toml"]));
    for words in ["released at time 100000001.25", "span: 100000000 to 100000004"] {
        assert!(check.contains(words), "no {words:?} in {check}");
    }
}
