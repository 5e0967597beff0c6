use nboom_io::{SceneDocument, SceneFile, Slot};
use nboom_model::{Errors, ModelError, Scene};
use nboom_sim::{Form, Options, Path};
use nboom_strength::WantedLoads;

use crate::distribution::Distribution;
use crate::plan::{Case, Plan};
use crate::rejection::Rejection;
use crate::requirement::Requirement;
use crate::wanted::Wanted;

/// What is varied in a scene, how, and what is wanted of each run; checked.
#[derive(Clone, Debug)]
pub struct Study {
    /// Its name, which that of its directory is too.
    pub name: String,
    /// The text of its file.
    pub text: String,
    /// The scene, in which numbers can be set.
    pub document: SceneDocument,
    /// The scene as it stands.
    pub nominal: SceneFile,
    /// The seed of everything random.
    pub seed: u64,
    /// How draws are made.
    pub method: Method,
    /// How many draws there are, of a grid the product of its points.
    pub draws: u64,
    /// What varies.
    pub variables: Vec<Variable>,
    /// Which variables vary together.
    pub correlations: Vec<Correlation>,
    /// What may be broken; each draw is also run once with each of them.
    pub faults: Vec<Fault>,
    /// What stands in the table of each run.
    pub wanted: Vec<Wanted>,
    /// Bounds that some of these should keep.
    pub requirements: Vec<Requirement>,
    /// How each case is run.
    pub run: RunSettings,
    /// Whether tables of states of all cases are wanted.
    pub trajectories: bool,
    /// What is drawn for each case.
    pub plan: Plan,
}

impl Study {
    /// The scene of a case, called after the study, the case and its fault, for a run that somebody looks at.
    ///
    /// # Errors
    /// As [`Self::scene_of`].
    pub fn named_scene_of(&self, case: &Case) -> Result<SceneFile, Rejection> {
        let file = self.scene_of(case)?;
        let fault = case.fault.map(|fault| format!(", {}", self.faults[fault].name));
        let name = format!("{}, case {}{}", self.name, case.number, fault.unwrap_or_default());
        Ok(SceneFile { scene: file.scene.called(name), ..file })
    }

    /// Variables that are correlated with another one.
    pub(crate) fn vary_together(&self) -> Vec<String> {
        let is_correlated = |i: &usize| self.correlations.iter().any(|of| of.between.contains(i));
        let correlated = (0..self.variables.len()).filter(is_correlated);
        correlated.map(|i| self.variables[i].name.clone()).collect()
    }
}

/// How draws are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// All combinations of points.
    Grid,
    /// Of each variable one draw in each of as many equal shares as there are draws.
    LatinHypercube,
    /// A Sobol sequence with a random digital shift.
    Sobol,
    /// Independent draws.
    MonteCarlo,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Grid, Self::LatinHypercube, Self::Sobol, Self::MonteCarlo];

    /// Its name in studies.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::LatinHypercube => "latin_hypercube",
            Self::Sobol => "sobol",
            Self::MonteCarlo => "monte_carlo",
        }
    }
}

/// How a drawn number changes one of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// It takes its place.
    Value,
    /// It multiplies it.
    Factor,
    /// It is added to it.
    Offset,
}

impl Relation {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Value, Self::Factor, Self::Offset];

    /// Its name in studies.
    pub fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Factor => "factor",
            Self::Offset => "offset",
        }
    }
}

/// A number that varies.
#[derive(Clone, Debug)]
pub struct Variable {
    /// The name of its column.
    pub name: String,
    /// The places in the scene that change with it.
    pub slots: Vec<Slot>,
    /// How it changes them.
    pub relation: Relation,
    /// How it is distributed.
    pub distribution: Distribution,
}

/// Two variables that vary together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correlation {
    /// Numbers of the variables, from 0.
    pub between: [usize; 2],
    /// Of their normal scores, above -1 and below 1.
    pub coefficient: f64,
}

/// Something that is broken. Hinges are indices, from 0.
#[derive(Clone, Debug)]
pub struct Fault {
    /// What it is called.
    pub name: String,
    /// Hinges that fail, and how.
    pub failures: Vec<(FailureMode, usize)>,
    /// Hinges that are released late.
    pub late_release: Vec<LateRelease>,
    /// Other numbers of the scene.
    pub changes: Vec<Change>,
}

