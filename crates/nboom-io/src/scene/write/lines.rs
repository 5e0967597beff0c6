use std::fmt::Write;

use nboom_scalar::{Sym3, Vec3};

use crate::angles::in_degrees;

/// Lines of a TOML text.
#[derive(Debug, Default)]
pub(super) struct Lines {
    pub text: String,
}

impl Lines {
    pub fn line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }

    pub fn table(&mut self, name: &str) {
        let _ = writeln!(self.text, "\n[{name}]");
    }

    pub fn tables(&mut self, name: &str) {
        let _ = writeln!(self.text, "\n[[{name}]]");
    }

    pub fn value(&mut self, key: &str, value: impl AsRef<str>) {
        let _ = writeln!(self.text, "{key} = {}", value.as_ref());
    }

    pub fn optional(&mut self, key: &str, value: Option<String>) {
        value.into_iter().for_each(|value| self.value(key, value));
    }
}

/// The shortest digits that are read as the number.
pub(super) fn number(number: f64) -> String {
    format!("{number:?}")
}

/// A text in quotes.
pub(super) fn text(text: &str) -> String {
    toml::Value::from(text).to_string()
}

pub(super) fn list<const N: usize>(numbers: [f64; N]) -> String {
    format!("[{}]", numbers.map(number).join(", "))
}

/// A list of values of any count.
pub(super) fn listed(values: impl Iterator<Item = String>) -> String {
    format!("[{}]", values.collect::<Vec<_>>().join(", "))
}

pub(super) fn vector(vector: Vec3<f64>) -> String {
    list(vector.to_array())
}

pub(super) fn inertia(inertia: &Sym3<f64>) -> String {
    let Sym3 { xx, yy, zz, xy, xz, yz } = *inertia;
    if [xy, xz, yz] == [0.0; 3] {
        return list([xx, yy, zz]);
    }
    let moments = [("xx", xx), ("yy", yy), ("zz", zz), ("xy", xy), ("xz", xz), ("yz", yz)];
    let moments = moments.map(|(key, value)| format!("{key} = {}", number(value)));
    format!("{{ {} }}", moments.join(", "))
}

/// A key of rates over time with its pairs of time and rate, in degrees where no bit is lost.
pub(super) fn angles_over_time(key: &str, pairs: &[[f64; 2]]) -> String {
    let degrees = |&[time, rate]: &[f64; 2]| Some([time, in_degrees(rate)?]);
    let (ending, pairs) = match pairs.iter().map(degrees).collect() {
        Some(in_degrees) => ("deg", in_degrees),
        None => ("rad", pairs.to_vec()),
    };
    format!("{key}_{ending} = {}", listed(pairs.into_iter().map(list)))
}

/// A key of several angles or rates with its values, in degrees where no bit is lost.
pub(super) fn angles<const N: usize>(key: &str, radians: [f64; N]) -> String {
    let degrees: Option<Vec<f64>> = radians.into_iter().map(in_degrees).collect();
    match degrees {
        Some(degrees) => format!("{key}_deg = {}", listed(degrees.into_iter().map(number))),
        None => format!("{key}_rad = {}", list(radians)),
    }
}

/// A key of an angle or rate with its value, in degrees where no bit is lost.
pub(super) fn angle(key: &str, radians: f64) -> String {
    match in_degrees(radians) {
        Some(degrees) => format!("{key}_deg = {}", number(degrees)),
        None => format!("{key}_rad = {}", number(radians)),
    }
}
