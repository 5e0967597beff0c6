//! The right side of the differential equations of one mode: from attitude, rate, angles and rates of
//! the hinges to their rates of change.

use std::ops::Range;

use nboom_model::Topology;

use crate::parameters::Layout;

/// Where the numbers of a right side stand: parameters of the satellite and of what acts on it, variables
/// y, and ẏ. Hinges are in the topology's order, appendage by appendage.
///
/// Parameters are those of [`Layout`], then those of [`Forces`](crate::Forces). y is the attitude χ, K̄
/// (a quaternion that turns main-body components into inertial ones, of any norm), ω along main-body
/// axes, β of each hinge, τ of each hinge. ẏ has the same order, and after it follows the power of the
/// parts of the hinge torques that depend on rates.
pub struct RightSideLayout;

impl RightSideLayout {
    /// Where the attitude stands in y.
    pub const ATTITUDE: Range<usize> = 0..4;
    /// Where ω stands in y.
    pub const OMEGA: Range<usize> = 4..7;
    /// Numbers of y before the hinges.
    pub const STATE: usize = 7;
    /// Numbers of the torque about a hinge: q₁, q₂, A₂, A₁, A₀.
    pub const LAW: usize = 5;
    /// Numbers of the external wrench about O, main-body axes: moment, force.
    pub const EXTERNAL: usize = 6;
    /// Numbers of a line: its end on the link, that on the main body, a₀ to a₃.
    pub const LINE: usize = 10;

    /// How many numbers y has.
    pub fn coordinates(topology: &Topology) -> usize {
        Self::tau(topology).end
    }

    /// Where the hinges' β stand in y.
    pub fn beta(topology: &Topology) -> Range<usize> {
        Self::STATE..Self::STATE + topology.hinges()
    }

    /// Where the hinges' τ stand in y.
    pub fn tau(topology: &Topology) -> Range<usize> {
        let start = Self::beta(topology).end;
        start..start + topology.hinges()
    }

    /// How many numbers an evaluation writes: ẏ and the power.
    pub fn outputs(topology: &Topology) -> usize {
        Self::power(topology) + 1
    }

    /// Where the power stands among what an evaluation writes.
    pub fn power(topology: &Topology) -> usize {
        Self::coordinates(topology)
    }

    /// How many numbers parameters take.
    pub fn parameters(topology: &Topology) -> usize {
        let hinges = topology.hinges();
        Self::external(topology).end + Self::LINE * hinges
    }

    /// Where the law of a hinge stands among the parameters.
    pub fn law(topology: &Topology, hinge: usize) -> Range<usize> {
        let start = Layout::parameters(topology) + Self::LAW * hinge;
        start..start + Self::LAW
    }

    /// Where the external wrench stands among the parameters.
    pub fn external(topology: &Topology) -> Range<usize> {
        let start = Self::law(topology, topology.hinges()).start;
        start..start + Self::EXTERNAL
    }

    /// Where the line that pushes the link of a hinge stands among the parameters.
    pub fn line(topology: &Topology, hinge: usize) -> Range<usize> {
        let start = Self::external(topology).end + Self::LINE * hinge;
        start..start + Self::LINE
    }
}
