//! A stand-alone simulator around the routines of a scene.

use std::env;
use std::path::{Path, PathBuf};
use std::process::Command;

use nboom_codegen::{Level, Module, Standing, hash};
use nboom_formulation::Formulation;
use nboom_model::{Scene, Structure};

use crate::files::{put, read};
use crate::{PackageError, manifest, program, sources};

const MAIN: &str = include_str!("../templates/main.rs");

/// Lines of cargo's that are shown when it fails.
const LAST_LINES: usize = 20;

/// How to build a simulator.
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
/// [`Module::of_simulator`] for one scene.
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
) -> Result<Built, PackageError> {
    program::require_free(program)?;
    let module = Module::of_simulator(scene, structure, build.formulation, build.level)?;
    let work = work(build)?;
    let version = sources::VERSION;
    let number = hash(format!("{version} {:016x}", module.key()).as_bytes());
    let name = format!("nboom-simulator-{number:016x}");
    let crates = format!("sources-{version}");
    for (path, text) in sources::of_command() {
        put(&work.join(&crates).join(path), text)?;
    }
    let folder = work.join(&name);
    put(&folder.join("Cargo.toml"), &manifest::of_simulator(&name, &format!("../{crates}")))?;
    if !folder.join("Cargo.lock").exists() {
        // Cargo leaves out what is not needed.
        put(&folder.join("Cargo.lock"), sources::lock())?;
    }
    let routines = folder.join("src/routines.rs");
    let there = read(&routines)?.and_then(|bytes| String::from_utf8(bytes).ok());
    if !there.is_some_and(|text| module.standing(&text) == Standing::Current) {
        put(&routines, &module.text()?)?;
    }
    put(&folder.join("src/main.rs"), &MAIN.replace("/*MADE*/", &program::made(number)))?;
    let made = cargo(&folder, &work.join("target"), build.offline)?;
    let up_to_date = program::copy(&made, program)?;
    let topology = module.routines[0].topology.to_string();
    let routines = module.routines.len() + module.stresses.len();
    Ok(Built { up_to_date, topology, routines, folder })
}

/// The folder to build in.
fn work(build: &Build) -> Result<PathBuf, PackageError> {
    let set = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let cache = || set("XDG_CACHE_HOME").or_else(|| Some(set("HOME")?.join(".cache")));
    let work = match &build.work {
        Some(work) => work.clone(),
        None => cache().ok_or(PackageError::NoFolder)?.join("nboom"),
    };
    // Cargo is started elsewhere.
    std::path::absolute(&work).map_err(PackageError::writing(&work))
}

/// Builds the package in a folder and returns its program.
fn cargo(folder: &Path, target: &Path, offline: bool) -> Result<PathBuf, PackageError> {
    let program = PathBuf::from(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    let mut command = Command::new(&program);
    command.current_dir(folder).args(["build", "--release", "--color", "never"]);
    command.arg("--message-format=json-render-diagnostics").arg("--target-dir").arg(target);
    if offline {
        command.arg("--offline");
    }
    let output = match command.output() {
        Ok(output) => output,
        Err(source) => return Err(PackageError::NoCargo { program, source }),
    };
    let messages = String::from_utf8_lossy(&output.stdout);
    let made = messages.lines().filter_map(executable).next_back();
    made.filter(|_| output.status.success()).ok_or_else(|| {
        let said = String::from_utf8_lossy(&output.stderr);
        let lines: Vec<&str> = said.lines().collect();
        let last_lines = lines[lines.len().saturating_sub(LAST_LINES)..].join("\n");
        PackageError::Cargo { directory: folder.to_owned(), last_lines }
    })
}

/// The program that a message of cargo's tells of.
fn executable(message: &str) -> Option<PathBuf> {
    let message: serde_json::Value = serde_json::from_str(message).ok()?;
    message["executable"].as_str().map(PathBuf::from)
}
