//! A limb of which equal parts are taken side by side: the trunk, which is the rest of it, and each of the parts.

use nboom_model::{EqualParts, Limb, LimbLink};
use nboom_scalar::{Real, Twist, Vec3, Wrench};

use crate::articulated::first_hinge;
use crate::base::AtOrigin;
use crate::chain::{Spin, Turned};
use crate::limb::{self, Motion, Moving, Stance, Standing, Turn};
use crate::parameters::{Branch, Reader};
use crate::stages::joint::{OUTBOARD, RATES};
use crate::stages::limb::{self as whole, LIMB, LIMB_HINGES, LIMB_TAU_DOT, MOUNT, of_limb};
use crate::stages::{AT_ORIGIN, BRANCH, Group, MAIN_RATES, OMEGA, Stage, TAU_DOT, TORQUE};

/// What is kept of a link of the trunk on the way outward: its [`STANCE`](super::STANCE) and [`BIAS`](super::BIAS).
pub const KEPT: Group = Group::new(
    "kept",
    &["sin", "cos", "bias_y", "bias_z", "travel", "nx", "ny", "nz", "fx", "fy", "fz"],
);
/// A link that carries parts: sine and cosine of its angle from the axes in which it is written, where these do not
/// turn with it; its angular bias acceleration along its own axes; along those in which it is written their ω (`w`),
/// and the bias acceleration of its origin (`b`); σ, its rate about ê₁.
pub const CARRIER: Group = Group::new(
    "carrier",
    &["sin", "cos", "bias_y", "bias_z", "wx", "wy", "wz", "sigma", "bx", "by", "bz"],
);
/// Accelerations of a link that carries parts, along the axes in which it is written: angular ones (`a`), and those
/// of its origin (`l`).
pub const CARRIER_RATES: Group = Group::new("carried_at", &["ax", "ay", "az", "lx", "ly", "lz"]);

/// A limb but for equal parts that are taken side by side.
#[derive(Clone, Debug)]
pub struct Trunk {
    limb: Limb,
    /// The links of the trunk as they are numbered in the limb, and among themselves.
    numbers: Vec<usize>,
    links: Vec<LimbLink>,
    parts: Vec<EqualParts>,
    /// The links that carry parts, as they are numbered in the limb.
    carriers: Vec<usize>,
}

impl Trunk {
    /// The limb without its equal parts; `None` if it has none.
    pub fn of(limb: &Limb) -> Option<Self> {
        let parts = limb.equal_parts();
        let is_own = |link: &usize| !parts.iter().any(|parts| parts.contains(*link));
        let numbers: Vec<usize> = (0..limb.links().len()).filter(is_own).collect();
        let renumbered = |&number: &usize| {
            let LimbLink { inboard, joint } = limb.links()[number];
            let own = |inboard: u16| numbers.partition_point(|&own| own < usize::from(inboard));
            LimbLink { inboard: inboard.map(|inboard| own(inboard) as u16), joint }
        };
        let links = numbers.iter().map(renumbered).collect();
        let mut carriers: Vec<usize> = parts.iter().map(|parts| parts.carrier).collect();
        carriers.sort_unstable();
        carriers.dedup();
        let some = !parts.is_empty();
        some.then(|| Self { limb: limb.clone(), numbers, links, parts, carriers })
    }

    /// The links of the trunk, as they are numbered in the limb.
    pub fn numbers(&self) -> &[usize] {
        &self.numbers
    }

    /// The equal parts that it carries.
    pub fn parts(&self) -> &[EqualParts] {
        &self.parts
    }

    /// A group of each link of the trunk.
    pub fn of_links(&self, group: Group) -> Group {
        group.of_links(1, self.links.len())
    }

    /// A group of each link that carries equal parts.
    pub fn of_carriers(&self, group: Group) -> Group {
        group.of_links(1, self.carriers.len())
    }

    /// Which of these links carries parts.
    pub fn carrier(&self, parts: &EqualParts) -> usize {
        self.carriers.partition_point(|&carrier| carrier < parts.carrier)
    }

    /// How the link stands that carries parts. It stands as in the limb, for no part begins with a parallel joint.
    pub fn standing_of_carrier(&self, parts: &EqualParts) -> Standing {
        Standing::of(self.limb.links(), parts.carrier)
    }

