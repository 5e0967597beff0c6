//! Repeats a run more accurately.

use std::io;

use nboom_model::Scene;
use nboom_results::{Kept, PeakDigits, WorstLoads, peak_digits};
use nboom_sim::{InstantMotion, Options, Recorder, Reference, StepMotion, Trust, Witness, trust};
use nboom_strength::StressAnalysis;

use crate::CliError;
use crate::interrupt::Interrupt;

/// The result of a reference run.
#[derive(Clone, Debug)]
pub(crate) struct Certified {
    pub(crate) trust: Trust,
    /// Digits of the largest stresses and hinge loads, if any were computed.
    pub(crate) peaks: Vec<PeakDigits>,
}

/// Observes a reference run.
pub(crate) struct Certifier {
    pub(crate) interrupt: Interrupt,
    /// Computes the loads, if the run did.
    pub(crate) analysis: Option<StressAnalysis>,
}

impl Certifier {
    /// Runs again, and writes how far the results, `worst` included, are from that run.
    pub(crate) fn certify(
        mut self,
        scene: &Scene,
        options: &Options,
        reference: Reference,
        (witness, worst): (&Witness, &WorstLoads),
        kept: &Kept,
    ) -> Result<Certified, CliError> {
        let trust = trust(scene, options, witness, reference, &mut self).map_err(|failure| {
            CliError::Certificate { error: failure.error, directory: kept.directory.clone() }
        })?;
        let peaks = match &mut self.analysis {
            Some(analysis) => {
                analysis.finish()?;
                peak_digits(worst, &WorstLoads::of(analysis), &witness.scales(scene))
            }
            None => Vec::new(),
        };
        kept.add_trust(scene, &trust, &peaks)?;
        Ok(Certified { trust, peaks })
    }
}

impl Recorder for Certifier {
    fn interrupted(&self) -> bool {
        self.interrupt.came()
    }

    fn needs_instants(&self) -> bool {
        self.analysis.is_some()
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        self.analysis.as_mut().map_or(Ok(()), |analysis| Recorder::instant(analysis, instant))
    }

    fn needs_steps(&self) -> bool {
        self.analysis.is_some()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        self.analysis.as_mut().map_or(Ok(()), |analysis| Recorder::step(analysis, step))
    }
}
