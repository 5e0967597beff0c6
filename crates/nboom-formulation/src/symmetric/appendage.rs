//! The arrow of one appendage, along its axes.

use nboom_model::Shape;
use nboom_scalar::{ArticulatedInertia, Real, RigidInertia, Sym3, Twist, Vec3, Wrench};

use crate::arrow::Arrow;
use crate::base::AtOrigin;
use crate::chain::Spin;
use crate::limb;
use crate::parameters::{Branch, HingeCoordinates};
use crate::pose::{self, Posed, each};

/// The arrow about O over the rates that [`pose::absolute`] gives, of a limb over τ.
pub(super) fn arrow<R: Real>(
    shape: &Shape,
    branch: &Branch<R>,
    omega: Vec3<R>,
    hinges: &[HingeCoordinates<R>],
) -> Arrow<R> {
    if let Shape::Limb(limb) = shape {
        return limb::composite(limb, branch, omega, hinges);
    }
    let w = branch.rot_body_from_appendage.transpose_mul(omega);
    let beta = each(hinges, |hinge| hinge.beta);
    let sigma = pose::absolute(shape, &each(hinges, |hinge| hinge.tau));
    let torque = each(hinges, |hinge| hinge.torque);
    let links = pose::place(shape, branch, &beta);
    match shape {
        Shape::Chain(_) => chain(&links, &Spin::new(w), &sigma, &torque),
        Shape::Paddle => paddle(&links, w, [sigma[0], sigma[1]], &torque),
        Shape::Limb(limb) => pose::no_limb(limb),
    }
}

/// The arrow of the same appendage over τ: a unit τ turns the link and all outboard.
pub(super) fn with_relative_rates<R: Real>(shape: &Shape, mut arrow: Arrow<R>) -> Arrow<R> {
    if !matches!(shape, Shape::Chain(_)) {
        return arrow;
    }
    let n = arrow.right.len();
    let entry = |i: usize, j: usize| arrow.hinges[i.max(j)][i.min(j)];
    let mut full: Vec<Vec<R>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    full.iter_mut().for_each(|row| sum_from_the_tip(row, |sum, inner| *inner += sum));
    sum_from_the_tip(&mut full, |sum, inner: &mut Vec<R>| {
        inner.iter_mut().zip(sum).for_each(|(inner, sum)| *inner += sum);
    });
    for (i, row) in full.iter_mut().enumerate() {
        row.truncate(i + 1);
    }
    arrow.hinges = full;
    sum_from_the_tip(&mut arrow.columns, |sum, inner| inner.add(sum));
    sum_from_the_tip(&mut arrow.right, |sum, inner| *inner += sum);
    arrow
}

/// Replaces each item by the sum of itself and all that follow.
fn sum_from_the_tip<T: Clone>(items: &mut [T], add: impl Fn(T, &mut T)) {
    for i in (1..items.len()).rev() {
        let sum = items[i].clone();
        add(sum, &mut items[i - 1]);
    }
}

/// A link with the mass of all that is outboard lumped at its outboard hinge.
struct Augmented<R> {
    /// D, first moment about the inboard hinge.
    first_moment: Vec3<R>,
    /// K, inertia about the inboard hinge.
    inertia: Sym3<R>,
}

/// Augmented links, and the mass of the whole appendage.
fn augmented<R: Real>(links: &[Posed<R>]) -> (Vec<Augmented<R>>, R) {
    let mut outboard = R::zero();
    let mut bodies = Vec::new();
    for link in links.iter().rev() {
        let (hinge_offset, own) = (link.hinge_offset, &link.inertia);
        let square = hinge_offset.y * hinge_offset.y + hinge_offset.z * hinge_offset.z;
        let lumped = Sym3 {
            xx: square,
            yy: hinge_offset.z * hinge_offset.z,
            zz: hinge_offset.y * hinge_offset.y,
            yz: -(hinge_offset.y * hinge_offset.z),
            ..Sym3::zero()
        };
        bodies.push(Augmented {
            first_moment: own.first_moment + hinge_offset * outboard,
            inertia: own.about_origin + lumped * outboard,
        });
        outboard += own.mass;
    }
    bodies.reverse();
    (bodies, outboard)
}

/// ê₁ × v.
fn about_first<R: Real>(v: Vec3<R>) -> Vec3<R> {
    Vec3::new(R::zero(), -v.z, v.y)
}

fn chain<R: Real>(links: &[Posed<R>], spin: &Spin<R>, sigma: &[R], torque: &[R]) -> Arrow<R> {
    let (bodies, mass) = augmented(links);
    let accelerations = hinge_accelerations(links, spin, sigma);
    let mut columns = Vec::new();
    let mut right = Vec::new();
    // Sums over the links outboard: first moments, their bias forces, and the whole inertia.
    let (mut moments, mut forces) = (Vec3::zero(), Vec3::zero());
    let (mut whole, mut bias_moment) = (Sym3::zero(), Vec3::zero());
    for (i, (link, body)) in links.iter().zip(&bodies).enumerate().rev() {
        let d = body.first_moment;
        let bias = d.cross(accelerations[i])
            + link.hinge_offset.cross(forces)
            + spin.gyroscopic_moment(sigma[i], &body.inertia);
        let outer_torque = torque.get(i + 1).map_or(R::zero(), |&outer| outer);
        right.push(torque[i] - outer_torque - bias.x);
        columns.push(column(link, body, moments));
        whole += body.inertia + crossed(link.hinge_offset, moments);
        bias_moment += bias;
        moments += d;
        forces += spin.bias_of(sigma[i], d);
    }
    columns.reverse();
    right.reverse();
    let point = links[0].hinge;
    let rigid = RigidInertia { mass, first_moment: moments, about_origin: whole };
    let wrench = Wrench { moment: bias_moment, force: accelerations[0] * mass + forces };
    Arrow {
        inboard: inboard(links.len()),
        hinges: in_plane_products(links, &bodies),
        columns,
        right,
        base: AtOrigin {
            inertia: ArticulatedInertia::of(&rigid.seen_from(point)),
            wrench: wrench.seen_from(point),
        },
    }
}

