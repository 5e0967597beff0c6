use std::fmt;

use nboom_scalar::{Sym3, Vec3};

use crate::{
    Finding, HingeLabel, MassDefect, MaterialDefect, Scene, SectionShape, SegmentStructure,
    Station, shown,
};

/// Share of a distance by which a mass centre may lie inboard of a station where both are the same place.
const ROUNDING: f64 = 1e-9;

/// Why a description of sections and slices is not that of a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StructureError {
    /// Not one entry for each hinged body.
    #[error("structure of {found} segments found, one for each of the {expected} expected")]
    Count {
        /// Entries.
        found: usize,
        /// Hinged bodies of the scene.
        expected: usize,
    },
    /// Something is wrong with a segment.
    #[error("{place}: {defect}")]
    Segment {
        /// Where.
        place: StructurePlace,
        /// What.
        defect: StructureDefect,
    },
}

/// A place in the structure; stations and vertices are stored from 0 and shown from 1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StructurePlace {
    /// The segment.
    pub segment: HingeLabel,
    /// Its station, outboard ones first.
    pub station: Option<usize>,
    /// The vertex of that station's section.
    pub vertex: Option<usize>,
}

impl fmt::Display for StructurePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "segment {}", self.segment)?;
        let parts = [("station", self.station), ("vertex", self.vertex)];
        for (name, number) in parts {
            if let Some(number) = number {
                write!(f, ", {name} {}", number + 1)?;
            }
        }
        Ok(())
    }
}

