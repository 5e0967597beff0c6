use std::io::{self, Write};

use nboom_model::HingeLabel;
use nboom_scalar::Wrench;
use nboom_sections::{PointStress, Stress};
use nboom_strength::StressAnalysis;

use crate::number::{field, number, vector_fields};

/// Names of the four axis points in `stress.csv`.
const AXIS_POINTS: [&str; 4] = ["0", "90", "180", "270"];

/// Rows of one time in `stress.csv` and `hinge_loads.csv`.
///
/// What several rows share is turned into text once.
#[derive(Debug, Default)]
pub(crate) struct StressRows {
    pub stresses: Vec<u8>,
    pub hinge_loads: Vec<u8>,
    /// Time and event.
    instant: Vec<u8>,
    /// Appendage, segment and station.
    station: Vec<u8>,
    /// Load of the station, to the end of the row.
    load: Vec<u8>,
}

impl StressRows {
    /// Replaces them by those of what `analysis` has found last.
    pub fn compose(
        &mut self,
        hinges: &[HingeLabel],
        (time, event): (f64, &str),
        analysis: &StressAnalysis,
    ) -> io::Result<()> {
        self.clear();
        self.instant.clear();
        number(&mut self.instant, time)?;
        write!(self.instant, ",{event}")?;
        self.compose_stresses(hinges, analysis)?;
        self.compose_hinge_loads(hinges, analysis)
    }

    /// Leaves no rows.
    pub fn clear(&mut self) {
        self.stresses.clear();
        self.hinge_loads.clear();
    }

    fn compose_stresses(
        &mut self,
        hinges: &[HingeLabel],
        analysis: &StressAnalysis,
    ) -> io::Result<()> {
        let Self { stresses: out, instant, station, load, .. } = self;
        for of_station in analysis.stresses() {
            let HingeLabel { appendage, segment } = hinges[of_station.segment];
            station.clear();
            write!(station, ",{},{},{},", appendage + 1, segment + 1, of_station.station + 1)?;
            load.clear();
            load_fields(load, &of_station.load)?;
            writeln!(load)?;
            let axis_points = AXIS_POINTS.into_iter().zip(of_station.axis_points);
            let points = axis_points.filter_map(|(name, point)| Some((name, point?)));
            for (name, point) in points.chain([("max", of_station.severest)]) {
                [instant, station, name.as_bytes()].into_iter().for_each(|part| out.extend(part));
                point_fields(out, &point)?;
                out.extend(&*load);
            }
        }
        Ok(())
    }

    fn compose_hinge_loads(
        &mut self,
        hinges: &[HingeLabel],
        analysis: &StressAnalysis,
    ) -> io::Result<()> {
        let Self { hinge_loads: out, instant, .. } = self;
        for (hinge, load) in hinges.iter().zip(analysis.hinge_loads()) {
            out.extend(&*instant);
            write!(out, ",{},{}", hinge.appendage + 1, hinge.segment + 1)?;
            load_fields(out, &load)?;
            writeln!(out)?;
        }
        Ok(())
    }
}

fn point_fields(out: &mut impl Write, point: &PointStress) -> io::Result<()> {
    place_fields(out, point)?;
    let [largest, smallest] = point.stress.principal();
    field(out, largest)?;
    field(out, smallest)?;
    field(out, point.stress.von_mises())
}

/// Place and stress components.
pub(crate) fn place_fields(out: &mut impl Write, point: &PointStress) -> io::Result<()> {
    let Stress { normal, shear_xi, shear_zeta } = point.stress;
    let numbers = [point.place.xi, point.place.zeta, normal, shear_xi, shear_zeta];
    numbers.into_iter().try_for_each(|number| field(out, number))
}

fn load_fields(out: &mut impl Write, load: &Wrench<f64>) -> io::Result<()> {
    vector_fields(out, load.force)?;
    vector_fields(out, load.moment)
}
