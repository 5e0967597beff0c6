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
    /// Whether there is a routine for the matrix and right side too: those of the formulation, or of
    /// `symmetric` if it forms none.
    pub equations: bool,
    /// Whether there is a routine for the scene's inverse dynamics too.
    pub inverse_dynamics: bool,
    /// Whether there is a routine for the right side of the scene's differential equations too.
    pub right_side: bool,
    /// Whether routines take a wrench on the main body also where nothing acts on it from outside.
    pub external_wrench: bool,
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
            right_side: false,
            external_wrench: false,
            lock_states: false,
            stresses: None,
        }
    }
}

/// What is asked of the generator.
pub(crate) struct Requests {
    /// The accelerations of the scene, all hinges free.
    pub whole: Request,
    /// The scene with its main body free, which equations and inverse dynamics are for.
    pub free: Scene,
    /// The equations of the scene.
    pub equations: Option<Request>,
    /// The forces for given accelerations of the scene.
    pub inverse_dynamics: Option<Request>,
    /// The right side of the scene's differential equations.
    pub right_side: Option<Request>,
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
        let inside = |request: Request| {
            let request = Request { scalar_path: SCALAR.to_owned(), ..request };
            if choices.external_wrench { request.with_external_wrench() } else { request }
        };
        let of = |scene: &Scene| {
            Ok::<_, CodegenError>(inside(Request::of_scene(scene, numbers, level)?))
        };
        let whole = of(scene)?.by(formulation);
        let takes_free = choices.equations || choices.inverse_dynamics;
        if takes_free && scene.main_body.mass == 0.0 {
            return Err(CodegenError::NoMass { scene: scene.name.clone() });
        }
        let free = scene.clone().with_free_main_body();
        let equations = choices.equations.then(|| {
            let request = of(&free)?.for_equations();
            let matrix =
                if formulation.has_equations() { formulation } else { Formulation::Symmetric };
            Ok::<_, CodegenError>(named(request, "Equations").by(matrix))
        });
        let inverse_dynamics = choices.inverse_dynamics.then(|| {
            let request = of(&free)?.for_inverse_dynamics();
            Ok::<_, CodegenError>(named(request, "Inverse"))
        });
        let right_side = choices.right_side.then(|| {
            let request = Request { on_eight_states: false, ..whole.right_side_of(scene)? };
            let name = format!("{}RightSide", whole.name);
            Ok::<_, CodegenError>(Request { name, ..request })
        });
        let right_side = right_side.transpose()?;
        let held = if lock_states { Request::lock_states(scene, level)? } else { Vec::new() };
        let held = held.into_iter().map(|request| inside(request).by(formulation)).collect();
        let stresses = stresses.map(|structure| StressRequest::of_scene(scene, structure, level));
        let stresses = stresses
            .transpose()?
            .map(|request| StressRequest { scalar_path: SCALAR.to_owned(), ..request });
        let (equations, inverse_dynamics) = (equations.transpose()?, inverse_dynamics.transpose()?);
        Ok(Self { whole, free, equations, inverse_dynamics, right_side, held, stresses })
    }

    /// The file with all of them.
    pub fn module(&self) -> Module {
        Module { routines: self.all(), stresses: self.stresses.iter().cloned().collect() }
    }

    /// Those for the scene with its main body free.
    pub fn of_free(&self) -> impl Iterator<Item = &Request> {
        self.equations.iter().chain(&self.inverse_dynamics)
    }

    /// All but stresses, in the order in which they are written.
    pub fn all(&self) -> Vec<Request> {
        let all_free = std::iter::once(&self.whole).chain(self.of_free()).chain(&self.right_side);
        all_free.chain(&self.held).cloned().collect()
    }
}

/// The request with a word after its name.
fn named(request: Request, word: &str) -> Request {
    Request { name: format!("{}{word}", request.name), ..request }
}
