use std::fmt;

use nboom_formulation::Formulation;
use nboom_ode::{Bound, Method, Rkam, RkamSettings, Stepper, Tolerance};
use nboom_scalar::{Batch, Kernel};

/// Whether generated or library code computes accelerations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Path {
    /// A generated routine where one fits, else library code: of the formulation that is asked
    /// for where that covers the mode, else the recursion.
    #[default]
    Auto,
    /// A generated routine in every mode, or none.
    Generated,
    /// Library code: the formulation that is asked for in every mode, the recursion if none is.
    Generic,
}

impl Path {
    /// All.
    pub const ALL: [Self; 3] = [Self::Auto, Self::Generated, Self::Generic];

    /// The name in commands and files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Generated => "generated",
            Self::Generic => "generic",
        }
    }

    /// What it is, in one line.
    pub fn about(self) -> &'static str {
        match self {
            Self::Auto => {
                "generated code where there is some for the scene's topology, else library code"
            }
            Self::Generated => "generated code",
            Self::Generic => "library code",
        }
    }

    /// The path with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|path| path.name() == name)
    }
}

/// The equations that accelerations come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The recursion over any tree, which exists as library code alone.
    Recursive,
    /// A closed form, as library code and in generated routines. Of `momentum`, library code
    /// integrates momenta in place of rates.
    Closed(Formulation),
}

impl Form {
    /// All: the closed forms, then the recursion.
    pub fn all() -> impl Iterator<Item = Self> {
        Formulation::ALL.into_iter().map(Self::Closed).chain([Self::Recursive])
    }

    /// The name in commands and files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Recursive => "recursive",
            Self::Closed(formulation) => formulation.name(),
        }
    }

    /// What it is, in one line.
    pub fn about(self) -> &'static str {
        match self {
            Self::Recursive => "articulated bodies, of any tree; library code",
            Self::Closed(formulation) => formulation.about(),
        }
    }

    /// The form with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|form| form.name() == name)
    }
}

impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// How to run a scene.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Output times are the initial time and this many equal parts of the span after it.
    pub samples: usize,
    /// The method of integration.
    pub integrator: Method,
    /// Settings of [`Method::Rkam`]; `None` derives them from the errors allowed.
    pub rkam: Option<RkamSettings>,
    /// Relative error allowed in a step.
    pub rtol: f64,
    /// Absolute error allowed in a step, as a share of each variable's natural size: 1 rad for angles,
    /// for rates the largest so far, or one radian in the whole run if that is more.
    pub atol: f64,
    /// The longest step; a step may exceed it by up to a hundredth to reach the next scheduled time or an event
    /// that is expected.
    pub max_step: f64,
    /// Steps after which the run is given up.
    pub max_steps: usize,
    /// What says so: this option, or the symbol of a deck.
    pub max_steps_by: &'static str,
    /// Events after which the run is given up.
    pub max_events: usize,
    /// Whether generated or library code computes accelerations.
    pub path: Path,
    /// The equations that accelerations come from; `None` leaves that to the path.
    pub formulation: Option<Form>,
    /// The generated routines to choose from.
    pub kernels: &'static [Kernel],
    /// Right sides among the generated routines, on eight states at once.
    pub batches: &'static [Batch],
    /// Whether explicit steps are taken in lanes of registers, as those of eight runs side by side are
    /// ([`Lanes`](crate::Lanes)). A run by itself then has the same result as beside others.
    pub lanes: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            samples: 200,
            integrator: Method::Auto,
            rkam: None,
            rtol: 1e-9,
            atol: 1e-12,
            max_step: f64::INFINITY,
            max_steps: 10_000_000,
            max_steps_by: "max_steps",
            max_events: 20_000,
            path: Path::Auto,
            formulation: None,
            kernels: &[],
            batches: &[],
            lanes: false,
        }
    }
}

/// An option with a value that it cannot have.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{option} {value:e} found, {expected} expected")]
pub struct OptionError {
    /// Which option.
    pub option: &'static str,
    /// Its value.
    pub value: f64,
    /// What it can be.
    pub expected: &'static str,
}

/// A choice of code that has no effect, or that cannot be had, because of another option.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum IdleChoice {
    /// A path with power series, which record their own code.
    #[error("{OF_TAYLOR}")]
    PathOfTaylor,
    /// A formulation with power series.
    #[error("{OF_TAYLOR}")]
    FormulationOfTaylor,
    /// The recursion as generated code.
    #[error("formulation recursive is library code, which path generic runs")]
    GeneratedRecursion,
}

const OF_TAYLOR: &str = "integrator taylor is made of power series of the equations of motion, for which there is no \
                         other code";

impl IdleChoice {
    /// Which option it is, `path` or `formulation`.
    pub fn option(self) -> &'static str {
        match self {
            Self::PathOfTaylor | Self::GeneratedRecursion => "path",
            Self::FormulationOfTaylor => "formulation",
        }
    }
}

/// Below this a relative error is smaller than the rounding of a step.
const SMALLEST_RTOL: f64 = 1e-14;

/// Whether a number is right, which one it is, itself, and what is expected.
type NumberCheck = (bool, &'static str, f64, &'static str);