impl Fault {
    /// Hinges that fail in this mode.
    pub fn hinges(&self, mode: FailureMode) -> impl Iterator<Item = usize> {
        self.failures.iter().filter(move |(of, _)| *of == mode).map(|(_, hinge)| *hinge)
    }
}

/// How a hinge fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FailureMode {
    /// It stays as it starts.
    Stuck,
    /// It is never released.
    MissedRelease,
    /// It does not latch.
    FailedLatch,
    /// It has no spring and no kick-off spring.
    BrokenSpring,
}

impl FailureMode {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Stuck, Self::MissedRelease, Self::FailedLatch, Self::BrokenSpring];

    /// Its name in studies.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stuck => "stuck",
            Self::MissedRelease => "missed_release",
            Self::FailedLatch => "failed_latch",
            Self::BrokenSpring => "broken_spring",
        }
    }

    /// Which hinges fail so, in one line.
    pub(crate) const fn about(self) -> &'static str {
        match self {
            Self::Stuck => "hinges that stay as they start",
            Self::MissedRelease => "hinges that are never released",
            Self::FailedLatch => "hinges that do not latch",
            Self::BrokenSpring => "hinges without spring and kick-off spring",
        }
    }
}

/// A release that comes late.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LateRelease {
    /// The hinge.
    pub hinge: usize,
    /// By how much \[T\].
    pub by: f64,
}

/// Another number at a place in the scene.
#[derive(Clone, Debug)]
pub struct Change {
    /// The place.
    pub slot: Slot,
    /// How the number changes what is there.
    pub relation: Relation,
    /// The number.
    pub number: f64,
}

/// How each case is run: options of `nboom run`; `None` is its default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunSettings {
    /// Relative error allowed in a step.
    pub rtol: Option<f64>,
    /// Absolute error allowed in a step, as a share of natural sizes.
    pub atol: Option<f64>,
    /// Method of integration.
    pub integrator: Option<nboom_sim::Method>,
    /// Equations of motion.
    pub formulation: Option<Form>,
    /// Which code computes accelerations.
    pub path: Option<Path>,
    /// The longest step.
    pub max_step: Option<f64>,
    /// Steps after which a run is given up.
    pub max_steps: Option<usize>,
    /// Events after which a run is given up.
    pub max_events: Option<usize>,
    /// Output times after the initial one.
    pub samples: Option<usize>,
    /// End of the run instead of the scene's.
    pub end_time: Option<f64>,
    /// Whether stresses are computed if the scene asks for them.
    pub stresses: bool,
    /// Whether loads of hinges are computed for any scene.
    pub hinge_loads: bool,
    /// How stresses are judged.
    pub strength: nboom_strength::Settings,
    /// Whether runs take their explicit steps side by side.
    pub lanes: bool,
}

impl RunSettings {
    /// The scene of a file with the end that its run has.
    ///
    /// # Errors
    /// When that is before the start.
    pub fn scene(&self, file: &SceneFile) -> Result<Scene, Errors<ModelError>> {
        match self.end_time {
            Some(end_time) => file.scene.ending_at(end_time),
            None => Ok(file.scene.clone()),
        }
    }

    /// The loads that are wanted of a run of `scene`, which is that of a file.
    pub fn wanted_loads<'a>(&self, file: &'a SceneFile, scene: &'a Scene) -> WantedLoads<'a> {
        WantedLoads {
            scene,
            structure: file.structure.as_ref(),
            stresses: self.stresses,
            hinge_loads: self.hinge_loads || file.settings.hinge_loads,
            settings: self.strength,
        }
    }

    /// The options of a run, without generated code.
    pub fn options(&self) -> Options {
        let defaults = Options::default();
        Options {
            rtol: self.rtol.unwrap_or(defaults.rtol),
            atol: self.atol.unwrap_or(defaults.atol),
            integrator: self.integrator.unwrap_or(defaults.integrator),
            formulation: self.formulation,
            path: self.path.unwrap_or_default(),
            max_step: self.max_step.unwrap_or(defaults.max_step),
            max_steps: self.max_steps.unwrap_or(defaults.max_steps),
            max_events: self.max_events.unwrap_or(defaults.max_events),
            samples: self.samples.unwrap_or(defaults.samples),
            lanes: self.lanes,
            ..defaults
        }
    }
}
