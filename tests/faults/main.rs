//! Faults put into the code on purpose, one at a time, and whether the tests notice.
//!
//! `tests/faults/list` has the faults as data: each is a piece of the code and what to put in its
//! place, with the tests that ought to fail then, those of the narrowest suite first. By hand:
//!
//! ```text
//! cargo test --test faults -- --ignored --nocapture
//! ```
//!
//! tries them on a copy of the working tree in `target/faults`, which takes hours. What was tried
//! is in `target/faults/results.txt` and not tried again; without that file all is. `FAULTS=sim:`
//! tries those whose name contains that. The last result is in `docs/validation.md`.

mod fault;
mod results;
mod tree;

use std::collections::BTreeSet;

use fault::{Fault, faults};
use results::{Outcome, Results};
use tree::Tree;

/// The share of the list that may have been overtaken by the code since it was written.
const OVERTAKEN: f64 = 0.1;

/// The share of faults that the tests are to find.
const FOUND: f64 = 0.9;

#[test]
fn the_list_is_of_the_code_as_it_is() {
    let faults = faults();
    let names: BTreeSet<&str> = faults.iter().map(|fault| fault.name.as_str()).collect();
    assert_eq!(names.len(), faults.len(), "two faults have one name");
    let changes: BTreeSet<_> = faults.iter().map(|f| (&f.file, &f.right, &f.wrong)).collect();
    assert_eq!(changes.len(), faults.len(), "two faults are the same");
    let root = tree::root();
    let overtaken: Vec<String> = faults.iter().filter_map(|f| f.put_into(&root).err()).collect();
    let most = OVERTAKEN * faults.len() as f64;
    assert!(overtaken.len() as f64 <= most, "{} at most: {overtaken:#?}", most.floor());
}

#[test]
#[ignore = "hours"]
fn the_tests_find_what_is_put_in() {
    let wanted = std::env::var("FAULTS").unwrap_or_default();
    let tree = Tree::new();
    let mut results = Results::read(&tree.folder.join("results.txt"));
    let of_interest: Vec<Fault> =
        faults().into_iter().filter(|fault| fault.name.contains(&wanted)).collect();
    for fault in &of_interest {
        let is_known = matches!(results.of(fault), Some(Outcome::Found | Outcome::Missed));
        if !is_known {
            let (outcome, by) = tree.try_out(fault);
            println!("{}: {} {by}", outcome.name(), fault.name);
            results.add(fault, outcome, &by);
        }
    }
    results.print(&of_interest);
    let count = |wanted: Outcome| {
        of_interest.iter().filter(|fault| results.of(fault) == Some(wanted)).count() as f64
    };
    let (found, missed) = (count(Outcome::Found), count(Outcome::Missed));
    let (no_code, unsound) = (count(Outcome::NoCode), count(Outcome::Unsound));
    assert!(no_code + unsound == 0.0, "some faults are not Rust, or tests fail without them");
    assert!(found >= FOUND * (found + missed), "{found} of {}", found + missed);
}
