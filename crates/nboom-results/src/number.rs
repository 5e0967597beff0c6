use std::io::{self, Write};

use nboom_scalar::Vec3;

/// Writes a comma and the shortest decimal that reads back to the same `f64`.
///
/// `Debug` is chosen over `Display` because it turns to an exponent where digits would become
/// hundreds of zeros.
pub(crate) fn field(out: &mut impl Write, value: f64) -> io::Result<()> {
    write!(out, ",{value:?}")
}

pub(crate) fn vector_fields(out: &mut impl Write, vector: Vec3<f64>) -> io::Result<()> {
    vector.to_array().into_iter().try_for_each(|component| field(out, component))
}

#[cfg(test)]
mod tests {
    use super::*;

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
        for value in hard {
            let mut text = Vec::new();
            field(&mut text, value).expect("memory is writable");
            let text = String::from_utf8(text).expect("digits are text");
            let back: f64 = text[1..].parse().expect("a number");
            assert_eq!(back.to_bits(), value.to_bits(), "{text}");
            assert!(text.len() < 27, "{text}");
        }
    }
}
