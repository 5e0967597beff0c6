//! Cases of studies: their scenes, their rows, their results.

mod results;
mod rows;
mod texts;
mod witness;

use std::fs;
use std::path::{Path, PathBuf};

use nboom_study::{Outcome, Row, Runner, Study, Value, columns};

/// A file of the examples.
fn example(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    folder.join(name).to_string_lossy().into_owned()
}

/// A folder for files of a test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cases").join(name);
    fs::create_dir_all(&folder).expect("writable");
    folder
}

/// Varies nothing, in a study that has to vary something.
const SAME: &str =
    "[[vary]]\nname = 'same'\npath = 'main_body.mass'\nas = 'factor'\nvalues = [1.0]\n";

/// A study of this scene, of one case unless the text varies something; `name` is that of the test.
fn study(name: &str, scene: &str, text: &str) -> Study {
    let path = folder(name).join("study.toml");
    let more = if text.contains("[[") { "" } else { SAME };
    let text = format!("scene = '{scene}'\nmethod = \"grid\"\n{text}\n{more}");
    fs::write(&path, text).expect("writable");
    Study::read(&path).unwrap_or_else(|error| panic!("{error}"))
}

/// The rows of these cases, by one runner.
fn rows(study: &Study, cases: impl IntoIterator<Item = u64>) -> Vec<Row> {
    let mut runner = Runner::new(study, &[], &[]);
    let mut row = |number| runner.run(&study.case(number), &|| false).expect("not interrupted");
    cases.into_iter().map(&mut row).collect()
}

/// The row of a case.
fn row(study: &Study, case: u64) -> Row {
    rows(study, [case]).remove(0)
}

/// What a row has in a column.
fn cell<'r>(study: &Study, row: &'r Row, column: &str) -> &'r Value {
    let columns = columns(study);
    assert_eq!(columns.len(), row.cells.len());
    let place = columns.iter().position(|known| known.name == column);
    &row.cells[place.unwrap_or_else(|| panic!("no column {column}"))]
}

/// The status of a row.
fn status(row: &Row) -> &str {
    match row.cells.last() {
        Some(Value::Text(status)) => status,
        other => panic!("{other:?}"),
    }
}

/// A row with results.
fn complete(row: Row) -> Row {
    assert_eq!((row.outcome, status(&row)), (Outcome::Ok, "ok"));
    row
}
