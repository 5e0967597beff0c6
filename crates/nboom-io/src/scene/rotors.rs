//! Rotors in words.

use nboom_model::Rotor;

use super::fields::{Fields, Reader};

impl Reader<'_, '_> {
    /// The rotors of a body, or of the main body.
    pub fn rotors(&mut self, body: &Fields<'_>) -> Vec<Rotor> {
        let tables = self.tables(body, "rotor");
        tables.iter().filter_map(|table| self.rotor(table)).collect()
    }

    fn rotor(&mut self, table: &Fields<'_>) -> Option<Rotor> {
        let (axis, inertia) = (self.direction(table, "axis"), self.number(table, "inertia"));
        let speed = self.angle(table, "speed");
        Some(Rotor { body: None, axis: axis?, inertia: inertia?, speed: speed? })
    }
}
