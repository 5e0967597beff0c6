use crate::{Finding, shown};

/// An isotropic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus \[F/L²\], positive. No result depends on it.
    pub youngs_modulus: f64,
    /// Poisson's ratio, above -1 and at most 0.5. No result depends on it.
    pub poissons_ratio: f64,
    /// Stress at which it yields \[F/L²\], positive; `None` where it is not known.
    pub yield_stress: Option<f64>,
    /// Stress at which it breaks \[F/L²\], at least that at which it yields; `None` where it is not known.
    pub ultimate_stress: Option<f64>,
}

/// What is wrong with a material.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.finding())]
#[non_exhaustive]
pub enum MaterialDefect {
    /// Young's modulus is zero, negative or not finite.
    YoungsModulus(f64),
    /// Poisson's ratio is none of an isotropic material.
    PoissonsRatio(f64),
    /// The yield stress is zero, negative or not finite.
    YieldStress(f64),
    /// The ultimate stress is zero, negative or not finite.
    UltimateStress(f64),
    /// The ultimate stress is below the yield stress.
    BreaksFirst {
        /// The ultimate stress.
        ultimate: f64,
        /// The yield stress.
        least: f64,
    },
}

impl MaterialDefect {
    /// What was found and what expected.
    pub fn finding(&self) -> Finding {
        match *self {
            Self::YoungsModulus(modulus) => Finding::new(
                format!("Young's modulus {}", shown(modulus)),
                "a positive finite modulus",
            ),
            Self::PoissonsRatio(ratio) => Finding::new(
                format!("Poisson's ratio {}", shown(ratio)),
                "a number above -1 and at most 0.5",
            ),
            Self::YieldStress(stress) => {
                Finding::new(format!("yield stress {}", shown(stress)), "a positive finite stress")
            }
            Self::UltimateStress(stress) => Finding::new(
                format!("ultimate stress {}", shown(stress)),
                "a positive finite stress",
            ),
            Self::BreaksFirst { ultimate, least } => Finding::new(
                format!("ultimate stress {}", shown(ultimate)),
                format!("at least the yield stress {}", shown(least)),
            ),
        }
    }
}

impl Material {
    /// A material of unknown strength.
    pub const fn elastic(youngs_modulus: f64, poissons_ratio: f64) -> Self {
        Self { youngs_modulus, poissons_ratio, yield_stress: None, ultimate_stress: None }
    }

    /// All that is wrong with it.
    pub fn defects(&self) -> Vec<MaterialDefect> {
        let Self { youngs_modulus, poissons_ratio, yield_stress, ultimate_stress } = *self;
        let is_positive = |value: &f64| *value > 0.0 && value.is_finite();
        let wrong = |value: Option<f64>| value.filter(|value| !is_positive(value));
        let modulus = wrong(Some(youngs_modulus)).map(MaterialDefect::YoungsModulus);
        // Beyond these a material would gain energy when it is sheared or compressed.
        let is_isotropic = poissons_ratio > -1.0 && poissons_ratio <= 0.5;
        let ratio = (!is_isotropic).then_some(poissons_ratio);
        let yields = wrong(yield_stress).map(MaterialDefect::YieldStress);
        let breaks = wrong(ultimate_stress).map(MaterialDefect::UltimateStress);
        let first = yield_stress.zip(ultimate_stress).filter(|(least, ultimate)| ultimate < least);
        let first = first.map(|(least, ultimate)| MaterialDefect::BreaksFirst { ultimate, least });
        let first = first.filter(|_| yields.is_none() && breaks.is_none());
        let ratio = ratio.map(MaterialDefect::PoissonsRatio);
        [modulus, ratio, yields, breaks, first].into_iter().flatten().collect()
    }
}
