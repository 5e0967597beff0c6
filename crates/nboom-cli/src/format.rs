//! Numbers and columns for people to read.

use nboom_model::Scene;
use nboom_results::time_digits;
use nboom_scalar::Vec3;
use nboom_verify::{Label, NotCovered};

/// A number with at most `digits` significant digits, without trailing zeros, and with an exponent
/// if it is very small or large.
pub(crate) fn short(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return scientific };
    let places = exponent.parse::<i32>().ok().map(|e| digits as i32 - 1 - e);
    // A negative number of places would print digits that are not known.
    match places.filter(|p| (0..digits as i32 + 4).contains(p)) {
        Some(places) => trimmed(&format!("{value:.*}", places as usize)),
        None => format!("{}e{exponent}", trimmed(mantissa)),
    }
}

/// A duration \[s\] in plain decimals, with three digits or all before the point.
pub(crate) fn seconds(duration: f64) -> String {
    let places = (2.0 - duration.log10().floor()).clamp(0.0, 9.0);
    trimmed(&format!("{duration:.*}", places as usize))
}

/// A time of a scene's run with at least so many digits.
pub(crate) fn moment(scene: &Scene, time: f64, least: usize) -> String {
    short(time, time_digits(time, [scene.initial.time, scene.end_time], least))
}

fn trimmed(text: &str) -> String {
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text.to_owned()
    }
}

pub(crate) fn vector(v: Vec3<f64>) -> String {
    let [x, y, z] = v.to_array().map(|component| short(component, 6));
    format!("({x}, {y}, {z})")
}

/// An angle in degrees, with the unit.
pub(crate) fn degrees(radians: f64) -> String {
    format!("{} deg", short(radians.to_degrees(), 6))
}

/// A number and the right form of the noun it counts.
pub(crate) fn count(n: usize, one: &str, many: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { many })
}

/// Path, formulation, assumptions and instructions of code in columns.
pub(crate) fn code_columns(label: &Label) -> String {
    let Label { path, formulation, assumptions, instructions, .. } = label;
    format!("{path:<10} {formulation:<12} {assumptions:<11} {instructions:<13}")
}

/// The head of [`code_columns`].
pub(crate) fn code_head() -> String {
    let [path, formulation, assumptions, instructions] =
        ["path", "formulation", "assumptions", "instructions"];
    code_columns(&Label { path, formulation, assumptions, instructions, ..Label::RECURSION })
}

/// The topology that a routine is for, after a line of columns.
pub(crate) fn routine_topology(label: &Label) -> String {
    match (label.topology, label.virtual_links) {
        (Some(topology), 0) => format!("  for {topology}"),
        (Some(topology), links) => {
            format!("  in {topology}, {}", count(links, "virtual link", "virtual links"))
        }
        (None, _) => String::new(),
    }
}

/// Code that does not cover a scene, in the same columns.
pub(crate) fn not_covered(code: &NotCovered) -> String {
    let NotCovered { path, formulation, why } = code;
    format!("{path:<10} {:<12} not covered: {why}", formulation.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_significant_digits_only() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-2.5, "-2.5"),
            (1.0 / 3.0, "0.333333"),
            (1234567.0, "1.23457e6"),
            (123456.0, "123456"),
            (100.0, "100"),
            (0.000123, "0.000123"),
            (1.5e-12, "1.5e-12"),
            (f64::NAN, "NaN"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(short(value, 6), text);
        }
    }

    #[test]
    fn durations_are_plain_decimals() {
        for (duration, text) in [
            (0.0, "0"),
            (3.14159e-5, "0.0000314"),
            (0.012345, "0.0123"),
            (2.5, "2.5"),
            (100.0, "100"),
            (2021.4, "2021"),
        ] {
            assert_eq!(seconds(duration), text);
        }
    }
}
