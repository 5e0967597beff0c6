//! Files, read and written whole.

use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::PackageError;

/// What a file holds, if there is one.
pub(crate) fn read(path: &Path) -> Result<Option<Vec<u8>>, PackageError> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(PackageError::reading(path)(error)),
    }
}

/// Makes a file hold a text or bytes, and tells whether it did already; its time stamp stays then.
pub(crate) fn put(path: &Path, what: impl AsRef<[u8]>) -> Result<bool, PackageError> {
    if read(path)?.is_some_and(|bytes| bytes == what.as_ref()) {
        return Ok(true);
    }
    replace(path, what.as_ref(), false)?;
    Ok(false)
}

/// Gives a file other contents all at once, from one beside it that nobody else has. So a writing
/// that is broken off leaves it as it was, and a program that runs can be replaced.
pub(crate) fn replace(path: &Path, bytes: &[u8], executable: bool) -> Result<(), PackageError> {
    let failed = || PackageError::writing(path);
    let folder = path.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(folder).map_err(failed())?;
    let (new, mut file) = open_beside(path).map_err(failed())?;
    let mut written = file.write_all(bytes);
    drop(file);
    if executable {
        written = written.and_then(|()| make_executable(&new));
    }
    written.and_then(|()| fs::rename(&new, path)).map_err(|error| {
        // What is left over then matters less than why.
        let _ = fs::remove_file(&new);
        failed()(error)
    })
}

/// Refuses the path of a new file that cannot be made: a file is made, and removed, in its folder, or in the
/// nearest one that there is.
pub(crate) fn require_writable(path: &Path) -> Result<(), PackageError> {
    let tried = std::path::absolute(path).and_then(|whole| {
        let below = whole.ancestors().find(|below| below.parent().is_none_or(Path::is_dir));
        let (new, _) = open_beside(below.unwrap_or(&whole))?;
        fs::remove_file(new)
    });
    tried.map_err(PackageError::writing(path))
}

/// A new hidden file in the same folder, and its path.
fn open_beside(path: &Path) -> io::Result<(PathBuf, File)> {
    (0..)
        .map(|number| beside(path, number))
        .map(|new| (OpenOptions::new().write(true).create_new(true).open(&new), new))
        .find_map(|(opened, new)| match opened {
            Ok(file) => Some(Ok((new, file))),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => None,
            Err(error) => Some(Err(error)),
        })
        .expect("numbers do not end")
}

/// The name of a hidden file in the same folder.
fn beside(path: &Path, number: usize) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{number}.new"))
}

#[cfg(unix)]
fn make_executable(path: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    let mut permissions = fs::metadata(path)?.permissions();
    // Whoever may read it may run it.
    let mode = permissions.mode();
    permissions.set_mode(mode | (mode & 0o444) >> 2);
    fs::set_permissions(path, permissions)
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_its_neighbours_stay() {
        let place = tempfile::tempdir().expect("a directory");
        let path = place.path().join("program");
        let neighbour = beside(&path, 0);
        fs::write(&path, "old").expect("writable");
        fs::write(&neighbour, "mine").expect("writable");
        replace(&path, b"new", true).expect("the folder is ours");
        assert_eq!(fs::read(&path).ok().as_deref(), Some(&b"new"[..]));
        assert_eq!(fs::read(&neighbour).ok().as_deref(), Some(&b"mine"[..]));
        assert_eq!(fs::read_dir(place.path()).expect("readable").count(), 2);
    }
}
