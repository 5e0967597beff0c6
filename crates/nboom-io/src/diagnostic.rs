use std::fmt;

/// Reading stops when a deck has this many errors; warnings beyond this many are dropped.
pub(crate) const MOST_KEPT: usize = 1000;

/// One error or warning at one place of an input file.
///
/// Shown as `file:line:column: SYMBOL: found X, expected Y`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Name of the file, as the caller gave it.
    pub file: String,
    /// Line (card), from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// The deck's own name of the value, with subscripts from 1 where one element is meant; the
    /// group (`&NXPUT`) or `deck` where no symbol is concerned.
    pub symbol: String,
    /// What the file says.
    pub found: String,
    /// What would have been right; in a warning, also how the value is taken.
    pub expected: String,
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, column, symbol, found, expected } = self;
        write!(f, "{file}:{line}:{column}: {symbol}: found {found}, expected {expected}")
    }
}

/// Line and column, both from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Position {
    pub line: usize,
    pub column: usize,
}

impl Position {
    pub const START: Self = Self { line: 1, column: 1 };
}

/// Collects what is found while a file is read.
pub(crate) struct Report<'f> {
    file: &'f str,
    pub errors: Vec<Diagnostic>,
    pub warnings: Vec<Diagnostic>,
}

impl<'f> Report<'f> {
    pub fn new(file: &'f str) -> Self {
        Self { file, errors: Vec::new(), warnings: Vec::new() }
    }

    pub fn error(
        &mut self,
        at: Position,
        symbol: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) {
        let diagnostic = self.diagnostic(at, symbol, found.into(), expected.into());
        push_bounded(&mut self.errors, diagnostic);
    }

    pub fn warn(
        &mut self,
        at: Position,
        symbol: &str,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) {
        let diagnostic = self.diagnostic(at, symbol, found.into(), expected.into());
        push_bounded(&mut self.warnings, diagnostic);
    }

    /// Whether reading on is of no use.
    pub fn is_full(&self) -> bool {
        self.errors.len() >= MOST_KEPT
    }

    pub fn sort(&mut self) {
        self.errors.sort_by_key(|d| (d.line, d.column));
        self.warnings.sort_by_key(|d| (d.line, d.column));
    }

    fn diagnostic(
        &self,
        at: Position,
        symbol: &str,
        found: String,
        expected: String,
    ) -> Diagnostic {
        let (file, symbol) = (self.file.to_owned(), symbol.to_owned());
        Diagnostic { file, line: at.line, column: at.column, symbol, found, expected }
    }
}

fn push_bounded(list: &mut Vec<Diagnostic>, diagnostic: Diagnostic) {
    if list.len() < MOST_KEPT {
        list.push(diagnostic);
    }
}

/// A piece of the input in quotes, shortened if it is long, with control characters replaced, which
/// would reach the terminal.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    let visible = |c: char| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c };
    let shown: String = text.chars().take(LONGEST).map(visible).collect();
    let dots = if text.chars().nth(LONGEST).is_some() { "..." } else { "" };
    format!("`{shown}{dots}`")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagnostic_reads_like_a_compiler_message() {
        let mut report = Report::new("a.nml");
        report.error(Position { line: 3, column: 7 }, "EMM", "`x`", "a number");
        assert_eq!(report.errors[0].to_string(), "a.nml:3:7: EMM: found `x`, expected a number");
    }

    #[test]
    fn long_text_is_cut_between_characters() {
        assert_eq!(quoted("ab"), "`ab`");
        assert_eq!(quoted("\u{1b}[2J"), "`\u{fffd}[2J`");
        assert_eq!(quoted(&"Ø".repeat(50)), format!("`{}...`", "Ø".repeat(40)));
    }

    #[test]
    fn memory_for_messages_is_bounded() {
        let mut report = Report::new("a.nml");
        for _ in 0..2 * MOST_KEPT {
            report.error(Position::START, "X", "a", "b");
            report.warn(Position::START, "X", "a", "b");
        }
        assert_eq!((report.errors.len(), report.warnings.len()), (MOST_KEPT, MOST_KEPT));
        assert!(report.is_full());
    }
}
