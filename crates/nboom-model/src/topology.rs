use std::fmt;

/// The hinges of one appendage that turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Shape {
    /// A chain of this many links whose hinge axes are all parallel.
    Chain(usize),
    /// An arm and, about an axis square to the arm's hinge, a paddle.
    Paddle,
}

impl Shape {
    /// How many hinges it has.
    pub fn hinges(self) -> usize {
        match self {
            Self::Chain(links) => links,
            Self::Paddle => 2,
        }
    }
}

/// The appendages of a satellite by shape alone: what a routine is generated for.
///
/// The order is canonical, chains first and longer ones before shorter ones, so that scenes
/// that differ only in numbering have one topology.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Topology {
    shapes: Vec<Shape>,
}

impl Topology {
    /// The topology of appendages given in any order; chains without links are left out.
    pub fn new(shapes: impl IntoIterator<Item = Shape>) -> Self {
        let mut shapes: Vec<Shape> =
            shapes.into_iter().filter(|shape| shape.hinges() > 0).collect();
        shapes.sort_by_key(|shape| match shape {
            Shape::Chain(links) => (0, usize::MAX - links),
            Shape::Paddle => (1, 0),
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

    /// Runs of equal shapes with their lengths, in canonical order.
    pub fn groups(&self) -> Vec<(Shape, usize)> {
        let mut groups: Vec<(Shape, usize)> = Vec::new();
        for &shape in &self.shapes {
            match groups.last_mut() {
                Some((last, count)) if *last == shape => *count += 1,
                _ => groups.push((shape, 1)),
            }
        }
        groups
    }
}

impl fmt::Display for Topology {
    /// For example `4xS5_P`: four chains of five links and a paddle; `M` is a main body alone.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.shapes.is_empty() {
            return write!(f, "M");
        }
        for (i, (shape, count)) in self.groups().into_iter().enumerate() {
            let separator = if i > 0 { "_" } else { "" };
            let times = if count > 1 { format!("{count}x") } else { String::new() };
            match shape {
                Shape::Chain(links) => write!(f, "{separator}{times}S{links}")?,
                Shape::Paddle => write!(f, "{separator}{times}P")?,
            }
        }
        Ok(())
    }
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
}
