//! Reference data as scenes: the JSON schema of `tests/data`.
#![allow(dead_code, reason = "each test binary uses its own part")]

pub mod json_scene;

use std::path::PathBuf;

use serde_json::Value;

/// A file of `tests/data`.
pub fn data_path(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

/// A JSON file of `tests/data`.
pub fn data(name: &str) -> Value {
    let text = std::fs::read_to_string(data_path(name)).expect("the data file is in the clone");
    serde_json::from_str(&text).expect("the data file is JSON")
}

/// The number at `key`.
pub fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} is a number in {value}"))
}

/// All numbers in a value, depth first.
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(n) => vec![n.as_f64().expect("the data are f64")],
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        other => panic!("numbers expected, {other} found"),
    }
}

/// Largest absolute difference, divided by the largest magnitude expected (at least `floor`); infinite where
/// something is no number.
pub fn relative_error(found: &[f64], expected: &[f64], floor: f64) -> f64 {
    assert_eq!(found.len(), expected.len());
    let scale = expected.iter().fold(floor, |m, e| m.max(e.abs()));
    let off = found.iter().zip(expected).map(|(f, e)| (f - e).abs() / scale);
    off.fold(0.0, |worst, off| if off.is_nan() { f64::INFINITY } else { worst.max(off) })
}
