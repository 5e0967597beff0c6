//! What the command line says about stresses.

use clap::Args;
use nboom_io::SceneFile;
use nboom_results::StressSigns;
use nboom_scalar::Kernel;
use nboom_strength::{Settings, Slips, StrengthError, StressAnalysis};

use crate::choice;

/// Options of `nboom run` that concern stresses.
#[derive(Args, Clone, Copy, Debug)]
pub struct StressArgs {
    /// Compute no stresses, whatever the scene asks for.
    #[arg(long)]
    pub no_stresses: bool,

    /// Stress at which the material yields, for the margins in stress_envelope.csv.
    #[arg(long, value_name = "S", value_parser = choice::positive, allow_negative_numbers = true)]
    pub yield_stress: Option<f64>,

    /// Factor on stresses in margins.
    #[arg(long, value_name = "F", default_value = "1", value_parser = choice::positive,
          allow_negative_numbers = true)]
    pub safety_factor: f64,

    /// Peak of a segment's response over the peak of a lock-up pulse: 1 for slow pulses, at most 2.
    #[arg(long, value_name = "D", default_value = "1", value_parser = choice::positive,
          allow_negative_numbers = true)]
    pub amplification: f64,

    /// Write stresses with the report's signs: compression positive, shear stresses reversed too.
    #[arg(long)]
    pub report_signs: bool,
}

impl StressArgs {
    /// Which sign stresses have in files.
    pub(crate) fn signs(&self) -> StressSigns {
        if self.report_signs { StressSigns::Report } else { StressSigns::Tension }
    }

    /// The analysis that a scene asks for, if it does; `kernels` may have code for its loads.
    ///
    /// # Errors
    /// When a section is not one.
    pub(crate) fn analysis(
        &self,
        file: &SceneFile,
        slips: Slips,
        kernels: &[Kernel],
    ) -> Result<Option<StressAnalysis>, StrengthError> {
        let Self { no_stresses, yield_stress, safety_factor, amplification, .. } = *self;
        let structure = file.structure.as_ref().filter(|_| !no_stresses);
        let settings = Settings { amplification, yield_stress, safety_factor, slips };
        let analysis =
            structure.map(|structure| StressAnalysis::new(&file.scene, structure, settings));
        Ok(analysis.transpose()?.map(|analysis| analysis.with_kernels(kernels)))
    }
}
