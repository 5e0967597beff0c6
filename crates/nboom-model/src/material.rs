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
#[non_exhaustive]
pub enum MaterialDefect {
    /// Young's modulus is zero, negative or not finite.
    #[error("Young's modulus {0} found, a positive finite modulus expected")]
    YoungsModulus(f64),
    /// Poisson's ratio is none of an isotropic material.
    #[error("Poisson's ratio {0} found, a number above -1 and at most 0.5 expected")]
    PoissonsRatio(f64),
    /// The yield stress is zero, negative or not finite.
    #[error("yield stress {0} found, a positive finite stress expected")]
    YieldStress(f64),
    /// The ultimate stress is zero, negative or not finite.
    #[error("ultimate stress {0} found, a positive finite stress expected")]
    UltimateStress(f64),
    /// The ultimate stress is below the yield stress.
    #[error("ultimate stress {ultimate} found, at least the yield stress {least} expected")]
    BreaksFirst {
        /// The ultimate stress.
        ultimate: f64,
        /// The yield stress.
        least: f64,
    },
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
