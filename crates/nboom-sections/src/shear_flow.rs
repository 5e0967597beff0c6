//! Shear flow q = τ t of a closed cell, positive along the numbering of the walls.
//!
//! From equilibrium of a strip of the wall, dq/ds = −t (c_ξ ξ′ + c_ζ ζ′) with (c_ξ, c_ζ) from the
//! second moments on the middle line, so that ∮ q dξ and ∮ q dζ are the shear forces exactly. The
//! constant is that of the torsion moment.

use crate::{Point, SecondMoments, Wall};

/// Coefficients of the flow along one wall in x, the constant first, under unit loads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct UnitFlows {
    /// A unit shear force along ξ through the centroid.
    pub(crate) xi: [f64; 3],
    /// A unit shear force along ζ through the centroid.
    pub(crate) zeta: [f64; 3],
    /// A unit moment about η.
    pub(crate) torsion: f64,
}

impl UnitFlows {
    /// Not yet computed.
    pub(crate) const NONE: Self = Self { xi: [0.0; 3], zeta: [0.0; 3], torsion: 0.0 };
}

/// Puts the unit flows into the walls and returns the shear centre as seen from the centroid.
pub(crate) fn solve(
    walls: &mut [Wall],
    centroid: Point,
    inertia: SecondMoments,
    signed_area: f64,
) -> Point {
    let xi = torque_free_flow(walls, centroid, inertia.solve(1.0, 0.0), signed_area);
    let zeta = torque_free_flow(walls, centroid, inertia.solve(0.0, 1.0), signed_area);
    // ∮ (ζ′ dξ − ξ′ dζ), the moment of a unit flow, is minus twice the area.
    let torsion = -0.5 / signed_area;
    let centre = Point {
        xi: -twistless_moment(walls, &zeta, signed_area),
        zeta: twistless_moment(walls, &xi, signed_area),
    };
    for (i, wall) in walls.iter_mut().enumerate() {
        wall.flows = UnitFlows { xi: xi[i], zeta: zeta[i], torsion };
    }
    centre
}

/// The flow of this gradient of normal stress that has no moment about the centroid.
fn torque_free_flow(
    walls: &[Wall],
    centroid: Point,
    gradient: Point,
    signed_area: f64,
) -> Vec<[f64; 3]> {
    let mut flow = Vec::with_capacity(walls.len());
    let (mut start, mut moment) = (0.0, 0.0);
    for wall in walls {
        let arm = wall.start() - centroid;
        let slope = -wall.area() * gradient.dot(arm);
        let bend = -0.5 * wall.area() * gradient.dot(wall.along());
        // ζ′ dξ − ξ′ dζ is constant along a wall.
        moment -= arm.cross(wall.along()) * (start + slope / 2.0 + bend / 3.0);
        flow.push([start, slope, bend]);
        start += slope + bend;
    }
    let closing = 0.5 * moment / signed_area;
    flow.iter_mut().for_each(|[constant, _, _]| *constant += closing);
    flow
}

/// The moment about the centroid of the circulating flow that cancels the twist ∮ q/t ds of a
/// torque-free one.
fn twistless_moment(walls: &[Wall], flow: &[[f64; 3]], signed_area: f64) -> f64 {
    let flexibility = |wall: &Wall| wall.length() / wall.thickness();
    let total: f64 = walls.iter().map(flexibility).sum();
    let twist = walls.iter().zip(flow).map(|(wall, [a, b, c])| {
        let mean = a + b / 2.0 + c / 3.0;
        mean * flexibility(wall)
    });
    2.0 * signed_area * twist.sum::<f64>() / total
}
