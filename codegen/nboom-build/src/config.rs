use std::path::{Component, Path, PathBuf};
use std::{env, fs, io};

use nboom_codegen::{
    CodegenError, Level, Module, Numbers, Output, Request, Standing, StressRequest,
};
use nboom_formulation::{Formulation, Symmetry};
use nboom_io::{SceneFile, read_scene};

use crate::BuildError;

/// What a file of generated routines holds.
///
/// `topology`, `scene` and `baked_scene` add routines; everything else applies to all routines of
/// the file. Paths are relative to the folder of `Cargo.toml`, where cargo runs build scripts.
#[derive(Clone, Debug)]
pub struct Config {
    sources: Vec<Source>,
    lock_states: bool,
    stresses: bool,
    external_wrench: bool,
    held_main_body: bool,
    symmetry: Symmetry,
    equations: bool,
    inverse_dynamics: bool,
    right_sides: bool,
    formulation: Formulation,
    level: Level,
    scalar_path: String,
}

#[derive(Clone, Debug)]
enum Source {
    Topology { name: String, topology: String },
    Scene { path: PathBuf, numbers: Numbers },
}

/// The variable of the environment that lets [`Config::check`] write.
const BLESS: &str = "NBOOM_BLESS";

/// The build in which [`Config::check`] writes.
const BLESSED_BUILD: &str = "NBOOM_BLESS=1 cargo build";

impl Default for Config {
    fn default() -> Self {
        Self {
            sources: Vec::new(),
            lock_states: false,
            stresses: false,
            external_wrench: false,
            held_main_body: false,
            symmetry: Symmetry::General,
            equations: false,
            inverse_dynamics: false,
            right_sides: false,
            formulation: Formulation::Articulated,
            level: Level::Fast,
            scalar_path: "::nboom_scalar".to_owned(),
        }
    }
}

impl Config {
    /// No routines yet: accelerations by `articulated`, level `fast`, for programs that use the
    /// crate `nboom_scalar`.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a routine for a topology, for example `4xS5_P`, all numbers at run time. `name` is the
    /// name of its type.
    pub fn topology(mut self, name: &str, topology: &str) -> Self {
        let (name, topology) = (name.to_owned(), topology.to_owned());
        self.sources.push(Source::Topology { name, topology });
        self
    }

    /// Adds a routine for the topology of a scene, numbers at run time; what is zero in the scene
    /// is assumed. Its type is named after the topology: `SatelliteS2P`.
    pub fn scene(self, path: impl Into<PathBuf>) -> Self {
        self.of_scene(path.into(), Numbers::RunTime)
    }

    /// Adds a routine with all numbers of a scene built in. Its type is named after the topology:
    /// `BakedS2P`.
    pub fn baked_scene(self, path: impl Into<PathBuf>) -> Self {
        self.of_scene(path.into(), Numbers::Baked)
    }

    fn of_scene(mut self, path: PathBuf, numbers: Numbers) -> Self {
        self.sources.push(Source::Scene { path, numbers });
        self
    }

    /// Adds routines for states of each scene with held hinges: one for each topology of a scene of
    /// up to 10 hinges; with more, those in which all appendages are held in step; at most 32, those
    /// of the most free hinges. Other states run embedded where a routine by `articulated` accepts
    /// them, for example one of [`topology`](Self::topology) with
    /// [`with_external_wrench`](Self::with_external_wrench) for the whole scene, and else by library
    /// code.
    pub fn with_lock_states(self) -> Self {
        Self { lock_states: true, ..self }
    }

    /// Adds a routine for the loads and stresses of each scene that describes its stations, with all
    /// its numbers built in. Its type is named after the topology: `StressesS2P`. A
    /// `nboom_strength::StressAnalysis` takes it from `kernels()`.
    pub fn with_stresses(self) -> Self {
        Self { stresses: true, ..self }
    }

    /// Routines of topologies take an external wrench on the main body. Those of scenes do where
    /// something acts on the scene from outside or holds its main body.
    pub fn with_external_wrench(self) -> Self {
        Self { external_wrench: true, ..self }
    }

    /// Routines of topologies are for a main body that is held, as on a test rig. The external wrench is that which
    /// holds it. Those of scenes are where the scene holds it.
    pub fn with_held_main_body(self) -> Self {
        Self { held_main_body: true, ..self }
    }

