//! What a run has only where somebody asks for it: the motors of rotors, and what a test rig bears.

use std::path::Path;

use nboom_model::Quantity;
use nboom_results::OUTPUT_FILE;
use nboom_tables::Rows;

use crate::table::{Table, read_columns};
use crate::{Gap, Run};

/// The end of the name of a column in degrees.
const IN_DEGREES: &str = "_deg";

impl Run {
    /// Columns of `output.csv` that no other table has, in radians; nothing where nobody asked for them.
    pub fn requested(&self) -> Option<&Table> {
        self.requested.as_ref()
    }

    /// Whether a test rig moves the main body along an axis.
    pub fn is_slid(&self) -> bool {
        let drive = self.scene().and_then(|scene| scene.base.drive());
        drive.is_some_and(|drive| drive.points.iter().any(|point| point.speed != 0.0))
    }
}

/// Reads these columns; a broken table becomes a gap.
pub(crate) fn read(directory: &Path, gaps: &mut Vec<Gap>) -> Option<Table> {
    let found = match read_wanted(directory) {
        Ok(found) => found,
        Err(gap) => {
            gaps.push(gap);
            None
        }
    };
    let (mut table, gap) = found?;
    gaps.extend(gap);
    for (name, column) in table.names.iter_mut().zip(&mut table.columns) {
        if let Some(plain) = name.strip_suffix(IN_DEGREES) {
            *name = plain.to_owned();
            column.iter_mut().for_each(|value| *value = value.to_radians());
        }
    }
    Some(table).filter(|table| table.rows() > 0)
}

fn read_wanted(directory: &Path) -> Result<Option<(Table, Option<Gap>)>, Gap> {
    let names = Rows::open(directory, OUTPUT_FILE)?.map(|rows| rows.names).unwrap_or_default();
    // Of a long table without them no row is read.
    if !names.iter().any(|name| is_wanted(name)) {
        return Ok(None);
    }
    read_columns(directory, OUTPUT_FILE, is_wanted, None)
}

fn is_wanted(name: &str) -> bool {
    let mut wanted = Quantity::OF_A_ROTOR.into_iter().chain(Quantity::OF_A_HELD_BODY);
    wanted.any(|quantity| name.starts_with(quantity.name()))
}
