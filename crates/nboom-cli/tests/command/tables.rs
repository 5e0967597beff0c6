//! What the command line asks of tables, and what the companion says of their columns.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;

use crate::{Place, code, refused, rows, stderr};

/// The sample of the report, which has stresses.
const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/n-boom-1970.nml");
/// A mast that slides out.
const MAST: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/mast.toml");

fn run(place: &Place, scene: &str, into: &str, options: &[&str]) {
    let words = ["run", scene, "-o", into, "--quiet", "--samples", "5"];
    let run = place.nboom(&[&words, options].concat());
    assert_eq!((code(&run), stderr(&run)), (0, String::new()));
}

/// Fields of each table by the table's name, as the companion says them.
fn companion(place: &Place, directory: &str) -> BTreeMap<String, Vec<Value>> {
    let path = place.path(directory).join("datapackage.json");
    let text = fs::read_to_string(path).expect("a companion");
    let package: Value = serde_json::from_str(&text).expect("JSON");
    let resources = package["resources"].as_array().expect("a list").iter();
    let table = |resource: &Value| {
        let fields = resource["schema"]["fields"].as_array().expect("a list").clone();
        (resource["path"].as_str().expect("a name").to_owned(), fields)
    };
    resources.map(table).collect()
}

fn units(fields: &[Value]) -> BTreeMap<&str, Option<&str>> {
    let name = |field: &'_ Value| field["name"].as_str().map(str::len).unwrap_or_default();
    assert!(fields.iter().all(|field| name(field) > 0));
    fields
        .iter()
        .map(|field| (field["name"].as_str().expect("text"), field["unit"].as_str()))
        .collect()
}

#[test]
fn the_companion_has_every_column_of_every_table() {
    let place = Place::new();
    for options in [&[][..], &["--units-in-headers", "--degrees", "--units", "ft-lbf-s"]] {
        run(&place, SAMPLE, "out", options);
        let companion = companion(&place, "out");
        let entries = fs::read_dir(place.path("out")).expect("a directory");
        let names =
            entries.map(|entry| entry.expect("readable").file_name().into_string().expect("text"));
        let tables: Vec<String> = names.filter(|name| name.ends_with(".csv")).collect();
        assert_eq!(tables.len(), companion.len(), "{tables:?}");
        for table in tables {
            let rows = rows(&place.path("out").join(&table));
            let fields = &companion[&table];
            let named: Vec<&str> =
                fields.iter().map(|field| field["name"].as_str().expect("text")).collect();
            assert_eq!(rows[0].split(',').collect::<Vec<_>>(), named, "{table}");
            // Kinds are those of what stands there.
            for row in &rows[1..] {
                for (cell, field) in row.split(',').zip(fields).filter(|(cell, _)| !cell.is_empty())
                {
                    let is_right = match field["type"].as_str() {
                        Some("number") => cell.parse::<f64>().is_ok(),
                        Some("integer") => cell.parse::<i64>().is_ok(),
                        Some("string") => true,
                        _ => false,
                    };
                    assert!(is_right, "{table}: {cell} in {field}");
                }
            }
        }
    }
}

#[test]
fn units_are_those_of_the_scene() {
    let place = Place::new();
    run(&place, SAMPLE, "out", &["--units", "in-lbf-s"]);
    let tables = companion(&place, "out");
    for (table, column, unit) in [
        ("states.csv", "t", Some("s")),
        ("states.csv", "rho_x", Some("in")),
        ("states.csv", "beta_1_1", Some("rad")),
        ("states.csv", "tau_1_1", Some("rad/s")),
        ("states.csv", "chi", Some("1")),
        ("states.csv", "state_1_1", None),
        ("events.csv", "kind", None),
        ("events.csv", "energy_before", Some("lbf in")),
        ("ledger.csv", "residual_energy", Some("1")),
        ("stress.csv", "von_mises", Some("lbf/in^2")),
        ("latch_impulses.csv", "p_xi", Some("lbf s")),
        ("latch_impulses.csv", "q_xi", Some("lbf in s")),
        ("hinge_load_envelope.csv", "magnitude", None),
    ] {
        assert_eq!(units(&tables[table]).get(column), Some(&unit), "{table} {column}");
    }
    // What slides has lengths, in degrees too.
    run(&place, MAST, "mast", &["--degrees"]);
    let tables = companion(&place, "mast");
    assert_eq!(units(&tables["states.csv"])["beta_1_1"], Some("m"));
    assert_eq!(units(&tables["output.csv"])["tau_1_1"], Some("m/s"));
    assert_eq!(units(&tables["output.csv"])["omega_x_deg"], Some("deg/s"));
    let first =
        &tables["states.csv"].iter().find(|field| field["name"] == "beta_1_1").expect("there");
    assert_eq!(first["description"], "travel relative to the inboard body");
    assert!(first["body"].is_string(), "{first}");
}

