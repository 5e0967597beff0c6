//! The right side of the differential equations of one mode: from attitude, rate, angles and rates of
//! the hinges to their rates of change.

use std::ops::Range;

use nboom_model::Topology;
use nboom_scalar::{Quaternion, Real, Vec3};

use crate::Formulation;
use crate::forces::Forces;
use crate::parameters::{Coordinates, HingeCoordinates, Layout, Parameters, Solution};

/// Where the numbers of a right side stand: parameters of the satellite and of what acts on it, variables
/// y, and ẏ. Hinges are in the topology's order, appendage by appendage.
///
/// Parameters are those of [`Layout`], then those of [`Forces`]. y is the attitude χ, K̄
/// (a quaternion that turns main-body components into inertial ones, of any norm), ω along main-body
/// axes, β of each hinge, τ of each hinge. ẏ has the same order, and after it follows the power of the
/// parts of the hinge torques that depend on rates.
#[derive(Clone, Copy, Debug)]
pub struct RightSideLayout;

impl RightSideLayout {
    /// Where the attitude stands in y.
    pub const ATTITUDE: Range<usize> = 0..4;
    /// Where ω stands in y.
    pub const OMEGA: Range<usize> = 4..7;
    /// Numbers of y before the hinges.
    pub const STATE: usize = 7;
    /// Numbers of the torque about a hinge: q₁, q₂, A₃, A₂, A₁, A₀, β₀.
    pub const LAW: usize = 7;
    /// Numbers of the external wrench about O, main-body axes: moment, force.
    pub const EXTERNAL: usize = 6;
    /// Numbers of the rotors on the main body: h̄, their angular momentum relative to it, main-body axes.
    pub const SPIN: usize = 3;
    /// Numbers of a line: its end on the link, that on the main body, a₀ to a₃.
    pub const LINE: usize = 10;
    /// Lines that may push one link: kick-off springs of bodies that are held together push as one link.
    pub const LINES_OF_LINK: usize = 2;

    /// Numbers of the coupling of a hinge with the one inboard of it: ρ₁, ρ₂, k, θ, c.
    pub const COUPLING: usize = 5;

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
        Self::coupling(topology, topology.hinges()).start
    }

    /// How many places for lines there are: first one for each hinge's link, then one more for each.
    pub fn lines(topology: &Topology) -> usize {
        Self::LINES_OF_LINK * topology.hinges()
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

    /// Where the angular momentum of the rotors on the main body stands among the parameters.
    pub fn spin(topology: &Topology) -> Range<usize> {
        let start = Self::external(topology).end;
        start..start + Self::SPIN
    }

    /// Where the line at a place stands among the parameters.
    pub fn line(topology: &Topology, place: usize) -> Range<usize> {
        let start = Self::spin(topology).end + Self::LINE * place;
        start..start + Self::LINE
    }

    /// Where that line's a₀ to a₃ stand; they are zero where nothing pushes.
    pub fn coefficients(topology: &Topology, place: usize) -> Range<usize> {
        let Range { end, .. } = Self::line(topology, place);
        end - 4..end
    }

    /// Where the coupling of a hinge with the one inboard of it stands among the parameters.
    pub fn coupling(topology: &Topology, hinge: usize) -> Range<usize> {
        let start = Self::line(topology, Self::lines(topology)).start + Self::COUPLING * hinge;
        start..start + Self::COUPLING
    }

    /// Where that coupling's stiffness k and damping c stand; they are zero where there is none.
    pub fn strength(topology: &Topology, hinge: usize) -> [usize; 2] {
        let Range { start, .. } = Self::coupling(topology, hinge);
        [start + 2, start + 4]
    }
}

/// ẏ and the power at y, in the order of [`RightSideLayout`], accelerations by `formulation`.
///
/// eq. (9.15) for the attitude, (6.1) and (6.17) for the forces.
pub fn right_side<R: Real>(
    formulation: Formulation,
    topology: &Topology,
    parameters: &Parameters<R>,
    forces: &Forces<R>,
    y: &[R],
) -> Vec<R> {
    let [beta, tau] = [RightSideLayout::beta, RightSideLayout::tau].map(|of| &y[of(topology)]);
    let vector = |at: usize| Vec3::new(y[at], y[at + 1], y[at + 2]);
    let omega = vector(RightSideLayout::OMEGA.start);
    R::remark(|| "Attitude: its rate.".to_owned());
    let rate = Quaternion { scalar: y[0], vector: vector(1) }.rate(omega);
    R::remark(|| "Hinges: power of what depends on their rates.".to_owned());
    let power = forces.rate_power(topology, tau);
    let torques = forces.torques(topology, parameters, [beta, tau]);
    let hinges = beta.iter().zip(tau).zip(torques);
    let hinges =
        hinges.map(|((&beta, &tau), torque)| HingeCoordinates { beta, tau, torque }).collect();
    let coordinates = Coordinates { omega, external: forces.on_main_body(omega), hinges };
    let Solution { main, tau_dot } = formulation.solve(topology, parameters, &coordinates);
    let mut rates = vec![rate.scalar];
    rates.extend(rate.vector.to_array());
    rates.extend(main.angular.to_array());
    rates.extend(tau);
    rates.extend(tau_dot);
    rates.push(power);
    rates
}