fn checks_of_rkam(settings: RkamSettings) -> [NumberCheck; 6] {
    let RkamSettings { first_step, shortest, longest, upper, lower } = settings;
    let first_step = first_step.unwrap_or(f64::MIN_POSITIVE);
    let [upper, lower] = [upper, lower].map(|bound| match bound {
        Bound::Number(number) => number,
        Bound::Within(Tolerance { relative, absolute }) => relative.max(absolute),
    });
    let bound = "a finite number above zero";
    [
        (longest > 0.0, "longest step (HMAX)", longest, "a number above zero"),
        (shortest >= 0.0, "shortest step (HMIN)", shortest, "a number not below zero"),
        (
            shortest <= longest,
            "shortest step (HMIN)",
            shortest,
            "a number at most the longest (HMAX)",
        ),
        (first_step > 0.0 && first_step.is_finite(), "first step (HZO)", first_step, bound),
        (upper > 0.0 && upper.is_finite(), "difference that halves steps (EU1)", upper, bound),
        (lower >= 0.0, "difference that doubles steps (EL1)", lower, "a number not below zero"),
    ]
}

impl Options {
    /// Refuses numbers with which no run can be made.
    ///
    /// # Errors
    /// The first of them.
    pub fn check(&self) -> Result<(), OptionError> {
        let Self { rtol, atol, max_step, max_steps, max_events, samples, .. } = *self;
        let has_digits = (SMALLEST_RTOL..1.0).contains(&rtol);
        let checks: [NumberCheck; 6] = [
            (has_digits, "relative error", rtol, "a number from 1e-14 to below 1"),
            (atol > 0.0 && atol.is_finite(), "absolute error", atol, "a finite number above zero"),
            (max_step > 0.0, "longest step", max_step, "a number above zero"),
            (samples > 0, "output intervals", samples as f64, "at least 1"),
            (max_steps > 0, "most steps", max_steps as f64, "at least 1"),
            (max_events > 0, "most events", max_events as f64, "at least 1"),
        ];
        let of_rkam = self.rkam.filter(|_| self.integrator == Method::Rkam).map(checks_of_rkam);
        let wrong = checks
            .into_iter()
            .chain(of_rkam.into_iter().flatten())
            .find(|(is_right, ..)| !is_right);
        wrong.map_or(Ok(()), |(_, option, value, expected)| {
            Err(OptionError { option, value, expected })
        })
    }

    /// Refuses choices of code of which one leaves nothing to another.
    ///
    /// # Errors
    /// The first of them.
    pub fn check_choices(&self) -> Result<(), IdleChoice> {
        let is_taylor = self.integrator == Method::Taylor;
        match (self.path, self.formulation) {
            (Path::Generated | Path::Generic, _) if is_taylor => Err(IdleChoice::PathOfTaylor),
            (_, Some(_)) if is_taylor => Err(IdleChoice::FormulationOfTaylor),
            (Path::Generated, Some(Form::Recursive)) => Err(IdleChoice::GeneratedRecursion),
            _ => Ok(()),
        }
    }

    /// Also refuses a longest step with which no run over `span` time units comes to its end.
    ///
    /// # Errors
    /// The first of them.
    pub fn check_span(&self, span: f64) -> Result<(), OptionError> {
        self.check()?;
        let (option, value) = ("longest step", self.max_step);
        let expected = "one that reaches the end in the steps that are allowed";
        let reaches = span <= value * self.max_steps as f64;
        if reaches { Ok(()) } else { Err(OptionError { option, value, expected }) }
    }

    /// Whether momenta are integrated in place of rates: generated routines and power series know
    /// accelerations alone.
    pub(crate) fn integrates_momenta(&self) -> bool {
        self.formulation == Some(Form::Closed(Formulation::Momentum))
            && self.path != Path::Generated
            && self.integrator != Method::Taylor
    }

    /// Errors allowed in a step.
    pub fn tolerance(&self) -> Tolerance {
        Tolerance { relative: self.rtol, absolute: self.atol }
    }

    pub(crate) fn stepper(&self) -> Box<dyn Stepper> {
        let mut stepper = match (self.integrator, self.rkam) {
            (Method::Rkam, Some(settings)) => Box::new(Rkam::new(settings)),
            _ => self.integrator.stepper(self.tolerance()),
        };
        stepper.limit_steps(self.max_step);
        stepper
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_of_rkam_with_which_no_run_can_be_made_are_refused() {
        let usual = RkamSettings::meeting(Bound::Number(1e-6));
        let check = |settings| {
            let rkam = Some(settings);
            Options { integrator: Method::Rkam, rkam, ..Options::default() }.check()
        };
        assert_eq!(check(usual), Ok(()));
        for wrong in [
            RkamSettings { shortest: -5.0, longest: -5.0, ..usual },
            RkamSettings { longest: 0.0, ..usual },
            RkamSettings { longest: f64::NAN, ..usual },
            RkamSettings { shortest: -1.0, ..usual },
            RkamSettings { shortest: 2.0, longest: 1.0, ..usual },
            RkamSettings { first_step: Some(0.0), ..usual },
            RkamSettings { first_step: Some(f64::NAN), ..usual },
            RkamSettings { upper: Bound::Number(f64::NAN), ..usual },
            RkamSettings { upper: Bound::Number(-1.0), ..usual },
            RkamSettings { upper: Bound::Number(f64::INFINITY), ..usual },
            RkamSettings { lower: Bound::Number(-1.0), ..usual },
        ] {
            assert!(check(wrong).is_err(), "{wrong:?}");
        }
    }

    #[test]
    fn a_run_of_no_steps_or_events_is_refused_by_what_says_so() {
        let of_no_steps = Options { max_steps: 0, ..Options::default() };
        let of_no_events = Options { max_events: 0, ..Options::default() };
        for (options, named) in [(of_no_steps, "steps"), (of_no_events, "events")] {
            let error = options.check_span(1.0).expect_err("nothing is allowed");
            assert_eq!(error.to_string(), format!("most {named} 0e0 found, at least 1 expected"));
        }
    }
}
