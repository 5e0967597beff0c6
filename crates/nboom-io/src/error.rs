use std::path::PathBuf;

use crate::Diagnostic;
use crate::diagnostic::MOST_KEPT;

/// Most errors that the message shows.
const MOST_SHOWN: usize = 50;

/// Most errors that it shows with their lines.
const MOST_DRAWN: usize = 10;

/// Why a file is not a scene.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum InputError {
    /// The file cannot be opened or read.
    #[error("{}: the file cannot be read", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        #[source]
        source: std::io::Error,
    },
    /// The path names a directory, a pipe or a device.
    #[error("{}", told(self.bad_file()))]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The file's name does not say what it is.
    #[error("{}", told(self.bad_file()))]
    NotAScene {
        /// The file.
        path: PathBuf,
    },
    /// A deck or a robot stands for a study.
    #[error("{}", told(self.bad_file()))]
    NotAStudy {
        /// The file.
        path: PathBuf,
    },
    /// A parameter is given for a deck or a robot.
    #[error("{file}: --set found, which only a scene in TOML with parameters can take")]
    NoParameters {
        /// The deck or the robot.
        file: String,
    },
    /// The base of what is no robot is to be fixed.
    #[error(
        "{file}: --fixed-base found, which only a robot in URDF can take; in a scene base = \"fixed\" says so"
    )]
    NoRobot {
        /// The scene or the deck.
        file: String,
    },
    /// The file is too long.
    #[error("{}", told(self.bad_file()))]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The longest file that is read \[bytes\].
        limit: u64,
    },
    /// The file contains a zero byte, so it is not text.
    #[error("{}", told(self.bad_file()))]
    Binary {
        /// The file.
        path: PathBuf,
        /// Where, in bytes from 0.
        offset: usize,
    },
    /// The file is not UTF-8.
    #[error("{}", told(self.bad_file()))]
    NotUtf8 {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// Where, in bytes from 0.
        offset: usize,
        /// The first byte that belongs to no character.
        byte: u8,
    },
    /// Everything that is wrong with a deck or a scene, in the order of its lines; reading stops at the
    /// thousandth error.
    #[error("{}", listing(.0).join("\n"))]
    Content(Vec<Diagnostic>),
}

/// A file that is not what is to be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadFile {
    /// The file, with the line if one is wrong.
    pub place: String,
    /// What is there.
    pub found: String,
    /// What would be right.
    pub expected: &'static str,
}

impl InputError {
    /// What is wrong with the file as a whole, if it is that.
    pub fn bad_file(&self) -> Option<BadFile> {
        let (path, found, expected) = match self {
            Self::NotAFile { path } => (path, "a directory or a device".to_owned(), "a file"),
            Self::NotAScene { path } => (
                path,
                "a name without a known ending".to_owned(),
                "a scene NAME.toml, a deck NAME.nml or a robot NAME.urdf",
            ),
            Self::NotAStudy { path } => {
                (path, "a deck or a robot".to_owned(), "a study NAME.toml whose scene it is")
            }
            Self::TooLarge { path, limit } => {
                (path, format!("more than {limit} bytes"), "at most that many")
            }
            Self::Binary { path, offset } => {
                (path, format!("a zero byte at offset {offset}"), "text")
            }
            Self::NotUtf8 { path, offset, byte, .. } => {
                (path, format!("the byte 0x{byte:02X} at offset {offset}"), "text in UTF-8")
            }
            _ => return None,
        };
        let place = match self {
            Self::NotUtf8 { line, .. } => format!("{}:{line}", path.display()),
            _ => path.display().to_string(),
        };
        Some(BadFile { place, found, expected })
    }

    /// The message, in pieces: one for each of the first errors of the content, and how many more there
    /// are. The first ten come with their lines.
    pub fn messages(&self) -> Vec<String> {
        match self {
            Self::Content(diagnostics) => listing(diagnostics),
            other => vec![other.to_string()],
        }
    }
}

fn told(bad: Option<BadFile>) -> String {
    bad.map_or_else(String::new, |BadFile { place, found, expected }| {
        format!("{place}: found {found}, expected {expected}")
    })
}

fn listing(diagnostics: &[Diagnostic]) -> Vec<String> {
    let shown = diagnostics.iter().take(MOST_SHOWN).enumerate();
    let told = |(i, one): (usize, &Diagnostic)| {
        if i < MOST_DRAWN { one.drawn() } else { one.to_string() }
    };
    let mut messages: Vec<String> = shown.map(told).collect();
    let more = diagnostics.len().saturating_sub(MOST_SHOWN);
    if more > 0 {
        let at_least = if diagnostics.len() >= MOST_KEPT { "at least " } else { "" };
        messages.push(format!("and {at_least}{more} more"));
    }
    messages
}

#[cfg(test)]
mod tests {
    use super::*;

    fn errors(count: usize) -> String {
        let diagnostic = |line| Diagnostic {
            file: "a.nml".to_owned(),
            line,
            column: 2,
            symbol: "EMM".to_owned(),
            found: "a".to_owned(),
            expected: "b".to_owned(),
            excerpt: None,
            help: None,
        };
        InputError::Content((1..=count).map(diagnostic).collect()).to_string()
    }

    #[test]
    fn a_long_list_of_errors_is_cut() {
        assert_eq!(errors(50).lines().count(), 50);
        assert_eq!(errors(53).lines().last(), Some("and 3 more"));
        assert_eq!(errors(MOST_KEPT).lines().last(), Some("and at least 950 more"));
    }
}
