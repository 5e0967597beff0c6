//! Columns and numbers of the listing.

use nboom_model::{Joint, UnitSystem};
use std::io::{self, Write};

use nboom_scalar::Vec3;

/// Unit labels in the listing's capitals.
pub(crate) struct Units {
    pub(crate) length: String,
    pub(crate) time: String,
    pub(crate) force: String,
    pub(crate) torque: String,
    pub(crate) energy: String,
    pub(crate) momentum: String,
    pub(crate) angular_momentum: String,
}

impl Units {
    pub(crate) fn of(system: &UnitSystem) -> Self {
        let time = if *system == UnitSystem::None { "T" } else { "SEC" }.to_owned();
        let force = system.force().to_uppercase();
        let torque = system.torque().to_uppercase();
        Self {
            length: system.length().to_uppercase(),
            energy: system.energy().to_uppercase(),
            momentum: format!("{force} {time}"),
            angular_momentum: format!("{torque} {time}"),
            time,
            force,
            torque,
        }
    }

    /// What an impulse at a joint is of, and its unit.
    pub(crate) fn impulse_at(self, joint: Joint) -> (&'static str, String) {
        match joint {
            Joint::Revolute => ("TORQUE", self.angular_momentum),
            Joint::Prismatic => ("FORCE", self.momentum),
        }
    }

    pub(crate) fn rate_of(&self, quantity: &str) -> String {
        format!("{quantity}/{}", self.time)
    }

    pub(crate) fn acceleration_of(&self, quantity: &str) -> String {
        format!("{quantity}/{} SQ", self.time)
    }
}

/// A number of ten digits with a signed exponent of at least two, as Fortran prints it.
pub(crate) fn number(value: f64) -> String {
    let text = format!("{value:.9E}");
    match text.split_once('E') {
        Some((digits, exponent)) => {
            let (sign, exponent) = match exponent.strip_prefix('-') {
                Some(exponent) => ('-', exponent),
                None => ('+', exponent),
            };
            format!("{digits}E{sign}{exponent:0>2}")
        }
        None => text,
    }
}

/// A table whose first column names the row and whose other columns have one width.
pub(crate) struct Columns {
    pub(crate) first: usize,
    pub(crate) others: usize,
}

impl Columns {
    /// Two lines: the columns' names, and below them their units in parentheses.
    pub(crate) fn heading(
        &self,
        out: &mut impl Write,
        first: &str,
        columns: &[(&str, &str)],
    ) -> io::Result<()> {
        let names: Vec<String> = columns.iter().map(|(name, _)| (*name).to_owned()).collect();
        let in_parentheses = |(_, unit): &(&str, &str)| {
            if unit.is_empty() { String::new() } else { format!("({unit})") }
        };
        self.row(out, first, &names)?;
        self.row(out, "", &columns.iter().map(in_parentheses).collect::<Vec<_>>())
    }

    pub(crate) fn row(
        &self,
        out: &mut impl Write,
        first: &str,
        cells: &[String],
    ) -> io::Result<()> {
        let mut line = format!("{first:<width$}", width = self.first);
        for cell in cells {
            line.push_str(&format!("{cell:>width$}", width = self.others));
        }
        writeln!(out, "{}", line.trim_end())
    }

    pub(crate) fn numbers(
        &self,
        out: &mut impl Write,
        first: &str,
        values: &[f64],
    ) -> io::Result<()> {
        let cells: Vec<String> = values.iter().copied().map(number).collect();
        self.row(out, first, &cells)
    }

    /// Three rows X, Y, Z with a column for each vector.
    pub(crate) fn components(&self, out: &mut impl Write, vectors: &[Vec3<f64>]) -> io::Result<()> {
        for (j, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            let values: Vec<f64> = vectors.iter().map(|v| v.to_array()[j]).collect();
            self.numbers(out, name, &values)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_have_a_sign_and_two_digits() {
        assert_eq!(number(90.0), "9.000000000E+01");
        assert_eq!(number(-1.5e-7), "-1.500000000E-07");
        assert_eq!(number(2e-300), "2.000000000E-300");
        assert_eq!(number(f64::NAN), "NaN");
    }
}
