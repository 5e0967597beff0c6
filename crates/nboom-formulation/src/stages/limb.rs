//! A whole limb as two steps.

use nboom_model::{Limb, LimbLink};
use nboom_scalar::{Real, Twist};

use crate::articulated::first_hinge;
use crate::limb::{self, EliminatedLink, OF_ELIMINATED_LINK, Standing};
use crate::parameters::{HingeCoordinates, Layout, Reader};
use crate::stages::{AT_ORIGIN, BODY, BRANCH, Group, MAIN_RATES, OMEGA, Stage, TAU_DOT};

/// Where a link is mounted on its inboard link.
pub(super) const MOUNT: Group = Group::new(
    "mount",
    &["m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33", "px", "py", "pz"],
);
/// The way from a parallel joint.
pub(super) const WAY: Group = Group::new("way", &["ly", "lz"]);
/// A link's body.
pub(super) const LINK_BODY: Group = Group::new("link", &BODY);
/// β, τ and torque of each joint; their number is that of the limb's links.
pub const LIMB_HINGES: Group = Group::new("hinges", &["beta", "tau", "torque"]);
/// What the eliminated joints leave.
pub const LIMB: Group = Group::new("limb", &OF_ELIMINATED_LINK);
/// τ̇ of each joint.
pub const LIMB_TAU_DOT: Group = TAU_DOT;

/// A group of each link as a limb has it.
pub fn of_limb(group: Group, limb: &Limb) -> Group {
    group.of_links(1, limb.links().len())
}

/// The parameters of a limb, as [`Layout`] has them.
pub(super) fn parameters(limb: &Limb) -> Vec<Group> {
    let links = (0..limb.links().len()).flat_map(|link| of_link(limb, link, link + 1));
    [BRANCH].into_iter().chain(links).collect()
}

/// The parameters of a link, which names count as `number`: where it is mounted, unless it is the first, and its
/// body.
pub(super) fn of_link(limb: &Limb, link: usize, number: usize) -> impl Iterator<Item = Group> {
    let mount = match Layout::mount(limb, link) {
        0 => None,
        Layout::WAY => Some(WAY),
        _ => Some(MOUNT),
    };
    mount.into_iter().chain([LINK_BODY]).map(move |group| group.of_links(number, 1))
}

/// β, τ and torque of each of `count` joints.
pub(super) fn hinges<R: Real>(
    count: usize,
    reader: &mut Reader<impl Iterator<Item = R>>,
) -> Vec<HingeCoordinates<R>> {
    let hinge = |_| {
        let [beta, tau, torque] = reader.vector().to_array();
        HingeCoordinates { beta, tau, torque }
    };
    (0..count).map(hinge).collect()
}

/// What the eliminated joints of these links leave.
pub(super) fn flat<R: Real>(links: &[LimbLink], eliminated: &[EliminatedLink<R>]) -> Vec<R> {
    let of_link = |(i, link): (usize, &EliminatedLink<R>)| link.flat(Standing::of(links, i));
    eliminated.iter().enumerate().flat_map(of_link).collect()
}

/// The same, read back.
pub(super) fn eliminated<R: Real>(
    links: &[LimbLink],
    reader: &mut Reader<impl Iterator<Item = R>>,
) -> Vec<EliminatedLink<R>> {
    let of_link = |i| EliminatedLink::read(Standing::of(links, i), reader);
    (0..links.len()).map(of_link).collect()
}

/// All joints of a limb eliminated.
pub fn limb_in<R: Real>(limb: Limb) -> Stage<R> {
    Stage {
        name: "limb_in",
        about: "All joints of a limb eliminated: what it shows at O, and what they leave.",
        parameters: parameters(&limb),
        inputs: vec![OMEGA, of_limb(LIMB_HINGES, &limb)],
        outputs: vec![AT_ORIGIN, of_limb(LIMB, &limb)],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.limb(limb.links());
            let at_mount = limb::of_main_body(&branch, reader.vector());
            let hinges = hinges(limb.links().len(), &mut reader);
            let (share, left) = limb::eliminate(1, limb.links(), &branch, &at_mount, &hinges);
            [limb::at_origin(&share, &branch).flat(), flat(limb.links(), &left)].concat()
        }),
    }
}

/// The way back through a limb.
pub fn limb_back<R: Real>(limb: Limb) -> Stage<R> {
    Stage {
        name: "limb_back",
        about: "τ̇ of the joints of a limb.",
        parameters: parameters(&limb),
        inputs: vec![of_limb(LIMB, &limb), MAIN_RATES],
        outputs: vec![of_limb(LIMB_TAU_DOT, &limb)],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.limb(limb.links());
            let left = eliminated(limb.links(), &mut reader);
            let main = Twist { angular: reader.vector(), linear: reader.vector() };
            let rot = &branch.rot_body_from_appendage;
            let (angular, linear) = first_hinge(branch.point, rot, main);
            let at_mount = Twist { angular, linear };
            let reached = limb::back(1, limb.links(), &branch, &left, at_mount);
            reached.into_iter().map(|(_, tau_dot)| tau_dot).collect()
        }),
    }
}
