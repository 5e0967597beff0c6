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
    #[error("{}: found a directory or a device, expected a file", path.display())]
    NotAFile {
        /// The path.
        path: PathBuf,
    },
    /// The file's name does not say what it is.
    #[error(
        "{}: found a name without a known ending, expected a scene NAME.toml, a deck NAME.nml or a robot NAME.urdf",
        path.display()
    )]
    NotAScene {
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
    #[error("{}: found more than {limit} bytes, expected at most that many", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// The longest file that is read \[bytes\].
        limit: u64,
    },
    /// The file contains a zero byte, so it is not text.
    #[error("{}: found a zero byte at offset {offset}, expected text", path.display())]
    Binary {
        /// The file.
        path: PathBuf,
        /// Where, in bytes from 0.
        offset: usize,
    },
    /// The file is not UTF-8.
    #[error("{}:{line}: found the byte 0x{byte:02X} at offset {offset}, expected text in UTF-8", path.display())]
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

impl InputError {
    /// The message, in pieces: one for each of the first errors of the content, and how many more there
    /// are. The first ten come with their lines.
    pub fn messages(&self) -> Vec<String> {
        match self {
            Self::Content(diagnostics) => listing(diagnostics),
            other => vec![other.to_string()],
        }
    }
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
