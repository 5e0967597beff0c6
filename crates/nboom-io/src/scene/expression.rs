//! Arithmetic in texts that stand for numbers.
//!
//! An expression has numbers, parameters `$name`, `+`, `-`, `*`, `/` and brackets.

use crate::diagnostic::quoted;

/// Deepest nesting of brackets and signs.
const DEEPEST: usize = 100;

/// What is wrong with an expression, and where, in bytes from its start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ExpressionError {
    pub at: usize,
    pub found: String,
    pub expected: String,
}

/// The value of a parameter by its name, or what was found and expected in its place.
pub(crate) type Lookup<'l> = dyn FnMut(&str) -> Result<f64, (String, String)> + 'l;

/// The value of an expression; `parameter` has that of each name, or says why it has none.
pub(crate) fn evaluate<'l>(
    text: &str,
    parameter: &'l mut Lookup<'l>,
) -> Result<f64, ExpressionError> {
    let mut parser = Parser { text, at: 0, depth: 0, parameter };
    let value = parser.sum()?;
    match parser.peek() {
        None => Ok(value),
        Some(_) => Err(parser.error("an operator or the end")),
    }
}

/// Whether it is the name of a parameter.
pub(crate) fn is_name(text: &str) -> bool {
    let mut characters = text.chars();
    characters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_')
        && characters.all(is_of_name)
}

/// The names behind each `$` of a text.
pub(crate) fn names(text: &str) -> impl Iterator<Item = &str> {
    text.split('$').skip(1).map(|rest| rest.split(|c| !is_of_name(c)).next().unwrap_or_default())
}

fn is_of_name(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

struct Parser<'t, 'p> {
    text: &'t str,
    at: usize,
    depth: usize,
    parameter: &'p mut Lookup<'p>,
}

impl Parser<'_, '_> {
    fn peek(&mut self) -> Option<char> {
        let rest = &self.text[self.at..];
        self.at += rest.len() - rest.trim_start().len();
        self.text[self.at..].chars().next()
    }

    fn take(&mut self, wanted: char) -> bool {
        let is_next = self.peek() == Some(wanted);
        self.at += if is_next { wanted.len_utf8() } else { 0 };
        is_next
    }

    fn error(&self, expected: &str) -> ExpressionError {
        let rest = &self.text[self.at..];
        let word = rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len());
        let found = match rest.chars().next() {
            Some(c) => quoted(&rest[..word.max(c.len_utf8())]),
            None => "the end".to_owned(),
        };
        ExpressionError { at: self.at, found, expected: expected.to_owned() }
    }

    fn sum(&mut self) -> Result<f64, ExpressionError> {
        let mut value = self.product()?;
        loop {
            if self.take('+') {
                value += self.product()?;
            } else if self.take('-') {
                value -= self.product()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn product(&mut self) -> Result<f64, ExpressionError> {
        let mut value = self.factor()?;
        loop {
            if self.take('*') {
                value *= self.factor()?;
            } else if self.take('/') {
                value /= self.factor()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn factor(&mut self) -> Result<f64, ExpressionError> {
        if self.depth == DEEPEST {
            return Err(self.error("less deeply nested brackets"));
        }
        self.depth += 1;
        let value = if self.take('-') {
            self.factor().map(|value| -value)
        } else if self.take('(') {
            let value = self.sum()?;
            if self.take(')') { Ok(value) } else { Err(self.error("`)`")) }
        } else if self.take('$') {
            self.named()
        } else {
            self.number()
        };
        self.depth -= 1;
        value
    }

    fn named(&mut self) -> Result<f64, ExpressionError> {
        let rest = &self.text[self.at..];
        let length = rest.find(|c| !is_of_name(c)).unwrap_or(rest.len());
        let name = &rest[..length];
        if !is_name(name) {
            return Err(self.error("the name of a parameter"));
        }
        let value = (self.parameter)(name).map_err(|(found, expected)| ExpressionError {
            at: self.at,
            found,
            expected,
        });
        self.at += length;
        value
    }

    fn number(&mut self) -> Result<f64, ExpressionError> {
        self.peek();
        let rest = &self.text[self.at..];
        let is_exponent_sign = |at: usize| at > 0 && matches!(rest.as_bytes()[at - 1], b'e' | b'E');
        let is_of_number = |at: usize, c: char| {
            c.is_ascii_digit()
                || matches!(c, '.' | 'e' | 'E')
                || "+-".contains(c) && is_exponent_sign(at)
        };
        let end = rest.char_indices().find(|&(at, c)| !is_of_number(at, c));
        let length = end.map_or(rest.len(), |(at, _)| at);
        let starts_well = rest.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        match rest[..length].parse() {
            Ok(value) if starts_well => {
                self.at += length;
                Ok(value)
            }
            _ => Err(self.error("a number, a parameter `$name` or `(`")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn value(text: &str) -> Result<f64, ExpressionError> {
        evaluate(text, &mut |name| match name {
            "k" => Ok(0.5),
            _ => Err((format!("`${name}`"), "`$k`".to_owned())),
        })
    }

    #[test]
    fn arithmetic_is_what_people_expect() {
        let cases = [
            ("1 + 2 * 3", 7.0),
            ("(1 + 2) * 3", 9.0),
            ("8 / 4 / 2", 1.0),
            ("1 - 2 - 3", -4.0),
            ("-$k * 2", -1.0),
            ("--2", 2.0),
            ("1e-3*1E+3", 1.0),
            (" .5 +$k", 1.0),
        ];
        for (text, expected) in cases {
            assert_eq!(value(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_is_wrong_is_told_at_its_place() {
        let cases = [
            ("2 *", 3, "the end", "a number"),
            ("2 3", 2, "`3`", "an operator"),
            ("(2", 2, "the end", "`)`"),
            ("2 * heavy", 4, "`heavy`", "a number"),
            ("1 + $m", 5, "`$m`", "`$k`"),
            ("$", 1, "the end", "the name"),
        ];
        for (text, at, found, expected) in cases {
            let error = value(text).expect_err(text);
            assert_eq!((error.at, error.found.as_str()), (at, found), "{text}");
            assert!(error.expected.starts_with(expected), "{text}: {}", error.expected);
        }
        assert!(value(&"(".repeat(100_000)).is_err());
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn no_text_panics(text in "[-+*/()$ke0-9. é]{0,20}") {
            let _ = value(&text);
        }

        #[test]
        fn a_number_is_itself(number in prop::num::f64::POSITIVE) {
            prop_assert_eq!(value(&format!("{number:e}")), Ok(number));
        }
    }
}
