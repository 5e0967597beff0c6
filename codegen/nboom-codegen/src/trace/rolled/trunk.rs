//! A limb whose trunk is taken alone, and its equal parts side by side: straight lines of the trunk, outward, inward
//! and back, and of each kind of parts, inward and back.

#[cfg(test)]
mod tests;

use std::ops::Range;

use nboom_expr::Expr;
use nboom_formulation::stages::{
    self, CARRIER, CARRIER_RATES, Group, KEPT, LIMB, OUTBOARD, Stage, Trunk, of_limb,
};
use nboom_formulation::{Layout, RightSideLayout};
use nboom_model::{EqualParts, Limb, Shape};

use crate::request::{Output, Request};
use crate::trace::rolled::{Equal, Placed, Places, Steps, as_asked, law, traced_law};
use crate::trace::stage::Masks;
use crate::trace::{STRAIGHT_LINKS, Traced};

/// The steps of a limb, in the order in which their constants stand.
pub(crate) struct TrunkSteps {
    pub trunk: Trunk,
    /// The torque about a joint of the trunk, of a right side.
    pub law: Option<Placed>,
    pub outward: Placed,
    pub inward: Placed,
    pub back: Placed,
    /// Equal parts, and their steps.
    pub parts: Vec<(Equal, Steps)>,
}

/// The steps of equal parts, in the order in which their constants stand, and where what they exchange with the
/// trunk stands among what all parts do.
pub(crate) struct PartSteps {
    pub part: Limb,
    /// What names of functions of the limb begin with.
    pub limb: String,
    /// The torque about a joint, of a right side.
    pub law: Option<Placed>,
    pub inward: Placed,
    pub back: Placed,
    /// How their carrier stands and moves.
    pub carrier: Among,
    /// What they show at its origin.
    pub shown: Among,
    /// Its accelerations.
    pub carried_at: Among,
}

/// Where the numbers of one carrier stand among those of all.
#[derive(Default)]
pub(crate) struct Among {
    pub places: Range<usize>,
    pub all: usize,
}

/// The lines of a limb, traced.
pub(super) struct TrunkLines {
    trunk: Trunk,
    outward: Traced,
    inward: Traced,
    back: Traced,
    /// Inward and back.
    parts: Vec<(Equal, [Traced; 2])>,
}

impl TrunkLines {
    /// `None` of a limb without equal parts, of one that has equals itself, and of so many links that no lines are
    /// tried.
    pub fn of(request: &Request, group: &Equal, limb: &Limb) -> Option<Self> {
        let trunk = Trunk::of(limb).filter(|_| group.count == 1)?;
        let parts = trunk.parts().iter();
        let links = trunk.numbers().len() + parts.map(|of| of.part.links().len()).sum::<usize>();
        if links > STRAIGHT_LINKS {
            return None;
        }
        let assumed = own_places(group, &trunk).map(|at| request.assumptions[at]);
        let assumed: Vec<Option<f64>> = assumed.collect();
        let prefix = group.prefix();
        let of_trunk = |stage: &Stage<Expr>, masks: &Masks| {
            Traced::new(&prefix, stage, &assumed, masks).regrouped(request.level)
        };
        let outward = of_trunk(&stages::trunk_outward(trunk.clone()), &Masks::new());
        let carriers = outward.live(trunk.of_carriers(CARRIER));
        let parts = trunk.parts().iter().enumerate().map(|(n, parts)| {
            let equal = equal(request, group, parts, n);
            let carrier = carriers.chunks(CARRIER.size()).nth(n).unwrap_or_default();
            let masks = Masks::from([(CARRIER.name, carrier.to_vec())]);
            let stage = stages::part_inward(parts.part.clone(), trunk.carrier(n));
            let inward = of_part(request, &equal, &stage, &masks);
            (equal, inward)
        });
        let parts: Vec<(Equal, Traced)> = parts.collect();
        let shown = parts.iter().flat_map(|(_, inward)| inward.live(OUTBOARD)).copied().collect();
        let kept = outward.live(trunk.of_links(KEPT)).to_vec();
        let masks = Masks::from([(KEPT.name, kept), (OUTBOARD.name, shown)]);
        let trunk_inward = as_asked(stages::trunk_inward(trunk.clone()), request);
        let inward = of_trunk(&trunk_inward, &masks);
        let masks = Masks::from([(LIMB.name, inward.live(trunk.of_links(LIMB)).to_vec())]);
        let back = of_trunk(&stages::trunk_back(trunk.clone()), &masks);
        let rates = back.live(trunk.of_carriers(CARRIER_RATES));
        let parts = parts.into_iter().enumerate().map(|(n, (equal, inward))| {
            let part = &trunk.parts()[n].part;
            let of_carrier = |group: Group, all: &[bool]| {
                (group.name, all.chunks(group.size()).nth(n).unwrap_or_default().to_vec())
            };
            let masks = Masks::from([
                of_carrier(CARRIER, carriers),
                of_carrier(CARRIER_RATES, rates),
                (LIMB.name, inward.live(of_limb(LIMB, part)).to_vec()),
            ]);
            let stage = stages::part_back(part.clone(), trunk.carrier(n));
            let back = of_part(request, &equal, &stage, &masks);
            (equal, [inward, back])
        });
        let parts = parts.collect();
        Some(Self { trunk, outward, inward, back, parts })
    }

