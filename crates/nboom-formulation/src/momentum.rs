//! Formulation `momentum`: the elimination of [`articulated`](crate::articulated) on momenta, form M-P
//! of the cost table in `docs/formulations.md`.
//!
//! The state has momenta (Π, P, π) = B₀ (ω, V, τ) in place of velocities. No bias acceleration
//! is ever formed, momentum is conserved to the last digit, and a lock-up merely drops the π of
//! the hinges that lock.

use nboom_model::{Shape, Topology};
use nboom_scalar::{Dual, Real, Twist, Vec3, Wrench};

use crate::articulated::Articulated;
use crate::formulation::ClosedForm;
use crate::parameters::{Branch, Coordinates, HingeCoordinates, Parameters, Solution};
use crate::pose::{self, Posed, each};

/// The row of [`Formulation`](crate::Formulation)'s table.
pub(crate) struct Momentum;

impl ClosedForm for Momentum {
    const NAME: &'static str = "momentum";
    const ABOUT: &'static str =
        "O(n) elimination on momenta (Π, P, π): velocities, no accelerations";

    /// The velocities of the momenta, differentiated along the motion.
    ///
    /// Runs do not need it; it makes the formulation comparable with the others.
    fn solve<R: Real>(
        topology: &Topology,
        parameters: &Parameters<R>,
        coordinates: &Coordinates<R>,
    ) -> Solution<R> {
        let hinges = &coordinates.hinges;
        let (beta, tau) = (each(hinges, |hinge| hinge.beta), each(hinges, |hinge| hinge.tau));
        let torques = each(hinges, |hinge| hinge.torque);
        // a_O does not depend on the velocity of O, which may be zero for the moment.
        let main = Twist { angular: coordinates.omega, linear: Vec3::zero() };
        let now = Velocities { main, tau: tau.clone() };
        let at = momenta(topology, parameters, &beta, &now);
        let rate = rates(topology, parameters, &beta, (&at, &now), coordinates.external, &torques);
        let beta: Vec<_> = beta.iter().zip(&tau).map(|(&b, &rate)| dual(b, rate)).collect();
        let constants = parameters.write().into_iter().map(Dual::constant);
        let parameters = Parameters::read(topology, constants);
        let moved = velocities(topology, &parameters, &beta, &in_time(&at, &rate));
        let derivative =
            |v: Vec3<Dual<R>>| Vec3::new(v.x.derivative, v.y.derivative, v.z.derivative);
        let Twist { angular, linear } = moved.main;
        Solution {
            main: Twist { angular: derivative(angular), linear: derivative(linear) },
            tau_dot: moved.tau.into_iter().map(|tau| tau.derivative).collect(),
        }
    }
}

/// Momenta of a satellite, or their rates of change.
#[derive(Clone, Debug, PartialEq)]
pub struct Momenta<R> {
    /// Angular momentum Π about O (`moment`) and linear momentum P (`force`) of everything,
    /// main-body axes.
    pub main: Wrench<R>,
    /// π of each hinge, conjugate to τ, appendage by appendage.
    pub hinges: Vec<R>,
}

/// Velocities of a satellite.
#[derive(Clone, Debug, PartialEq)]
pub struct Velocities<R> {
    /// ω and V, the inertial velocity of O, main-body axes.
    pub main: Twist<R>,
    /// τ of each hinge, appendage by appendage.
    pub tau: Vec<R>,
}

/// (Π, P, π) = B₀ (ω, V, τ) at the hinge angles `beta`.
pub fn momenta<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    beta: &[R],
    velocities: &Velocities<R>,
) -> Momenta<R> {
    R::remark(|| "Momenta of the velocities.".to_owned());
    let mut main = parameters.main.momentum(velocities.main);
    let mut hinges = Vec::with_capacity(beta.len());
    for appendage in appendages(topology, parameters, beta, velocities) {
        main.add(appendage.about_origin());
        hinges.extend(appendage.hinges.iter().map(Carried::along_axis));
    }
    Momenta { main, hinges }
}

/// (ω, V, τ) from (Π, P, π), by the O(n) elimination.
///
/// A satellite at rest answers a torque π at each hinge and a wrench (Π, P) with the
/// accelerations B₀⁻¹ (Π, P, π). Traced, everything that belongs to rates folds away.
pub fn velocities<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    beta: &[R],
    momenta: &Momenta<R>,
) -> Velocities<R> {
    let hinge = |(&beta, &torque): (&R, &R)| HingeCoordinates { beta, tau: R::zero(), torque };
    let at_rest = Coordinates {
        omega: Vec3::zero(),
        external: momenta.main,
        hinges: beta.iter().zip(&momenta.hinges).map(hinge).collect(),
    };
    let Solution { main, tau_dot } = Articulated::solve(topology, parameters, &at_rest);
    Velocities { main, tau: tau_dot }
}

