//! Cargo, which builds what is written.

use std::env;
use std::env::consts::DLL_EXTENSION;
use std::ffi::OsStr;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;

use serde_json::Value;

use crate::{PackageError, Progress};

/// Lines of cargo's that are shown when it fails.
const LAST_LINES: usize = 20;

/// Builds the package in a folder and returns what is `wanted` of the last crate that has it.
pub(crate) fn cargo(
    folder: &Path,
    target: &Path,
    offline: bool,
    wanted: impl Fn(Artifact) -> Option<PathBuf>,
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
            tell(Progress::Crate { count: done + 1, name: artifact.name.clone() });
            made = wanted(artifact).or(made.take());
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
pub(crate) struct Artifact {
    name: String,
    /// The program, if it is one.
    pub(crate) executable: Option<PathBuf>,
    /// The library that programs of other languages load, if it is one.
    pub(crate) library: Option<PathBuf>,
}

impl Artifact {
    fn read(message: &str) -> Option<Self> {
        let message: Value = serde_json::from_str(message).ok()?;
        let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
        let is_library = list(&message["target"]["kind"]).iter().any(|kind| kind == "cdylib");
        // Beside a library may stand what debuggers and linkers take.
        let files = list(&message["filenames"]);
        let mut files = files.iter().filter_map(Value::as_str).map(PathBuf::from);
        let library = files.find(|path| path.extension() == Some(OsStr::new(DLL_EXTENSION)));
        let library = library.filter(|_| is_library);
        let executable = message["executable"].as_str().map(PathBuf::from);
        let name = message["target"]["name"].as_str()?.to_owned();
        (message["reason"] == "compiler-artifact").then_some(Self { name, executable, library })
    }
}
