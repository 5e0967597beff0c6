//! The directory of a sweep, which one process at a time may write.

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::iter::repeat;
use std::path::{Path, PathBuf};

use nboom_io::sha256;
use nboom_results::{Kind, Lock, require_named, write_file};

use crate::StudyError;
use crate::description::{Description, Source, short};
use crate::journal::Journal;
use crate::statistics::Summary;

/// Name of the description of a sweep within its directory.
pub const STUDY_JSON_FILE: &str = "study.json";
/// Name of the study as it was read, within a sweep's directory.
pub const STUDY_FILE: &str = "study.toml";
/// Name of the scene, which stands alone, within a sweep's directory.
pub const SWEPT_SCENE_FILE: &str = "scene.toml";
/// Name of what is done so far, within a sweep's directory.
pub const JOURNAL_FILE: &str = "journal.txt";
/// Name of the table of cases within a sweep's directory.
pub const CASES_FILE: &str = "cases.parquet";
/// Name of the table of cases in CSV within a sweep's directory.
pub const CASES_CSV_FILE: &str = "cases.csv";
/// Name of the table of trajectories within a sweep's directory.
pub const TRAJECTORIES_FILE: &str = "trajectories.parquet";
/// Name of the table of trajectories in CSV within a sweep's directory.
pub const TRAJECTORIES_CSV_FILE: &str = "trajectories.csv";

/// Name of the statistics of all cases within a sweep's directory.
pub const STATISTICS_FILE: &str = "statistics.json";
/// Name of the page of a sweep within its directory.
pub const PAGE_FILE: &str = "report.html";

/// All names that a sweep may write.
const FILES: [&str; 10] = [
    STUDY_JSON_FILE,
    STUDY_FILE,
    SWEPT_SCENE_FILE,
    JOURNAL_FILE,
    CASES_FILE,
    CASES_CSV_FILE,
    TRAJECTORIES_FILE,
    TRAJECTORIES_CSV_FILE,
    STATISTICS_FILE,
    PAGE_FILE,
];

/// The longest description and the longest text that is read \[bytes\].
const LONGEST: u64 = 1 << 28;

/// The locked directory of a sweep.
#[derive(Debug)]
pub(crate) struct Place {
    path: PathBuf,
    _lock: Lock,
    /// What is there.
    pub found: Option<Description>,
}

/// What can be done with a directory.
#[derive(Clone, Debug)]
pub(crate) enum State {
    /// The sweep is finished.
    Complete(Description),
    /// It is to be begun or continued.
    Open(Description),
    /// There is one with fewer draws that it continues.
    Fewer(Description),
}

impl Place {
    /// Locks a directory, which is made if need be.
    ///
    /// # Errors
    /// When it has the name of no directory for results, when another process holds it, and when something there has the name of a file of a sweep and is none.
    pub fn take(path: &Path) -> Result<Self, StudyError> {
        require_named(path)?;
        let lock = Lock::acquire(path, path, "a sweep")?;
        let found = description(path)?;
        for name in FILES {
            let path = path.join(name);
            match Kind::of(&path).map_err(StudyError::reading(&path))? {
                Kind::Nothing => {}
                Kind::File if found.is_some() => {}
                found => return Err(StudyError::Foreign { path, found }),
            }
        }
        Ok(Self { path: path.to_owned(), _lock: lock, found })
    }

