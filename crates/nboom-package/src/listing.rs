//! What was written into a directory, so that a change by somebody else is noticed.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::io::ErrorKind;
use std::path::Component::Normal;
use std::path::Path;

use nboom_codegen::{Standing, hash};

use crate::PackageError;

/// Paths inside a directory, and texts.
pub(crate) type Files = BTreeMap<String, String>;

/// The file that lists the others.
const NAME: &str = "GENERATED";

/// What it begins with.
const MARK: &str = "Written by nboom; edit the scene or the options, not these files.";

/// The files that were written into a directory with the hashes of their texts.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Listing {
    /// A number for all that they were made from.
    key: u64,
    hashes: BTreeMap<String, u64>,
}

impl Listing {
    pub fn new(key: u64, files: &Files) -> Self {
        let hashes = files.iter().map(|(path, text)| (path.clone(), hash(text.as_bytes())));
        Self { key, hashes: hashes.collect() }
    }

    /// The listing in a directory, if there is one.
    ///
    /// # Errors
    /// [`PackageError::NotOurs`] when it was changed.
    pub fn read(directory: &Path) -> Result<Option<Self>, PackageError> {
        let path = directory.join(NAME);
        let Some(bytes) = read(&path)? else { return Ok(None) };
        let found = String::from_utf8(bytes).ok();
        let parsed = found.as_deref().and_then(Self::parse);
        match parsed.filter(|listing| found == Some(listing.text())) {
            Some(listing) => Ok(Some(listing)),
            None => Err(PackageError::NotOurs { path, standing: Standing::Edited }),
        }
    }

    fn parse(text: &str) -> Option<Self> {
        let mut lines = text.lines().skip(1);
        let number = |text: &str| u64::from_str_radix(text, 16).ok();
        let key = number(lines.next()?.strip_prefix("Request ")?.split(',').next()?)?;
        let row = |line: &str| {
            let (hash, path) = line.split_once("  ")?;
            let inside = Path::new(path).components().all(|part| matches!(part, Normal(_)));
            inside.then_some((path.to_owned(), number(hash)?))
        };
        Some(Self { key, hashes: lines.map(row).collect::<Option<_>>()? })
    }

    fn text(&self) -> String {
        let mut rows = String::new();
        for (path, hash) in &self.hashes {
            writeln!(rows, "{hash:016x}  {path}").expect("a string takes any text");
        }
        let of_rows = hash(rows.as_bytes());
        format!("{MARK}\nRequest {:016x}, list {of_rows:016x}\n{rows}", self.key)
    }

    /// How a directory stands to what `key` stands for; the file that decides it.
    ///
    /// # Errors
    /// [`PackageError::Outdated`] when it is not what would be written now.
    pub fn require_current(directory: &Path, key: u64) -> Result<(), PackageError> {
        let outdated = |path, standing| Err(PackageError::Outdated { path, standing });
        let listing = match Self::read(directory) {
            Err(PackageError::NotOurs { path, standing }) => {
                return outdated(path, Some(standing));
            }
            listing => listing?,
        };
        let Some(listing) = listing else { return outdated(directory.join(NAME), None) };
        for (path, of_text) in &listing.hashes {
            let path = directory.join(path);
            match read(&path)? {
                None => return outdated(path, None),
                Some(bytes) if hash(&bytes) != *of_text => {
                    return outdated(path, Some(Standing::Edited));
                }
                Some(_) => {}
            }
        }
        if listing.key == key {
            Ok(())
        } else {
            outdated(directory.join(NAME), Some(Standing::Stale))
        }
    }
}

/// Makes a directory hold `files` and a listing of them, and removes what an earlier listing has
/// beyond these. Files that are as they should be are not touched.
///
/// # Errors
/// [`PackageError::NotOurs`] where that would destroy what somebody else has written; nothing is
/// written then.
pub(crate) fn write(directory: &Path, key: u64, files: &Files) -> Result<(), PackageError> {
    let before = Listing::read(directory)?;
    let written = before.map(|listing| listing.hashes).unwrap_or_default();
    for path in files.keys().chain(written.keys()) {
        let of_text = files.get(path).map(|text| hash(text.as_bytes()));
        let path_there = directory.join(path);
        let Some(bytes) = read(&path_there)? else { continue };
        let found = Some(hash(&bytes));
        if found != of_text && found != written.get(path).copied() {
            let known = written.contains_key(path);
            let standing = if known { Standing::Edited } else { Standing::Foreign };
            return Err(PackageError::NotOurs { path: path_there, standing });
        }
    }
    for (path, text) in files {
        put(&directory.join(path), text)?;
    }
    for path in written.keys().filter(|path| !files.contains_key(*path)) {
        let path = directory.join(path);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                return Err(PackageError::writing(&path)(error));
            }
            _ => {}
        }
    }
    put(&directory.join(NAME), &Listing::new(key, files).text())
}

/// Makes a file hold a text; its time stamp stays where it does.
pub(crate) fn put(path: &Path, text: &str) -> Result<(), PackageError> {
    if read(path)?.is_some_and(|bytes| bytes == text.as_bytes()) {
        return Ok(());
    }
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder).map_err(PackageError::writing(path))?;
    fs::write(path, text).map_err(PackageError::writing(path))
}

/// What a file holds, if there is one.
pub(crate) fn read(path: &Path) -> Result<Option<Vec<u8>>, PackageError> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
        Err(error) => Err(PackageError::reading(path)(error)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_listing_reads_back() {
        let files =
            Files::from([("a".to_owned(), "x".to_owned()), ("b/c d".to_owned(), "".into())]);
        let listing = Listing::new(7, &files);
        assert_eq!(Listing::parse(&listing.text()), Some(listing));
        for other in
            ["", "one line\n", "a\nRequest 7, list 0\nno hash\n", "a\nRequest 7, list 0\n1  ../b"]
        {
            assert_eq!(Listing::parse(other), None);
        }
    }
}
