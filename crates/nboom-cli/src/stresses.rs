//! What the command line says about stresses.

use clap::Args;
use nboom_io::SceneFile;
use nboom_model::Scene;
use nboom_results::StressSigns;
use nboom_scalar::Kernel;
use nboom_strength::{PulseShape, Settings, Slips, StrengthError, StressAnalysis};

use crate::choice;

/// Options of `nboom run` that concern stresses.
#[derive(Args, Clone, Copy, Debug)]
pub struct StressArgs {
    /// Compute no stresses, whatever the scene asks for.
    #[arg(long)]
    pub no_stresses: bool,

    /// Stress at which all parts yield, for margins; in place of the yield stresses of a scene's
    /// materials.
    #[arg(long, value_name = "S", value_parser = choice::positive, allow_negative_numbers = true,
          conflicts_with = "no_stresses")]
    pub yield_stress: Option<f64>,

    /// Factor on stresses in margins to yielding; by default 1.
    #[arg(long, value_name = "F", value_parser = choice::positive, allow_negative_numbers = true)]
    pub safety_factor: Option<f64>,

    /// Factor on stresses in margins to breaking, of materials with an ultimate stress; by default 1.
    #[arg(long, value_name = "F", value_parser = choice::positive, allow_negative_numbers = true)]
    pub ultimate_factor: Option<f64>,

    /// Peak of a segment's response over the peak of a lock-up pulse: 1 for slow pulses and by
    /// default; at most 2.
    #[arg(long, value_name = "D", value_parser = choice::amplification,
          allow_negative_numbers = true)]
    pub amplification: Option<f64>,

    /// How the pulses of latches that act together add up: half-sines over time, or each with its peak
    /// as long as it lasts.
    #[arg(long, value_name = "SHAPE", default_value = PulseShape::default().name(),
          value_parser = choice::pulse_shape)]
    pub pulses: PulseShape,

    /// Write the loads of hinges, for any scene: hinge_loads.csv and its companions. With stresses
    /// they are always written.
    #[arg(long)]
    pub hinge_loads: bool,

    /// Write stresses with the report's signs: compression positive, shear stresses reversed too.
    #[arg(long, conflicts_with = "no_stresses")]
    pub report_signs: bool,
}

impl StressArgs {
    /// Which sign stresses have in files.
    pub(crate) fn signs(&self) -> StressSigns {
        if self.report_signs { StressSigns::Report } else { StressSigns::Tension }
    }

    /// Whether a scene or the command line asks for the loads of hinges, with or without stresses.
    pub(crate) fn of_hinges(&self, file: &SceneFile) -> bool {
        self.hinge_loads || file.settings.hinge_loads
    }

    /// The analysis of a run of `scene` that its file or the command line asks for, if one does; `kernels` may have code
    /// for its loads.
    ///
    /// # Errors
    /// When a section is not one.
    pub(crate) fn analysis(
        &self,
        (file, scene): (&SceneFile, &Scene),
        slips: Slips,
        kernels: &[Kernel],
    ) -> Result<Option<StressAnalysis>, StrengthError> {
        let Self { yield_stress, pulses, .. } = *self;
        let [amplification, safety_factor, ultimate_factor] =
            [self.amplification, self.safety_factor, self.ultimate_factor]
                .map(|factor| factor.unwrap_or(1.0));
        let settings =
            Settings { amplification, pulses, yield_stress, safety_factor, ultimate_factor, slips };
        match &file.structure {
            Some(structure) if !self.no_stresses => {
                let analysis = StressAnalysis::new(scene, structure, settings)?;
                Ok(Some(analysis.with_kernels(kernels)))
            }
            structure if self.of_hinges(file) => {
                StressAnalysis::of_hinges(scene, structure.as_ref(), settings).map(Some)
            }
            _ => Ok(None),
        }
    }
}