    /// Routines of topologies assume this of the satellite. Only `Kernel::accepts` refuses the numbers of others.
    pub fn with_symmetry(self, symmetry: Symmetry) -> Self {
        Self { symmetry, ..self }
    }

    /// Routines write the matrix and the right side that the formulation solves, instead of
    /// accelerations or inverse dynamics. The main body of a scene is free, also where the scene holds it.
    pub fn for_equations(self) -> Self {
        Self { equations: true, inverse_dynamics: false, ..self }
    }

    /// Routines are for inverse dynamics, instead of accelerations or equations: from accelerations to the wrench on the
    /// main body and the hinge torques. The main body of a scene is free, also where the scene holds it: the wrench
    /// is then what holds it.
    pub fn for_inverse_dynamics(self) -> Self {
        Self { inverse_dynamics: true, equations: false, ..self }
    }

    /// Beside each routine for accelerations there is one for the right side of a mode's differential
    /// equations, `RightSideSatelliteS2P`, and where kick-off springs push links one that takes them,
    /// `PushedSatelliteS2P`, if that is not too long.
    pub fn with_right_sides(self) -> Self {
        Self { right_sides: true, ..self }
    }

    /// The closed form that routines compute.
    pub fn formulation(self, formulation: Formulation) -> Self {
        Self { formulation, ..self }
    }

    /// How freely arithmetic may be rearranged.
    pub fn level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// Where the program has the crate `nboom_scalar`: `::nboom::scalar` if it uses the facade.
    pub fn scalar_path(self, path: &str) -> Self {
        Self { scalar_path: path.to_owned(), ..self }
    }

    /// Writes the file into the build script's output directory, unless it is there. It may stand in a folder
    /// there, `generated/wing.rs`.
    ///
    /// # Errors
    /// When the file would be outside that directory, a scene cannot be read, a routine cannot be generated, or the
    /// file cannot be written.
    pub fn write(&self, file: &str) -> Result<(), BuildError> {
        let inside = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
        let file_of = Path::new(file);
        if file_of.file_name().is_none() || !file_of.components().all(inside) {
            return Err(BuildError::NotInOutDir { file: file.to_owned() });
        }
        let folder = env::var_os("OUT_DIR").ok_or(BuildError::NoOutDir)?;
        // Whatever is in this folder was written by a build script.
        self.bring_up_to_date(&Path::new(&folder).join(file), |_| true, "cargo build")
    }

    /// Writes the file to `path`, unless it is there.
    ///
    /// # Errors
    /// As [`write`](Self::write); and when there is a file that was not generated, or that was
    /// changed since.
    pub fn write_to(&self, path: impl AsRef<Path>) -> Result<(), BuildError> {
        self.write_in(path.as_ref(), "cargo build")
    }

    fn write_in(&self, path: &Path, build: &'static str) -> Result<(), BuildError> {
        println!("cargo::rerun-if-changed={}", path.display());
        let may = |found: Option<Standing>| found.is_none_or(|found| found == Standing::Stale);
        self.bring_up_to_date(path, may, build)
    }

    /// Checks that the file at `path`, part of the program's source, is what would be generated.
    /// In a build with `NBOOM_BLESS=1` in the environment it is as [`write_to`](Self::write_to).
    ///
    /// # Errors
    /// As [`write_to`](Self::write_to); and when the file is missing or out of date.
    pub fn check(&self, path: impl AsRef<Path>) -> Result<(), BuildError> {
        let bless = env::var_os(BLESS).is_some_and(|bless| bless == "1");
        self.check_or_bless(path.as_ref(), bless)
    }

    fn check_or_bless(&self, path: &Path, bless: bool) -> Result<(), BuildError> {
        if bless {
            return self.write_in(path, BLESSED_BUILD);
        }
        println!("cargo::rerun-if-changed={}", path.display());
        self.bring_up_to_date(path, |_| false, BLESSED_BUILD)
    }

