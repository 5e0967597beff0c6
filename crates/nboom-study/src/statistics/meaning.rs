use serde::{Deserialize, Serialize};

/// What a result is, as far as statistics treat it by that.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Meaning {
    /// When a hinge locked for the last time. A case in which it does not lock has none, and counts as later than all
    /// others.
    LockTime {
        /// What the study calls the hinge.
        hinge: String,
    },
    /// A margin, which should not be negative.
    Margin,
    /// What is smallest in a run.
    Smallest,
    /// What is largest in a run.
    Largest,
    /// Any other number.
    #[default]
    Other,
}

impl Meaning {
    /// The hinge of whose lock-ups these are the times.
    pub fn hinge_that_locks(&self) -> Option<&str> {
        match self {
            Self::LockTime { hinge } => Some(hinge),
            _ => None,
        }
    }
}
