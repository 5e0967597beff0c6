//! Columns of tables of the motion: names, units and meanings, and the numbers of a run.

use nboom_model::{HingeLabel, UnitSystem, WantedTable};
use nboom_results::{motion_heads, quantity};
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
        Self::new(WantedTable::states(hinges.len()), hinges, rows)
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
        let told = |head: nboom_results::Head| {
            // States of hinges are numbers here like all others.
            let unit = head.unit(units).unwrap_or_else(|| "1".to_owned());
            (head.name.into_owned(), unit, head.about.into_owned())
        };
        motion_heads(&self.table, hinges).into_iter().map(told).collect()
    }
}
