use super::builder::Builder;
use super::shown;
use super::values::plain;
use crate::LegacySettings;

impl Builder<'_, '_, '_> {
    /// Settings of the original's integrator and printer.
    pub fn settings(&mut self) -> LegacySettings {
        self.warn_order("HMIN", "HMAX");
        self.warn_order("EL1", "EU1");
        LegacySettings {
            first_step: self.positive("HZO"),
            upper_error: self.positive("EU1"),
            lower_error: self.not_negative("EL1"),
            min_step: self.not_negative("HMIN"),
            max_step: self.positive("HMAX"),
            max_steps: self.positive("LSTEP").map(|steps| steps as usize),
            print_interval: self.positive("IAX").map(|steps| steps as usize),
            stress_interval: self.not_negative("INSTR").unwrap_or(0.0) as usize,
            plots: self.values.get("NOPLT", 0).map(|no_plots| no_plots != 1.0),
        }
    }

    /// Limits in the wrong order, which matter only to `rkam`.
    fn warn_order(&mut self, least: &'static str, most: &'static str) {
        let (low, high) = (self.values.real(least, 0), self.values.real(most, 0));
        if high > 0.0 && low > high {
            let expected =
                format!("at most {most}, which is {}, for --integrator rkam", shown(high));
            self.warn(plain(least), 0, shown(low), &expected);
        }
    }

    fn positive(&mut self, name: &'static str) -> Option<f64> {
        self.not_negative(name).filter(|value| *value > 0.0)
    }

    fn not_negative(&mut self, name: &'static str) -> Option<f64> {
        let value = self.values.get(name, 0)?;
        if value < 0.0 {
            self.error(plain(name), 0, shown(value), "none below zero");
            return None;
        }
        Some(value)
    }
}
