//! Formulation `articulated`: O(n) elimination, form P of the cost table in
//! `docs/formulations.md`.

use nboom_model::{Limb, Shape, Topology, WeldedTree};
use nboom_scalar::{Mat3, Real, Twist, Vec3, Wrench};

use crate::base::AtOrigin;
use crate::chain::{self, Eliminated, OutboardShare, Outward, Spin, Turned};
use crate::formulation::ClosedForm;
use crate::limb::{self, EliminatedLink};
use crate::paddle::{self, ArmRates, Paddle};
use crate::parameters::{Branch, Coordinates, HingeCoordinates, Parameters, Solution};
use crate::recognise::{Uncovered, recognise};

/// Accelerations of a satellite by this formulation: [`Formulation::solve`](crate::Formulation::solve), for programs
/// that need no other compiled.
pub fn solve<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    coordinates: &Coordinates<R>,
) -> Solution<R> {
    Articulated::solve(topology, parameters, coordinates)
}

/// The row of [`Formulation`](crate::Formulation)'s table.
pub(crate) struct Articulated;

impl ClosedForm for Articulated {
    const NAME: &'static str = "articulated";
    const ABOUT: &'static str = "O(n) elimination over (ω̇, a_O, τ̇), hinge by hinge from the tips";

    const TAKES_LIMBS: bool = true;

    fn covers(tree: &WeldedTree<f64>) -> Result<(), Uncovered> {
        recognise(tree).map(|_| ())
    }

    fn solve<R: Real>(
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Solution<R> {
        let omega = coordinates.omega;
        let mut seen = AtOrigin::nothing();
        let mut first = 0;
        let mut appendages = Vec::with_capacity(parameters.branches.len());
        for (shape, branch) in topology.shapes().iter().zip(&parameters.branches) {
            let hinges = &coordinates.hinges[first..first + shape.hinges()];
            let number = appendages.len() + 1;
            R::remark(|| {
                format!("Appendage {number}: ω in its axes, and how its first joint moves.")
            });
            let appendage = match shape {
                Shape::Limb(limb) => {
                    let at_mount = limb::of_main_body(branch, omega);
                    let (share, links) =
                        limb::eliminate(number, limb.links(), branch, &at_mount, hinges);
                    Appendage::Limb { limb: limb.clone(), share, links }
                }
                Shape::Chain(_) | Shape::Paddle => Appendage::Planar(ChainOrPaddle::eliminate(
                    number,
                    *shape == Shape::Paddle,
                    branch,
                    omega,
                    hinges,
                )),
            };
            if !parameters.main_is_held {
                R::remark(|| format!("Appendage {number}: what it shows at O, main-body axes."));
                seen.add(&appendage.at_origin(branch));
            }
            appendages.push(appendage);
            first += shape.hinges();
        }
        let main = accelerations_of_main(parameters, omega, &coordinates.external, &seen);
        let mut tau_dot = Vec::with_capacity(coordinates.hinges.len());
        for (i, (appendage, branch)) in appendages.iter().zip(&parameters.branches).enumerate() {
            appendage.back(i + 1, branch, main, &mut tau_dot);
        }
        Solution { main, tau_dot }
    }
}

/// ω̇ and a_O of a main body on which appendages are `seen` at O.
fn accelerations_of_main<R: Real>(
    Parameters { main, main_is_held, .. }: &Parameters<R>,
    omega: Vec3<R>,
    external: &Wrench<R>,
    seen: &AtOrigin<R>,
) -> Twist<R> {
    if *main_is_held {
        R::remark(|| "Main body: as it is held.".to_owned());
        return AtOrigin::accelerations_of_held(main, external);
    }
    R::remark(|| "Main body: its own wrench, and all shares at O.".to_owned());
    let mut total = AtOrigin::of_main_body(main, omega, external);
    total.add(seen);
    R::remark(|| "Main body: a_O eliminated, ω̇ solved for, then a_O.".to_owned());
    total.accelerations()
}

/// An appendage whose hinges have been eliminated.
enum Appendage<R> {
    Planar(ChainOrPaddle<R>),
    Limb { limb: Limb, share: AtOrigin<R>, links: Vec<EliminatedLink<R>> },
}

impl<R: Real> Appendage<R> {
    fn at_origin(&self, branch: &Branch<R>) -> AtOrigin<R> {
        match self {
            Self::Planar(planar) => planar.at_origin(branch),
            Self::Limb { share, .. } => limb::at_origin(share, branch),
        }
    }

    fn back(&self, number: usize, branch: &Branch<R>, main: Twist<R>, tau_dot: &mut Vec<R>) {
        R::remark(|| format!("Appendage {number}: accelerations of its first joint."));
        let (angular, linear) = first_hinge(branch.point, &branch.rot_body_from_appendage, main);
        match self {
            Self::Planar(planar) => planar.back(number, angular, linear, tau_dot),
            Self::Limb { limb, links, .. } => {
                let main = Twist { angular, linear };
                let reached = limb::back(number, limb.links(), branch, links, main);
                tau_dot.extend(reached.into_iter().map(|(_, tau_dot)| tau_dot));
            }
        }
    }
}

/// A chain or a paddle.
struct ChainOrPaddle<R> {
    share: OutboardShare<R>,
    first_torque: R,
    eliminated: Vec<Eliminated<R>>,
    paddle: Option<Paddle<R>>,
}

impl<R: Real> ChainOrPaddle<R> {
    fn eliminate(
        number: usize,
        is_paddle: bool,
        branch: &Branch<R>,
        omega: Vec3<R>,
        hinges: &[HingeCoordinates<R>],
    ) -> Self {
        let spin = Spin::new(branch.rot_body_from_appendage.transpose_mul(omega));
        let start = Outward {
            alpha: R::zero(),
            sigma: R::zero(),
            hinge: spin.bias_of_main_point(branch.point),
        };
        match is_paddle {
            false => Self::eliminate_chain(number, &spin, branch, start, hinges),
            true => Self::eliminate_paddle(number, &spin, branch, start, hinges),
        }
    }

