//! Decks with something changed.

use std::ops::Range;

use fastrand::Rng;
use nboom_io::{Extent, Group, NumberKind, Numbering, SYMBOLS, Symbol};

use super::text::{self, one_of};

/// One of the decks after some changes.
pub fn changed(rng: &mut Rng, decks: &[String]) -> Vec<u8> {
    let mut deck = decks[rng.usize(..decks.len())].clone();
    // One change says most about the place where it stands; some decks are changed beyond all sense.
    let changes = one_of(rng, &[1, 1, 1, 2, 2, 3, 5, 12]);
    // Of what is changed anywhere, nearly all is refused: most decks should still be decks.
    if rng.u32(..10) < 6 {
        for _ in 0..changes {
            match rng.bool() {
                true => change_value(rng, &mut deck),
                false => assign(rng, &mut deck, within),
            }
        }
        return deck.into_bytes();
    }
    for _ in 0..changes {
        match rng.u32(..12) {
            0..3 => text::change_number(rng, &mut deck),
            3 => text::swap_numbers(rng, &mut deck),
            4 => text::change_lines(rng, &mut deck),
            5 => rename(rng, &mut deck),
            6 => subscript(rng, &mut deck),
            7 => repeat(rng, &mut deck),
            8..10 => assign(rng, &mut deck, anywhere),
            10 => take_line(rng, &mut deck, decks),
            _ => remove(rng, &mut deck),
        }
    }
    text::bytes(rng, deck)
}

/// What nearly any other number would make a scene that cannot be.
const RESTRAINED: &[&str] = &["HIIK", "HM", "EMO", "X", "EKBAR", "FTHAT", "GHAT", "DLI", "TSK"];

/// Whether the numbers of a symbol may be any.
fn is_free(name: &str) -> bool {
    let plain = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let of_name = SYMBOLS.iter().find(|symbol| [name, plain].contains(&symbol.name));
    of_name
        .is_some_and(|symbol| symbol.kind == NumberKind::Real && !RESTRAINED.contains(&symbol.name))
}

/// A number that may be any becomes another one.
fn change_value(rng: &mut Rng, deck: &mut String) {
    let names = names(deck);
    let is_value = |place: &Range<usize>| {
        let name = names.iter().rev().find(|name| name.end <= place.start);
        let bytes = deck.as_bytes();
        let is_subscript = matches!(bytes[place.start - 1], b'(')
            || matches!(bytes.get(place.end), Some(b')' | b'*'))
            || deck[..place.start].rfind('(') > deck[..place.start].rfind([')', '=']);
        !is_subscript && name.is_some_and(|name| is_free(&deck[name.clone()]))
    };
    let places: Vec<_> = text::numbers(deck).into_iter().filter(is_value).collect();
    let Some(place) = rng.choice(places) else { return };
    let mut number = deck[place.clone()].to_owned();
    text::change_number(rng, &mut number);
    deck.replace_range(place, &number);
}

/// Where names stand that something is assigned to.
fn names(deck: &str) -> Vec<Range<usize>> {
    let bytes = deck.as_bytes();
    let is_name = |b: u8| b.is_ascii_alphanumeric();
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let end = (at..bytes.len()).find(|&i| !is_name(bytes[i])).unwrap_or(bytes.len());
        if end > at
            && bytes[at].is_ascii_alphabetic()
            && matches!(bytes.get(end), Some(b'=' | b'('))
        {
            found.push(at..end);
        }
        at = end + 1;
    }
    found
}

fn symbol(rng: &mut Rng) -> (&'static Symbol, String) {
    let symbol = &SYMBOLS[rng.usize(..SYMBOLS.len())];
    let number = match symbol.numbering {
        Numbering::None => String::new(),
        Numbering::Segment => format!("{}", rng.u32(..6)),
        Numbering::SegmentAndStation => format!("{}{}", rng.u32(..6), rng.u32(..6)),
    };
    (symbol, format!("{}{number}", symbol.name))
}

fn rename(rng: &mut Rng, deck: &mut String) {
    let Some(place) = rng.choice(names(deck)) else { return };
    let (_, name) = symbol(rng);
    deck.replace_range(place, &name);
}

