//! Where bytes of a text stand.

use crate::diagnostic::Position;

/// The lines of a text.
pub(super) struct Lines<'t> {
    text: &'t str,
    /// Where each begins \[bytes\].
    starts: Vec<usize>,
}

impl<'t> Lines<'t> {
    pub fn of(text: &'t str) -> Self {
        let ends = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n');
        Self { text, starts: std::iter::once(0).chain(ends.map(|(at, _)| at + 1)).collect() }
    }

    /// The place of a byte that begins a character.
    pub fn position(&self, at: usize) -> Position {
        let line = self.starts.partition_point(|&start| start <= at);
        let before = self.text.get(self.starts[line - 1]..at).unwrap_or_default();
        Position { line, column: before.chars().count() + 1 }
    }
}
