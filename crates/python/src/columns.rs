//! Columns of tables of the motion: names, units and meanings, and the numbers of a run.

use nboom_model::{Column, HingeLabel, UnitSystem, WantedTable};
use nboom_results::quantity;
use nboom_sim::Snapshot;
use pyo3::prelude::*;

use crate::arrays::room;

/// Name, unit and meaning of a column.
pub(crate) type Head = (String, String, String);

/// A table of the motion while it fills.
#[derive(Clone, Debug)]
pub(crate) struct MotionTable {
    table: WantedTable,
    /// Which of its columns are in degrees.
    in_degrees: Vec<bool>,
    /// Row after row, each of which begins with the time.
    pub numbers: Vec<f64>,
}

impl MotionTable {
    /// Without rows, but with memory for so many.
    ///
    /// # Errors
    /// `MemoryError` where there is none.
    pub fn new(table: WantedTable, hinges: &[HingeLabel], rows: usize) -> PyResult<Self> {
        let in_degrees =
            table.columns.iter().map(|column| table.is_in_degrees(column, hinges)).collect();
        let numbers = room(&[rows, 1 + table.columns.len()])?;
        Ok(Self { table, in_degrees, numbers })
    }

    /// That of states: all columns, angles in radians.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_states(hinges: &[HingeLabel], rows: usize) -> PyResult<Self> {
        let columns = Column::all(hinges.len());
        Self::new(WantedTable { columns, in_degrees: false }, hinges, rows)
    }

    /// Whether it takes an evaluation of the equations of motion for each row.
    pub fn needs_detail(&self) -> bool {
        self.table.needs_detail()
    }

    /// How many columns there are, time included.
    pub fn width(&self) -> usize {
        1 + self.table.columns.len()
    }

    /// Adds a row.
    pub fn push(&mut self, snapshot: &Snapshot) {
        self.numbers.push(snapshot.time);
        for (column, &in_degrees) in self.table.columns.iter().zip(&self.in_degrees) {
            let number = quantity(column, snapshot);
            self.numbers.push(if in_degrees { number.to_degrees() } else { number });
        }
    }

    /// Names, units and meanings of all columns.
    pub fn heads(&self, hinges: &[HingeLabel], units: &UnitSystem) -> Vec<Head> {
        let time = ("t".to_owned(), units.time().to_owned(), "time".to_owned());
        let head = |(column, &in_degrees): (&Column, &bool)| {
            let suffix = if in_degrees { "_deg" } else { "" };
            let unit = units.label(self.table.unit(column, hinges));
            (column.name(hinges) + suffix, unit, column.about(hinges).to_owned())
        };
        let columns = self.table.columns.iter().zip(&self.in_degrees);
        [time].into_iter().chain(columns.map(head)).collect()
    }
}
