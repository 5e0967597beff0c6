//! Tables in files as columns for numpy.

use nboom_study::{StudyError, SweepDirectory};
use nboom_tables::{Cell, Column, Kind};
use pyo3::prelude::*;

use crate::arrays::{list, room};
use crate::error::of_study;

/// Name, unit, meaning and cells of a column.
pub(crate) type CaseColumn = (String, Option<String>, String, Py<PyAny>);

/// The cells of a column: NaN where a number is missing.
enum Cells {
    Numbers(Vec<f64>),
    Integers(Vec<i64>),
    Texts(Vec<Option<String>>),
}

impl Cells {
    /// Without cells, but with memory for so many.
    fn of(column: &Column, cases: usize) -> PyResult<Self> {
        Ok(match column.kind {
            // Of cases and seeds, of which none is missing.
            Kind::Integer if matches!(&*column.name, "case" | "seed") => {
                Self::Integers(room(&[cases])?)
            }
            Kind::Integer | Kind::Number => Self::Numbers(room(&[cases])?),
            Kind::Text => Self::Texts(room(&[cases])?),
        })
    }

    fn push(&mut self, cell: &Cell<'_>) {
        match self {
            Self::Numbers(numbers) => numbers.push(match *cell {
                Cell::Number(number) => number,
                Cell::Integer(number) => number as f64,
                Cell::Empty | Cell::Text(_) => f64::NAN,
            }),
            Self::Integers(numbers) => {
                numbers.push(if let Cell::Integer(number) = cell { *number } else { 0 });
            }
            Self::Texts(texts) => texts.push(match cell {
                Cell::Text(text) => Some((*text).to_owned()),
                _ => None,
            }),
        }
    }

    fn into_python(self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        Ok(match self {
            Self::Numbers(numbers) => list(py, numbers).unbind(),
            Self::Integers(numbers) => list(py, numbers).unbind(),
            Self::Texts(texts) => texts.into_pyobject(py)?.unbind(),
        })
    }
}

/// The table of cases of a finished sweep.
pub(crate) fn read(py: Python<'_>, sweep: &SweepDirectory) -> PyResult<Vec<CaseColumn>> {
    let columns = &sweep.description.columns;
    let cases = usize::try_from(sweep.description.cases).unwrap_or(usize::MAX);
    let cells = columns.iter().map(|column| Cells::of(column, cases));
    let mut all = cells.collect::<PyResult<Vec<Cells>>>()?;
    let read: Result<(), StudyError> = py.detach(|| {
        sweep.each_case(|cells| {
            all.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
            Ok(())
        })
    });
    read.map_err(of_study)?;
    let column = |(column, cells): (&Column, Cells)| {
        let Column { name, unit, description, .. } = column;
        Ok((name.clone(), unit.clone(), description.clone(), cells.into_python(py)?))
    };
    columns.iter().zip(all).map(column).collect()
}
