use std::io::{self, Write};
use std::path::{Path, PathBuf};

use nboom_model::HingeLabel;
use nboom_sim::{InstantMotion, Snapshot};
use nboom_strength::{Cause, StressAnalysis, Worst};

use crate::number::{field, number};
use crate::rows::{self, Output};
use crate::stress_rows::{StressRows, place_fields};
use crate::{ENVELOPE_FILE, HINGE_LOADS_FILE, ResultsError, STRESS_FILE};

const STRESS_HEADER: &str = "t,event,appendage,segment,station,point,xi,zeta,sigma_22,sigma_21,\
     sigma_23,principal_1,principal_2,von_mises,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const HINGE_LOADS_HEADER: &str = "t,event,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const ENVELOPE_HEADER: &str = "appendage,segment,station,t,event,event_appendage,event_segment,xi,\
     zeta,sigma_22,sigma_21,sigma_23,von_mises,driver,margin";

/// Writes `stress.csv` and `hinge_loads.csv` while a run goes on, and the envelope at its end.
///
/// Tension is positive; forces and moments act on what is outboard of a station or hinge, in segment
/// axes, moments about the point of the station on the η axis or about the hinge point. A row with
/// the event `lock_up` has peaks: what the motion just before makes, and the pulses.
#[derive(Debug)]
pub(crate) struct StressWriter {
    directory: PathBuf,
    pub analysis: StressAnalysis,
    /// Output times from one computation to the next.
    every: usize,
    samples: usize,
    hinges: Vec<HingeLabel>,
    stresses: Output,
    hinge_loads: Output,
    /// Rows that are to be written next.
    rows: StressRows,
}

impl StressWriter {
    pub fn create(
        directory: &Path,
        hinges: Vec<HingeLabel>,
        analysis: StressAnalysis,
        every: usize,
    ) -> Result<Self, ResultsError> {
        let started = |file: &str, header: &str| {
            let path = directory.join(file);
            let table = rows::create_long(&path).and_then(|mut out| {
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
            every: every.max(1),
            samples: 0,
            hinges,
            rows: StressRows::default(),
        })
    }

    /// Whether the coming output time is one of those that stresses are computed at.
    pub fn is_due(&self) -> bool {
        self.samples.is_multiple_of(self.every)
    }

    /// Computes the stresses of an output time, if they are due; [`Self::write`] writes them.
    pub fn sample(&mut self, snapshot: &Snapshot) -> Result<(), ResultsError> {
        let due = self.is_due();
        self.samples += 1;
        let Some(detail) = snapshot.detail.as_ref().filter(|_| due) else { return Ok(()) };
        self.analysis.motion(snapshot, detail)?;
        self.compose(snapshot.time, "")
    }

    /// Computes both sides of an instant, and the peaks if hinges lock; [`Self::write`] writes these.
    pub fn instant(&mut self, instant: &InstantMotion) -> Result<(), ResultsError> {
        self.analysis.instant(instant)?;
        if instant.jumps.is_empty() {
            return Ok(());
        }
        self.compose(instant.after.time, "lock_up")
    }

    fn compose(&mut self, time: f64, event: &str) -> Result<(), ResultsError> {
        let composed = self.rows.compose(&self.hinges, (time, event), &self.analysis);
        composed.map_err(ResultsError::writing(&self.directory.join(STRESS_FILE)))
    }

    /// Whether [`Self::write`] would send something to the disk.
    pub fn reaches_disk(&self) -> bool {
        rows::overflows(&self.stresses, &self.rows.stresses)
            || rows::overflows(&self.hinge_loads, &self.rows.hinge_loads)
    }

    /// Writes what has been computed since it was called last.
    pub fn write(&mut self) -> Result<(), ResultsError> {
        let written = self.stresses.write_all(&self.rows.stresses);
        written.map_err(ResultsError::writing(&self.directory.join(STRESS_FILE)))?;
        let written = self.hinge_loads.write_all(&self.rows.hinge_loads);
        written.map_err(ResultsError::writing(&self.directory.join(HINGE_LOADS_FILE)))?;
        self.rows.clear();
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
        write!(out, "{},{},{},", appendage + 1, segment + 1, worst.station + 1)?;
        number(out, worst.time)?;
        match worst.cause {
            Cause::Motion => write!(out, ",,,")?,
            Cause::LockUp { hinge } => {
                let HingeLabel { appendage, segment } = self.hinges[hinge];
                write!(out, ",lock_up,{},{}", appendage + 1, segment + 1)?;
            }
        }
        place_fields(out, &worst.severest)?;
        field(out, worst.severest.stress.von_mises())?;
        write!(out, ",{}", worst.driver)?;
        match worst.margin {
            Some(margin) => field(out, margin)?,
            None => write!(out, ",")?,
        }
        writeln!(out)
    }
}
