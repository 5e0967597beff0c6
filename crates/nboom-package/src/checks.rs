//! The tests of a crate of routines, with their data.

use crate::certificate::{Certified, Tested};
use crate::choices::Requests;
use crate::manifest::rust_name;

const ACCELERATIONS: &str = include_str!("../templates/certificate.rs");
const EQUATIONS: &str = include_str!("../templates/certificate_equations.rs");

/// `tests/certificate.rs` of the crate `name`.
pub(crate) fn code(name: &str, requests: &Requests, certified: &Certified) -> String {
    let whole = &requests.whole.name;
    let equations = requests.equations.as_ref().map(|request| &request.name);
    let names: Vec<&str> =
        [Some(whole), equations].into_iter().flatten().map(String::as_str).collect();
    let text = ACCELERATIONS.to_owned() + if equations.is_some() { EQUATIONS } else { "" };
    let values = [
        ("CRATE", rust_name(name)),
        ("NAMES", names.join(", ")),
        ("TOLERANCE", format!("{:e}", certified.tolerance())),
        ("WHOLE", whole.clone()),
        ("EQUATIONS", equations.cloned().unwrap_or_default()),
    ];
    values.iter().fold(text, |text, (key, value)| text.replace(&format!("/*{key}*/"), value))
}

/// States and accelerations, a row for each under one that counts them.
pub(crate) fn accelerations(certified: &Certified) -> String {
    table(certified, "acceleration", |state| &state.accelerations)
}

/// States and what the equations are solved by.
pub(crate) fn equations(certified: &Certified) -> String {
    table(certified, "unknown", |state| &state.unknowns)
}

fn table(certified: &Certified, word: &str, expected: impl Fn(&Tested) -> &[f64]) -> String {
    let Some(first) = certified.tested.first() else { return String::new() };
    let head = |word: &str, count: usize| -> Vec<String> {
        (0..count).map(|i| format!("{word}_{i}")).collect()
    };
    let heads = [head("state", first.coordinates.len()), head(word, expected(first).len())];
    let mut text = heads.concat().join(",") + "\n";
    for state in &certified.tested {
        let numbers = state.coordinates.iter().chain(expected(state));
        let cells: Vec<String> = numbers.map(|number| format!("{number:?}")).collect();
        text += &(cells.join(",") + "\n");
    }
    text
}
