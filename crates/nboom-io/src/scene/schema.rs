//! The JSON schema of scenes, from the list of tables and keys.

use serde_json::{Map, Value, json};

use super::catalog::SCENE;
use super::keys::{Holds, Key, TableKind, all_tables};

/// The JSON schema of a scene, for editors.
pub fn schema() -> Value {
    let definitions: Map<String, Value> = all_tables(&SCENE)
        .into_iter()
        .filter(|kind| !std::ptr::eq(*kind, &SCENE))
        .map(|kind| (kind.name.to_owned(), table(kind)))
        .collect();
    let mut root = table(&SCENE);
    root["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    root["title"] = json!("A scene of nboom");
    root["$defs"] = Value::Object(definitions);
    root
}

fn table(kind: &TableKind) -> Value {
    let mut properties = Map::new();
    let mut conditions = Vec::new();
    for key in kind.keys {
        for name in key.names() {
            let mut value = of_value(&key.holds);
            value["description"] = json!(key.about);
            properties.insert(name, value);
        }
        conditions.extend(condition(key));
    }
    if !kind.one_of.is_empty() {
        let given =
            |name: &&str| one_of_names(&kind.key_called(name).map(Key::names).unwrap_or_default());
        let choices: Vec<Value> = kind.one_of.iter().map(given).collect();
        conditions.push(json!({ "oneOf": choices }));
    }
    let mut schema = json!({
        "type": "object",
        "description": kind.about,
        "properties": properties,
        "additionalProperties": false,
    });
    if !conditions.is_empty() {
        schema["allOf"] = json!(conditions);
    }
    schema
}

/// That a key is given once, or at most once.
fn condition(key: &Key) -> Option<Value> {
    let names = key.names();
    match (&names[..], key.is_required) {
        ([name], true) => Some(json!({ "required": [name] })),
        ([_], false) => None,
        (_, true) => Some(
            json!({ "oneOf": names.iter().map(|n| json!({ "required": [n] })).collect::<Vec<_>>() }),
        ),
        (_, false) => Some(json!({ "not": { "required": names } })),
    }
}

fn one_of_names(names: &[String]) -> Value {
    let each: Vec<Value> = names.iter().map(|name| json!({ "required": [name] })).collect();
    json!({ "anyOf": each })
}

fn reference(kind: &TableKind) -> Value {
    json!({ "$ref": format!("#/$defs/{}", kind.name) })
}

fn number() -> Value {
    json!({ "type": ["number", "string"] })
}

fn list(items: Value, count: usize) -> Value {
    json!({ "type": "array", "items": items, "minItems": count, "maxItems": count })
}

fn of_value(holds: &Holds) -> Value {
    match holds {
        Holds::Text => json!({ "type": "string" }),
        Holds::Texts => json!({ "type": ["string", "array"], "items": { "type": "string" } }),
        Holds::Choice(choices) => json!({ "enum": choices }),
        Holds::Count | Holds::Number | Holds::Angle => number(),
        Holds::Angles(count) | Holds::Numbers(count) => list(number(), *count),
        Holds::List => json!({ "type": "array", "items": number() }),
        Holds::Rows(count) => json!({ "type": "array", "items": list(number(), *count) }),
        Holds::AnglePairs | Holds::AnglesOverTime => {
            json!({ "type": "array", "items": list(number(), 2) })
        }
        Holds::Direction => json!({
            "anyOf": [{ "enum": ["x", "-x", "y", "-y", "z", "-z"] }, list(number(), 3)],
        }),
        Holds::Inertia(kind) => json!({ "anyOf": [list(number(), 3), reference(kind)] }),
        Holds::Table(kind) => json!({ "allOf": [reference(kind)] }),
        Holds::Tables(kind) => json!({ "type": "array", "items": reference(kind) }),
        Holds::Named(kind) => json!({ "type": "object", "additionalProperties": reference(kind) }),
        Holds::NamedNumbers => json!({ "type": "object", "additionalProperties": number() }),
        Holds::ChoiceOr(choices, kind) => {
            json!({ "anyOf": [{ "enum": choices }, reference(kind)] })
        }
    }
}
