//! Texts of others within a page.

/// A text in which characters that steer it and would not be seen are replaced.
pub fn visible(text: &str) -> String {
    let shown = |c: char| if steers(c) { char::REPLACEMENT_CHARACTER } else { c };
    text.chars().map(shown).collect()
}

/// Text for an element or a quoted attribute of HTML or XML, [`visible`].
pub fn escaped(text: &str) -> String {
    let text = visible(text);
    [('&', "&amp;"), ('<', "&lt;"), ('>', "&gt;"), ('"', "&quot;"), ('\'', "&#39;")]
        .into_iter()
        .fold(text, |text, (from, to)| text.replace(from, to))
}

/// Controls, marks that turn the direction of text, and what XML has no room for.
fn steers(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{2069}' | '\u{feff}' | '\u{fffe}' | '\u{ffff}')
}

/// JSON that may stand in an element of a page: nothing in it ends the element.
pub(crate) fn json(text: &str) -> String {
    let mut safe = String::with_capacity(text.len() + text.len() / 64);
    let mut written = 0;
    for (place, byte) in text.bytes().enumerate() {
        // No other byte begins one of the characters that matter.
        if !matches!(byte, b'<' | b'>' | b'&' | 0xe2) {
            continue;
        }
        let Some(c) = text[place..].chars().next() else { continue };
        if matches!(c, '<' | '>' | '&' | '\u{2028}' | '\u{2029}') {
            safe.push_str(&text[written..place]);
            safe.push_str(&format!("\\u{:04x}", u32::from(c)));
            written = place + c.len_utf8();
        }
    }
    safe + &text[written..]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_ends_the_element_that_it_stands_in() {
        let hostile = "</script><script>alert(\"1\")</script><!-- \u{2028} & 'x' \u{202e}";
        let safe = json(&serde_json::to_string(hostile).expect("text"));
        assert!(!safe.contains(['<', '>', '&', '\u{2028}']), "{safe}");
        assert_eq!(serde_json::from_str::<String>(&safe).expect("still JSON"), hostile);
        let safe = escaped(hostile);
        assert!(!safe.contains(['<', '>', '"', '\'', '\u{202e}', '\u{2028}']), "{safe}");
        assert!(safe.starts_with("&lt;/script&gt;&lt;script&gt;alert(&quot;1&quot;)"), "{safe}");
    }
}
