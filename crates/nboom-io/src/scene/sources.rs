//! The files that a scene is written in.

use std::ops::Range;

use crate::diagnostic::Position;

/// Where something stands: bytes of a file, by its number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Place {
    pub file: usize,
    pub bytes: Range<usize>,
}

/// The files of a scene, the scene's own first.
#[derive(Debug, Default)]
pub(crate) struct Sources {
    files: Vec<Source>,
}

#[derive(Debug)]
struct Source {
    name: String,
    text: String,
    /// Where lines start, in bytes.
    lines: Vec<usize>,
}

impl Sources {
    /// Adds a file, and returns its number.
    pub fn add(&mut self, name: &str, text: String) -> usize {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        let lines = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        self.files.push(Source { name: name.to_owned(), text, lines });
        self.files.len() - 1
    }

    pub fn name(&self, file: usize) -> &str {
        &self.files[file].name
    }

    pub fn text(&self, file: usize) -> &str {
        &self.files[file].text
    }

    /// Line and column of a place, the text of that line, and how many of its characters are meant.
    pub fn locate(&self, place: &Place) -> (Position, &str, usize) {
        let Source { text, lines, .. } = &self.files[place.file];
        let start = floor(text, place.bytes.start);
        let line = lines.partition_point(|&at| at <= start) - 1;
        let line_end = lines.get(line + 1).map_or(text.len(), |next| next - 1);
        let of_line = text[lines[line]..line_end].trim_end_matches('\r');
        let end = floor(text, place.bytes.end).clamp(start, lines[line] + of_line.len());
        let column = characters(&text[lines[line]..start]) + 1;
        let marked = characters(&text[start.min(end)..end]);
        (Position { line: line + 1, column }, of_line, marked)
    }
}

/// How many characters a text has; quick, since a line may be as long as a file.
fn characters(text: &str) -> usize {
    let starts_one = |byte: &&u8| (**byte as i8) >= -0x40;
    text.as_bytes().iter().filter(starts_one).count()
}

/// The last boundary between characters up to a byte.
fn floor(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|&at| text.is_char_boundary(at)).unwrap_or_default()
}
