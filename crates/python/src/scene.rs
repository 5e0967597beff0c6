//! Scenes.

use std::ffi::OsString;
use std::fs;
use std::path::PathBuf;
use std::sync::OnceLock;

use nboom_cli::{PreparedRun, Routines, RunArgs, svg, warnings};
use nboom_formulation::Formulation;
use nboom_io::{
    Format, ReadOptions, SceneDocument, SceneFile, Slot, check_folder_name, parse, write_scene,
};
use nboom_package::{Build, Loaded, library, load};
use nboom_sim::Options;
use nboom_verify::{TestCase, compare_unless};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::dynamics::Dynamics;
use crate::error::{About, of_input, raised, warn, warned, wrong_input};
use crate::evaluator::Evaluator;
use crate::patience::Signals;
use crate::run::{Run, told_before};
use crate::simulator::Simulator;
use crate::words::run_args;

/// A scene that was read and checked.
#[pyclass(frozen, module = "nboom._nboom")]
pub(crate) struct Scene {
    file: SceneFile,
    /// Its text, in which numbers can be set.
    document: OnceLock<SceneDocument>,
    source: Option<Source>,
    routines: Routines,
}

/// What a deck or a robot was read from. A deck is no scene in TOML: its bodies have no names, and it has settings of
/// the integrator of 1970.
#[derive(Clone)]
struct Source {
    text: String,
    format: Format,
    fixed_base: bool,
}

/// The routines that the package has.
pub(crate) fn stock() -> Routines {
    Routines {
        for_runs: nboom_routines::for_runs(),
        equations: nboom_routines::equations(),
        batches: nboom_routines::batches(),
        right_sides_of_eight: nboom_routines::right_sides_of_eight(),
    }
}

impl Scene {
    pub fn of(file: SceneFile) -> Self {
        Self { file, document: OnceLock::new(), source: None, routines: stock() }
    }

    /// The options and the run that these words ask for.
    fn prepared(&self, words: &[OsString]) -> PyResult<(RunArgs, PreparedRun)> {
        let args = run_args(&self.file.scene.name, words)?;
        let prepared = args.prepare(self.file.clone(), &self.routines);
        let checked = prepared.and_then(|prepared| prepared.check().map(|()| prepared));
        Ok((args, checked.map_err(|error| raised(&error))?))
    }

    /// The scene as a text in which numbers can be set.
    fn document(&self) -> PyResult<&SceneDocument> {
        if let Some(document) = self.document.get() {
            return Ok(document);
        }
        let (text, name) = (write_scene(&self.file), &self.file.scene.name);
        let options = ReadOptions::default();
        let made = SceneDocument::of_text(Format::Toml, (name, &text), name, None, &options);
        let made = made.map_err(of_input)?;
        Ok(self.document.get_or_init(|| made))
    }

    fn slot(&self, path: &str) -> PyResult<Slot> {
        self.document()?.slot(path).map_err(|unknown| wrong_input(unknown.to_string()))
    }
}

