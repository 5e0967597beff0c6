//! Which known word an unknown one was meant to be.

/// Least likeness, from 0 to 1, of words that may be meant for each other.
const LIKE: f64 = 0.8;

/// Longer words are nobody's slip of a key, and likeness takes the square of the length \[bytes\].
const LONGEST: usize = 64;

/// The known name that is nearest to an unknown one, if one is near; of equally near ones the first.
pub fn nearest<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let name = name.to_lowercase();
    if name.len() > LONGEST {
        return None;
    }
    let mut best = None;
    for known in known {
        let like = strsim::jaro_winkler(&name, &known.to_lowercase());
        if like >= best.map_or(LIKE, |(most, _)| most) && best.is_none_or(|(most, _)| like > most) {
            best = Some((like, known));
        }
    }
    best.map(|(_, known)| known)
}

/// Whether that was meant.
pub(crate) fn question(name: &str) -> String {
    format!("did you mean `{name}`?")
}
