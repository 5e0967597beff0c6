//! Where bytes of a text stand.

use crate::diagnostic::Position;

/// Characters are counted up to every so many bytes, so that a place is found at once in a file of one line.
const STRIDE: usize = 4096;

/// The lines of a text.
pub(super) struct Lines<'t> {
    text: &'t [u8],
    /// Where each begins \[bytes\].
    starts: Vec<usize>,
    /// How many characters begin before every so many bytes.
    characters: Vec<usize>,
}

impl<'t> Lines<'t> {
    pub fn of(text: &'t str) -> Self {
        let text = text.as_bytes();
        let ends = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n');
        let starts = std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect();
        let mut characters = vec![0];
        for piece in text.chunks(STRIDE) {
            characters.extend(characters.last().map(|before| before + count(piece)));
        }
        Self { text, starts, characters }
    }

    /// The place of a byte that begins a character.
    pub fn position(&self, at: usize) -> Position {
        let line = self.starts.partition_point(|&start| start <= at);
        let before = self.characters_before(at) - self.characters_before(self.starts[line - 1]);
        Position { line, column: before + 1 }
    }

    fn characters_before(&self, at: usize) -> usize {
        let piece = at / STRIDE;
        self.characters[piece] + count(&self.text[piece * STRIDE..at])
    }
}

/// How many characters begin among these bytes.
fn count(bytes: &[u8]) -> usize {
    let continues = |byte: &u8| (0x80..0xc0).contains(byte);
    bytes.iter().filter(|byte| !continues(byte)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_count_characters_of_the_line() {
        let text = format!("é\n{}x", "aØ→".repeat(STRIDE));
        let lines = Lines::of(&text);
        for (at, line, column) in [(0, 1, 1), (2, 1, 2), (3, 2, 1), (4, 2, 2), (6, 2, 3)] {
            assert_eq!(lines.position(at), Position { line, column });
        }
        for at in [text.len() - 1, text.len()] {
            let column = text[3..at].chars().count() + 1;
            assert_eq!(lines.position(at), Position { line: 2, column });
        }
    }
}