/// A subscript changes, or comes where there was none.
fn subscript(rng: &mut Rng, deck: &mut String) {
    let Some(place) = rng.choice(names(deck)) else { return };
    let end = match deck[place.end..].find(')') {
        Some(length) if deck[place.end..].starts_with('(') => place.end + length + 1,
        _ => place.end,
    };
    let subscripts: Vec<String> =
        (0..rng.usize(1..4)).map(|_| rng.i32(-1..7).to_string()).collect();
    let huge = ["(99999999999)", "(1,99999999999999999999)", "()", "(1,", "(1:2)", "(,)"];
    let new = match rng.u32(..6) {
        0 => one_of(rng, &huge).to_owned(),
        _ => format!("({})", subscripts.join(",")),
    };
    deck.replace_range(place.end..end, &new);
}

/// A number comes many times.
fn repeat(rng: &mut Rng, deck: &mut String) {
    let Some(place) = rng.choice(text::numbers(deck)) else { return };
    let times =
        ["0", "2", "3", "9", "1000", "65536", "99999999", "99999999999999999999", "-1", "1.5"];
    let times = one_of(rng, &times);
    deck.insert_str(place.start, &format!("{times}*"));
}

/// One number of a symbol, at a place that most scenes have.
fn within(rng: &mut Rng) -> (&'static Symbol, String) {
    let free: Vec<&Symbol> = SYMBOLS
        .iter()
        .filter(|symbol| is_free(symbol.name) && matches!(symbol.group, Group::Nxput | Group::Rock))
        .collect();
    let symbol = free[rng.usize(..free.len())];
    let subscript = |extent: &Extent| match extent {
        Extent::Fixed(count) => rng.usize(1..=*count).to_string(),
        _ => rng.u32(1..3).to_string(),
    };
    let subscripts: Vec<String> = symbol.shape.iter().map(subscript).collect();
    let place =
        if subscripts.is_empty() { String::new() } else { format!("({})", subscripts.join(",")) };
    let assigned = format!("{}{place}={}", symbol.name, value(rng));
    (symbol, assigned)
}

/// Any numbers of a symbol, which may be too many.
fn anywhere(rng: &mut Rng) -> (&'static Symbol, String) {
    let (symbol, name) = symbol(rng);
    let subscript = match symbol.shape.len() {
        1 if rng.bool() => format!("({})", rng.u32(1..5)),
        2 => format!("({},{})", rng.u32(1..5), rng.u32(1..4)),
        _ => String::new(),
    };
    let count = one_of(rng, &[1, 1, 1, 2, 3, 4]);
    let values: Vec<String> = (0..count).map(|_| value(rng)).collect();
    (symbol, format!("{name}{subscript}={}", values.join(",")))
}

/// Something is assigned at the end of a group, mostly the group of the symbol.
fn assign(rng: &mut Rng, deck: &mut String, any: fn(&mut Rng) -> (&'static Symbol, String)) {
    let (symbol, assigned) = any(rng);
    let heads: Vec<usize> = deck.match_indices("&END").map(|(at, _)| at).collect();
    let of_group = deck.to_uppercase().find(&format!("&{:?}\n", symbol.group).to_uppercase());
    let end = of_group.and_then(|head| heads.iter().copied().find(|&at| at > head));
    let Some(end) = end.filter(|_| rng.u32(..10) > 0).or_else(|| rng.choice(heads)) else { return };
    deck.insert_str(end, &format!("{assigned},\n "));
}

fn value(rng: &mut Rng) -> String {
    match rng.u32(..4) {
        0 => rng.i32(-2..6).to_string(),
        1 => format!("{:?}", 200.0 * (rng.f64() - 0.5)),
        2 => format!("{:?}", (rng.f64() - 0.5) * 10_f64.powi(rng.i32(-12..13))),
        _ => {
            let mut any = "0.5".to_owned();
            text::change_number(rng, &mut any);
            any
        }
    }
}

/// A line of another deck.
fn take_line(rng: &mut Rng, deck: &mut String, decks: &[String]) {
    let other = &decks[rng.usize(..decks.len())];
    let Some(line) = rng.choice(other.lines().collect::<Vec<_>>()) else { return };
    let ends: Vec<usize> = deck.match_indices('\n').map(|(at, _)| at + 1).collect();
    let Some(at) = rng.choice(ends) else { return };
    deck.insert_str(at, &format!("{line}\n"));
}

/// A whole assignment goes.
fn remove(rng: &mut Rng, deck: &mut String) {
    let places = names(deck);
    if places.is_empty() {
        return;
    }
    let which = rng.usize(..places.len());
    let end = places.get(which + 1).map_or(deck.len(), |next| next.start);
    let end = deck[..end].rfind("&END").filter(|&at| at > places[which].start).unwrap_or(end);
    deck.replace_range(places[which].start..end, "");
}
