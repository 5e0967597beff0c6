//! Packages around the routines of a scene that are written into a folder and built there.

use std::env;
use std::path::PathBuf;

use nboom_codegen::{Module, Standing, hash};
use nboom_model::{Scene, Structure};

use crate::cargo::{Artifact, cargo};
use crate::files::{put, read};
use crate::sources::Source;
use crate::{Build, PackageError, Progress, sources};

/// A package with the routines of [`Module::of_simulator`].
pub(crate) struct Package {
    /// The number of the request and of all that is written for it.
    pub(crate) number: u64,
    /// The scene's topology.
    pub(crate) topology: String,
    /// How many routines it has.
    pub(crate) routines: usize,
    /// The folder that all packages are built in.
    pub(crate) work: PathBuf,
    /// Where it stands.
    pub(crate) folder: PathBuf,
    name: String,
    module: Module,
    offline: bool,
}

impl Package {
    /// Decides on a package; its name is `kind` and the number.
    pub(crate) fn of(
        kind: &str,
        scene: &Scene,
        structure: Option<&Structure>,
        build: &Build,
    ) -> Result<Self, PackageError> {
        let module = Module::of_simulator(scene, structure, build.formulation, build.level)?;
        let work = work(build)?;
        let number = hash(format!("{} {:016x}", sources::VERSION, module.key()).as_bytes());
        let name = format!("{kind}-{number:016x}");
        Ok(Self {
            number,
            topology: module.routines[0].topology.to_string(),
            routines: module.routines.len() + module.stresses.len(),
            folder: work.join(&name),
            work,
            name,
            module,
            offline: build.offline,
        })
    }

    /// Writes it, but for the file that its compilation begins with, and the crates that it is made of;
    /// `manifest` is told its name and where those are.
    pub(crate) fn write(
        &self,
        crates: impl Iterator<Item = &'static Source>,
        manifest: fn(&str, &str) -> String,
        tell: &mut impl FnMut(Progress),
    ) -> Result<(), PackageError> {
        let beside = format!("sources-{}", sources::VERSION);
        for (path, text) in crates {
            put(&self.work.join(&beside).join(path), text)?;
        }
        put(&self.folder.join("Cargo.toml"), manifest(&self.name, &format!("../{beside}")))?;
        if !self.folder.join("Cargo.lock").exists() {
            // Cargo leaves out what is not needed.
            put(&self.folder.join("Cargo.lock"), sources::lock())?;
        }
        let routines = self.folder.join("src/routines.rs");
        let there = read(&routines)?.and_then(|bytes| String::from_utf8(bytes).ok());
        if !there.is_some_and(|text| self.module.standing(&text) == Standing::Current) {
            tell(Progress::Writing { routines: self.routines });
            put(&routines, self.module.text()?)?;
        }
        Ok(())
    }

    /// Builds it, and returns what is `wanted` of it.
    pub(crate) fn build(
        &self,
        wanted: impl Fn(Artifact) -> Option<PathBuf>,
        tell: impl FnMut(Progress),
    ) -> Result<PathBuf, PackageError> {
        cargo(&self.folder, &self.work.join("target"), self.offline, wanted, tell)
    }
}

/// The folder to build in.
fn work(build: &Build) -> Result<PathBuf, PackageError> {
    let set = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let cache = || {
        set("XDG_CACHE_HOME")
            .filter(|path| path.is_absolute())
            .or_else(|| Some(set("HOME")?.join(".cache")))
    };
    let work = match &build.work {
        Some(work) => work.clone(),
        None => cache().ok_or(PackageError::NoFolder)?.join("nboom"),
    };
    // Cargo is started elsewhere.
    std::path::absolute(&work).map_err(PackageError::writing(&work))
}
