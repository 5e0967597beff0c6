use nboom_loads::LoadEquations;
use nboom_model::{Scene, Structure};
use nboom_sections::{AtStation, Section};

use crate::request::routine::check_name;
use crate::request::scene::{name, welded};
use crate::request::{CodegenError, Level};

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

    /// # Errors
    /// When the name is not one, and when a number of the scene is infinite.
    pub(crate) fn check(&self) -> Result<(), CodegenError> {
        check_name(&self.name)?;
        match self.equations.numbers().into_iter().find(|value| !value.is_finite()) {
            Some(value) => Err(CodegenError::Number { name: self.name.clone(), value }),
            None => Ok(()),
        }
    }

    /// All numbers of the scene.
    pub(crate) fn assumptions(&self) -> Vec<Option<f64>> {
        self.equations.numbers().into_iter().map(Some).collect()
    }
}