/// What is wrong at a place of the structure.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.finding())]
#[non_exhaustive]
pub enum StructureDefect {
    /// A pulse constant is zero, negative or not finite.
    PulseConstant(f64),
    /// No material is like that.
    #[error(transparent)]
    Material(#[from] MaterialDefect),
    /// A number is infinite or not a number.
    NotFinite {
        /// Which number.
        quantity: &'static str,
        /// What it is.
        value: f64,
    },
    /// A station lies outboard of the one before it.
    Order {
        /// Of the station.
        distance: f64,
        /// Of the station before.
        outboard: f64,
    },
    /// The last station is not at the hinge.
    NotAtHinge(f64),
    /// The mass centre of a slice lies inboard of the station that carries it; a warning.
    SliceInboard {
        /// Of the station.
        distance: f64,
        /// Of the mass centre, along η.
        center: f64,
    },
    /// Stations of a body with a rotor are away from its hinge, and so do not carry it; a warning.
    BeyondRotor {
        /// How many.
        stations: usize,
    },
    /// The pulse of a latch lasts longer than the run; a warning.
    LongPulse {
        /// Impulse over peak.
        constant: f64,
        /// How long the run lasts.
        run: f64,
    },
    /// The mass of a slice is negative or not finite.
    SliceMass(f64),
    /// No rigid body has the mass centre and inertia of a slice.
    Slice(MassDefect),
    /// The slices do not add up to the mass of the segment.
    Mass {
        /// Of all slices.
        found: f64,
        /// Of the segment.
        expected: f64,
    },
    /// The mass centre of all slices is not that of the segment.
    CenterOfMass {
        /// Of all slices.
        found: Vec3<f64>,
        /// Of the segment.
        expected: Vec3<f64>,
    },
    /// The inertia of all slices about their mass centre is not that of the segment.
    Inertia {
        /// Of all slices.
        found: Sym3<f64>,
        /// Of the segment.
        expected: Sym3<f64>,
    },
}

impl StructureDefect {
    /// What was found and what expected, apart from the place.
    pub fn finding(&self) -> Finding {
        match self {
            Self::PulseConstant(constant) => Finding::new(
                format!("pulse constant {}", shown(*constant)),
                "a positive finite time",
            ),
            Self::Material(defect) => defect.finding(),
            Self::NotFinite { quantity, value } => {
                Finding::new(format!("{quantity} {value}"), "a finite number")
            }
            Self::Order { distance, outboard } => Finding::new(
                format!("distance {} after {}", shown(*distance), shown(*outboard)),
                "at most that of the station before",
            ),
            Self::NotAtHinge(distance) => {
                Finding::new(format!("last station {} from the hinge", shown(*distance)), "0")
            }
            Self::SliceInboard { distance, center } => Finding::new(
                format!(
                    "distance {} of a station whose slice has its mass centre at {} along the long axis",
                    shown(*distance),
                    shown(*center)
                ),
                "a slice outboard of its station",
            ),
            Self::BeyondRotor { stations } => Finding::new(
                format!(
                    "a rotor in a body with stations away from its hinge, {stations} of them, which do not carry its \
                     moment"
                ),
                "a wheel as a body on a hinge",
            ),
            Self::LongPulse { constant, run } => Finding::new(
                format!("pulse constant {}", shown(*constant)),
                format!("one below the {} that the run lasts", shown(*run)),
            ),
            Self::SliceMass(mass) => Finding::new(
                format!("slice of mass {}", shown(*mass)),
                "a finite mass not below zero",
            ),
            Self::Slice(defect) => defect.finding().after("slice with "),
            Self::Mass { found, expected } => Finding::new(
                format!("slices of mass {} in all", shown(*found)),
                format!("{} of the segment ({} away)", shown(*expected), rounded(found - expected)),
            ),
            Self::CenterOfMass { found, expected } => Finding::new(
                format!("slices with mass centre {}", vector(*found)),
                format!(
                    "{} of the segment ({} away)",
                    vector(*expected),
                    rounded((*found - *expected).norm())
                ),
            ),
            Self::Inertia { found, expected } => Finding::new(
                format!(
                    "slices with moments {} and products {} of inertia",
                    moments(found),
                    products(found)
                ),
                format!(
                    "{} and {} of the segment (up to {} away)",
                    moments(expected),
                    products(expected),
                    rounded((*found - *expected).largest_entry())
                ),
            ),
        }
    }
}

fn vector(v: Vec3<f64>) -> String {
    format!("({})", v.to_array().map(shown).join(", "))
}

fn moments(inertia: &Sym3<f64>) -> String {
    vector(Vec3::new(inertia.xx, inertia.yy, inertia.zz))
}

fn products(inertia: &Sym3<f64>) -> String {
    vector(Vec3::new(inertia.xy, inertia.xz, inertia.yz))
}

/// The magnitude of a difference, to four digits.
fn rounded(difference: f64) -> String {
    let digits = format!("{:.3e}", difference.abs());
    shown(digits.parse().unwrap_or(difference))
}

pub(crate) fn find(segment: &SegmentStructure, label: HingeLabel) -> Vec<StructureError> {
    let place = StructurePlace { segment: label, station: None, vertex: None };
    let mut found = Found { place, errors: Vec::new() };
    let SegmentStructure { pulse_constant, material, stations } = segment;
    let is_positive = |value: f64| value > 0.0 && value.is_finite();
    if !is_positive(*pulse_constant) {
        found.push(StructureDefect::PulseConstant(*pulse_constant));
    }
    material.defects().into_iter().for_each(|defect| found.push(defect.into()));
    for (j, station) in stations.iter().enumerate() {
        found.place.station = Some(j);
        found.check_slice(station);
        found.check_section(&station.section);
        found.check_distance(stations, j);
    }
    found.errors
}

/// What is allowed of the structure of body `i` but probably not meant.
pub(crate) fn doubtful(scene: &Scene, i: usize, segment: &SegmentStructure) -> Vec<StructureError> {
    let label = scene.label(i);
    let mut found = slices_inboard(segment, &label);
    let place = StructurePlace { segment: label, station: None, vertex: None };
    let of_segment = [beyond_rotor(scene, i, segment), long_pulse(scene, i, segment)];
    let of_segment = of_segment.into_iter().flatten();
    found.extend(of_segment.map(|defect| StructureError::Segment { place: place.clone(), defect }));
    found
}

fn beyond_rotor(scene: &Scene, i: usize, segment: &SegmentStructure) -> Option<StructureDefect> {
    let has_rotor = scene.rotors.iter().any(|rotor| rotor.body == Some(i));
    let is_away = |station: &&Station| station.distance_from_hinge > 0.0;
    let stations = segment.stations.iter().filter(is_away).count();
    (has_rotor && stations > 0).then_some(StructureDefect::BeyondRotor { stations })
}

/// Latches and stops end the motion of their hinge in an instant.
fn long_pulse(scene: &Scene, i: usize, segment: &SegmentStructure) -> Option<StructureDefect> {
    let (constant, run) = (segment.pulse_constant, scene.end_time - scene.initial.time);
    let is_long = scene.bodies[i].hinge.may_be_struck() && run > 0.0 && constant > run;
    is_long.then_some(StructureDefect::LongPulse { constant, run })
}

/// Stations whose slices lie inboard of them. One at the hinge carries all of its segment, whatever side that is on.
fn slices_inboard(segment: &SegmentStructure, label: &HingeLabel) -> Vec<StructureError> {
    let numbered = segment.stations.iter().enumerate();
    let lies_inboard = numbered.filter(|(_, Station { distance_from_hinge, slice, .. })| {
        let short = slice.center_of_mass.y < distance_from_hinge * (1.0 - ROUNDING);
        *distance_from_hinge > 0.0 && slice.mass > 0.0 && short
    });
    let warning = |(j, station): (usize, &Station)| {
        let place = StructurePlace { segment: label.clone(), station: Some(j), vertex: None };
        let (distance, center) = (station.distance_from_hinge, station.slice.center_of_mass.y);
        StructureError::Segment {
            place,
            defect: StructureDefect::SliceInboard { distance, center },
        }
    };
    lies_inboard.map(warning).collect()
}

/// The errors found so far, and where the search is.
struct Found {
    place: StructurePlace,
    errors: Vec<StructureError>,
}

impl Found {
    fn push(&mut self, defect: StructureDefect) {
        let place = self.place.clone();
        self.errors.push(StructureError::Segment { place, defect });
    }