    /// The links that carry parts, as they are numbered in the trunk.
    fn carriers(&self) -> impl Iterator<Item = usize> {
        let own = |&carrier: &usize| self.numbers.partition_point(|&own| own < carrier);
        self.carriers.iter().map(own)
    }

    fn parameters(&self) -> Vec<Group> {
        let links = self.numbers.iter().enumerate();
        let links = links.flat_map(|(own, &link)| whole::of_link(&self.limb, link, own + 1));
        [BRANCH].into_iter().chain(links).collect()
    }

    fn standing(&self, link: usize) -> Standing {
        Standing::of(&self.links, link)
    }
}

/// The trunk turned and displaced by its joints.
pub fn trunk_outward<R: Real>(trunk: Trunk) -> Stage<R> {
    Stage {
        name: "outward",
        about: "The trunk of a limb: how its links stand, their biases, and how those move that carry parts.",
        parameters: trunk.parameters(),
        inputs: vec![OMEGA, trunk.of_links(RATES)],
        outputs: vec![trunk.of_links(KEPT), trunk.of_carriers(CARRIER)],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.limb(&trunk.links);
            let at_mount = limb::of_main_body(&branch, reader.vector());
            let rates: Vec<[R; 2]> =
                trunk.links.iter().map(|_| [reader.next(), reader.next()]).collect();
            let moving = limb::outward(1, &trunk.links, &branch, &at_mount, rates.into_iter());
            let kept = moving.iter().enumerate().flat_map(|(i, Moving { stance, body, .. })| {
                let Wrench { moment, force } = body.wrench();
                let wrench = moment.to_array().into_iter().chain(force.to_array());
                stance.flat(trunk.standing(i)).into_iter().chain(wrench)
            });
            let carriers = trunk.carriers().flat_map(|i| {
                let Moving { stance, motion, .. } = &moving[i];
                let [sin, cos] = match trunk.standing(i) {
                    Standing::Turning => [stance.turned.sin, stance.turned.cos],
                    Standing::Sliding | Standing::WithAxes => [R::zero(); 2],
                };
                let (w, origin) = (motion.spin.w.to_array(), motion.origin.to_array());
                let stance = [sin, cos, stance.bias.y, stance.bias.z].into_iter();
                stance.chain(w).chain([motion.sigma]).chain(origin)
            });
            kept.chain(carriers).collect()
        }),
    }
}

/// The joints of the trunk eliminated, when its parts are.
pub fn trunk_inward<R: Real>(trunk: Trunk) -> Stage<R> {
    Stage {
        name: "inward",
        about: "The joints of the trunk of a limb eliminated: what the limb shows at O, and what they leave.",
        parameters: trunk.parameters(),
        inputs: vec![trunk.of_links(KEPT), trunk.of_links(TORQUE), trunk.of_carriers(OUTBOARD)],
        outputs: vec![AT_ORIGIN, trunk.of_links(LIMB)],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.limb(&trunk.links);
            let standing: Vec<(Stance<R>, Turned<R>)> = (0..trunk.links.len())
                .map(|i| {
                    let stance = Stance::read(trunk.standing(i), &mut reader);
                    let wrench = Wrench { moment: reader.vector(), force: reader.vector() };
                    let rigid = stance.turned.rigid(&branch.links[i].inertia);
                    (stance, Turned::last(rigid, wrench))
                })
                .collect();
            let torques: Vec<R> = trunk.links.iter().map(|_| reader.next()).collect();
            let mut outboard = vec![AtOrigin::nothing(); trunk.links.len()];
            for carrier in trunk.carriers() {
                outboard[carrier] = AtOrigin::read(&mut reader);
            }
            let stands = |i: usize| (&standing[i].0, &standing[i].1);
            let (share, left) =
                limb::inward(1, &trunk.links, &branch, stands, |i| torques[i], outboard);
            [limb::at_origin(&share, &branch).flat(), whole::flat(&trunk.links, &left)].concat()
        }),
    }
}

