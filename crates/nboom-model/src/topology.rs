use std::fmt;
use std::str::FromStr;

use crate::Limb;

/// The hinges of one appendage that turn.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// A chain of this many links whose hinge axes are all parallel.
    Chain(usize),
    /// An arm and, about an axis square to the arm's hinge, a paddle.
    Paddle,
    /// Any other.
    Limb(Limb),
}

impl Shape {
    /// How many hinges it has.
    pub fn hinges(&self) -> usize {
        match self {
            Self::Chain(links) => *links,
            Self::Paddle => 2,
            Self::Limb(limb) => limb.links().len(),
        }
    }

    /// The link that carries the hinge of a link; none where the main body does.
    pub fn inboard(&self, link: usize) -> Option<usize> {
        match self {
            Self::Chain(_) | Self::Paddle => link.checked_sub(1),
            Self::Limb(limb) => limb.links()[link].inboard.map(usize::from),
        }
    }
}

/// The appendages of a satellite by shape alone: what a routine is generated for.
///
/// The order is canonical, chains first and limbs last, longer ones before shorter ones, so that
/// scenes that differ only in numbering have one topology.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Topology {
    shapes: Vec<Shape>,
}

impl Topology {
    /// The most hinges for which code is generated.
    pub const MOST_HINGES: usize = 1000;

    /// The topology of appendages given in any order; chains without links are left out.
    pub fn new(shapes: impl IntoIterator<Item = Shape>) -> Self {
        let mut shapes: Vec<Shape> =
            shapes.into_iter().filter(|shape| shape.hinges() > 0).collect();
        shapes.sort_by_key(|shape| match shape {
            Shape::Chain(links) => (0, usize::MAX - links, None),
            Shape::Paddle => (1, 0, None),
            Shape::Limb(limb) => (2, usize::MAX - limb.links().len(), Some(limb.clone())),
        });
        Self { shapes }
    }

    /// The appendages in canonical order.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// Hinges of all appendages.
    pub fn hinges(&self) -> usize {
        self.shapes.iter().map(|shape| shape.hinges()).sum()
    }

    /// For each hinge the one inboard of it in the same appendage; none where the main body carries it.
    pub fn inboard_hinges(&self) -> Vec<Option<usize>> {
        let mut all = Vec::with_capacity(self.hinges());
        for shape in &self.shapes {
            let first = all.len();
            let inboard = |link| shape.inboard(link).map(|inboard| first + inboard);
            all.extend((0..shape.hinges()).map(inboard));
        }
        all
    }

    /// Whether an appendage is neither a chain nor a paddle.
    pub fn has_limbs(&self) -> bool {
        self.shapes.iter().any(|shape| matches!(shape, Shape::Limb(_)))
    }

    /// Runs of equal shapes with their lengths, in canonical order.
    pub fn groups(&self) -> impl Iterator<Item = (Shape, usize)> {
        self.shapes.chunk_by(|a, b| a == b).map(|equal| (equal[0].clone(), equal.len()))
    }
}

impl fmt::Display for Topology {
    /// For example `4xS5_P`: four chains of five links and a paddle; `M` is a main body alone.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.shapes.is_empty() {
            return write!(f, "M");
        }
        for (i, (shape, count)) in self.groups().enumerate() {
            let separator = if i > 0 { "_" } else { "" };
            let times = if count > 1 { format!("{count}x") } else { String::new() };
            match shape {
                Shape::Chain(links) => write!(f, "{separator}{times}S{links}")?,
                Shape::Paddle => write!(f, "{separator}{times}P")?,
                Shape::Limb(limb) => write!(f, "{separator}{times}{limb}")?,
            }
        }
        Ok(())
    }
}

/// The most hinges that a name stands for, so that none fills the memory. Those beyond
/// [`Topology::MOST_HINGES`] are told by their number where code is to be generated.
const MOST_NAMED: usize = 10_000;

/// Why a text names no topology.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{text}` found, a topology like 4xS5_P expected: M, or appendages joined by _, each S and its \
     links, P, or T and the joints of a limb like Tr(rp)(s), at most {} hinges in all",
    Topology::MOST_HINGES
)]
pub struct TopologyError {
    /// What was found.
    pub text: String,
}

impl FromStr for Topology {
    type Err = TopologyError;

    /// Reads what [`Display`](fmt::Display) writes; appendages may stand in any order.
    fn from_str(text: &str) -> Result<Self, TopologyError> {
        let topology = if text == "M" { Some(Vec::new()) } else { shapes(text) }.map(Self::new);
        topology.ok_or_else(|| TopologyError { text: text.to_owned() })
    }
}

fn shapes(text: &str) -> Option<Vec<Shape>> {
    let mut shapes = Vec::new();
    for group in text.split('_') {
        let (count, shape) = match group.split_once('x') {
            Some((count, shape)) => (number(count)?, shape),
            None => (1, group),
        };
        let shape = match (shape.strip_prefix('S'), shape) {
            (Some(links), _) => Shape::Chain(number(links)?),
            (_, "P") => Shape::Paddle,
            _ => Shape::Limb(Limb::named(shape)?),
        };
        let hinges = count.checked_mul(shape.hinges())?;
        if hinges > MOST_NAMED - shapes.iter().map(|s: &Shape| s.hinges()).sum::<usize>() {
            return None;
        }
        shapes.extend(std::iter::repeat_n(shape, count));
    }
    Some(shapes)
}

/// A positive number without sign or leading zeros.
fn number(text: &str) -> Option<usize> {
    let plain = text.bytes().all(|digit| digit.is_ascii_digit()) && !text.starts_with('0');
    text.parse().ok().filter(|_| plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbering_does_not_matter() {
        let a = Topology::new([Shape::Paddle, Shape::Chain(2), Shape::Chain(5), Shape::Chain(2)]);
        let b = Topology::new([Shape::Chain(2), Shape::Chain(5), Shape::Chain(2), Shape::Paddle]);
        assert_eq!(a, b);
        assert_eq!(a.to_string(), "S5_2xS2_P");
        assert_eq!(a.hinges(), 11);
    }

    #[test]
    fn a_name_reads_back() {
        for name in ["M", "S1", "P", "4xS5_P", "S100", "S5_2xS2_3xP", "P_4xTrrp_Ts"] {
            let topology: Topology = name.parse().expect("a topology");
            assert_eq!(topology.to_string(), name);
        }
        assert_eq!("P_S2".parse::<Topology>().map(|t| t.to_string()).ok(), Some("S2_P".to_owned()));
    }

    #[test]
    fn what_is_no_name_is_refused() {
        let huge = "99999999999999999999xS1";
        let wrong = ["", "S", "S0", "S-1", "0xP", "4x", "xS1", "S2__P", "Q", "M_P", "S+2", "S1e3"];
        for text in wrong.into_iter().chain([huge, "S10001", "9999xP", "9999xS1_P"]) {
            let error = text.parse::<Topology>().expect_err(text);
            assert_eq!(error.text, text);
        }
        assert!("9998xS1_P".parse::<Topology>().is_ok());
        let refused = "S10001".parse::<Topology>().expect_err("too long").to_string();
        assert!(refused.ends_with("at most 1000 hinges in all"), "{refused}");
    }
}
