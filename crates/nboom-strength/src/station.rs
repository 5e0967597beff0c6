//! Stresses of stations at one time.

use std::sync::Arc;

use nboom_scalar::Wrench;
use nboom_sections::{AtStation, PointStress, Section};
use nboom_sim::EventKind;

use crate::Slips;
use crate::formulas::Formulas;

/// Load of one station at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationLoad {
    /// Force and moment on the part outboard of the station, about the point on the η axis,
    /// segment axes.
    pub load: Wrench<f64>,
    /// The numbers that describe its stresses, see
    /// [`SectionStresses::numbers`](nboom_sections::SectionStresses::numbers); with formulas of 1970
    /// those of the load.
    pub numbers: [f64; 6],
}

impl StationLoad {
    pub(crate) fn none() -> Self {
        Self { load: Wrench::zero(), numbers: [0.0; 6] }
    }
}

/// Load and stresses of one station at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationStress {
    /// The segment, as its hinge is numbered in the scene.
    pub segment: usize,
    /// The station, from 0, outboard ones first.
    pub station: usize,
    /// Force and moment on the part outboard of the station, about the point on the η axis,
    /// segment axes.
    pub load: Wrench<f64>,
    /// At 0, 90, 180 and 270 degrees; a section that is not convex may lack some.
    pub axis_points: [Option<PointStress>; 4],
    /// Where the von Mises stress is largest.
    pub max_von_mises: PointStress,
}

impl StationStress {
    /// Stresses at the axis points and where the von Mises stress is largest.
    pub fn points(&self) -> impl Iterator<Item = &PointStress> {
        self.axis_points.iter().flatten().chain([&self.max_von_mises])
    }
}

/// The largest loads on either side of a lock-up or an impact, by its pulses and those that still lasted, until
/// they ended or the next one came.
#[derive(Clone, Debug, PartialEq)]
pub struct PulsePeaks {
    /// When the hinge or hinges locked or hit their stops.
    pub time: f64,
    /// A lock-up where some locked, else an impact.
    pub kind: EventKind,
    /// When the von Mises stress of each station was largest.
    pub stations: Vec<StationLoad>,
    /// When the moment of each hinge was largest: force and moment that it exerts on its outboard body,
    /// about the hinge point, segment axes.
    pub hinge_loads: Vec<Wrench<f64>>,
}

/// All stations of a structure, segment by segment, outboard ones first. A copy finds stresses of loads
/// that it is given, in any thread.
#[derive(Clone, Debug)]
pub struct Stations(Vec<Station>);

#[derive(Clone, Debug)]
pub(crate) struct Station {
    /// The segment, as its hinge is numbered in the scene.
    pub segment: usize,
    /// From 0, outboard ones first.
    pub station: usize,
    pub formulas: Arc<Formulas>,
    /// The largest von Mises stress at a point of [`StationStress`] under each number alone, if it is 1.
    gains: [f64; 6],
}

impl Station {
    fn new(AtStation { segment, station, here }: AtStation<Section>, slips: Slips) -> Self {
        let formulas = Arc::new(Formulas::new(here, slips));
        let mut new = Self { segment, station, formulas, gains: [0.0; 6] };
        new.gains = std::array::from_fn(|j| {
            let numbers = std::array::from_fn(|i| if i == j { 1.0 } else { 0.0 });
            let stresses = new.stresses(&StationLoad { numbers, ..StationLoad::none() });
            stresses.points().map(|point| point.stress.von_mises()).fold(0.0, f64::max)
        });
        new
    }

    fn stresses(&self, of: &StationLoad) -> StationStress {
        let StationLoad { load, numbers } = *of;
        let stresses = self.formulas.stresses(numbers);
        StationStress {
            segment: self.segment,
            station: self.station,
            load,
            axis_points: stresses.axis_points(),
            max_von_mises: stresses.max_von_mises(),
        }
    }

    /// An upper bound of the von Mises stress at each point of [`StationStress`], since it is a norm.
    fn bound(&self, of: &StationLoad) -> f64 {
        self.gains.iter().zip(&of.numbers).map(|(gain, number)| gain * number.abs()).sum()
    }
}

impl Stations {
    /// Those with these sections, by the right formulas but for `slips`.
    pub fn new(sections: Vec<AtStation<Section>>, slips: Slips) -> Self {
        Self(sections.into_iter().map(|at| Station::new(at, slips)).collect())
    }

    pub(crate) fn iter(&self) -> impl ExactSizeIterator<Item = &Station> {
        self.0.iter()
    }

    /// The stresses of all stations under their loads.
    pub fn stresses(&self, loads: &[StationLoad]) -> impl Iterator<Item = StationStress> {
        self.0.iter().zip(loads).map(|(station, load)| station.stresses(load))
    }

    /// An upper bound of all von Mises stresses under these loads; cheaper than the stresses.
    pub fn bound(&self, loads: &[StationLoad]) -> f64 {
        self.0.iter().zip(loads).map(|(station, load)| station.bound(load)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_sections::{Point, Polygon, Tube};

    #[test]
    fn no_stress_exceeds_the_bound() {
        let corners = [(2.0, 1.0), (-1.0, 1.5), (-1.0, -1.0), (1.0, -1.0), (0.5, 0.5)];
        let corners = corners.map(|(xi, zeta)| Point { xi, zeta });
        let polygon = Polygon::new(&corners, &[0.02, 0.03, 0.01, 0.02, 0.02]).expect("a polygon");
        let tube = Tube::new(1.0, 0.1).expect("a tube");
        for slips in [Slips::default(), Slips::all()] {
            for here in [Section::Tube(tube), Section::Polygon(polygon.clone())] {
                let stations =
                    Stations::new(vec![AtStation { segment: 0, station: 0, here }], slips);
                // Numbers of all signs.
                for case in 0..64 {
                    let number = |i: usize| [2.0, -3.0][case >> i & 1] + i as f64;
                    let numbers = std::array::from_fn(number);
                    let loads = [StationLoad { numbers, ..StationLoad::none() }];
                    let bound = stations.bound(&loads);
                    for stresses in stations.stresses(&loads) {
                        let mut found = stresses.points().map(|point| point.stress.von_mises());
                        // A few roundings.
                        assert!(found.all(|found| found <= bound * (1.0 + 1e-14)), "{stresses:?}");
                    }
                }
            }
        }
    }
}
