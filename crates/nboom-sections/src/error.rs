use std::fmt;

/// Why a description is not a thin-walled section with one cell.
///
/// Vertices and walls are stored from 0 and shown from 1; wall n joins vertex n to the next one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SectionError {
    /// There are too few vertices to enclose anything.
    #[error("{found} vertices found, at least 3 expected")]
    TooFewVertices {
        /// How many there are.
        found: usize,
    },
    /// There are more vertices than a section may have.
    #[error("{found} vertices found, at most {most} expected")]
    TooManyVertices {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// Walls and their thicknesses differ in number.
    #[error("{found} wall thicknesses found, {expected} expected, as many as vertices")]
    ThicknessCount {
        /// How many thicknesses there are.
        found: usize,
        /// How many vertices there are.
        expected: usize,
    },
    /// A coordinate of a vertex is not finite.
    #[error("vertex {}: coordinates {xi} and {zeta} found, finite numbers expected", vertex + 1)]
    Vertex {
        /// The vertex.
        vertex: usize,
        /// Its ξ.
        xi: f64,
        /// Its ζ.
        zeta: f64,
    },
    /// A wall has no thickness.
    #[error("wall {}: thickness {thickness} found, a positive finite number expected", wall + 1)]
    Thickness {
        /// The wall.
        wall: usize,
        /// The given thickness.
        thickness: f64,
    },
    /// A wall has no length.
    #[error(
        "wall {}: length zero found, vertices {} and {} at different points expected",
        wall + 1, wall + 1, next + 1
    )]
    ZeroLengthWall {
        /// The wall, and the vertex that it starts from.
        wall: usize,
        /// The vertex that it ends at.
        next: usize,
    },
    /// The outline meets itself; the error names the first wall that this one meets.
    #[error("walls {} and {} that cross or touch found, one cell expected", wall + 1, other + 1)]
    Crossing {
        /// The wall with the lower number.
        wall: usize,
        /// The other one.
        other: usize,
    },
    /// The walls enclose nothing, as those of an open section.
    #[error("enclosed area {area} found, a closed cell expected")]
    NoEnclosedArea {
        /// The area inside the outline.
        area: f64,
    },
    /// A tube has no radius.
    #[error("radius {radius} found, a positive finite number expected")]
    Radius {
        /// The given radius.
        radius: f64,
    },
    /// A tube has no wall, or one thicker than its radius.
    #[error("thickness {thickness} found, above 0 and at most the radius {radius} expected")]
    TubeThickness {
        /// The given thickness.
        thickness: f64,
        /// The radius.
        radius: f64,
    },
    /// Numbers are finite, but properties computed from them are not, or vanish.
    #[error("properties beyond the range of numbers found, lengths in other units expected")]
    Range,
}

/// A section that can be computed, but for which thin-wall theory may not hold.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum SectionWarning {
    /// A wall of a polygon is thick compared with its length.
    ThickWall {
        /// The wall, from 0.
        wall: usize,
        /// Thickness over length.
        ratio: f64,
    },
    /// The wall of a tube is thick compared with the radius.
    ThickTube {
        /// Thickness over radius.
        ratio: f64,
    },
}

/// Thickness over length, or over radius, up to which a wall counts as thin.
const THIN: f64 = 0.1;

impl SectionWarning {
    pub(crate) fn of_wall(wall: usize, ratio: f64) -> Option<Self> {
        (ratio > THIN).then_some(Self::ThickWall { wall, ratio })
    }

    pub(crate) fn of_tube(ratio: f64) -> Option<Self> {
        (ratio > THIN).then_some(Self::ThickTube { ratio })
    }
}

impl fmt::Display for SectionWarning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ThickWall { wall, ratio } => write!(
                f,
                "wall {}: thickness {ratio:.3} of its length found, at most {THIN} for thin-wall theory \
                 expected",
                wall + 1
            ),
            Self::ThickTube { ratio } => {
                write!(
                    f,
                    "thickness {ratio:.3} of the radius found, at most {THIN} for thin-wall theory \
                     expected"
                )
            }
        }
    }
}
