//! Forces and torques from outside in words.

use nboom_model::{External, ExternalKind};
use nboom_scalar::Vec3;

use super::catalog::ALONG;
use super::fields::{Fields, Reader};
use crate::words::{self, ExternalWords, external_table};

impl Reader<'_, '_> {
    /// Those on a body, or on the main body: forces, then torques.
    pub fn externals(&mut self, body: &Fields<'_>) -> Vec<External> {
        let mut all = Vec::new();
        for kind in ExternalKind::ALL {
            let tables = self.tables(body, external_table(kind));
            all.extend(tables.iter().filter_map(|table| self.external(kind, table)));
        }
        all
    }

    fn external(&mut self, kind: ExternalKind, table: &Fields<'_>) -> Option<External> {
        let point = self.vector(table, "point");
        let words = match kind {
            ExternalKind::Force => words::thruster(self.vector(table, "force")?, point?),
            ExternalKind::Torque => {
                let words = words::torque(self.vector(table, "torque")?);
                words.point(point.unwrap_or_else(Vec3::zero))
            }
        };
        let amount = match kind {
            ExternalKind::Force => "force",
            ExternalKind::Torque => "torque",
        };
        self.warn_if_zero(table, amount);
        let is_inertial = self.choice(table, "axes", ALONG) == Some("inertial");
        let words = if is_inertial { words.along_inertial_axes() } else { words };
        self.course(words, table).map(Into::into)
    }

    fn course(&mut self, mut words: ExternalWords, table: &Fields<'_>) -> Option<ExternalWords> {
        if table.has("over_time") {
            if let Some(vain) = ["from", "until"].into_iter().find(|key| table.has(key)) {
                let found = format!("`{vain}` beside over_time");
                self.error(&table.place(vain), vain, &found, "one of them");
            }
            self.warn_if_zero_throughout(table, "over_time");
            return Some(words.over_time(self.rows(table, "over_time")));
        }
        if table.has("from") {
            words = words.from(self.number(table, "from")?);
        }
        if table.has("until") {
            words = words.until(self.number(table, "until")?);
        }
        Some(words)
    }
}
