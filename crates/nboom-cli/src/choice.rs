//! Values of options, checked where they are read.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
#[cfg(feature = "generator")]
use nboom_formulation::Formulation;
use nboom_io::Format;
use nboom_model::UnitSystem;
#[cfg(feature = "generator")]
use nboom_package::Level;
use nboom_sim::{Form, Method, OptionError, Options, Path, Reference};
use nboom_strength::PulseShape;

/// Why the value of an option is refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChoiceError {
    /// Nothing has this name.
    #[error("unknown name, {} expected", .available.join(", "))]
    Unknown {
        /// The names that there are.
        available: Vec<&'static str>,
    },
    /// The text is not a number.
    #[error("a number expected")]
    NotANumber,
    /// The number is infinite or not a number.
    #[error("a finite number expected")]
    NotFinite,
    /// A tolerance or a length of time is zero or negative.
    #[error("a number above zero expected")]
    NotPositive,
    /// The text is not NAME=VALUE.
    #[error("NAME=VALUE expected, a parameter and a number")]
    NotAnAssignment,
    /// The number is below 1 or above 2.
    #[error("a number from 1 to 2 expected")]
    NotAnAmplification,
    /// No run accepts this value.
    #[error(transparent)]
    Option(#[from] OptionError),
}

pub(crate) fn formulation(name: &str) -> Result<Form, ChoiceError> {
    let names = || Form::all().map(Form::name).collect();
    Form::named(name).ok_or_else(|| ChoiceError::Unknown { available: names() })
}

#[cfg(feature = "generator")]
pub(crate) fn closed_form(name: &str) -> Result<Formulation, ChoiceError> {
    let names = || Formulation::ALL.map(Formulation::name).into();
    Formulation::named(name).ok_or_else(|| ChoiceError::Unknown { available: names() })
}

#[cfg(feature = "generator")]
pub(crate) fn level(name: &str) -> Result<Level, ChoiceError> {
    let levels = [Level::Exact, Level::Fast];
    let found = levels.into_iter().find(|level| level.name() == name);
    found.ok_or_else(|| ChoiceError::Unknown { available: levels.map(Level::name).into() })
}

pub(crate) fn plots(name: &str) -> Result<nboom_plots::Format, ChoiceError> {
    let formats = nboom_plots::Format::ALL;
    let found = formats.into_iter().find(|format| format.name() == name);
    found.ok_or_else(|| ChoiceError::Unknown { available: formats.map(|f| f.name()).into() })
}

pub(crate) fn integrator(name: &str) -> Result<Method, ChoiceError> {
    let names = || Method::ALL.map(Method::name).into();
    Method::named(name).ok_or_else(|| ChoiceError::Unknown { available: names() })
}

/// Help and shells show the names, and what each is.
pub(crate) fn path() -> impl TypedValueParser<Value = Path> {
    let known = Path::ALL.map(|path| PossibleValue::new(path.name()).help(path.about()));
    PossibleValuesParser::new(known).try_map(|name| {
        let names = || Path::ALL.map(Path::name).into();
        Path::named(&name).ok_or_else(|| ChoiceError::Unknown { available: names() })
    })
}

pub(crate) fn reference(name: &str) -> Result<Reference, ChoiceError> {
    let available = Reference::ALL.map(Reference::name).into();
    Reference::named(name).ok_or(ChoiceError::Unknown { available })
}

pub(crate) fn scene_format(name: &str) -> Result<Format, ChoiceError> {
    let available = Format::ALL.map(Format::name).into();
    let found = Format::ALL.into_iter().find(|format| format.name() == name);
    found.ok_or(ChoiceError::Unknown { available })
}

/// NAME=VALUE, a parameter of a scene.
pub(crate) fn parameter(text: &str) -> Result<(String, f64), ChoiceError> {
    let (name, value) = text.split_once('=').ok_or(ChoiceError::NotAnAssignment)?;
    Ok((name.trim().to_owned(), finite(value.trim())?))
}

