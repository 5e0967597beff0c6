//! Steps as they are emitted, interpreted part by part, against whole limbs on `f64`. What a step does not hand on is
//! NaN for those that follow.

use nboom_model::{LimbJoint, LimbLink};

use super::*;
use crate::trace::rolled::interpreted::{Dice, asked, taken};

const LIMBS: u64 = 400;

/// A limb with equal parts on one link or two of it.
fn limb(dice: &mut Dice) -> Limb {
    let count = 1 + dice.below(6);
    let mut links = dice.limb(count).links().to_vec();
    for _ in 0..1 + dice.below(2) {
        let (carrier, size) = (dice.below(count) as u16, 2 + dice.below(5));
        let part = dice.limb(size);
        for _ in 0..2 + dice.below(3) {
            let first = links.len() as u16;
            links.extend(part.links().iter().map(|link| {
                let inboard = link.inboard.map_or(carrier, |inboard| first + inboard);
                LimbLink { inboard: Some(inboard), joint: link.joint }
            }));
        }
    }
    Limb::new(&links).expect("a tree").0
}

/// What the limb shows at O, and τ̇ of its joints when the main body has these accelerations; hinges are β, τ and
/// torque.
fn by_steps(
    lines: &TrunkLines,
    group: &Equal,
    p: &[f64],
    [omega, hinges, main]: [&[f64]; 3],
) -> (Vec<f64>, Vec<f64>) {
    let TrunkLines { trunk, outward, inward, back, parts } = lines;
    let of_trunk: Vec<f64> = own_places(group, trunk).map(|at| p[at - Layout::MAIN]).collect();
    let own = |numbers: [usize; 2]| -> Vec<f64> {
        let of_link = |&i: &usize| hinges[3 * i + numbers[0]..3 * i + numbers[1]].to_vec();
        trunk.numbers().iter().flat_map(of_link).collect()
    };
    let mut found = taken(outward, &of_trunk, &[omega, &own([0, 2])]);
    let (carriers, kept) = (found.remove(1), found.remove(0));
    let of_carrier = |n: usize, group: Group| {
        let start = trunk.carrier(&trunk.parts()[n]) * group.size();
        start..start + group.size()
    };
    let mut shown = vec![0.0; trunk.of_carriers(OUTBOARD).size()];
    let mut left = vec![Vec::new(); parts.len()];
    for (n, (equal, [inward, _])) in parts.iter().enumerate().rev() {
        let carrier = &carriers[of_carrier(n, CARRIER)];
        for a in (0..equal.count).rev() {
            let (own, hinges) = of_one(equal, a, p, hinges);
            let mut found = taken(inward, own, &[carrier, hinges]);
            left[n].push(found.remove(1));
            let sums = shown[of_carrier(n, OUTBOARD)].iter_mut();
            sums.zip(found.remove(0)).filter(|(_, part)| !part.is_nan()).for_each(|(s, p)| *s += p);
        }
        left[n].reverse();
    }
    let mut found = taken(inward, &of_trunk, &[&kept, &own([2, 3]), &shown]);
    let (of_trunk_left, mut seen) = (found.remove(1), found.remove(0));
    let mut found = taken(back, &of_trunk, &[&of_trunk_left, main]);
    let (rates, of_own) = (found.remove(1), found.remove(0));
    let mut tau_dot = vec![f64::NAN; hinges.len() / 3];
    trunk.numbers().iter().zip(of_own).for_each(|(&i, found)| tau_dot[i] = found);
    for (n, (equal, [_, back])) in parts.iter().enumerate() {
        let (carrier, rates) =
            (&carriers[of_carrier(n, CARRIER)], &rates[of_carrier(n, CARRIER_RATES)]);
        let links = equal.shape.hinges();
        for a in 0..equal.count {
            let (own, _) = of_one(equal, a, p, hinges);
            let found = taken(back, own, &[carrier, &left[n][a], rates]).remove(0);
            tau_dot[equal.hinge + a * links..][..links].copy_from_slice(&found);
        }
    }
    // What a limb never shows is zero.
    seen.iter_mut().filter(|number| number.is_nan()).for_each(|number| *number = 0.0);
    (seen, tau_dot)
}

/// Parameters and hinges of one of equal parts.
fn of_one<'a>(equal: &Equal, a: usize, p: &'a [f64], hinges: &'a [f64]) -> (&'a [f64], &'a [f64]) {
    let links = equal.shape.hinges();
    let own = &p[equal.parameter - Layout::MAIN + a * equal.parameters()..][..equal.parameters()];
    (own, &hinges[3 * (equal.hinge + a * links)..][..3 * links])
}

/// Whether what hangs on each link is added up in the same order as where the limb is taken as a whole: nothing else
/// hangs behind equal parts.
fn same_order(trunk: &Trunk, limb: &Limb) -> bool {
    trunk.parts().iter().all(|parts| {
        let mut behind = parts.first..limb.links().len();
        behind.all(|i| {
            let of_parts = trunk.parts().iter().any(|parts| parts.contains(i));
            of_parts || limb.links()[i].inboard != Some(parts.carrier as u16)
        })
    })
}

#[test]
fn trunks_and_parts_compute_what_whole_limbs_do() {
    let (mut exact, mut others, mut slides) = (0, 0, 0);
    for seed in 0..LIMBS {
        let mut dice = Dice::new(seed);
        let limb = limb(&mut dice);
        let count = limb.links().len();
        let (request, group, p) = asked(seed, &mut dice, &limb);
        let Some(lines) = TrunkLines::of(&request, &group, &limb) else {
            // All that is equal begins about an axis parallel to its carrier's.
            continue;
        };
        slides += limb.links().iter().filter(|l| l.joint == LimbJoint::Prismatic).count();

        let (omega, hinges, main) = (dice.numbers(3), dice.numbers(3 * count), dice.numbers(6));
        let (seen, tau_dot) = by_steps(&lines, &group, &p, [&omega, &hinges, &main]);
        let inward = stages::limb_in::<f64>(limb.clone());
        let mut whole = (inward.run)(&[&p[..], &omega, &hinges].concat());
        let left = whole.split_off(stages::AT_ORIGIN.size());
        let back = stages::limb_back::<f64>(limb.clone());
        let expected = (back.run)(&[&p[..], &left, &main].concat());
        assert!(expected.iter().all(|number| number.is_finite()), "seed {seed}: {limb}");
        if same_order(&lines.trunk, &limb) {
            exact += 1;
            assert_eq!(seen, whole, "seed {seed}: {limb}");
            assert_eq!(tau_dot, expected, "seed {seed}: {limb}");
        } else {
            others += 1;
            near(&seen, &whole);
            near(&tau_dot, &expected);
        }
    }
    assert!(exact > 100 && others > 50 && slides > 500, "{exact} {others} {slides}");
}

/// Equal but for the order of sums.
fn near(found: &[f64], expected: &[f64]) {
    let scale = expected.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-11 * scale, "{found} {expected}");
    }
}
