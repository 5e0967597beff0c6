//! What became of a hinge, and what it and its segment carried.

use nboom_io::{SceneFile, nearest};
use nboom_model::{Hinge, HingeLabel, HingeState};
use nboom_strength::{HingeQuantity, Worst, WorstHingeLoad};
use nboom_tables::{Column, Kind as Holds};

use super::{Found, Loads, Named, Needs, What, refused};
use crate::statistics::Meaning;
use crate::table::units;

/// What happened to a hinge for the last time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Happened {
    /// When it was released.
    pub release: Option<f64>,
    /// When it locked.
    pub lock_up: Option<f64>,
    /// The impulse of that lock-up.
    pub impulse: Option<f64>,
}

/// A number of a hinge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    LockTime,
    ReleaseTime,
    Impulse,
    State,
    ClosingRate,
    Miss,
    PeakForce,
    PeakMoment,
    PeakStress,
    Margin,
}

struct Description {
    kind: Kind,
    name: &'static str,
    /// None of a whole number; that of a hinge that turns, and that of one that slides.
    unit: Option<[&'static str; 2]>,
    needs: Needs,
    about: &'static str,
}

const fn of(
    kind: Kind,
    name: &'static str,
    unit: Option<[&'static str; 2]>,
    needs: Needs,
    about: &'static str,
) -> Description {
    Description { kind, name, unit, needs, about }
}

const TIME: Option<[&str; 2]> = Some(["T"; 2]);

/// What the number of a state is.
pub(super) const STATE: &str =
    "at the end: -1 unreleased, 0 free, 1 locked, 2 stuck by friction or against a stop";

static ALL: [Description; 10] = [
    of(Kind::LockTime, "lock_time", TIME, Needs::Nothing, "when it locked for the last time"),
    of(Kind::ReleaseTime, "release_time", TIME, Needs::Nothing, "when it was released"),
    of(
        Kind::Impulse,
        "impulse",
        Some(["F L T", "F T"]),
        Needs::Nothing,
        "impulsive torque of its last lock-up on the outboard side, of a slide the impulsive force",
    ),
    of(Kind::State, "state", None, Needs::Nothing, STATE),
    of(
        Kind::ClosingRate,
        "closing_rate",
        Some(["rad/T", "L/T"]),
        Needs::Nothing,
        "its rate just before it locked for the last time",
    ),
    of(
        Kind::Miss,
        "miss",
        Some(["rad", "L"]),
        Needs::Nothing,
        "how near it came to its lock angle without locking; zero if it is locked",
    ),
    of(
        Kind::PeakForce,
        "peak_force",
        Some(["F"; 2]),
        Needs::HingeLoads,
        "largest force that it carries",
    ),
    of(
        Kind::PeakMoment,
        "peak_moment",
        Some(["F L"; 2]),
        Needs::HingeLoads,
        "largest moment that it carries",
    ),
    of(
        Kind::PeakStress,
        "peak_stress",
        Some(["F/L^2"; 2]),
        Needs::Stresses,
        "largest von Mises stress of the stations of its segment",
    ),
    of(
        Kind::Margin,
        "margin",
        Some(["1"; 2]),
        Needs::Strengths,
        "smallest margin of the stations of its segment",
    ),
];

/// What the result with this name of the hinge of a body is, if there is one.
pub(super) fn meaning((word, body): (&str, &str)) -> Option<Meaning> {
    let found = ALL.iter().find(|known| known.name == word)?;
    Some(match found.kind {
        Kind::LockTime => Meaning::LockTime { hinge: body.to_owned() },
        Kind::Margin => Meaning::Margin,
        _ => Meaning::Other,
    })
}

/// The result with this name of the hinge of a body.
pub(super) fn named(word: &str, body: &str, file: &SceneFile, loads: Loads) -> Named {
    let Some(found) = ALL.iter().find(|known| known.name == word) else {
        let meant = nearest(word, ALL.iter().map(|known| known.name));
        let names: Vec<&str> = ALL.iter().map(|known| known.name).collect();
        let expected = format!("one of {} of a hinge", names.join(", "));
        return Err((expected, meant.map(|name| format!("{name} of {body}"))));
    };
    let hinges = file.scene.labels();
    let Some(hinge) = HingeLabel::find(hinges, body) else {
        let meant = nearest(body, hinges.iter().filter_map(|label| label.name.as_deref()));
        let expected = "a hinge by the name of its body, or by its numbers as `1,2`".to_owned();
        return Err((expected, meant.map(|name| format!("{word} of {name}"))));
    };
    if let Some(missing) = found.needs.missing(file, loads) {
        return Err(refused(missing));
    }
    let Hinge { start, lock_angle, .. } = file.scene.bodies[hinge].hinge;
    let latching = [Kind::LockTime, Kind::Impulse, Kind::ClosingRate, Kind::Miss];
    if latching.contains(&found.kind) && start.state == HingeState::Locked {
        return Err(refused("a hinge that is not locked from the start"));
    }
    if latching.contains(&found.kind) && lock_angle.is_none() {
        return Err(refused("a hinge that has a lock angle"));
    }
    if found.kind == Kind::ReleaseTime && start.state != HingeState::Unreleased {
        return Err(refused("a hinge that is held at the start"));
    }
    let has_stations = || {
        let structure = file.structure.as_ref();
        structure.is_some_and(|structure| !structure.segments()[hinge].stations.is_empty())
    };
    if matches!(found.kind, Kind::PeakStress | Kind::Margin) && !has_stations() {
        return Err(refused("a hinge whose segment has stations"));
    }
    let label = &hinges[hinge];
    let column = Column::new("", found.unit.map_or(Holds::Integer, |_| Holds::Number), found.about);
    let unit = found.unit.map(|unit| units(file).label(unit[usize::from(label.joint.slides())]));
    let body = label.name.as_deref().map(str::to_owned);
    Ok((What::Hinge(found.kind, hinge), Column { unit, body, ..column }, found.needs))
}

impl Kind {
    /// What a run has found.
    pub(super) fn value(self, hinge: usize, found: &Found<'_>) -> Option<f64> {
        let Happened { release, lock_up, impulse } = found.hinges[hinge];
        let verdict = &found.summary.verdict.hinges[hinge];
        match self {
            Self::LockTime => lock_up,
            Self::ReleaseTime => release,
            Self::Impulse => impulse,
            Self::State => Some(verdict.state.code().into()),
            Self::ClosingRate => verdict.closing_rate,
            Self::Miss => match verdict.state {
                HingeState::Locked => Some(0.0),
                _ => verdict.miss.map(|miss| miss.by),
            },
            Self::PeakForce => found.peak(hinge, HingeQuantity::Force),
            Self::PeakMoment => found.peak(hinge, HingeQuantity::Moment),
            Self::PeakStress => {
                let stress = |worst: &Worst| worst.max_von_mises.stress.von_mises();
                found.stations(hinge).map(stress).max_by(f64::total_cmp)
            }
            Self::Margin => {
                let margin = |worst: &Worst| worst.margins.smallest().map(|(margin, _)| margin);
                found.stations(hinge).filter_map(margin).min_by(f64::total_cmp)
            }
        }
    }
}

impl Found<'_> {
    fn peak(&self, hinge: usize, quantity: HingeQuantity) -> Option<f64> {
        let is_it = |worst: &&WorstHingeLoad| {
            worst.quantity == quantity && worst.hinge == self.labels[hinge]
        };
        self.worst.hinges.iter().find(is_it).map(WorstHingeLoad::magnitude)
    }

    fn stations(&self, hinge: usize) -> impl Iterator<Item = &Worst> {
        let segment = &self.labels[hinge];
        self.worst.stations.iter().filter(move |worst| worst.segment == *segment)
    }
}
