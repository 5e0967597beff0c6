//! Tables of a run as columns of numbers.

use std::collections::HashMap;
use std::path::Path;

use nboom_tables::{Rows, number};

use crate::Gap;
use crate::rounding::{Sizes, of_no_momentum};
use crate::thin::thinned;

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
    /// Of the scene whose motion this is.
    pub(crate) sizes: Option<Sizes>,
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
        Self { names, columns, read: 0, sizes: None }
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
        let is_of_none = of_no_momentum(self);
        let range = |(name, [low, high]): (&String, &[f64; 2])| {
            let is_seen = high - low > ROUNDING * largest[&quantity(name)];
            let is_rounding = name.starts_with("residual_") || is_of_none(name);
            if is_seen && !is_rounding { high - low } else { 0.0 }
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

/// The columns of a file that `is_wanted`, time first, of a scene with these `sizes`; the second value is what ended it
/// early.
pub(crate) fn read_columns(
    directory: &Path,
    file: &'static str,
    is_wanted: impl Fn(&str) -> bool,
    sizes: Option<Sizes>,
) -> Result<Option<(Table, Option<Gap>)>, Gap> {
    let Some(mut rows) = Rows::open(directory, file)? else { return Ok(None) };
    let time = rows.place("t")?;
    let others = rows.names.iter().enumerate().filter(|(i, name)| *i != time && is_wanted(name));
    let places: Vec<usize> = [time].into_iter().chain(others.map(|(i, _)| i)).collect();
    let names = places.iter().map(|&i| rows.names[i].clone()).collect();
    let mut table = Table { sizes, ..Table::new(names) };
    let mut row = Vec::with_capacity(places.len());
    let ended = rows.each(|fields| {
        row.clear();
        for &place in &places {
            row.push(number(&fields[place])?);
        }
        table.push(&row);
        Ok(())
    });
    Ok(Some((table, ended.err().map(Gap::from))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn read(text: &str) -> Result<(Table, Option<Gap>), Gap> {
        let place = tempfile::tempdir().expect("a directory");
        fs::write(place.path().join("states.csv"), text).expect("writable");
        let read = read_columns(place.path(), "states.csv", |name| name != "left_out", None);
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
