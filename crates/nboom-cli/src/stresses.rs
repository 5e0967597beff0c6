//! What the command line says about stresses.

use clap::Args;
use nboom_io::SceneFile;
use nboom_model::Scene;
use nboom_results::StressSigns;
use nboom_strength::{PulseShape, Settings, Slips, WantedLoads};

use crate::choice;

/// Options of `nboom run` that concern stresses.
#[derive(Args, Clone, Copy, Debug, Default)]
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

    /// Peak of a segment's response over the peak of a pulse: 1 for slow pulses and by default; at
    /// most 2.
    #[arg(long, value_name = "D", value_parser = choice::amplification,
          allow_negative_numbers = true)]
    pub amplification: Option<f64>,

    /// How pulses that act together add up: half-sines over time, or each with its peak as long as it
    /// lasts.
    #[arg(long, value_name = "SHAPE", default_value = PulseShape::default().name(),
          value_parser = choice::pulse_shape)]
    pub pulses: PulseShape,

    /// Write the loads of hinges, for any scene: hinge_loads.csv and its companions. With stresses, or
    /// with a pulse constant of each body that latches or has stops, they are always written.
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

    /// The loads that the file of a scene or the command line wants of a run of `scene`.
    pub(crate) fn wanted<'a>(
        &self,
        (file, scene): (&'a SceneFile, &'a Scene),
        slips: Slips,
    ) -> WantedLoads<'a> {
        let factor = |given: Option<f64>| given.unwrap_or(1.0);
        WantedLoads {
            scene,
            structure: file.structure.as_ref(),
            stresses: !self.no_stresses,
            hinge_loads: self.hinge_loads || file.settings.hinge_loads,
            settings: Settings {
                amplification: factor(self.amplification),
                pulses: self.pulses,
                yield_stress: self.yield_stress,
                safety_factor: factor(self.safety_factor),
                ultimate_factor: factor(self.ultimate_factor),
                slips,
            },
        }
    }
}
