//! Quantities whose largest values are searched.

use std::sync::Arc;

use nboom_loads::LoadSet;
use nboom_scalar::{Mat3, Vec3, Wrench};
use nboom_sections::PointStress;

use crate::StationLoad;
use crate::formulas::Formulas;
use crate::station::Station;

/// What a gauge measures.
#[derive(Clone, Debug)]
pub(crate) enum Measure {
    /// The largest von Mises stress in a section.
    Stress(Arc<Formulas>),
    /// The magnitude of a hinge's force.
    Force,
    /// The magnitude of a hinge's moment.
    Moment,
}

/// How a hinge turns its body: by the angle at a place of the row about this axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Turn {
    axis: Vec3<f64>,
    angle: usize,
}

impl Turn {
    /// Turns components along the body's axes into those along axes that turn with the inboard body alone.
    fn rotation(&self, row: &[f64]) -> Mat3<f64> {
        Mat3::about_axis(self.axis, row[self.angle])
    }
}

/// One quantity: a norm of six of the numbers in a row of loads, see [`LoadSet::numbers`].
///
/// The von Mises stress at one point is the length of a vector that is linear in the load, and the
/// largest of such lengths is again a norm: it is convex, and at most the sum of the values for
/// each number alone.
#[derive(Clone, Debug)]
pub(crate) struct Gauge {
    pub measure: Measure,
    /// Where its load starts in the row.
    load: usize,
    /// Where its numbers start in the row; those of the load unless a section has its own.
    numbers: usize,
    /// Its value for one unit of each number alone.
    gains: [f64; 6],
    /// That of a hinge which turns.
    turn: Option<Turn>,
}

impl Gauge {
    /// The stress of a station, as counted over all segments.
    pub fn of_station(station: usize, loads: &LoadSet, at: &Station) -> Self {
        let load = loads.station_at(station);
        let of_loads = at.formulas.are_of_1970();
        let numbers = if of_loads { load } else { loads.stress_at(station) };
        Self::new(Measure::Stress(Arc::clone(&at.formulas)), load, numbers)
    }

    /// Force and moment of a hinge; about `axis` unless it slides. In a row its angle is among those that
    /// follow the loads.
    pub fn of_hinge(hinge: usize, loads: &LoadSet, axis: Option<Vec3<f64>>) -> [Self; 2] {
        let load = loads.hinge_at(hinge);
        let turn = axis.map(|axis| Turn { axis, angle: loads.count() + hinge });
        [Measure::Force, Measure::Moment]
            .map(|measure| Self { turn, ..Self::new(measure, load, load) })
    }

