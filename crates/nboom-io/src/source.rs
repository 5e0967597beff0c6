use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use crate::InputError;

/// The longest file that is read \[bytes\].
pub(crate) const LARGEST_FILE: u64 = 16 << 20;

/// The text of a deck's file; bytes that are not UTF-8 become U+FFFD, which only comments may
/// contain.
pub(crate) fn read_text(path: &Path) -> Result<String, InputError> {
    let io = |source| InputError::Io { path: path.to_owned(), source };
    let metadata = fs::metadata(path).map_err(io)?;
    // Also keeps a pipe that nobody writes to from being waited for.
    if !metadata.is_file() {
        return Err(InputError::NotAFile { path: path.to_owned() });
    }
    check_ending(path)?;
    check_length(path, metadata.len())?;
    let mut bytes = Vec::new();
    // The file may have grown since it was measured.
    File::open(path).map_err(io)?.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(io)?;
    check_length(path, bytes.len() as u64)?;
    decode(path, bytes)
}

fn check_ending(path: &Path) -> Result<(), InputError> {
    let is_deck = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("nml"));
    if is_deck { Ok(()) } else { Err(InputError::NotAScene { path: path.to_owned() }) }
}

fn check_length(path: &Path, length: u64) -> Result<(), InputError> {
    if length > LARGEST_FILE {
        return Err(InputError::TooLarge { path: path.to_owned(), limit: LARGEST_FILE });
    }
    Ok(())
}

fn decode(path: &Path, bytes: Vec<u8>) -> Result<String, InputError> {
    if let Some(offset) = bytes.iter().position(|&byte| byte == 0) {
        return Err(InputError::Binary { path: path.to_owned(), offset });
    }
    Ok(match String::from_utf8(bytes) {
        Ok(text) => text,
        Err(error) => String::from_utf8_lossy(error.as_bytes()).into_owned(),
    })
}
