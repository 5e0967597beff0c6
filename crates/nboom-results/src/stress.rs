use std::io::{self, Write};
use std::path::{Path, PathBuf};

use nboom_model::HingeLabel;
use nboom_sim::{InstantMotion, Snapshot};
use nboom_strength::{Cause, StressAnalysis, Worst};

use crate::number::{field, number};
use crate::row_text::{RowText, place_fields, stress_fields};
use crate::rows::{self, LongTable, Output};
use crate::signs::StressSigns;
use crate::{ENVELOPE_FILE, HINGE_LOADS_FILE, ResultsError, STRESS_FILE};

const STRESS_HEADER: &str = "t,event,appendage,segment,station,point,xi,zeta,sigma_22,sigma_21,\
     sigma_23,principal_1,principal_2,von_mises,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const HINGE_LOADS_HEADER: &str = "t,event,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const ENVELOPE_HEADER: &str = "appendage,segment,station,t,event,event_appendage,event_segment,xi,\
     zeta,sigma_22,sigma_21,sigma_23,von_mises,driver,margin";

/// How stresses are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StressTables {
    /// Output times from one computation to the next; 0 counts as 1.
    pub every: usize,
    /// Which sign they have.
    pub signs: StressSigns,
}

/// Writes `stress.csv` and `hinge_loads.csv` while a run goes on, and the envelope at its end.
///
/// Forces and moments act on what is outboard of a station or hinge, in segment axes, moments about
/// the point of the station on the η axis or about the hinge point. A row with the event `lock_up` has
/// peaks: what the motion just before makes, and the pulses.
#[derive(Debug)]
pub(crate) struct StressWriter {
    directory: PathBuf,
    pub analysis: StressAnalysis,
    /// Output times from one computation to the next.
    every: usize,
    samples: usize,
    hinges: Vec<HingeLabel>,
    stresses: LongTable,
    hinge_loads: LongTable,
    text: RowText,
}

impl StressWriter {
    pub fn create(
        directory: &Path,
        hinges: Vec<HingeLabel>,
        analysis: StressAnalysis,
        StressTables { every, signs }: StressTables,
    ) -> Result<Self, ResultsError> {
        Ok(Self {
            directory: directory.to_owned(),
            stresses: LongTable::create(directory.join(STRESS_FILE), STRESS_HEADER)?,
            hinge_loads: LongTable::create(directory.join(HINGE_LOADS_FILE), HINGE_LOADS_HEADER)?,
            analysis,
            every: every.max(1),
            samples: 0,
            text: RowText::new(signs, &hinges),
            hinges,
        })
    }

    /// Whether the coming output time is one of those that stresses are computed at.
    pub fn is_due(&self) -> bool {
        self.samples.is_multiple_of(self.every)
    }

    /// Computes the stresses of an output time, if they are due; its rows wait for [`Self::write`].
    pub fn sample(&mut self, snapshot: &Snapshot) -> Result<(), ResultsError> {
        let due = self.is_due();
        self.samples += 1;
        let Some(detail) = snapshot.detail.as_ref().filter(|_| due) else { return Ok(()) };
        self.analysis.motion(snapshot, detail)?;
        self.compose(snapshot.time, "")
    }

    /// Computes both sides of an instant, and the peaks if hinges lock, whose rows wait for
    /// [`Self::write`].
    pub fn instant(&mut self, instant: &InstantMotion) -> Result<(), ResultsError> {
        self.analysis.instant(instant)?;
        if instant.jumps.is_empty() {
            return Ok(());
        }
        self.compose(instant.after.time, "lock_up")
    }

    /// Adds rows of what the analysis has found last to what waits in memory.
    fn compose(&mut self, time: f64, event: &str) -> Result<(), ResultsError> {
        let Self { directory, hinges, analysis, text, stresses, hinge_loads, .. } = self;
        let composed = text.set_instant(time, event).and_then(|()| {
            text.add_stresses(&mut stresses.lines, hinges, analysis.stresses())?;
            text.add_hinge_loads(&mut hinge_loads.lines, analysis.hinge_loads())
        });
        composed.map_err(ResultsError::writing(&directory.join(STRESS_FILE)))
    }

    /// Whether so much waits in memory that it is time to write.
    pub fn is_full(&self) -> bool {
        self.stresses.is_long() || self.hinge_loads.is_long()
    }

    /// Writes what waits in memory.
    pub fn write(&mut self) -> Result<(), ResultsError> {
        self.stresses.write()?;
        self.hinge_loads.write()
    }

    /// Writes what waits in memory, and the worst of each station.
    pub fn finish(&mut self) -> Result<(), ResultsError> {
        self.write()?;
        let path = self.directory.join(ENVELOPE_FILE);
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
        place_fields(out, worst.severest.place)?;
        stress_fields(out, self.text.components(worst.severest.stress))?;
        field(out, worst.severest.stress.von_mises())?;
        write!(out, ",{}", worst.driver)?;
        // Nothing can be said of what is not loaded.
        match worst.margin.filter(|margin| margin.is_finite()) {
            Some(margin) => field(out, margin)?,
            None => write!(out, ",")?,
        }
        writeln!(out)
    }
}
