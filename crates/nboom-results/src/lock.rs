use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::{Duration, SystemTime};

use crate::ResultsError;
use crate::kind::Kind;

/// Name of the locked file in the directory of a current run; it says who holds the lock.
pub const LOCK_FILE: &str = "run.pid";

/// The right to write into a directory, which the system takes back when the process ends, in
/// whatever way.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    /// Whoever has this file locked holds the directory.
    _file: File,
    /// Whether a run that was killed had it before.
    pub was_left: bool,
}

impl Lock {
    /// Locks `directory`, which is made if need be, as the place where the results of `work` for
    /// `results` are written.
    ///
    /// # Errors
    /// [`ResultsError::InUse`] while another holds it.
    pub fn acquire(
        directory: &Path,
        results: &Path,
        work: &'static str,
    ) -> Result<Self, ResultsError> {
        let path = directory.join(LOCK_FILE);
        loop {
            make(directory)?;
            let (mut file, was_left) = match open(&path) {
                // Another run has just ended and removed the directory.
                Err(error) if error.kind() == ErrorKind::NotFound => continue,
                opened => opened.map_err(ResultsError::writing(&path))?,
            };
            match file.try_lock() {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    let holder = Holder::read(&path);
                    let directory = results.to_owned();
                    return Err(ResultsError::InUse { work, directory, holder });
                }
                Err(TryLockError::Error(error)) => {
                    return Err(ResultsError::writing(&path)(error));
                }
            }
            let held = Holder::here();
            let told = held.to_string();
            let written = file.set_len(0).and_then(|()| file.write_all(told.as_bytes()));
            written.map_err(ResultsError::writing(&path))?;
            // The file may have been of a run that has just ended, and be gone.
            if fs::read_to_string(&path).is_ok_and(|text| text == told) {
                return Ok(Self { path, _file: file, was_left });
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Nobody could be told; a file that is left blocks nobody.
        let _ = fs::remove_file(&self.path);
        if let Some(directory) = self.path.parent() {
            // Unless results stay in it.
            let _ = fs::remove_dir(directory);
        }
    }
}

/// Makes the directory, unless it is there.
fn make(directory: &Path) -> Result<(), ResultsError> {
    let failed = |source| ResultsError::Directory { path: directory.to_owned(), source };
    match fs::create_dir_all(directory) {
        Err(error) if error.kind() != ErrorKind::AlreadyExists => return Err(failed(error)),
        _ => {}
    }
    match Kind::of(directory).map_err(failed)? {
        // Another run may have removed it again.
        Kind::Directory | Kind::Nothing => Ok(()),
        found => Err(ResultsError::NotADirectory { path: directory.to_owned(), found }),
    }
}

/// Opens the lock's file; it may have been left by a run that was killed.
fn open(path: &Path) -> io::Result<(File, bool)> {
    let mut options = OpenOptions::new();
    options.read(true).write(true);
    match options.clone().create_new(true).open(path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => match Kind::of(path)? {
            Kind::File | Kind::Nothing => Ok((options.open(path)?, true)),
            // Opening a pipe would wait for a reader.
            found => Err(io::Error::new(ErrorKind::AlreadyExists, format!("found {found}"))),
        },
        opened => Ok((opened?, false)),
    }
}

/// Who holds a lock, as far as its file says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Holder {
    /// The process and how long after 1970 it began, if that could be read.
    known: Option<(u32, Duration)>,
}

impl Holder {
    fn here() -> Self {
        Self { known: Some((process::id(), now())) }
    }

    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap_or_default();
        let mut words = text.split_whitespace();
        let mut known = || {
            let process = words.next()?.parse().ok()?;
            Some((process, Duration::from_nanos(words.next()?.parse().ok()?)))
        };
        Self { known: known() }
    }

    /// What to call the holder in a sentence.
    pub(crate) fn told(&self) -> String {
        match self.known {
            Some((process, since)) => {
                let seconds = now().saturating_sub(since).as_secs();
                format!("process {process}, for {seconds} s")
            }
            None => "another process".to_owned(),
        }
    }
}

impl std::fmt::Display for Holder {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.known {
            Some((process, since)) => writeln!(f, "{process} {}", since.as_nanos()),
            None => Ok(()),
        }
    }
}

fn now() -> Duration {
    SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_and_nothing_is_left() {
        let place = tempfile::tempdir().expect("a directory");
        let directory = place.path().join("run.partial");
        let results = place.path().join("run");
        let lock = Lock::acquire(&directory, &results, "a run").expect("nobody has it");
        assert!(!lock.was_left);
        let refused = Lock::acquire(&directory, &results, "a run").expect_err("it is held");
        let told =
            format!("a run into {} is going on, by process {}", results.display(), process::id());
        assert!(refused.to_string().contains(&told), "{refused}");
        drop(lock);
        assert!(!directory.exists());
        drop(Lock::acquire(&directory, &results, "a run").expect("nobody has it"));
    }

    #[test]
    fn of_many_at_the_same_instant_one_is_let_in() {
        let place = tempfile::tempdir().expect("a directory");
        let directory = place.path().join("run.partial");
        let inside = std::sync::atomic::AtomicUsize::new(0);
        let enter = || {
            for _ in 0..200 {
                if let Ok(lock) = Lock::acquire(&directory, place.path(), "a run") {
                    use std::sync::atomic::Ordering::SeqCst;
                    assert_eq!(inside.fetch_add(1, SeqCst), 0, "two at once");
                    std::thread::yield_now();
                    inside.fetch_sub(1, SeqCst);
                    drop(lock);
                }
            }
        };
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(enter);
            }
        });
        assert!(!directory.exists());
    }

    #[test]
    fn what_a_killed_process_left_keeps_nobody_out() {
        let place = tempfile::tempdir().expect("a directory");
        fs::write(place.path().join(LOCK_FILE), "1 1\n").expect("writable");
        let lock = Lock::acquire(place.path(), place.path(), "a run").expect("nobody has it");
        assert!(lock.was_left);
    }
}