    fn new(measure: Measure, load: usize, numbers: usize) -> Self {
        let mut gauge = Self { measure, load, numbers, gains: [0.0; 6], turn: None };
        gauge.gains = std::array::from_fn(|j| {
            gauge.value(&std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 }))
        });
        gauge
    }

    /// Its numbers in a row of loads.
    pub fn numbers(&self, row: &[f64]) -> [f64; 6] {
        six(row, self.numbers)
    }

    /// The axes along which its numbers may be taken: as rows have them, and those of a hinge turned back.
    pub fn turns(&self) -> impl Iterator<Item = Option<Turn>> + use<> {
        [None].into_iter().chain(self.turn.map(Some))
    }

    /// Its numbers in a row of loads, turned back by `turn`.
    pub fn numbers_along(&self, turn: Option<Turn>, row: &[f64]) -> [f64; 6] {
        match turn {
            Some(turn) => six_of(self.load(row).rotated(&turn.rotation(row))),
            None => self.numbers(row),
        }
    }

    /// Puts numbers that were turned back by `turn` into a row that has the angle.
    pub fn put_along(&self, turn: Option<Turn>, numbers: [f64; 6], row: &mut [f64]) {
        if let Some(turn) = turn {
            let load = wrench(numbers).rotated(&turn.rotation(row).transpose());
            row[self.load..self.load + 6].copy_from_slice(&six_of(load));
        }
    }

    /// Its load in a row of loads.
    pub fn load(&self, row: &[f64]) -> Wrench<f64> {
        wrench(six(row, self.load))
    }

    /// Load and numbers of its station in a row of loads.
    pub fn station_load(&self, row: &[f64]) -> StationLoad {
        StationLoad { load: self.load(row), numbers: self.numbers(row) }
    }

    /// The quantity for these numbers.
    pub fn value(&self, numbers: &[f64; 6]) -> f64 {
        let Wrench { force, moment } = wrench(*numbers);
        match &self.measure {
            Measure::Stress(formulas) => formulas.max_von_mises_of(*numbers).stress.von_mises(),
            Measure::Force => force.norm(),
            Measure::Moment => moment.norm(),
        }
    }

    /// A cheap upper bound of the quantity for these numbers.
    pub fn bound(&self, numbers: &[f64; 6]) -> f64 {
        self.gains.iter().zip(numbers).map(|(gain, number)| gain * number.abs()).sum()
    }

    /// Whether bounds show that the quantity for these numbers is at most `level`.
    pub fn is_at_most(&self, level: f64, numbers: &[f64; 6]) -> bool {
        self.bound(numbers) <= level
            || match &self.measure {
                Measure::Stress(formulas) => formulas.is_at_most(level, *numbers),
                Measure::Force | Measure::Moment => self.value(numbers) <= level,
            }
    }

    /// The quantity for these numbers if it is above `level`.
    pub fn above(&self, level: f64, numbers: &[f64; 6]) -> Option<f64> {
        if self.is_at_most(level, numbers) {
            return None;
        }
        Some(self.value(numbers)).filter(|value| *value > level)
    }

    /// The contribution of each of `parts` of a load to the quantity under the whole load, as a
    /// share of it: its component along the vector whose length is the quantity.
    pub fn shares<'a>(
        &'a self,
        row: &'a [f64],
        parts: impl Iterator<Item = &'a [f64]> + 'a,
    ) -> impl Iterator<Item = f64> + 'a {
        let point = self.max_von_mises(row);
        let vector = move |row: &[f64]| self.vector(row, point.as_ref());
        let whole = vector(row);
        let size = whole.norm_squared();
        parts.map(move |part| if size > 0.0 { vector(part).dot(whole) / size } else { 0.0 })
    }

    /// Where a station is stressed most under a row of loads.
    fn max_von_mises(&self, row: &[f64]) -> Option<PointStress> {
        match &self.measure {
            Measure::Stress(formulas) => Some(formulas.max_von_mises_of(self.numbers(row))),
            Measure::Force | Measure::Moment => None,
        }
    }

    /// The vector whose length the quantity is, at a point of the section.
    fn vector(&self, row: &[f64], point: Option<&PointStress>) -> Vec3<f64> {
        let load = self.load(row);
        match (&self.measure, point) {
            (Measure::Stress(formulas), Some(point)) => {
                let stress = formulas.at(point, &load);
                let factor = 3.0_f64.sqrt();
                Vec3::new(stress.normal, factor * stress.shear_xi, factor * stress.shear_zeta)
            }
            (Measure::Moment, _) => load.moment,
            _ => load.force,
        }
    }
}

fn six(row: &[f64], start: usize) -> [f64; 6] {
    std::array::from_fn(|i| row[start + i])
}

fn six_of(load: Wrench<f64>) -> [f64; 6] {
    let ([px, py, pz], [qx, qy, qz]) = (load.force.to_array(), load.moment.to_array());
    [px, py, pz, qx, qy, qz]
}

fn wrench([px, py, pz, qx, qy, qz]: [f64; 6]) -> Wrench<f64> {
    Wrench { force: Vec3::new(px, py, pz), moment: Vec3::new(qx, qy, qz) }
}
