//! Files of sections with something changed.

use fastrand::Rng;
use serde_json::{Value, json};

use super::text;

/// A few of the sections, as a file has them.
pub fn some(rng: &mut Rng, sections: &[Value]) -> Value {
    let count = rng.usize(1..4);
    let chosen: Vec<Value> =
        (0..count).map(|_| sections[rng.usize(..sections.len())].clone()).collect();
    json!({ "cases": chosen })
}

/// Some sections after some changes.
pub fn changed(rng: &mut Rng, sections: &[Value]) -> Vec<u8> {
    let mut file = some(rng, sections);
    for section in file["cases"].as_array_mut().expect("a list") {
        // What is only handed on would take most of the changes.
        section.as_object_mut().expect("an object").retain(|key, _| key != "expect");
    }
    for _ in 0..rng.usize(..3) {
        change(rng, &mut file["cases"]);
    }
    let mut file = file.to_string();
    for _ in 0..rng.usize(..4) {
        match rng.u32(..4) {
            0..3 => text::change_number(rng, &mut file),
            _ => text::swap_numbers(rng, &mut file),
        }
    }
    text::bytes(rng, file)
}

/// One value somewhere inside.
fn change(rng: &mut Rng, value: &mut Value) {
    match value {
        Value::Array(list) if !list.is_empty() => {
            let [one, other] = [(); 2].map(|()| rng.usize(..list.len()));
            match rng.u32(..12) {
                0 => list.swap(one, other),
                1 => drop(list.remove(one)),
                2 => list.insert(other, list[one].clone()),
                3 => list.reverse(),
                4 => *list = std::iter::repeat_n(list[one].clone(), rng.usize(..300)).collect(),
                _ => change(rng, &mut list[one]),
            }
        }
        Value::Object(section) if !section.is_empty() => {
            let keys: Vec<String> = section.keys().cloned().collect();
            let key = rng.choice(keys).expect("it is not empty");
            match rng.u32(..8) {
                0 => drop(section.remove(&key)),
                1 => drop(section.insert("R".to_owned(), json!(1.0))),
                2 => drop(section.insert("Ω\u{1b}[2J".to_owned(), json!([]))),
                _ => change(rng, &mut section[&key]),
            }
        }
        other => *other = any(rng, other),
    }
}

fn any(rng: &mut Rng, old: &Value) -> Value {
    match rng.u32(..8) {
        0 => Value::Null,
        1 => json!({}),
        2 => json!([old]),
        3 => json!("\u{1b}[31m polygon"),
        4 => json!("circular"),
        5 => json!("polygon"),
        6 => json!(true),
        _ => json!(rng.f64() - 0.5),
    }
}