/// Rates of change of the momenta in main-body components, without gravity.
///
/// `velocities` are those of `momenta`; `external` is the wrench about O, `torques` are the
/// generalised forces conjugate to β:
///
/// ```text
/// π̇ = torque + (ω × a)·H + (v × a)·p,   Π̇ = M − ω × Π − V × P,   Ṗ = F − ω × P
/// ```
///
/// with a the hinge axis, v the velocity of the hinge, and H, p the momenta of everything
/// outboard about the hinge.
pub fn rates<R: Real>(
    topology: &Topology,
    parameters: &Parameters<R>,
    beta: &[R],
    (momenta, velocities): (&Momenta<R>, &Velocities<R>),
    external: Wrench<R>,
    torques: &[R],
) -> Momenta<R> {
    R::remark(|| "Rates of change of the momenta.".to_owned());
    let Twist { angular: omega, linear: velocity } = velocities.main;
    let Wrench { moment, force } = momenta.main;
    let main = Wrench {
        moment: external.moment - omega.cross(moment) - velocity.cross(force),
        force: external.force - omega.cross(force),
    };
    let mut hinges = Vec::with_capacity(beta.len());
    for appendage in appendages(topology, parameters, beta, velocities) {
        hinges.extend(appendage.hinges.iter().map(Carried::gyroscopic));
    }
    hinges.iter_mut().zip(torques).for_each(|(rate, &torque)| *rate += torque);
    Momenta { main, hinges }
}

fn dual<R>(value: R, derivative: R) -> Dual<R> {
    Dual { value, derivative }
}

/// Momenta as functions of time.
fn in_time<R: Real>(at: &Momenta<R>, rate: &Momenta<R>) -> Momenta<Dual<R>> {
    let vector = |v: Vec3<R>, d: Vec3<R>| Vec3::new(dual(v.x, d.x), dual(v.y, d.y), dual(v.z, d.z));
    let moment = vector(at.main.moment, rate.main.moment);
    let force = vector(at.main.force, rate.main.force);
    let hinges = at.hinges.iter().zip(&rate.hinges).map(|(&pi, &rate)| dual(pi, rate));
    Momenta { main: Wrench { moment, force }, hinges: hinges.collect() }
}

/// An appendage in motion.
struct Appendage<'a, R> {
    branch: &'a Branch<R>,
    hinges: Vec<Carried<R>>,
}

/// A link's hinge and what it carries, appendage axes.
struct Carried<R> {
    axis: Vec3<R>,
    /// Velocity of the link and of its hinge.
    motion: Twist<R>,
    /// Momenta of everything outboard about the hinge.
    outboard: Wrench<R>,
}

impl<R: Real> Carried<R> {
    fn along_axis(&self) -> R {
        self.axis.dot(self.outboard.moment)
    }

    fn gyroscopic(&self) -> R {
        let Twist { angular, linear } = self.motion;
        angular.cross(self.axis).dot(self.outboard.moment)
            + linear.cross(self.axis).dot(self.outboard.force)
    }
}

impl<R: Real> Appendage<'_, R> {
    fn about_origin(&self) -> Wrench<R> {
        let about_hinge = self.hinges[0].outboard;
        let seen = about_hinge.seen_from(self.branch.point);
        pose::rotated(seen, &self.branch.rot_body_from_appendage)
    }
}

fn appendages<'a, R: Real>(
    topology: &'a Topology,
    parameters: &'a Parameters<R>,
    beta: &'a [R],
    velocities: &'a Velocities<R>,
) -> impl Iterator<Item = Appendage<'a, R>> {
    let mut first = 0;
    topology.shapes().iter().zip(&parameters.branches).map(move |(shape, branch)| {
        let of = first..first + shape.hinges();
        first += shape.hinges();
        let rot = &branch.rot_body_from_appendage;
        let main = Twist {
            angular: rot.transpose_mul(velocities.main.angular),
            linear: rot.transpose_mul(velocities.main.linear),
        };
        let links = pose::place(shape, branch, &beta[of.clone()]);
        let sigma = pose::absolute(shape, &velocities.tau[of]);
        Appendage { branch, hinges: carried(shape, &links, &sigma, main.at(branch.point)) }
    })
}

/// Outward for velocities, inward for momenta; `main` is the motion of the main body's point at
/// the first hinge.
fn carried<R: Real>(
    shape: &Shape,
    links: &[Posed<R>],
    sigma: &[R],
    main: Twist<R>,
) -> Vec<Carried<R>> {
    let mut motion = main;
    let mut hinges = Vec::with_capacity(links.len());
    for (link, &rate) in links.iter().zip(sigma) {
        let inboard = match shape {
            Shape::Chain(_) => main.angular,
            Shape::Paddle => motion.angular,
            Shape::Limb(limb) => pose::no_limb(limb),
        };
        motion.angular = inboard + link.axis * rate;
        let outboard = link.inertia.momentum(motion);
        hinges.push(Carried { axis: link.axis, motion, outboard });
        motion = motion.at(link.hinge_offset);
    }
    for i in (1..hinges.len()).rev() {
        let outer = hinges[i].outboard.seen_from(links[i - 1].hinge_offset);
        hinges[i - 1].outboard.add(outer);
    }
    hinges
}
