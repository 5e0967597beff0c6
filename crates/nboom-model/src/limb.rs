mod equal_parts;

use std::fmt;
use std::sync::Arc;

pub use equal_parts::EqualParts;

/// The links of an appendage of any form: a tree of bodies, each on a joint about or along one axis.
///
/// The order is canonical: a link stands before all that is outboard of it, and of the parts outboard of
/// one link the larger ones come first, then by name. Limbs that differ only in numbering are equal.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Limb {
    links: Arc<[LimbLink]>,
}

/// A link of a limb.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LimbLink {
    /// The inboard link; `None` is what the limb is mounted on.
    pub inboard: Option<u16>,
    /// The joint between the two.
    pub joint: LimbJoint,
}

/// What a joint of a limb leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LimbJoint {
    /// Turning about any axis.
    Revolute,
    /// Turning about an axis parallel to the one about which the inboard link turns.
    Parallel,
    /// Sliding along any axis.
    Prismatic,
}

impl LimbJoint {
    const ALL: [Self; 3] = [Self::Revolute, Self::Parallel, Self::Prismatic];

    fn letter(self) -> char {
        match self {
            Self::Revolute => 'r',
            Self::Parallel => 'p',
            Self::Prismatic => 's',
        }
    }
}

impl Limb {
    /// The most links that a limb can have, as many as a routine has hinges: what puts them in order takes room
    /// in proportion to the square of their number.
    pub const MOST_LINKS: usize = 1000;

    /// The limb of links that stand inboard before outboard, the first on what the limb is mounted on and
    /// no other; with it, for each link of the canonical order, which of these it is.
    ///
    /// `None` if links do not stand so, if there are none or more than [`MOST_LINKS`](Self::MOST_LINKS), or
    /// if an axis is said to be parallel to one about which nothing turns.
    pub fn new(links: &[LimbLink]) -> Option<(Self, Vec<usize>)> {
        let stands = |(i, link): (usize, &LimbLink)| match link.inboard {
            None => i == 0 && link.joint != LimbJoint::Parallel,
            Some(inboard) => {
                let inboard = usize::from(inboard);
                let turns = |j: usize| links[j].joint != LimbJoint::Prismatic;
                inboard < i && (link.joint != LimbJoint::Parallel || turns(inboard))
            }
        };
        if links.is_empty() || links.len() > Self::MOST_LINKS {
            return None;
        }
        links.iter().enumerate().all(stands).then(|| Self::in_order(links))
    }

    fn in_order(links: &[LimbLink]) -> (Self, Vec<usize>) {
        let parts = parts(links);
        let (mut in_order, mut order) = (Vec::new(), Vec::new());
        let mut waiting = vec![(0, None)];
        while let Some((i, inboard)) = waiting.pop() {
            let number = order.len() as u16;
            in_order.push(LimbLink { inboard, joint: links[i].joint });
            order.push(i);
            waiting.extend(parts[i].outboard.iter().rev().map(|&j| (j, Some(number))));
        }
        (Self { links: in_order.into() }, order)
    }

    /// The limb with this name, as [`Display`](fmt::Display) writes it, its parts in any order.
    pub(crate) fn named(text: &str) -> Option<Self> {
        let mut links = Vec::new();
        let (mut inboard, mut branchings) = (None, Vec::new());
        for letter in text.strip_prefix('T')?.chars() {
            match letter {
                '(' => branchings.push(inboard?),
                ')' => inboard = Some(branchings.pop()?),
                letter => {
                    let joint =
                        LimbJoint::ALL.into_iter().find(|joint| joint.letter() == letter)?;
                    links.push(LimbLink { inboard, joint });
                    inboard = Some(u16::try_from(links.len() - 1).ok()?);
                }
            }
        }
        let limb = Self::new(&links)?.0;
        // Every other way of writing branches would be a second name of the same limb.
        let is_plain = branchings.is_empty() && limb.to_string().len() == text.len();
        is_plain.then_some(limb)
    }

