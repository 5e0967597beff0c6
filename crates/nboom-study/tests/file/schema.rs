//! The schema of studies takes what is read, and the page about them has all its keys.

use std::fs;
use std::path::Path;

use nboom_study::{Study, schema};

use super::STUDY;
use json_schema::JsonSchema;

#[path = "../../../../tests/support/json_schema.rs"]
mod json_schema;

/// As an editor sees a study.
fn as_json(study: &str) -> serde_json::Value {
    let table: toml::Table = study.parse().expect("TOML");
    serde_json::to_value(table).expect("JSON")
}

#[test]
fn the_schema_takes_what_is_read_and_no_other_keys() {
    let schema = JsonSchema::new(&schema());
    assert_eq!(schema.take(&as_json(STUDY)), Ok(()));
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/studies");
    for entry in fs::read_dir(examples).expect("there are studies") {
        let path = entry.expect("a file").path();
        let text = fs::read_to_string(&path).expect("a text");
        assert_eq!(schema.take(&as_json(&text)), Ok(()), "{}", path.display());
        Study::read(&path).unwrap_or_else(|error| panic!("{error}"));
    }
    for (from, to) in [
        ("draws", "drawz"),
        ("deviation", "sigma"),
        ("seed = 7", "seed = -7"),
        ("monte_carlo", "dice"),
        ("by = 0.5", "by = '0.5'"),
    ] {
        let wrong = as_json(&STUDY.replacen(from, to, 1));
        assert!(schema.take(&wrong).is_err(), "{to}");
    }
}

/// All keys below a part of the schema.
fn keys(schema: &serde_json::Value, found: &mut Vec<String>) {
    for (name, inner) in schema["properties"].as_object().into_iter().flatten() {
        found.push(name.clone());
        keys(inner, found);
        keys(&inner["items"], found);
        inner["anyOf"].as_array().into_iter().flatten().for_each(|one| keys(one, found));
    }
}

/// Words in code, as `key` or `{ key = 1 }`, of a text without blocks of code.
fn in_code(text: &str) -> Vec<&str> {
    let spans = text.split('`').skip(1).step_by(2);
    spans.flat_map(|span| span.split(|c: char| !(c.is_alphanumeric() || c == '_'))).collect()
}

#[test]
fn the_page_of_studies_has_all_keys() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/studies.md");
    let page = fs::read_to_string(page).expect("a page");
    let page = page.split("```").step_by(2).collect::<String>();
    let cell = |line: &str| Some(line.strip_prefix('|')?.split('|').next()?.to_owned());
    let cells: String = page.lines().filter_map(cell).collect();
    let schema = schema();
    let (mut in_tables, mut found) = (Vec::new(), Vec::new());
    for (name, inner) in schema["properties"].as_object().expect("keys") {
        match name.as_str() {
            "vary" | "fault" | "requirement" => {
                in_tables.extend(inner["items"]["properties"].as_object().expect("keys").keys());
            }
            // In sentences.
            "run" | "correlation" => {}
            _ => in_tables.push(name),
        }
    }
    keys(&schema, &mut found);
    assert!(found.len() > 40 && in_tables.len() > 25, "{found:?} {in_tables:?}");
    let (words, cells) = (in_code(&page), in_code(&cells));
    for key in in_tables {
        assert!(cells.contains(&key.as_str()), "{key} in no table");
    }
    for key in found {
        assert!(words.contains(&key.as_str()), "{key}");
    }
}
