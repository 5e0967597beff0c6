use nboom_model::{SectionShape, Structure};
use nboom_scalar::{Vec3, Wrench};

use crate::{
    Point, PointStress, Polygon, PolygonStresses, Properties, SectionError, SectionWarning, Stress,
    Tube, TubeStresses,
};

/// A thin-walled section with one cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Section {
    /// Circular.
    Tube(Tube),
    /// With plane walls.
    Polygon(Polygon),
}

/// Something that belongs to a station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtStation<T> {
    /// The segment, as its hinge is numbered in the scene.
    pub segment: usize,
    /// The station, from 0, outboard ones first.
    pub station: usize,
    /// What it is.
    pub here: T,
}

impl Section {
    /// The sections of all stations, segment by segment.
    ///
    /// # Errors
    /// The first defect of the first wrong section.
    pub fn all(structure: &Structure) -> Result<Vec<AtStation<Self>>, AtStation<SectionError>> {
        let mut all = Vec::new();
        for (segment, description) in structure.segments().iter().enumerate() {
            for (station, of_station) in description.stations.iter().enumerate() {
                let section = Self::of_shape(&of_station.section);
                let here = section.map_err(|mut errors| AtStation {
                    segment,
                    station,
                    here: errors.swap_remove(0),
                })?;
                all.push(AtStation { segment, station, here });
            }
        }
        Ok(all)
    }

    /// The section that a station has.
    ///
    /// # Errors
    /// Everything that is wrong with its numbers, else with its walls, else with its outline.
    pub fn of_shape(shape: &SectionShape) -> Result<Self, Vec<SectionError>> {
        match shape {
            SectionShape::Tube { radius, thickness } => {
                Tube::new(*radius, *thickness).map(Self::Tube).map_err(|error| vec![error])
            }
            SectionShape::Polygon(vertices) => {
                let places: Vec<Point> =
                    vertices.iter().map(|v| Point { xi: v.xi, zeta: v.zeta }).collect();
                let thicknesses: Vec<f64> = vertices.iter().map(|v| v.thickness).collect();
                Polygon::new(&places, &thicknesses).map(Self::Polygon)
            }
        }
    }

    /// Its properties.
    pub fn properties(&self) -> Properties {
        match self {
            Self::Tube(tube) => tube.properties(),
            Self::Polygon(polygon) => *polygon.properties(),
        }
    }

    /// Where thin-wall theory may not hold.
    pub fn warnings(&self) -> Vec<SectionWarning> {
        match self {
            Self::Tube(tube) => tube.warnings(),
            Self::Polygon(polygon) => polygon.warnings(),
        }
    }

    /// The stresses under a load: force and moment, about the point on the η axis, that act on the
    /// part outboard of the section.
    pub fn stresses(&self, load: &Wrench<f64>) -> SectionStresses<'_> {
        match self {
            Self::Tube(tube) => SectionStresses::Tube(tube.stresses(load)),
            Self::Polygon(polygon) => SectionStresses::Polygon(polygon.stresses(load)),
        }
    }

    /// The stresses that these numbers describe, see [`SectionStresses::numbers`].
    pub fn described_by(&self, numbers: [f64; 6]) -> SectionStresses<'_> {
        match self {
            Self::Tube(tube) => SectionStresses::Tube(tube.described_by(numbers)),
            Self::Polygon(polygon) => SectionStresses::Polygon(polygon.described_by(numbers)),
        }
    }

    /// The contributions of P_ξ, P_η, P_ζ, Q_ξ, Q_η and Q_ζ of a load, one unit each, to the
    /// numbers that describe stresses; one row for each number.
    pub fn influence(&self) -> [[f64; 6]; 6] {
        let unit = |i: usize, at: usize| if i == at { 1.0 } else { 0.0 };
        let vector = |i: usize, at: usize| Vec3::new(unit(i, at), unit(i, at + 1), unit(i, at + 2));
        let columns: [[f64; 6]; 6] = std::array::from_fn(|i| {
            let load = Wrench { force: vector(i, 0), moment: vector(i, 3) };
            self.stresses(&load).numbers()
        });
        std::array::from_fn(|number| columns.map(|column| column[number]))
    }
}

/// The stresses in a section under one load.
#[derive(Clone, Copy, Debug)]
pub enum SectionStresses<'a> {
    /// In a tube.
    Tube(TubeStresses),
    /// In a polygon.
    Polygon(PolygonStresses<'a>),
}

impl SectionStresses<'_> {
    /// Six numbers, linear in the load, that describe them together with the section: for a tube
    /// the coefficients of normal and shear stress, for a polygon the normal stress at the
    /// centroid, its gradient, shear force and torsion moment.
    pub fn numbers(&self) -> [f64; 6] {
        match self {
            Self::Tube(stresses) => stresses.numbers(),
            Self::Polygon(stresses) => stresses.numbers(),
        }
    }

    /// The point at which the von Mises stress is largest.
    pub fn max_von_mises(&self) -> PointStress {
        match self {
            Self::Tube(stresses) => stresses.at(stresses.max_von_mises()),
            Self::Polygon(stresses) => {
                let (wall, x) = stresses.max_von_mises();
                stresses.at(wall, x)
            }
        }
    }

    /// Whether bounds show that the von Mises stress is nowhere above `level`; cheaper than
    /// [`max_von_mises`](Self::max_von_mises), and seldom undecided.
    pub fn is_at_most(&self, level: f64) -> bool {
        match self {
            Self::Tube(stresses) => stresses.is_at_most(level),
            Self::Polygon(stresses) => stresses.is_at_most(level),
        }
    }

    /// The stress at a point of the section that was found for another load.
    pub fn at(&self, point: &PointStress) -> Stress {
        match self {
            Self::Tube(stresses) => stresses.at(point.place.zeta.atan2(point.place.xi)).stress,
            Self::Polygon(stresses) => stresses.near(point),
        }
    }

    /// Stresses at the four axis points of the report, 0, 90, 180 and 270 degrees from ξ towards ζ:
    /// where rays from the centroid leave the section. A polygon that is not convex may lack some.
    pub fn axis_points(&self) -> [Option<PointStress>; 4] {
        match self {
            Self::Tube(stresses) => stresses.axis_points().map(Some),
            Self::Polygon(stresses) => stresses.axis_points(),
        }
    }
}
