//! Where a run writes, and how its files replace an earlier result.
//!
//! A run writes into `DIR.partial` and holds a lock on it. Once the summary in `DIR.partial` says
//! complete, its files are moved to DIR one by one. If the run is killed after that, the next run
//! finishes the move before it begins.

use std::ffi::OsString;
use std::fs;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::{iter, thread};

use crate::earlier::Earlier;
use crate::kind::Kind;
use crate::lock::Lock;
use crate::names::COMPANIONS;
use crate::plots::remove_plots;
use crate::whole::Draft;
use crate::{FILES, REPORT_FILE, REPORT_MARK, ResultsError, SUMMARY_FILE};

/// Suffix of the directory in which results are not finished.
const PARTIAL: &str = ".partial";

/// Name of a summary that will replace another, within `DIR.partial`.
const DRAFT_FILE: &str = "summary.json.new";

/// How many files are waited for at once.
const AT_ONCE: usize = 4;

/// How much of a page is read to recognise it \[bytes\].
const PAGE_START: u64 = 512;

/// A directory for the results of a run, and the locked one in which they are written.
#[derive(Debug)]
pub(crate) struct Destination {
    finished: PathBuf,
    partial: PathBuf,
    lock: Lock,
    /// Whether an earlier run was complete but had not yet been moved to its place.
    pub has_put_right: bool,
}

impl Destination {
    /// Locks the place of the results `directory`, finishes the move of a run that was killed, and
    /// removes the files of an unfinished run.
    ///
    /// # Errors
    /// When another run holds it, when a file with a name of a run was not written by one,
    /// and when the system refuses. Nothing in `directory` is touched then.
    pub fn take(directory: &Path) -> Result<Self, ResultsError> {
        let (parent, name) = parted(directory)?;
        let finished = parent.join(&name);
        let partial = parent.join([name, PARTIAL.into()].join(&OsString::new()));
        let lock = Lock::acquire(&partial, &finished, "a run")?;
        let mut place = Self { finished, partial, lock, has_put_right: false };
        same_volume(&place.finished, &place.partial)?;
        place.put_right()?;
        check(&place.finished)?;
        place.clear()?;
        Ok(place)
    }

    /// The directory to write into.
    pub fn partial(&self) -> &Path {
        &self.partial
    }

    /// A file that will be a summary.
    pub fn draft(&self) -> Result<Draft, ResultsError> {
        let path = self.partial.join(DRAFT_FILE);
        Draft::create(path.clone()).map_err(ResultsError::writing(&path))
    }

