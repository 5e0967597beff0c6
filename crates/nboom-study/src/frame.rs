//! Frames of a journal: a line that says which cases follow in how many bytes, and their rows in CSV.

use std::borrow::Cow;
use std::io::Write as _;
use std::ops::RangeInclusive;

use nboom_tables::{Cell, Column, Kind};

use crate::Row;

/// The longest first line of a frame \[bytes\].
pub(crate) const LONGEST_HEAD: u64 = 128;

/// The first line of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Head {
    /// The first case.
    pub first: u64,
    /// The last case.
    pub last: u64,
    /// Bytes of rows of cases.
    pub rows: u64,
    /// Bytes of rows of trajectories, which come after them.
    pub states: u64,
    /// Of what stands in this line before it, and of all rows.
    pub checksum: u32,
}

impl Head {
    /// Reads a line with its end; none if it is anything else.
    pub fn parse(line: &[u8]) -> Option<Self> {
        let text = std::str::from_utf8(line).ok()?;
        let words: Vec<&str> = text.strip_prefix("batch ")?.trim_end().split(' ').collect();
        let [first, last, rows, states, checksum] = words[..] else { return None };
        let head = Self {
            first: first.parse().ok()?,
            last: last.parse().ok()?,
            rows: rows.parse().ok()?,
            states: states.parse().ok()?,
            checksum: u32::from_str_radix(checksum, 16).ok()?,
        };
        // There is one way to write it.
        (head.text() == text && 1 <= head.first && head.first <= head.last).then_some(head)
    }

    /// Reads the line of a whole frame and nothing else; none if it is anything else.
    pub fn of_whole(frame: &[u8]) -> Option<Self> {
        let line = frame.iter().take(LONGEST_HEAD as usize).position(|byte| *byte == b'\n')?;
        let (line, rows) = frame.split_at(line + 1);
        let head = Self::parse(line)?;
        let length = usize::try_from(head.rows.checked_add(head.states)?).ok()?;
        let mut checksum = crc32fast::Hasher::new();
        checksum.update(head.said().as_bytes());
        checksum.update(rows);
        (rows.len() == length && checksum.finalize() == head.checksum).then_some(head)
    }

    /// The line.
    pub fn text(&self) -> String {
        format!("{} {:08x}\n", self.said(), self.checksum)
    }

    /// The line up to the checksum.
    pub fn said(&self) -> String {
        let Self { first, last, rows, states, .. } = self;
        format!("batch {first} {last} {rows} {states}")
    }
}

/// Columns of the tables of a sweep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Columns<'a> {
    /// Of cases.
    pub cases: &'a [Column],
    /// Of trajectories; none if they are not wanted.
    pub states: &'a [Column],
}

/// Rows of consecutive cases as text.
#[derive(Debug)]
pub(crate) struct Batch {
    /// The first case.
    pub first: u64,
    /// How many there are.
    pub cases: u64,
    rows: Vec<u8>,
    states: Vec<u8>,
}

impl Batch {
    /// Without cases, of which the first will be this one.
    pub fn from_case(first: u64) -> Self {
        Self { first, cases: 0, rows: Vec::new(), states: Vec::new() }
    }

    /// How long its rows are.
    pub fn bytes(&self) -> usize {
        self.rows.len() + self.states.len()
    }

    /// Adds the next case.
    ///
    /// # Panics
    /// When the row has other cells than there are columns, or is of another case; it is not added then.
    pub fn push(&mut self, row: &Row, columns: &Columns<'_>) {
        let case = (self.first + self.cases).cast_signed();
        let cells: Vec<Cell<'_>> = row.cells.iter().map(crate::Value::cell).collect();
        assert_eq!(cells.len(), columns.cases.len(), "a row has a cell for each column");
        assert_eq!(cells[0], Cell::Integer(case), "a row begins with the number of its case");
        let is_whole = |state: &Vec<f64>| state.len() + 1 == columns.states.len();
        assert!(row.states.iter().all(is_whole), "a state has a number for each column");
        let mut states = Vec::new();
        for state in &row.states {
            let numbers = columns.states[1..].iter().zip(state);
            let numbers = numbers.map(|(column, value)| number(column.kind, *value));
            line(&mut states, std::iter::once(Cell::Integer(case)).chain(numbers));
        }
        self.push_cells(&cells, states);
    }

    /// Adds the next case by the cells of its row and the lines of its states.
    pub fn push_cells(&mut self, cells: &[Cell<'_>], states: Vec<u8>) {
        line(&mut self.rows, cells.iter().copied());
        if self.states.is_empty() {
            // A trajectory may be too long to be held twice.
            self.states = states;
        } else {
            self.states.extend(states);
        }
        self.cases += 1;
    }

    /// The cases that it has.
    pub fn range(&self) -> RangeInclusive<u64> {
        self.first..=self.first + self.cases - 1
    }

    /// Its frame, in pieces, which may be too long to be held twice.
    pub fn frame(&self) -> [Cow<'_, [u8]>; 3] {
        let last = *self.range().end();
        let (rows, states) = (self.rows.len() as u64, self.states.len() as u64);
        let mut head = Head { first: self.first, last, rows, states, checksum: 0 };
        let mut checksum = crc32fast::Hasher::new();
        for part in [head.said().as_bytes(), &self.rows, &self.states] {
            checksum.update(part);
        }
        head.checksum = checksum.finalize();
        [head.text().into_bytes().into(), (&self.rows).into(), (&self.states).into()]
    }
}

/// A number in a column of trajectories, where what is not finite is nothing.
#[expect(clippy::cast_possible_truncation, reason = "codes of states are small whole numbers")]
fn number(kind: Kind, value: f64) -> Cell<'static> {
    match kind {
        _ if !value.is_finite() => Cell::Empty,
        Kind::Integer => Cell::Integer(value as i64),
        Kind::Number | Kind::Text => Cell::Number(value),
    }
}

/// The number of the case of a row, in either table; 0 if it has none.
pub(crate) fn case_of(cells: &[Cell<'_>]) -> u64 {
    match cells.first() {
        Some(Cell::Integer(case)) => case.cast_unsigned(),
        _ => 0,
    }
}

/// Writes a row in CSV.
pub(crate) fn line<'a>(out: &mut Vec<u8>, cells: impl Iterator<Item = Cell<'a>>) {
    for (i, cell) in cells.enumerate() {
        let comma = if i == 0 { "" } else { "," };
        write!(out, "{comma}{cell}").expect("memory takes all");
    }
    out.push(b'\n');
}
