//! Scenes in TOML and robots with something changed.

use fastrand::Rng;

use super::text::{self, one_of};

/// One of the texts after some changes.
pub fn changed(rng: &mut Rng, texts: &[String]) -> Vec<u8> {
    let mut text = texts[rng.usize(..texts.len())].clone();
    for _ in 0..one_of(rng, &[1, 1, 1, 2, 2, 3, 5, 12]) {
        match rng.u32(..10) {
            0..5 => text::change_number(rng, &mut text),
            5 => text::swap_numbers(rng, &mut text),
            6 => text::change_lines(rng, &mut text),
            7 => change_word(rng, &mut text),
            8 => take_line(rng, &mut text, texts),
            _ => repeat_a_part(rng, &mut text),
        }
    }
    text::bytes(rng, text)
}

/// A word, of a name or a key, becomes another one.
fn change_word(rng: &mut Rng, text: &mut String) {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let words: Vec<String> =
        text.split(|c| !is_part(c)).filter(|word| word.len() > 1).map(str::to_owned).collect();
    let [Some(one), Some(other)] = [rng.choice(&words), rng.choice(&words)] else { return };
    *text = text.replacen(one, other, 1);
}

/// A line of any of the texts comes in.
fn take_line(rng: &mut Rng, text: &mut String, texts: &[String]) {
    let from: Vec<&str> = texts[rng.usize(..texts.len())].lines().collect();
    let mut lines: Vec<&str> = text.lines().collect();
    let Some(line) = rng.choice(from) else { return };
    lines.insert(rng.usize(..=lines.len()), line);
    *text = lines.join("\n") + "\n";
}

/// Some lines come again at the end.
fn repeat_a_part(rng: &mut Rng, text: &mut String) {
    let lines: Vec<&str> = text.lines().collect();
    let from = rng.usize(..=lines.len());
    let part = lines[from..lines.len().min(from + rng.usize(1..20))].join("\n");
    text.push_str(&part);
    text.push('\n');
}
