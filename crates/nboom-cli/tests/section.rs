//! `nboom section`: the reference data answered in their own schema, and files that are refused.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::{Value, json};
use tempfile::TempDir;

fn data() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/data/section_cases.json");
    serde_json::from_str(&fs::read_to_string(path).expect("in the clone")).expect("JSON")
}

/// Runs the command on a file with this text, in a directory of its own.
fn nboom(text: &str, args: &[&str]) -> (Output, TempDir) {
    let directory = tempfile::tempdir().expect("a directory");
    fs::write(directory.path().join("sections.json"), text).expect("writable");
    let mut command = Command::new(env!("CARGO_BIN_EXE_nboom"));
    command.current_dir(directory.path()).args(["section", "sections.json"]).args(args);
    (command.output().expect("the binary starts"), directory)
}

fn answer(text: &str) -> Value {
    let (output, _) = nboom(text, &[]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

fn refused(text: &str) -> Vec<String> {
    let (output, _) = nboom(text, &[]);
    assert_eq!((output.status.code(), output.stdout), (Some(2), Vec::new()));
    String::from_utf8(output.stderr).expect("text").lines().map(str::to_owned).collect()
}

/// Largest number in a value, by magnitude.
fn scale(value: &Value) -> f64 {
    match value {
        Value::Number(number) => number.as_f64().expect("a double").abs(),
        Value::Array(list) => list.iter().map(scale).fold(0.0, f64::max),
        Value::Object(object) => object.values().map(scale).fold(0.0, f64::max),
        _ => 0.0,
    }
}

/// Every key of `expected` is in `found`, and its numbers within 1e-8 of the largest number of their
/// list or object, or of 1, about the size of the sections, where that is less. The tests of the
/// library compare more closely; they know where the place of a maximum is degenerate and where
/// rounding decides on a static moment.
fn compare(found: &Value, expected: &Value, scale: f64, told: &str) {
    match expected {
        Value::Object(object) => {
            for (key, value) in object {
                let is_maximum = key.starts_with("max_von_mises");
                let (found, value) = match is_maximum {
                    true => (&found[key]["vm"], &value["vm"]),
                    false => (&found[key], value),
                };
                if ["Q_xi", "Q_zeta"].contains(&key.as_str()) {
                    assert!(found.is_number(), "{told} {key}");
                    continue;
                }
                compare(found, value, scale.max(self::scale(value)), &format!("{told} {key}"));
            }
        }
        Value::Array(list) => {
            assert_eq!(found.as_array().map(Vec::len), Some(list.len()), "{told}");
            for (i, value) in list.iter().enumerate() {
                compare(&found[i], value, scale, &format!("{told} {i}"));
            }
        }
        _ => {
            let (found, right) = (found.as_f64(), expected.as_f64().expect("a number"));
            let found = found.unwrap_or_else(|| panic!("{told}: absent"));
            assert!((found - right).abs() <= 1e-8 * scale, "{told}: {found}, {right} expected");
        }
    }
}

#[test]
fn the_reference_data_are_answered_in_their_schema() {
    let data = data();
    let mut questions = data.clone();
    for case in questions["cases"].as_array_mut().expect("a list") {
        case.as_object_mut().expect("a section").remove("expect");
    }
    let found = answer(&questions.to_string());
    let cases = data["cases"].as_array().expect("a list");
    assert_eq!(found["cases"].as_array().map(Vec::len), Some(cases.len()));
    for (found, case) in found["cases"].as_array().expect("a list").iter().zip(cases) {
        for (key, given) in case.as_object().expect("a section") {
            if key != "expect" {
                assert_eq!(&found[key], given);
            }
        }
        compare(&found["expect"], &case["expect"], 1.0, case["id"].as_str().expect("a text"));
    }
    // Asked with its own answer in it, the command says the same.
    assert_eq!(answer(&found.to_string()), found);
}

/// By Bredt's formula, flow = moment / (2 area); its sign follows from the order of the vertices, and is the report's for one key.
#[test]
fn the_flow_of_torsion_has_two_signs() {
    let [wide, high] = [0.05, 0.03];
    let corners = [[-wide, -high], [wide, -high], [wide, high], [-wide, high]];
    let turned: Vec<[f64; 2]> = corners.iter().rev().copied().collect();
    for (vertices, sign) in [(corners.to_vec(), -1.0), (turned, 1.0)] {
        let section = json!({
            "id": "box", "kind": "polygon", "vertices": vertices, "thickness": vec![0.002; 4], "Q": [0.0, 12.0, 0.0],
        });
        let found = &answer(&json!({ "cases": [section] }).to_string())["cases"][0]["expect"];
        let number = |value: &Value| value.as_f64().expect("a number");
        let flow = 12.0 / (2.0 * 4.0 * wide * high);
        let along = number(&found["shear_flow_start_mid_end"][0][0]);
        assert!((along - sign * flow).abs() < 1e-9 * flow, "{along}");
        assert!((number(&found["torsion_shear_flow"]) + along).abs() < 1e-9 * flow);
    }
}

/// The keys of all objects in a value.
fn keys(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) => {
            found.extend(object.keys().cloned());
            object.values().for_each(|value| keys(value, found));
        }
        Value::Array(list) => list.iter().for_each(|value| keys(value, found)),
        _ => {}
    }
}

