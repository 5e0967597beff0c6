use nboom_codegen::{CodegenError, Level, Module, Numbers, Request, StressRequest};
use nboom_formulation::Formulation;
use nboom_model::{Scene, Structure};

/// Which routines a crate has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choices<'a> {
    /// The equations of motion.
    pub formulation: Formulation,
    /// Where the routine has the satellite's numbers from.
    pub numbers: Numbers,
    /// How freely arithmetic may be rearranged.
    pub level: Level,
    /// Whether there is a routine for the formulation's matrix and right side too.
    pub equations: bool,
    /// Whether there is a routine for the scene's inverse dynamics too.
    pub inverse_dynamics: bool,
    /// Whether there are routines for the topologies that the scene comes through while hinges
    /// are held.
    pub lock_states: bool,
    /// The scene's stations, if there is a routine for loads and stresses.
    pub stresses: Option<&'a Structure>,
}

impl Default for Choices<'_> {
    fn default() -> Self {
        Self {
            formulation: Formulation::Articulated,
            numbers: Numbers::RunTime,
            level: Level::Fast,
            equations: false,
            inverse_dynamics: false,
            lock_states: false,
            stresses: None,
        }
    }
}

/// What is asked of the generator.
pub(crate) struct Requests {
    /// The accelerations of the scene, all hinges free.
    pub whole: Request,
    /// The equations of the scene.
    pub equations: Option<Request>,
    /// The forces for given accelerations of the scene.
    pub inverse_dynamics: Option<Request>,
    /// Accelerations while hinges are held.
    pub held: Vec<Request>,
    /// Loads and stresses.
    pub stresses: Option<StressRequest>,
}

/// Where generated code finds the crate that it uses.
const SCALAR: &str = "crate::nboom_scalar";

impl Requests {
    pub fn new(scene: &Scene, choices: &Choices<'_>) -> Result<Self, CodegenError> {
        let Choices { formulation, numbers, level, lock_states, stresses, .. } = *choices;
        let inside = |request: Request| Request {
            scalar_path: SCALAR.to_owned(),
            ..request.by(formulation)
        };
        let whole = inside(Request::of_scene(scene, numbers, level)?);
        let equations = choices.equations.then(|| {
            let name = format!("{}Equations", whole.name);
            Request { name, ..whole.clone().for_equations() }
        });
        let inverse_dynamics = choices.inverse_dynamics.then(|| {
            let name = format!("{}Inverse", whole.name);
            let whole = whole.clone().by(Formulation::Articulated);
            Request { name, ..whole.for_inverse_dynamics() }
        });
        let held = if lock_states { Request::lock_states(scene, level)? } else { Vec::new() };
        let held = held.into_iter().map(inside).collect();
        let stresses = stresses.map(|structure| StressRequest::of_scene(scene, structure, level));
        let stresses = stresses
            .transpose()?
            .map(|request| StressRequest { scalar_path: SCALAR.to_owned(), ..request });
        Ok(Self { whole, equations, inverse_dynamics, held, stresses })
    }

    /// The file with all of them.
    pub fn module(&self) -> Module {
        Module { routines: self.all(), stresses: self.stresses.iter().cloned().collect() }
    }

    /// Those for the scene with all hinges free, accelerations first.
    pub fn all_free(&self) -> impl Iterator<Item = &Request> {
        std::iter::once(&self.whole).chain(&self.equations).chain(&self.inverse_dynamics)
    }

    /// All but stresses, in the order in which they are written.
    pub fn all(&self) -> Vec<Request> {
        self.all_free().chain(&self.held).cloned().collect()
    }
}
