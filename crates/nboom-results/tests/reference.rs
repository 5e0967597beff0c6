//! `docs/results.md` says what is in the table of states.

use std::fs;
use std::path::Path;

use nboom_model::Quantity;

#[test]
fn the_table_of_quantities_is_that_of_the_code() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/results.md");
    let (begin, end) = ("<!-- quantities -->\n", "<!-- end of quantities -->");
    let text = fs::read_to_string(&path).expect("docs/results.md is in the clone");
    let (before, rest) = text.split_once(begin).expect("the table has a begin mark");
    let (found, after) = rest.split_once(end).expect("the table has an end mark");
    let mut expected = "| columns | unit | what |\n| --- | --- | --- |\n".to_owned();
    for quantity in Quantity::all() {
        let columns: Vec<_> = quantity.columns().iter().map(|name| format!("`{name}`")).collect();
        // A state is a whole number, which has no unit.
        let unit = if quantity == Quantity::State { "" } else { quantity.unit() };
        let (columns, about) = (columns.join(", "), quantity.about());
        expected.push_str(&format!("| {columns} | {unit} | {about} |\n"));
    }
    if std::env::var_os("NBOOM_BLESS").is_some_and(|bless| bless == "1") {
        let text = format!("{before}{begin}{expected}{end}{after}");
        fs::write(&path, text).expect("docs/results.md can be written");
    } else {
        assert_eq!(found, expected, "NBOOM_BLESS=1 cargo test -p nboom-results rewrites it");
    }
}