/// The way back through the trunk.
pub fn trunk_back<R: Real>(trunk: Trunk) -> Stage<R> {
    Stage {
        name: "back",
        about: "τ̇ of the joints of the trunk of a limb, and the accelerations of links that carry parts.",
        parameters: trunk.parameters(),
        inputs: vec![trunk.of_links(LIMB), MAIN_RATES],
        outputs: vec![trunk.of_links(TAU_DOT), trunk.of_carriers(CARRIER_RATES)],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let branch = reader.limb(&trunk.links);
            let left = whole::eliminated(&trunk.links, &mut reader);
            let main = Twist { angular: reader.vector(), linear: reader.vector() };
            let rot = &branch.rot_body_from_appendage;
            let (angular, linear) = first_hinge(branch.point, rot, main);
            let at_mount = Twist { angular, linear };
            let reached = limb::back(1, &trunk.links, &branch, &left, at_mount);
            let tau_dot = reached.iter().map(|(_, tau_dot)| *tau_dot);
            let of_carriers = trunk.carriers().flat_map(|i| {
                let Twist { angular, linear } = reached[i].0;
                [angular, linear].into_iter().flat_map(Vec3::to_array)
            });
            tau_dot.chain(of_carriers).collect()
        }),
    }
}

/// The parameters of a part, whose first link is mounted on its carrier.
fn of_part(part: &Limb) -> Vec<Group> {
    let on_carrier = std::iter::once(MOUNT);
    on_carrier.chain(whole::parameters(part).into_iter().skip(1)).collect()
}

/// A part, whose numbers begin with its mount, and its carrier, which stands so.
fn part_on_carrier<R: Real>(
    part: &Limb,
    carrier: Standing,
    reader: &mut Reader<impl Iterator<Item = R>>,
) -> (Branch<R>, Stance<R>, Motion<R>) {
    let branch = reader.limb(part.links());
    let (turn, still) = (Turn { sin: reader.next(), cos: reader.next() }, Turn::still());
    let stance = Stance {
        // Nothing that it carries asks how its axes have turned, or how far it has slid.
        axes_turned: still,
        turned: if carrier == Standing::Turning { turn } else { still },
        travel: R::zero(),
        bias: Vec3::new(R::zero(), reader.next(), reader.next()),
    };
    let (spin, sigma) = (Spin::new(reader.vector()), reader.next());
    // Parallel joints alone ask for its angle, and no part begins with one.
    let motion = Motion { alpha: R::zero(), sigma, spin, origin: reader.vector() };
    (branch, stance, motion)
}

/// All joints of a part eliminated, whose carrier stands so.
pub fn part_inward<R: Real>(part: Limb, carrier: Standing) -> Stage<R> {
    Stage {
        name: "inward",
        about: "All joints of a part eliminated: what it shows at its carrier's origin, and what they leave.",
        parameters: of_part(&part),
        inputs: vec![CARRIER, of_limb(LIMB_HINGES, &part)],
        outputs: vec![OUTBOARD, of_limb(LIMB, &part)],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let (branch, stance, motion) = part_on_carrier(&part, carrier, &mut reader);
            let mount = branch.mount(0);
            let at_mount = motion.at(&stance, &mount);
            let hinges = whole::hinges(part.links().len(), &mut reader);
            let (share, left) = limb::eliminate(1, part.links(), &branch, &at_mount, &hinges);
            let carried = stance.share_carried(&mount, &share);
            [carried.flat(), whole::flat(part.links(), &left)].concat()
        }),
    }
}

/// The way back through a part, whose carrier stands so.
pub fn part_back<R: Real>(part: Limb, carrier: Standing) -> Stage<R> {
    Stage {
        name: "back",
        about: "τ̇ of the joints of a part.",
        parameters: of_part(&part),
        inputs: vec![CARRIER, of_limb(LIMB, &part), CARRIER_RATES],
        outputs: vec![of_limb(LIMB_TAU_DOT, &part)],
        run: Box::new(move |numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let (branch, stance, _) = part_on_carrier(&part, carrier, &mut reader);
            let left = whole::eliminated(part.links(), &mut reader);
            let of_carrier = Twist { angular: reader.vector(), linear: reader.vector() };
            let at_mount = stance.carries(&branch.mount(0), of_carrier);
            let reached = limb::back(1, part.links(), &branch, &left, at_mount);
            reached.into_iter().map(|(_, tau_dot)| tau_dot).collect()
        }),
    }
}
