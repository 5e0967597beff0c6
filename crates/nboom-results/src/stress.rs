use std::io::{self, Write};
use std::path::{Path, PathBuf};

use nboom_model::HingeLabel;
use nboom_sim::{InstantMotion, Snapshot, StepMotion};
use nboom_strength::{Cause, StressAnalysis, Worst, WorstHingeLoad};

use crate::number::{field, number};
use crate::row_text::{RowText, load_fields, place_fields, stress_fields};
use crate::rows::{self, LongTable, Output};
use crate::signs::StressSigns;
use crate::{
    ENVELOPE_FILE, HINGE_ENVELOPE_FILE, HINGE_LOADS_FILE, LATCH_IMPULSES_FILE, ResultsError,
    STRESS_FILE,
};

const STRESS_HEADER: &str = "t,event,appendage,segment,station,point,xi,zeta,sigma_22,sigma_21,\
     sigma_23,principal_1,principal_2,von_mises,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const HINGE_LOADS_HEADER: &str = "t,event,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const LATCH_IMPULSES_HEADER: &str =
    "t,event_appendage,event_segment,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";
const ENVELOPE_HEADER: &str = "appendage,segment,station,t,event,event_appendage,event_segment,xi,\
     zeta,sigma_22,sigma_21,sigma_23,von_mises,driver,margin,share,p_xi,p_eta,p_zeta,q_xi,q_eta,\
     q_zeta";
const HINGE_ENVELOPE_HEADER: &str = "appendage,segment,quantity,t,event,event_appendage,\
     event_segment,magnitude,share,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta";

/// What stands for the driver of a station that carries nothing.
const UNLOADED: &str = "unloaded";

/// How stresses are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StressTables {
    /// Output times from one computation to the next; 0 counts as 1.
    pub every: usize,
    /// Which sign they have.
    pub signs: StressSigns,
}

/// Writes `hinge_loads.csv` and `latch_impulses.csv`, and where there are stations `stress.csv`, while a
/// run goes on, and the envelopes at its end.
///
/// Forces and moments act on what is outboard of a station or hinge, in segment axes, moments about
/// the point of the station on the η axis or about the hinge point. A row with the event `lock_up` has
/// peaks: what the motion makes, and the pulses that are known.
#[derive(Debug)]
pub(crate) struct StressWriter {
    directory: PathBuf,
    pub analysis: StressAnalysis,
    /// Output times from one computation to the next.
    every: usize,
    samples: usize,
    hinges: Vec<HingeLabel>,
    /// Where there are stations.
    stresses: Option<LongTable>,
    hinge_loads: LongTable,
    latch_impulses: LongTable,
    text: RowText,
}

impl StressWriter {
    pub fn create(
        directory: &Path,
        hinges: Vec<HingeLabel>,
        analysis: StressAnalysis,
        StressTables { every, signs }: StressTables,
    ) -> Result<Self, ResultsError> {
        let table = |file: &str, header: &str| LongTable::create(directory, file, header);
        let stresses = analysis.has_stations().then(|| table(STRESS_FILE, STRESS_HEADER));
        Ok(Self {
            directory: directory.to_owned(),
            stresses: stresses.transpose()?,
            hinge_loads: table(HINGE_LOADS_FILE, HINGE_LOADS_HEADER)?,
            latch_impulses: table(LATCH_IMPULSES_FILE, LATCH_IMPULSES_HEADER)?,
            analysis,
            every: every.max(1),
            samples: 0,
            text: RowText::new(signs, &hinges),
            hinges,
        })
    }

    /// Whether the coming output time is one of those that loads are written at.
    pub fn is_due(&self) -> bool {
        self.samples.is_multiple_of(self.every)
    }

    /// Computes the loads of an output time, if they are due; its rows wait for [`Self::write`].
    pub fn sample(&mut self, snapshot: &Snapshot) -> Result<(), ResultsError> {
        let due = self.is_due();
        self.samples += 1;
        let Some(detail) = snapshot.detail.as_ref().filter(|_| due) else { return Ok(()) };
        self.analysis.motion(snapshot, detail)?;
        self.compose(snapshot.time, "")
    }

    /// The largest loads of a step, for the envelopes.
    pub fn step(&mut self, step: &mut dyn StepMotion) -> Result<(), ResultsError> {
        Ok(self.analysis.step(step)?)
    }

    /// Computes both sides of an instant, and the peaks if hinges lock, whose rows wait for
    /// [`Self::write`].
    pub fn instant(&mut self, instant: &InstantMotion) -> Result<(), ResultsError> {
        self.analysis.instant(instant)?;
        if instant.jumps.is_empty() {
            return Ok(());
        }
        let Self { directory, hinges, analysis, text, latch_impulses, .. } = self;
        let out = &mut latch_impulses.lines;
        let written = analysis.latch_impulses().iter().try_for_each(|found| {
            text.set_latch(instant.after.time, hinges[found.latch])?;
            text.add_hinge_loads(out, &found.hinges)
        });
        written.map_err(ResultsError::writing(&directory.join(LATCH_IMPULSES_FILE)))?;
        self.compose(instant.after.time, "lock_up")
    }

