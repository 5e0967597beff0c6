//! Inverse dynamics: what makes a satellite move with given accelerations.

use nboom_model::{LimbJoint, LimbLink, Shape, Topology};
use nboom_scalar::{Mat3, Real, Twist, Vec3, Wrench};

use crate::articulated::first_hinge;
use crate::chain::ChainLink;
use crate::limb;
use crate::parameters::{Branch, Coordinates, HingeCoordinates, Mount, Parameters, Solution};
use crate::pose;

/// A motion with its accelerations.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<R> {
    /// ω, main-body axes \[rad/T\].
    pub omega: Vec3<R>,
    /// ω̇ and a_O, main-body axes; with gravity, a_O less that of a body in free fall.
    pub main: Twist<R>,
    /// β, τ and τ̇ of each hinge, appendage by appendage.
    pub hinges: Vec<HingeMotion<R>>,
}

/// Angle, rate and acceleration of one hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingeMotion<R> {
    /// Angle relative to the inboard link \[rad\], or travel of a slide.
    pub beta: R,
    /// Rate relative to the inboard link.
    pub tau: R,
    /// Acceleration relative to the inboard link.
    pub tau_dot: R,
}

/// What acts on a satellite.
#[derive(Clone, Debug, PartialEq)]
pub struct Drive<R> {
    /// Wrench on the main body about O, main-body axes.
    pub external: Wrench<R>,
    /// Generalised force conjugate to β of each hinge, appendage by appendage.
    pub torques: Vec<R>,
}

impl<R: Real> Motion<R> {
    /// Reads what [`write`](Self::write) writes.
    pub fn read(topology: &Topology, numbers: &[R]) -> Self {
        let Coordinates { omega, external, hinges } = Coordinates::read(topology, numbers);
        let main = Twist { angular: external.moment, linear: external.force };
        let hinge =
            |HingeCoordinates { beta, tau, torque: tau_dot }| HingeMotion { beta, tau, tau_dot };
        Self { omega, main, hinges: hinges.into_iter().map(hinge).collect() }
    }

    /// The numbers in the order of [`Layout`](crate::Layout) for a state, ω̇ and a_O in the place of moment
    /// and force, τ̇ in that of torques.
    pub fn write(&self, topology: &Topology) -> Vec<R> {
        let Twist { angular: moment, linear: force } = self.main;
        let hinge = |&HingeMotion { beta, tau, tau_dot: torque }: &HingeMotion<R>| {
            HingeCoordinates { beta, tau, torque }
        };
        let hinges = self.hinges.iter().map(hinge).collect();
        let external = Wrench { moment, force };
        Coordinates { omega: self.omega, external, hinges }.write(topology)
    }
}

impl<R: Real> Drive<R> {
    /// The numbers in the order of [`Layout`](crate::Layout) for accelerations: moment and force in the place
    /// of ω̇ and a_O, torques in that of τ̇.
    pub fn write(&self, topology: &Topology) -> Vec<R> {
        let Wrench { moment: angular, force: linear } = self.external;
        let tau_dot = self.torques.clone();
        Solution { main: Twist { angular, linear }, tau_dot }.write(topology)
    }
}

/// The wrench on the main body and the hinge torques under which a satellite of any topology has this motion:
/// the equations of motion read backwards, by Newton's and Euler's laws link by link, O(n).
pub fn inverse_dynamics<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    motion: &Motion<R>,
) -> Drive<R> {
    let Motion { omega, main, hinges } = motion;
    let mut external = parameters.main.inertia_wrench(*omega, *main);
    let mut torques = Vec::with_capacity(hinges.len());
    for (i, (shape, branch)) in topology.shapes().iter().zip(&parameters.branches).enumerate() {
        let number = i + 1;
        R::remark(|| format!("Appendage {number}: accelerations of its first joint."));
        let rot = &branch.rot_body_from_appendage;
        let (angular, linear) = first_hinge(branch.point, rot, *main);
        let at_mount = Twist { angular, linear };
        let hinges = &hinges[torques.len()..torques.len() + shape.hinges()];
        let (links, branch) = in_links(shape, branch);
        let (wrench, of_hinges) = limb::inverse(number, &links, &branch, *omega, at_mount, hinges);
        R::remark(|| format!("Appendage {number}: its wrench about O, main-body axes."));
        external.add(pose::rotated(wrench.seen_from(branch.point), rot));
        torques.extend(of_hinges);
    }
    Drive { external, torques }
}

/// An appendage of any shape in terms of a limb: its links and their mounts.
fn in_links<R: Real>(shape: &Shape, branch: &Branch<R>) -> (Vec<LimbLink>, Branch<R>) {
    let ways = branch.links.iter().map(|link| link.next);
    let link = |i: usize, joint| {
        let inboard = i.checked_sub(1);
        let inboard = inboard.map(|i| u16::try_from(i).expect("so many links fit into no memory"));
        LimbLink { inboard, joint }
    };
    match shape {
        Shape::Limb(limb) => (limb.links().to_vec(), branch.clone()),
        &Shape::Chain(count) => {
            let links = (0..count).map(|i| match i {
                0 => link(i, LimbJoint::Revolute),
                _ => link(i, LimbJoint::Parallel),
            });
            let mounts = ways.take(count - 1).map(Mount::Parallel).collect();
            (links.collect(), Branch { mounts: Some(mounts), ..branch.clone() })
        }
        Shape::Paddle => {
            let (arm, paddle) = (branch.links[0], branch.links[1]);
            let [ly, lz] = arm.next;
            // ê₁ is along the paddle's hinge, η of the arm.
            let rot = Mat3::from_columns(Vec3::unit_y(), Vec3::unit_z(), Vec3::unit_x());
            let mount = Mount::Across { rot, point: Vec3::new(R::zero(), ly, lz) };
            let inertia = paddle.inertia.rotated(&rot.transpose());
            let links = vec![arm, ChainLink { inertia, ..paddle }];
            let branch = Branch { links, mounts: Some(vec![mount]), ..branch.clone() };
            (vec![link(0, LimbJoint::Revolute), link(1, LimbJoint::Revolute)], branch)
        }
    }
}
