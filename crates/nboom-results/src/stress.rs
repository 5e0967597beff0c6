use std::io::{self, Write};
use std::path::{Path, PathBuf};

use nboom_model::HingeLabel;
use nboom_scalar::Wrench;
use nboom_sections::PointStress;
use nboom_sim::{LockUpMotion, Snapshot};
use nboom_strength::{Cause, StationStress, StressAnalysis, Worst};

use crate::number::{field, vector_fields};
use crate::rows::{self, Output};
use crate::signs::StressSigns;
use crate::{ENVELOPE_FILE, HINGE_LOADS_FILE, ResultsError, STRESS_FILE};

const STRESS_HEADER: &str = "t,event,appendage,segment,station,point,xi,zeta,sigma_22,sigma_21,\
     sigma_23,principal_1,principal_2,von_mises,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const HINGE_LOADS_HEADER: &str = "t,event,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const ENVELOPE_HEADER: &str = "appendage,segment,station,t,event,event_appendage,event_segment,xi,\
     zeta,sigma_22,sigma_21,sigma_23,von_mises,driver,margin";

/// Names of the four axis points in `stress.csv`.
const AXIS_POINTS: [&str; 4] = ["0", "90", "180", "270"];

/// Writes `stress.csv` and `hinge_loads.csv` while a run goes on, and the envelope at its end.
///
/// Stresses have the signs asked for; forces and moments act on what is outboard of a station or hinge, in segment
/// axes, moments about the point of the station on the η axis or about the hinge point. A row with
/// the event `lock_up` has peaks: what the motion just before makes, and the pulses.
#[derive(Debug)]
pub(crate) struct StressWriter {
    directory: PathBuf,
    pub analysis: StressAnalysis,
    signs: StressSigns,
    /// Output times from one computation to the next.
    every: usize,
    samples: usize,
    hinges: Vec<HingeLabel>,
    stresses: Output,
    hinge_loads: Output,
}

impl StressWriter {
    pub fn create(
        directory: &Path,
        hinges: Vec<HingeLabel>,
        analysis: StressAnalysis,
        every: usize,
        signs: StressSigns,
    ) -> Result<Self, ResultsError> {
        let started = |file: &str, header: &str| {
            let path = directory.join(file);
            let table = rows::create(&path).and_then(|mut out| {
                writeln!(out, "{header}")?;
                Ok(out)
            });
            table.map_err(ResultsError::writing(&path))
        };
        Ok(Self {
            directory: directory.to_owned(),
            stresses: started(STRESS_FILE, STRESS_HEADER)?,
            hinge_loads: started(HINGE_LOADS_FILE, HINGE_LOADS_HEADER)?,
            analysis,
            signs,
            every: every.max(1),
            samples: 0,
            hinges,
        })
    }

    /// Whether the coming output time is one of those that stresses are computed at.
    pub fn is_due(&self) -> bool {
        self.samples.is_multiple_of(self.every)
    }

    pub fn sample(&mut self, snapshot: &Snapshot) -> Result<(), ResultsError> {
        let due = self.is_due();
        self.samples += 1;
        let Some(detail) = snapshot.detail.as_ref().filter(|_| due) else { return Ok(()) };
        self.analysis.motion(snapshot, detail)?;
        self.write(snapshot.time, "")
    }

    pub fn lock_up(&mut self, lock_up: &LockUpMotion) -> Result<(), ResultsError> {
        let Some(detail) = &lock_up.before.detail else { return Ok(()) };
        self.analysis.lock_up(lock_up, detail)?;
        self.write(lock_up.before.time, "lock_up")
    }

    /// Writes what the analysis has found last.
    fn write(&mut self, time: f64, event: &str) -> Result<(), ResultsError> {
        let Self { stresses, hinges, analysis, signs, .. } = self;
        let mut of_stations = analysis.stresses().iter();
        let written = of_stations.try_for_each(|station| {
            write_station(stresses, hinges[station.segment], (time, event), station, *signs)
        });
        written.map_err(ResultsError::writing(&self.directory.join(STRESS_FILE)))?;
        let written = self.write_hinges(time, event);
        written.map_err(ResultsError::writing(&self.directory.join(HINGE_LOADS_FILE)))
    }

