//! A run, by hinges and units.

use std::borrow::Cow;

use nboom_report::{Hinge, Run, Table};

use crate::axis::Scale;
use crate::figure::{Curve, Panel};

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
        let units = Units {
            time: units.time().to_owned(),
            length: units.length().to_owned(),
            force: units.force().to_owned(),
            torque: units.torque(),
            energy: units.energy(),
            stress: units.stress(),
            rate: format!("°/{}", units.time()),
            speed: units.speed(),
        };
        Self { run, hinges: run.hinges(), units }
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
        let is_wanted = |hinge: &&Hinge| {
            wanted.slides.is_none_or(|slides| slides == hinge.slides)
                && wanted.wheels.is_none_or(|wheels| wheels == hinge.wheel)
        };
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
    /// Whether of wheels or of others, if not of both.
    pub wheels: Option<bool>,
}

/// Angles in degrees.
pub(crate) fn degrees(radians: &[f64]) -> Cow<'_, [f64]> {
    radians.iter().map(|angle| angle.to_degrees()).collect()
}