    /// Writes what is not current, if it `may` be overwritten; there `None` is no file at all. The error names
    /// the `build` that writes what may not be written now.
    fn bring_up_to_date(
        &self,
        path: &Path,
        may: impl Fn(Option<Standing>) -> bool,
        build: &'static str,
    ) -> Result<(), BuildError> {
        let module = self.module()?;
        let io = |source| BuildError::Io { path: path.to_owned(), source };
        let found = match fs::read(path) {
            // What is not text was not generated.
            Ok(bytes) => Some(module.standing(&String::from_utf8_lossy(&bytes))),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(io(error)),
        };
        if found == Some(Standing::Current) {
            return Ok(());
        }
        if !may(found) {
            return Err(BuildError::NotCurrent { path: path.to_owned(), standing: found, build });
        }
        let text = module.text()?;
        path.parent().map_or(Ok(()), fs::create_dir_all).map_err(io)?;
        fs::write(path, text).map_err(io)
    }

    /// One request for each routine; a routine that several scenes have in common comes once.
    fn module(&self) -> Result<Module, BuildError> {
        // Without any condition cargo runs the script for each change of the package. The script itself it always watches,
        // and it need not be called `build.rs`.
        println!("cargo::rerun-if-env-changed={BLESS}");
        let mut module = Module::default();
        for source in &self.sources {
            let Module { routines, stresses } = self.module_of(source)?;
            for request in routines.into_iter().map(|request| self.as_configured(request)) {
                match module.routines.iter().find(|other| other.name == request.name) {
                    Some(other) if *other == request => {}
                    Some(_) => return Err(BuildError::Twice { name: request.name }),
                    None => module.routines.push(request),
                }
            }
            for request in stresses {
                if module.stresses.iter().any(|other| other.name == request.name) {
                    return Err(BuildError::Twice { name: request.name });
                }
                module.stresses.push(request);
            }
        }
        Ok(module.at(&self.scalar_path))
    }

    fn module_of(&self, source: &Source) -> Result<Module, BuildError> {
        match source {
            Source::Topology { name, topology } => {
                let topology = topology
                    .parse()
                    .map_err(|source| BuildError::Topology { name: name.clone(), source })?;
                let mut request = Request::new(name, topology, self.level);
                request.external = self.external_wrench;
                request = request.with_symmetry(self.symmetry);
                if self.held_main_body {
                    request = request.with_held_main_body();
                }
                let right_side = self.right_sides.then(|| {
                    let name = format!("RightSide{name}");
                    Request { name, ..request.clone() }.for_right_side()
                });
                Ok([request].into_iter().chain(right_side).collect::<Vec<_>>().into())
            }
            Source::Scene { path, numbers } => {
                println!("cargo::rerun-if-changed={}", path.display());
                let SceneFile { scene, structure, included, .. } = read_scene(path)?;
                for path in &included {
                    println!("cargo::rerun-if-changed={}", path.display());
                }
                let takes_free = self.equations || self.inverse_dynamics;
                if takes_free && scene.main_body.mass == 0.0 {
                    return Err(CodegenError::NoMass { scene: scene.name.clone() }.into());
                }
                let scene = if takes_free { scene.with_free_main_body() } else { scene };
                let mut routines = vec![Request::of_scene(&scene, *numbers, self.level)?];
                if self.lock_states {
                    routines.extend(Request::lock_states(&scene, self.level)?);
                }
                let structure = structure.filter(|_| self.stresses);
                let stresses = structure.map(|s| StressRequest::of_scene(&scene, &s, self.level));
                let stresses = stresses.transpose()?.into_iter().collect();
                let by = |request: Request| request.by(self.formulation);
                let routines = routines.into_iter().map(by).collect();
                let module = Module { routines, stresses };
                Ok(if self.right_sides { module.with_right_sides(&scene) } else { module })
            }
        }
    }

    fn as_configured(&self, request: Request) -> Request {
        let request = request.by(self.formulation);
        match request.output {
            Output::Accelerations if self.equations => request.for_equations(),
            Output::Accelerations if self.inverse_dynamics => request.for_inverse_dynamics(),
            _ => request,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blessed_check_writes_what_is_missing_or_stale_only() {
        let folder = tempfile::tempdir().expect("a folder for the test");
        // The folder in between is made.
        let path = folder.path().join("generated").join("routines.rs");
        let (old, new) = (Config::new().topology("Old", "M"), Config::new().topology("New", "M"));
        for config in [&old, &new] {
            assert!(config.check_or_bless(&path, false).is_err());
            config.check_or_bless(&path, true).expect("it is missing or stale");
            config.check_or_bless(&path, false).expect("it has just been written");
        }
        fs::write(&path, "fn main() {}\n").expect("the folder is ours");
        assert!(new.check_or_bless(&path, true).is_err());
    }
}
