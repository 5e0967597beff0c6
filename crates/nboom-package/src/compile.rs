//! A stand-alone simulator around the routines of a scene.

use std::env;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

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
/// [`Module::of_simulator`] for one scene; `tell` hears how far it has come.
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
    let module = Module::of_simulator(scene, structure, build.formulation, build.level)?;
    let routine_count = module.routines.len() + module.stresses.len();
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
        tell(Progress::Writing { routines: routine_count });
        put(&routines, &module.text()?)?;
    }
    put(&folder.join("src/main.rs"), &MAIN.replace("/*MADE*/", &program::made(number)))?;
    let made = cargo(&folder, &work.join("target"), build.offline, tell)?;
    let up_to_date = program::copy(&made, program)?;
    let topology = module.routines[0].topology.to_string();
    Ok(Built { up_to_date, topology, routines: routine_count, folder })
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
fn cargo(
    folder: &Path,
    target: &Path,
    offline: bool,
    mut tell: impl FnMut(Progress),
) -> Result<PathBuf, PackageError> {
    let program = PathBuf::from(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    let mut command = Command::new(&program);
    command.current_dir(folder).args(["build", "--release", "--color", "never"]);
    command.arg("--message-format=json-render-diagnostics").arg("--target-dir").arg(target);
    if offline {
        command.arg("--offline");
    }
    tell(Progress::Building);
    let not_there = |source| PackageError::NoCargo { program: program.clone(), source };
    let mut child =
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().map_err(not_there)?;
    let (out, mut error) = (child.stdout.take(), child.stderr.take());
    let mut made = None;
    let said = thread::scope(|scope| {
        // A pipe that nobody reads would stop cargo when it is full.
        let said = scope.spawn(move || {
            let mut bytes = Vec::new();
            // What cannot be read says less about why cargo has failed, and nothing else.
            let _ = error.as_mut().map(|pipe| pipe.read_to_end(&mut bytes));
            String::from_utf8_lossy(&bytes).into_owned()
        });
        let lines = out.into_iter().flat_map(|pipe| BufReader::new(pipe).lines());
        let artifacts = lines.map_while(Result::ok).filter_map(|line| Artifact::read(&line));
        for (done, artifact) in artifacts.enumerate() {
            tell(Progress::Crate { count: done + 1, name: artifact.name });
            made = artifact.executable.or(made.take());
        }
        said.join().unwrap_or_default()
    });
    let ended = child.wait().map_err(not_there)?;
    made.filter(|_| ended.success()).ok_or_else(|| {
        let lines: Vec<&str> = said.lines().collect();
        let last_lines = lines[lines.len().saturating_sub(LAST_LINES)..].join("\n");
        PackageError::Cargo { directory: folder.to_owned(), last_lines }
    })
}

/// What a message of cargo's tells that has come through a crate.
struct Artifact {
    name: String,
    /// The program, if it is one.
    executable: Option<PathBuf>,
}

impl Artifact {
    fn read(message: &str) -> Option<Self> {
        let message: serde_json::Value = serde_json::from_str(message).ok()?;
        let executable = message["executable"].as_str().map(PathBuf::from);
        let name = message["target"]["name"].as_str()?.to_owned();
        (message["reason"] == "compiler-artifact").then_some(Self { name, executable })
    }
}
