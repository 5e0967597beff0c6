//! Tables of a run, read row by row up to the first that is none.

use std::fs::File;
use std::io::{self, BufRead, BufReader, ErrorKind, Read};
use std::ops::Index;
use std::path::Path;

use nboom_results::column_name;

/// The longest line that is read \[bytes\]: that of tens of thousands of joints.
const LONGEST_LINE: u64 = 1 << 24;

/// Why a table, or the rest of it, cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum RowsError {
    /// A file that cannot be read.
    #[error("{file} cannot be read: {source}")]
    Unreadable {
        /// The file.
        file: &'static str,
        /// Why.
        source: io::Error,
    },
    /// A table without columns that it should have.
    #[error("{file}, line 1: the column {expected} is missing")]
    NoColumn {
        /// The file.
        file: &'static str,
        /// The column.
        expected: String,
    },
    /// A row that is none.
    #[error("{file}, line {line}: {found}")]
    Row {
        /// The file.
        file: &'static str,
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        found: String,
    },
}

/// The header and the rows of a file, as text.
#[derive(Debug)]
pub struct Rows {
    file: &'static str,
    lines: BufReader<File>,
    /// Names of the columns.
    pub names: Vec<String>,
    line: String,
    number: usize,
    /// Where each field of the line ends.
    ends: Vec<usize>,
}

/// The fields of a row, by their number from 0.
#[derive(Debug)]
pub struct Fields<'a> {
    line: &'a str,
    ends: &'a [usize],
}

impl Index<usize> for Fields<'_> {
    type Output = str;

    fn index(&self, field: usize) -> &str {
        let start = if field == 0 { 0 } else { self.ends[field - 1] + 1 };
        &self.line[start..self.ends[field]]
    }
}

impl Rows {
    /// Opens a file of a run; nothing if it is not there.
    pub fn open(directory: &Path, file: &'static str) -> Result<Option<Self>, RowsError> {
        let unreadable = |source| RowsError::Unreadable { file, source };
        let opened = match File::open(directory.join(file)) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            opened => opened.map_err(unreadable)?,
        };
        if !opened.metadata().map_err(unreadable)?.is_file() {
            return Err(unreadable(ErrorKind::InvalidInput.into()));
        }
        let lines = BufReader::with_capacity(1 << 16, opened);
        let (names, line, ends) = (Vec::new(), String::new(), Vec::new());
        let mut rows = Self { file, lines, names, line, number: 0, ends };
        rows.advance()?;
        rows.names = rows.line.split(',').map(|cell| column_name(cell).to_owned()).collect();
        Ok(Some(rows))
    }

    /// Where a column is.
    ///
    /// # Errors
    /// When there is none.
    pub fn place(&self, name: &str) -> Result<usize, RowsError> {
        let place = self.names.iter().position(|known| known == name);
        place.ok_or_else(|| RowsError::NoColumn { file: self.file, expected: name.to_owned() })
    }

    /// Where these columns are.
    pub fn places<const N: usize>(&self, names: [&str; N]) -> Result<[usize; N], RowsError> {
        let mut places = [0; N];
        for (place, name) in places.iter_mut().zip(names) {
            *place = self.place(name)?;
        }
        Ok(places)
    }

    /// Reads the next line; false at the end of the file.
    fn advance(&mut self) -> Result<bool, RowsError> {
        self.line.clear();
        self.number += 1;
        let read = self.lines.by_ref().take(LONGEST_LINE).read_line(&mut self.line);
        match read {
            Ok(0) => Ok(false),
            Ok(_) if self.line.ends_with('\n') => {
                self.line.truncate(self.line.trim_end().len());
                Ok(true)
            }
            Ok(_) => Err(self.wrong("the line is cut off".to_owned())),
            Err(error) if error.kind() == ErrorKind::InvalidData => {
                Err(self.wrong("it is not text".to_owned()))
            }
            Err(source) => Err(RowsError::Unreadable { file: self.file, source }),
        }
    }

    /// The fields of the next row; nothing at the end of the file.
    ///
    /// # Errors
    /// When the row has another number of fields than the header, or is cut off.
    pub fn next_row(&mut self) -> Result<Option<Fields<'_>>, RowsError> {
        if !self.advance()? {
            return Ok(None);
        }
        let Self { line, ends, .. } = self;
        ends.clear();
        let commas = line.bytes().enumerate().filter(|(_, byte)| *byte == b',');
        ends.extend(commas.map(|(place, _)| place).chain([line.len()]));
        let (found, expected) = (self.ends.len(), self.names.len());
        if found != expected {
            return Err(self.wrong(format!("{found} fields found, {expected} expected")));
        }
        Ok(Some(Fields { line: &self.line, ends: &self.ends }))
    }

    /// Hands on the fields of each row, up to the end or to the first that is no row.
    ///
    /// # Errors
    /// As [`Self::next_row`], and when `take` finds a row wrong.
    pub fn each(
        &mut self,
        mut take: impl FnMut(&Fields<'_>) -> Result<(), String>,
    ) -> Result<(), RowsError> {
        while let Some(fields) = self.next_row()? {
            if let Err(found) = take(&fields) {
                return Err(self.wrong(found));
            }
        }
        Ok(())
    }

    pub(crate) fn wrong(&self, found: String) -> RowsError {
        RowsError::Row { file: self.file, line: self.number, found }
    }
}

/// A number of a table.
///
/// # Errors
/// When it is none.
pub fn number(field: &str) -> Result<f64, String> {
    let value: Option<f64> = field.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| {
        format!("`{}` found, a number expected", field.chars().take(30).collect::<String>())
    })
}

/// A count of a table.
///
/// # Errors
/// When it is none.
pub fn count(field: &str) -> Result<usize, String> {
    field.parse().map_err(|_| {
        format!("`{}` found, a count expected", field.chars().take(30).collect::<String>())
    })
}
