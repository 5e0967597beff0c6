use nboom_model::HingeLabel;
use nboom_sim::{HingeImpulse, HingeVerdict, Verdict};
use nboom_strength::{Cause, HingeQuantity, Limit, StressAnalysis, Worst, WorstHingeLoad};
use serde::Serialize;

use crate::label_keys::LabelKeys;

/// The worst stresses and hinge loads of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WorstLoads {
    /// The largest von Mises stress of each station; nothing without stations.
    pub stations: Vec<Worst>,
    /// The largest force and the largest moment of each hinge.
    pub hinges: Vec<WorstHingeLoad>,
    /// How long the pulse of each hinge's latch or stop lasts; nothing where loads have none.
    pub pulses: Vec<f64>,
}

impl WorstLoads {
    /// The results of an analysis so far.
    pub fn of(analysis: &StressAnalysis) -> Self {
        let (stations, hinges) = (analysis.envelope(), analysis.hinge_envelope());
        Self { stations, hinges, pulses: analysis.pulse_durations() }
    }

    /// The station with the largest von Mises stress.
    pub fn station(&self) -> Option<&Worst> {
        let von_mises = |worst: &Worst| worst.max_von_mises.stress.von_mises();
        self.stations.iter().max_by(|a, b| von_mises(a).total_cmp(&von_mises(b)))
    }

    /// The station with the smallest margin, if a strength is known, the margin, and what it is to.
    pub fn weakest(&self) -> Option<(&Worst, f64, Limit)> {
        self.weakest_of_each().min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// As [`weakest`](Self::weakest), to each limit that is known: one that yields may also break elsewhere.
    pub fn weakest_of_each(&self) -> impl Iterator<Item = (&Worst, f64, Limit)> {
        Limit::ALL.into_iter().filter_map(|limit| {
            let known = self.stations.iter();
            let known = known.filter_map(|worst| Some((worst, worst.margins.to(limit)?, limit)));
            known.min_by(|a, b| a.1.total_cmp(&b.1))
        })
    }

    /// How many stations bear a load of which no margin is known, where others have one.
    pub fn without_margin(&self) -> usize {
        let has_none =
            |worst: &&Worst| worst.driver.is_some() && worst.margins.smallest().is_none();
        self.weakest().map_or(0, |_| self.stations.iter().filter(has_none).count())
    }

    /// The hinge with the largest force or moment.
    pub fn hinge(&self, quantity: HingeQuantity) -> Option<&WorstHingeLoad> {
        let of_quantity = self.hinges.iter().filter(|worst| worst.quantity == quantity);
        of_quantity.max_by(|a, b| a.magnitude().total_cmp(&b.magnitude()))
    }
}

/// The key `verdict` of `summary.json`. Where a number is the largest or smallest of many, the key
/// with `_at` says where it is.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct VerdictKeys {
    hinges: Vec<HingeKeys>,
    /// Its magnitude.
    largest_impulse: Option<f64>,
    largest_impulse_at: Option<LockUpKeys>,
    /// The largest von Mises stress.
    worst_load: Option<f64>,
    worst_load_at: Option<StationKeys>,
    smallest_margin: Option<f64>,
    smallest_margin_at: Option<MarginKeys>,
    smallest_yield_margin: Option<f64>,
    smallest_yield_margin_at: Option<StationKeys>,
    smallest_ultimate_margin: Option<f64>,
    smallest_ultimate_margin_at: Option<StationKeys>,
    largest_hinge_force: Option<f64>,
    largest_hinge_force_at: Option<HingeLoadKeys>,
    largest_hinge_moment: Option<f64>,
    largest_hinge_moment_at: Option<HingeLoadKeys>,
}

#[derive(Clone, Debug, Serialize)]
struct HingeKeys {
    #[serde(flatten)]
    label: LabelKeys,
    /// As in `states.csv`.
    state: i8,
    time: Option<f64>,
    angle: f64,
    /// How near it came to its lock angle without locking, and when.
    miss: Option<f64>,
    miss_time: Option<f64>,
    /// Its rate just before it locked.
    closing_rate: Option<f64>,
}

