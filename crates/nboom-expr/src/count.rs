use std::fmt;
use std::ops::Add;

use crate::{Graph, Node};

/// How many operations a graph takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Sums, differences and changes of sign that are not part of one.
    pub additions: usize,
    /// Products.
    pub multiplications: usize,
    /// Quotients.
    pub divisions: usize,
    /// Square roots.
    pub square_roots: usize,
    /// Angles whose sine or cosine is taken.
    pub angles: usize,
}

impl Operations {
    /// Additions, multiplications and divisions together.
    pub fn flops(&self) -> usize {
        self.additions + self.multiplications + self.divisions
    }
}

impl Add for Operations {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            additions: self.additions + other.additions,
            multiplications: self.multiplications + other.multiplications,
            divisions: self.divisions + other.divisions,
            square_roots: self.square_roots + other.square_roots,
            angles: self.angles + other.angles,
        }
    }
}

impl fmt::Display for Operations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { additions, multiplications, divisions, square_roots, angles } = self;
        write!(f, "{additions} add, {multiplications} mul, {divisions} div")?;
        if *square_roots > 0 {
            write!(f, ", {square_roots} sqrt")?;
        }
        write!(f, ", {angles} sin_cos")
    }
}

impl Graph {
    /// Operations of the whole graph.
    pub fn operations(&self) -> Operations {
        self.operations_of(|_| true)
    }

    /// Operations of the nodes (by number) for which `counted` holds.
    pub fn operations_of(&self, counted: impl Fn(usize) -> bool) -> Operations {
        let mut count = Operations::default();
        let mut angles = std::collections::BTreeSet::new();
        for (_, node) in self.nodes().filter(|(id, _)| counted(id.index())) {
            match node {
                Node::Input(_) | Node::Constant(_) => {}
                Node::Add(..) | Node::Sub(..) | Node::Neg(_) => count.additions += 1,
                Node::Mul(..) => count.multiplications += 1,
                Node::Div(..) => count.divisions += 1,
                Node::Sqrt(_) => count.square_roots += 1,
                Node::Sin(angle) | Node::Cos(angle) => {
                    angles.insert(angle);
                }
            }
        }
        count.angles = angles.len();
        count
    }
}
