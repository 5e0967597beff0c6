//! What a figure shows.

use std::borrow::Cow;

use crate::axis::Scale;
use crate::style::MOST_COLOURS;

/// Most panels of a figure; of more, all curves share one.
const MOST_PANELS: usize = 6;

/// A figure: panels one below the other, over the same time.
#[derive(Debug, Clone)]
pub(crate) struct Figure<'a> {
    /// What it shows.
    pub title: &'static str,
    /// How to read it, below the title.
    pub note: String,
    pub panels: Vec<Panel<'a>>,
}

/// Curves of one quantity.
#[derive(Debug, Clone)]
pub(crate) struct Panel<'a> {
    /// The quantity, with its unit if it has one.
    pub label: String,
    pub scale: Scale,
    /// The shortest range of the axis that shows more than rounding.
    pub least: f64,
    pub curves: Vec<Curve<'a>>,
}

/// One value over time.
#[derive(Debug, Clone)]
pub(crate) struct Curve<'a> {
    pub label: String,
    /// Curves of one group share a panel.
    pub group: usize,
    pub times: &'a [f64],
    pub values: Cow<'a, [f64]>,
    /// Time and size of the largest value of the whole motion.
    pub largest: Option<[f64; 2]>,
}

impl<'a> Curve<'a> {
    pub fn new(label: impl Into<String>, times: &'a [f64], values: Cow<'a, [f64]>) -> Self {
        Self { label: label.into(), group: 0, times, values, largest: None }
    }

    /// All values that an axis must have room for.
    pub fn reach(&self) -> impl Iterator<Item = f64> {
        self.values.iter().copied().chain(self.largest.map(|[_, value]| value))
    }
}

impl<'a> Panel<'a> {
    pub fn new(quantity: &str, unit: &str, scale: Scale, curves: Vec<Curve<'a>>) -> Self {
        let label =
            if unit.is_empty() { quantity.to_owned() } else { format!("{quantity} [{unit}]") };
        Self { label, scale, least: 0.0, curves }
    }

    /// The panels of many curves: groups together as long as each curve has a colour of its own, a group of more
    /// curves alone, and all of them in one panel where that would be too many.
    pub fn of_groups(
        quantity: &str,
        unit: &str,
        scale: Scale,
        curves: Vec<Curve<'a>>,
    ) -> Vec<Self> {
        let panel = |curves| Self::new(quantity, unit, scale, curves);
        let mut panels: Vec<Vec<Curve<'a>>> = Vec::new();
        for group in curves.chunk_by(|a, b| a.group == b.group) {
            match panels.last_mut().filter(|last| last.len() + group.len() <= MOST_COLOURS) {
                Some(last) => last.extend_from_slice(group),
                None => panels.push(group.to_vec()),
            }
        }
        if panels.len() > MOST_PANELS {
            return vec![panel(curves)];
        }
        panels.into_iter().map(panel).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sizes(groups: &[usize]) -> Vec<usize> {
        let curve = |group| Curve { group, ..Curve::new("", &[], Cow::Borrowed(&[])) };
        let curves = groups.iter().enumerate().flat_map(|(i, &count)| vec![curve(i); count]);
        let panels = Panel::of_groups("Angle", "°", Scale::Degrees, curves.collect());
        panels.iter().map(|panel| panel.curves.len()).collect()
    }

    #[test]
    fn appendages_share_panels_as_long_as_colours_last() {
        assert_eq!(sizes(&[2, 2]), [4]);
        assert_eq!(sizes(&[3, 3, 3]), [6, 3]);
        assert_eq!(sizes(&[100]), [100]);
        assert_eq!(sizes(&[1; 20]), [8, 8, 4]);
        assert_eq!(sizes(&[5; 20]), [100]);
        assert_eq!(sizes(&[]), [0; 0]);
    }
}
