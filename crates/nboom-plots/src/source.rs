//! A run, by hinges and units.

use std::borrow::Cow;

use nboom_report::{Run, Table};

use crate::axis::Scale;
use crate::figure::{Curve, Panel};

/// Share of a run's largest rate below which a rate is rounding.
pub(crate) const ROUNDING: f64 = 1e-9;

/// A hinge as its columns and its curves are called.
#[derive(Debug, Clone)]
pub(crate) struct Hinge {
    pub appendage: usize,
    pub segment: usize,
    /// The end of its columns' names.
    pub key: String,
    pub label: String,
    pub slides: bool,
}

/// A run with its hinges.
pub(crate) struct Source<'a> {
    pub run: &'a Run,
    pub hinges: Vec<Hinge>,
    pub units: Units,
}

/// Labels of units, angles in degrees.
pub(crate) struct Units {
    pub time: String,
    pub length: String,
    pub force: String,
    pub torque: String,
    pub energy: String,
    pub stress: String,
    /// Of an angle's rate.
    pub rate: String,
    pub speed: String,
}

impl<'a> Source<'a> {
    pub fn new(run: &'a Run) -> Self {
        let units = run.units();
        let [time, length, force] =
            [units.time(), units.length(), units.force()].map(str::to_owned);
        let is_si = (length.as_str(), force.as_str()) == ("m", "N");
        let units = Units {
            stress: if is_si { "Pa".to_owned() } else { format!("{force}/{length}²") },
            rate: format!("°/{time}"),
            speed: format!("{length}/{time}"),
            torque: units.torque(),
            energy: units.energy(),
            time,
            length,
            force,
        };
        Self { run, hinges: hinges(run), units }
    }

    /// How the hinge with these numbers, from 1, is called.
    pub fn label(&self, appendage: usize, segment: usize) -> String {
        let is_it = |hinge: &&Hinge| (hinge.appendage, hinge.segment) == (appendage, segment);
        let found = self.hinges.iter().find(is_it);
        found.map_or_else(|| format!("{appendage},{segment}"), |hinge| hinge.label.clone())
    }

    /// Panels of the columns of those hinges that slide, or of those that turn; the numbers of the latter in
    /// degrees, but of loads.
    pub fn of_hinges(&self, table: &'a Table, wanted: &Wanted<'_>) -> Vec<Panel<'a>> {
        let is_wanted = |hinge: &&Hinge| wanted.slides.is_none_or(|slides| slides == hinge.slides);
        let curve = |hinge: &Hinge| {
            let column = table.column(&format!("{}_{}", wanted.quantity, hinge.key))?;
            let values = if wanted.in_degrees { degrees(column) } else { Cow::Borrowed(column) };
            let curve = Curve::new(&hinge.label, table.times(), values);
            Some(Curve { group: hinge.appendage, ..curve })
        };
        let curves = self.hinges.iter().filter(is_wanted).filter_map(curve).collect();
        Panel::of_groups(wanted.label, wanted.unit, wanted.scale, curves)
    }
}

/// Columns of hinges.
pub(crate) struct Wanted<'w> {
    /// The beginning of their names.
    pub quantity: &'w str,
    pub label: &'w str,
    pub unit: &'w str,
    pub scale: Scale,
    pub in_degrees: bool,
    /// Of which hinges, if not of all.
    pub slides: Option<bool>,
}

/// Angles in degrees.
pub(crate) fn degrees(radians: &[f64]) -> Cow<'_, [f64]> {
    radians.iter().map(|angle| angle.to_degrees()).collect()
}

/// Hinges by the scene; without it by the columns of the motion.
fn hinges(run: &Run) -> Vec<Hinge> {
    let hinge = |[appendage, segment]: [usize; 2], name: Option<&str>, slides| Hinge {
        key: format!("{appendage}_{segment}"),
        label: name.map_or_else(|| format!("{appendage},{segment}"), str::to_owned),
        appendage,
        segment,
        slides,
    };
    if let Some(scene) = run.scene() {
        let bodies = scene.bodies.iter().enumerate();
        let of_body = |(i, body): (usize, &nboom_model::Body)| {
            hinge(scene.label(i).numbers(), scene.name_of(i), body.joint.slides())
        };
        return bodies.map(of_body).collect();
    }
    let columns = run.motion().map_or(&[][..], Table::names);
    let numbers = |name: &String| {
        let (appendage, segment) = name.strip_prefix("beta_")?.split_once('_')?;
        Some([appendage.parse().ok()?, segment.parse().ok()?])
    };
    columns.iter().filter_map(numbers).map(|numbers| hinge(numbers, None, false)).collect()
}
