use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::group::Group;
use crate::parquet::ParquetFile;
use crate::{Cell, Column, TablesError};

/// A table that is made row by row, in CSV or Parquet.
///
/// In CSV each row is in the file when [`Self::row`] returns. In Parquet rows wait in memory until there are
/// enough of them, and nobody can read the file before [`Self::finish`].
#[derive(Debug)]
pub struct TableWriter {
    path: PathBuf,
    columns: Vec<Column>,
    rows: usize,
    out: Out,
}

#[derive(Debug)]
enum Out {
    Csv(File),
    Parquet(Box<ParquetFile>, Group),
}

impl TableWriter {
    /// A table in CSV at `path`, with the names of the columns in its first line.
    ///
    /// # Errors
    /// When the file cannot be made.
    pub fn csv(path: &Path, columns: Vec<Column>) -> Result<Self, TablesError> {
        let file = File::create(path).map_err(TablesError::writing(path))?;
        let mut table = Self { path: path.to_owned(), columns, rows: 0, out: Out::Csv(file) };
        let names: Vec<String> =
            table.columns.iter().map(|column| Cell::Text(&column.name).to_string()).collect();
        table.line(names)?;
        Ok(table)
    }

    /// A table in Parquet at `path`, with units, descriptions and bodies of the columns, and with these texts
    /// by their names.
    ///
    /// # Errors
    /// When this format is not built, and when the file cannot be made.
    pub fn parquet(
        path: &Path,
        columns: Vec<Column>,
        texts: &[(&str, &str)],
    ) -> Result<Self, TablesError> {
        let file = ParquetFile::create(path, &columns, texts)?;
        let out = Out::Parquet(Box::new(file), Group::of(&columns));
        Ok(Self { path: path.to_owned(), columns, rows: 0, out })
    }

    /// Adds a row.
    ///
    /// # Errors
    /// When the cells are not those of the columns, and nothing is written then; when the file cannot be written.
    pub fn row(&mut self, cells: &[Cell<'_>]) -> Result<(), TablesError> {
        self.admit(cells)?;
        self.rows += 1;
        match &mut self.out {
            Out::Csv(_) => self.line(cells.iter().map(Cell::to_string).collect()),
            Out::Parquet(file, group) => {
                group.push(cells);
                if group.is_full() {
                    file.write(group)?;
                    group.clear();
                }
                Ok(())
            }
        }
    }

    /// Writes what waits, and waits for the disk.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn finish(self) -> Result<(), TablesError> {
        match self.out {
            Out::Csv(file) => file.sync_all().map_err(TablesError::writing(&self.path)),
            Out::Parquet(mut file, group) => {
                file.write(&group)?;
                file.close()
            }
        }
    }

    fn admit(&self, cells: &[Cell<'_>]) -> Result<(), TablesError> {
        let wrong = |column: Option<&Column>, found| TablesError::Cell {
            path: self.path.clone(),
            row: self.rows + 1,
            column: column.map(|column| column.name.clone()),
            found,
        };
        let (found, expected) = (cells.len(), self.columns.len());
        if found != expected {
            return Err(wrong(None, format!("{found} cells found, {expected} expected")));
        }
        let mut pairs = self.columns.iter().zip(cells);
        pairs.try_for_each(|(column, cell)| {
            column.kind.admit(cell).map_err(|found| wrong(Some(column), found))
        })
    }

    fn line(&mut self, fields: Vec<String>) -> Result<(), TablesError> {
        let Out::Csv(file) = &mut self.out else { return Ok(()) };
        // In one piece, so that a kill hardly ever leaves half a line.
        let written = file.write_all((fields.join(",") + "\n").as_bytes());
        written.map_err(TablesError::writing(&self.path))
    }
}
