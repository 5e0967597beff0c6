use super::lexer::is_letter_o;

/// What a word means as a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Reading<T> {
    /// As it stands.
    Plain(T),
    /// With every letter O read as the digit 0.
    Repaired(T),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum NotANumber {
    /// Not written like a number.
    Form,
    /// Beyond the range of f64.
    Range,
}

/// A FORTRAN number: `-.5`, `30.0E6`, `1.D-3`, `+3`.
pub(crate) fn real(word: &str) -> Result<Reading<f64>, NotANumber> {
    repairing(word, plain_real)
}

/// A subscript or repetition: digits only; numbers beyond u64 are the largest u64.
pub(crate) fn count(word: &str) -> Result<Reading<u64>, NotANumber> {
    repairing(word, plain_count)
}

fn repairing<T>(
    word: &str,
    read: impl Fn(&str) -> Result<T, NotANumber>,
) -> Result<Reading<T>, NotANumber> {
    match read(word) {
        Err(NotANumber::Form) if word.contains(is_letter_o) => {
            read(&word.replace(is_letter_o, "0")).map(Reading::Repaired)
        }
        result => result.map(Reading::Plain),
    }
}

fn plain_count(word: &str) -> Result<u64, NotANumber> {
    if word.is_empty() || !word.bytes().all(|b| b.is_ascii_digit()) {
        return Err(NotANumber::Form);
    }
    Ok(word.parse().unwrap_or(u64::MAX))
}

fn plain_real(word: &str) -> Result<f64, NotANumber> {
    if !has_form_of_real(word) {
        return Err(NotANumber::Form);
    }
    let value: f64 = word.replace(['d', 'D'], "E").parse().map_err(|_| NotANumber::Form)?;
    if value.is_finite() { Ok(value) } else { Err(NotANumber::Range) }
}

fn has_form_of_real(word: &str) -> bool {
    let unsigned = word.strip_prefix(['+', '-']).unwrap_or(word);
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E', 'd', 'D']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (unsigned, None),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let exponent_is_good = exponent.is_none_or(|exponent| {
        let unsigned = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
        !unsigned.is_empty() && digits(unsigned)
    });
    digits(whole) && digits(fraction) && whole.len() + fraction.len() > 0 && exponent_is_good
}

#[cfg(test)]
mod tests {
    use super::*;
    use Reading::{Plain, Repaired};

    #[test]
    fn fortran_numbers() {
        let table = [
            (".5", 0.5),
            ("30.0E6", 3e7),
            ("1.D-3", 1e-3),
            ("1.d-3", 1e-3),
            ("1E5", 1e5),
            ("+3", 3.0),
            ("0.1E06", 1e5),
            ("-.001", -0.001),
            ("-0.", -0.0),
            ("1E-400", 0.0),
        ];
        for (word, value) in table {
            assert_eq!(real(word), Ok(Plain(value)), "{word}");
        }
    }

    #[test]
    fn the_letter_o_is_a_zero_where_a_number_must_stand() {
        assert_eq!(real("1O.0"), Ok(Repaired(10.0)));
        assert_eq!(real("Ø.o5"), Ok(Repaired(0.05)));
        assert_eq!(count("1O"), Ok(Repaired(10)));
    }

    #[test]
    fn what_is_no_number() {
        let words = [
            "", ".", "+", "-.", "1.2.3", "E5", "1E", "1E+", "1E5.0", "NAN", "INF", "-INF",
            "INFINITY", "0X1F", "1_000", "NO", "--1", "1,", "TRUE",
        ];
        for word in words {
            assert_eq!(real(word), Err(NotANumber::Form), "{word}");
        }
        assert_eq!(real("1E400"), Err(NotANumber::Range));
        assert_eq!(real(&"9".repeat(1000)), Err(NotANumber::Range));
        assert_eq!(count("3.0"), Err(NotANumber::Form));
        assert_eq!(count("-1"), Err(NotANumber::Form));
        assert_eq!(count("99999999999999999999999"), Ok(Plain(u64::MAX)));
    }
}