#[test]
fn the_page_on_sections_says_what_every_key_is() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/sections.md");
    let page = fs::read_to_string(path).expect("in the clone");
    let found = answer(&data().to_string());
    let mut all = BTreeSet::new();
    found["cases"]
        .as_array()
        .expect("a list")
        .iter()
        .for_each(|case| keys(&case["expect"], &mut all));
    assert!(all.len() > 40, "{all:?}");
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| `")).collect();
    for key in all {
        let is_said = rows.iter().any(|row| row.contains(&format!("`{key}`")));
        assert!(is_said, "{key} has no row in docs/sections.md");
    }
    let convention = found["convention"].as_str().expect("a text");
    assert!(convention.contains("stresses F/L^2"), "{convention}");
    // The file of that page is one.
    let (_, rest) = page.split_once("```json").expect("an example");
    let (example, _) = rest.split_once("```").expect("its end");
    assert_eq!(answer(example)["cases"].as_array().map(Vec::len), Some(2));
}

#[test]
fn without_a_load_there_are_properties_only() {
    let found = answer(
        r#"{"cases": [{"id": "a", "kind": "circular", "R": 2, "t": 0.05},
            {"id": "b", "kind": "circular", "R": 2, "t": 0.05, "Q": [0, 1, 0]}]}"#,
    );
    let keys = |i: usize| found["cases"][i]["expect"].as_object().expect("an answer").len();
    assert_eq!((keys(0), keys(1)), (7, 10));
}

#[test]
fn a_key_beside_the_sections_that_has_no_meaning_is_told() {
    let text = r#"{"cases": [{"id": "a", "kind": "circular", "R": 2, "t": 0.05}], "P": [0, 0, 1]}"#;
    let (output, _) = nboom(text, &[]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(
        String::from_utf8_lossy(&output.stderr),
        "warning: sections.json: key P without meaning found, cases or convention expected; it is \
         ignored\n"
    );
}

#[test]
fn the_answer_goes_where_it_is_asked_for() {
    let text = r#"{"cases": [{"id": "a", "kind": "circular", "R": 2, "t": 0.3}]}"#;
    let (output, directory) = nboom(text, &["-o", "new/out.json"]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8_lossy(&output.stdout), "1 section, results in new/out.json\n");
    assert_eq!(
        String::from_utf8_lossy(&output.stderr),
        "warning: sections.json: section a: thickness 0.150 of the radius found, at most 0.1 for \
         thin-wall theory expected\n"
    );
    let written = fs::read_to_string(directory.path().join("new/out.json")).expect("written");
    let written: Value = serde_json::from_str(&written).expect("JSON");
    assert_eq!(written["cases"], answer(text)["cases"]);
    let (output, _) = nboom(text, &["-o", "sections.json/out.json"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&output.stderr).contains("sections.json/out.json"));
}

/// A polygon with one thing changed.
fn changed(key: &str, value: Value) -> String {
    let mut case = json!({
        "id": "C1",
        "kind": "polygon",
        "vertices": [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]],
        "thickness": [0.02, 0.02, 0.02, 0.02],
        "P": [1.0, 2.0, 3.0],
        "Q": [4.0, 5.0, 6.0],
    });
    case[key] = value;
    json!({ "cases": [case] }).to_string()
}

