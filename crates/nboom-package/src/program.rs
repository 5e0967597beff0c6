//! Where a simulator is put: not over what is somebody else's.

use std::ffi::OsStr;
use std::io::{self, ErrorKind};
use std::path::Path;

use nboom_codegen::Standing;

use crate::PackageError;
use crate::files::{read, replace, require_writable};

/// What a simulator says of itself, before the number of its request and a full stop.
const MADE: &str = "Simulator made by nboom compile, request ";

/// Digits of that number.
const DIGITS: usize = 16;

/// What a simulator says of itself, by which it is recognised.
pub(crate) fn made(number: u64) -> String {
    format!("{MADE}{number:016x}.")
}

/// Refuses what is not a place for a program: a directory, and a file that is no simulator.
///
/// # Errors
/// [`PackageError::NotOurs`] where a file would be lost, [`PackageError::Write`] where none can be.
pub(crate) fn require_free(program: &Path) -> Result<(), PackageError> {
    let refused = |kind| Err(PackageError::writing(program)(io::Error::from(kind)));
    let ends_as_directory = program.as_os_str().to_string_lossy().ends_with(['/', '\\']);
    if program.is_dir() || ends_as_directory || program.file_name().is_none_or(OsStr::is_empty) {
        return refused(ErrorKind::IsADirectory);
    }
    if program.ancestors().skip(1).any(Path::is_file) {
        return refused(ErrorKind::NotADirectory);
    }
    match read(program)? {
        Some(bytes) if !is_simulator(&bytes) => {
            let (path, standing) = (program.to_owned(), Standing::Foreign);
            Err(PackageError::NotOurs { path, standing })
        }
        // One that is up to date stays, wherever it is.
        Some(_) => Ok(()),
        None => require_writable(program),
    }
}

/// Puts a program where it is wanted, and tells whether it was there already.
pub(crate) fn copy(made: &Path, program: &Path) -> Result<bool, PackageError> {
    let bytes = std::fs::read(made).map_err(PackageError::reading(made))?;
    if read(program)?.is_some_and(|there| there == bytes) {
        return Ok(true);
    }
    // Cargo took its time.
    require_free(program)?;
    replace(program, &bytes, true)?;
    Ok(false)
}

/// Whether these are a simulator's bytes. A text that quotes one is none.
fn is_simulator(bytes: &[u8]) -> bool {
    let words = bytes.windows(MADE.len() + DIGITS + 1);
    let is_mark = |word: &[u8]| {
        word.strip_prefix(MADE.as_bytes()).is_some_and(|rest| {
            rest[..DIGITS].iter().all(u8::is_ascii_hexdigit) && rest[DIGITS] == b'.'
        })
    };
    std::str::from_utf8(bytes).is_err() && words.into_iter().any(is_mark)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_simulator_is_told_from_other_files() {
        let with = |text: &str| [b"\x7fELF\xff", text.as_bytes(), b"\0"].concat();
        assert!(is_simulator(&with(&made(0xfeed))));
        for other in ["", "any other program", MADE, &made(7)[..MADE.len() + DIGITS]] {
            assert!(!is_simulator(&with(other)), "{other}");
        }
        assert!(!is_simulator(made(7).as_bytes()), "its help, kept in a file");
    }
}
