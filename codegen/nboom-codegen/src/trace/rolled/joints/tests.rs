//! Steps as they are emitted, interpreted joint by joint, against whole limbs on `f64`: bit for bit. What a step
//! does not hand on is NaN for those that follow.

use nboom_formulation::stages::{LIMB, of_limb};
use nboom_model::LimbJoint;

use super::*;
use crate::trace::rolled::interpreted::{Dice, asked, taken};

const LIMBS: u64 = 400;

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
            None => taken(&joints.start.traced, p, &[omega]),
            Some(j) => {
                let inboard = &moving[j];
                taken(
                    &of(&joints.mounts, i).outward.traced,
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
        let step = &of(&joints.joints, i).outward.traced;
        moving.push(taken(step, of_body(i), &[&at_mount[0], &at_mount[1], &[sin, cos], rates]));
    }
    let mut outboard = vec![vec![0.0; OUTBOARD.size()]; links.len()];
    let mut left = vec![Vec::new(); links.len()];
    let mut seen = Vec::new();
    for i in (0..links.len()).rev() {
        let step = &of(&joints.joints, i).inward.traced;
        let torque = &hinges[3 * i + 2..3 * i + 3];
        let inputs = [&moving[i][0][..], &moving[i][3], torque, &outboard[i]];
        let mut found = taken(step, of_body(i), &inputs);
        left[i] = found.remove(1);
        let share = found.remove(0);
        match inboard(i) {
            None => {
                let root = joints.root.as_ref().expect("the main body is free");
                seen = taken(&root.traced, p, &[&share]).remove(0);
            }
            Some(j) => {
                let step = &of(&joints.mounts, i).inward.traced;
                let carried = taken(step, of_mount(i), &[&moving[j][0], &share]).remove(0);
                outboard[j].iter_mut().zip(carried).for_each(|(sum, part)| *sum += part);
            }
        }
    }
    let mut reached: Vec<Vec<Vec<f64>>> = Vec::new();
    let mut tau_dot = Vec::new();
    for i in 0..links.len() {
        let at_mount = match inboard(i) {
            None => taken(&joints.first.traced, p, &[main]),
            Some(j) => {
                let inputs = [&left[j][..], &reached[j][0], &reached[j][1]];
                taken(&of(&joints.mounts, i).back.traced, of_mount(i), &inputs)
            }
        };
        let inputs = [&left[i][..], &at_mount[0], &at_mount[1]];
        let mut found = taken(&of(&joints.joints, i).back.traced, of_body(i), &inputs);
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
        let mut dice = Dice::new(seed);
        let count = 2 + dice.below(if seed % 9 == 0 { 70 } else { 12 });
        let limb = dice.limb(count);
        let (request, group, p) = asked(seed, &mut dice, &limb);
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
