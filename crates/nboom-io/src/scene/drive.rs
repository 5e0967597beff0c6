//! Prescribed motion of the main body in words.

use nboom_model::{Base, Drive};

use super::catalog::BASES;
use super::fields::{Fields, Reader};
use crate::deck::shown;
use crate::words;

impl Reader<'_, '_> {
    /// How the main body is held.
    pub fn base(&mut self, main_body: &Fields<'_>) -> Base {
        let fixed = self.choice(main_body, "base", BASES) == Some(BASES[1]);
        match self.table(main_body, "drive") {
            Some(table) if main_body.has("base") => {
                let (found, expected) = ("`drive` beside `base`", "one of them");
                self.error(&table.at, "drive", found, expected);
                Base::Free
            }
            Some(table) => self.drive(&table).map_or(Base::Free, Base::Driven),
            None if fixed => Base::Fixed,
            None => Base::Free,
        }
    }

    fn drive(&mut self, table: &Fields<'_>) -> Option<Drive> {
        let axis = self.direction(table, "axis");
        let (rate, speed) = (self.angles_over_time(table, "rate"), self.rows(table, "speed"));
        for (key, rows) in [("rate", &rate), ("speed", &speed)] {
            if let Some(back) = rows.windows(2).find(|pair| pair[0][0] >= pair[1][0]) {
                let found = format!("time {} after time {}", shown(back[1][0]), shown(back[0][0]));
                self.error(&table.place(key), key, &found, "ascending times");
                return None;
            }
        }
        Some(words::prescribed(axis?, &rate, &speed))
    }
}
