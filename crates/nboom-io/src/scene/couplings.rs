//! Springs and dampers between two hinges.

use nboom_model::{CouplingDraft, Joint};

use super::catalog::ACTS_ON;
use super::fields::{Fields, Reader};
use crate::words;

impl Reader<'_, '_> {
    /// The couplings of a body on such a joint.
    pub fn couplings(&mut self, body: &Fields<'_>, joint: Joint) -> Vec<CouplingDraft> {
        let tables = self.tables(body, "coupling");
        tables.iter().filter_map(|table| self.coupling(table, joint)).collect()
    }

    fn coupling(&mut self, table: &Fields<'_>, joint: Joint) -> Option<CouplingDraft> {
        let mut words = words::coupling(self.text(table, "to")?);
        words.ratio = self.number(table, "ratio").unwrap_or(words.ratio);
        words.stiffness = self.number(table, "stiffness").unwrap_or(words.stiffness);
        words.damping = self.number(table, "damping").unwrap_or(words.damping);
        words.is_mutual = self.choice(table, "acts_on", ACTS_ON) != Some("this");
        let (rest, rest_length) = (self.angle(table, "rest"), self.number(table, "rest_length"));
        let (own, vain, expected) = match joint {
            Joint::Revolute => (rest, "rest_length", "rest_deg or rest_rad"),
            Joint::Prismatic => (rest_length, "rest", "rest_length"),
        };
        if table.has(vain) {
            let found = format!("`{vain}` of a joint that {}", joint.does());
            self.error(&table.place(vain), vain, &found, expected);
        }
        words.rest = own.unwrap_or(words.rest);
        Some(words.into())
    }
}
