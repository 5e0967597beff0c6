//! The section "What 1970 saw" of `docs/integrators.md`, from the report's deck to its figures: the
//! integrator of 1970 under the deck's own settings against an accurate run.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::{Place, code, stderr};

const DECK: &str = include_str!("../../../../examples/n-boom-1970.nml");

/// The rows of the section's tables: what, and the cells after it.
fn documented() -> BTreeMap<String, Vec<String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/integrators.md");
    let text = fs::read_to_string(path).expect("the document is in the clone");
    let (_, section) = text.split_once("### What 1970 saw").expect("the section is there");
    let cells = |line: &str| -> Option<(String, Vec<String>)> {
        let mut cells = line.strip_prefix('|')?.split('|').map(|cell| cell.trim().to_owned());
        Some((cells.next()?, cells.collect()))
    };
    section.lines().filter_map(cells).collect()
}

/// The first number in a cell.
fn number(cell: &str) -> f64 {
    let first = cell.split([' ', ',']).next().expect("split has a first piece");
    first.parse().unwrap_or_else(|_| panic!("no number at the start of {cell:?}"))
}

/// A table of a run: for each row its cells by column.
fn table(place: &Place, directory: &str, name: &str) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(place.path(directory).join(name)).expect("a table");
    let mut lines = text.lines().map(|line| line.split(',').map(str::to_owned));
    let header: Vec<String> = lines.next().expect("a header").collect();
    lines.map(|cells| header.iter().cloned().zip(cells).collect()).collect()
}

/// The largest difference of the columns whose names begin so.
fn largest(runs: &[Vec<BTreeMap<String, String>>; 2], beginning: &str) -> f64 {
    let [a, b] = runs;
    assert_eq!(a.len(), b.len());
    let rows = a.iter().zip(b).flat_map(|(a, b)| {
        let columns = a.iter().filter(|(name, _)| name.starts_with(beginning));
        columns.map(|(name, value)| (number(value) - number(&b[name])).abs()).collect::<Vec<_>>()
    });
    rows.fold(0.0, f64::max)
}

/// Two digits are documented.
fn agrees(what: &str, found: f64, documented: f64) {
    assert!(
        (found / documented - 1.0).abs() < 0.06,
        "{what}: {found:e}, documented {documented:e}"
    );
}

#[test]
fn what_1970_saw() {
    let place = Place::new();
    place.write("deck.nml", DECK);
    let documented = documented();
    let accurate = ["--integrator", "dop853", "--rtol", "1e-12", "--atol", "1e-13"];
    for (column, (name, options)) in
        [("rkam", &["--integrator", "rkam"][..]), ("dop853", &accurate)].into_iter().enumerate()
    {
        let common = ["run", "deck.nml", "-o", name, "--end-time", "0.4", "--no-stresses"];
        let output = place.nboom(&[&common[..], options].concat());
        assert_eq!(code(&output), 0, "{}", stderr(&output));
        let summary = place.summary(name);
        let count = |key: &str| summary[key].as_u64().expect("a count");
        let steps = format!("{}, {}", count("steps_accepted"), count("steps_rejected"));
        assert_eq!(documented["steps, refused ones"][column], steps, "{name}");
        assert_eq!(documented["evaluations"][column], count("evaluations").to_string(), "{name}");
        for quantity in ["energy", "angular momentum"] {
            let row = &documented[&format!("largest residual of {quantity}, relative")];
            let found = summary["conservation"][quantity.replace(' ', "_")].as_f64();
            agrees(quantity, found.expect("a residual"), number(&row[column]));
        }
    }
    let runs = |name| ["rkam", "dop853"].map(|directory| table(&place, directory, name));
    let (states, events) = (runs("states.csv"), runs("events.csv"));
    let of_kind = |kind: &str| {
        events.clone().map(|mut rows| {
            rows.retain(|row| row["kind"] == kind);
            rows
        })
    };
    for (what, kind, column) in [
        ("time of a release", "release", "t"),
        ("time at which a kick-off spring lets go", "kick_off_disengage", "t"),
        ("time of a lock-up", "lock_up", "t"),
        ("impulse of a lock-up", "lock_up", "impulse"),
    ] {
        let rows = of_kind(kind);
        assert!(!rows[0].is_empty(), "{what}");
        agrees(what, largest(&rows, column), number(&documented[what][0]));
    }
    for (what, column) in [
        ("hinge angle, radians", "beta_"),
        ("hinge rate, radians per second", "tau_"),
        ("rate of the main body, radians per second", "omega_"),
        ("kinetic energy", "kinetic_energy"),
    ] {
        agrees(what, largest(&states, column), number(&documented[what][0]));
    }
    // The deck allows 150 steps, which end before its last time.
    let output = place.nboom(&["run", "deck.nml", "--integrator", "rkam", "--no-stresses"]);
    let message = stderr(&output);
    assert_eq!(code(&output), 3, "{message}");
    assert!(message.contains("at time 0.42"), "{message}");
    assert!(message.contains("the 150 steps that LSTEP allows are used up"), "{message}");
    assert!(!message.contains("stiff"), "{message}");
    // The command line comes before the deck, with any method.
    for method in ["rkam", "dop853"] {
        let words = ["run", "deck.nml", "--max-steps", "20", "--integrator", method];
        let output = place.nboom(&[&words[..], &["--no-stresses"]].concat());
        let message = stderr(&output);
        assert_eq!(code(&output), 3, "{message}");
        assert!(message.contains("the 20 steps that max_steps allows are used up"), "{message}");
    }
    // Also where it says what holds without it.
    let usual = ["run", "deck.nml", "--max-steps", "10000000", "--integrator", "rkam"];
    let output = place.nboom(&[&usual[..], &["--no-stresses"]].concat());
    assert_eq!(code(&output), 0, "{}", stderr(&output));
}
