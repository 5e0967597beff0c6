use nboom_model::{Departures, Scene};
use nboom_sections::report::SectionSlips;

mod motion;

/// A slip of the program of 1970 that can be asked for; `docs/the-1970-program.md` has the evidence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slip {
    /// Kick-off springs of chains turned hinges with the forces that belong to α.
    ChainKickOff,
    /// Kick-off springs did not act on paddles.
    PaddleKickOff,
    /// The inertia of paddles was turned by two rotations in the wrong order.
    PaddleInertia,
    /// Loads were handed inboard turned by the angle of the wrong hinge.
    LoadTransfer,
    /// Tubes bent with half of their second moment of area.
    TubeInertia,
    /// Shear stress of forces in tubes was in absolute values.
    TubeShear,
    /// I_ξξ/I_ζζ took the place of the square of the product of inertia.
    ProductOfInertia,
    /// Bending of polygons had the wrong sign.
    BendingSigns,
    /// Tension stood for the shear force in the torsion moment about the centroid.
    TorsionArm,
    /// The last wall of a polygon ended at the η axis.
    ClosingWall,
    /// Shear stress of forces in polygons came from static moments.
    LevelShear,
    /// Axis points of polygons got the stresses of a vertex nearby.
    VertexBefore,
}

impl Slip {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::ChainKickOff,
        Self::PaddleKickOff,
        Self::PaddleInertia,
        Self::LoadTransfer,
        Self::TubeInertia,
        Self::TubeShear,
        Self::ProductOfInertia,
        Self::BendingSigns,
        Self::TorsionArm,
        Self::ClosingWall,
        Self::LevelShear,
        Self::VertexBefore,
    ];

    /// The name on the command line and in the document.
    pub fn name(self) -> &'static str {
        match self {
            Self::ChainKickOff => "chain-kick-off",
            Self::PaddleKickOff => "paddle-kick-off",
            Self::PaddleInertia => "paddle-inertia",
            Self::LoadTransfer => "load-transfer",
            Self::TubeInertia => "tube-inertia",
            Self::TubeShear => "tube-shear",
            Self::ProductOfInertia => "product-of-inertia",
            Self::BendingSigns => "bending-signs",
            Self::TorsionArm => "torsion-arm",
            Self::ClosingWall => "closing-wall",
            Self::LevelShear => "level-shear",
            Self::VertexBefore => "vertex-before",
        }
    }

    /// The one with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|slip| slip.name() == name)
    }
}

/// Slips that are asked for; by default none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slips(u16);

impl Slips {
    /// All of them.
    pub fn all() -> Self {
        Slip::ALL.into_iter().collect()
    }

    /// Whether this one is asked for.
    pub fn contains(self, slip: Slip) -> bool {
        self.0 & (1 << slip as u16) != 0
    }

    /// Those asked for.
    pub fn iter(self) -> impl Iterator<Item = Slip> {
        Slip::ALL.into_iter().filter(move |&slip| self.contains(slip))
    }

    /// What of them concerns sections.
    pub(crate) fn of_sections(self) -> SectionSlips {
        SectionSlips {
            tube_inertia: self.contains(Slip::TubeInertia),
            tube_shear: self.contains(Slip::TubeShear),
            product_of_inertia: self.contains(Slip::ProductOfInertia),
            bending_signs: self.contains(Slip::BendingSigns),
            torsion_arm: self.contains(Slip::TorsionArm),
            closing_wall: self.contains(Slip::ClosingWall),
            level_shear: self.contains(Slip::LevelShear),
            vertex_before: self.contains(Slip::VertexBefore),
        }
    }

    /// The scene that the original moved instead of `scene`.
    pub fn scene(self, scene: Scene) -> Scene {
        let idle = self.contains(Slip::PaddleKickOff);
        let scene = if idle { motion::without_springs_on_paddles(&scene) } else { scene };
        let (chains, paddles) =
            (self.contains(Slip::ChainKickOff), self.contains(Slip::PaddleInertia));
        let departures = Departures {
            withheld: if chains { motion::withheld(&scene) } else { Vec::new() },
            turned: if paddles { motion::turned(&scene) } else { Vec::new() },
        };
        scene.with_departures(departures)
    }
}

impl FromIterator<Slip> for Slips {
    fn from_iter<I: IntoIterator<Item = Slip>>(slips: I) -> Self {
        Self(slips.into_iter().fold(0, |set, slip| set | 1 << slip as u16))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_sections_is_asked_for_by_its_own_name_alone() {
        let none = SectionSlips::default();
        let of_sections = [
            (Slip::TubeInertia, SectionSlips { tube_inertia: true, ..none }),
            (Slip::TubeShear, SectionSlips { tube_shear: true, ..none }),
            (Slip::ProductOfInertia, SectionSlips { product_of_inertia: true, ..none }),
            (Slip::BendingSigns, SectionSlips { bending_signs: true, ..none }),
            (Slip::TorsionArm, SectionSlips { torsion_arm: true, ..none }),
            (Slip::ClosingWall, SectionSlips { closing_wall: true, ..none }),
            (Slip::LevelShear, SectionSlips { level_shear: true, ..none }),
            (Slip::VertexBefore, SectionSlips { vertex_before: true, ..none }),
        ];
        for slip in Slip::ALL {
            let expected = of_sections.iter().find(|(of, _)| *of == slip);
            let expected = expected.map_or(none, |(_, slips)| *slips);
            assert_eq!(Slips::from_iter([slip]).of_sections(), expected, "{}", slip.name());
        }
    }
}
