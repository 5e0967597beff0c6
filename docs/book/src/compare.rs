//! Whether two texts say the same, but for the rounding of numbers.

/// Relative difference of numbers that are the same.
const NEAR: f64 = 1e-5;
/// Below this a number of an account is rounding itself.
const ROUNDING: f64 = 1e-7;

/// Whether the lines expected are those found; a line `...` stands for any number of lines.
pub fn lines(expected: &[&str], found: &[&str]) -> bool {
    match expected.split_first() {
        None => found.is_empty(),
        Some((&"...", rest)) => (0..=found.len()).any(|from| lines(rest, &found[from..])),
        Some((first, rest)) => found
            .split_first()
            .is_some_and(|(line, more)| text(first, line, 0.0) && lines(rest, more)),
    }
}

/// Whether texts agree in all but blanks and in numbers within tolerances; `size` is that of numbers
/// by which they may differ, whatever they are.
pub fn text(one: &str, other: &str, size: f64) -> bool {
    let (one, other) = (pieces(one), pieces(other));
    one.len() == other.len() && one.iter().zip(&other).all(|(a, b)| same(a, b, size))
}

fn same(a: &str, b: &str, size: f64) -> bool {
    match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => {
            let most = a.abs().max(b.abs());
            (a - b).abs() <= size.max(NEAR * most) || most < ROUNDING
        }
        _ => a == b,
    }
}

/// Words and numbers.
fn pieces(text: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '.' | '-' | '+');
    let mut found = Vec::new();
    for word in text.split_whitespace() {
        let mut rest = word;
        while !rest.is_empty() {
            let end = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
            let end = if end == 0 { rest.chars().next().map_or(1, char::len_utf8) } else { end };
            found.push(&rest[..end]);
            rest = &rest[end..];
        }
    }
    found
}

#[test]
fn numbers_may_be_rounded_and_words_may_not() {
    assert!(text("energy 2.0e-10 (relative)", "energy  2.6e-10 (relative)", 0.0));
    assert!(text("lock up 1,1 2623.1765", "lock up 1,1 2623.17651", 0.0));
    assert!(!text("lock up 1,1 2623.1765", "lock up 1,1 2624", 0.0));
    assert!(!text("locked", "free", 0.0));
    assert!(lines(&["a", "...", "d"], &["a", "b", "c", "d"]));
    assert!(!lines(&["a", "d"], &["a", "b", "d"]));
}