    /// The names of a run that have been written.
    pub fn files(&self) -> impl Iterator<Item = &'static str> {
        let is_there = |name: &&str| self.partial.join(name).exists();
        FILES.into_iter().filter(is_there)
    }

    /// Moves what was written to the final directory, unless it is incomplete and that one has a
    /// finished result. Returns where it then is.
    ///
    /// # Errors
    /// When something cannot be moved; then the rest is still where it was written.
    pub fn settle(&self) -> Result<&Path, ResultsError> {
        let summary = self.partial.join(SUMMARY_FILE);
        // Somebody may have removed the directory while the run went on.
        let gone = || ResultsError::writing(&summary)(ErrorKind::NotFound.into());
        let new = Earlier::in_directory(&self.partial)?.ok_or_else(gone)?;
        let old = check(&self.finished)?;
        if !new.complete && old.as_ref().is_some_and(|old| old.complete) {
            return Ok(&self.partial);
        }
        if new.complete {
            let results = self.files().filter(|name| !COMPANIONS.contains(name));
            sync_all(results.map(|name| self.partial.join(name)))?;
        }
        fs::create_dir_all(&self.finished).map_err(|error| self.misplaced("", error))?;
        // Figures are of the old results, and can be made again.
        remove_plots(&self.finished)?;
        let steps = steps(&new, old.as_ref());
        steps.into_iter().try_for_each(|step| self.take_step(&new, step))?;
        Ok(&self.finished)
    }

    /// Adds a file to the results, which are in `directory`.
    pub fn add(
        &self,
        directory: &Path,
        name: &'static str,
        publish: impl FnOnce(Draft, &Path) -> io::Result<()>,
    ) -> Result<(), ResultsError> {
        let (draft, target) = self.addition(directory, name)?;
        publish(draft, &target).map_err(ResultsError::writing(&target))
    }

    /// A file that will be added to the results, which are in `directory`, and where it will be.
    pub fn addition(
        &self,
        directory: &Path,
        name: &'static str,
    ) -> Result<(Draft, PathBuf), ResultsError> {
        assert!(FILES.contains(&name), "{name} is in the table of names");
        let (path, target) = (self.partial.join(name), directory.join(name));
        let draft = Draft::create(path).map_err(ResultsError::writing(&target))?;
        Ok((draft, target))
    }

    fn take_step(&self, new: &Earlier, step: Step) -> Result<(), ResultsError> {
        match step {
            Step::Mark(files) => {
                let mark = new.as_mark(&files, &self.partial);
                let _ = fs::remove_file(self.partial.join(DRAFT_FILE));
                let target = self.finished.join(SUMMARY_FILE);
                let marked = self.draft()?.publish(&target, &mark);
                marked.map_err(|error| self.misplaced(SUMMARY_FILE, error))
            }
            Step::Remove(name) => remove(&self.finished.join(name)),
            Step::Move(name) => {
                let moved = fs::rename(self.partial.join(name), self.finished.join(name));
                match moved {
                    // A run that was killed had moved it already, or never wrote it.
                    Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
                    moved => moved.map_err(|error| self.misplaced(name, error)),
                }
            }
        }
    }

    fn misplaced(&self, name: &str, source: io::Error) -> ResultsError {
        let (from, to) = (self.partial.clone(), self.finished.join(name));
        ResultsError::Misplaced { from, to, source }
    }

    /// Moves a complete run that was killed before it took its place.
    fn put_right(&mut self) -> Result<(), ResultsError> {
        self.require_ours()?;
        if Earlier::in_directory(&self.partial)?.is_some_and(|left| left.complete) {
            self.settle()?;
            self.has_put_right = true;
        }
        Ok(())
    }

    /// Refuses files with names of a run that no run has written. Whatever is in the directory of a
    /// current run is its own.
    fn require_ours(&self) -> Result<(), ResultsError> {
        if self.lock.was_left { Ok(()) } else { check(&self.partial).map(|_| ()) }
    }

    /// Removes what is left of an unfinished run.
    fn clear(&self) -> Result<(), ResultsError> {
        remove_plots(&self.partial)?;
        let mut names = FILES.into_iter().chain([DRAFT_FILE]);
        names.try_for_each(|name| remove(&self.partial.join(name)))
    }
}

