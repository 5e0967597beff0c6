//! Steps as they are emitted, interpreted joint by joint, against whole limbs on `f64`: bit for bit. What a step
//! does not hand on is NaN for those that follow.

use nboom_formulation::stages::{LIMB, of_limb};
use nboom_model::{Limb, LimbJoint, LimbLink, Shape, Topology};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng as _, SeedableRng};

use super::*;
use crate::request::Level;

const LIMBS: u64 = 400;

struct Dice(SplitMix64);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
    }

    /// Between −2 and 2, at times zero or one.
    fn number(&mut self) -> f64 {
        match self.below(8) {
            0 | 1 => 0.0,
            2 => 1.0,
            _ => self.below(1 << 30) as f64 / f64::from(1 << 28) - 2.0,
        }
    }

    fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    /// A tree of joints of all kinds, mostly long parts.
    fn limb(&mut self, count: usize) -> Limb {
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
    fn parameters(&mut self, group: &Equal, limb: &Limb) -> Vec<f64> {
        let mut numbers = self.numbers(group.parameters());
        for i in 0..limb.links().len() {
            let body = group.link(i) + Layout::mount(limb, i);
            numbers[body] = 1.0 + self.below(100) as f64;
            numbers[body + 4] = 200.0 + self.below(100) as f64;
        }
        numbers
    }
}

/// What a step hands on, one list for each group.
fn taken(step: &Placed, parameters: &[f64], inputs: &[&[f64]]) -> Vec<Vec<f64>> {
    let Traced { split, inputs: groups, outputs, .. } = &step.traced;
    let mut numbers = parameters[..split.parameters].to_vec();
    assert_eq!(groups.len(), inputs.len());
    for ((group, mask), values) in groups.iter().zip(inputs) {
        assert_eq!(values.len(), group.size(), "{}", step.traced.name);
        numbers.extend(mask.iter().zip(*values).map(|(live, value)| match live {
            true => *value,
            false => f64::NAN,
        }));
    }
    let mut found = split.graph.evaluate(&numbers).into_iter();
    let handed_on = |(value, live): (f64, &bool)| {
        assert!(*live || value == 0.0, "{}", step.traced.name);
        if *live { value } else { f64::NAN }
    };
    let groups = outputs
        .iter()
        .map(|(group, mask)| found.by_ref().take(group.size()).zip(mask).map(handed_on).collect());
    groups.collect()
}

/// The kind of which link `i` is.
fn of(kinds: &[Kind], i: usize) -> &Kind {
    kinds.iter().find(|kind| kind.links.contains(&i)).expect("of some kind")
}

/// What the limb shows at O, and τ̇ of its joints when the main body has these accelerations; hinges are β, τ and
/// torque.
fn by_steps(
    joints: &Joints,
    group: &Equal,
    p: &[f64],
    [omega, hinges, main]: [&[f64]; 3],
) -> (Vec<f64>, Vec<f64>) {
    let links = joints.limb.links();
    let inboard = |i: usize| links[i].inboard.map(usize::from);
    let of_mount = |i: usize| &p[group.link(i)..];
    let of_body = |i: usize| &p[group.link(i) + Layout::mount(&joints.limb, i)..];
    let mut alpha: Vec<f64> = Vec::new();
    let mut moving: Vec<Vec<Vec<f64>>> = Vec::new();
    for i in 0..links.len() {
        let at_mount = match inboard(i) {
            None => taken(&joints.start, p, &[omega]),
            Some(j) => {
                let inboard = &moving[j];
                taken(
                    &of(&joints.mounts, i).outward,
                    of_mount(i),
                    &[&inboard[0], &inboard[1], &inboard[2]],
                )
            }
        };
        let beta = hinges[3 * i];
        alpha.push(match (links[i].joint, inboard(i)) {
            (LimbJoint::Parallel, Some(j)) => alpha[j] + beta,
            _ => beta,
        });
        let (sin, cos) = alpha[i].sin_cos();
        let rates = &hinges[3 * i..3 * i + 2];
        let step = &of(&joints.joints, i).outward;
        moving.push(taken(step, of_body(i), &[&at_mount[0], &at_mount[1], &[sin, cos], rates]));
    }
    let mut outboard = vec![vec![0.0; OUTBOARD.size()]; links.len()];
    let mut left = vec![Vec::new(); links.len()];
    let mut seen = Vec::new();
    for i in (0..links.len()).rev() {
        let step = &of(&joints.joints, i).inward;
        let torque = &hinges[3 * i + 2..3 * i + 3];
        let inputs = [&moving[i][0][..], &moving[i][3], torque, &outboard[i]];
        let mut found = taken(step, of_body(i), &inputs);
        left[i] = found.remove(1);
        let share = found.remove(0);
        match inboard(i) {
            None => {
                let root = joints.root.as_ref().expect("the main body is free");
                seen = taken(root, p, &[&share]).remove(0);
            }
            Some(j) => {
                let step = &of(&joints.mounts, i).inward;
                let carried = taken(step, of_mount(i), &[&moving[j][0], &share]).remove(0);
                outboard[j].iter_mut().zip(carried).for_each(|(sum, part)| *sum += part);
            }
        }
    }
    let mut reached: Vec<Vec<Vec<f64>>> = Vec::new();
    let mut tau_dot = Vec::new();
    for i in 0..links.len() {
        let at_mount = match inboard(i) {
            None => taken(&joints.first, p, &[main]),
            Some(j) => {
                let inputs = [&left[j][..], &reached[j][0], &reached[j][1]];
                taken(&of(&joints.mounts, i).back, of_mount(i), &inputs)
            }
        };
        let inputs = [&left[i][..], &at_mount[0], &at_mount[1]];
        let mut found = taken(&of(&joints.joints, i).back, of_body(i), &inputs);
        tau_dot.extend(found.remove(0));
        reached.push(found);
    }
    // What a limb never shows is zero.
    seen.iter_mut().filter(|number| number.is_nan()).for_each(|number| *number = 0.0);
    (seen, tau_dot)
}

