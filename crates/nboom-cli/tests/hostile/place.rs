//! A directory for one test, and the program run in it with a limit on memory and time.

use std::fs;
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The 1970 report's deck, on which the bad ones are made.
pub const REPORT_DECK: &str = include_str!("../../../../examples/n-boom-1970.nml");

/// All the memory that a wrong deck may take, the program's own text included \[kB\].
const MEMORY: u64 = 200 * 1024;

/// Refusing takes well under a second; this only catches what hangs, on the slowest machine.
const PATIENCE: Duration = Duration::from_secs(10);

/// A directory that goes away with the test.
pub struct Place {
    directory: PathBuf,
}

impl Place {
    pub fn new(name: &str) -> Self {
        let name = format!("nboom-test-{}-{name}", std::process::id());
        let directory = std::env::temp_dir().join(name);
        fs::create_dir_all(&directory).expect("the temporary directory is writable");
        Self { directory }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.directory.join(name)
    }

    /// Writes a file; an old one of that name, whatever it is, goes.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        let _ = fs::remove_file(self.path(name));
        fs::write(self.path(name), content).expect("writable");
    }

    /// Runs the program with these arguments and no more memory than [`MEMORY`].
    pub fn nboom(&self, args: &[&str]) -> Finished {
        self.limited("", args)
    }

    /// Runs it where no file may grow beyond so many blocks of 512 bytes; the signal that
    /// would end the program there is ignored, so that writing fails as on a full disk.
    pub fn nboom_with_files_of(&self, blocks: u32, args: &[&str]) -> Finished {
        self.limited(&format!("trap '' XFSZ && ulimit -f {blocks} && "), args)
    }

    /// Starts the program and returns while it runs.
    pub fn start(&self, args: &[&str]) -> Running {
        let mut command = Command::new(env!("CARGO_BIN_EXE_nboom"));
        command.args(args).current_dir(&self.directory).stdin(Stdio::null());
        let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn();
        Running { child: child.expect("the program starts") }
    }

    fn limited(&self, limit: &str, args: &[&str]) -> Finished {
        let started = Instant::now();
        let output = Command::new("sh")
            .args(["-c", &format!("{limit}ulimit -v {MEMORY} && exec \"$0\" \"$@\"")])
            .arg(env!("CARGO_BIN_EXE_nboom"))
            .args(args)
            .current_dir(&self.directory)
            .stdin(Stdio::null())
            .output()
            .expect("there is a shell");
        let took = started.elapsed();
        assert!(took < PATIENCE, "{args:?} took {took:?}");
        if std::env::var_os("NBOOM_TIMES").is_some() {
            eprintln!("{took:?} {args:?} in {}", self.directory.display());
        }
        Finished { output }
    }

    /// A file of a run, as text.
    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.directory);
    }
}

/// The program while it runs.
pub struct Running {
    child: Child,
}

impl Running {
    pub fn id(&self) -> u32 {
        self.child.id()
    }

    /// Waits until something is so that the program brings about.
    pub fn wait_until(&mut self, mut is_so: impl FnMut() -> bool) {
        let started = Instant::now();
        while !is_so() {
            assert!(started.elapsed() < PATIENCE, "it never came");
            let ended = self.child.try_wait().expect("it is a child");
            assert!(ended.is_none(), "it has ended: {ended:?}");
            sleep(Duration::from_millis(1));
        }
    }

    /// Sends a signal, such as `INT`.
    pub fn signal(&self, name: &str) {
        let mut kill = Command::new("kill");
        kill.args([format!("-{name}"), self.id().to_string()]).stderr(Stdio::null());
        // The program may have ended by itself.
        let _ = kill.status().expect("there is kill");
    }

    pub fn end(self) -> Finished {
        let started = Instant::now();
        let output = self.child.wait_with_output().expect("it ends");
        let took = started.elapsed();
        assert!(took < PATIENCE, "it took {took:?}");
        Finished { output }
    }
}

/// The program when it has ended.
pub struct Finished {
    output: Output,
}

impl Finished {
    pub fn code(&self) -> Option<i32> {
        self.output.status.code()
    }

    pub fn stdout(&self) -> String {
        String::from_utf8_lossy(&self.output.stdout).into_owned()
    }

    pub fn stderr(&self) -> String {
        String::from_utf8(self.output.stderr.clone()).expect("messages are text")
    }

    /// Ended with this code, saying all of `words` in lines that a terminal can show and
    /// nothing of the program's own insides.
    pub fn refused(&self, told: &str, code: i32, words: &[&str]) {
        let message = self.stderr();
        assert_eq!(self.code(), Some(code), "{told}: {message}");
        assert_eq!(self.stdout(), "", "{told}");
        for word in words {
            assert!(message.contains(word), "{told}: no {word:?} in {message:?}");
        }
        for inside in ["panicked", "RUST_BACKTRACE", ".rs:", "Some(", "Err(", "unwrap"] {
            assert!(!message.contains(inside), "{told}: {message}");
        }
        assert!(!message.is_empty(), "{told}");
        // Errors, what the input is warned of, and its lines that they are about.
        let is_excerpt = |line: &str| {
            line.trim_start_matches(|c: char| c == ' ' || c.is_ascii_digit()).starts_with('|')
        };
        let is_error = |line: &&str| line.starts_with("error: ");
        let is_warning = |line: &str| line.starts_with("warning: ");
        let is_known = |line: &str| is_error(&line) || is_warning(line) || is_excerpt(line);
        assert!(message.lines().all(is_known), "{told}: {message}");
        let errors = message.lines().filter(is_error).count();
        assert!(errors <= 51 && message.len() < 20_000, "{told}: {message}");
        let shown = |c: char| c == '\n' || !c.is_control();
        assert!(message.chars().all(shown), "{told}: {message:?}");
    }
}
