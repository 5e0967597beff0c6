//! Directories that are not those of a complete run are refused, and the message says where and why.

use std::fs;

use nboom_tables::{Format, Run, TablesError};
use serde_json::{Value, json};

use crate::{Place, package};

/// Why the directory is refused, after a change of it.
fn refused(change: impl FnOnce(&Place)) -> TablesError {
    let place = Place::new();
    change(&place);
    Run::read(&place.path("")).expect_err("it is refused")
}

fn said(change: impl FnOnce(&Place), words: &[&str]) {
    let error = refused(change);
    let message = error.to_string();
    assert!(words.iter().all(|word| message.contains(word)), "{message}");
    assert!(error.is_of_input(), "{message}");
}

#[test]
fn what_is_no_directory_of_a_complete_run_is_refused() {
    said(
        |place| fs::remove_file(place.path("summary.json")).expect("it is there"),
        &["summary.json"],
    );
    let no_package = |place: &Place| fs::remove_file(place.path("datapackage.json"));
    said(|place| no_package(place).expect("it is there"), &["no datapackage.json found"]);
    let incomplete = |place: &Place| place.write("summary.json", r#"{ "complete": false }"#);
    said(incomplete, &["not complete", "in CSV"]);
    let killed = |place: &Place| {
        incomplete(place);
        no_package(place).expect("it is there");
    };
    assert!(matches!(refused(killed), TablesError::Incomplete { .. }));
    said(
        |place| place.write("summary.json", "{ \"complete\": tr"),
        &["summary.json", "line 1 column 16"],
    );
    said(|place| place.write("summary.json", "[]"), &["summary.json", "no summary of a run"]);
    said(|place| place.write("datapackage.json", "{"), &["datapackage.json", "line 1 column 1"]);
}

#[test]
fn tables_up_to_a_failure_can_be_asked_for() {
    let place = Place::new();
    place.write("summary.json", r#"{ "complete": false }"#);
    Run::read_so_far(&place.path("")).expect("it has tables");
}

#[test]
fn columns_that_no_run_has_are_refused() {
    let with = |place: &Place, change: &dyn Fn(&mut Value)| {
        let mut package = package();
        change(&mut package["resources"][0]);
        place.write("datapackage.json", &package.to_string());
    };
    let named = |name: &'static str| {
        move |table: &mut Value| table["schema"]["fields"][1]["name"] = name.into()
    };
    said(
        |place| with(place, &|table| table["path"] = "../x.csv".into()),
        &["the table `../x.csv`"],
    );
    said(|place| with(place, &named("a/b")), &["the column `a/b` of states.csv"]);
    said(|place| with(place, &named("t [ms]")), &["the column `t` of states.csv"]);
    said(|place| with(place, &named("")), &["the column `` of states.csv"]);
    said(|place| with(place, &|table| table["schema"]["fields"] = json!([])), &["without columns"]);
    let of_a_date = |table: &mut Value| table["schema"]["fields"][1]["type"] = "date".into();
    said(|place| with(place, &of_a_date), &["datapackage.json", "unknown variant `date`"]);
}

#[test]
fn a_format_is_refused_where_it_is_not_built_and_says_who_has_it() {
    let place = Place::new();
    let run = Run::read(&place.path("")).expect("a run");
    for format in Format::ALL {
        let is_built = match format {
            Format::Parquet => cfg!(feature = "parquet"),
            Format::Hdf5 => cfg!(feature = "hdf5"),
        };
        assert_eq!(run.outputs(format).is_ok(), is_built);
        let error = TablesError::NotBuilt(format);
        let expected = format!("expected nboom itself, with the feature {}", format.name());
        assert!(error.to_string().contains(&expected), "{error}");
        assert!(error.is_of_input());
    }
}
