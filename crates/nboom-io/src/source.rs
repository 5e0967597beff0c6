use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::InputError;

/// The longest deck that is read \[bytes\].
const LARGEST_DECK: u64 = 16 << 20;

/// The text of a deck's file, and the hash of its bytes.
pub(crate) fn read_deck(path: &Path) -> Result<(String, String), InputError> {
    check_file(path)?;
    check_ending(path)?;
    hashed(path, read_bytes(path, LARGEST_DECK)?)
}

/// The text of a deck from any reader, and the hash of its bytes; `path` stands for it in messages.
pub(crate) fn read_stream(path: &Path, reader: impl Read) -> Result<(String, String), InputError> {
    hashed(path, read_limited(path, reader, LARGEST_DECK)?)
}

fn hashed(path: &Path, bytes: Vec<u8>) -> Result<(String, String), InputError> {
    let hash = sha256(&bytes);
    Ok((decode(path, bytes)?, hash))
}

/// SHA-256 in hexadecimal digits.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The text of a file of at most `limit` bytes; bytes that are not UTF-8 become U+FFFD.
///
/// # Errors
/// When the file cannot be read, is a directory or a device, is too long or is not text.
pub fn read_text(path: &Path, limit: u64) -> Result<String, InputError> {
    decode(path, read_bytes(path, limit)?)
}

fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, InputError> {
    let length = check_file(path)?;
    check_length(path, length, limit)?;
    let file = File::open(path);
    let file = file.map_err(|source| InputError::Io { path: path.to_owned(), source })?;
    // The file may have grown since it was measured.
    read_limited(path, file, limit)
}

fn read_limited(path: &Path, reader: impl Read, limit: u64) -> Result<Vec<u8>, InputError> {
    let mut bytes = Vec::new();
    let read = reader.take(limit + 1).read_to_end(&mut bytes);
    read.map_err(|source| InputError::Io { path: path.to_owned(), source })?;
    check_length(path, bytes.len() as u64, limit)?;
    Ok(bytes)
}

/// The length of a regular file; a pipe might block.
fn check_file(path: &Path) -> Result<u64, InputError> {
    let io = |source| InputError::Io { path: path.to_owned(), source };
    let metadata = fs::metadata(path).map_err(io)?;
    if metadata.is_file() {
        Ok(metadata.len())
    } else {
        Err(InputError::NotAFile { path: path.to_owned() })
    }
}

fn check_ending(path: &Path) -> Result<(), InputError> {
    let is_deck = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("nml"));
    if is_deck { Ok(()) } else { Err(InputError::NotAScene { path: path.to_owned() }) }
}

fn check_length(path: &Path, length: u64, limit: u64) -> Result<(), InputError> {
    if length > limit {
        return Err(InputError::TooLarge { path: path.to_owned(), limit });
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
