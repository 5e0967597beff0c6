//! Files that are no decks.

use std::error::Error;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use nboom_io::{InputError, read_scene};

use super::SMALL_DECK;

/// A file of this test run, removed in the end.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str, bytes: &[u8]) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::write(&path, bytes).expect("the scratch directory takes files");
        Self(path)
    }

    fn read(&self) -> Result<nboom_io::SceneFile, InputError> {
        read_scene(&self.0)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

#[test]
fn a_deck_is_named_after_its_file() {
    for name in ["boom one.nml", "boom one.NML"] {
        let file = Scratch::new(name, SMALL_DECK.as_bytes()).read().expect("the deck is right");
        assert_eq!(file.scene.name, "boom one");
    }
}

#[test]
fn errors_name_the_file() {
    let file = Scratch::new("wrong.nml", SMALL_DECK.replace("EMM=", "EMN=").as_bytes());
    let error = file.read().unwrap_err();
    assert!(error.to_string().contains("wrong.nml:14:2: &NXPUT: found `EMN`"), "{error}");
}

#[test]
fn other_endings_are_refused_with_what_is_accepted() {
    for name in ["scene.json", "scene", "nml"] {
        let file = Scratch::new(name, SMALL_DECK.as_bytes());
        let error = file.read().unwrap_err();
        assert!(matches!(error, InputError::NotAScene { .. }));
        assert!(error.to_string().contains(".nml"));
    }
}

#[test]
fn a_missing_file_and_a_directory() {
    let scratch = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let error = read_scene(&scratch.join("missing.nml")).unwrap_err();
    assert!(matches!(error, InputError::Io { .. }));
    assert!(error.source().is_some());
    assert!(matches!(read_scene(scratch), Err(InputError::NotAFile { .. })));
}

#[test]
fn an_empty_file_lacks_its_groups() {
    let Err(InputError::Content(errors)) = Scratch::new("empty.nml", b"").read() else {
        panic!("errors expected");
    };
    let symbols: Vec<_> = errors.iter().map(|e| (&*e.symbol, e.line, e.column)).collect();
    assert_eq!(symbols, [("&DIM", 1, 1), ("&NXPUT", 1, 1), ("&ROCK", 1, 1)]);
}

#[test]
fn a_zero_byte_is_no_text() {
    let file = Scratch::new("binary.nml", b" &DIM\n\0\x01\x02");
    assert!(matches!(file.read(), Err(InputError::Binary { offset: 6, .. })));
}

#[test]
fn other_encodings_only_in_comments() {
    let latin = |text: &str| -> Vec<u8> {
        let byte = |c| if c == 'Ä' { 0xC4 } else { c as u8 };
        text.chars().map(byte).collect()
    };
    let comment = SMALL_DECK.replace("EMM=100.0,", "EMM=100.0, ! Äußeres");
    let comment = comment.replace("ß", "Ä");
    assert!(Scratch::new("latin-comment.nml", &latin(&comment)).read().is_ok());
    let card = SMALL_DECK.replace("EMM=100.0,", "EMM=10Ä.0,");
    let Err(InputError::Content(errors)) = Scratch::new("latin-card.nml", &latin(&card)).read()
    else {
        panic!("errors expected");
    };
    assert_eq!((errors.len(), errors[0].line, errors[0].column), (1, 14, 8));
}

#[test]
fn scenes_and_robots_are_utf_8() {
    for name in ["latin.toml", "latin.urdf"] {
        let Err(error) = Scratch::new(name, b"# fine\nname = \"M\xC4rz\"\n").read() else {
            panic!("{name}: an error expected");
        };
        assert!(matches!(error, InputError::NotUtf8 { line: 2, offset: 16, byte: 0xC4, .. }));
        let message = ":2: found the byte 0xC4 at offset 16, expected text in UTF-8";
        assert!(error.to_string().ends_with(message), "{error}");
    }
}

#[test]
fn a_hundred_megabytes_are_refused_at_once() {
    let file = Scratch::new("large.nml", b"");
    File::options()
        .write(true)
        .open(&file.0)
        .and_then(|file| file.set_len(100_000_000))
        .expect("the scratch directory takes sparse files");
    let start = Instant::now();
    assert!(matches!(file.read(), Err(InputError::TooLarge { limit: 16_777_216, .. })));
    assert!(start.elapsed() < Duration::from_secs(1));
}
