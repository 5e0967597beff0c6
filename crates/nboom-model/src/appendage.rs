use nboom_scalar::Vec3;

use crate::{Body, Hinge, Joint, MassProperties, Mount};

/// One segment of a regular or paddle appendage, in segment axes ξ, η, ζ.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// ℓ, from this segment's hinge along η to the next one, or to its outer end.
    pub length: f64,
    /// Mass properties; mass centre from the inboard hinge, segment axes.
    pub mass_properties: MassProperties,
    /// The segment's inboard hinge.
    pub hinge: Hinge,
}

/// The report's two ways to write bodies of the tree, Section 4; segment axes are those of
/// eqs. (9.1) and (9.2).
///
/// `mount.rot_inboard_from_hinge` holds the appendage axes ê₁, ê₂, ê₃ as columns, eq. (9.6).
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a handful of these lives while a scene is written")]
pub enum Appendage {
    /// A chain of segments whose hinge axes are all parallel to ê₁.
    Regular {
        /// The first hinge on the main body.
        mount: Mount,
        /// Segments, inboard before outboard.
        segments: Vec<Segment>,
    },
    /// An arm that turns about ê₁ and a paddle that turns about the arm's η axis.
    Paddle {
        /// The arm's hinge on the main body.
        mount: Mount,
        /// The arm; its length reaches to a point on the paddle's axis.
        arm: Segment,
        /// The paddle, whose length no motion depends on.
        paddle: Segment,
    },
}

impl Appendage {
    /// The bodies of this appendage, numbered from `first` in the tree.
    pub fn bodies(&self, first: usize) -> Vec<Body> {
        match self {
            Self::Regular { mount, segments } => {
                let axes = segments.iter().map(|segment| (segment, Vec3::unit_x()));
                chain(*mount, axes, first)
            }
            Self::Paddle { mount, arm, paddle } => {
                chain(*mount, [(arm, Vec3::unit_x()), (paddle, Vec3::unit_y())], first)
            }
        }
    }
}

fn chain<'a>(
    first_mount: Mount,
    segments: impl IntoIterator<Item = (&'a Segment, Vec3<f64>)>,
    first: usize,
) -> Vec<Body> {
    let mut mount = first_mount;
    let mut bodies = Vec::new();
    for (i, (segment, axis)) in segments.into_iter().enumerate() {
        bodies.push(Body {
            inboard: (i > 0).then(|| first + i - 1),
            mount,
            joint: Joint::Revolute,
            axis,
            mass_properties: segment.mass_properties,
            tip: Vec3::unit_y() * segment.length,
            hinge: segment.hinge,
        });
        mount = Mount::at(Vec3::unit_y() * segment.length);
    }
    bodies
}
