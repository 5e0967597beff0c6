//! Text in which nothing hides: names come from files of others.

/// Whether a character is not seen and steers what is: controls, line ends among them, marks that turn the direction of
/// text, what has no width, and what XML has no room for.
pub fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}')
}

/// A text in which a mark stands for each character that [`steers`].
pub fn visible(text: &str) -> String {
    text.replace(steers, "\u{fffd}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_seen_stays_and_what_is_not_becomes_a_mark() {
        let plain = "Ø, \u{65e5}\u{672c}, 1\u{202f}°, \u{1f6f0}";
        assert_eq!(visible(plain), plain);
        let hidden = "a\u{1b}b\tc\u{202e}d\u{200b}e\u{feff}f\u{ffff}g";
        assert_eq!(visible(hidden), "a\u{fffd}b\u{fffd}c\u{fffd}d\u{fffd}e\u{fffd}f\u{fffd}g");
    }
}
