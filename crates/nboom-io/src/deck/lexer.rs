use crate::diagnostic::Position;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// `&` or, first on a card, `+`, with the word after it as text.
    Mark,
    /// A word before `=` or `(`.
    Name,
    /// Any other word: a number, if all is well.
    Word,
    Equals,
    LeftParenthesis,
    RightParenthesis,
    Comma,
    Star,
    /// A character that has no place in a deck.
    Strange,
    End,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Token<'t> {
    pub kind: Kind,
    pub text: &'t str,
    pub at: Position,
    /// No blank precedes it.
    pub glued: bool,
    pub first_on_card: bool,
}

/// Cuts a deck into tokens; blanks, card ends and comments after `!` separate.
#[derive(Clone)]
pub(crate) struct Lexer<'t> {
    text: &'t str,
    offset: usize,
    at: Position,
    card_is_blank: bool,
}

impl<'t> Lexer<'t> {
    pub fn new(text: &'t str) -> Self {
        // A byte order mark is not part of the text.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Self { text, offset: 0, at: Position::START, card_is_blank: true }
    }

    /// The next token; at the end of the text always [`Kind::End`].
    pub fn next_token(&mut self) -> Token<'t> {
        let before = self.offset;
        self.skip_blanks();
        let (at, start) = (self.at, self.offset);
        let glued = before == start;
        let first_on_card = std::mem::replace(&mut self.card_is_blank, false);
        let Some(c) = self.peek() else {
            return Token { kind: Kind::End, text: "", at, glued, first_on_card };
        };
        let kind = self.kind_of(c, first_on_card);
        match kind {
            Kind::Mark => {
                self.bump();
                let text = self.word_after_mark();
                return Token { kind, text, at, glued, first_on_card };
            }
            Kind::Word => self.bump_word(),
            _ => self.bump(),
        }
        let kind = if kind == Kind::Word && self.names_a_symbol() { Kind::Name } else { kind };
        Token { kind, text: &self.text[start..self.offset], at, glued, first_on_card }
    }

    fn kind_of(&self, c: char, first_on_card: bool) -> Kind {
        match c {
            '&' => Kind::Mark,
            '+' if first_on_card && self.letters_follow_sign() => Kind::Mark,
            '=' => Kind::Equals,
            '(' => Kind::LeftParenthesis,
            ')' => Kind::RightParenthesis,
            ',' => Kind::Comma,
            '*' => Kind::Star,
            '+' | '-' => Kind::Word,
            _ if is_word(c) => Kind::Word,
            _ => Kind::Strange,
        }
    }

    fn rest(&self) -> &'t str {
        &self.text[self.offset..]
    }

    fn peek(&self) -> Option<char> {
        self.rest().chars().next()
    }

    fn bump(&mut self) {
        let Some(c) = self.peek() else { return };
        self.offset += c.len_utf8();
        if c == '\n' {
            self.at = Position { line: self.at.line + 1, column: 1 };
            self.card_is_blank = true;
        } else {
            self.at.column += 1;
        }
    }

    fn bump_while(&mut self, test: impl Fn(char) -> bool) {
        while self.peek().is_some_and(&test) {
            self.bump();
        }
    }

    fn skip_blanks(&mut self) {
        loop {
            self.bump_while(char::is_whitespace);
            if self.peek() != Some('!') {
                return;
            }
            self.bump_while(|c| c != '\n');
        }
    }

    /// A word, with its sign and the sign of its exponent if it is a number.
    fn bump_word(&mut self) {
        self.bump_if(|c| matches!(c, '+' | '-'));
        let starts_number = |c: char| c.is_ascii_digit() || c == '.' || is_letter_o(c);
        let number = self.peek().is_some_and(starts_number);
        let mut last = ' ';
        while let Some(c) = self.peek() {
            let exponent_sign =
                number && matches!(c, '+' | '-') && matches!(last, 'e' | 'E' | 'd' | 'D');
            if !is_word(c) && !exponent_sign {
                return;
            }
            self.bump();
            last = c;
        }
    }

    fn bump_if(&mut self, test: impl Fn(char) -> bool) {
        if self.peek().is_some_and(test) {
            self.bump();
        }
    }

    fn word_after_mark(&mut self) -> &'t str {
        self.bump_while(is_blank_on_card);
        let start = self.offset;
        self.bump_while(is_word);
        &self.text[start..self.offset]
    }

    fn letters_follow_sign(&self) -> bool {
        let word = self.rest()[1..].trim_start_matches(is_blank_on_card);
        let word = word.split(|c| !is_word(c)).next().unwrap_or_default();
        word.starts_with(char::is_alphabetic) && !word.contains('.')
    }

    fn names_a_symbol(&self) -> bool {
        let mut ahead = self.clone();
        ahead.skip_blanks();
        matches!(ahead.peek(), Some('=' | '('))
    }
}

pub(crate) fn is_letter_o(c: char) -> bool {
    matches!(c, 'O' | 'o' | 'Ø' | 'ø')
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || matches!(c, '.' | '_')
}

fn is_blank_on_card(c: char) -> bool {
    c.is_whitespace() && c != '\n'
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<(Kind, &str, usize, usize)> {
        let mut lexer = Lexer::new(text);
        let mut tokens = Vec::new();
        loop {
            let token = lexer.next_token();
            if token.kind == Kind::End {
                return tokens;
            }
            tokens.push((token.kind, token.text, token.at.line, token.at.column));
        }
    }

    #[test]
    fn a_card_with_blanks_everywhere() {
        use Kind::{Comma, Equals, LeftParenthesis, Name, RightParenthesis, Star, Word};
        assert_eq!(
            tokens(" QNIK ( 1 ,2) = 4 * -.5E-3 , ! rest, = 3"),
            [
                (Name, "QNIK", 1, 2),
                (LeftParenthesis, "(", 1, 7),
                (Word, "1", 1, 9),
                (Comma, ",", 1, 11),
                (Word, "2", 1, 12),
                (RightParenthesis, ")", 1, 13),
                (Equals, "=", 1, 15),
                (Word, "4", 1, 17),
                (Star, "*", 1, 19),
                (Word, "-.5E-3", 1, 21),
                (Comma, ",", 1, 28),
            ]
        );
    }

    #[test]
    fn plus_marks_a_group_only_before_letters_at_the_start_of_a_card() {
        use Kind::{Comma, Mark, Word};
        assert_eq!(tokens(" + END"), [(Mark, "END", 1, 2)]);
        assert_eq!(tokens(" +3.0"), [(Word, "+3.0", 1, 2)]);
        assert_eq!(tokens("1,+END"), [(Word, "1", 1, 1), (Comma, ",", 1, 2), (Word, "+END", 1, 3)]);
        assert_eq!(tokens("\n&ROCK"), [(Mark, "ROCK", 2, 1)]);
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(tokens("ØMEG=1")[2], (Kind::Word, "1", 1, 6));
    }

    #[test]
    fn what_has_no_place_is_one_token_each() {
        assert_eq!(tokens("$\u{fffd}").len(), 2);
        assert_eq!(tokens("\u{feff}\n"), []);
    }
}
