//! How many cases meet what is required.

use super::confidence::proportion;
use super::summary::{Compliance, Worse};
use super::{Proportion, Requirement};

/// Cases of one group that meet requirements.
#[derive(Clone, Debug)]
pub(super) struct Met {
    /// Of each of them how many do, and the first that does not.
    each: Vec<(u64, Option<u64>)>,
    /// All of them.
    all: u64,
}

/// A requirement of a column.
#[derive(Clone, Debug)]
pub(super) struct Required {
    pub requirement: Requirement,
    pub column: usize,
}

impl Met {
    pub fn new(requirements: usize) -> Self {
        Self { each: vec![(0, None); requirements], all: 0 }
    }

    /// Takes a case with these numbers.
    pub fn add(&mut self, case: u64, numbers: &[f64], required: &[Required]) {
        let mut meets_all = true;
        for ((met, first_broken), Required { requirement, column }) in
            self.each.iter_mut().zip(required)
        {
            if requirement.is_met(numbers[*column]) {
                *met += 1;
            } else {
                first_broken.get_or_insert(case);
                meets_all = false;
            }
        }
        self.all += u64::from(meets_all);
    }

    /// The share of so many cases that meet all.
    pub fn all(&self, cases: u64) -> Proportion {
        proportion(self.all, cases)
    }
}

impl Required {
    /// What groups with so many cases came to; this is the requirement with this number.
    pub fn compliance<'a>(
        &self,
        number: usize,
        groups: impl Iterator<Item = (&'a Met, u64)> + Clone,
    ) -> Compliance {
        Compliance {
            requirement: self.requirement.clone(),
            met: groups.clone().map(|(met, cases)| proportion(met.each[number].0, cases)).collect(),
            first_broken: groups.map(|(met, _)| met.each[number].1).collect(),
        }
    }

    /// On which side of it numbers are worse, if it has one bound.
    pub fn worse(&self) -> Option<Worse> {
        match (self.requirement.at_least, self.requirement.at_most) {
            (Some(_), None) => Some(Worse::Small),
            (None, Some(_)) => Some(Worse::Large),
            _ => None,
        }
    }
}