    /// The directory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Where a file of this name is.
    pub fn file(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    /// What can be done here for this sweep.
    ///
    /// # Errors
    /// When another sweep is here; when it is of another program or machine, unless that is accepted; and when
    /// its study or scene is not what it wrote.
    pub fn state(&self, now: &Description, accept_difference: bool) -> Result<State, StudyError> {
        let Some(then) = &self.found else { return Ok(State::Open(now.clone())) };
        match sources(&self.path, then) {
            // A kill may come before they are written, and a resume writes them.
            Err(StudyError::Missing { .. }) if !then.complete => {}
            found => {
                found?;
            }
        }
        if now.continues(then) {
            require_made_here(&self.path, then, now, accept_difference)?;
            return Ok(State::Fewer(then.clone()));
        }
        require_same(&self.path, then, now, accept_difference)?;
        Ok(if then.complete {
            State::Complete(then.clone())
        } else {
            State::Open(then.clone().also_by(now))
        })
    }

    /// An error that says of another study or scene where its text differs from what is here.
    pub fn explained(&self, error: StudyError, [study, scene]: [&str; 2]) -> StudyError {
        let StudyError::Different { directory, mut differences } = error else { return error };
        for (name, now) in [(STUDY_FILE, study), (SWEPT_SCENE_FILE, scene)] {
            // A file that cannot be read explains nothing, and is not what is wrong.
            let then = text(&self.file(name)).unwrap_or_default();
            let lines = then.lines().map(Some).chain(repeat(None));
            let mut pairs = lines.zip(now.lines().map(Some).chain(repeat(None))).enumerate();
            let ends = |pair: &(usize, (Option<&str>, Option<&str>))| pair.1 != (None, None);
            let is_of_draws = |line: &Option<&str>| {
                line.is_some_and(|line| line.trim_start().starts_with("draws"))
            };
            // How many draws there are is among the differences.
            let differs = |(_, (then, now)): &(usize, (Option<&str>, Option<&str>))| {
                then != now && !(is_of_draws(then) && is_of_draws(now))
            };
            let different = pairs.by_ref().take_while(ends).find(differs);
            if let Some((i, (then, now))) = different.filter(|_| !then.is_empty()) {
                let told = |line: &str| format!("`{}`", short(line));
                let [then, now] = [then, now].map(|line| line.map_or("no line".into(), told));
                differences.push(format!("{name}, line {}: {then} then, {now} now", i + 1));
            }
        }
        StudyError::Different { directory, differences }
    }

    /// # Errors
    /// When a file of one of these names is not there.
    pub fn require<const N: usize>(&self, names: [&str; N]) -> Result<(), StudyError> {
        let missing = names.into_iter().map(|name| self.file(name)).find(|path| !path.exists());
        missing.map_or(Ok(()), |path| Err(StudyError::Missing { path }))
    }

    /// Begins a sweep or continues it: says that it is not complete, and what it is of.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn begin(&self, what: &Description, study: &str, scene: &str) -> Result<(), StudyError> {
        // First, so that all that comes after it is known to be a sweep's.
        self.write(STUDY_JSON_FILE, &what.text())?;
        self.remove_drafts()?;
        self.write(STUDY_FILE, study)?;
        self.write(SWEPT_SCENE_FILE, scene)
    }

    /// Writes the statistics of all cases.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn sum_up(&self, statistics: &Summary) -> Result<(), StudyError> {
        let text = serde_json::to_string(statistics).expect("the keys are texts and numbers");
        self.write(STATISTICS_FILE, &(text + "\n"))
    }

    /// Says what the sweep is now: made by others too, or complete.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn describe(&self, what: &Description) -> Result<(), StudyError> {
        self.write(STUDY_JSON_FILE, &what.text())
    }

    /// Removes a file of this name, if it is there.
    ///
    /// # Errors
    /// When it cannot be removed.
    pub fn remove(&self, name: &str) -> Result<(), StudyError> {
        let path = self.file(name);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(StudyError::writing(&path)(error))
            }
            _ => Ok(()),
        }
    }

    /// Paths of the files of a sweep that are here.
    pub fn files(&self) -> Vec<PathBuf> {
        FILES.into_iter().map(|name| self.file(name)).filter(|path| path.exists()).collect()
    }

    fn write(&self, name: &str, text: &str) -> Result<(), StudyError> {
        Ok(write_file(&self.file(name), text)?)
    }

    /// Removes what a killed process left of files that are written whole.
    fn remove_drafts(&self) -> Result<(), StudyError> {
        let failed = StudyError::reading;
        for entry in fs::read_dir(&self.path).map_err(failed(&self.path))? {
            let entry = entry.map_err(failed(&self.path))?;
            if is_draft(&entry.file_name().to_string_lossy()) {
                fs::remove_file(entry.path()).map_err(StudyError::writing(&entry.path()))?;
            }
        }
        Ok(())
    }
}

/// Whether a file is one that would have replaced one of a sweep.
fn is_draft(name: &str) -> bool {
    let parts = name.strip_prefix('.').and_then(|name| name.strip_suffix(".new"));
    let parts = parts.and_then(|name| name.rsplit_once('.'));
    parts.is_some_and(|(name, number)| {
        FILES.contains(&name) && number.chars().all(|digit| digit.is_ascii_digit())
    })
}

