use std::fmt;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use nboom_model::visible;

use crate::scene::{Place, Sources};

/// Reading stops when a file has this many errors; warnings beyond this many are dropped.
pub(crate) const MOST_KEPT: usize = 1000;

/// Longest line of a file that a message shows \[characters\].
const LONGEST_LINE: usize = 200;

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
    /// The file's own name of the value: a deck's symbol, with subscripts from 1 where one element is
    /// meant, or its group (`&NXPUT`); the key of a scene; `deck` or `scene` where nothing of it is
    /// concerned.
    pub symbol: String,
    /// What the file says.
    pub found: String,
    /// What would have been right; in a warning, also how the value is taken.
    pub expected: String,
    /// The line, if there is one to show.
    pub excerpt: Option<Excerpt>,
    /// What may have been meant.
    pub help: Option<String>,
}

/// A line of a file, of which some characters from a diagnostic's column on are meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The line, without control characters.
    pub line: String,
    /// How many characters are meant; at least 1.
    pub marked: usize,
}

impl Diagnostic {
    /// The message in one line, and below it the line of the file with what is meant marked.
    pub fn drawn(&self) -> String {
        let mut text = self.to_string();
        if let Some(Excerpt { line, marked }) = &self.excerpt {
            let byte = |character: usize| {
                line.char_indices().nth(character).map_or(line.len(), |(at, _)| at)
            };
            let span = byte(self.column - 1)..byte(self.column - 1 + marked);
            let line = Snippet::source(line.as_str()).line_start(self.line);
            let snippet = line.annotation(AnnotationKind::Primary.span(span));
            let group = Group::with_level(Level::ERROR).element(snippet);
            text.push('\n');
            text.push_str(&Renderer::plain().render(&[group]));
        }
        text
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, line, column, symbol, found, expected, help, .. } = self;
        write!(f, "{file}:{line}:{column}: {symbol}: found {found}, expected {expected}")?;
        help.as_ref().map_or(Ok(()), |help| write!(f, "; {help}"))
    }
}

/// Line and column, both from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

    /// An error at a place of a scene.
    pub fn error_at(
        &mut self,
        sources: &Sources,
        at: &Place,
        symbol: &str,
        found: &str,
        expected: &str,
    ) {
        self.error_with_help(sources, at, symbol, found, expected, None);
    }

    /// An error at a place of a scene, with what may have been meant.
    pub fn error_with_help(
        &mut self,
        sources: &Sources,
        at: &Place,
        symbol: &str,
        found: &str,
        expected: &str,
        help: Option<String>,
    ) {
        let diagnostic = located(sources, at, symbol, found, expected);
        push_bounded(&mut self.errors, Diagnostic { help, ..diagnostic });
    }

    /// A warning at a place of a scene.
    pub fn warn_at(
        &mut self,
        sources: &Sources,
        at: &Place,
        symbol: &str,
        found: &str,
        expected: &str,
    ) {
        push_bounded(&mut self.warnings, located(sources, at, symbol, found, expected));
    }

    /// Whether an error or a warning of this symbol at this place is there already.
    pub fn has(&self, sources: &Sources, at: &Place, symbol: &str) -> bool {
        let (Position { line, column }, ..) = sources.locate(at);
        let place = (sources.name(at.file), line, column, symbol);
        let of = |told: &Diagnostic| (&*told.file, told.line, told.column, &*told.symbol) == place;
        self.errors.iter().chain(&self.warnings).any(of)
    }

    /// Warnings that were found before.
    pub fn warn_again(&mut self, warnings: &[Diagnostic]) {
        warnings.iter().for_each(|warning| push_bounded(&mut self.warnings, warning.clone()));
    }

    /// Whether nothing is wrong so far, and all warnings are kept.
    pub fn has_all_of_a_scene(&self) -> bool {
        self.errors.is_empty() && self.warnings.len() < MOST_KEPT
    }

    /// Whether reading on is of no use.
    pub fn is_full(&self) -> bool {
        self.errors.len() >= MOST_KEPT
    }

    /// By lines, file by file, the report's own first.
    pub fn sort(&mut self) {
        let order = |a: &Diagnostic, b: &Diagnostic| {
            let [a, b] = [a, b].map(|d| (d.file != self.file, &d.file, d.line, d.column));
            a.cmp(&b)
        };
        self.errors.sort_by(order);
        self.warnings.sort_by(order);
    }

    /// Adds to each message the line of `text` that it is about.
    pub fn add_excerpts(&mut self, text: &str) {
        let lines: Vec<&str> = text.lines().collect();
        for diagnostic in self.errors.iter_mut().chain(&mut self.warnings) {
            let Some(line) = lines.get(diagnostic.line - 1) else { continue };
            if line.len() > 4 * LONGEST_LINE {
                continue;
            }
            let ends = |c: char| c.is_whitespace() || c == ',';
            let rest = line.chars().skip(diagnostic.column - 1);
            let marked = rest.take_while(|&c| !ends(c)).count();
            diagnostic.excerpt = Excerpt::of(line, diagnostic.column, marked);
        }
    }

    fn diagnostic(
        &self,
        at: Position,
        symbol: &str,
        found: String,
        expected: String,
    ) -> Diagnostic {
        let (file, symbol) = (self.file.to_owned(), symbol.to_owned());
        let Position { line, column } = at;
        Diagnostic { file, line, column, symbol, found, expected, excerpt: None, help: None }
    }
}

