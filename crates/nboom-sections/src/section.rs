use nboom_scalar::Wrench;

use crate::{PointStress, Polygon, Properties, SectionWarning, Stress, Tube};

/// A thin-walled section with one cell.
#[derive(Clone, Debug, PartialEq)]
pub enum Section {
    /// Circular.
    Tube(Tube),
    /// With plane walls.
    Polygon(Polygon),
}

impl Section {
    /// What it is, apart from any load.
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

    /// The point at which the von Mises stress is largest under a load: force and moment, about the
    /// point on the η axis, that act on the part outboard of the section.
    pub fn severest(&self, load: &Wrench<f64>) -> PointStress {
        match self {
            Self::Tube(tube) => {
                let stresses = tube.stresses(load);
                stresses.at(stresses.severest())
            }
            Self::Polygon(polygon) => {
                let stresses = polygon.stresses(load);
                let (wall, x) = stresses.severest();
                stresses.at(wall, x)
            }
        }
    }

    /// The stress that a load makes at a point of the section which another load was found at.
    pub fn at(&self, point: &PointStress, load: &Wrench<f64>) -> Stress {
        match self {
            Self::Tube(tube) => {
                let theta = point.place.zeta.atan2(point.place.xi);
                tube.stresses(load).at(theta).stress
            }
            Self::Polygon(polygon) => {
                let number = point.wall.unwrap_or(0);
                let x = polygon.walls()[number].nearest(point.place);
                polygon.stresses(load).at(number, x).stress
            }
        }
    }

    /// Stresses at the four axis points of the report, 0, 90, 180 and 270 degrees from ξ towards ζ:
    /// where rays from the centroid leave the section. A polygon that is not convex may lack some.
    pub fn axis_points(&self, load: &Wrench<f64>) -> [Option<PointStress>; 4] {
        match self {
            Self::Tube(tube) => {
                let stresses = tube.stresses(load);
                Tube::AXIS_ANGLES.map(|theta| Some(stresses.at(theta)))
            }
            Self::Polygon(polygon) => {
                let stresses = polygon.stresses(load);
                polygon.axis_points().map(|place| place.map(|(wall, x)| stresses.at(wall, x)))
            }
        }
    }
}
