//! Elements of which the parser, which compares each attribute with all before it, would take minutes.

/// Most attributes and namespaces of an element.
pub(super) const MOST_ATTRIBUTES: usize = 1000;

/// What is skipped as a whole, by how it begins and ends.
const SKIPPED: [(&str, &str); 3] = [("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>")];

/// The byte at which an element begins that has too many attributes. Of what is no XML the parser tells.
pub(super) fn crowded(text: &str) -> Option<usize> {
    let mut at = 0;
    while let Some(next) = text[at..].find('<') {
        at += next;
        let rest = &text[at..];
        let length = match SKIPPED.iter().find(|(start, _)| rest.starts_with(start)) {
            Some((start, end)) => {
                let inner = rest[start.len()..].find(end)?;
                start.len() + inner + end.len()
            }
            None => {
                let (attributes, length) = tag(rest);
                if attributes > MOST_ATTRIBUTES {
                    return Some(at);
                }
                length
            }
        };
        at += length;
    }
    None
}

/// How many attributes a tag has, and how long it is \[bytes\].
fn tag(text: &str) -> (usize, usize) {
    let (mut attributes, mut quote) = (0, None);
    for (at, byte) in text.bytes().enumerate() {
        match (byte, quote) {
            (b'"' | b'\'', None) => {
                attributes += 1;
                quote = Some(byte);
            }
            (b'>', None) => return (attributes, at + 1),
            (_, Some(open)) if open == byte => quote = None,
            _ => {}
        }
    }
    (attributes, text.len())
}
