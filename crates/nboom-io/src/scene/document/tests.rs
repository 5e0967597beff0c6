//! Scenes made with what a document remembers, against the same trees read from beginning to end.

use std::path::Path;
use std::sync::LazyLock;

use proptest::prelude::*;

use super::{ReadOptions, SceneDocument, Slot};

/// A document, and the places of all its numbers.
type Numbers = (SceneDocument, Vec<Slot>);

/// Shared by all cases, so that those before have filled the memory.
static DOCUMENTS: LazyLock<Vec<Numbers>> = LazyLock::new(|| {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let files = std::fs::read_dir(examples).expect("a folder");
    let mut paths: Vec<_> = files.map(|file| file.expect("a file").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "toml" || end == "nml"));
    paths.sort();
    paths.iter().map(|path| with_slots(path)).collect()
});

fn with_slots(path: &Path) -> Numbers {
    let document = SceneDocument::read(path, &ReadOptions::default());
    let document = document.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let text: toml::Table = document.text().parse().expect("TOML");
    let mut paths = Vec::new();
    text.iter().for_each(|(key, value)| add(&format!("\"{key}\""), value, &mut paths));
    let slots = paths.iter().filter_map(|path| document.slot(path).ok()).collect();
    (document, slots)
}

/// Adds the paths of all that is no table or list.
fn add(path: &str, value: &toml::Value, paths: &mut Vec<String>) {
    match value {
        toml::Value::Table(table) => {
            table.iter().for_each(|(key, value)| add(&format!("{path}.\"{key}\""), value, paths));
        }
        toml::Value::Array(list) => {
            (1..).zip(list).for_each(|(i, value)| add(&format!("{path}[{i}]"), value, paths));
        }
        _ => paths.push(path.to_owned()),
    }
}

/// All of a scene, or what is wrong, at its place.
fn outcome(document: &SceneDocument, values: &[(&Slot, f64)]) -> String {
    format!("{:?}", document.scene(values))
}

/// What becomes of a number.
fn change() -> impl Strategy<Value = fn(f64, f64) -> f64> {
    let slight = |there: f64, by: f64| there * (1.0 + 0.01 * by);
    let other = |_: f64, by: f64| by;
    let same = |there: f64, _: f64| there;
    let none = |_: f64, _: f64| f64::NAN;
    prop_oneof![
        8 => Just(slight as fn(f64, f64) -> f64),
        2 => Just(other as fn(f64, f64) -> f64),
        1 => Just(same as fn(f64, f64) -> f64),
        1 => Just(none as fn(f64, f64) -> f64),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn what_is_remembered_changes_nothing(
        document in any::<prop::sample::Index>(),
        changes in prop::collection::vec(
            (any::<prop::sample::Index>(), change(), -3.0..3.0), 0..5),
        before in 0_usize..5,
    ) {
        let (document, slots) = document.get(&DOCUMENTS);
        let values: Vec<_> = changes
            .iter()
            .map(|(at, change, by)| (at.get(slots), change, *by))
            .map(|(slot, change, by)| (slot, change(document.number(slot), by)))
            .collect();
        let (before, after) = values.split_at(before.min(values.len()));
        let whole = SceneDocument { memory: None, ..document.with(&values) };
        prop_assert_eq!(outcome(document, &values), outcome(&whole, &[]));
        prop_assert_eq!(outcome(&document.with(before), after), outcome(&whole, &[]));
    }
}

#[test]
fn all_examples_have_numbers_and_a_memory() {
    assert!(DOCUMENTS.len() >= 12);
    assert!(
        DOCUMENTS.iter().all(|(document, slots)| slots.len() > 10 && document.memory.is_some())
    );
}
