//! Files that are replaced whole: they always have either the old content or the new one.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Seek, Write};
use std::path::{Path, PathBuf};

use crate::ResultsError;
use crate::kind::Kind;

/// Writes a file at `path`, into a folder that is made if need be; an older file is replaced.
///
/// # Errors
/// [`ResultsError::Foreign`] where something other than a file is there, such as a link;
/// another error when it cannot be written. An older file then stays.
pub fn write_file(path: &Path, text: &str) -> Result<(), ResultsError> {
    write_whole(path, text.as_bytes())
}

/// As [`write_file`], of anything.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), ResultsError> {
    beside(path)?.publish(path, bytes).map_err(ResultsError::writing(path))
}

/// As [`write_file`], of a file that `make` writes at another path.
///
/// # Errors
/// As [`write_file`], and that of `make`.
pub fn make_file<E: From<ResultsError>>(
    path: &Path,
    make: impl FnOnce(&Path) -> Result<(), E>,
) -> Result<(), E> {
    beside(path)?.publish_made(path, make)
}

/// A file that will be the one at `path`, where only a file may be; the folder is made if need be.
fn beside(path: &Path) -> Result<Draft, ResultsError> {
    match Kind::of(path).map_err(ResultsError::writing(path))? {
        Kind::File | Kind::Nothing => {}
        found => return Err(ResultsError::Foreign { path: path.to_owned(), found }),
    }
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.map_err(ResultsError::writing(path))?;
    let mut numbers = 0..;
    loop {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let number = numbers.next().unwrap_or(0);
        match Draft::create(path.with_file_name(format!(".{name}.{number}.new"))) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            made => return made.map_err(ResultsError::writing(path)),
        }
    }
}

/// A file that will replace another, and is removed if it does not.
#[derive(Debug)]
pub(crate) struct Draft {
    path: PathBuf,
    file: File,
    published: bool,
}

impl Drop for Draft {
    fn drop(&mut self) {
        if !self.published {
            // The error matters more than a file that is left over.
            let _ = fs::remove_file(&self.path);
        }
    }
}

impl Draft {
    /// Makes the file at `path`, where nothing may be.
    pub fn create(path: PathBuf) -> io::Result<Self> {
        let file = OpenOptions::new().write(true).create_new(true).open(&path)?;
        Ok(Self { path, file, published: false })
    }

    /// Reserves this many bytes of the disk for this file.
    pub fn reserve(&mut self, bytes: usize) -> io::Result<()> {
        self.file.write_all(&vec![b' '; bytes])
    }

    /// Writes a text into the file and moves it to `target`.
    pub fn publish(mut self, target: &Path, text: &[u8]) -> io::Result<()> {
        self.write(text)?;
        self.put(target)
    }

    /// As [`Self::publish`], of a text that can be made again: after a power failure the file may be empty.
    pub fn publish_unsynced(mut self, target: &Path, text: &[u8]) -> io::Result<()> {
        self.file.write_all(text)?;
        self.put(target)
    }

    /// Lets `make` write the file at its path, and moves it to `target`.
    ///
    /// # Errors
    /// That of `make`, and when the file cannot be moved.
    pub fn publish_made<E: From<ResultsError>>(
        mut self,
        target: &Path,
        make: impl FnOnce(&Path) -> Result<(), E>,
    ) -> Result<(), E> {
        make(&self.path)?;
        // A rename may reach the disk before the data it names.
        let put = self.file.sync_all().and_then(|()| self.put(target));
        Ok(put.map_err(ResultsError::writing(target))?)
    }

    /// Writes a text into the file and moves it to `target`; if there is no space for the text,
    /// writes one that says so.
    ///
    /// # Errors
    /// When the text itself could not be written.
    pub fn publish_or(
        mut self,
        target: &Path,
        text: &[u8],
        instead: impl FnOnce(&io::Error) -> Vec<u8>,
    ) -> io::Result<()> {
        match self.write(text) {
            Ok(()) => self.put(target),
            Err(error) => {
                // The first error says most.
                let _ = self.publish(target, &instead(&error));
                Err(error)
            }
        }
    }

    fn put(&mut self, target: &Path) -> io::Result<()> {
        fs::rename(&self.path, target)?;
        self.published = true;
        Ok(())
    }

    /// Replaces the content of the file by a text.
    fn write(&mut self, text: &[u8]) -> io::Result<()> {
        self.file.rewind()?;
        self.file.write_all(text)?;
        self.file.set_len(text.len() as u64)?;
        // A rename may reach the disk before the data it names.
        self.file.sync_all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_its_neighbours_stay() {
        let place = tempfile::tempdir().expect("a directory");
        let path = place.path().join("answer.json");
        fs::write(&path, "old and longer").expect("writable");
        fs::write(place.path().join(".answer.json.0.new"), "mine").expect("writable");
        write_file(&path, "new").expect("writable");
        assert_eq!(fs::read_to_string(&path).ok().as_deref(), Some("new"));
        assert_eq!(fs::read_dir(place.path()).expect("readable").count(), 2);
    }

    #[test]
    fn a_file_that_cannot_be_made_leaves_the_old_one_alone() {
        let place = tempfile::tempdir().expect("a directory");
        let path = place.path().join("table");
        let make = |text: &'static str| {
            make_file(&path, move |draft: &Path| {
                fs::write(draft, text).expect("writable");
                if text.is_empty() { Err(ErrorKind::StorageFull.into()) } else { Ok(()) }
                    .map_err(ResultsError::writing(draft))
            })
        };
        make("whole").expect("writable");
        make("").expect_err("it fails");
        assert_eq!(fs::read_to_string(&path).ok().as_deref(), Some("whole"));
        assert_eq!(fs::read_dir(place.path()).expect("readable").count(), 1);
    }

    #[cfg(unix)]
    #[test]
    fn links_and_directories_are_refused() {
        let place = tempfile::tempdir().expect("a directory");
        let (target, link) = (place.path().join("target"), place.path().join("link"));
        fs::write(&target, "mine").expect("writable");
        std::os::unix::fs::symlink(&target, &link).expect("a unix system");
        for path in [&link, place.path()] {
            let refused = write_file(path, "new").expect_err("it is no file");
            assert!(matches!(refused, ResultsError::Foreign { .. }), "{refused}");
        }
        assert_eq!(fs::read_to_string(&target).ok().as_deref(), Some("mine"));
    }

    #[test]
    fn what_is_reserved_leaves_no_trace() {
        let place = tempfile::tempdir().expect("a directory");
        let target = place.path().join("summary.json");
        let mut draft = Draft::create(place.path().join("draft")).expect("writable");
        draft.reserve(1 << 14).expect("writable");
        draft.publish(&target, b"short").expect("writable");
        assert_eq!(fs::read_to_string(&target).ok().as_deref(), Some("short"));
    }
}
