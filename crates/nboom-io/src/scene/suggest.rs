//! Which known word an unknown one was meant to be.

/// Least likeness, from 0 to 1, of words that may be meant for each other.
const LIKE: f64 = 0.8;

/// A question with the known name that is nearest to an unknown one, if one is near.
pub(crate) fn nearest<'n>(name: &str, known: impl Iterator<Item = &'n str>) -> Option<String> {
    let name = name.to_lowercase();
    // Longer words are nobody's slip of a key, and likeness takes the square of the length.
    if name.len() > 64 {
        return None;
    }
    let like = known.map(|known| (strsim::jaro_winkler(&name, &known.to_lowercase()), known));
    let best = like.filter(|(like, _)| *like >= LIKE).max_by(|a, b| a.0.total_cmp(&b.0));
    best.map(|(_, known)| format!("did you mean `{known}`?"))
}
