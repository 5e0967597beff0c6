use nboom_model::HingeLabel;
use nboom_sim::{Digits, Scales, natural};
use nboom_strength::HingeQuantity;

use crate::WorstLoads;

/// How well the largest load of a station or hinge is known.
#[derive(Clone, Debug, PartialEq)]
pub struct PeakDigits {
    /// The hinge, or that of the station's segment.
    pub hinge: HingeLabel,
    /// The station, from 0, outboard ones first; `None` for a hinge.
    pub station: Option<usize>,
    /// `von_mises`, `force` or `moment`.
    pub digits: Digits,
}

/// Differences of the largest stresses and hinge loads of a run from those of its reference. Each
/// is relative to itself, or to the largest of its kind if it is negligible beside that, or to the
/// natural size of loads if the motion loads nothing.
pub fn peak_digits(run: &WorstLoads, truth: &WorstLoads, scales: &Scales) -> Vec<PeakDigits> {
    let largest = |quantity| truth.hinge(quantity).map_or(0.0, |worst| worst.magnitude());
    let [force, moment] = [HingeQuantity::Force, HingeQuantity::Moment].map(largest);
    let (of_forces, of_moments) = (natural(force, scales.force), natural(moment, scales.moment));
    // Stresses follow from loads, and vanish where these do.
    let loaded = (force / of_forces).max(moment / of_moments);
    let von_mises = truth.station().map_or(0.0, |worst| worst.max_von_mises.stress.von_mises());
    let stations = run.stations.iter().zip(&truth.stations).map(|(run, truth)| {
        let [ours, true_one] = [run, truth].map(|worst| worst.max_von_mises.stress.von_mises());
        let size = natural(true_one, von_mises) / loaded;
        let digits = Digits::new("von_mises", (ours - true_one).abs(), size);
        PeakDigits { hinge: truth.segment.clone(), station: Some(truth.station), digits }
    });
    let hinges = run.hinges.iter().zip(&truth.hinges).map(|(run, truth)| {
        let of_kind = match truth.quantity {
            HingeQuantity::Force => of_forces,
            HingeQuantity::Moment => of_moments,
        };
        let size = natural(truth.magnitude(), of_kind);
        let off = (run.magnitude() - truth.magnitude()).abs();
        let digits = Digits::new(truth.quantity.name(), off, size);
        PeakDigits { hinge: truth.hinge.clone(), station: None, digits }
    });
    stations.chain(hinges).collect()
}
