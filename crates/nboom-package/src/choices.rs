use nboom_codegen::{CodegenError, Level, Numbers, Request};
use nboom_formulation::Formulation;
use nboom_model::Scene;

/// Which routines a crate has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choices {
    /// The equations of motion.
    pub formulation: Formulation,
    /// Where the routine has the satellite's numbers from.
    pub numbers: Numbers,
    /// How freely arithmetic may be rearranged.
    pub level: Level,
    /// Whether there is a routine for the formulation's matrix and right side too.
    pub equations: bool,
    /// Whether there are routines for the topologies that the scene comes through while hinges
    /// are held.
    pub lock_states: bool,
}

impl Default for Choices {
    fn default() -> Self {
        Self {
            formulation: Formulation::Articulated,
            numbers: Numbers::RunTime,
            level: Level::Fast,
            equations: false,
            lock_states: false,
        }
    }
}

/// What is asked of the generator.
pub(crate) struct Requests {
    /// The accelerations of the scene, all hinges free.
    pub whole: Request,
    /// The equations of the scene.
    pub equations: Option<Request>,
    /// Accelerations while hinges are held.
    pub held: Vec<Request>,
}

impl Requests {
    pub fn new(scene: &Scene, choices: &Choices) -> Result<Self, CodegenError> {
        let Choices { formulation, numbers, level, equations, lock_states } = *choices;
        let inside = |request: Request| Request {
            scalar_path: "crate::nboom_scalar".to_owned(),
            ..request.by(formulation)
        };
        let whole = inside(Request::of_scene(scene, numbers, level)?);
        let equations = equations.then(|| {
            let name = format!("{}Equations", whole.name);
            Request { name, ..whole.clone().for_equations() }
        });
        let held = if lock_states { Request::lock_states(scene, level)? } else { Vec::new() };
        let held = held.into_iter().map(inside).collect();
        Ok(Self { whole, equations, held })
    }

    /// All, in the order in which they are written.
    pub fn all(&self) -> Vec<Request> {
        let first = std::iter::once(&self.whole).chain(&self.equations);
        first.chain(&self.held).cloned().collect()
    }
}