    /// The links, inboard before outboard.
    pub fn links(&self) -> &[LimbLink] {
        &self.links
    }
}

/// A link and all that is outboard of it.
#[derive(Clone, Default)]
struct Part {
    /// In letters and parentheses.
    name: String,
    /// The links next to it, in canonical order.
    outboard: Vec<usize>,
}

/// The parts that begin with each of the links.
fn parts(links: &[LimbLink]) -> Vec<Part> {
    let mut parts = vec![Part::default(); links.len()];
    for i in (0..links.len()).rev() {
        let mut outboard = std::mem::take(&mut parts[i].outboard);
        let size = |j: &usize| parts[*j].name.chars().filter(|c| c.is_alphabetic()).count();
        outboard.sort_by_key(|j| (usize::MAX - size(j), parts[*j].name.clone(), *j));
        let mut name = links[i].joint.letter().to_string();
        match outboard[..] {
            [only] => name += &parts[only].name,
            _ => outboard.iter().for_each(|&j| name += &format!("({})", parts[j].name)),
        }
        parts[i] = Part { name, outboard };
        if let Some(inboard) = links[i].inboard {
            parts[usize::from(inboard)].outboard.push(i);
        }
    }
    parts
}

impl fmt::Display for Limb {
    /// `T`, and for each link `r`, `p` or `s` by its joint, followed by what is outboard of it: one part as
    /// it is, several in parentheses. `Tr(rp)(s)` has an arm of two links and a slide on its first link.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "T{}", parts(self.links())[0].name)
    }
}

impl fmt::Debug for Limb {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Limb({self})")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn link(inboard: Option<u16>, joint: LimbJoint) -> LimbLink {
        LimbLink { inboard, joint }
    }

    #[test]
    fn numbering_does_not_matter() {
        use LimbJoint::{Parallel, Prismatic, Revolute};
        let slide_first = [
            link(None, Revolute),
            link(Some(0), Prismatic),
            link(Some(0), Revolute),
            link(Some(2), Parallel),
        ];
        let arm_first = [
            link(None, Revolute),
            link(Some(0), Revolute),
            link(Some(1), Parallel),
            link(Some(0), Prismatic),
        ];
        let (limb, order) = Limb::new(&slide_first).expect("a limb");
        assert_eq!(limb.to_string(), "Tr(rp)(s)");
        assert_eq!(order, [0, 2, 3, 1]);
        assert_eq!(Limb::new(&arm_first), Some((limb, vec![0, 1, 2, 3])));
    }

    #[test]
    fn equal_parts_keep_their_order() {
        let revolute = |inboard| link(inboard, LimbJoint::Revolute);
        let (limb, order) =
            Limb::new(&[revolute(None), revolute(Some(0)), revolute(Some(0))]).expect("a limb");
        assert_eq!((limb.to_string().as_str(), order), ("Tr(r)(r)", vec![0, 1, 2]));
    }

    #[test]
    fn a_name_reads_back_and_others_do_not() {
        for name in ["Tr", "Ts", "Trpp", "Tr(rp)(s)", "Trp(rr(s)(s))(pp)(rr)"] {
            assert_eq!(Limb::named(name).map(|limb| limb.to_string()).as_deref(), Some(name));
        }
        assert_eq!(Limb::named("Tr(s)(rp)"), Limb::named("Tr(rp)(s)"));
        let long = format!("T{}", "r".repeat(Limb::MOST_LINKS + 1));
        let deep = format!("Tr{}", "(".repeat(100_000));
        let wrong = ["T", "Tp", "Tsp", "Tr(r)", "Tr(r", "Tr)r", "Tr()", "T(r)", "Tr(r)r", "Trx"];
        for name in wrong.into_iter().chain([&long[..], &deep]) {
            assert_eq!(Limb::named(name), None, "{name}");
        }
    }
}
