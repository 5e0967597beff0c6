//! A stand-alone simulator around the routines of a scene.

use std::path::{Path, PathBuf};

use nboom_codegen::Level;
use nboom_formulation::Formulation;
use nboom_model::{Scene, Structure};

use crate::files::put;
use crate::package::Package;
use crate::{PackageError, manifest, program, sources};

const MAIN: &str = include_str!("../templates/main.rs");

/// How to build a simulator or a library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Build {
    /// The equations of motion that routines are generated for.
    pub formulation: Formulation,
    /// How freely arithmetic may be rearranged.
    pub level: Level,
    /// The folder to build in; without it `nboom` in the user's cache.
    pub work: Option<PathBuf>,
    /// Whether cargo may use what it has at hand only.
    pub offline: bool,
}

impl Default for Build {
    fn default() -> Self {
        let (formulation, level) = (Formulation::Articulated, Level::Fast);
        Self { formulation, level, work: None, offline: false }
    }
}

/// How far a build has come.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Routines are being written.
    Writing {
        /// How many.
        routines: usize,
    },
    /// Cargo has been started.
    Building,
    /// Cargo has come through one more crate, compiled now or before.
    Crate {
        /// How many it has come through.
        count: usize,
        /// The name of this one.
        name: String,
    },
}

/// What became of a simulator.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Built {
    /// Whether the program was there already.
    pub up_to_date: bool,
    /// The scene's topology.
    pub topology: String,
    /// How many routines it has.
    pub routines: usize,
    /// Where it was built.
    pub folder: PathBuf,
}

/// Builds a program that takes scenes and the options of `nboom run`, with the routines of
/// [`Module::of_simulator`](nboom_codegen::Module::of_simulator) for one scene; `tell` hears how far it has come.
///
/// What it is made of stays in a folder, so that the next build is quicker.
///
/// # Errors
/// [`PackageError`] when there is no code for the scene, when a file cannot be written or would
/// overwrite what is no simulator, and when cargo is not there or fails.
pub fn compile(
    scene: &Scene,
    structure: Option<&Structure>,
    build: &Build,
    program: &Path,
    mut tell: impl FnMut(Progress),
) -> Result<Built, PackageError> {
    program::require_free(program)?;
    let package = Package::of("nboom-simulator", scene, structure, build)?;
    package.write(sources::of_command(), manifest::of_simulator, &mut tell)?;
    put(
        &package.folder.join("src/main.rs"),
        MAIN.replace("/*MADE*/", &program::made(package.number)),
    )?;
    let made = package.build(|artifact| artifact.executable, tell)?;
    let up_to_date = program::copy(&made, program)?;
    let Package { topology, routines, folder, .. } = package;
    Ok(Built { up_to_date, topology, routines, folder })
}
