//! Tables for other programs: formats that do not exist, and files that are there. A format that a program was
//! built without is refused in `docs/how-to/compile.md`.

use std::fs;

use crate::{Place, code, refused, stderr};

#[test]
fn a_format_that_there_is_not_is_refused_with_those_there_are() {
    let place = Place::new();
    for words in [&["run", "boom.nml", "--tables", "xlsx"], &["tables", "out", "--format", "xlsx"]]
    {
        refused(&place.nboom(words), 2, &["xlsx", "parquet", "hdf5"]);
    }
}

#[test]
fn tables_of_a_run_replace_no_file_and_never_go_among_results() {
    let place = Place::new();
    for into in ["one", "other"] {
        assert_eq!(code(&place.nboom(&["run", "boom.nml", "-o", into, "--quiet"])), 0);
    }
    let tables = |options: &[&str]| {
        place.nboom(&[&["tables", "one", "--format", "parquet"], options].concat())
    };
    let read = |name: &str| fs::read(place.path(name)).expect("a file");
    fs::create_dir(place.path("mine")).expect("a folder");
    place.write("mine/states.parquet", "mine");
    refused(&tables(&["-o", "mine"]), 2, &["mine/states.parquet", "--force replaces it"]);
    assert_eq!(read("mine/states.parquet"), b"mine");
    // Nothing is written before all is looked at.
    assert_eq!(fs::read_dir(place.path("mine")).expect("a folder").count(), 1);
    let forced = tables(&["-o", "mine", "--force"]);
    assert_eq!((code(&forced), stderr(&forced)), (0, String::new()));
    assert!(read("mine/states.parquet").starts_with(b"PAR1"));
    for folder in ["one", "other"] {
        let told = ["found results of a run", "nboom run --tables"];
        refused(&tables(&["-o", folder, "--force"]), 2, &told);
        assert!(!place.path(folder).join("states.parquet").exists());
        // A later run is not kept from its place.
        assert_eq!(code(&place.nboom(&["run", "boom.nml", "-o", folder, "--quiet"])), 0);
    }
}
