use nboom_model::MassProperties;
use nboom_scalar::Vec3;

use super::assignment::MOST_STATIONS;
use super::builder::Builder;
use super::shown;
use super::symbols::Group;
use super::values::{Key, plain};
use crate::LegacySettings;

/// Vertices of a section, at most.
const MOST_VERTICES: usize = 6;

/// The stress groups of a deck, Table 16.1: sections and slices of every segment.
#[derive(Clone, Debug, PartialEq)]
pub struct StressInput {
    /// One for each segment, in the order of the scene's bodies.
    pub segments: Vec<StressSegment>,
}

/// Material, lock-up pulse and stations of one segment.
#[derive(Clone, Debug, PartialEq)]
pub struct StressSegment {
    /// `CMN`: impulse over peak of a lock-up pulse \[T\], positive.
    pub pulse_constant: f64,
    /// `XNU`: Poisson's ratio.
    pub poissons_ratio: f64,
    /// `E`: Young's modulus \[F/L²\], positive.
    pub youngs_modulus: f64,
    /// One to five, outboard before inboard.
    pub stations: Vec<StressStation>,
}

/// A section of a segment, and the slice from it to the next station outboard.
#[derive(Clone, Debug, PartialEq)]
pub struct StressStation {
    /// `S`: from the inboard hinge along η \[L\].
    pub distance_from_hinge: f64,
    /// `DELM`, `DELC`, `DLI`: the slice, whose mass may be zero; its mass centre from the
    /// inboard hinge, inertia about that centre, segment axes.
    pub slice: MassProperties,
    /// The walls.
    pub section: SectionShape,
}

/// The thin walls of a section, in the ξζ plane of the segment.
#[derive(Clone, Debug, PartialEq)]
pub enum SectionShape {
    /// A circular tube.
    Tube {
        /// `R` \[L\], positive.
        radius: f64,
        /// `T` \[L\], positive.
        thickness: f64,
    },
    /// A closed polygon of three to six walls.
    Polygon(Vec<Vertex>),
}

/// A corner of a polygonal section and the wall from it to the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// `XI` \[L\].
    pub xi: f64,
    /// `ZETA` \[L\].
    pub zeta: f64,
    /// `T` \[L\], positive.
    pub thickness: f64,
}

