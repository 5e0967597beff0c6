use std::fs::File;
use std::io::Read;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord};

use crate::parquet::each_group;
use crate::{Cell, Column, TablesError};

/// Rows in CSV without a header, where words may stand in quotes.
#[derive(Debug)]
pub struct CsvRows<'c, R> {
    reader: csv::Reader<R>,
    record: StringRecord,
    columns: &'c [Column],
}

impl<'c, R: Read> CsvRows<'c, R> {
    /// Rows of these columns.
    pub fn new(reader: R, columns: &'c [Column]) -> Self {
        let reader = ReaderBuilder::new().has_headers(false).flexible(true).from_reader(reader);
        Self { reader, record: StringRecord::new(), columns }
    }

    /// The cells of the next row; nothing at the end.
    ///
    /// # Errors
    /// When it cannot be read or has something else than cells of the columns, in words.
    pub fn next_row(&mut self) -> Result<Option<Vec<Cell<'_>>>, String> {
        if !self.advance()? {
            return Ok(None);
        }
        let pairs = self.record.iter().zip(self.columns);
        pairs.map(|(field, column)| column.cell(field)).collect::<Result<_, _>>().map(Some)
    }

    /// Reads the next row; false at the end.
    fn advance(&mut self) -> Result<bool, String> {
        let read = self.reader.read_record(&mut self.record);
        let is_there = read.map_err(|error| error.to_string())?;
        let (found, expected) = (self.record.len(), self.columns.len());
        if is_there && found != expected {
            return Err(format!("a row of {found} fields, {expected} expected"));
        }
        Ok(is_there)
    }
}

/// Hands on the rows of a file `NAME.csv` or `NAME.parquet` that a [`crate::TableWriter`] wrote, in groups
/// at most in memory.
///
/// # Errors
/// When it cannot be read, when it has other columns, when this build lacks its format, and those of `take`.
pub fn read_table<E: From<TablesError>>(
    path: &Path,
    columns: &[Column],
    mut take: impl FnMut(&[Cell<'_>]) -> Result<(), E>,
) -> Result<(), E> {
    if path.extension().is_some_and(|ending| ending == "parquet") {
        return each_group(path, columns, |group| {
            (0..group.rows).try_for_each(|row| take(&group.row(row)))
        });
    }
    let file = File::open(path).map_err(TablesError::reading(path))?;
    let mut rows = CsvRows::new(file, columns);
    let wrong = |found| TablesError::Table { path: path.to_owned(), found };
    rows.advance().map_err(wrong)?;
    if !rows.record.iter().eq(columns.iter().map(|column| column.name.as_str())) {
        return Err(wrong("other names of columns".to_owned()).into());
    }
    while let Some(cells) = rows.next_row().map_err(wrong)? {
        take(&cells)?;
    }
    Ok(())
}
