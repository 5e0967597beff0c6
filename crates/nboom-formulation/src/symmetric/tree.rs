//! Any tree: links that turn or slide in any direction, and that branch. Everything is about O and
//! along main-body axes, so that composite bodies are plain sums.

use nboom_model::{Link, Spin, WeldedTree};
use nboom_scalar::{ArticulatedInertia, Mat3, Real, RigidInertia, Twist, Vec3, Wrench};

use crate::arrow::Arrow;
use crate::base::AtOrigin;
use crate::parameters::{Coordinates, HingeCoordinates, Solution};

/// Accelerations of any tree; hinges are in the order of its links, in `coordinates` and in
/// the solution.
pub fn solve<R: Real>(tree: &WeldedTree<R>, coordinates: &Coordinates<R>) -> Solution<R> {
    let (seen, eliminated) = arrow(tree, coordinates).eliminate();
    let main = tree.held.unwrap_or_else(|| seen.accelerations());
    Solution { main, tau_dot: eliminated.back(main) }
}

/// B₀ over (V, ω, τ) of any tree: (6 + links)² entries, row by row. Only the angles are read.
pub fn mass_matrix<R: Real>(tree: &WeldedTree<R>, coordinates: &Coordinates<R>) -> Vec<R> {
    arrow(tree, coordinates).dense()
}

/// u₀ of any tree without gravity: 6 + links entries.
pub fn forcing<R: Real>(tree: &WeldedTree<R>, coordinates: &Coordinates<R>) -> Vec<R> {
    arrow(tree, coordinates).dense_right()
}

/// A link in one state; its motions are those of its point that passes O.
#[derive(Clone, Copy)]
struct Moving<R> {
    rot: Mat3<R>,
    hinge: Vec3<R>,
    /// Motion for a unit rate of the hinge: (a, h̄ × a), or (0, a) where the link slides.
    axis: Twist<R>,
    velocity: Twist<R>,
    /// Acceleration when no rate changes.
    bias: Twist<R>,
}

impl<R: Real> Moving<R> {
    fn main(omega: Vec3<R>) -> Self {
        Self {
            rot: Mat3::identity(),
            hinge: Vec3::zero(),
            axis: Twist::zero(),
            velocity: Twist { angular: omega, linear: Vec3::zero() },
            bias: Twist::zero(),
        }
    }

    fn outboard(&self, link: &Link<R>, hinge: &HingeCoordinates<R>) -> Self {
        let at_zero = self.rot * link.rot_inboard_at_zero;
        let point = self.hinge + self.rot * link.point;
        let along = at_zero * link.axis;
        let hinge_point = point + link.joint.travel(along, hinge.beta);
        let axis = link.joint.motion(along, R::one()).at(-hinge_point);
        let (own, carried) = (axis * hinge.tau, self.velocity);
        let turned = carried.cross(own);
        Self {
            rot: at_zero * link.joint.turn(link.axis, hinge.beta),
            hinge: hinge_point,
            axis,
            velocity: sum(carried, own),
            bias: sum(self.bias, turned),
        }
    }

    /// The rate of change of the momentum of a body about O that moves with the link, and of the
    /// rotors in it, if it has some.
    fn bias_wrench(&self, body: &RigidInertia<R>, spin: Option<Spin<R>>) -> Wrench<R> {
        let (v, h) = (self.velocity, body.momentum(self.velocity));
        let mut wrench = body.momentum(self.bias);
        if let Some(spin) = spin {
            wrench.moment += spin.rotated(&self.rot).moment(v.angular);
        }
        wrench.add(v.cross_wrench(h));
        wrench
    }
}

fn sum<R: Real>(a: Twist<R>, b: Twist<R>) -> Twist<R> {
    Twist { angular: a.angular + b.angular, linear: a.linear + b.linear }
}

/// The arrow of the whole tree, which has the main link as its base.
fn arrow<R: Real>(tree: &WeldedTree<R>, coordinates: &Coordinates<R>) -> Arrow<R> {
    let Coordinates { omega, external, hinges } = coordinates;
    let moving = outward(tree, *omega, hinges);
    let mut base = AtOrigin::of_main_body(&tree.main, *omega, external);
    let shares = inward(tree, &moving, &mut base);
    let column = |(at, share): (&Moving<R>, &Share<R>)| share.body.momentum(at.axis);
    let columns: Vec<Wrench<R>> = moving.iter().zip(&shares).map(column).collect();
    let right = |j: usize| hinges[j].torque - moving[j].axis.power(shares[j].bias);
    Arrow {
        inboard: tree.links.iter().map(|link| link.inboard).collect(),
        hinges: (0..moving.len()).map(|j| row(tree, &moving, j, columns[j])).collect(),
        right: (0..moving.len()).map(right).collect(),
        columns,
        base,
    }
}

fn outward<R: Real>(
    tree: &WeldedTree<R>,
    omega: Vec3<R>,
    hinges: &[HingeCoordinates<R>],
) -> Vec<Moving<R>> {
    let main = Moving::main(omega);
    let mut moving: Vec<Moving<R>> = Vec::new();
    for (link, hinge) in tree.links.iter().zip(hinges) {
        let next = link.inboard.map_or(&main, |i| &moving[i]).outboard(link, hinge);
        moving.push(next);
    }
    moving
}

/// A link and all that is outboard of it, about O, hinges frozen.
#[derive(Clone, Copy)]
struct Share<R> {
    body: RigidInertia<R>,
    bias: Wrench<R>,
}

/// Sums over what is outboard of each link; `base` receives what is outboard of the main link.
fn inward<R: Real>(
    tree: &WeldedTree<R>,
    moving: &[Moving<R>],
    base: &mut AtOrigin<R>,
) -> Vec<Share<R>> {
    let own = |(link, at): (&Link<R>, &Moving<R>)| {
        let body = link.inertia.rotated(&at.rot).seen_from(at.hinge);
        Share { body, bias: at.bias_wrench(&body, link.spin) }
    };
    let mut shares: Vec<Share<R>> = tree.links.iter().zip(moving).map(own).collect();
    for j in (0..shares.len()).rev() {
        let Share { body, bias } = shares[j];
        match tree.links[j].inboard {
            Some(i) => {
                shares[i].body.add(body);
                shares[i].bias.add(bias);
            }
            None => base.add(&AtOrigin { inertia: ArticulatedInertia::of(&body), wrench: bias }),
        }
    }
    shares
}

/// Row j of the hinge block: the power of column j on each hinge on the way to the main body.
fn row<R: Real>(tree: &WeldedTree<R>, moving: &[Moving<R>], j: usize, column: Wrench<R>) -> Vec<R> {
    let mut row = vec![R::zero(); j + 1];
    for i in std::iter::successors(Some(j), |&i| tree.links[i].inboard) {
        row[i] = moving[i].axis.power(column);
    }
    row
}