    /// Operations of all lines.
    pub fn operations(&self) -> usize {
        let parts = self.parts.iter().flat_map(|(_, lines)| lines);
        let lines = [&self.outward, &self.inward, &self.back].into_iter().chain(parts);
        lines.map(|line| line.split.evaluation().flops()).sum()
    }

    /// The steps, with places for their constants.
    pub fn placed(self, request: &Request, group: &Equal, places: &mut Places) -> TrunkSteps {
        let Self { trunk, outward, inward, back, parts } = self;
        let mut places_of_carriers = [
            (&outward, trunk.of_carriers(CARRIER), CARRIER.size()),
            (&inward, trunk.of_carriers(OUTBOARD), OUTBOARD.size()),
            (&back, trunk.of_carriers(CARRIER_RATES), CARRIER_RATES.size()),
        ]
        .map(|(step, group, size)| among(step.mask(group), size).into_iter());
        let law = law_of_trunk(request, group, &trunk, places);
        let [outward, inward, back] = [outward, inward, back].map(|line| places.place(line, 1));
        let parts = trunk.parts().iter().zip(parts).map(|(parts, (equal, lines))| {
            let law = self::law(request, &equal, places);
            let [inward, back] = lines.map(|line| places.place(line, equal.count));
            let (part, limb) = (parts.part.clone(), group.prefix());
            let mut next =
                places_of_carriers.each_mut().map(|of| of.next().unwrap_or_default()).into_iter();
            let mut next = || next.next().unwrap_or_default();
            let (carrier, shown, carried_at) = (next(), next(), next());
            let steps = PartSteps { part, limb, law, inward, back, carrier, shown, carried_at };
            (equal, Steps::Part(Box::new(steps)))
        });
        let parts = parts.collect();
        TrunkSteps { trunk, law, outward, inward, back, parts }
    }
}

/// Where the parameters of the trunk stand among those of the satellite.
pub(crate) fn own_places(group: &Equal, trunk: &Trunk) -> impl Iterator<Item = usize> {
    let of_link = |&link: &usize| {
        let start = group.parameter + group.link(link);
        start..start + Layout::link(&group.shape, link)
    };
    let branch = group.parameter..group.parameter + Layout::BRANCH;
    branch.chain(trunk.numbers().iter().flat_map(of_link))
}

/// Equal parts of a limb.
fn equal(request: &Request, limb: &Equal, parts: &EqualParts, number: usize) -> Equal {
    let hinge = limb.hinge + parts.first;
    Equal {
        shape: Shape::Limb(parts.part.clone()),
        count: parts.count,
        parameter: limb.parameter + limb.link(parts.first),
        hinge,
        law: RightSideLayout::law(&request.topology, hinge).start,
        part: Some(format!("{}_part{}", limb.prefix(), number + 1)),
    }
}

fn of_part(request: &Request, equal: &Equal, stage: &Stage<Expr>, masks: &Masks) -> Traced {
    let assumed = equal.assumptions(request, 0, equal.parameters(), 1);
    Traced::new(&equal.prefix(), stage, &assumed, masks).regrouped(request.level)
}

/// The torque about a joint of the trunk, of a right side.
fn law_of_trunk(
    request: &Request,
    group: &Equal,
    trunk: &Trunk,
    places: &mut Places,
) -> Option<Placed> {
    let numbers = trunk.numbers();
    let traced = || {
        let start = |_, n: usize| group.law + numbers[n] * RightSideLayout::LAW;
        let assumed = group.common(request, start, RightSideLayout::LAW, numbers.len());
        traced_law(&group.prefix(), &assumed)
    };
    let of_right_side = (request.output == Output::RightSide).then(traced);
    of_right_side.map(|traced| places.place(traced, numbers.len()))
}

/// Where the numbers of each chunk of `size` stand among those that are handed over.
fn among(mask: &[bool], size: usize) -> Vec<Among> {
    let live = |mask: &[bool]| mask.iter().filter(|live| **live).count();
    let (mut start, all) = (0, live(mask));
    let of_chunk = |chunk: &[bool]| {
        let end = start + live(chunk);
        Among { places: std::mem::replace(&mut start, end)..end, all }
    };
    mask.chunks(size).map(of_chunk).collect()
}