#[pymethods]
impl Scene {
    /// Reads a scene `NAME.toml`, a deck `NAME.nml` or a robot `NAME.urdf`.
    #[staticmethod]
    fn load(
        path: PathBuf,
        set: Vec<(String, f64)>,
        include_anywhere: bool,
        fixed_base: bool,
    ) -> PyResult<Self> {
        let options = ReadOptions { set, includes_from_anywhere: include_anywhere, fixed_base };
        let file = nboom_io::read_scene_with(&path, &options).map_err(of_input)?;
        if file.format == Format::Toml {
            let document = SceneDocument::read(&path, &options).map_err(of_input)?;
            return Ok(Self { document: document.into(), ..Self::of(file) });
        }
        let format = file.format;
        // As its reader: comments of decks may be in any code.
        let text = fs::read(&path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        let source = text.ok().map(|text| Source { text, format, fixed_base });
        Ok(Self { source, ..Self::of(file) })
    }

    /// Reads a text in TOML, a deck (`nml`) or a robot (`urdf`).
    #[staticmethod]
    fn parse(
        text: &str,
        name: &str,
        format: &str,
        folder: Option<PathBuf>,
        fixed_base: bool,
    ) -> PyResult<Self> {
        let format = match format {
            "toml" => Format::Toml,
            "nml" => Format::Nml,
            "urdf" => Format::Urdf,
            other => {
                return Err(PyValueError::new_err(format!(
                    "format: `{other}` found, toml, nml or urdf expected"
                )));
            }
        };
        if let Err((found, expected)) = check_folder_name(name) {
            return Err(wrong_input(format!("name: {found} found, {expected} expected")));
        }
        let (folder, options) =
            (folder.as_deref(), ReadOptions { fixed_base, ..ReadOptions::default() });
        let file = parse(format, (name, text), name, folder, &options).map_err(of_input)?;
        if format == Format::Toml {
            let read = SceneDocument::of_text(format, (name, text), name, folder, &options);
            let document = read.map_err(of_input)?;
            return Ok(Self { document: document.into(), ..Self::of(file) });
        }
        let source = Some(Source { text: text.to_owned(), format, fixed_base });
        Ok(Self { source, ..Self::of(file) })
    }

    #[getter]
    fn name(&self) -> &str {
        &self.file.scene.name
    }

    /// Initial and end time.
    #[getter]
    fn span(&self) -> (f64, f64) {
        (self.file.scene.initial.time, self.file.scene.end_time)
    }

    #[getter]
    fn degrees_of_freedom(&self) -> usize {
        self.file.scene.degrees_of_freedom()
    }

    /// For each hinge what it is called, and its body if that has a name.
    #[getter]
    fn hinges(&self) -> Vec<(String, Option<String>)> {
        let labels = self.file.scene.labels().iter();
        let told = |[appendage, segment]: [usize; 2]| format!("{appendage},{segment}");
        labels
            .map(|label| (told(label.numbers()), label.name.as_deref().map(str::to_owned)))
            .collect()
    }

    #[getter]
    fn units(&self) -> String {
        self.file.settings.units.as_ref().map_or("none", |units| units.name()).to_owned()
    }

    #[getter]
    fn parameters(&self) -> Vec<(String, f64)> {
        self.file.settings.parameters.clone()
    }

    #[getter]
    fn warnings(&self) -> Vec<String> {
        warnings(&self.file, &self.file.scene)
    }

    #[getter]
    fn sha256(&self) -> &str {
        &self.file.sha256
    }

    /// A text in TOML that stands alone.
    fn text(&self) -> PyResult<String> {
        Ok(self.document()?.text())
    }

    /// What `parse` makes the same scene of: text, name, format, folder, and whether the base is fixed.
    fn source(&self) -> PyResult<(String, &str, &'static str, Option<PathBuf>, bool)> {
        let name = &*self.file.scene.name;
        Ok(match &self.source {
            Some(Source { text, format, fixed_base }) => {
                (text.clone(), name, format.name(), None, *fixed_base)
            }
            None => (self.text()?, name, Format::Toml.name(), None, false),
        })
    }

    /// A drawing in SVG, if the scene can be drawn.
    fn svg(&self) -> Option<String> {
        svg(&self.file)
    }

    /// The number at a path.
    fn number(&self, path: &str) -> PyResult<f64> {
        let slot = self.slot(path)?;
        Ok(self.document()?.number(&slot))
    }

    /// The scene with other numbers at these paths.
    fn with_numbers(&self, values: Vec<(String, f64)>) -> PyResult<Self> {
        let slots = values.iter().map(|(path, value)| Ok((self.slot(path)?, *value)));
        let slots = slots.collect::<PyResult<Vec<_>>>()?;
        for (i, (slot, _)) in slots.iter().enumerate() {
            if let Some(j) = slots[..i].iter().position(|(other, _)| other == slot) {
                let [first, second] = [j, i].map(|at| &values[at].0);
                return Err(wrong_input(format!(
                    "values: `{first}` and `{second}` found, which are one number; one of them expected"
                )));
            }
        }
        let values: Vec<(&Slot, f64)> = slots.iter().map(|(slot, value)| (slot, *value)).collect();
        let document = self.document()?.with(&values);
        let file = document.scene(&[]).map_err(of_input)?;
        Ok(Self { file, document: document.into(), source: None, routines: self.routines })
    }

    /// What runs the scene with these options of `nboom run`.
    fn simulator(&self, words: Vec<OsString>) -> PyResult<Simulator> {
        let (_, prepared) = self.prepared(&words)?;
        Ok(Simulator::new(prepared))
    }

    /// Runs the scene with these options of `nboom run` into the directory that they name; warns of what the run
    /// `before` has not warned of.
    fn write(&self, py: Python<'_>, words: Vec<OsString>, before: &Run) -> PyResult<()> {
        let (args, prepared) = self.prepared(&words)?;
        let known = [self.warnings(), before.warnings()].concat();
        warn(py, About::Scene, told_before(&prepared), &known)?;
        let signals = Signals::new();
        let write = || prepared.write(&args, &signals.interrupt());
        let written = warned(py, About::Results, &known, write)?;
        written.map(|_| ()).map_err(|error| signals.taken().unwrap_or_else(|| raised(&error)))
    }

    /// Code for the equations of motion, hinges free but those that are held at an angle.
    fn dynamics(&self, words: Vec<OsString>, held: Vec<(usize, f64)>) -> PyResult<Dynamics> {
        let (_, prepared) = self.prepared(&words)?;
        let scene = &prepared.scene;
        let mut angles = vec![None; scene.bodies.len()];
        for (hinge, angle) in held {
            if !angle.is_finite() {
                let label = scene.label(hinge);
                return Err(PyValueError::new_err(format!(
                    "held: {angle} found for hinge {label}, a finite number expected"
                )));
            }
            angles[hinge] = Some(angle);
        }
        let options = Options { kernels: self.routines.for_runs, ..prepared.options };
        let evaluator = Evaluator::new(scene, &angles, &options, self.routines.batches);
        let evaluator = evaluator.map_err(wrong_input)?;
        let label = |&hinge: &usize| scene.label(hinge).to_string();
        let hinges = evaluator.free_hinges().iter().map(label).collect();
        Ok(Dynamics::of(evaluator, hinges))
    }

    /// Compares all code that computes accelerations on random states: `verify.json`.
    fn verify(&self, py: Python<'_>, states: usize, seed: u64, tolerance: f64) -> PyResult<String> {
        let (scene, routines) = (self.file.scene.clone(), self.routines);
        let signals = Signals::new();
        let compared = py.detach(|| {
            let held = TestCase::each_with_held_hinges(&scene, states / 2, seed);
            let (drawn, interrupted) = (states - held.len(), || signals.came());
            let free = TestCase::new_unless(&interrupted, scene.clone(), drawn, seed)?;
            let routines = (routines.for_runs, routines.equations);
            compare_unless(&interrupted, &free, held, routines, tolerance)
        });
        let compared =
            compared.map_err(|error| signals.taken().unwrap_or_else(|| raised(&error.into())))?;
        Ok(compared.json())
    }

    /// The same scene with routines that cargo compiles for it now.
    fn compiled(
        &self,
        py: Python<'_>,
        formulation: Option<&str>,
        work: Option<PathBuf>,
        offline: bool,
    ) -> PyResult<Self> {
        let named = |name| {
            Formulation::named(name).ok_or_else(|| {
                let known = Formulation::ALL.map(Formulation::name).join(", ");
                wrong_input(format!("formulation: `{name}` found, one of {known} expected"))
            })
        };
        let formulation = formulation.map_or(Ok(Build::default().formulation), named)?;
        let build = Build { formulation, work, offline, ..Build::default() };
        let SceneFile { scene, structure, .. } = &self.file;
        let loaded = py.detach(|| load(&library(scene, structure.as_ref(), &build, |_| {})?.path));
        let Loaded { kernels, batches } = loaded.map_err(|error| raised(&error.into()))?;
        let for_runs = [kernels, self.routines.for_runs].concat().leak();
        let right_sides_of_eight = [batches, self.routines.right_sides_of_eight].concat().leak();
        let batches = [batches, self.routines.batches].concat().leak();
        let routines = Routines { for_runs, right_sides_of_eight, batches, ..self.routines };
        let (file, document) = (self.file.clone(), self.document.clone());
        Ok(Self { file, document, source: self.source.clone(), routines })
    }
}
