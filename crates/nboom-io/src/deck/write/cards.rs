use std::fmt::Write;

/// Longest card that is written, in characters.
const WIDTH: usize = 72;

/// Cards of a deck.
#[derive(Debug, Default)]
pub(super) struct Cards {
    pub text: String,
}

impl Cards {
    /// A card that only people read.
    pub fn comment(&mut self, comment: &str) {
        let _ = writeln!(self.text, "! {}", comment.replace(char::is_control, "\u{fffd}"));
    }

    /// A group with what `fill` puts into it.
    pub fn group(&mut self, name: &str, fill: impl FnOnce(&mut Self)) {
        let _ = writeln!(self.text, " {name}");
        fill(self);
        self.text.push_str(" &END\n");
    }

    /// An assignment, over as many cards as it takes; none without values.
    pub fn values(&mut self, name: &str, values: &[f64]) {
        let words = values.chunk_by(|a, b| a == b).map(|equal| match equal.len() {
            1 => format!("{:?},", equal[0]),
            count => format!("{count}*{:?},", equal[0]),
        });
        self.words(name, words);
    }

    /// As [`Self::values`], but nothing where all are zero, which is their value by default.
    pub fn unless_zero(&mut self, name: &str, values: &[f64]) {
        if values.iter().any(|value| *value != 0.0) {
            self.values(name, values);
        }
    }

    pub fn integers(&mut self, name: &str, values: &[usize]) {
        self.words(name, values.iter().map(|value| format!("{value},")));
    }

    fn words(&mut self, name: &str, words: impl Iterator<Item = String>) {
        let (mut card, mut has_words) = (format!(" {name}="), false);
        for word in words {
            if has_words && card.len() + word.len() > WIDTH {
                let _ = writeln!(self.text, "{card}");
                card = " ".to_owned();
            }
            card.push_str(&word);
            has_words = true;
        }
        if has_words {
            let _ = writeln!(self.text, "{card}");
        }
    }
}