    fn check_finite(&mut self, quantity: &'static str, value: f64) {
        if !value.is_finite() {
            self.push(StructureDefect::NotFinite { quantity, value });
        }
    }

    fn check_distance(&mut self, stations: &[Station], j: usize) {
        let distance = stations[j].distance_from_hinge;
        self.check_finite("distance", distance);
        if let Some(before) = j.checked_sub(1) {
            let outboard = stations[before].distance_from_hinge;
            if distance > outboard {
                self.push(StructureDefect::Order { distance, outboard });
            }
        }
        if j + 1 == stations.len() && distance.is_finite() && distance != 0.0 {
            self.push(StructureDefect::NotAtHinge(distance));
        }
    }

    fn check_slice(&mut self, station: &Station) {
        let slice = &station.slice;
        if !(slice.mass >= 0.0 && slice.mass.is_finite()) {
            self.push(StructureDefect::SliceMass(slice.mass));
        } else if let Some(defect) = slice.defect_apart_from_mass() {
            self.push(StructureDefect::Slice(defect));
        }
    }

    fn check_section(&mut self, section: &SectionShape) {
        match section {
            SectionShape::Tube { radius, thickness } => {
                self.check_finite("radius", *radius);
                self.check_finite("thickness", *thickness);
            }
            SectionShape::Polygon(vertices) => {
                for (l, vertex) in vertices.iter().enumerate() {
                    self.place.vertex = Some(l);
                    self.check_finite("ξ", vertex.xi);
                    self.check_finite("ζ", vertex.zeta);
                    self.check_finite("thickness", vertex.thickness);
                }
                self.place.vertex = None;
            }
        }
    }
}
