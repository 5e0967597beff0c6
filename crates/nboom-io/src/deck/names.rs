use super::lexer::is_letter_o;
use super::number::{self, Reading};
use super::symbols::{Group, Numbering, SYMBOLS, Symbol};

/// Longer words are not compared with the known names.
const LONGEST_NAME: usize = 16;

/// A name of the table, with the numbers that are part of it (0 where there are none).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Name {
    pub symbol: &'static Symbol,
    pub segment: u64,
    pub station: u64,
}

/// The group with this name (without mark), also with 0 for O and the reverse.
pub(crate) fn find_group(word: &str) -> Option<Reading<Group>> {
    let upper = bounded_upper(word)?;
    let find = |name: &str| Group::ALL.into_iter().find(|group| &group.name()[1..] == name);
    find(&upper).map(Reading::Plain).or_else(|| find(&letters_o(&upper)).map(Reading::Repaired))
}

/// The symbol with this name, also with 0 for O and the reverse where that is no other symbol.
pub(crate) fn find(word: &str) -> Option<Reading<Name>> {
    let upper = bounded_upper(word)?;
    let exact = find_alone(&upper).or_else(|| find_numbered(&upper)).map(Reading::Plain);
    exact
        .or_else(|| find_alone(&letters_o(&upper)).map(Reading::Repaired))
        .or_else(|| find_numbered(&upper.replace(is_letter_o, "0")).map(Reading::Repaired))
}

fn bounded_upper(word: &str) -> Option<String> {
    (word.len() <= LONGEST_NAME).then(|| word.to_uppercase())
}

fn letters_o(upper: &str) -> String {
    upper.replace(['0', 'Ø'], "O")
}

fn find_alone(upper: &str) -> Option<Name> {
    let is_meant = |s: &&Symbol| {
        s.numbering == Numbering::None && (s.name == upper || s.aliases.contains(&upper))
    };
    SYMBOLS.iter().find(is_meant).map(|symbol| Name { symbol, segment: 0, station: 0 })
}

fn find_numbered(upper: &str) -> Option<Name> {
    SYMBOLS.iter().filter(|s| s.numbering != Numbering::None).find_map(|symbol| {
        let digits = upper.strip_prefix(symbol.name)?;
        let Ok(Reading::Plain(number)) = number::count(digits) else { return None };
        let name = |segment, station| Name { symbol, segment, station };
        match symbol.numbering {
            Numbering::SegmentAndStation if digits.len() < 2 => None,
            Numbering::SegmentAndStation => Some(name(number / 10, number % 10)),
            _ => Some(name(number, 0)),
        }
    })
}

/// The known name that is nearest to this unknown one, if it is near.
pub(crate) fn suggestion(word: &str) -> Option<&'static str> {
    let upper = bounded_upper(word)?;
    let allowed = if upper.chars().count() < 5 { 1 } else { 2 };
    let names = SYMBOLS.iter().flat_map(|s| s.aliases.iter().copied().chain([s.name]));
    let distances = names.filter(|name| name.len() > 1).map(|name| (distance(&upper, name), name));
    distances.filter(|(d, _)| *d <= allowed).min_by_key(|(d, _)| *d).map(|(_, name)| name)
}

/// How many letters must be inserted, left out or changed.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for j in 0..b.len() {
            let changed = diagonal + usize::from(letter != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(word: &str) -> Option<(&'static str, u64, u64, bool)> {
        find(word).map(|reading| match reading {
            Reading::Plain(n) => (n.symbol.name, n.segment, n.station, false),
            Reading::Repaired(n) => (n.symbol.name, n.segment, n.station, true),
        })
    }

    #[test]
    fn names_as_they_stand() {
        assert_eq!(found("omeg"), Some(("OMEG", 0, 0, false)));
        assert_eq!(found("HS"), Some(("GHAT", 0, 0, false)));
        assert_eq!(found("RIK1"), Some(("RIK1", 0, 0, false)));
        assert_eq!(found("TF"), Some(("TF", 0, 0, false)));
        assert_eq!(found("T10"), Some(("T", 10, 0, false)));
        assert_eq!(found("XI9"), Some(("XI", 9, 0, false)));
    }

    #[test]
    fn the_last_digit_of_a_slice_is_its_station() {
        assert_eq!(found("DLI35"), Some(("DLI", 3, 5, false)));
        assert_eq!(found("DLI154"), Some(("DLI", 15, 4, false)));
        assert_eq!(found("DLI5"), None);
    }

    #[test]
    fn zero_and_o_are_told_apart_by_the_table() {
        for word in ["0MEG", "ØMEG", "ømeg"] {
            assert_eq!(found(word), Some(("OMEG", 0, 0, true)), "{word}");
        }
        assert_eq!(found("DLI1O4"), Some(("DLI", 10, 4, true)));
        assert_eq!(found("TZ0"), Some(("TZO", 0, 0, true)));
        assert_eq!(find_group("R0CK"), Some(Reading::Repaired(Group::Rock)));
        assert_eq!(find_group("RØCK"), Some(Reading::Repaired(Group::Rock)));
        assert_eq!(find_group("rock"), Some(Reading::Plain(Group::Rock)));
    }

    #[test]
    fn no_two_symbols_share_a_name() {
        let mut names: Vec<_> =
            SYMBOLS.iter().flat_map(|s| s.aliases.iter().copied().chain([s.name])).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn suggestions_are_near() {
        assert_eq!(suggestion("EMLK"), Some("EMIK"));
        assert_eq!(suggestion("BETIK"), Some("BETAIK"));
        assert_eq!(suggestion("QQQQQQ"), None);
        assert_eq!(suggestion(&"A".repeat(1 << 20)), None);
        assert_eq!(distance("KITTEN", "SITTING"), 3);
    }
}
