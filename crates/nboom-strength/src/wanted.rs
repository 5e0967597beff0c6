use nboom_model::{Material, Scene, Structure};
use nboom_scalar::Kernel;

use crate::{Settings, StrengthError, StressAnalysis};

/// The loads that are wanted of a run.
#[derive(Clone, Copy, Debug)]
pub struct WantedLoads<'a> {
    /// The scene of the run.
    pub scene: &'a Scene,
    /// Its stations, and the constants of its pulses.
    pub structure: Option<&'a Structure>,
    /// Whether stresses are wanted where there are stations.
    pub stresses: bool,
    /// Whether loads of hinges are wanted of any scene.
    pub hinge_loads: bool,
    /// How they are judged.
    pub settings: Settings,
}

/// Which loads a run finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Loads {
    /// None.
    None,
    /// Those of hinges.
    Hinges,
    /// Those of hinges and stations, and so stresses.
    Stations,
    /// The same, and margins, since some strength is known.
    Margins,
}

impl<'a> WantedLoads<'a> {
    /// The structure, if stresses are wanted of it.
    pub fn stressed(&self) -> Option<&'a Structure> {
        self.structure.filter(|_| self.stresses)
    }

    /// Which loads the run finds.
    pub fn loads(&self) -> Loads {
        match self.stressed() {
            Some(structure) if structure.has_stations() => {
                let is_known = self.knows_yield_stress() || self.knows_ultimate_stress();
                if is_known { Loads::Margins } else { Loads::Stations }
            }
            None if !self.hinge_loads => Loads::None,
            _ => Loads::Hinges,
        }
    }

    /// What finds them, if there are any; `kernels` may have code for those of stations.
    ///
    /// # Errors
    /// When a section or a setting is not one.
    pub fn analysis(&self, kernels: &[Kernel]) -> Result<Option<StressAnalysis>, StrengthError> {
        match self.stressed() {
            Some(structure) => {
                let analysis = StressAnalysis::new(self.scene, structure, self.settings)?;
                Ok(Some(analysis.with_kernels(kernels)))
            }
            None if self.hinge_loads => {
                StressAnalysis::of_hinges(self.scene, self.structure, self.settings).map(Some)
            }
            None => Ok(None),
        }
    }

    pub(crate) fn knows_yield_stress(&self) -> bool {
        self.settings.yield_stress.is_some() || self.any_has(|material| material.yield_stress)
    }

    pub(crate) fn knows_ultimate_stress(&self) -> bool {
        self.any_has(|material| material.ultimate_stress)
    }

    fn any_has(&self, strength: fn(&Material) -> Option<f64>) -> bool {
        let mut materials = self.structure.into_iter().flat_map(|structure| structure.materials());
        materials.any(|material| strength(material).is_some())
    }
}
