//! What was written into a directory, so that a change by somebody else is noticed.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::io::ErrorKind;
use std::path::Component::Normal;
use std::path::Path;

use nboom_codegen::{Standing, hash};

use crate::PackageError;
use crate::files::{put, read};

/// Paths inside a directory, and texts.
pub(crate) type Files = BTreeMap<String, String>;

/// The file that lists the others.
const NAME: &str = "GENERATED";

/// What it begins with.
const MARK: &str = "Written by nboom; edit the scene or the options, not these files.";

/// The key of a listing whose files are being written.
const UNFINISHED: u64 = 0;

/// The files that were written into a directory with the hashes of their texts.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Listing {
    /// A number for all that they were made from.
    key: u64,
    /// A path may have several hashes while files are being written.
    hashes: BTreeMap<String, BTreeSet<u64>>,
}

impl Listing {
    pub fn new(key: u64, files: &Files) -> Self {
        let of_text = |text: &String| BTreeSet::from([hash(text.as_bytes())]);
        let hashes = files.iter().map(|(path, text)| (path.clone(), of_text(text)));
        Self { key, hashes: hashes.collect() }
    }

    /// While files are being written each is as it was or as it will be.
    fn until(&self, after: &Self) -> Self {
        let mut hashes = self.hashes.clone();
        for (path, of_texts) in &after.hashes {
            hashes.entry(path.clone()).or_default().extend(of_texts);
        }
        Self { key: UNFINISHED, hashes }
    }

    fn has(&self, path: &str, of_text: u64) -> bool {
        self.hashes.get(path).is_some_and(|hashes| hashes.contains(&of_text))
    }

    /// The listing in a directory, if there is one.
    ///
    /// # Errors
    /// [`PackageError::NotOurs`] when it was changed.
    pub fn read(directory: &Path) -> Result<Option<Self>, PackageError> {
        let path = directory.join(NAME);
        let Some(found) = read_text(&path)? else { return Ok(None) };
        match Self::parse(&found).filter(|listing| found == listing.text()) {
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
        let mut hashes: BTreeMap<String, BTreeSet<u64>> = BTreeMap::new();
        for line in lines {
            let (path, of_text) = row(line)?;
            hashes.entry(path).or_default().insert(of_text);
        }
        Some(Self { key, hashes })
    }

    fn text(&self) -> String {
        let mut rows = String::new();
        let of_path = |(path, hashes)| std::iter::repeat(path).zip(hashes);
        for (path, hash) in self.hashes.iter().flat_map(of_path) {
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
        for name in listing.hashes.keys() {
            let path = directory.join(name);
            match read_text(&path)? {
                None => return outdated(path, None),
                Some(text) if !listing.has(name, hash(text.as_bytes())) => {
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

/// The text of a file, if there is one, with its lines as they were written: some checkouts end them otherwise.
fn read_text(path: &Path) -> Result<Option<String>, PackageError> {
    let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).replace("\r\n", "\n");
    Ok(read(path)?.map(text))
}

/// Makes a directory hold `files` and a listing of them, and removes what an earlier listing has
/// beyond these. Files that are as they should be are not touched. When the writing is broken off,
/// the next one knows the files for its own.
///
/// # Errors
/// [`PackageError::NotOurs`] where that would destroy what somebody else has written; nothing is
/// written then.
pub(crate) fn write(directory: &Path, key: u64, files: &Files) -> Result<(), PackageError> {
    let nothing = Listing { key: UNFINISHED, hashes: BTreeMap::new() };
    let before = Listing::read(directory)?.unwrap_or(nothing);
    let after = Listing::new(key, files);
    let between = before.until(&after);
    for name in between.hashes.keys() {
        let path = directory.join(name);
        let Some(text) = read_text(&path)? else { continue };
        if !between.has(name, hash(text.as_bytes())) {
            let known = before.hashes.contains_key(name);
            let standing = if known { Standing::Edited } else { Standing::Foreign };
            return Err(PackageError::NotOurs { path, standing });
        }
    }
    put(&directory.join(NAME), between.text())?;
    for (path, text) in files {
        put(&directory.join(path), text)?;
    }
    for path in before.hashes.keys().filter(|path| !files.contains_key(*path)) {
        let path = directory.join(path);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                return Err(PackageError::writing(&path)(error));
            }
            _ => {}
        }
    }
    put(&directory.join(NAME), after.text())?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_writing_that_was_broken_off_is_finished() {
        let place = tempfile::tempdir().expect("a directory");
        let of = |text: &str| {
            let names = ["a", "b", "c"].into_iter();
            names.map(|name| (name.to_owned(), text.to_owned())).collect::<Files>()
        };
        let holds = |text: &str| {
            let of_file = |name| fs::read_to_string(place.path().join(name)).ok();
            ["a", "b", "c"].map(of_file) == [(); 3].map(|()| Some(text.to_owned()))
        };
        // Only the first of three files is written.
        let broken = |key, text: &str| {
            let nothing = Listing { key: UNFINISHED, hashes: BTreeMap::new() };
            let before = Listing::read(place.path()).expect("ours").unwrap_or(nothing);
            let between = before.until(&Listing::new(key, &of(text)));
            put(&place.path().join(NAME), between.text()).expect("writable");
            put(&place.path().join("a"), text).expect("writable");
        };
        broken(1, "old");
        write(place.path(), 1, &of("old")).expect("its own files are known");
        assert!(holds("old"));
        broken(2, "new");
        let unfinished = Listing::require_current(place.path(), 2).expect_err("old and new");
        assert!(matches!(unfinished, PackageError::Outdated { .. }), "{unfinished}");
        write(place.path(), 2, &of("new")).expect("its own files are known");
        assert!(holds("new"));
        Listing::require_current(place.path(), 2).expect("all is written");
    }

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
