//! Repeats a run more accurately.

use std::io;

use nboom_model::Scene;
use nboom_results::{Kept, PeakDigits, WorstLoads, peak_digits};
use nboom_sim::{
    InstantMotion, Options, Recorder, Reference, Snapshot, StepMotion, Trust, Witness, trust,
};
use nboom_strength::StressAnalysis;

use crate::CliError;
use crate::interrupt::Interrupt;
use crate::terminal::say;

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
        // Printed even with --quiet, since the results are not what they seem.
        doubts(&trust, &peaks, options).iter().for_each(|doubt| say("warning", doubt));
        Ok(Certified { trust, peaks })
    }
}

/// Digits fewer than which are hardly any.
const FEW: u32 = 3;

/// How many times tighter the reference is that a certificate promises.
const TIGHTER: f64 = 1e3;

/// Why a certificate is less than it seems.
fn doubts(trust: &Trust, peaks: &[PeakDigits], options: &Options) -> Vec<String> {
    let mut doubts = Vec::new();
    if !trust.same_events {
        doubts.push(
            "certificate: the reference has other events, so nothing is confirmed after the first that differs"
                .to_owned(),
        );
    }
    let of_events =
        trust.events.iter().flat_map(|event| [Some(&event.time), event.impulse.as_ref()]);
    let of_peaks = peaks.iter().map(|peak| &peak.digits);
    let all = of_events.flatten().chain(&trust.end).chain(of_peaks);
    if let Some(worst) = all.min_by_key(|digits| digits.count()).filter(|of| of.count() < FEW) {
        let (count, quantity) = (worst.count(), worst.quantity);
        doubts.push(format!(
            "certificate: {count} digits of {quantity} found, {FEW} or more expected"
        ));
    }
    let factor = options.rtol / trust.rtol;
    if trust.reference == Reference::TighterTolerance && factor < 0.99 * TIGHTER {
        doubts.push(format!(
            "certificate: the reference is {factor:.0} times tighter, not a thousand times, and may share the \
             run's errors; --certify=double-double does not"
        ));
    }
    doubts
}

impl Recorder for Certifier {
    fn needs_detail(&self) -> bool {
        self.analysis.as_ref().is_some_and(Recorder::needs_detail)
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.analysis.as_mut().map_or(Ok(()), |analysis| analysis.sample(snapshot))
    }

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
