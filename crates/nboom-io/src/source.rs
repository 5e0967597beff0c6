use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use sha2::{Digest, Sha256};

use crate::InputError;
use crate::scene::folder_name;

/// The longest file of a scene that is read \[bytes\].
pub(crate) const LARGEST: u64 = 16 << 20;

/// What a scene is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// TOML.
    Toml,
    /// A deck of the 1970 program.
    Nml,
    /// A robot in URDF.
    Urdf,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 3] = [Self::Toml, Self::Nml, Self::Urdf];

    /// The name on the command line, and the ending of files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Toml => "toml",
            Self::Nml => "nml",
            Self::Urdf => "urdf",
        }
    }

    /// The format of a file by its ending, letter case ignored.
    pub fn of(path: &Path) -> Option<Self> {
        let ending = path.extension()?;
        Self::ALL.into_iter().find(|format| ending.eq_ignore_ascii_case(format.name()))
    }
}

/// Format and text of a scene's file, and the hash of its bytes.
pub(crate) fn read_file(path: &Path) -> Result<(Format, String, String), InputError> {
    check_file(path)?;
    let format = Format::of(path);
    let format = format.ok_or_else(|| InputError::NotAScene { path: path.to_owned() })?;
    let (text, sha256) = hashed(path, format, read_bytes(path, LARGEST)?)?;
    Ok((format, text, sha256))
}

/// The folder of a file.
pub(crate) fn folder(path: &Path) -> &Path {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// What a scene in a file is called that does not say its name.
pub(crate) fn scene_name(path: &Path) -> String {
    folder_name(&path.file_stem().unwrap_or_default().to_string_lossy())
}

/// The text of a scene from any reader, and the hash of its bytes; `path` stands for it in messages.
pub(crate) fn read_stream(
    path: &Path,
    format: Format,
    reader: impl Read,
) -> Result<(String, String), InputError> {
    hashed(path, format, read_limited(path, reader, LARGEST)?)
}

fn hashed(path: &Path, format: Format, bytes: Vec<u8>) -> Result<(String, String), InputError> {
    let hash = sha256(&bytes);
    let text = match format {
        // Decks are older than UTF-8; their comments may be in any code.
        Format::Nml => {
            check_text(path, &bytes)?;
            String::from_utf8_lossy(&bytes).into_owned()
        }
        Format::Toml | Format::Urdf => decode(path, bytes)?,
    };
    Ok((text, hash))
}

/// SHA-256 in hexadecimal digits.
pub fn sha256(bytes: &[u8]) -> String {
    digits(&Sha256::digest(bytes))
}

/// [`sha256`] of all that a reader has.
///
/// # Errors
/// When it cannot be read.
pub fn sha256_of(mut reader: impl Read) -> io::Result<String> {
    let mut hash = Sha256::new();
    io::copy(&mut reader, &mut hash)?;
    Ok(digits(&hash.finalize()))
}

fn digits(hash: &[u8]) -> String {
    hash.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The text of a file of at most `limit` bytes.
///
/// # Errors
/// When the file cannot be read, is a directory or a device, is too long or is not text in UTF-8.
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

fn check_length(path: &Path, length: u64, limit: u64) -> Result<(), InputError> {
    if length > limit {
        return Err(InputError::TooLarge { path: path.to_owned(), limit });
    }
    Ok(())
}

fn decode(path: &Path, bytes: Vec<u8>) -> Result<String, InputError> {
    check_text(path, &bytes)?;
    String::from_utf8(bytes).map_err(|error| {
        let (offset, bytes) = (error.utf8_error().valid_up_to(), error.as_bytes());
        let line = bytes[..offset].iter().filter(|byte| **byte == b'\n').count() + 1;
        InputError::NotUtf8 { path: path.to_owned(), line, offset, byte: bytes[offset] }
    })
}

fn check_text(path: &Path, bytes: &[u8]) -> Result<(), InputError> {
    match bytes.iter().position(|&byte| byte == 0) {
        Some(offset) => Err(InputError::Binary { path: path.to_owned(), offset }),
        None => Ok(()),
    }
}
