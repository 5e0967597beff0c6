use std::ops::Range;

use super::builder::Builder;
use super::shown;
use super::values::plain;

/// Where one appendage stands in the list of all segments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct AppendageSegments {
    /// Number of the appendage, from 0.
    pub appendage: usize,
    /// Its segments, from 0.
    pub segments: Range<usize>,
    pub is_paddle: bool,
}

impl AppendageSegments {
    /// The segment whose absolute angle is part of that of segment `i`; a paddle's second body
    /// turns about another axis.
    pub fn summed_inboard(&self, i: usize) -> Option<usize> {
        (!self.is_paddle && i > self.segments.start).then(|| i - 1)
    }
}

impl Builder<'_, '_, '_> {
    /// The appendages; `None`, and reported, when NA, NP, IXK and NK do not fit together.
    pub fn layout(&mut self) -> Option<Vec<AppendageSegments>> {
        let first_paddle = self.first_paddle();
        let counts = self.counts();
        let (first_paddle, counts) = (first_paddle?, counts?);
        let paddles_are_pairs = self.check_paddles(&counts[first_paddle..], first_paddle);
        let sum_is_right = self.check_sum(counts.iter().sum());
        let mut start = 0;
        let places = counts.iter().enumerate().map(|(appendage, count)| {
            let segments = start..start + count;
            start = segments.end;
            AppendageSegments { appendage, segments, is_paddle: appendage >= first_paddle }
        });
        (paddles_are_pairs && sum_is_right).then(|| places.collect())
    }

    fn first_paddle(&mut self) -> Option<usize> {
        let (paddles, appendages) = (self.values.real("NP", 0), self.sizes.appendages);
        if !(0.0..=appendages as f64).contains(&paddles) {
            let expected = format!("at least 0 and at most NA = {appendages}");
            self.error(plain("NP"), 0, shown(paddles), &expected);
            return None;
        }
        Some(appendages - paddles as usize)
    }

    /// Segments of each appendage; missing ones have been reported.
    fn counts(&mut self) -> Option<Vec<usize>> {
        let most = self.sizes.segments as f64;
        let mut counts = Some(Vec::new());
        for k in 0..self.sizes.appendages {
            let count = self.values.get("NK", k);
            if let Some(wrong) = count.filter(|count| !(1.0..=most).contains(count)) {
                let expected = format!("at least 1 and at most IXK = {}", self.sizes.segments);
                self.error(plain("NK"), k, shown(wrong), &expected);
                counts = None;
            }
            counts = counts.zip(count).map(|(mut counts, count)| {
                counts.push(count as usize);
                counts
            });
        }
        counts
    }

    fn check_paddles(&mut self, counts: &[usize], first: usize) -> bool {
        for (k, count) in counts.iter().enumerate().filter(|(_, count)| **count != 2) {
            self.error(plain("NK"), first + k, count.to_string(), "2 for a paddle");
        }
        counts.iter().all(|count| *count == 2)
    }

    fn check_sum(&mut self, sum: usize) -> bool {
        let segments = self.sizes.segments;
        if segments != sum {
            let expected = format!("{sum}, the sum of NK");
            self.error(plain("IXK"), 0, segments.to_string(), &expected);
        }
        segments == sum
    }
}