#[test]
fn bad_sections_are_named() {
    let bow_tie = json!([[1, 1], [-1, -1], [1, -1], [-1, 1]]);
    for (key, value, line) in [
        ("vertices", json!([[1, 1], [0, 1]]), "2 vertices found, at least 3 expected"),
        (
            "vertices",
            json!([[1, 1], [0], [0, 1], 5]),
            "vertex 2: found [0], expected two numbers [xi, zeta]",
        ),
        ("vertices", json!("round"), "vertices: found \"round\", expected a list"),
        (
            "vertices",
            json!([[1, 1], [1, 1], [0, 1], [0, 0]]),
            "wall 1: length zero found, vertices 1 and 2 at different points expected",
        ),
        ("vertices", bow_tie, "walls 1 and 3 that cross or touch found, one cell expected"),
        (
            "vertices",
            json!([[0, 0], [1, 0], [2, 0], [3, 0]]),
            "enclosed area 0 found, a closed cell expected",
        ),
        (
            "thickness",
            json!([0.1, 0, 0.1, 0.1]),
            "wall 2: thickness 0 found, a positive finite number expected",
        ),
        (
            "thickness",
            json!([0.1, "thin", 0.1, 0.1]),
            "thickness 2: found \"thin\", expected a number",
        ),
        ("thickness", json!([0.1]), "1 wall thicknesses found, 4 expected, as many as vertices"),
        ("thickness", Value::Null, "thickness: found nothing, expected a list"),
        (
            "kind",
            json!("solid"),
            "kind: found \"solid\", expected \"circular\" or \"polygon\"; solid and open sections and those with several cells are not covered",
        ),
        (
            "webs",
            json!([[1, 3]]),
            "webs: found a key without meaning, expected one of id, kind, P, Q, name, tags, expect, vertices, thickness",
        ),
        (
            "R",
            json!(3.0),
            "R: found a key without meaning, expected one of id, kind, P, Q, name, tags, expect, vertices, thickness",
        ),
        ("P", json!([1, 2]), "P: found [1,2], expected three components"),
        ("Q", json!([1, 2, null]), "Q 3: found nothing, expected a number"),
        (
            "Q",
            json!([1e308, 1e308, 1e308]),
            "P and Q: found a load whose stresses exceed the range of numbers",
        ),
    ] {
        let expected = format!("error: sections.json: section C1: {line}");
        let found = refused(&changed(key, value));
        assert!(found.contains(&expected), "{found:#?}\n{expected}");
    }
    let found = refused(&changed("id", json!(7)));
    assert_eq!(found, ["error: sections.json: section number 1: id: found 7, expected a text"]);
    let tube = |t: f64| json!({"id": "T", "kind": "circular", "R": 2.0, "t": t});
    let found = refused(&json!({"cases": [tube(2.5), tube(0.1), 5, tube(-0.1)]}).to_string());
    assert_eq!(
        found,
        [
            "error: sections.json: section T: thickness 2.5 found, above 0 and at most the radius 2 expected",
            "error: sections.json: section number 3: section: found 5, expected an object",
            "error: sections.json: section T: thickness -0.1 found, above 0 and at most the radius 2 expected",
        ]
    );
}

#[test]
fn files_without_sections_are_refused() {
    for (text, words) in [
        ("", "sections.json: not JSON: EOF while parsing a value at line 1 column 0"),
        ("{\n\"cases\": [}", "not JSON: expected value at line 2 column 11"),
        ("{\"cases\": [{\"R\": 1e999}]}", "not JSON: number out of range at line 1"),
        ("[]", "sections.json: no list `cases` of sections found"),
        ("{\"cases\": 5}", "sections.json: no list `cases` of sections found"),
    ] {
        let found = refused(text);
        assert!(found.len() == 1 && found[0].contains(words), "{found:?}");
    }
    for (text, place) in [
        (
            "{\"cases\": [],\n\"cases\": []}",
            "cases found again, each key once expected at line 2 column 7",
        ),
        (
            "{\"cases\": [{\"R\": 2,\n  \"R\": 3}]}",
            "R found again, each key once expected at line 2 column 5",
        ),
    ] {
        assert_eq!(
            refused(text),
            [format!("error: sections.json: a key that stands twice: {place}")]
        );
    }
    let (output, _) = nboom("{}", &["--output"]);
    assert_eq!(output.status.code(), Some(2));
    let many = json!({ "cases": vec![5; 60] }).to_string();
    assert_eq!(refused(&many).len(), 51);
    assert_eq!(refused(&many).last().map(String::as_str), Some("error: and 10 more"));
    let long = format!("{{\"cases\": [{}5]}}", "5,".repeat(3 << 20));
    assert!(refused(&long)[0].contains("expected at most that many"), "{:?}", refused(&long));
}
