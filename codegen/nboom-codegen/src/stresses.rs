//! Loads and stresses of a scene as one straight line.

use nboom_expr::Graph;
use nboom_loads::{LoadEquations, RESULT, SceneMotion};
use nboom_model::{Scene, Structure};
use nboom_sections::{AtStation, Section};

use crate::item::Signature;
use crate::routine::straight;
use crate::scene::{name, welded};
use crate::{CodegenError, Generated, Level, OPERATION_LIMIT, check_name, formatted, in_module};

/// Code for the loads of every hinge and station of a scene and for what describes the stresses
/// there, from a motion and its accelerations; all numbers of the scene are built in.
#[derive(Clone, Debug)]
pub struct StressRequest {
    /// Name of the type that implements the routine, a Rust identifier.
    pub name: String,
    /// Path of the crate `nboom_scalar` where the code will stand.
    pub scalar_path: String,
    /// What is traced.
    pub equations: LoadEquations,
    /// How freely arithmetic may be rearranged.
    pub level: Level,
}

impl StressRequest {
    /// Code for a scene whose stations are in `structure`. The type is named after the topology:
    /// `StressesS2P`.
    ///
    /// # Errors
    /// When a section is not one, and when the scene is not made of chains and paddles.
    pub fn of_scene(
        scene: &Scene,
        structure: &Structure,
        level: Level,
    ) -> Result<Self, CodegenError> {
        let sections =
            Section::all(structure).map_err(|AtStation { segment, station, here }| {
                let segment = scene.label(segment).to_string();
                CodegenError::Section { segment, station: station + 1, source: here }
            })?;
        let influences = sections.iter().map(|at| at.here.influence());
        let topology = welded(scene, &vec![true; scene.bodies.len()], 0.0)?.topology;
        Ok(Self {
            name: name("Stresses", &topology),
            scalar_path: "::nboom_scalar".to_owned(),
            equations: LoadEquations::new(scene, Some(structure)).with_sections(influences),
            level,
        })
    }

    /// Traces the equations: numbers of the scene first, then the motion.
    pub fn trace(&self) -> Graph {
        let Self { equations, .. } = self;
        let mut pinned = self.pinned();
        let numbers = pinned.len();
        pinned.resize(numbers + SceneMotion::<f64>::count(equations.hinges()), None);
        Graph::trace_with(&pinned, |inputs| {
            let (of_scene, of_motion) = inputs.split_at(numbers);
            let mut equations = equations.with_numbers(of_scene);
            let mut found = equations.load_set();
            let motion = SceneMotion::of_numbers(of_motion, equations.hinges());
            equations.evaluate(&motion, &mut found);
            found.numbers()
        })
    }

    /// A module with the routine, and its type.
    ///
    /// # Errors
    /// When the name or the path is not one, when a number of the scene is infinite, and when the
    /// line would be too long for a compiler.
    pub fn generate(&self) -> Result<Generated, CodegenError> {
        let Self { name, scalar_path, equations, level } = self;
        check_name(name)?;
        let signature = Signature {
            name: name.clone(),
            result: RESULT,
            topology: match equations.hinges() {
                1 => "1 hinge".to_owned(),
                hinges => format!("{hinges} hinges"),
            },
            formulation: "",
            external: true,
            pinned: self.pinned(),
            coordinates: SceneMotion::<f64>::count(equations.hinges()),
            outputs: equations.load_set().count(),
        };
        if let Some(value) = signature.pinned.iter().flatten().find(|value| !value.is_finite()) {
            return Err(CodegenError::Number { name: name.clone(), value: *value });
        }
        self.check_length()?;
        let generated = straight(self.trace(), *level, &signature);
        let heading = [
            format!(" Loads and stresses of {}, level {}.", signature.topology, level.name()),
            format!(" Taken for granted: all {} numbers of the scene.", signature.pinned.len()),
        ];
        Ok(Generated { tokens: in_module(name, scalar_path, &heading, &generated)?, ..generated })
    }

    /// The code as formatted source with a header.
    ///
    /// # Errors
    /// As [`generate`](Self::generate).
    pub fn source(&self) -> Result<String, CodegenError> {
        Ok(formatted(self.generate()?.tokens))
    }

    /// # Errors
    /// When the line would be too long for a compiler.
    pub(crate) fn check_length(&self) -> Result<(), CodegenError> {
        let graph = self.trace();
        let (operations, limit) = (graph.operations_of(|_| true).flops(), OPERATION_LIMIT);
        if operations > limit {
            return Err(CodegenError::Length { name: self.name.clone(), operations, limit });
        }
        Ok(())
    }

    fn pinned(&self) -> Vec<Option<f64>> {
        self.equations.numbers().into_iter().map(Some).collect()
    }
}
