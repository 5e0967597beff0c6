//! A stand-alone simulator around the routines of a scene.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use nboom_codegen::{Level, Numbers, Request, Standing, file, hash, key, standing};
use nboom_formulation::Formulation;
use nboom_model::Scene;

use crate::listing::{put, read};
use crate::{PackageError, manifest, sources};

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

/// Builds a program that takes scenes and the options of `nboom run`, with routines for one
/// scene: with its numbers, with others, and for the topologies that it comes through while
/// hinges are held.
///
/// What it is made of stays in a folder, so that the next build is quicker.
///
/// # Errors
/// [`PackageError`] when there is no code for the scene, when a file cannot be written and when
/// cargo is not there or fails.
pub fn compile(scene: &Scene, build: &Build, program: &Path) -> Result<Built, PackageError> {
    let requests = requests(scene, build)?;
    let work = work(build)?;
    let version = sources::VERSION;
    let number = hash(format!("{version} {:016x}", key(&requests)).as_bytes());
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
    if !there.is_some_and(|text| standing(&text, &requests) == Standing::Current) {
        put(&routines, &file(&requests)?)?;
    }
    put(&folder.join("src/main.rs"), &main_text(&requests))?;
    let made = cargo(&folder, &work.join("target"), build.offline)?;
    let up_to_date = copy(&made, program)?;
    let topology = requests[0].topology.to_string();
    Ok(Built { up_to_date, topology, routines: requests.len(), folder })
}

fn requests(scene: &Scene, build: &Build) -> Result<Vec<Request>, PackageError> {
    let mut all = vec![
        Request::of_scene(scene, Numbers::Baked, build.level)?,
        Request::of_scene(scene, Numbers::RunTime, build.level)?,
    ];
    all.extend(Request::lock_states(scene, build.level)?);
    Ok(all.into_iter().map(|request| request.by(build.formulation)).collect())
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

fn main_text(requests: &[Request]) -> String {
    let row =
        |request: &Request| format!("            Kernel::of::<routines::{}>(),\n", request.name);
    MAIN.replace("/*KERNELS*/", &requests.iter().map(row).collect::<String>())
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

/// Puts a program where it is wanted, and tells whether it was there already.
fn copy(made: &Path, program: &Path) -> Result<bool, PackageError> {
    let bytes = fs::read(made).map_err(PackageError::reading(made))?;
    if read(program)?.is_some_and(|there| there == bytes) {
        return Ok(true);
    }
    let failed = || PackageError::writing(program);
    if let Some(folder) = program.parent() {
        fs::create_dir_all(folder).map_err(failed())?;
    }
    // A program that runs cannot be written to, but its name can be given to another one.
    let mut beside = program.as_os_str().to_owned();
    beside.push(".new");
    fs::copy(made, &beside).map_err(failed())?;
    fs::rename(&beside, program).map_err(failed())?;
    Ok(false)
}