fn located(sources: &Sources, at: &Place, symbol: &str, found: &str, expected: &str) -> Diagnostic {
    let (Position { line, column }, text, marked) = sources.locate(at);
    Diagnostic {
        file: sources.name(at.file).to_owned(),
        line,
        column,
        symbol: symbol.to_owned(),
        found: found.to_owned(),
        expected: expected.to_owned(),
        excerpt: Excerpt::of(text, column, marked),
        help: None,
    }
}

impl Excerpt {
    /// The line with so many characters marked, unless it is empty or too long to be shown, or ends before `column`.
    pub fn of(line: &str, column: usize, marked: usize) -> Option<Self> {
        // A character has at most four bytes; longer lines are not even counted.
        if line.trim().is_empty() || line.len() > 4 * LONGEST_LINE {
            return None;
        }
        let length = line.chars().count();
        if length > LONGEST_LINE || column > length + 1 {
            return None;
        }
        Some(Self { line: visible(&line.replace('\t', " ")), marked: marked.max(1) })
    }
}

fn push_bounded(list: &mut Vec<Diagnostic>, diagnostic: Diagnostic) {
    if list.len() < MOST_KEPT {
        list.push(diagnostic);
    }
}

/// A piece of the input in quotes, shortened if it is long, in which nothing hides.
pub(crate) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    let shown: String = text.chars().take(LONGEST).collect();
    let dots = if text.chars().nth(LONGEST).is_some() { "..." } else { "" };
    format!("`{}{dots}`", visible(&shown))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_diagnostic_reads_like_a_compiler_message() {
        let mut report = Report::new("a.nml");
        report.error(Position { line: 3, column: 7 }, "EMM", "`x`", "a number");
        assert_eq!(report.errors[0].to_string(), "a.nml:3:7: EMM: found `x`, expected a number");
        report.add_excerpts("\n\n EMM= x, HM=\n");
        let drawn = report.errors[0].drawn();
        assert!(drawn.ends_with("\n  |\n3 |  EMM= x, HM=\n  |       ^"), "{drawn}");
    }

    #[test]
    fn lines_that_cannot_be_shown_are_left_out() {
        let mut report = Report::new("a.nml");
        for line in 1..=4 {
            report.error(Position { line, column: 3 }, "EMM", "x", "a number");
        }
        report.add_excerpts(&format!("é\u{7}é\t1\n{}\n\n", "x".repeat(LONGEST_LINE + 1)));
        let lines: Vec<_> = report.errors.iter().map(|error| error.excerpt.clone()).collect();
        let first = Excerpt { line: "é\u{fffd}é 1".to_owned(), marked: 1 };
        assert_eq!(lines, [Some(first), None, None, None]);
    }

    #[test]
    fn long_text_is_cut_between_characters() {
        assert_eq!(quoted("ab"), "`ab`");
        assert_eq!(quoted("\u{1b}[2J\u{202e}"), "`\u{fffd}[2J\u{fffd}`");
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
