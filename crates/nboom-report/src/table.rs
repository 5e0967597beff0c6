//! Tables of a run, read row by row up to the first that is none.

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read};
use std::ops::Index;
use std::path::Path;

use nboom_results::column_name;

use crate::Gap;
use crate::thin::thinned;

/// The longest line that is read \[bytes\]: that of tens of thousands of joints.
const LONGEST_LINE: u64 = 1 << 24;

/// Numbers of a table that are held at once; a longer table is thinned while it is read.
const MOST_NUMBERS: usize = 1 << 24;

/// Share of the largest number of a quantity below which changes are rounding.
const ROUNDING: f64 = 1e-9;

/// Numbers by column, the first of which is time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    pub(crate) names: Vec<String>,
    pub(crate) columns: Vec<Vec<f64>>,
    /// Rows that were read, those left out since included.
    pub(crate) read: usize,
}

impl Table {
    /// Names of the columns.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The times of the rows, which ascend; of one instant with an event there are two.
    pub fn times(&self) -> &[f64] {
        self.columns.first().map_or(&[], Vec::as_slice)
    }

    /// The column of this name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        let place = self.names.iter().position(|known| known == name)?;
        Some(&self.columns[place])
    }

    /// Without rows.
    pub(crate) fn new(names: Vec<String>) -> Self {
        let columns = vec![Vec::new(); names.len()];
        Self { names, columns, read: 0 }
    }

    pub(crate) fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Adds a row; of a table that grows too long every part keeps what can be seen.
    pub(crate) fn push(&mut self, row: &[f64]) {
        self.read += 1;
        self.columns.iter_mut().zip(row).for_each(|(column, value)| column.push(*value));
        if self.rows() * self.columns.len() > MOST_NUMBERS {
            let kept = thinned(&self.columns, &self.ranges(), &[], self.rows() / 2);
            self.keep(&kept.rows);
        }
    }

    /// Of every column but the time the range that a figure of it has; zero of one that only rounding moves, and
    /// of residuals, which are rounding.
    pub(crate) fn ranges(&self) -> Vec<f64> {
        let bounds = self.columns.iter().map(|column| {
            let first = [f64::INFINITY, f64::NEG_INFINITY];
            column.iter().fold(first, |[low, high], value| [low.min(*value), high.max(*value)])
        });
        let bounds: Vec<[f64; 2]> = bounds.collect();
        let quantity =
            |name: &'_ str| name.rsplit_once('_').map_or(name, |(quantity, _)| quantity).to_owned();
        let mut largest: HashMap<String, f64> = HashMap::new();
        for (name, [low, high]) in self.names.iter().zip(&bounds) {
            let known = largest.entry(quantity(name)).or_default();
            *known = known.max(low.abs()).max(high.abs());
        }
        let range = |(name, [low, high]): (&String, &[f64; 2])| {
            let is_seen = high - low > ROUNDING * largest[&quantity(name)];
            if is_seen && !name.starts_with("residual_") { high - low } else { 0.0 }
        };
        self.names.iter().zip(&bounds).skip(1).map(range).collect()
    }

    /// Keeps these rows, which ascend.
    pub(crate) fn keep(&mut self, rows: &[usize]) {
        for column in &mut self.columns {
            *column = rows.iter().map(|&row| column[row]).collect();
        }
    }

    /// Puts the rows of another table with the same columns in, by time; of one time, those of this table last.
    pub(crate) fn merge(&mut self, other: &Self) {
        let (times, others) = (&self.columns[0], &other.columns[0]);
        let mut order: Vec<(f64, bool, usize)> = Vec::with_capacity(times.len() + others.len());
        order.extend(others.iter().enumerate().map(|(row, time)| (*time, false, row)));
        order.extend(times.iter().enumerate().map(|(row, time)| (*time, true, row)));
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
        for (own, others) in self.columns.iter_mut().zip(&other.columns) {
            let value = |&(_, is_own, row): &(f64, bool, usize)| {
                if is_own { own[row] } else { others[row] }
            };
            *own = order.iter().map(value).collect();
        }
    }
}

/// The header and the rows of a file, as text.
pub(crate) struct Rows {
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
pub(crate) struct Fields<'a> {
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
    pub fn open(directory: &Path, file: &'static str) -> Result<Option<Self>, Gap> {
        let unreadable = |source| Gap::Unreadable { file, source };
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
    pub fn place(&self, name: &str) -> Result<usize, Gap> {
        let place = self.names.iter().position(|known| known == name);
        place.ok_or_else(|| Gap::NoColumn { file: self.file, expected: name.to_owned() })
    }

    /// Where these columns are.
    pub fn places<const N: usize>(&self, names: [&str; N]) -> Result<[usize; N], Gap> {
        let mut places = [0; N];
        for (place, name) in places.iter_mut().zip(names) {
            *place = self.place(name)?;
        }
        Ok(places)
    }

    /// Reads the next line; false at the end of the file.
    fn advance(&mut self) -> Result<bool, Gap> {
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
            Err(source) => Err(Gap::Unreadable { file: self.file, source }),
        }
    }

