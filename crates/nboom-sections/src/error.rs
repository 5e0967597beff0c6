use std::fmt;

use nboom_model::{Finding, shown};

/// Why a description is not a thin-walled section with one cell.
///
/// Vertices and walls are stored from 0 and shown from 1; wall n joins vertex n to the next one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.finding())]
#[non_exhaustive]
pub enum SectionError {
    /// There are too few vertices to enclose anything.
    TooFewVertices {
        /// How many there are.
        found: usize,
    },
    /// There are more vertices than a section may have.
    TooManyVertices {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// Walls and their thicknesses differ in number.
    #[error("{}, as many as vertices", self.finding())]
    ThicknessCount {
        /// How many thicknesses there are.
        found: usize,
        /// How many vertices there are.
        expected: usize,
    },
    /// A coordinate of a vertex is not finite.
    Vertex {
        /// The vertex.
        vertex: usize,
        /// Its ξ.
        xi: f64,
        /// Its ζ.
        zeta: f64,
    },
    /// A wall has no thickness.
    Thickness {
        /// The wall.
        wall: usize,
        /// The given thickness.
        thickness: f64,
    },
    /// A wall has no length.
    ZeroLengthWall {
        /// The wall, and the vertex that it starts from.
        wall: usize,
        /// The vertex that it ends at.
        next: usize,
    },
    /// The outline meets itself; the error names the first wall that this one meets.
    Crossing {
        /// The wall with the lower number.
        wall: usize,
        /// The other one.
        other: usize,
    },
    /// The walls enclose nothing, as those of an open section.
    NoEnclosedArea {
        /// The area inside the outline.
        area: f64,
    },
    /// A tube has no radius.
    Radius {
        /// The given radius.
        radius: f64,
    },
    /// A tube has no wall, or one thicker than its radius.
    TubeThickness {
        /// The given thickness.
        thickness: f64,
        /// The radius.
        radius: f64,
    },
    /// Numbers are finite, but properties computed from them are not, or vanish.
    Range,
}

impl SectionError {
    /// What was found, with its vertex or wall before it, and what expected.
    pub fn finding(&self) -> Finding {
        match *self {
            Self::TooFewVertices { found } => {
                Finding::new(format!("{found} vertices"), "at least 3")
            }
            Self::TooManyVertices { found, most } => {
                Finding::new(format!("{found} vertices"), format!("at most {most}"))
            }
            Self::ThicknessCount { found, expected } => {
                Finding::new(format!("{found} wall thicknesses"), expected.to_string())
            }
            Self::Vertex { vertex, xi, zeta } => Finding::new(
                format!("vertex {}: coordinates {} and {}", vertex + 1, shown(xi), shown(zeta)),
                "finite numbers",
            ),
            Self::Thickness { wall, thickness } => Finding::new(
                format!("wall {}: thickness {}", wall + 1, shown(thickness)),
                "a positive finite number",
            ),
            Self::ZeroLengthWall { wall, next } => Finding::new(
                format!("wall {}: length zero", wall + 1),
                format!("vertices {} and {} at different points", wall + 1, next + 1),
            ),
            Self::Crossing { wall, other } => Finding::new(
                format!("walls {} and {} that cross or touch", wall + 1, other + 1),
                "one cell",
            ),
            Self::NoEnclosedArea { area } => {
                Finding::new(format!("enclosed area {}", shown(area)), "a closed cell")
            }
            Self::Radius { radius } => {
                Finding::new(format!("radius {}", shown(radius)), "a positive finite number")
            }
            Self::TubeThickness { thickness, radius } => Finding::new(
                format!("thickness {}", shown(thickness)),
                format!("above 0 and at most the radius {}", shown(radius)),
            ),
            Self::Range => {
                Finding::new("properties beyond the range of numbers", "lengths in other units")
            }
        }
    }
}

/// A section that can be computed, but for which thin-wall theory may not hold.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SectionWarning {
    /// Walls of a polygon are thick compared with its cell.
    ThickWall {
        /// The thickest wall, from 0.
        wall: usize,
        /// Its thickness over the mean radius of the cell, twice the enclosed area over the perimeter.
        ratio: f64,
    },
    /// The wall of a tube is thick compared with the radius.
    ThickTube {
        /// Thickness over radius.
        ratio: f64,
    },
}

/// Thickness over radius up to which a wall counts as thin.
const THIN: f64 = 0.1;

impl SectionWarning {
    pub(crate) fn of_wall(wall: usize, ratio: f64) -> Option<Self> {
        (ratio > THIN).then_some(Self::ThickWall { wall, ratio })
    }

    pub(crate) fn of_tube(ratio: f64) -> Option<Self> {
        (ratio > THIN).then_some(Self::ThickTube { ratio })
    }

    /// What was found, with its wall before it, and what expected.
    pub fn finding(&self) -> Finding {
        let found = match self {
            Self::ThickWall { wall, ratio } => {
                format!("wall {}: thickness {ratio:.3} of the mean radius of the cell", wall + 1)
            }
            Self::ThickTube { ratio } => format!("thickness {ratio:.3} of the radius"),
        };
        Finding::new(found, format!("at most {THIN} for thin-wall theory"))
    }
}

impl fmt::Display for SectionWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.finding().fmt(f)
    }
}
