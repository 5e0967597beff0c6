//! What is required of each run.

use nboom_io::nearest;

use super::reader::{Fields, Reader, quoted};
use crate::requirement::Requirement;
use crate::wanted::{Wanted, plain};

impl<'t> Reader<'t> {
    /// Bounds of results that stand in the table.
    pub fn requirements(&mut self, root: &Fields<'t>, wanted: &[Wanted]) -> Vec<Requirement> {
        let mut all: Vec<Requirement> = Vec::new();
        for of in self.tables(root, "requirement") {
            let number = |reader: &mut Self, key| reader.number(&of, key).map(|found| found.value);
            let (at_least, at_most) = (number(self, "at_least"), number(self, "at_most"));
            if !of.has("at_least") && !of.has("at_most") {
                let expected = "at_least, or at_most, or both";
                self.error(&of.place(), "requirement", "no bound", expected);
            }
            if let (Some(least), Some(most)) = (at_least, at_most)
                && least > most
            {
                let found = format!("{most}, less than at_least");
                let expected = format!("a number from {least} on");
                self.error(&of.place_of("at_most"), "at_most", found, expected);
            }
            let Some(result) = self.text(&of, "result") else { continue };
            let text = plain(result.value);
            if !wanted.iter().any(|wanted| wanted.text() == text) {
                let meant = nearest(&text, wanted.iter().map(Wanted::text));
                let expected = "a result in the table of cases";
                self.error_like(&result.place, "result", quoted(&text), expected, meant);
            }
            if all.iter().any(|other| other.result == text) {
                let found = format!("{}, which has a requirement before", quoted(&text));
                self.error(&result.place, "result", found, "both bounds in one requirement");
            }
            all.push(Requirement { result: text, at_least, at_most });
        }
        all
    }
}