    /// Hands on the fields of each row, up to the end or to the first that is no row.
    ///
    /// # Errors
    /// When a row has another number of fields than the header, is cut off, or `take` finds it wrong.
    pub fn each(
        &mut self,
        mut take: impl FnMut(&Fields<'_>) -> Result<(), String>,
    ) -> Result<(), Gap> {
        while self.advance()? {
            let Self { line, ends, .. } = self;
            ends.clear();
            let commas = line.bytes().enumerate().filter(|(_, byte)| *byte == b',');
            ends.extend(commas.map(|(place, _)| place).chain([line.len()]));
            let (found, expected) = (self.ends.len(), self.names.len());
            let taken = if found == expected {
                take(&Fields { line: &self.line, ends: &self.ends })
            } else {
                Err(format!("{found} fields found, {expected} expected"))
            };
            taken.map_err(|found| self.wrong(found))?;
        }
        Ok(())
    }

    fn wrong(&self, found: String) -> Gap {
        Gap::Row { file: self.file, line: self.number, found }
    }
}

/// A number of a table.
///
/// # Errors
/// When it is none.
pub(crate) fn number(field: &str) -> Result<f64, String> {
    let value: Option<f64> = field.parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| {
        format!("`{}` found, a number expected", field.chars().take(30).collect::<String>())
    })
}

/// A count of a table.
///
/// # Errors
/// When it is none.
pub(crate) fn count(field: &str) -> Result<usize, String> {
    field.parse().map_err(|_| {
        format!("`{}` found, a count expected", field.chars().take(30).collect::<String>())
    })
}

/// The columns of a file that `is_wanted`, time first; the second value is what ended it early.
pub(crate) fn read_columns(
    directory: &Path,
    file: &'static str,
    is_wanted: impl Fn(&str) -> bool,
) -> Result<Option<(Table, Option<Gap>)>, Gap> {
    let Some(mut rows) = Rows::open(directory, file)? else { return Ok(None) };
    let time = rows.place("t")?;
    let others = rows.names.iter().enumerate().filter(|(i, name)| *i != time && is_wanted(name));
    let places: Vec<usize> = [time].into_iter().chain(others.map(|(i, _)| i)).collect();
    let names = places.iter().map(|&i| rows.names[i].clone()).collect();
    let mut table = Table::new(names);
    let mut row = Vec::with_capacity(places.len());
    let ended = rows.each(|fields| {
        row.clear();
        for &place in &places {
            row.push(number(&fields[place])?);
        }
        table.push(&row);
        Ok(())
    });
    Ok(Some((table, ended.err())))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn read(text: &str) -> Result<(Table, Option<Gap>), Gap> {
        let place = tempfile::tempdir().expect("a directory");
        fs::write(place.path().join("states.csv"), text).expect("writable");
        let read = read_columns(place.path(), "states.csv", |name| name != "left_out");
        read.map(|found| found.expect("it is there"))
    }

    #[test]
    fn whole_rows_are_read_and_the_first_broken_one_is_named() {
        let (table, gap) = read("t,a,left_out\n0.0,1.0,x\n1.0,2.0,x\n").expect("a table");
        assert!(gap.is_none());
        assert_eq!(table.names, ["t", "a"]);
        assert_eq!(table.columns, [[0.0, 1.0], [1.0, 2.0]]);
        for (last, told) in [
            ("2.0,3.", "line 4: 2 fields found, 3 expected"),
            ("2.0,3.0,x", "line 4: the line is cut off"),
            ("2.0,nothing,x\n", "line 4: `nothing` found, a number expected"),
            ("2.0,NaN,x\n", "line 4: `NaN` found, a number expected"),
            ("2.0,3.0\n", "line 4: 2 fields found, 3 expected"),
        ] {
            let text = format!("t,a,left_out\n0.0,1.0,x\n1.0,2.0,x\n{last}");
            let (table, gap) = read(&text).expect("a table");
            let gap = gap.expect("a row is broken").to_string();
            assert_eq!(table.rows(), 2, "{last}");
            let is_told = gap.contains(told)
                || (!last.ends_with('\n') && gap.contains("the line is cut off"));
            assert!(is_told, "{gap}");
        }
        assert!(matches!(read("a,b\n"), Err(Gap::NoColumn { .. })));
        assert!(read("").is_err());
    }

    #[test]
    fn rows_of_one_time_stay_in_order() {
        let mut states = Table::new(vec!["t".to_owned(), "a".to_owned()]);
        let mut instants = states.clone();
        [[0.0, 1.0], [1.0, 2.0], [2.0, 3.0]].iter().for_each(|row| states.push(row));
        [[1.0, 10.0], [1.0, 20.0]].iter().for_each(|row| instants.push(row));
        states.merge(&instants);
        assert_eq!(states.columns, [[0.0, 1.0, 1.0, 1.0, 2.0], [1.0, 10.0, 20.0, 2.0, 3.0]]);
    }
}
