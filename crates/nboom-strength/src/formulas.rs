use nboom_scalar::Wrench;
use nboom_sections::report::Original;
use nboom_sections::{PointStress, Section, Stress};

use crate::Slips;

/// A section with the formulas that stresses are computed by.
#[derive(Clone, Debug)]
pub(crate) enum Formulas {
    Right(Section),
    Of1970(Original),
}

impl Formulas {
    pub fn new(section: Section, slips: Slips) -> Self {
        let slips = slips.of_sections();
        if slips.concern(&section) {
            Self::Of1970(Original::new(section, slips))
        } else {
            Self::Right(section)
        }
    }

    pub fn axis_points(&self, load: &Wrench<f64>) -> [Option<PointStress>; 4] {
        match self {
            Self::Right(section) => section.axis_points(load),
            Self::Of1970(original) => original.axis_points(load),
        }
    }

    pub fn severest(&self, load: &Wrench<f64>) -> PointStress {
        match self {
            Self::Right(section) => section.severest(load),
            Self::Of1970(original) => original.severest(load),
        }
    }

    pub fn at(&self, severest: &PointStress, load: &Wrench<f64>) -> Stress {
        match self {
            Self::Right(section) => section.at(severest, load),
            Self::Of1970(original) => original.at(severest, load),
        }
    }
}
