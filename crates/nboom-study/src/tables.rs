//! The tables of a sweep, from its journals.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use nboom_results::make_file;
use nboom_tables::{Column, Format, TableWriter, read_table};

use crate::directory::{
    CASES_CSV_FILE, CASES_FILE, Place, TRAJECTORIES_CSV_FILE, TRAJECTORIES_FILE,
};
use crate::frame::Columns;
use crate::journal::{Journal, Part};
use crate::statistics::{Statistics, Summary};
use crate::{Description, StudyError};

/// Tables in Parquet and in CSV, of cases and of trajectories.
pub(crate) const TWINS: [[&str; 2]; 2] =
    [[CASES_FILE, CASES_CSV_FILE], [TRAJECTORIES_FILE, TRAJECTORIES_CSV_FILE]];

/// A table in one format.
#[derive(Clone, Copy, Debug)]
struct Table<'a> {
    file: &'static str,
    part: Part,
    columns: &'a [Column],
    is_parquet: bool,
}

/// How many formats a table is written in.
pub(crate) fn formats(csv: bool) -> u64 {
    u64::from(has_parquet()) + u64::from(csv || !has_parquet())
}

pub(crate) fn has_parquet() -> bool {
    Format::Parquet.require().is_ok()
}

/// Statistics of all cases of these journals.
///
/// # Errors
/// When a journal cannot be read or has other rows.
pub(crate) fn statistics(what: &Description, journals: &[Journal]) -> Result<Summary, StudyError> {
    let mut statistics = Statistics::new(what.fields(), &what.requirements);
    for journal in journals {
        journal.each(Part::Case, &what.columns, |cells| {
            statistics.row(cells);
            Ok(())
        })?;
    }
    Ok(statistics.finish())
}

/// Writes the tables of journals that together have all cases, in order; `texts` belong to them, by name.
///
/// They are in Parquet, and in CSV if that is asked for or if there is no Parquet in this build.
///
/// # Errors
/// When a table cannot be written or a journal cannot be read; an earlier table then stays.
pub(crate) fn write_tables(
    place: &Place,
    columns: Columns<'_>,
    journals: &[Journal],
    texts: &[(&str, &str)],
    csv: bool,
) -> Result<(), StudyError> {
    let table = |file, part, is_parquet| {
        let columns = if part == Part::Case { columns.cases } else { columns.states };
        Table { file, part, columns, is_parquet }
    };
    let all = [
        table(CASES_FILE, Part::Case, true),
        table(TRAJECTORIES_FILE, Part::States, true),
        table(CASES_CSV_FILE, Part::Case, false),
        table(TRAJECTORIES_CSV_FILE, Part::States, false),
    ];
    let is_wanted = |table: &Table<'_>| {
        let is_format = if table.is_parquet { has_parquet() } else { csv || !has_parquet() };
        is_format && !table.columns.is_empty()
    };
    all.into_iter().filter(is_wanted).try_for_each(|table| {
        make_file(&place.file(table.file), |path: &Path| table.write(path, journals, texts))
    })
}

/// How long the tables are that are there \[bytes\].
///
/// # Errors
/// When the system does not say.
pub(crate) fn lengths(place: &Place) -> Result<BTreeMap<String, u64>, StudyError> {
    let mut found = BTreeMap::new();
    for name in TWINS.as_flattened() {
        if let Some(length) = length(&place.file(name))? {
            found.insert((*name).to_owned(), length);
        }
    }
    Ok(found)
}

/// # Errors
/// When a table is not as long as it was, or is not there; one in CSV may be gone where there is that in Parquet.
pub(crate) fn require(place: &Place, tables: &BTreeMap<String, u64>) -> Result<(), StudyError> {
    let is_copy = |name: &str| {
        TWINS.iter().any(|[parquet, csv]| name == *csv && tables.contains_key(*parquet))
    };
    for (name, expected) in tables {
        let path = place.file(name);
        match length(&path)? {
            Some(found) if found == *expected => {}
            None if is_copy(name) => {}
            None => return Err(StudyError::Missing { path }),
            Some(found) => {
                let [found, expected] = [found, *expected].map(|bytes| format!("{bytes} bytes"));
                return Err(StudyError::Altered { path, found, expected });
            }
        }
    }
    Ok(())
}

/// The file in the directory of a finished sweep with a table of this part; one that this build can read, if it is
/// there.
pub(crate) fn path(directory: &Path, part: Part) -> PathBuf {
    let [parquet, csv] = TWINS[usize::from(part == Part::States)].map(|name| directory.join(name));
    let is_readable = has_parquet() || !csv.exists();
    if parquet.exists() && is_readable { parquet } else { csv }
}

/// How long a file is \[bytes\], if it is there.
fn length(path: &Path) -> Result<Option<u64>, StudyError> {
    match fs::metadata(path) {
        Ok(found) => Ok(Some(found.len())),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(StudyError::reading(path)(error)),
    }
}

/// Writes those tables in CSV that are not there, from those in Parquet, and says whether there were any.
///
/// # Errors
/// When a table cannot be read or written; an earlier one then stays.
pub(crate) fn add_csv(place: &Place, columns: Columns<'_>) -> Result<bool, StudyError> {
    let is_missing = |&([_, csv], columns): &([&str; 2], &[Column])| {
        !columns.is_empty() && !place.file(csv).exists()
    };
    let pairs = TWINS.into_iter().zip([columns.cases, columns.states]);
    let missing: Vec<_> = pairs.filter(is_missing).collect();
    missing.iter().try_for_each(|&([from, to], columns)| {
        make_file(&place.file(to), |path: &Path| -> Result<(), StudyError> {
            let mut table = TableWriter::csv(path, columns.to_vec())?;
            read_table(&place.file(from), columns, |cells| -> Result<(), StudyError> {
                Ok(table.row(cells)?)
            })?;
            Ok(table.finish()?)
        })
    })?;
    Ok(!missing.is_empty())
}

impl Table<'_> {
    fn write(
        &self,
        path: &Path,
        journals: &[Journal],
        texts: &[(&str, &str)],
    ) -> Result<(), StudyError> {
        let columns = self.columns.to_vec();
        let mut table = if self.is_parquet {
            TableWriter::parquet(path, columns, texts)?
        } else {
            TableWriter::csv(path, columns)?
        };
        for journal in journals {
            journal.each(self.part, self.columns, |cells| Ok(table.row(cells)?))?;
        }
        Ok(table.finish()?)
    }
}