impl Builder<'_, '_, '_> {
    /// The stress groups, if stresses are asked for and the groups are there.
    pub fn stress(&mut self, settings: &LegacySettings) -> Option<StressInput> {
        let position = |group| self.values.groups.get(&group).copied();
        let present = (position(Group::Dynsta), position(Group::Dynstb));
        let wanted = settings.stress_interval > 0;
        match present {
            (Some(_), Some(_)) if wanted => {
                let segments = (0..self.sizes.segments).map(|i| self.stress_segment(i)).collect();
                return Some(StressInput { segments });
            }
            (None, None) if wanted => {
                let interval = settings.stress_interval.to_string();
                let expected = "&DYNSTA and &DYNSTB after it; no stresses are computed";
                self.warn(plain("INSTR"), 0, interval, expected);
            }
            (Some(at), None) if wanted => {
                self.report.error(at, "&DYNSTA", "&DYNSTA alone", "&DYNSTB after it");
            }
            (None, Some(at)) if wanted => {
                self.report.error(at, "&DYNSTB", "&DYNSTB alone", "&DYNSTA before it");
            }
            (Some(at), _) | (None, Some(at)) => {
                let expected = "INSTR above 0 for stresses; the stress groups are ignored";
                self.report.warn(at, "INSTR", "0", expected);
            }
            (None, None) => {}
        }
        None
    }

    fn stress_segment(&mut self, i: usize) -> StressSegment {
        let count = self.count_in("NSTA", i, 1..=MOST_STATIONS);
        let stations: Vec<_> = (0..count).map(|j| self.station(i, j)).collect();
        self.check_station_order(i, &stations);
        StressSegment {
            pulse_constant: self.positive_element(plain("CMN"), i),
            poissons_ratio: self.values.real("XNU", i),
            youngs_modulus: self.positive_element(plain("E"), i),
            stations,
        }
    }

    fn check_station_order(&mut self, i: usize, stations: &[StressStation]) {
        for (j, pair) in stations.windows(2).enumerate() {
            let (outboard, inboard) = (pair[0].distance_from_hinge, pair[1].distance_from_hinge);
            if inboard > outboard {
                let found = format!("{} after {}", shown(inboard), shown(outboard));
                let expected = "distances from the inboard hinge, outboard station first";
                self.error(plain("S"), MOST_STATIONS * i + j + 1, found, expected);
            }
        }
    }

    fn station(&mut self, i: usize, j: usize) -> StressStation {
        let flat = MOST_STATIONS * i + j;
        let mass = self.values.real("DELM", flat);
        if mass < 0.0 {
            self.error(plain("DELM"), flat, shown(mass), "none below zero");
        }
        let center = self.values.reals(("DELC", i + 1, 0), 3 * j..3 * j + 3);
        let center_of_mass = Vec3::new(center[0], center[1], center[2]);
        let inertia = self.slice_inertia(("DLI", i + 1, j + 1));
        StressStation {
            distance_from_hinge: self.values.real("S", flat),
            slice: MassProperties::new(mass, center_of_mass, inertia),
            section: self.section(i, j),
        }
    }

    fn slice_inertia(&mut self, key: Key) -> nboom_scalar::Sym3<f64> {
        let has_moments = [0, 4, 8].iter().all(|&d| self.values.cell(key, d).is_some());
        if has_moments {
            return self.inertia(key, 0);
        }
        let given = self.values.arrays.get(&key).filter(|array| !array.damaged);
        if given.is_some_and(|array| array.cells.iter().any(Option::is_some)) {
            let found = "a matrix without all three moments".to_owned();
            self.error(key, 0, found, "moments on the diagonal");
        }
        nboom_scalar::Sym3::zero()
    }

    fn section(&mut self, i: usize, j: usize) -> SectionShape {
        let flat = MOST_STATIONS * i + j;
        let walls = ("T", i + 1, 0);
        if self.values.real("ICIR", i) == 0.0 {
            let radius = self.positive_element(plain("R"), flat);
            let thickness = self.positive_element(walls, MOST_VERTICES * j);
            return SectionShape::Tube { radius, thickness };
        }
        let count = self.count_in("NVER", flat, 3..=MOST_VERTICES);
        let corners = MOST_VERTICES * j..MOST_VERTICES * j + count;
        let xi = self.values.reals(("XI", i + 1, 0), corners.clone());
        let zeta = self.values.reals(("ZETA", i + 1, 0), corners.clone());
        let vertices = corners.zip(xi).zip(zeta).map(|((wall, xi), zeta)| Vertex {
            xi,
            zeta,
            thickness: self.positive_element(walls, wall),
        });
        SectionShape::Polygon(vertices.collect())
    }

    /// A count in range, or 0.
    fn count_in(
        &mut self,
        name: &'static str,
        index: usize,
        range: std::ops::RangeInclusive<usize>,
    ) -> usize {
        let (least, most) = (*range.start(), *range.end());
        let expected = format!("a number from {least} to {most}");
        let count = self.element(plain(name), index, &expected);
        if let Some(wrong) = count.filter(|n| !(least as f64..=most as f64).contains(n)) {
            self.error(plain(name), index, shown(wrong), &expected);
            return 0;
        }
        count.map_or(0, |count| count as usize)
    }

    fn positive_element(&mut self, key: Key, index: usize) -> f64 {
        let expected = "a positive value";
        let value = self.element(key, index, expected);
        if let Some(wrong) = value.filter(|value| *value <= 0.0) {
            self.error(key, index, shown(wrong), expected);
        }
        value.unwrap_or(1.0)
    }

    /// An element that must be given.
    fn element(&mut self, key: Key, index: usize, expected: &str) -> Option<f64> {
        let value = self.values.cell(key, index).map(|cell| cell.value);
        if value.is_none() && !self.values.is_damaged(key) {
            self.error(key, index, "nothing".to_owned(), expected);
        }
        value
    }
}
