//! For tests: limbs and numbers from a seed, and steps interpreted on them.

use nboom_formulation::Layout;
use nboom_model::{Limb, LimbJoint, LimbLink, Shape, Topology};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng as _, SeedableRng};

use crate::request::{Level, Request};
use crate::trace::Traced;
use crate::trace::rolled::Equal;

pub struct Dice(SplitMix64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        Self(SplitMix64::seed_from_u64(seed))
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
    }

    /// Between −2 and 2, at times zero or one.
    pub fn number(&mut self) -> f64 {
        match self.below(8) {
            0 | 1 => 0.0,
            2 => 1.0,
            _ => self.below(1 << 30) as f64 / f64::from(1 << 28) - 2.0,
        }
    }

    pub fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    /// A tree of joints of all kinds, mostly long parts.
    pub fn limb(&mut self, count: usize) -> Limb {
        let mut links: Vec<LimbLink> = Vec::new();
        for i in 0..count {
            let near = 1 + self.below(3.min(i.max(1)));
            let inboard = i.checked_sub(near);
            let inboard = if i > 0 { Some(inboard.unwrap_or(0)) } else { None };
            let may_be_parallel = inboard.is_some_and(|j| links[j].joint != LimbJoint::Prismatic);
            let joint = match self.below(5) {
                0 => LimbJoint::Prismatic,
                1 | 2 if may_be_parallel => LimbJoint::Parallel,
                _ => LimbJoint::Revolute,
            };
            let inboard = inboard.map(|j| j as u16);
            links.push(LimbLink { inboard, joint });
        }
        Limb::new(&links).expect("a tree").0
    }

    /// Numbers of which every inertia about a joint, and every mass, is positive.
    pub fn parameters(&mut self, group: &Equal, limb: &Limb) -> Vec<f64> {
        let mut numbers = self.numbers(group.parameters());
        for i in 0..limb.links().len() {
            let body = group.link(i) + Layout::mount(limb, i);
            numbers[body] = 1.0 + self.below(100) as f64;
            numbers[body + 4] = 200.0 + self.below(100) as f64;
        }
        numbers
    }
}

/// A request for a limb alone, of whose parameters nothing is assumed, zeros and ones, some or all, by the seed; the
/// limb among its appendages, and its parameters.
pub fn asked(seed: u64, dice: &mut Dice, limb: &Limb) -> (Request, Equal, Vec<f64>) {
    let shape = Shape::Limb(limb.clone());
    let topology = Topology::new([shape.clone()]);
    let mut request = Request::new("Limb", topology, Level::Exact);
    let parameter = Layout::MAIN;
    let group = Equal { shape, count: 1, parameter, hinge: 0, law: 0, coupling: 0, part: None };
    let p = dice.parameters(&group, limb);
    let assumed = |value: &f64| match seed % 4 {
        0 => None,
        1 => (*value == 0.0 || *value == 1.0).then_some(*value),
        2 => (dice.below(2) == 0).then_some(*value),
        _ => Some(*value),
    };
    let assumptions: Vec<Option<f64>> = p.iter().map(assumed).collect();
    request.assumptions[Layout::MAIN..].copy_from_slice(&assumptions);
    (request, group, p)
}

/// What a step hands on, one list for each group.
pub fn taken(step: &Traced, parameters: &[f64], inputs: &[&[f64]]) -> Vec<Vec<f64>> {
    let Traced { split, inputs: groups, outputs, .. } = step;
    let mut numbers = parameters[..split.parameters].to_vec();
    assert_eq!(groups.len(), inputs.len());
    for ((group, mask), values) in groups.iter().zip(inputs) {
        assert_eq!(values.len(), group.size(), "{}", step.name);
        numbers.extend(mask.iter().zip(*values).map(|(live, value)| match live {
            true => *value,
            false => f64::NAN,
        }));
    }
    let mut found = split.graph.evaluate(&numbers).into_iter();
    let handed_on = |(value, live): (f64, &bool)| {
        assert!(*live || value == 0.0, "{}", step.name);
        if *live { value } else { f64::NAN }
    };
    let groups = outputs
        .iter()
        .map(|(group, mask)| found.by_ref().take(group.size()).zip(mask).map(handed_on).collect());
    groups.collect()
}
