//! The routines of a scene as a library that a running program loads.

use std::fs;
use std::path::PathBuf;

use nboom_model::{Scene, Structure};

use crate::files::put;
use crate::package::Package;
use crate::{Build, PackageError, Progress, manifest, sources};

const CODE: &str = include_str!("../templates/shared.rs");

/// What became of a library.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Library {
    /// The library, which [`load`](fn@crate::load) takes.
    pub path: PathBuf,
    /// The scene's topology.
    pub topology: String,
    /// How many routines it has.
    pub routines: usize,
    /// Where it was built.
    pub folder: PathBuf,
    /// Whether it was there already.
    pub up_to_date: bool,
}

/// Builds a library with the routines of
/// [`Module::of_simulator`](nboom_codegen::Module::of_simulator) for one scene, for programs that
/// [`load`](fn@crate::load) it; `tell` hears how far it has come.
///
/// It stays in the folder to build in, under a name with a number for all that it is made of.
///
/// # Errors
/// [`PackageError`] when there is no code for the scene, when a file cannot be written, and when
/// cargo is not there or fails.
pub fn library(
    scene: &Scene,
    structure: Option<&Structure>,
    build: &Build,
    mut tell: impl FnMut(Progress),
) -> Result<Library, PackageError> {
    let package = Package::of("nboom-library", scene, structure, build)?;
    package.write(sources::of_routines(), manifest::of_shared, &mut tell)?;
    put(&package.folder.join("src/lib.rs"), CODE)?;
    let made = package.build(|artifact| artifact.library, tell)?;
    // Cargo writes over its own, which would pull it away under a program that has loaded it.
    let path = package.work.join(made.file_name().unwrap_or_default());
    let bytes = fs::read(&made).map_err(PackageError::reading(&made))?;
    let up_to_date = put(&path, bytes)?;
    let Package { topology, routines, folder, .. } = package;
    Ok(Library { path, topology, routines, folder, up_to_date })
}
