//! Stresses of stations at one time.

use nboom_scalar::Wrench;
use nboom_sections::PointStress;

use crate::gauge::{Gauge, Measure};

/// Which station a gauge is for.
#[derive(Clone, Debug)]
pub(crate) struct StationPlace {
    pub segment: usize,
    pub station: usize,
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

/// The largest loads on either side of a lock-up, by its pulses and those that still lasted, until
/// they ended or the next hinge locked.
#[derive(Clone, Debug, PartialEq)]
pub struct LockUpPeaks {
    /// When the hinge or hinges locked.
    pub time: f64,
    /// When the von Mises stress of each station was largest.
    pub stresses: Vec<StationStress>,
    /// When the moment of each hinge was largest: force and moment that it exerts on its outboard body,
    /// about the hinge point, segment axes.
    pub hinge_loads: Vec<Wrench<f64>>,
}

/// The stresses of all stations under the load and numbers of each gauge.
pub(crate) fn set_stresses(
    stresses: &mut Vec<StationStress>,
    stations: &[StationPlace],
    gauges: &[Gauge],
    of: impl Fn(usize) -> (Wrench<f64>, [f64; 6]),
) {
    stresses.clear();
    for (g, (at, gauge)) in stations.iter().zip(gauges).enumerate() {
        let Measure::Stress(formulas) = &gauge.measure else { continue };
        let (load, numbers) = of(g);
        let axis_points = formulas.stresses(&load, numbers).axis_points();
        let (segment, station, max_von_mises) =
            (at.segment, at.station, formulas.max_von_mises_of(numbers));
        stresses.push(StationStress { segment, station, load, axis_points, max_von_mises });
    }
}
