use nboom_model::Scene;
use nboom_sim::{Digits, Trust};
use serde::Serialize;

use crate::PeakDigits;
use crate::label_keys::LabelKeys;

#[derive(Serialize)]
struct TrustKeys<'a> {
    scene: &'a str,
    reference: &'static str,
    reference_rtol: f64,
    reference_atol: f64,
    same_events: bool,
    events: Vec<EventKeys<'a>>,
    end: Vec<DigitKeys>,
    /// The largest stresses and hinge loads, if any were computed.
    peaks: Vec<PeakKeys>,
}

#[derive(Serialize)]
struct PeakKeys {
    #[serde(flatten)]
    hinge: LabelKeys,
    /// `null` for a hinge.
    station: Option<usize>,
    #[serde(flatten)]
    digits: DigitKeys,
}

impl From<&PeakDigits> for PeakKeys {
    fn from(peak: &PeakDigits) -> Self {
        let PeakDigits { hinge, station, digits } = peak;
        Self {
            hinge: hinge.into(),
            station: station.map(|station| station + 1),
            digits: digits.into(),
        }
    }
}

#[derive(Serialize)]
struct EventKeys<'a> {
    t: f64,
    kind: &'static str,
    appendage: Option<usize>,
    segment: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<&'a str>,
    time: DigitKeys,
    impulse: Option<DigitKeys>,
}

#[derive(Serialize)]
struct DigitKeys {
    quantity: &'static str,
    /// `null` where it is not a finite number.
    difference: f64,
    digits: u32,
}

impl From<&Digits> for DigitKeys {
    fn from(digits: &Digits) -> Self {
        let Digits { quantity, difference } = *digits;
        Self { quantity, difference, digits: digits.count() }
    }
}

/// The text of [`TRUST_FILE`](crate::TRUST_FILE).
pub(crate) fn text(scene: &Scene, trust: &Trust, peaks: &[PeakDigits]) -> String {
    let events = trust.events.iter().map(|known| {
        let label = known.event.hinge.map(|hinge| &scene.labels()[hinge]);
        EventKeys {
            t: known.event.time,
            kind: known.event.kind.name(),
            appendage: label.map(|label| label.numbers()[0]),
            segment: label.map(|label| label.numbers()[1]),
            name: label.and_then(|label| label.name.as_deref()),
            time: (&known.time).into(),
            impulse: known.impulse.as_ref().map(DigitKeys::from),
        }
    });
    let keys = TrustKeys {
        scene: &scene.name,
        reference: trust.reference.name(),
        reference_rtol: trust.rtol,
        reference_atol: trust.atol,
        same_events: trust.same_events,
        events: events.collect(),
        end: trust.end.iter().map(DigitKeys::from).collect(),
        peaks: peaks.iter().map(PeakKeys::from).collect(),
    };
    serde_json::to_string_pretty(&keys).expect("the keys are texts and numbers") + "\n"
}
