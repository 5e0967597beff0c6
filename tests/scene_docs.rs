//! `docs/scenes.md` has every key of a scene, and its scenes are right.

use std::fs;
use std::path::PathBuf;

use nboom::io::{Holds, Key, ReadOptions, SCENE, TableKind, all_tables, parse_scene};

fn document() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/scenes.md")
}

fn read() -> String {
    fs::read_to_string(document()).expect("the document is in the clone")
}

#[test]
fn the_tables_of_keys_are_those_of_the_code() {
    let (begin, end) = ("<!-- keys of scenes -->\n", "<!-- end of keys of scenes -->");
    let text = read();
    let (before, rest) = text.split_once(begin).expect("the tables have a begin mark");
    let (found, after) = rest.split_once(end).expect("the tables have an end mark");
    let expected: String = all_tables(&SCENE).into_iter().map(table).collect();
    let expected = format!("\n{expected}");
    if std::env::var_os("NBOOM_BLESS").is_some_and(|bless| bless == "1") {
        let text = format!("{before}{begin}{expected}{end}{after}");
        fs::write(document(), text).expect("documents can be written");
    } else {
        assert_eq!(found, expected, "NBOOM_BLESS=1 cargo test --test scene_docs rewrites it");
    }
}

fn table(kind: &TableKind) -> String {
    let TableKind { name, about, keys, one_of } = kind;
    let mut text = format!("### {name}\n\n{about}");
    if !one_of.is_empty() {
        text.push_str(&format!(" Exactly one of `{}` is given.", one_of.join("`, `")));
    }
    text.push_str("\n\n| key | value | meaning |\n| --- | --- | --- |\n");
    keys.iter().for_each(|key| text.push_str(&row(key)));
    text.push('\n');
    text
}

fn row(key: &Key) -> String {
    let names = key.names().join("`, `");
    let names = format!("`{names}`");
    let names = if key.is_required { format!("**{names}**") } else { names };
    format!("| {names} | {} | {} |\n", value(&key.holds), key.about)
}

fn value(holds: &Holds) -> String {
    let link = |kind: &TableKind| format!("[{0}](#{1})", kind.name, kind.name.replace(' ', "-"));
    let choices = |choices: &[&str]| format!("`\"{}\"`", choices.join("\"`, `\""));
    match holds {
        Holds::Text => "text".to_owned(),
        Holds::Texts => "list of texts".to_owned(),
        Holds::Choice(names) => choices(names),
        Holds::Count => "whole number".to_owned(),
        Holds::Number => "number".to_owned(),
        Holds::Angle => "angle or rate".to_owned(),
        Holds::Angles(count) => format!("{count} angles or rates"),
        Holds::Numbers(count) => format!("{count} numbers"),
        Holds::List => "list of numbers".to_owned(),
        Holds::Rows(count) => format!("list of lists of {count} numbers"),
        Holds::AnglesOverTime => "list of pairs of a time and an angle".to_owned(),
        Holds::AnglePairs => "list of pairs of an angle and a number".to_owned(),
        Holds::Direction => "`\"x\"`, `\"-x\"`, …, or 3 numbers".to_owned(),
        Holds::Inertia(kind) => format!("3 moments, or table: {}", link(kind)),
        Holds::Table(kind) => format!("table: {}", link(kind)),
        Holds::Tables(kind) => format!("list of tables: {}", link(kind)),
        Holds::Named(kind) => format!("tables by name: {}", link(kind)),
        Holds::NamedNumbers => "numbers by name".to_owned(),
        Holds::ChoiceOr(names, kind) => format!("{}, or table: {}", choices(names), link(kind)),
    }
}

/// The smallest scene is one that people copy.
#[test]
fn the_smallest_scene_is_right() {
    let text = read();
    let block = text.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next());
    let block = block.expect("the document has a scene");
    let file = parse_scene("scenes.md", block, "smallest", None, &ReadOptions::default());
    let file = file.unwrap_or_else(|error| panic!("{error}"));
    assert!(file.warnings.is_empty() && file.scene.warnings().is_empty());
}
