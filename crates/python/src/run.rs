//! What a run has found, in memory.

use std::sync::Arc;

use nboom_cli::{PreparedRun, idle_formulation};
use nboom_results::{RunDescription, SummaryFile, WorstLoads, event_heads, event_order};
use nboom_sim::{Event, Summary};
use numpy::{IntoPyArray, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::list;
use crate::columns::{Head, MotionTable};

/// The results of a run.
#[pyclass(frozen, module = "nboom._nboom")]
pub(crate) struct Run {
    prepared: Arc<PreparedRun>,
    states: (MotionTable, Py<PyArray2<f64>>),
    wanted: Option<(MotionTable, Py<PyArray2<f64>>)>,
    events: Vec<Event>,
    summary: Summary,
    worst: WorstLoads,
    seconds: f64,
    error: Option<String>,
}

/// What is found before Python sees it.
pub(crate) struct Numbers {
    pub states: MotionTable,
    pub wanted: Option<MotionTable>,
    pub events: Vec<Event>,
    pub summary: Summary,
    pub worst: WorstLoads,
    pub seconds: f64,
    pub error: Option<String>,
}

/// What a run warns of before it begins.
pub(crate) fn told_before(prepared: &PreparedRun) -> Vec<String> {
    prepared.run.told_before().chain(&prepared.ignored).cloned().collect()
}

impl Run {
    /// All that it has warned of.
    pub fn warnings(&self) -> Vec<String> {
        let ignored = self.ignored().into_iter().collect();
        [told_before(&self.prepared), ignored, self.troubles()].concat()
    }

    pub fn new(py: Python<'_>, prepared: Arc<PreparedRun>, numbers: Numbers) -> PyResult<Self> {
        let Numbers { states, wanted, mut events, summary, worst, seconds, error } = numbers;
        let table = |table: MotionTable| -> PyResult<(MotionTable, Py<PyArray2<f64>>)> {
            let mut table = table;
            let (numbers, width) = (std::mem::take(&mut table.numbers), table.width());
            let rows = numbers.len() / width;
            let array = numbers.into_pyarray(py).reshape([rows, width])?;
            Ok((table, array.unbind()))
        };
        let states = table(states)?;
        let wanted = wanted.map(table).transpose()?;
        events.sort_by(event_order);
        Ok(Self { prepared, states, wanted, events, summary, worst, seconds, error })
    }

    fn with_heads<'py>(
        &self,
        py: Python<'py>,
        (table, array): &(MotionTable, Py<PyArray2<f64>>),
    ) -> (Vec<Head>, Bound<'py, PyArray2<f64>>) {
        let RunDescription { hinges, units, .. } = self.description();
        (table.heads(hinges, units), array.bind(py).clone())
    }

    fn description(&self) -> &RunDescription {
        &self.prepared.run
    }
}

#[pymethods]
impl Run {
    /// Names, units and meanings of the columns of states, and their numbers, a row for each output time.
    #[getter]
    fn states<'py>(&self, py: Python<'py>) -> (Vec<Head>, Bound<'py, PyArray2<f64>>) {
        self.with_heads(py, &self.states)
    }

    /// The same of the table that the scene or the options want beside it.
    #[getter]
    fn wanted<'py>(&self, py: Python<'py>) -> Option<(Vec<Head>, Bound<'py, PyArray2<f64>>)> {
        self.wanted.as_ref().map(|wanted| self.with_heads(py, wanted))
    }

    /// Columns of the table of events by name: those of events.csv, and `body`.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (events, hinges) = (&self.events, &self.description().hinges);
        let numbers = |of: &dyn Fn(&Event) -> f64| list(py, events.iter().map(of).collect());
        let label = |event: &Event| event.hinge.map(|hinge| &hinges[hinge]);
        let place = |i: usize| {
            move |event: &Event| label(event).map_or(f64::NAN, |label| label.numbers()[i] as f64)
        };
        let kinds: Vec<String> = events.iter().map(|event| event.kind.name().to_string()).collect();
        let body =
            |event: &Event| label(event).and_then(|label| label.name.as_deref()).map(str::to_owned);
        let bodies: Vec<Option<String>> = events.iter().map(body).collect();
        let columns = PyDict::new(py);
        columns.set_item("t", numbers(&|event| event.time))?;
        columns.set_item("kind", kinds)?;
        columns.set_item("appendage", numbers(&place(0)))?;
        columns.set_item("segment", numbers(&place(1)))?;
        columns.set_item("body", bodies)?;
        columns.set_item("impulse", numbers(&|event| event.impulse.unwrap_or(f64::NAN)))?;
        columns.set_item("energy_before", numbers(&|event| event.before.kinetic_energy))?;
        columns.set_item("energy_after", numbers(&|event| event.after.kinetic_energy))?;
        Ok(columns)
    }

    /// Names of the columns of events, units of those that have one, and meanings.
    #[getter]
    fn event_heads(&self) -> Vec<(String, Option<String>, String)> {
        let units = &self.description().units;
        let of_body = ("body".to_owned(), None, "body on the hinge, if it has a name".to_owned());
        let told = |head: nboom_results::Head| {
            let unit = head.unit(units);
            (head.name.into_owned(), unit, head.about.into_owned())
        };
        event_heads(&self.description().hinges).into_iter().map(told).chain([of_body]).collect()
    }

    /// The text of `summary.json`.
    #[getter]
    fn summary(&self) -> String {
        let Self { summary, worst, seconds, error, .. } = self;
        let run = self.description();
        let ended = SummaryFile::ended(run, summary, worst, *seconds, error.as_deref(), Vec::new());
        let ended = ended.with_troubles(&self.troubles());
        String::from_utf8_lossy(&ended.text()).into_owned()
    }

    /// Why the results are not to be trusted, if so.
    #[getter]
    fn troubles(&self) -> Vec<String> {
        let Self { prepared, summary, worst, .. } = self;
        nboom_cli::troubles(&prepared.scene, summary, prepared.options.rtol, worst)
    }

    /// The formulation that is asked for, where the run had another one, and why.
    #[getter]
    fn ignored(&self) -> Option<String> {
        idle_formulation(&self.prepared.options, &self.summary)
    }

    /// Whether the run has come to its end.
    #[getter]
    fn complete(&self) -> bool {
        self.error.is_none()
    }

    /// Seconds that it took.
    #[getter]
    fn seconds(&self) -> f64 {
        self.seconds
    }
}