/// One of the steps by which results take the place of others. After each of them a summary says
/// what is there.
#[derive(Clone, Debug, PartialEq)]
enum Step {
    /// Say that the result is being replaced, and which run has which files.
    Mark(Vec<String>),
    /// Remove a file that the new results do not have.
    Remove(&'static str),
    /// Move a file.
    Move(&'static str),
}

/// The steps by which `new` results take the place of `old` ones.
///
/// The summary of complete results comes last, that of incomplete ones first.
fn steps(new: &Earlier, old: Option<&Earlier>) -> Vec<Step> {
    let is_new = |name: &&str| new.files.iter().any(|file| file == name);
    let is_old = |name: &str| old.is_some_and(|old| old.owns(name));
    let all = FILES.into_iter().filter(|name| is_new(name) || is_old(name));
    let all: Vec<String> = all.map(str::to_owned).collect();
    let stale = FILES.into_iter().filter(|name| is_old(name) && !is_new(name));
    let tables = FILES.into_iter().filter(|name| *name != SUMMARY_FILE).filter(is_new);
    let (stale, tables) = (stale.map(Step::Remove), tables.map(Step::Move));
    let summary = Step::Move(SUMMARY_FILE);
    let mut steps = Vec::new();
    if new.complete {
        steps.push(Step::Mark(all));
        steps.extend(stale.chain(tables));
        steps.push(summary);
    } else {
        steps.extend(stale);
        steps.push(summary);
        steps.extend(tables);
    }
    steps
}

/// # Errors
/// When a directory has no name of its own, as the root, or one that those of unfinished runs have.
pub fn require_named(directory: &Path) -> Result<(), ResultsError> {
    parted(directory).map(|_| ())
}

/// Parent and name of a directory for results.
fn parted(directory: &Path) -> Result<(PathBuf, OsString), ResultsError> {
    let unnamed = || ResultsError::Name { path: directory.to_owned() };
    let named = match directory.file_name() {
        Some(_) => directory.to_owned(),
        // `.` and `..` stand for directories that have names.
        None => fs::canonicalize(directory).map_err(|_| unnamed())?,
    };
    let name = named.file_name().ok_or_else(unnamed)?.to_owned();
    if name.to_string_lossy().ends_with(PARTIAL) {
        return Err(unnamed());
    }
    Ok((named.parent().map(Path::to_owned).unwrap_or_default(), name))
}

/// The results of a run in a directory, after a check that no file with a name of a run is foreign.
fn check(directory: &Path) -> Result<Option<Earlier>, ResultsError> {
    let failed = |source| ResultsError::Directory { path: directory.to_owned(), source };
    match Kind::of(directory).map_err(failed)? {
        Kind::Nothing => return Ok(None),
        Kind::Directory => {}
        found => return Err(ResultsError::NotADirectory { path: directory.to_owned(), found }),
    }
    let earlier = Earlier::in_directory(directory)?;
    for name in FILES {
        let path = directory.join(name);
        let is_ours =
            |earlier: &Earlier| earlier.owns(name) && (name != REPORT_FILE || is_page(&path));
        match Kind::of(&path).map_err(ResultsError::writing(&path))? {
            Kind::Nothing => {}
            Kind::File if earlier.as_ref().is_some_and(is_ours) => {}
            found => return Err(ResultsError::Foreign { path, found }),
        }
    }
    Ok(earlier)
}

/// Whether a file is a page that nboom has made.
pub fn is_page(path: &Path) -> bool {
    let mut start = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(PAGE_START).read_to_end(&mut start));
    read.is_ok() && String::from_utf8_lossy(&start).contains(REPORT_MARK)
}

/// Refuses a directory into which files beside it cannot be moved.
#[cfg(unix)]
fn same_volume(finished: &Path, partial: &Path) -> Result<(), ResultsError> {
    use std::os::unix::fs::MetadataExt;
    let volume = |path: &Path| fs::metadata(path).ok().map(|found| found.dev());
    match volume(finished) {
        Some(found) if Some(found) != volume(partial) => {
            Err(ResultsError::Mounted { path: finished.to_owned() })
        }
        _ => Ok(()),
    }
}

#[cfg(not(unix))]
fn same_volume(_: &Path, _: &Path) -> Result<(), ResultsError> {
    Ok(())
}

/// Waits until all of these files are on the disk.
///
/// Each file that is waited for alone takes as long as a short run, and far longer where others write
/// too; the system brings several to the disk in hardly more time than one.
fn sync_all(paths: impl Iterator<Item = PathBuf> + Send) -> Result<(), ResultsError> {
    let paths = Mutex::new(paths);
    let next = || paths.lock().expect("no thread panics here").next();
    let sync_some = || iter::from_fn(next).try_for_each(|path| sync(&path));
    thread::scope(|scope| {
        // Where the system has no thread to give, the others do its work.
        let others = (1..AT_ONCE).map(|_| thread::Builder::new().spawn_scoped(scope, sync_some));
        let others: Vec<_> = others.flatten().collect();
        let results = others.into_iter().map(|other| other.join().expect("a sync does not panic"));
        iter::once(sync_some()).chain(results).collect()
    })
}

/// Waits until a file is on the disk.
fn sync(path: &Path) -> Result<(), ResultsError> {
    let synced = fs::OpenOptions::new().write(true).open(path).and_then(|file| file.sync_all());
    synced.map_err(ResultsError::writing(path))
}

/// Removes a file or a link, if there is one.
fn remove(path: &Path) -> Result<(), ResultsError> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => {
            Err(ResultsError::writing(path)(error))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests;
