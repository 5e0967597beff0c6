//! The font of all figures: widths of text, and shapes of letters.

use std::sync::LazyLock;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use ttf_parser::{Face, GlyphId};

use crate::sheet::{Anchor, Place, RAISED_BY, RAISED_SIZE, Words};

/// The font, see `font/README.md`.
const TEXT: &str = include_str!("../font/sans.ttf.base64");

/// What stands for a letter that the font does not have.
const MISSING: char = '\u{25a1}';

/// The file of the font.
pub(crate) static FILE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let text: String = TEXT.split_ascii_whitespace().collect();
    STANDARD.decode(text).expect("a test decodes it")
});

pub(crate) static FACE: LazyLock<Face<'static>> =
    LazyLock::new(|| Face::parse(&FILE, 0).expect("a test parses it"));

/// Whether the font has a letter.
pub(crate) fn has(letter: char) -> bool {
    FACE.glyph_index(letter).is_some()
}

/// The shape of a letter.
pub(crate) fn glyph(letter: char) -> GlyphId {
    let of = |letter| FACE.glyph_index(letter);
    of(letter).or_else(|| of(MISSING)).unwrap_or_default()
}

/// Width of a shape, as a share of the size of the text.
pub(crate) fn advance(glyph: GlyphId) -> f64 {
    let units = f64::from(FACE.units_per_em());
    f64::from(FACE.glyph_hor_advance(glyph).unwrap_or(0)) / units
}

/// Width of a text of this size.
pub(crate) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(|letter| advance(glyph(letter))).sum::<f64>() * size
}

/// A part of some words in letters of one size.
pub(crate) struct Part<'w> {
    pub text: &'w str,
    pub size: f64,
    /// Where its base line begins.
    pub at: Place,
}

/// The text of some words and its exponent, one after the other.
pub(crate) fn parts(words: &Words) -> [Part<'_>; 2] {
    let Words { text, raised, size, at: [x, y], .. } = words;
    let small = RAISED_SIZE * size;
    let length = width(text, *size);
    let back = match words.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5 * (length + width(raised, small)),
        Anchor::End => length + width(raised, small),
    };
    // Along the line of text, and above it.
    let place = |along: f64, above: f64| {
        if words.upward { [x - above, y - along] } else { [x + along, y - above] }
    };
    [
        Part { text, size: *size, at: place(-back, 0.0) },
        Part { text: raised, size: small, at: place(length - back, RAISED_BY * size) },
    ]
}

/// The text, or as much of it as there is room for.
pub(crate) fn fitted(text: &str, size: f64, room: f64) -> String {
    if width(text, size) <= room {
        return text.to_owned();
    }
    let mut room = room - width("…", size);
    let fits = |letter: &char| {
        room -= advance(glyph(*letter)) * size;
        room >= 0.0
    };
    let kept: String = text.chars().take_while(fits).collect();
    kept.trim_end().to_owned() + "…"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_arial() {
        // Of its 2048 units: published widths of the letters.
        for (letter, units) in [('A', 1366.0), ('i', 455.0), ('0', 1139.0), (' ', 569.0)] {
            assert_eq!(width(&letter.to_string(), 2048.0), units, "{letter}");
        }
        assert_eq!(glyph('\u{4e2d}'), glyph(MISSING));
        for letter in "°×·−…²³ωβσθΣ’→Жéß".chars() {
            assert_ne!(glyph(letter), glyph(MISSING), "{letter}");
        }
    }

    #[test]
    fn long_texts_are_cut() {
        assert_eq!(fitted("panel", 10.0, 100.0), "panel");
        let cut = fitted("a panel with a long name", 10.0, 60.0);
        assert!(cut.ends_with('…') && width(&cut, 10.0) <= 60.0, "{cut}");
        assert_eq!(fitted("panel", 10.0, 0.0), "…");
    }
}