    fn eliminate_chain(
        number: usize,
        spin: &Spin<R>,
        branch: &Branch<R>,
        start: Outward<R>,
        hinges: &[HingeCoordinates<R>],
    ) -> Self {
        let mut reached = start;
        let mut turned: Vec<Turned<R>> = Vec::with_capacity(hinges.len());
        for (i, (link, hinge)) in branch.links.iter().zip(hinges).enumerate() {
            R::remark(|| {
                format!("Link {number},{}, outward: turned by its angle, its bias.", i + 1)
            });
            let (link, next) = chain::outward(spin, link, hinge.beta, hinge.tau, reached);
            turned.push(link);
            reached = next;
        }
        let mut share = OutboardShare::nothing();
        let mut eliminated = Vec::with_capacity(hinges.len());
        for (i, link) in turned.iter().enumerate().rev() {
            R::remark(|| format!("Link {number},{}, inward: its hinge eliminated.", i + 1));
            let outer_torque = hinges.get(i + 1).map_or(R::zero(), |hinge| hinge.torque);
            let (next, hinge) = chain::inward(link, hinges[i].torque - outer_torque, &share);
            share = next;
            eliminated.push(hinge);
        }
        eliminated.reverse();
        Self { share, first_torque: hinges[0].torque, eliminated, paddle: None }
    }

    fn eliminate_paddle(
        number: usize,
        spin: &Spin<R>,
        branch: &Branch<R>,
        start: Outward<R>,
        hinges: &[HingeCoordinates<R>],
    ) -> Self {
        let (of_arm, of_paddle) = (&hinges[0], &hinges[1]);
        R::remark(|| format!("Arm {number}, outward: turned by its angle, its bias."));
        let (arm, reached) = chain::outward(spin, &branch.links[0], of_arm.beta, of_arm.tau, start);
        let rates = ArmRates {
            arm: reached,
            beta: of_paddle.beta,
            tau: of_paddle.tau,
            torque: of_paddle.torque,
        };
        R::remark(|| format!("Paddle {number}: turned by its angles, its hinge eliminated."));
        let (inertia, wrench, paddle) = paddle::eliminate(spin, &branch.links[1].inertia, &rates);
        R::remark(|| format!("Arm {number}, inward: its hinge eliminated."));
        let (share, eliminated) = paddle::arm_inward(&arm, of_arm.torque, &inertia, wrench);
        Self {
            share,
            first_torque: of_arm.torque,
            eliminated: vec![eliminated],
            paddle: Some(paddle),
        }
    }

    fn at_origin(&self, branch: &Branch<R>) -> AtOrigin<R> {
        at_origin(&self.share, self.first_torque, branch.point, &branch.rot_body_from_appendage)
    }

    /// Adds τ̇ of all hinges when ω̇ and the acceleration of the first one, appendage axes, are these.
    fn back(&self, number: usize, w: Vec3<R>, mut a: Vec3<R>, tau_dot: &mut Vec<R>) {
        let mut inboard = w.x;
        for (i, eliminated) in self.eliminated.iter().enumerate() {
            R::remark(|| format!("Link {number},{}, back: τ̇ of its hinge.", i + 1));
            let (epsilon, next) = chain::back(eliminated, [w.y, w.z], a);
            tau_dot.push(epsilon - inboard);
            (inboard, a) = (epsilon, next);
        }
        if let Some(paddle) = &self.paddle {
            R::remark(|| format!("Paddle {number}, back: τ̇ of its hinge."));
            let hinge = Twist { angular: Vec3::new(inboard, w.y, w.z), linear: a };
            tau_dot.push(paddle::back(paddle, hinge));
        }
    }
}

/// What an appendage shows at its first hinge, seen from O along main-body axes. The moment
/// about ê₁ is the first hinge's torque.
#[inline]
pub fn at_origin<R: Real>(
    share: &OutboardShare<R>,
    first_torque: R,
    point: Vec3<R>,
    rot: &Mat3<R>,
) -> AtOrigin<R> {
    let (inertia, wrench) = share.whole(first_torque);
    AtOrigin { inertia: inertia.seen_from(point), wrench: wrench.seen_from(point) }.rotated(rot)
}

/// ω̇ and the acceleration of the first hinge in appendage axes.
#[inline]
pub fn first_hinge<R: Real>(point: Vec3<R>, rot: &Mat3<R>, main: Twist<R>) -> (Vec3<R>, Vec3<R>) {
    let w = rot.transpose_mul(main.angular);
    (w, rot.transpose_mul(main.linear) + w.cross(point))
}
