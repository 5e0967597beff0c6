use std::fmt;

use nboom_tables::Cell;

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

/// What became of a case, with what is wrong with its run or why there is none. Its text stands in the row, because a
/// journal has nothing else of a case.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Status {
    /// It was run.
    Ok,
    /// It was run to its end, with energy that grew beyond all that its scene has.
    Runaway,
    /// It was run, but did not keep a conservation law.
    Poor,
    /// It was run, but errors of the run may decide whether a hinge locks.
    Doubtful,
    /// Its scene is none, for this reason.
    Rejected(String),
    /// Its run could not be finished, for this reason.
    Failed(String),
}

impl Status {
    /// Those without a reason.
    const BARE: [Self; 4] = [Self::Ok, Self::Runaway, Self::Poor, Self::Doubtful];

    /// Its text, but for the reason.
    pub(crate) const fn name(&self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Runaway => "ok, runs away",
            Self::Poor => "ok, poor conservation",
            Self::Doubtful => "ok, latch in doubt",
            Self::Rejected(_) => "rejected: ",
            Self::Failed(_) => "failed: ",
        }
    }

    /// The status of this text, if there is one.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let with = |status: fn(String) -> Self| {
            let why = text.strip_prefix(status(String::new()).name())?;
            Some(status(why.to_owned()))
        };
        let bare = Self::BARE.into_iter().find(|status| status.name() == text);
        bare.or_else(|| with(Self::Rejected)).or_else(|| with(Self::Failed))
    }

    pub(crate) const fn outcome(&self) -> Outcome {
        match self {
            Self::Ok | Self::Runaway | Self::Poor | Self::Doubtful => Outcome::Ok,
            Self::Rejected(_) => Outcome::Rejected,
            Self::Failed(_) => Outcome::Failed,
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())?;
        match self {
            Self::Rejected(why) | Self::Failed(why) => f.write_str(why),
            Self::Ok | Self::Runaway | Self::Poor | Self::Doubtful => Ok(()),
        }
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_status_is_read_back_from_its_text() {
        use Outcome::{Failed, Rejected};
        let why = || "mass: -1 found".to_owned();
        for (status, text, outcome) in [
            (Status::Ok, "ok", Outcome::Ok),
            (Status::Runaway, "ok, runs away", Outcome::Ok),
            (Status::Poor, "ok, poor conservation", Outcome::Ok),
            (Status::Doubtful, "ok, latch in doubt", Outcome::Ok),
            (Status::Rejected(why()), "rejected: mass: -1 found", Rejected),
            (Status::Failed(why()), "failed: mass: -1 found", Failed),
        ] {
            assert_eq!((&*status.to_string(), status.outcome()), (text, outcome));
            assert_eq!(Status::parse(text), Some(status));
        }
        for unknown in ["", "ok, ", "OK", "rejected", "skipped: it is too late"] {
            assert_eq!(Status::parse(unknown), None, "{unknown}");
        }
    }
}
