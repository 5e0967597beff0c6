//! Units and cross sections in words.

use nboom_model::{Finding, SectionShape, UnitSystem};
use nboom_sections::Section;

use super::catalog::UNIT_SETS;
use super::fields::{Fields, Reader};

impl Reader<'_, '_> {
    /// The units that the scene states.
    pub fn units(&mut self, root: &Fields<'_>) -> Option<UnitSystem> {
        if !root.has("units") {
            return None;
        }
        if root.inner("units").is_none() {
            return self.choice(root, "units", UNIT_SETS).and_then(UnitSystem::from_name);
        }
        let labels = self.table(root, "units")?;
        // One that is missing has been reported.
        let [length, time, force] = ["length", "time", "force"]
            .map(|key| self.text(&labels, key).map(|label| (key, label.to_owned())));
        for (key, label) in [&length, &time, &force].into_iter().flatten() {
            if label.trim().is_empty()
                || label.contains([',', '"'])
                || label.contains(char::is_control)
            {
                let expected = "a label without commas and quotes";
                self.error(&labels.place(key), key, "no label", expected);
            }
        }
        let ((_, length), (_, time), (_, force)) = (length?, time?, force?);
        Some(UnitSystem::Custom { length, time, force })
    }

    /// Reports what is wrong with the walls of a section, and where thin-wall theory may not hold.
    pub fn check_walls(&mut self, fields: &Fields<'_>, shape: &SectionShape) {
        let symbol = match shape {
            SectionShape::Tube { .. } => "tube",
            SectionShape::Polygon(_) => "polygon",
        };
        let at = fields.place(symbol);
        match Section::of_shape(shape) {
            Ok(section) => {
                for warning in section.warnings() {
                    let Finding { found, expected } = warning.finding();
                    self.report.warn_at(self.sources, &at, symbol, &found, &expected);
                }
            }
            Err(errors) => {
                for error in errors {
                    let Finding { found, expected } = error.finding();
                    self.error(&at, symbol, &found, &expected);
                }
            }
        }
    }
}
