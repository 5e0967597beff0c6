//! Texts of others within a page.

use nboom_model::visible;

/// Text for an element or a quoted attribute of HTML or XML, [`visible`].
pub fn escaped(text: &str) -> String {
    let text = visible(text);
    [('&', "&amp;"), ('<', "&lt;"), ('>', "&gt;"), ('"', "&quot;"), ('\'', "&#39;")]
        .into_iter()
        .fold(text, |text, (from, to)| text.replace(from, to))
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
