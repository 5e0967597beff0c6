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
        self.stresses.as_ref().is_some_and(Recorder::needs_detail)
            || self.wanted.as_ref().is_some_and(MotionTable::needs_detail)
    }

    fn output_times(&self) -> Option<&OutputTimes> {
        self.prepared.run.output.times.as_ref()
    }

    fn interrupted(&self) -> bool {
        self.signals.came()
    }

    fn sample(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        self.states.push(snapshot);
        if let Some(wanted) = &mut self.wanted {
            wanted.push(snapshot);
        }
        self.stresses.as_mut().map_or(Ok(()), |analysis| analysis.sample(snapshot))
    }

    fn event(&mut self, event: &Event, _after: &Snapshot) -> io::Result<()> {
        self.events.push(*event);
        Ok(())
    }

    fn needs_instants(&self) -> bool {
        self.stresses.is_some()
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        self.stresses.as_mut().map_or(Ok(()), |analysis| Recorder::instant(analysis, instant))
    }

    fn needs_steps(&self) -> bool {
        self.stresses.is_some()
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        self.stresses.as_mut().map_or(Ok(()), |analysis| Recorder::step(analysis, step))
    }
}
