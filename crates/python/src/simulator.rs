//! Scenes that are prepared to be run.

use std::io;
use std::sync::{Arc, Mutex};
use std::time::Instant;

use nboom_cli::{CliError, PreparedRun};
use nboom_results::{WorstLoads, with_causes};
use nboom_sim::{Event, InstantMotion, OutputTimes, Recorder, Snapshot, StepMotion};
use nboom_strength::StressAnalysis;
use pyo3::prelude::*;

use crate::columns::MotionTable;
use crate::error::raised;
use crate::patience::{Signals, wait};
use crate::run::{Numbers, Run, told_before};

/// A scene with options, prepared to be run as often as wanted.
#[pyclass(frozen, module = "nboom._nboom")]
pub(crate) struct Simulator {
    simulator: Mutex<nboom_sim::Simulator>,
    prepared: Arc<PreparedRun>,
}

/// What a run tells, in memory.
struct Memory<'a> {
    prepared: &'a PreparedRun,
    states: MotionTable,
    /// The table that is wanted beside it.
    wanted: Option<MotionTable>,
    events: Vec<Event>,
    stresses: Option<StressAnalysis>,
    signals: Signals,
}

impl Simulator {
    pub fn new(prepared: PreparedRun) -> Self {
        let simulator = nboom_sim::Simulator::new(&prepared.scene, prepared.options);
        Self { simulator: Mutex::new(simulator), prepared: Arc::new(prepared) }
    }
}

impl Memory<'_> {
    /// Whether the run has no length, so that its output time is all that its loads are found at.
    fn is_moment(&self) -> bool {
        self.prepared.scene.initial.time == self.prepared.scene.end_time
    }
}

#[pymethods]
impl Simulator {
    /// Runs it. A run that fails is the attribute `run` of the exception.
    fn run(&self, py: Python<'_>) -> PyResult<Run> {
        let prepared = &*self.prepared;
        let labels = prepared.scene.labels();
        let output = &prepared.run.output;
        let (listed, samples) = (output.times.as_ref(), prepared.options.samples);
        let rows = OutputTimes::intervals(listed, samples, prepared.run.span) + 1;
        let wanted = output.table.clone().map(|table| MotionTable::new(table, labels, rows));
        let mut memory = Memory {
            prepared,
            states: MotionTable::of_states(labels, rows)?,
            wanted: wanted.transpose()?,
            events: Vec::new(),
            stresses: prepared.stresses.clone(),
            signals: Signals::new(),
        };
        let (summary, failed, seconds) = py.detach(|| -> PyResult<_> {
            let mut simulator = wait(&self.simulator)?;
            let started = Instant::now();
            let (summary, failed) = match simulator.run(&mut memory) {
                Ok(summary) => (summary.clone(), None),
                Err(failure) => (*failure.summary, Some(failure.error)),
            };
            Ok((summary, failed, started.elapsed().as_secs_f64()))
        })?;
        if let Some(interrupt) = memory.signals.taken() {
            return Err(interrupt);
        }
        let mut worst = WorstLoads::default();
        if let Some(analysis) = &mut memory.stresses {
            py.detach(|| analysis.finish()).map_err(|error| raised(&error.into()))?;
            worst = WorstLoads::of(analysis);
        }
        let Memory { states, wanted, events, .. } = memory;
        let error = failed.as_ref().map(|error| with_causes(error));
        let numbers = Numbers { states, wanted, events, summary, worst, seconds, error };
        let run = Run::new(py, Arc::clone(&self.prepared), numbers)?;
        let Some(error) = failed else { return Ok(run) };
        let raised = raised(&CliError::Simulation { error, directory: None });
        raised.value(py).setattr("run", run)?;
        Err(raised)
    }

    /// What is probably a mistake, and what is ignored of the scene and of the options.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        told_before(&self.prepared)
    }
}

impl Recorder for Memory<'_> {
    fn needs_detail(&self) -> bool {
        self.is_moment() && self.stresses.is_some()
            || self.wanted.as_ref().is_some_and(MotionTable::needs_detail)
    }

    fn output_times(&self) -> Option<&OutputTimes> {
        self.prepared.run.output.times.as_ref()
    }

    fn interrupted(&self) -> bool {
        self.signals.came()
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let is_moment = self.is_moment();
        self.states.push(snapshot);
        if let Some(wanted) = &mut self.wanted {
            wanted.push(snapshot);
        }
        match (&mut self.stresses, &snapshot.detail) {
            (Some(analysis), Some(detail)) if is_moment => {
                analysis.motion(snapshot, detail).map_err(io::Error::other)
            }
            _ => Ok(()),
        }
    }

    fn event(&mut self, event: &Event, _after: &Snapshot) -> io::Result<()> {
        self.events.push(*event);
        Ok(())
    }

    fn needs_instants(&self) -> bool {
        self.stresses.is_some()
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        let analysis = self.stresses.as_mut();
        analysis.map_or(Ok(()), |analysis| analysis.instant(instant).map_err(io::Error::other))
    }

    fn needs_steps(&self) -> bool {
        self.stresses.is_some()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        let analysis = self.stresses.as_mut();
        analysis.map_or(Ok(()), |analysis| analysis.step(step).map_err(io::Error::other))
    }
}
