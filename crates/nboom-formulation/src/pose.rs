//! The links of an appendage in one state, along appendage axes.

use nboom_model::{Limb, Shape};
use nboom_scalar::{Mat3, Real, RigidInertia, Sym3, Vec3, Wrench};

use crate::chain::ChainLink;
use crate::parameters::{Branch, HingeCoordinates};
use crate::{limb, paddle};

/// A link turned into appendage axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Posed<R> {
    /// Mass properties about its hinge.
    pub inertia: RigidInertia<R>,
    /// Unit vector along its hinge: ê₁, or η̂₁ for a paddle.
    pub axis: Vec3<R>,
    /// h̄, its hinge from O.
    pub hinge: Vec3<R>,
    /// To the next hinge, from this one.
    pub hinge_offset: Vec3<R>,
}

/// Limbs are covered by `articulated` and, in ways of its own, by `symmetric`.
pub(crate) fn no_limb(limb: &Limb) -> ! {
    panic!("{limb} is neither a chain nor a paddle")
}

/// The links of an appendage at these hinge angles.
pub(crate) fn place<R: Real>(shape: &Shape, branch: &Branch<R>, beta: &[R]) -> Vec<Posed<R>> {
    match shape {
        Shape::Chain(_) => chain(branch, beta),
        Shape::Paddle => arm_and_paddle(branch, beta[0], beta[1]),
        Shape::Limb(limb) => no_limb(limb),
    }
}

/// Where a link is, along appendage axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LinkPlace<R> {
    /// Turns components of the link into appendage components.
    pub rot: Mat3<R>,
    /// Its origin from O.
    pub position: Vec3<R>,
    /// Unit vector along its joint, and whether it slides along it.
    pub axis: Vec3<R>,
    pub slides: bool,
    /// The link inboard of it.
    pub inboard: Option<usize>,
}

/// The places of all links of an appendage.
pub(crate) fn link_places<R: Real>(
    shape: &Shape,
    branch: &Branch<R>,
    beta: &[R],
) -> Vec<LinkPlace<R>> {
    let turns = match shape {
        Shape::Limb(limb) => return limb::link_places(limb, branch, beta),
        Shape::Chain(_) => {
            let alpha = absolute(shape, beta).into_iter();
            alpha.map(|alpha| (about_first(alpha.sin_cos()), Vec3::unit_x())).collect()
        }
        Shape::Paddle => {
            let arm = beta[0].sin_cos();
            let outer =
                (paddle::rotation(arm, beta[1].sin_cos()), Vec3::new(R::zero(), arm.1, arm.0));
            vec![(about_first(arm), Vec3::unit_x()), outer]
        }
    };
    let (mut position, mut places) = (branch.point, Vec::with_capacity(beta.len()));
    for (i, ((rot, axis), link)) in turns.into_iter().zip(&branch.links).enumerate() {
        places.push(LinkPlace { rot, position, axis, slides: false, inboard: i.checked_sub(1) });
        let [ly, lz] = link.next;
        position += rot * Vec3::new(R::zero(), ly, lz);
    }
    places
}

/// R_x of an angle from its sine and cosine.
pub(crate) fn about_first<R: Real>((s, c): (R, R)) -> Mat3<R> {
    let zero = R::zero();
    Mat3::from_rows(Vec3::unit_x(), Vec3::new(zero, c, -s), Vec3::new(zero, s, c))
}

fn chain<R: Real>(branch: &Branch<R>, beta: &[R]) -> Vec<Posed<R>> {
    let (mut alpha, mut hinge) = (R::zero(), branch.point);
    let mut posed = Vec::new();
    for (link, &beta) in branch.links.iter().zip(beta) {
        alpha += beta;
        let (s, c) = alpha.sin_cos();
        let link = Posed { hinge, ..turned(link, s, c) };
        hinge += link.hinge_offset;
        posed.push(link);
    }
    posed
}

/// eqs. (9.1) and (9.2): the arm turns with R_x(α₁), the paddle with R_x(α₁) R_y(α₂).
fn arm_and_paddle<R: Real>(branch: &Branch<R>, alpha1: R, alpha2: R) -> Vec<Posed<R>> {
    let (s1, c1) = alpha1.sin_cos();
    let arm = Posed { hinge: branch.point, ..turned(&branch.links[0], s1, c1) };
    let rot = paddle::rotation((s1, c1), alpha2.sin_cos());
    let paddle = Posed {
        inertia: branch.links[1].inertia.rotated(&rot),
        axis: Vec3::new(R::zero(), c1, s1),
        hinge: arm.hinge + arm.hinge_offset,
        hinge_offset: Vec3::zero(),
    };
    vec![arm, paddle]
}

/// A link turned about ê₁; its hinge is left at the origin.
fn turned<R: Real>(link: &ChainLink<R>, s: R, c: R) -> Posed<R> {
    let turn = |y: R, z: R| (c * y - s * z, s * y + c * z);
    let RigidInertia { mass, first_moment, about_origin } = link.inertia;
    let (cy, cz) = turn(first_moment.y, first_moment.z);
    let (ly, lz) = turn(link.next[0], link.next[1]);
    let inertia = RigidInertia {
        mass,
        first_moment: Vec3::new(first_moment.x, cy, cz),
        about_origin: turned_tensor(&about_origin, s, c),
    };
    let hinge_offset = Vec3::new(R::zero(), ly, lz);
    Posed { inertia, axis: Vec3::unit_x(), hinge: Vec3::zero(), hinge_offset }
}

/// The tensor turned about the first axis.
pub(crate) fn turned_tensor<R: Real>(k: &Sym3<R>, s: R, c: R) -> Sym3<R> {
    let difference = k.yy - k.zz;
    let shift = s * (s * difference + c * (k.yz + k.yz));
    Sym3 {
        xx: k.xx,
        yy: k.yy - shift,
        zz: k.zz + shift,
        xy: c * k.xy - s * k.xz,
        xz: s * k.xy + c * k.xz,
        yz: c * (s * difference + c * (k.yz + k.yz)) - k.yz,
    }
}

/// Rates relative to the main body: σ of a chain's links are sums of τ, a paddle's are its τ.
pub(crate) fn absolute<R: Real>(shape: &Shape, relative: &[R]) -> Vec<R> {
    match shape {
        Shape::Paddle => relative.to_vec(),
        Shape::Chain(_) => {
            let mut sum = R::zero();
            let add = |&rate: &R| {
                sum += rate;
                sum
            };
            relative.iter().map(add).collect()
        }
        Shape::Limb(limb) => no_limb(limb),
    }
}

/// The inverse of [`absolute`].
pub(crate) fn relative<R: Real>(shape: &Shape, absolute: &[R]) -> Vec<R> {
    let difference = |i: usize| match shape {
        Shape::Chain(_) if i > 0 => absolute[i] - absolute[i - 1],
        _ => absolute[i],
    };
    (0..absolute.len()).map(difference).collect()
}

/// A wrench along the axes whose components `rot` gives.
pub(crate) fn rotated<R: Real>(wrench: Wrench<R>, rot: &Mat3<R>) -> Wrench<R> {
    Wrench { moment: *rot * wrench.moment, force: *rot * wrench.force }
}

/// One quantity of each hinge.
pub(crate) fn each<R: Real>(
    hinges: &[HingeCoordinates<R>],
    quantity: impl Fn(&HingeCoordinates<R>) -> R,
) -> Vec<R> {
    hinges.iter().map(quantity).collect()
}
