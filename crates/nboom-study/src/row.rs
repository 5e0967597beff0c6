use nboom_tables::Cell;

/// The status of a case that was run.
pub(crate) const OK: &str = "ok";

/// The status of a case that was run to its end, with energy that grew beyond all that its scene has.
pub(crate) const RUNAWAY: &str = "ok, runs away";

/// The status of a case that was run, but did not keep a conservation law. It stands in the row because a journal has
/// nothing else of a case.
pub(crate) const POOR: &str = "ok, poor conservation";

/// The status of a case in which errors of the run may decide whether a hinge locks.
pub(crate) const DOUBTFUL: &str = "ok, latch in doubt";

/// The row of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What stands in the columns of [`columns`](crate::columns).
    pub cells: Vec<Value>,
    /// What stands in those of [`trajectory_columns`](crate::trajectory_columns) behind the number of the case,
    /// a row for each output time; only of a study that wants trajectories, of a run that was finished.
    pub states: Vec<Vec<f64>>,
    /// What became of the case.
    pub outcome: Outcome,
}

/// What became of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// It was run.
    Ok,
    /// Its scene is none.
    Rejected,
    /// Its run could not be finished.
    Failed,
}

/// What stands in a row and a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Nothing.
    Empty,
    /// A finite number.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// Words in one line.
    Text(String),
}

impl Value {
    /// A number, or nothing if it is not finite.
    pub(crate) fn number(value: f64) -> Self {
        if value.is_finite() { Self::Number(value) } else { Self::Empty }
    }

    /// The cell of a table.
    pub fn cell(&self) -> Cell<'_> {
        match self {
            Self::Number(value) if value.is_finite() => Cell::Number(*value),
            Self::Empty | Self::Number(_) => Cell::Empty,
            Self::Integer(value) => Cell::Integer(*value),
            Self::Text(text) => Cell::Text(text),
        }
    }
}
