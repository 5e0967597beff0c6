//! Which figures there are, in the order of the report of 1970, and what it did not plot after them.

mod balance;
mod loads;
mod motion;
mod on_request;

use crate::figure::Figure;
use crate::source::Source;

/// Names of axes.
const XYZ: [&str; 3] = ["x", "y", "z"];

/// A figure by the name of its file.
pub(crate) struct Entry {
    pub name: &'static str,
    pub make: for<'a> fn(&Source<'a>) -> Option<Figure<'a>>,
}

macro_rules! figures {
    ($($name:literal: $make:path,)*) => {
        /// All figures that a run may have.
        pub(crate) const FIGURES: &[Entry] = &[$(Entry { name: $name, make: |source| $make(source) },)*];
    };
}

figures! {
    "01-deployment-angles": motion::angles,
    "02-hinge-rates": motion::rates,
    "03-body-rates": motion::body_rates,
    "04-nutation": motion::nutation,
    "05-direction-cosines": motion::direction_cosines,
    "06-kick-off-forces": loads::kick_off_forces,
    "07-hinge-loads": loads::hinge_loads,
    "08-stresses": loads::stresses,
    "09-energy": balance::energy,
    "10-residuals": balance::residuals,
    "11-rotors": on_request::rotors,
    "12-test-rig": on_request::rig,
}
