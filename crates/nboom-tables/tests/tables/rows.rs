//! Tables in CSV: read up to the first row that is none, written row by row.

use std::fs;

use nboom_tables::{Cell, Column, Kind, Rows, TableWriter, number};

use crate::Place;

fn columns() -> Vec<Column> {
    vec![
        Column::new("case", Kind::Integer, "number"),
        Column::new("t", Kind::Number, "time").in_units_of("s"),
        Column::new("why", Kind::Text, "what happened"),
    ]
}

#[test]
fn rows_are_read_up_to_the_first_that_is_none() {
    for (rest, wrong) in [
        ("3\n", "states.csv, line 4: 1 fields found, 2 expected"),
        ("3,4,5\n", "states.csv, line 4: 3 fields found, 2 expected"),
        ("3,0.1", "states.csv, line 4: the line is cut off"),
        ("3,x\n", "states.csv, line 4: `x` found, a number expected"),
        ("3,inf\n", "states.csv, line 4: `inf` found, a number expected"),
    ] {
        let place = Place::new();
        place.write("states.csv", &format!("t [s],beta_1_1\n1,0.5\n2,0.25\n{rest}"));
        let mut rows = Rows::open(&place.path(""), "states.csv").expect("open").expect("there");
        assert_eq!(rows.names, ["t", "beta_1_1"]);
        let mut angles = Vec::new();
        let ended = rows.each(|fields| {
            angles.push(number(&fields[1])?);
            Ok(())
        });
        assert_eq!(ended.expect_err(wrong).to_string(), wrong);
        assert_eq!(angles, [0.5, 0.25]);
    }
}

#[test]
fn each_row_is_in_the_file_at_once() {
    let place = Place::new();
    let path = place.path("cases.csv");
    let mut table = TableWriter::csv(&path, columns()).expect("writable");
    let text = || fs::read_to_string(&path).expect("text");
    assert_eq!(text(), "case,t,why\n");
    let row = [Cell::Integer(1), Cell::Number(-0.0), Cell::Text("hinge 1,1: \"locked\"")];
    table.row(&row).expect("writable");
    assert_eq!(text(), "case,t,why\n1,-0.0,\"hinge 1,1: \"\"locked\"\"\"\n");
    let row = [Cell::Integer(i64::MIN), Cell::Number(5e-324), Cell::Empty];
    table.row(&row).expect("writable");
    assert!(text().ends_with("\n-9223372036854775808,5e-324,\n"), "{}", text());
    table.finish().expect("writable");
}

#[test]
fn a_row_of_other_columns_is_refused_and_not_written() {
    let place = Place::new();
    let path = place.path("cases.csv");
    let mut table = TableWriter::csv(&path, columns()).expect("writable");
    table.row(&[Cell::Empty, Cell::Empty, Cell::Empty]).expect("writable");
    let mut refused = |row: &[Cell<'_>], words: &str| {
        let error = table.row(row).expect_err(words);
        assert!(error.to_string().ends_with(words), "{error}");
        assert!(error.is_of_input());
    };
    refused(&[Cell::Integer(1)], "cases.csv, row 2: 1 cells found, 3 expected");
    let nan = [Cell::Integer(1), Cell::Number(f64::NAN), Cell::Empty];
    refused(&nan, "row 2, column t: Number(NaN) found, a finite number expected");
    let swapped = [Cell::Text("a"), Cell::Number(1.0), Cell::Empty];
    refused(&swapped, "row 2, column case: Text(\"a\") found, a whole number expected");
    let number = [Cell::Integer(1), Cell::Number(1.0), Cell::Number(1.0)];
    refused(&number, "row 2, column why: Number(1.0) found, words expected");
    table.finish().expect("writable");
    assert_eq!(fs::read_to_string(path).expect("text"), "case,t,why\n,,\n");
}

#[test]
fn a_folder_that_is_not_there_is_an_error_in_writing() {
    let path = Place::new().path("gone/cases.csv");
    let error = TableWriter::csv(&path, columns()).expect_err("there is no folder");
    assert!(error.to_string().starts_with("cannot write ") && !error.is_of_input(), "{error}");
}