    fn write_hinges(&mut self, time: f64, event: &str) -> io::Result<()> {
        let out = &mut self.hinge_loads;
        for (hinge, load) in self.hinges.iter().zip(self.analysis.hinge_loads()) {
            write!(out, "{time:?},{event},{},{}", hinge.appendage + 1, hinge.segment + 1)?;
            load_fields(out, &load)?;
            writeln!(out)?;
        }
        Ok(())
    }

    /// Writes what waits in memory, and the worst of each station.
    pub fn finish(&mut self) -> Result<(), ResultsError> {
        let directory = &self.directory;
        let stresses = self.stresses.flush();
        stresses.map_err(ResultsError::writing(&directory.join(STRESS_FILE)))?;
        let hinge_loads = self.hinge_loads.flush();
        hinge_loads.map_err(ResultsError::writing(&directory.join(HINGE_LOADS_FILE)))?;
        let path = directory.join(ENVELOPE_FILE);
        let written = rows::create(&path).and_then(|mut out| {
            writeln!(out, "{ENVELOPE_HEADER}")?;
            let worst = self.analysis.envelope().iter();
            worst.into_iter().try_for_each(|worst| self.write_worst(&mut out, worst))?;
            out.flush()
        });
        written.map_err(ResultsError::writing(&path))
    }

    fn write_worst(&self, out: &mut Output, worst: &Worst) -> io::Result<()> {
        let HingeLabel { appendage, segment } = worst.segment;
        write!(out, "{},{},{},{:?}", appendage + 1, segment + 1, worst.station + 1, worst.time)?;
        match worst.cause {
            Cause::Motion => write!(out, ",,,")?,
            Cause::LockUp { hinge } => {
                let HingeLabel { appendage, segment } = self.hinges[hinge];
                write!(out, ",lock_up,{},{}", appendage + 1, segment + 1)?;
            }
        }
        place_fields(out, &worst.severest, self.signs)?;
        field(out, worst.severest.stress.von_mises())?;
        write!(out, ",{}", worst.driver)?;
        match worst.margin {
            Some(margin) => field(out, margin)?,
            None => write!(out, ",")?,
        }
        writeln!(out)
    }
}

fn write_station(
    out: &mut impl Write,
    HingeLabel { appendage, segment }: HingeLabel,
    (time, event): (f64, &str),
    station: &StationStress,
    signs: StressSigns,
) -> io::Result<()> {
    let (appendage, segment, number) = (appendage + 1, segment + 1, station.station + 1);
    let axis_points = AXIS_POINTS.into_iter().zip(station.axis_points);
    let points = axis_points.filter_map(|(name, point)| Some((name, point?)));
    for (name, point) in points.chain([("max", station.severest)]) {
        write!(out, "{time:?},{event},{appendage},{segment},{number},{name}")?;
        place_fields(out, &point, signs)?;
        let [largest, smallest] = signs.principal(point.stress);
        field(out, largest)?;
        field(out, smallest)?;
        field(out, point.stress.von_mises())?;
        load_fields(out, &station.load)?;
        writeln!(out)?;
    }
    Ok(())
}

/// Place and stress components.
fn place_fields(out: &mut impl Write, point: &PointStress, signs: StressSigns) -> io::Result<()> {
    let place = [point.place.xi, point.place.zeta];
    let numbers = place.into_iter().chain(signs.components(point.stress));
    numbers.into_iter().try_for_each(|number| field(out, number))
}

fn load_fields(out: &mut impl Write, load: &Wrench<f64>) -> io::Result<()> {
    vector_fields(out, load.force)?;
    vector_fields(out, load.moment)
}
