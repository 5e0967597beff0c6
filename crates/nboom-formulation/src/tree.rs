use nboom_model::{LimbJoint, Shape, Topology};
use nboom_scalar::{TreeJoint, TreeLink, TreeMount};

use crate::parameters::Layout;

impl Layout {
    /// The links of all appendages as a tree of joints, appendage by appendage, with the places of their numbers in
    /// parameters, states and accelerations: what [`Derivatives`](nboom_scalar::Derivatives) loop over.
    pub fn tree(topology: &Topology) -> Vec<TreeLink> {
        let mut tree = Vec::with_capacity(topology.hinges());
        let mut places = Self::places(topology).into_iter();
        let mut at = Self::MAIN;
        for shape in topology.shapes() {
            let first = tree.len();
            let on_main = TreeMount::OnMain(at);
            at += Self::BRANCH;
            for link in 0..shape.hinges() {
                let (inboard, joint, mount) = mounted(shape, link, at);
                let before = match shape {
                    Shape::Limb(limb) => Self::mount(limb, link),
                    Shape::Chain(_) | Shape::Paddle => 0,
                };
                let place = places.next().expect("a place for each hinge");
                let [angle, rate, torque] = Self::hinge_in_state(topology, place);
                tree.push(TreeLink {
                    inboard: inboard.map(|inboard| first + inboard),
                    joint,
                    mount: if inboard.is_none() { on_main } else { mount },
                    body: at + before,
                    angle,
                    rate,
                    torque,
                    acceleration: Self::OUTPUT + place,
                });
                at += Self::link(shape, link);
            }
        }
        tree
    }
}

/// Which link of its appendage carries a link whose numbers begin at `at`, how it moves, and its mount; that of a link on
/// the main body has no meaning.
fn mounted(shape: &Shape, link: usize, at: usize) -> (Option<usize>, TreeJoint, TreeMount) {
    // Of a chain or paddle the way to a link stands at the end of the numbers of its inboard one.
    let way_before = TreeMount::Parallel(at - Layout::WAY);
    match shape {
        Shape::Chain(_) => (link.checked_sub(1), TreeJoint::Revolute, way_before),
        Shape::Paddle if link == 0 => (None, TreeJoint::Revolute, way_before),
        Shape::Paddle => (Some(0), TreeJoint::RevoluteAboutSecond, way_before),
        Shape::Limb(limb) => {
            let of_limb = limb.links()[link];
            let (joint, mount) = match of_limb.joint {
                LimbJoint::Revolute => (TreeJoint::Revolute, TreeMount::Across(at)),
                LimbJoint::Parallel => (TreeJoint::Revolute, TreeMount::Parallel(at)),
                LimbJoint::Prismatic => (TreeJoint::Prismatic, TreeMount::Across(at)),
            };
            (of_limb.inboard.map(usize::from), joint, mount)
        }
    }
}
