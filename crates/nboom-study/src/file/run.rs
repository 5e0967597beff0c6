//! The options of the runs of a study.

use std::fmt::Display;

use nboom_io::SceneFile;
use nboom_sim::{Form, Method as Integrator, OptionError, Path as Code};
use nboom_strength::{ActsOn, PulseShape, Settings};

use super::reader::{Fields, Reader};
use crate::study::RunSettings;

impl<'t> Reader<'t> {
    /// Options of the runs.
    pub(super) fn run_settings(&mut self, of: Option<&Fields<'t>>) -> RunSettings {
        let usual = RunSettings { stresses: true, lanes: true, ..RunSettings::default() };
        let Some(of) = of else { return usual };
        let number = |reader: &mut Self, key| reader.number(of, key).map(|found| found.value);
        let settings = RunSettings {
            rtol: number(self, "rtol"),
            atol: number(self, "atol"),
            integrator: self.choice(of, "integrator").and_then(|of| Integrator::named(of.value)),
            formulation: self.choice(of, "formulation").and_then(|of| Form::named(of.value)),
            path: self.choice(of, "path").and_then(|of| Code::named(of.value)),
            max_step: number(self, "max_step"),
            max_steps: self.whole(of, "max_steps").map(|found| found.value as usize),
            max_events: self.whole(of, "max_events").map(|found| found.value as usize),
            samples: self.whole(of, "samples").map(|found| found.value as usize),
            end_time: number(self, "end_time"),
            stresses: self.flag(of, "stresses").unwrap_or(true),
            hinge_loads: self.flag(of, "hinge_loads").unwrap_or(false),
            strength: self.strength(of),
            lanes: self.flag(of, "lanes").unwrap_or(true),
        };
        let RunSettings { rtol, atol, max_step, .. } = settings;
        for (key, alone) in [
            ("rtol", RunSettings { rtol, ..usual.clone() }),
            ("atol", RunSettings { atol, ..usual.clone() }),
            ("max_step", RunSettings { max_step, ..usual.clone() }),
        ] {
            if let Err(OptionError { value, expected, .. }) = alone.options().check() {
                self.error(&of.place_of(key), key, format!("{value:e}"), expected);
            }
        }
        if let Err(idle) = settings.options().check_choices() {
            let key = idle.option();
            self.error(&of.place_of(key), key, without_effect(&idle), "none");
        }
        settings
    }

    /// How stresses are judged.
    fn strength(&mut self, of: &Fields<'t>) -> Settings {
        let usual = Settings::default();
        let mut positive = |key| {
            let found = self.number(of, key)?;
            if found.value > 0.0 && found.value.is_finite() {
                return Some(found.value);
            }
            self.error(&found.place, key, found.value.to_string(), "a number above zero");
            None
        };
        let [yield_stress, safety_factor, ultimate_factor] =
            ["yield_stress", "safety_factor", "ultimate_factor"].map(&mut positive);
        let amplification = self.number(of, "amplification");
        if let Some(found) = amplification.as_ref().filter(|of| !(1.0..=2.0).contains(&of.value)) {
            let told = found.value.to_string();
            self.error(&found.place, "amplification", told, "a number from 1 to 2");
        }
        let pulses = self.choice(of, "pulses").and_then(|of| PulseShape::named(of.value));
        Settings {
            amplification: amplification.map_or(usual.amplification, |of| of.value),
            pulses: pulses.unwrap_or(usual.pulses),
            yield_stress,
            safety_factor: safety_factor.unwrap_or(usual.safety_factor),
            ultimate_factor: ultimate_factor.unwrap_or(usual.ultimate_factor),
            slips: usual.slips,
        }
    }

    /// Reports options that the scene cannot have, and those that have no effect on its runs.
    pub(super) fn check_run(
        &mut self,
        of: Option<&Fields<'t>>,
        run: &RunSettings,
        nominal: &SceneFile,
    ) {
        let Some(of) = of else { return };
        let wanted = run.wanted_loads(nominal, &nominal.scene);
        for (key, acts_on) in [
            ("yield_stress", ActsOn::Stresses),
            ("safety_factor", ActsOn::YieldMargins),
            ("ultimate_factor", ActsOn::UltimateMargins),
            ("amplification", ActsOn::Pulses),
            ("pulses", ActsOn::Pulses),
        ] {
            if let Some(why) = wanted.idle(acts_on).filter(|_| of.has(key)) {
                self.error(&of.place_of(key), key, without_effect(&why), "none");
            }
        }
        let Some(end_time) = run.end_time else { return };
        if nominal.scene.ending_at(end_time).is_err() {
            let (found, start) = (format!("end time {end_time}"), nominal.scene.initial.time);
            let expected = format!("a time not before the initial time {start}");
            self.error(&of.place_of("end_time"), "end_time", found, expected);
        }
    }
}

/// What is found where an option would do nothing.
fn without_effect(why: &dyn Display) -> String {
    format!("one that has no effect, since {why}")
}