/// # Errors
/// When two descriptions are not of the same sweep; when they are of other programs, unless that is accepted.
pub(crate) fn require_same(
    directory: &Path,
    then: &Description,
    now: &Description,
    accept_difference: bool,
) -> Result<(), StudyError> {
    let differences = then.differences(now);
    if !differences.is_empty() {
        return Err(StudyError::Different { directory: directory.to_owned(), differences });
    }
    require_made_here(directory, then, now, accept_difference)
}

/// # Errors
/// When a description names programs that another does not, unless that is accepted.
pub(crate) fn require_made_here(
    directory: &Path,
    then: &Description,
    now: &Description,
    accept_difference: bool,
) -> Result<(), StudyError> {
    let directory = directory.to_owned();
    let differences = then.made_elsewhere(now);
    if differences.is_empty() || accept_difference {
        Ok(())
    } else {
        Err(StudyError::MadeElsewhere { directory, differences })
    }
}

/// Reads the description of the sweep in a directory; none if there is none.
///
/// # Errors
/// When it is no description.
pub(crate) fn description(directory: &Path) -> Result<Option<Description>, StudyError> {
    let path = directory.join(STUDY_JSON_FILE);
    let found = match Kind::of(&path) {
        // A file stands in the directory's place.
        Err(error) if error.kind() == ErrorKind::NotADirectory => Kind::Nothing,
        found => found.map_err(StudyError::reading(&path))?,
    };
    match found {
        Kind::Nothing => return Ok(None),
        Kind::File => {}
        found => return Err(StudyError::Foreign { path, found }),
    }
    let text = text(&path)?;
    Description::parse(&text).map(Some).map_err(|found| StudyError::NoSweep { path, found })
}

/// The study and the scene in the directory of a sweep, as the sweep wrote them.
///
/// # Errors
/// When one of them is not there or is another one.
pub(crate) fn sources(directory: &Path, what: &Description) -> Result<[String; 2], StudyError> {
    let as_written = |name: &str, Source { sha256: written }: &Source| {
        let path = directory.join(name);
        if !path.exists() {
            return Err(StudyError::Missing { path });
        }
        let bytes = bytes(&path)?;
        let found = sha256(&bytes);
        let text = String::from_utf8(bytes).ok().filter(|_| found == *written);
        text.ok_or_else(|| StudyError::altered(&path, &found, written))
    };
    Ok([as_written(STUDY_FILE, &what.study)?, as_written(SWEPT_SCENE_FILE, &what.scene)?])
}

/// Refuses a study in the directory of a sweep if it, or the scene beside it, is not what the sweep wrote: what is
/// made of it would not be what the sweep's tables are of.
///
/// # Errors
/// When one of them is another one.
pub fn require_as_swept(study: &Path) -> Result<(), StudyError> {
    let directory = study.parent().unwrap_or(Path::new(""));
    if study.file_name().is_none_or(|name| name != STUDY_FILE) {
        return Ok(());
    }
    match description(directory) {
        Ok(Some(what)) => sources(directory, &what).map(drop),
        // A study may lie beside a file of that name which no sweep has written, such as a schema.
        Ok(None) | Err(StudyError::NoSweep { .. } | StudyError::Foreign { .. }) => Ok(()),
        Err(error) => Err(error),
    }
}

/// Reads a text.
///
/// # Errors
/// When it cannot be read.
pub(crate) fn text(path: &Path) -> Result<String, StudyError> {
    let not_text = |error| StudyError::reading(path)(io::Error::new(ErrorKind::InvalidData, error));
    String::from_utf8(bytes(path)?).map_err(not_text)
}

fn bytes(path: &Path) -> Result<Vec<u8>, StudyError> {
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LONGEST).read_to_end(&mut bytes));
    read.map_err(StudyError::reading(path))?;
    Ok(bytes)
}

/// Reads which cases the journal in a directory has.
///
/// # Errors
/// Those of [`Journal::read`].
pub(crate) fn journal(directory: &Path, what: &Description) -> Result<Journal, StudyError> {
    Journal::read(&directory.join(JOURNAL_FILE), what.range())
}