#[derive(Clone, Debug, Serialize)]
struct LockUpKeys {
    #[serde(flatten)]
    label: LabelKeys,
    time: f64,
    impulse: f64,
}

#[derive(Clone, Debug, Serialize)]
struct StationKeys {
    #[serde(flatten)]
    label: LabelKeys,
    station: usize,
    time: f64,
    event: Option<&'static str>,
}

#[derive(Clone, Debug, Serialize)]
struct MarginKeys {
    #[serde(flatten)]
    station: StationKeys,
    /// What the margin is to.
    limit: &'static str,
}

impl From<(&Worst, f64, Limit)> for MarginKeys {
    fn from((worst, _, limit): (&Worst, f64, Limit)) -> Self {
        Self { station: worst.into(), limit: limit.name() }
    }
}

impl VerdictKeys {
    pub fn new(labels: &[HingeLabel], verdict: &Verdict, worst: &WorstLoads) -> Self {
        let hinges = labels.iter().zip(&verdict.hinges);
        let largest = verdict.largest_impulse;
        let (most_loaded, weakest) = (worst.station(), worst.weakest());
        let [on_yield, on_ultimate] = [Limit::Yield, Limit::Ultimate]
            .map(|limit| worst.weakest_of_each().find(|&(.., of)| of == limit));
        let [force, moment] =
            [HingeQuantity::Force, HingeQuantity::Moment].map(|quantity| worst.hinge(quantity));
        Self {
            hinges: hinges.map(|(label, hinge)| HingeKeys::new(label, hinge)).collect(),
            largest_impulse: largest.map(|largest| largest.impulse.abs()),
            largest_impulse_at: largest.map(|largest| LockUpKeys::new(labels, &largest)),
            worst_load: most_loaded.map(|worst| worst.max_von_mises.stress.von_mises()),
            worst_load_at: most_loaded.map(StationKeys::from),
            smallest_margin: weakest.map(|(_, margin, _)| margin),
            smallest_margin_at: weakest.map(MarginKeys::from),
            smallest_yield_margin: on_yield.map(|(_, margin, _)| margin),
            smallest_yield_margin_at: on_yield.map(|(at, ..)| at.into()),
            smallest_ultimate_margin: on_ultimate.map(|(_, margin, _)| margin),
            smallest_ultimate_margin_at: on_ultimate.map(|(at, ..)| at.into()),
            largest_hinge_force: force.map(WorstHingeLoad::magnitude),
            largest_hinge_force_at: force.map(HingeLoadKeys::from),
            largest_hinge_moment: moment.map(WorstHingeLoad::magnitude),
            largest_hinge_moment_at: moment.map(HingeLoadKeys::from),
        }
    }
}

impl HingeKeys {
    fn new(label: &HingeLabel, hinge: &HingeVerdict) -> Self {
        Self {
            label: label.into(),
            state: hinge.state.code(),
            time: hinge.since,
            angle: hinge.angle,
            miss: hinge.miss.map(|miss| miss.by),
            miss_time: hinge.miss.map(|miss| miss.time),
            closing_rate: hinge.closing_rate,
        }
    }
}

impl LockUpKeys {
    fn new(labels: &[HingeLabel], largest: &HingeImpulse) -> Self {
        let HingeImpulse { hinge, time, impulse } = *largest;
        Self { label: (&labels[hinge]).into(), time, impulse }
    }
}

#[derive(Clone, Debug, Serialize)]
struct HingeLoadKeys {
    #[serde(flatten)]
    label: LabelKeys,
    time: f64,
    event: Option<&'static str>,
}

impl From<&WorstHingeLoad> for HingeLoadKeys {
    fn from(worst: &WorstHingeLoad) -> Self {
        let (time, event) = (worst.time, event_of(worst.cause));
        Self { label: (&worst.hinge).into(), time, event }
    }
}

fn event_of(cause: Cause) -> Option<&'static str> {
    match cause {
        Cause::Motion => None,
        Cause::Pulse { kind, .. } => Some(kind.name()),
    }
}

impl From<&Worst> for StationKeys {
    fn from(worst: &Worst) -> Self {
        Self {
            label: (&worst.segment).into(),
            station: worst.station + 1,
            time: worst.time,
            event: event_of(worst.cause),
        }
    }
}
