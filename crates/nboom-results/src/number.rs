use std::io::{self, Write};

use nboom_scalar::Vec3;

/// A value for a table is not finite.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{0} found, a finite number expected; the results or their units are beyond all numbers")]
pub(crate) struct NotFinite(f64);

/// Writes the shortest decimal that reads back to the same `f64`, with an exponent where it would
/// have many digits.
///
/// # Errors
/// When the number is not finite, or `out` refuses it.
pub(crate) fn number(out: &mut impl Write, value: f64) -> io::Result<()> {
    if !value.is_finite() {
        return Err(io::Error::other(NotFinite(value)));
    }
    out.write_all(zmij::Buffer::new().format(value).as_bytes())
}

/// Writes a comma and a [`number`].
pub(crate) fn field(out: &mut impl Write, value: f64) -> io::Result<()> {
    out.write_all(b",")?;
    number(out, value)
}

pub(crate) fn vector_fields(out: &mut impl Write, vector: Vec3<f64>) -> io::Result<()> {
    vector.to_array().into_iter().try_for_each(|component| field(out, component))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(value: f64) -> String {
        let mut text = Vec::new();
        number(&mut text, value).expect("memory is writable");
        String::from_utf8(text).expect("digits are text")
    }

    fn digits(text: &str) -> usize {
        let mantissa = text.split('e').next().expect("a first part");
        let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
        digits.trim_matches('0').len()
    }

    /// Any bits: a generator of Marsaglia's, and the neighbours of all powers of two.
    fn values() -> impl Iterator<Item = f64> {
        let random = std::iter::successors(Some(0x9e37_79b9_7f4a_7c15_u64), |&bits| {
            let bits = bits ^ (bits << 13);
            let bits = bits ^ (bits >> 7);
            Some(bits ^ (bits << 17))
        });
        let powers = (0..0x7ff_u64).map(|exponent| exponent << 52);
        let close = powers.flat_map(|bits| [bits, bits + 1, bits | 0xf_ffff_ffff_ffff]);
        random.take(20_000).chain(close).map(f64::from_bits)
    }

    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let hard = [
            0.1 + 0.2,
            -0.0,
            5e-324,
            f64::MAX,
            -f64::MIN_POSITIVE,
            1.0 / 3.0,
            1e22,
            9007199254740993.0,
            std::f64::consts::PI,
        ];
        for value in hard.into_iter().chain(values()).filter(|value| value.is_finite()) {
            let text = text(value);
            let back: f64 = text.parse().expect("a number");
            assert_eq!(back.to_bits(), value.to_bits(), "{text}");
            assert!(text.len() < 26, "{text}");
            // The standard library's are known to be shortest.
            assert_eq!(digits(&text), digits(&format!("{value:e}")), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_refused() {
        for value in [f64::INFINITY, -f64::INFINITY, f64::NAN] {
            let mut text = Vec::new();
            let refused = field(&mut text, value).expect_err("it is not finite").to_string();
            assert!(refused.starts_with(&format!("{value} found, a finite number")), "{refused}");
        }
    }
}
