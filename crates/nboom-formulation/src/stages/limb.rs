//! A whole limb as two steps.

use nboom_model::{Limb, Shape};
use nboom_scalar::{Real, Twist};

use crate::articulated::first_hinge;
use crate::limb::{self, EliminatedLink, OF_ELIMINATED_LINK, Standing};
use crate::parameters::{Branch, HingeCoordinates, Layout, Reader};
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
fn parameters(limb: &Limb) -> Vec<Group> {
    let mut groups = vec![BRANCH];
    for link in 0..limb.links().len() {
        match Layout::mount(limb, link) {
            0 => {}
            Layout::WAY => groups.push(WAY.of_links(link + 1, 1)),
            _ => groups.push(MOUNT.of_links(link + 1, 1)),
        }
        groups.push(LINK_BODY.of_links(link + 1, 1));
    }
    groups
}

type Numbers<'a, R> = Reader<std::iter::Copied<std::slice::Iter<'a, R>>>;

fn branch<R: Real>(limb: &Limb, reader: &mut Numbers<'_, R>) -> Branch<R> {
    reader.branch(&Shape::Limb(limb.clone()))
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
            let branch = branch(&limb, &mut reader);
            let omega = reader.vector();
            let hinges: Vec<_> = (0..limb.links().len())
                .map(|_| {
                    let [beta, tau, torque] = reader.vector().to_array();
                    HingeCoordinates { beta, tau, torque }
                })
                .collect();
            let (share, links) = limb::eliminate(1, &limb, &branch, omega, &hinges);
            let mut found = limb::at_origin(&share, &branch).flat();
            let flat =
                |(i, link): (usize, &EliminatedLink<R>)| link.flat(Standing::of(limb.links(), i));
            found.extend(links.iter().enumerate().flat_map(flat));
            found
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
            let branch = branch(&limb, &mut reader);
            let links = 0..limb.links().len();
            let standing = |i| Standing::of(limb.links(), i);
            let links: Vec<_> =
                links.map(|i| EliminatedLink::read(standing(i), &mut reader)).collect();
            let main = Twist { angular: reader.vector(), linear: reader.vector() };
            let rot = &branch.rot_body_from_appendage;
            let (angular, linear) = first_hinge(branch.point, rot, main);
            limb::back(1, &limb, &branch, &links, Twist { angular, linear })
        }),
    }
}
