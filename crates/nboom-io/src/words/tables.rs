use std::collections::BTreeSet;

use nboom_model::{Errors, ModelError, Resolved, SceneDraft};

use super::error::{of_body, of_rotor};
use super::{WordsError, WordsErrors, external_table};
use crate::responsible::{Table, responsible};

/// The tables of a scene in words, as messages call them.
pub(super) struct Tables<'a> {
    pub draft: &'a SceneDraft,
    pub resolved: &'a Resolved,
    pub has_thrust: bool,
}

impl Tables<'_> {
    /// The errors of the scene at their tables; what is wrong of a repeated body is told once.
    pub fn errors(&self, errors: Errors<ModelError>) -> WordsErrors {
        let at_table = |error| {
            let (table, key) = responsible(&self.resolved.description, self.has_thrust, &error);
            WordsError::Model { of: self.name(table), key, error }
        };
        let mut errors: Vec<WordsError> = errors.into_iter().map(at_table).collect();
        let mut told = BTreeSet::new();
        errors.retain(|error| told.insert(error.to_string()));
        Errors(errors)
    }

    fn name(&self, table: Table) -> String {
        let bodies = &self.draft.bodies;
        let body = |i: usize| &bodies[self.resolved.of_draft[i]];
        let of_body = |i| of_body(&body(i).name);
        let owner = |of: Option<usize>| of.map_or_else(|| "main_body".to_owned(), of_body);
        let joint = |i| format!("{}, {}", of_body(i), body(i).joint.name());
        match table {
            Table::Run => "scene".to_owned(),
            Table::Initial => "initial".to_owned(),
            Table::Gravity => "gravity".to_owned(),
            Table::MainBody => "main_body".to_owned(),
            Table::Body(i) => of_body(i),
            Table::Joint(i) => joint(i),
            Table::Release(i) => format!("{}, release", joint(i)),
            Table::KickOff(i) => format!("{}, kick_off", of_body(i)),
            Table::Rotor(body, number) => of_rotor(&owner(body), number),
            Table::Thrust => "thrust".to_owned(),
            Table::External(body, kind, number) => {
                format!("{}, {} {}", owner(body), external_table(kind), number + 1)
            }
        }
    }
}
