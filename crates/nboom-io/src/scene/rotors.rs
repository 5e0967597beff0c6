//! Rotors in words.

use nboom_model::{Rotor, RotorSpeed};

use super::fields::{Fields, Reader};

impl Reader<'_, '_> {
    /// The rotors of a body, or of the main body.
    pub fn rotors(&mut self, body: &Fields<'_>) -> Vec<Rotor> {
        let tables = self.tables(body, "rotor");
        tables.iter().filter_map(|table| self.rotor(table)).collect()
    }

    fn rotor(&mut self, table: &Fields<'_>) -> Option<Rotor> {
        let (axis, inertia) = (self.direction(table, "axis"), self.number(table, "inertia"));
        let speed = if table.has("speed_over_time") {
            Some(RotorSpeed::Table(self.angles_over_time(table, "speed_over_time")))
        } else {
            self.angle(table, "speed").map(RotorSpeed::Constant)
        };
        Some(Rotor { body: None, axis: axis?, inertia: inertia?, speed: speed? })
    }
}