#[test]
fn units_in_headers_change_no_name_and_no_page() {
    let place = Place::new();
    run(&place, SAMPLE, "plain", &["--units", "SI"]);
    run(&place, SAMPLE, "units", &["--units", "SI", "--units-in-headers", "--degrees"]);
    let header = |directory: &str| rows(&place.path(directory).join("states.csv"))[0].clone();
    assert!(header("units").starts_with("t [s],rho_x [m],rho_y [m],rho_z [m],v_x [m/s]"));
    let names = header("units");
    let names: Vec<&str> =
        names.split(',').map(|cell| cell.split(" [").next().expect("a name")).collect();
    assert_eq!(names.join(","), header("plain"));
    // Rows are the same, and the page shows them, but for the clock and the list of files.
    assert!(
        rows(&place.path("plain/states.csv"))[1..] == rows(&place.path("units/states.csv"))[1..]
    );
    let summary = |directory: &str| place.summary(directory);
    let page = |directory: &str| {
        let page = fs::read_to_string(place.path(directory).join("report.html")).expect("a page");
        let wall = summary(directory)["wall_seconds"].to_string();
        assert!(page.contains(&wall));
        page.replace(&wall, "0").replace("\"output.csv\",", "")
    };
    assert!(page("plain") == page("units"), "the pages differ");
    let report = place.nboom(&["report", "units"]);
    assert_eq!((code(&report), stderr(&report)), (0, String::new()));
}

#[test]
fn the_command_line_chooses_columns_degrees_and_times() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "boom"])), 0);
    place.write("times.txt", "# of the test\n0.5, 1.25\n7\n");
    let run = |options: &[&str]| {
        let run = place.nboom(&[&["run", "boom.toml", "-o", "out", "--quiet"], options].concat());
        assert_eq!(code(&run), 0, "{}", stderr(&run));
    };
    let numbers = |file: &str| -> Vec<Vec<f64>> {
        let number = |cell: &str| cell.parse().expect("a number");
        let rows = rows(&place.path("out").join(file));
        rows[1..].iter().map(|row| row.split(',').map(number).collect()).collect()
    };
    for times in ["0.5,1.25,7", "times.txt"] {
        run(&["--times", times, "--columns", "beta of boom, v", "--columns", "beta", "--degrees"]);
        let header = &rows(&place.path("out/output.csv"))[0];
        assert_eq!(header, "t,beta_1_1_deg,v_x,v_y,v_z");
        let (asked, states) = (numbers("output.csv"), numbers("states.csv"));
        let times: Vec<f64> = asked.iter().map(|row| row[0]).collect();
        assert_eq!(times, [0.0, 0.5, 1.25, 7.0, 10.0]);
        let header = rows(&place.path("out/states.csv"))[0].clone();
        let beta = header.split(',').position(|name| name == "beta_1_1").expect("a column");
        for (asked, states) in asked.iter().zip(&states) {
            assert_eq!(asked[1], states[beta].to_degrees());
        }
    }
    // Degrees alone: all columns.
    run(&["--degrees"]);
    let columns = |file: &str| rows(&place.path("out").join(file))[0].split(',').count();
    assert_eq!(columns("output.csv"), columns("states.csv"));
}

#[test]
fn names_with_commas_and_blanks_are_columns_too() {
    let place = Place::new();
    let text = fs::read_to_string(MAST).expect("an example");
    let scene: Value = toml::from_str(&text).expect("TOML");
    let name = scene["body"][0]["name"].as_str().expect("a name");
    for odd in ["a,b", "  sp  ", "x, omega"] {
        let quoted = |name: &str| format!("\"{name}\"");
        place.write("odd.toml", &text.replace(&quoted(name), &quoted(odd)));
        let column = format!("beta of {odd}");
        let options = ["--columns", &column, "--columns", "omega_x,v_x"];
        run(&place, "odd.toml", "odd", &options);
        let header = rows(&place.path("odd/output.csv"))[0].clone();
        assert_eq!(header, "t,beta_1_1,omega_x,v_x", "{odd}");
        fs::remove_dir_all(place.path("odd")).expect("it is there");
    }
}

#[test]
fn columns_and_times_that_nobody_has_are_refused() {
    let place = Place::new();
    assert_eq!(code(&place.nboom(&["new", "boom"])), 0);
    place.write("bad.txt", "0.5\nsoon\n");
    for (options, told) in [
        (["--columns", "omga"], "--columns: column `omga` found, a quantity as `omega`"),
        (["--columns", "omga"], "did you mean `omega`?"),
        (["--columns", "beta of bom"], "did you mean `beta of boom`?"),
        (["--columns", "reaction_force"], "columns of a main body that moves freely expected"),
        (["--columns", "motor_torque"], "found, columns of a scene without rotors expected\n"),
        (["--columns", "rotor_speed_1"], "found, columns of a scene without rotors expected\n"),
        (["--times", "1,0.5"], "--times: found 0.5 after 1, expected ascending times"),
        (["--times", "1,11"], "found 11, expected a time from 0, the start, to 10, the end"),
        (["--times", "1,,2"], "a number expected"),
        (["--times", ""], "a number expected"),
        (["--times", "bad.txt"], "bad.txt:2: found `soon`, expected a finite number"),
        (["--times", "nowhere.txt"], "nowhere.txt"),
    ] {
        let run = place.nboom(&[&["run", "boom.toml"], &options[..]].concat());
        refused(&run, 2, &[told]);
        assert!(!place.path("out").exists());
    }
    let both = place.nboom(&["run", "boom.toml", "--times", "1,2", "--samples", "3"]);
    refused(&both, 2, &["--times", "--samples"]);
}
