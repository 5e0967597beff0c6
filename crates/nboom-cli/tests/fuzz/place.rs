//! A folder for one input, and the program run in it within limits.

use std::ffi::OsString;
use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus};
use std::thread::sleep;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use super::input::{Input, SECTIONS};

/// All the memory that a run may take, as addresses, the program's own text included \[kB\].
const MEMORY: u32 = 200 * 1024;

/// The longest file that it may write, blocks of 512 bytes. Beyond, writing fails as on a full disk.
const FILE_BLOCKS: u32 = 16 << 11;

/// After so long most runs are interrupted, so that many are.
const SHORT_PATIENCE: Duration = Duration::from_millis(200);

/// After so long the others are.
const PATIENCE: Duration = Duration::from_secs(5);

/// Of so many inputs one has the longer time.
const PATIENT: u64 = 64;

/// After so long beyond it is killed.
const LAST: Duration = Duration::from_secs(60);

/// A file that somebody else has written.
pub const FOREIGN: &str = "notes.txt";

/// What it holds.
pub const NOTES: &str = "mine\n";

/// What may stand where a file or a folder is expected.
#[derive(Clone, Copy, Debug)]
pub enum Odd {
    LinkToNotes,
    LinkToNothing,
    LinkToItself,
    Pipe,
}

impl Odd {
    pub const ALL: [Self; 4] =
        [Self::LinkToNotes, Self::LinkToNothing, Self::LinkToItself, Self::Pipe];

    pub fn name(self) -> &'static str {
        match self {
            Self::LinkToNotes => "link",
            Self::LinkToNothing => "dangling",
            Self::LinkToItself => "loop",
            Self::Pipe => "pipe",
        }
    }

    fn make(self, folder: &Path) {
        let path = folder.join(self.name());
        let made = match self {
            Self::LinkToNotes => symlink(FOREIGN, path),
            Self::LinkToNothing => symlink("nothing", path),
            Self::LinkToItself => symlink(self.name(), path),
            Self::Pipe => Command::new("mkfifo").arg(path).status().map(|_| ()),
        };
        made.expect("the folder is new");
    }
}

/// How the program has ended.
#[derive(Debug)]
pub struct Ended {
    pub status: ExitStatus,
    pub out: String,
    pub error: String,
    /// From the interrupt to the end, where it had to be interrupted.
    pub after_interrupt: Option<Duration>,
}

impl Ended {
    pub fn code(&self) -> Option<i32> {
        self.status.code()
    }

    pub fn signal(&self) -> Option<i32> {
        self.status.signal()
    }
}

/// A folder that goes away with the input.
pub struct Place {
    whole: TempDir,
    scene_name: &'static str,
}

impl Place {
    pub fn with(input: &Input) -> Self {
        let place =
            Self { whole: tempfile::tempdir().expect("a folder"), scene_name: input.scene_name };
        let folder = place.folder();
        fs::create_dir_all(folder.join("folder")).expect("writable");
        fs::write(folder.join(input.scene_name), &input.scene).expect("writable");
        fs::write(folder.join(SECTIONS), &input.sections).expect("writable");
        fs::write(folder.join(FOREIGN), NOTES).expect("writable");
        fs::write(folder.join("folder").join(FOREIGN), NOTES).expect("writable");
        for odd in Odd::ALL {
            let is_named = |word: &OsString| word.to_string_lossy().contains(odd.name());
            if input.words.iter().any(is_named) {
                odd.make(&folder);
            }
        }
        place
    }

    /// Where the program runs.
    pub fn folder(&self) -> PathBuf {
        self.around().join("b")
    }

    /// What is `..` there, which is still inside of what goes away.
    pub fn around(&self) -> PathBuf {
        self.whole.path().join("a")
    }

    /// Runs the program; one that takes too long is interrupted.
    pub fn run(&self, words: &[OsString], number: u64) -> Ended {
        let patience = if number.is_multiple_of(PATIENT) { PATIENCE } else { SHORT_PATIENCE };
        let limits = format!(
            "trap '' XFSZ; ulimit -c 0; ulimit -f {FILE_BLOCKS}; ulimit -v {MEMORY}; exec \"$0\" \"$@\""
        );
        let [out, error] = ["out.txt", "error.txt"].map(|name| self.whole.path().join(name));
        let file = |path: &Path| File::create(path).expect("the folder is writable");
        let mut child = Command::new("sh")
            .args(["-c", &limits, env!("CARGO_BIN_EXE_nboom")])
            .args(words)
            .current_dir(self.folder())
            .env("CARGO", "false")
            .env("HOME", self.folder().join("home"))
            .env_remove("XDG_CACHE_HOME")
            .stdin(File::open(self.folder().join(self.scene_name)).expect("it was just written"))
            .stdout(file(&out))
            .stderr(file(&error))
            .spawn()
            .expect("there is a shell");
        let (status, after_interrupt) = wait(&mut child, patience);
        let text =
            |path: &Path| String::from_utf8_lossy(&fs::read(path).expect("readable")).into_owned();
        Ended { status, out: text(&out), error: text(&error), after_interrupt }
    }
}

/// The end of a process, and how long it took after it was interrupted, if it was.
fn wait(child: &mut Child, patience: Duration) -> (ExitStatus, Option<Duration>) {
    if let Some(status) = end_within(child, patience) {
        return (status, None);
    }
    let interrupted = Instant::now();
    // Only an end in between makes this fail.
    let _ = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    let status = end_within(child, LAST).unwrap_or_else(|| {
        child.kill().expect("it is ours");
        child.wait().expect("it is ours")
    });
    (status, Some(interrupted.elapsed()))
}

fn end_within(child: &mut Child, time: Duration) -> Option<ExitStatus> {
    let started = Instant::now();
    let mut pause = Duration::from_micros(200);
    loop {
        if let Some(status) = child.try_wait().expect("it is ours") {
            return Some(status);
        }
        if started.elapsed() > time {
            return None;
        }
        sleep(pause);
        pause = (2 * pause).min(Duration::from_millis(10));
    }
}
