//! Changes of any text that has numbers and lines in it.

use std::ops::Range;

use fastrand::Rng;

/// Numbers at the ends of what there is, words that some readers take for numbers, and none.
const EXTREMES: &[&str] = &[
    "0",
    "-0.0",
    "1",
    "-1",
    "2",
    "3",
    "1e-300",
    "-1e-300",
    "1e300",
    "-1e300",
    "1.7976931348623157e308",
    "1e309",
    "4.9e-324",
    "-4.9e-324",
    "2.2250738585072014e-308",
    "1e-154",
    "1e154",
    "1e-17",
    "1e17",
    "1e10",
    "-1e10",
    "1e200",
    "1e-200",
    "9007199254740993",
    "2147483648",
    "-2147483649",
    "4294967296",
    "18446744073709551616",
    "99999999999999999999999",
    "1e6",
    "999999.9",
    "1e30",
    "360",
    "-90",
    "90",
    "1e5",
    "NaN",
    "nan",
    "Inf",
    "-inf",
    "INFINITY",
    "1e",
    ".",
    "-",
    "+",
    "1.2.3",
    "1d3",
    "0x10",
    "1_000",
    "",
];

/// Any of a list that is not empty.
pub fn one_of<T: Copy>(rng: &mut Rng, list: &[T]) -> T {
    list[rng.usize(..list.len())]
}

/// Where the numbers of a text stand.
pub fn numbers(text: &str) -> Vec<Range<usize>> {
    let bytes = text.as_bytes();
    let (mut found, mut at) = (Vec::new(), 0);
    while at < bytes.len() {
        let after_word = at > 0 && bytes[at - 1].is_ascii_alphanumeric();
        let is_start = bytes[at].is_ascii_digit()
            || (matches!(bytes[at], b'-' | b'+' | b'.')
                && bytes.get(at + 1).is_some_and(|&b| b.is_ascii_digit() || b == b'.'));
        if !is_start || after_word {
            at += 1;
            continue;
        }
        let mut end = at + 1;
        while end < bytes.len() {
            let of_exponent = matches!(bytes[end], b'-' | b'+')
                && matches!(bytes[end - 1], b'e' | b'E' | b'd' | b'D');
            if !(bytes[end].is_ascii_digit()
                || matches!(bytes[end], b'.' | b'e' | b'E' | b'd' | b'D')
                || of_exponent)
            {
                break;
            }
            end += 1;
        }
        found.push(at..end);
        at = end;
    }
    found
}

/// One number becomes another one.
pub fn change_number(rng: &mut Rng, text: &mut String) {
    let places = numbers(text);
    let Some(place) = rng.choice(places) else { return };
    let old = text[place.clone()].to_owned();
    let new = match rng.u32(..8) {
        0..3 => one_of(rng, EXTREMES).to_owned(),
        3 => match old.strip_prefix('-') {
            Some(rest) => rest.to_owned(),
            None => format!("-{old}"),
        },
        4 => format!("{}", rng.i32(-3..8)),
        5 => scaled(&old, 10_f64.powi(rng.i32(-20..21))),
        6 => scaled(&old, 1.0 + 1e-3 * (rng.f64() - 0.5)),
        _ => scaled(&old, 3.0 * (rng.f64() - 0.5)),
    };
    text.replace_range(place, &new);
}

fn scaled(number: &str, factor: f64) -> String {
    number
        .parse::<f64>()
        .map_or_else(|_| number.to_owned(), |value| format!("{:?}", value * factor))
}

/// Two numbers change places.
pub fn swap_numbers(rng: &mut Rng, text: &mut String) {
    let places = numbers(text);
    let [Some(one), Some(other)] = [rng.choice(&places), rng.choice(&places)] else { return };
    let (first, second) = if one.start < other.start { (one, other) } else { (other, one) };
    if first.end > second.start {
        return;
    }
    let [of_first, of_second] = [first, second].map(|place| text[place.clone()].to_owned());
    text.replace_range(second.clone(), &of_first);
    text.replace_range(first.clone(), &of_second);
}

/// A line is removed, doubled, or changes places with another.
pub fn change_lines(rng: &mut Rng, text: &mut String) {
    let mut lines: Vec<&str> = text.lines().collect();
    if lines.is_empty() {
        return;
    }
    let [one, other] = [(); 2].map(|()| rng.usize(..lines.len()));
    match rng.u32(..3) {
        0 => drop(lines.remove(one)),
        1 => lines.insert(other, lines[one]),
        _ => lines.swap(one, other),
    }
    *text = lines.join("\n") + "\n";
}

/// The text as bytes, mostly as it is; else cut off, or with any bytes in it.
pub fn bytes(rng: &mut Rng, text: String) -> Vec<u8> {
    let mut bytes = text.into_bytes();
    let length = bytes.len();
    match rng.u32(..20) {
        0 => bytes.truncate(rng.usize(..=length)),
        1 => (0..rng.usize(1..9)).for_each(|_| {
            if let Some(byte) = rng.choice(&mut bytes) {
                *byte = rng.u8(..);
            }
        }),
        2 => {
            let at = rng.usize(..=length);
            let pieces: [&[u8]; 8] = [
                b"\0",
                b"\xff\xfe",
                b"\x1b[2J",
                b"\r",
                b"\xef\xbb\xbf",
                b"\xc3\x28",
                "Ω".as_bytes(),
                b"\t",
            ];
            bytes.splice(at..at, one_of(rng, &pieces).iter().copied());
        }
        3 => {
            let [from, to] = [(); 2].map(|()| rng.usize(..=length));
            bytes.drain(from.min(to)..from.max(to));
        }
        _ => {}
    }
    bytes
}