pub(crate) fn units(name: &str) -> Result<UnitSystem, ChoiceError> {
    let names = || UnitSystem::NAMED.map(|units| units.name()).into();
    UnitSystem::from_name(name).ok_or_else(|| ChoiceError::Unknown { available: names() })
}

pub(crate) fn pulse_shape(name: &str) -> Result<PulseShape, ChoiceError> {
    let available = PulseShape::ALL.map(PulseShape::name).into();
    PulseShape::named(name).ok_or(ChoiceError::Unknown { available })
}

pub(crate) fn table_format(name: &str) -> Result<nboom_tables::Format, ChoiceError> {
    let all = nboom_tables::Format::ALL;
    let found = all.into_iter().find(|format| format.name() == name);
    found.ok_or_else(|| ChoiceError::Unknown { available: all.map(|format| format.name()).into() })
}

pub(crate) fn finite(text: &str) -> Result<f64, ChoiceError> {
    let value: f64 = text.parse().map_err(|_| ChoiceError::NotANumber)?;
    if value.is_finite() { Ok(value) } else { Err(ChoiceError::NotFinite) }
}

pub(crate) fn positive(text: &str) -> Result<f64, ChoiceError> {
    let value = finite(text)?;
    if value > 0.0 { Ok(value) } else { Err(ChoiceError::NotPositive) }
}

/// Slow pulses are not amplified, and no pulse is amplified by more than 2.
pub(crate) fn amplification(text: &str) -> Result<f64, ChoiceError> {
    let value = finite(text)?;
    if (1.0..=2.0).contains(&value) { Ok(value) } else { Err(ChoiceError::NotAnAmplification) }
}

pub(crate) fn rtol(text: &str) -> Result<f64, ChoiceError> {
    let rtol = finite(text)?;
    Options { rtol, ..Options::default() }.check()?;
    Ok(rtol)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tolerances_have_limits() {
        for text in ["1e-14", "0.99"] {
            assert_eq!(rtol(text).ok(), text.parse().ok());
        }
        for text in ["9e-15", "1e-18", "1e-300", "0", "-1e-9", "1", "10"] {
            let refused = rtol(text).expect_err("too small or too large").to_string();
            assert!(refused.ends_with("a number from 1e-14 to below 1 expected"), "{refused}");
        }
        assert_eq!(positive("1e-30"), Ok(1e-30));
        for text in ["0", "-1e-9"] {
            assert_eq!(positive(text), Err(ChoiceError::NotPositive));
        }
        for (text, error) in [
            ("nan", ChoiceError::NotFinite),
            ("inf", ChoiceError::NotFinite),
            ("-inf", ChoiceError::NotFinite),
            ("tight", ChoiceError::NotANumber),
        ] {
            assert_eq!(rtol(text), Err(error.clone()));
            assert_eq!(positive(text), Err(error));
        }
    }

    #[test]
    fn amplifications_are_from_one_to_two() {
        for text in ["1", "1.77", "2"] {
            assert_eq!(amplification(text).ok(), text.parse().ok());
        }
        for text in ["0.5", "0.99", "2.01", "7", "-1"] {
            assert_eq!(amplification(text), Err(ChoiceError::NotAnAmplification), "{text}");
        }
    }

    #[test]
    fn refusals_say_what_there_is() {
        let refused = formulation("kane").expect_err("unknown").to_string();
        assert_eq!(
            refused,
            "unknown name, report, relative, symmetric, articulated, momentum, recursive expected"
        );
        let refused = integrator("euler").expect_err("unknown").to_string();
        assert_eq!(
            refused,
            "unknown name, auto, rkam, dopri5, dop853, adams, taylor, radau5, radau9, radau13, gauss, gauss_lanes expected"
        );
        let refused = units("cubits").expect_err("unknown").to_string();
        assert_eq!(refused, "unknown name, none, SI, ft-lbf-s, in-lbf-s expected");
    }
}
