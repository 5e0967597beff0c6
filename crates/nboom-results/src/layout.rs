//! Columns and numbers of the listing.

use std::io::{self, Write};

use nboom_model::{HingeLabel, Joint, UnitSystem};
use nboom_scalar::Vec3;
use nboom_sim::{Detail, EventKind, Snapshot};

/// Digits of the numbers of the printout.
pub(crate) const DIGITS: usize = 10;

/// Unit labels: the original's capitals, and a scene's own as they are, since mN is no MN.
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
        let (time, label): (_, fn(&str) -> String) = match system {
            UnitSystem::None => ("T", str::to_uppercase),
            UnitSystem::Si | UnitSystem::FtLbfS | UnitSystem::InLbfS => ("SEC", str::to_uppercase),
            UnitSystem::Custom { time, .. } => (time.as_str(), str::to_owned),
        };
        let (force, torque) = (label(system.force()), label(&system.torque()));
        Self {
            length: label(system.length()),
            energy: label(&system.energy()),
            momentum: format!("{force} {time}"),
            angular_momentum: format!("{torque} {time}"),
            time: time.to_owned(),
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
    number_to(value, DIGITS)
}

/// As [`number`], of so many digits.
pub(crate) fn number_to(value: f64, digits: usize) -> String {
    let text = format!("{value:.*E}", digits.saturating_sub(1));
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

pub(crate) fn inertial_columns(units: &Units) -> [(&'static str, String); 6] {
    [
        ("REFERENCE PT POSITION", units.length.clone()),
        ("MASS CTR POSITION", units.length.clone()),
        ("MASS CTR VELOCITY", units.rate_of(&units.length)),
        ("MASS CTR ACCELERATION", units.acceleration_of(&units.length)),
        ("ANGULAR MOMENTUM", units.angular_momentum.clone()),
        ("LINEAR MOMENTUM", units.momentum.clone()),
    ]
}

pub(crate) fn inertial_vectors(snapshot: &Snapshot, detail: &Detail) -> [Vec3<f64>; 6] {
    [
        snapshot.position_inertial,
        detail.mass_center_inertial,
        detail.mass_center_velocity_inertial,
        detail.mass_center_acceleration_inertial,
        snapshot.angular_momentum_inertial,
        snapshot.linear_momentum_inertial,
    ]
}

pub(crate) fn row_name(label: &HingeLabel) -> String {
    let [appendage, segment] = label.numbers();
    format!("{appendage:>3} {segment:>3}")
}

pub(crate) fn title(kind: EventKind) -> &'static str {
    match kind {
        EventKind::LockUp => "LOCK-UP OF HINGE",
        EventKind::Impact => "IMPACT AT A STOP OF HINGE",
        EventKind::Release => "RELEASE OF HINGE",
        EventKind::Stick => "FRICTION HOLDS HINGE",
        EventKind::Slip => "SLIP OF HINGE",
        EventKind::Rest => "STOP HOLDS HINGE",
        EventKind::Leave => "DEPARTURE FROM A STOP OF HINGE",
        EventKind::Rise(kind) => kind.names().rise.in_listing,
        EventKind::Fall(kind) => kind.names().fall.in_listing,
        EventKind::ThrustOn => "THRUST ON",
        EventKind::ThrustOff => "THRUST OFF",
        EventKind::End => "END OF RUN",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_a_scene_are_not_changed() {
        let [length, time, force] = ["mm", "min", "mN"].map(str::to_owned);
        let units = Units::of(&UnitSystem::Custom { length, time, force });
        assert_eq!([&*units.length, &*units.force, &*units.energy], ["mm", "mN", "mm mN"]);
        assert_eq!(units.angular_momentum, "mm mN min");
        assert_eq!(units.acceleration_of("DEG"), "DEG/min SQ");
        let old = Units::of(&UnitSystem::InLbfS);
        assert_eq!([old.angular_momentum, old.momentum], ["IN LBF SEC", "LBF SEC"]);
    }

    #[test]
    fn exponents_have_a_sign_and_two_digits() {
        assert_eq!(number(90.0), "9.000000000E+01");
        assert_eq!(number(-1.5e-7), "-1.500000000E-07");
        assert_eq!(number(2e-300), "2.000000000E-300");
        assert_eq!(number(f64::NAN), "NaN");
    }
}
