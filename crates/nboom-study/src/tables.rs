//! The tables of a sweep, from its journals.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use nboom_io::sha256_of;
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
    let statistics = Statistics::new(what.fields(), &what.requirements);
    let mut statistics = statistics.of_runs_within(what.rtol);
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

/// Says of tables what they are now, of those among them that are there.
///
/// # Errors
/// When one cannot be read.
pub(crate) fn describe(
    place: &Place,
    names: &[&str],
    what: &mut Description,
) -> Result<(), StudyError> {
    for name in names {
        let path = place.file(name);
        if let Some(length) = length(&path)? {
            what.tables.insert((*name).to_owned(), length);
            what.sums.insert((*name).to_owned(), sum(&path)?);
        }
    }
    Ok(())
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

/// As [`require`], also with other bytes of the same length.
///
/// # Errors
/// When a table is not what the sweep wrote.
pub(crate) fn require_unchanged(place: &Place, what: &Description) -> Result<(), StudyError> {
    require(place, &what.tables)?;
    let are_there = what.sums.iter().map(|(name, sum)| (place.file(name), sum));
    for (path, expected) in are_there.filter(|(path, _)| path.exists()) {
        let found = sum(&path)?;
        if found != *expected {
            return Err(StudyError::altered(&path, &found, expected));
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

/// The SHA-256 of a file.
fn sum(path: &Path) -> Result<String, StudyError> {
    File::open(path).and_then(sha256_of).map_err(StudyError::reading(path))
}

/// Writes those tables in CSV that are not there, from those in Parquet, and says whether there were any.
///
/// # Errors
/// When a table is not what the sweep wrote, and when one cannot be read or written; an earlier one then stays.
pub(crate) fn add_csv(place: &Place, what: &mut Description) -> Result<bool, StudyError> {
    let columns = what.columns_of_tables();
    let is_missing = |&([_, csv], columns): &([&str; 2], &[Column])| {
        // One without a sum is of a process that was killed before it was described.
        let is_described = what.sums.is_empty() || what.sums.contains_key(csv);
        let is_whole = is_described && place.file(csv).exists();
        !columns.is_empty() && !is_whole
    };
    let pairs = TWINS.into_iter().zip([columns.cases, columns.states]);
    let missing: Vec<_> = pairs.filter(is_missing).collect();
    if missing.is_empty() {
        return Ok(false);
    }
    require_unchanged(place, what)?;
    missing.iter().try_for_each(|&([from, to], columns)| {
        make_file(&place.file(to), |path: &Path| -> Result<(), StudyError> {
            let mut table = TableWriter::csv(path, columns.to_vec())?;
            read_table(&place.file(from), columns, |cells| -> Result<(), StudyError> {
                Ok(table.row(cells)?)
            })?;
            Ok(table.finish()?)
        })
    })?;
    let added: Vec<&str> = missing.into_iter().map(|([_, csv], _)| csv).collect();
    describe(place, &added, what)?;
    Ok(true)
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