/// Bias acceleration of each hinge.
fn hinge_accelerations<R: Real>(links: &[Posed<R>], spin: &Spin<R>, sigma: &[R]) -> Vec<Vec3<R>> {
    let mut hinge = spin.bias_of(R::zero(), links[0].hinge);
    let mut all = Vec::new();
    for (link, &sigma) in links.iter().zip(sigma) {
        all.push(hinge);
        hinge += spin.bias_of(sigma, link.hinge_offset);
    }
    all
}

fn inboard(links: usize) -> Vec<Option<usize>> {
    (0..links).map(|i| i.checked_sub(1)).collect()
}

/// K ê₁ + h̄ × (ê₁ × D) + R × (ê₁ × L) about O, and ê₁ × D; R sums D outboard.
fn column<R: Real>(link: &Posed<R>, body: &Augmented<R>, outboard: Vec3<R>) -> Wrench<R> {
    let k = &body.inertia;
    let force = about_first(body.first_moment);
    let moment = Vec3::new(k.xx, k.xy, k.xz)
        + link.hinge.cross(force)
        + outboard.cross(about_first(link.hinge_offset));
    Wrench { moment, force }
}

/// 2 L·R U − L Rᵀ − R Lᵀ with L in the plane.
fn crossed<R: Real>(hinge_offset: Vec3<R>, outboard: Vec3<R>) -> Sym3<R> {
    let (yy, zz) = (hinge_offset.y * outboard.y, hinge_offset.z * outboard.z);
    let twice = |x: R| x + x;
    Sym3 {
        xx: twice(yy + zz),
        yy: twice(zz),
        zz: twice(yy),
        xy: -(hinge_offset.y * outboard.x),
        xz: -(hinge_offset.z * outboard.x),
        yz: -(hinge_offset.y * outboard.z + hinge_offset.z * outboard.y),
    }
}

/// Entries (i, i): moment of inertia of the augmented body; (i, j), j < i: L_j · D_i in plane.
fn in_plane_products<R: Real>(links: &[Posed<R>], bodies: &[Augmented<R>]) -> Vec<Vec<R>> {
    let row = |(i, body): (usize, &Augmented<R>)| {
        let d = body.first_moment;
        let product = |link: &Posed<R>| link.hinge_offset.y * d.y + link.hinge_offset.z * d.z;
        let mut row: Vec<R> = links[..i].iter().map(product).collect();
        row.push(body.inertia.xx);
        row
    };
    bodies.iter().enumerate().map(row).collect()
}

/// Arm and paddle by composite bodies, about O.
fn paddle<R: Real>(links: &[Posed<R>], w: Vec3<R>, sigma: [R; 2], torque: &[R]) -> Arrow<R> {
    let (arm, paddle) = (&links[0], &links[1]);
    let turn = |link: &Posed<R>, rate: R| link.axis * rate;
    let (of_arm, of_paddle) = (turn(arm, sigma[0]), turn(paddle, sigma[1]));
    let omega_arm = w + of_arm;
    let bias_arm = Twist { angular: w.cross(of_arm), linear: w.cross(w.cross(arm.hinge)) };
    let relative = omega_arm.cross(omega_arm.cross(arm.hinge_offset));
    let bias_paddle = Twist {
        angular: bias_arm.angular + omega_arm.cross(of_paddle),
        linear: bias_arm.at(arm.hinge_offset).linear + relative,
    };
    let mut wrench = arm.inertia.inertia_wrench(omega_arm, bias_arm);
    let outer = paddle.inertia.inertia_wrench(omega_arm + of_paddle, bias_paddle);
    wrench.add(outer.seen_from(arm.hinge_offset));
    let mut composite = paddle.inertia.seen_from(arm.hinge_offset);
    composite.add(arm.inertia);

    let about = |axis| Twist { angular: axis, linear: Vec3::zero() };
    let first = composite.momentum(about(arm.axis));
    let second = paddle.inertia.momentum(about(paddle.axis));
    let at_arm = second.seen_from(arm.hinge_offset);
    let right =
        [torque[0] - arm.axis.dot(wrench.moment), torque[1] - paddle.axis.dot(outer.moment)];
    Arrow {
        inboard: inboard(2),
        hinges: vec![
            vec![arm.axis.dot(first.moment)],
            vec![arm.axis.dot(at_arm.moment), about(paddle.axis).power(second)],
        ],
        columns: vec![first.seen_from(arm.hinge), at_arm.seen_from(arm.hinge)],
        right: right.to_vec(),
        base: AtOrigin {
            inertia: ArticulatedInertia::of(&composite.seen_from(arm.hinge)),
            wrench: wrench.seen_from(arm.hinge),
        },
    }
}
