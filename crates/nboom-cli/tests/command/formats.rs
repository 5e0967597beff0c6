//! Tables in formats that this build lacks. `.ci/tables` tries builds that have them.

use crate::{Place, code, refused, stderr};

/// Whether a format can be asked for.
fn has(format: &str) -> bool {
    [("parquet", cfg!(feature = "parquet")), ("hdf5", cfg!(feature = "hdf5"))]
        .contains(&(format, true))
}

#[test]
fn a_format_that_is_not_built_is_refused_before_anything_is_written() {
    let place = Place::new();
    let made = place.nboom(&["run", "boom.nml", "-o", "out", "--quiet", "--no-report"]);
    assert_eq!((code(&made), stderr(&made)), (0, String::new()));
    for format in ["parquet", "hdf5"].into_iter().filter(|format| !has(format)) {
        let how = format!("cargo install --locked --path crates/nboom-cli --features {format}");
        let run = place.nboom(&["run", "boom.nml", "-o", "refused", "--tables", format]);
        refused(&run, 2, &[format, &how]);
        assert!(!place.path("refused").exists() && !place.path("refused.partial").exists());
        refused(&place.nboom(&["tables", "out", "--format", format]), 2, &[format, &how]);
        assert!(!place.path("out-tables").exists());
    }
}

#[test]
fn a_format_that_there_is_not_is_refused_with_those_there_are() {
    let place = Place::new();
    for words in [&["run", "boom.nml", "--tables", "xlsx"], &["tables", "out", "--format", "xlsx"]]
    {
        refused(&place.nboom(words), 2, &["xlsx", "parquet", "hdf5"]);
    }
}
