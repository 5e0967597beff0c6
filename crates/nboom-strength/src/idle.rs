use std::fmt;

use nboom_model::Structure;

use crate::{Loads, WantedLoads};

/// What a number of [`Settings`](crate::Settings) acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActsOn {
    /// Stresses.
    Stresses,
    /// Pulses of latches and stops.
    Pulses,
    /// Margins to yielding.
    YieldMargins,
    /// Margins to breaking.
    UltimateMargins,
}

/// Why a number of [`Settings`](crate::Settings) acts on nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Idle {
    /// The scene has no stations.
    NoStations,
    /// No hinge latches or has stops.
    NeitherLatchNorStop,
    /// Loads have no pulses: a body that latches or has stops has no pulse constant, and there are no stations.
    NoPulses,
    /// Stresses are left out of the run.
    NoStresses,
    /// No yield stress is known.
    NoYieldStress,
    /// No ultimate stress is known.
    NoUltimateStress,
}

impl fmt::Display for Idle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NoStations => {
                "the scene has no stations, which in a deck are stress groups with INSTR > 0"
            }
            Self::NeitherLatchNorStop => "no hinge latches or has stops, which takes a latch angle or stops of one that turns",
            Self::NoPulses => {
                "loads have no pulses of latches and stops, which take `pulse_constant` of each body they act on, or stations, in a deck stress groups with INSTR > 0"
            }
            Self::NoStresses => {
                "stresses are left out, by --no-stresses or in a study by `stresses = false`"
            }
            Self::NoYieldStress => {
                "no material of the scene has a yield stress, and --yield-stress, in a study \
                 `yield_stress`, gives none"
            }
            Self::NoUltimateStress => "no material of the scene has an ultimate stress",
        })
    }
}

impl WantedLoads<'_> {
    /// Why a number that acts on this has no effect, if it has none.
    pub fn idle(&self, number: ActsOn) -> Option<Idle> {
        if number == ActsOn::Pulses {
            return self.without_pulses();
        }
        if !self.structure.is_some_and(Structure::has_stations) {
            return Some(Idle::NoStations);
        }
        if !self.stresses {
            return Some(Idle::NoStresses);
        }
        match number {
            ActsOn::Stresses | ActsOn::Pulses => None,
            ActsOn::YieldMargins => (!self.knows_yield_stress()).then_some(Idle::NoYieldStress),
            ActsOn::UltimateMargins => {
                (!self.knows_ultimate_stress()).then_some(Idle::NoUltimateStress)
            }
        }
    }

    /// Why loads have no pulses of latches and stops, if they have none.
    fn without_pulses(&self) -> Option<Idle> {
        if !self.scene.bodies.iter().any(|body| body.hinge.may_be_struck()) {
            return Some(Idle::NeitherLatchNorStop);
        }
        if self.structure.is_none() {
            return Some(Idle::NoPulses);
        }
        (self.loads() == Loads::None).then_some(Idle::NoStresses)
    }
}
