//! What the first case of a sweep tells of the code that computes its cases.

use std::sync::{Mutex, PoisonError};

use nboom_sim::{Form, Selection};

/// Which code computed the accelerations of a case, of a study that asks for a formulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Selected {
    /// The case.
    pub case: u64,
    /// What the study asks for.
    pub formulation: Form,
    /// What took over, mode by mode.
    pub selections: Vec<Selection>,
}

/// That of the first case, whichever thread runs it and whenever.
#[derive(Debug, Default)]
pub(crate) struct FirstSelected(Mutex<Option<Selected>>);

impl FirstSelected {
    /// Notes that of a case.
    pub fn note(&self, case: u64, formulation: Form, selections: &[Selection]) {
        let mut first = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if first.as_ref().is_none_or(|first| case < first.case) {
            *first = Some(Selected { case, formulation, selections: selections.to_vec() });
        }
    }

    /// That of the first case of all; none if no case has come to its end.
    pub fn taken(self) -> Option<Selected> {
        self.0.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}
