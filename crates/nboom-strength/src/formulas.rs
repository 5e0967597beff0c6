use nboom_scalar::{Vec3, Wrench};
use nboom_sections::report::Original;
use nboom_sections::{PointStress, Section, SectionStresses, Stress};

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

    /// The stresses that `numbers` describe; by formulas of 1970, those under the load of these P and Q.
    pub fn stresses(&self, numbers: [f64; 6]) -> Stresses<'_> {
        match self {
            Self::Right(section) => Stresses::Right(section.described_by(numbers)),
            Self::Of1970(original) => {
                let [px, py, pz, qx, qy, qz] = numbers;
                let (force, moment) = (Vec3::new(px, py, pz), Vec3::new(qx, qy, qz));
                Stresses::Of1970(original, Wrench { force, moment })
            }
        }
    }

    /// Whether these are formulas of 1970, which take loads in place of numbers.
    pub fn are_of_1970(&self) -> bool {
        matches!(self, Self::Of1970(_))
    }

    /// Where the von Mises stress is largest.
    pub fn max_von_mises_of(&self, numbers: [f64; 6]) -> PointStress {
        self.stresses(numbers).max_von_mises()
    }

    /// Whether bounds show that the von Mises stress under these numbers is nowhere above `level`;
    /// cheaper than [`max_von_mises_of`](Self::max_von_mises_of), but for formulas of 1970.
    pub fn is_at_most(&self, level: f64, numbers: [f64; 6]) -> bool {
        match self {
            Self::Right(section) => section.described_by(numbers).is_at_most(level),
            Self::Of1970(_) => self.max_von_mises_of(numbers).stress.von_mises() <= level,
        }
    }

    /// The stress of a load at a point that was found for another load.
    pub fn at(&self, point: &PointStress, load: &Wrench<f64>) -> Stress {
        match self {
            Self::Right(section) => section.stresses(load).at(point),
            Self::Of1970(original) => original.at(point, load),
        }
    }
}

/// Stresses in a section by its formulas.
pub(crate) enum Stresses<'a> {
    Right(SectionStresses<'a>),
    Of1970(&'a Original, Wrench<f64>),
}

impl Stresses<'_> {
    pub fn axis_points(&self) -> [Option<PointStress>; 4] {
        match self {
            Self::Right(stresses) => stresses.axis_points(),
            Self::Of1970(original, load) => original.axis_points(load),
        }
    }

    pub fn max_von_mises(&self) -> PointStress {
        match self {
            Self::Right(stresses) => stresses.max_von_mises(),
            Self::Of1970(original, load) => original.max_von_mises(load),
        }
    }
}
