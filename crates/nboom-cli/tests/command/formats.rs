//! Formats of tables that do not exist. One that a program was built without is refused in `docs/how-to/compile.md`.

use crate::{Place, refused};

#[test]
fn a_format_that_there_is_not_is_refused_with_those_there_are() {
    let place = Place::new();
    for words in [&["run", "boom.nml", "--tables", "xlsx"], &["tables", "out", "--format", "xlsx"]]
    {
        refused(&place.nboom(words), 2, &["xlsx", "parquet", "hdf5"]);
    }
}