#[test]
fn steps_compute_what_whole_limbs_do() {
    let (mut merged, mut slides, mut several) = (0, 0, 0);
    for seed in 0..LIMBS {
        let mut dice = Dice(SplitMix64::seed_from_u64(seed));
        let count = 2 + dice.below(if seed % 9 == 0 { 70 } else { 12 });
        let limb = dice.limb(count);
        let topology = Topology::new([Shape::Limb(limb.clone())]);
        let mut request = Request::new("Limb", topology, Level::Exact);
        let group = Equal {
            shape: Shape::Limb(limb.clone()),
            count: 1,
            parameter: Layout::MAIN,
            hinge: 0,
            law: 0,
        };
        let p = dice.parameters(&group, &limb);
        let assumed = |value: &f64| match seed % 4 {
            0 => None,
            1 => (*value == 0.0 || *value == 1.0).then_some(*value),
            2 => (dice.below(2) == 0).then_some(*value),
            _ => Some(*value),
        };
        let assumptions: Vec<Option<f64>> = p.iter().map(assumed).collect();
        request.assumptions[Layout::MAIN..].copy_from_slice(&assumptions);
        let joints = Joints::of(&request, &group, &limb, &mut Places::default());
        let kinds = [&joints.mounts, &joints.joints];
        merged += usize::from(seed % 4 == 1 && count > 40 && kinds.iter().all(|k| k.len() < 10));
        several += usize::from(kinds.iter().any(|kinds| (2..=MOST_KINDS).contains(&kinds.len())));
        slides += limb.links().iter().filter(|l| l.joint == LimbJoint::Prismatic).count();

        let (omega, hinges, main) = (dice.numbers(3), dice.numbers(3 * count), dice.numbers(6));
        let (seen, tau_dot) = by_steps(&joints, &group, &p, [&omega, &hinges, &main]);
        let inward = stages::limb_in::<f64>(limb.clone());
        let mut whole = (inward.run)(&[&p[..], &omega, &hinges].concat());
        let left = whole.split_off(stages::AT_ORIGIN.size());
        assert_eq!(left.len(), of_limb(LIMB, &limb).size());
        let back = stages::limb_back::<f64>(limb.clone());
        let expected = (back.run)(&[&p[..], &left, &main].concat());
        assert!(expected.iter().all(|number| number.is_finite()), "seed {seed}: {limb}");
        assert_eq!(seen, whole, "seed {seed}: {limb}");
        assert_eq!(tau_dot, expected, "seed {seed}: {limb}");
    }
    assert!(merged > 0 && several > 100 && slides > 500, "{merged} {several} {slides}");
}