    /// Adds rows of what the analysis has found last to what waits in memory.
    fn compose(&mut self, time: f64, event: &str) -> Result<(), ResultsError> {
        let Self { directory, hinges, analysis, text, stresses, hinge_loads, .. } = self;
        let composed = text.set_instant(time, event).and_then(|()| {
            if let Some(stresses) = stresses {
                text.add_stresses(&mut stresses.lines, hinges, analysis.stresses())?;
            }
            text.add_hinge_loads(&mut hinge_loads.lines, analysis.hinge_loads())
        });
        composed.map_err(ResultsError::writing(&directory.join(STRESS_FILE)))
    }

    /// Whether so much waits in memory that it is time to write.
    pub fn is_full(&self) -> bool {
        let tables = self.stresses.iter().chain([&self.hinge_loads, &self.latch_impulses]);
        tables.into_iter().any(LongTable::is_long)
    }

    /// Writes what waits in memory.
    pub fn write(&mut self) -> Result<(), ResultsError> {
        let Self { stresses, hinge_loads, latch_impulses, .. } = self;
        let mut tables = stresses.iter_mut().chain([hinge_loads, latch_impulses]);
        tables.try_for_each(LongTable::write)
    }

    /// Lets the last pulses come to their ends, and writes what waits in memory and the worst of each
    /// station and hinge.
    pub fn finish(&mut self) -> Result<(), ResultsError> {
        self.analysis.finish()?;
        self.write()?;
        if self.stresses.is_some() {
            self.write_table(ENVELOPE_FILE, ENVELOPE_HEADER, |out| {
                let worst = self.analysis.envelope();
                worst.iter().try_for_each(|worst| self.write_worst(out, worst))
            })?;
        }
        self.write_table(HINGE_ENVELOPE_FILE, HINGE_ENVELOPE_HEADER, |out| {
            let worst = self.analysis.hinge_envelope();
            worst.iter().try_for_each(|worst| self.write_worst_of_hinge(out, worst))
        })
    }

    fn write_table(
        &self,
        file: &str,
        header: &str,
        rows: impl FnOnce(&mut Output) -> io::Result<()>,
    ) -> Result<(), ResultsError> {
        let path = self.directory.join(file);
        let written = rows::create(&self.directory, file).and_then(|mut out| {
            writeln!(out, "{header}")?;
            rows(&mut out)?;
            out.flush()
        });
        written.map_err(ResultsError::writing(&path))
    }

    fn write_worst(&self, out: &mut Output, worst: &Worst) -> io::Result<()> {
        let HingeLabel { appendage, segment } = worst.segment;
        write!(out, "{},{},{},", appendage + 1, segment + 1, worst.station + 1)?;
        number(out, worst.time)?;
        self.event_fields(out, worst.cause)?;
        place_fields(out, worst.severest.place)?;
        stress_fields(out, self.text.components(worst.severest.stress))?;
        field(out, worst.severest.stress.von_mises())?;
        write!(out, ",{}", worst.driver.map_or(UNLOADED, |driver| driver.name()))?;
        match worst.margin {
            Some(margin) => field(out, margin)?,
            None => write!(out, ",")?,
        }
        share_field(out, worst.cause)?;
        load_fields(out, &worst.load)?;
        writeln!(out)
    }

    fn write_worst_of_hinge(&self, out: &mut Output, worst: &WorstHingeLoad) -> io::Result<()> {
        let HingeLabel { appendage, segment } = worst.hinge;
        write!(out, "{},{},{},", appendage + 1, segment + 1, worst.quantity.name())?;
        number(out, worst.time)?;
        self.event_fields(out, worst.cause)?;
        field(out, worst.magnitude())?;
        share_field(out, worst.cause)?;
        load_fields(out, &worst.load)?;
        writeln!(out)
    }

    /// The event that made a load, and its hinge.
    fn event_fields(&self, out: &mut Output, cause: Cause) -> io::Result<()> {
        match cause {
            Cause::Motion => write!(out, ",,,"),
            Cause::LockUp { hinge, .. } => {
                let HingeLabel { appendage, segment } = self.hinges[hinge];
                write!(out, ",lock_up,{},{}", appendage + 1, segment + 1)
            }
        }
    }
}

fn share_field(out: &mut Output, cause: Cause) -> io::Result<()> {
    match cause {
        Cause::Motion => write!(out, ","),
        Cause::LockUp { share, .. } => field(out, share),
    }
}
