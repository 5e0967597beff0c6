//! A limb whose trunk is taken alone, and its equal parts side by side: straight lines of the trunk, outward, inward
//! and back, and of each kind of parts, inward and back.

#[cfg(test)]
mod tests;

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

/// The steps of equal parts, in the order in which their constants stand, and where the numbers that they exchange
/// with the trunk stand among those of all carriers.
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
pub(crate) struct Among {
    pub places: Vec<usize>,
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
        let of_carrier = |parts: &EqualParts, group: Group, all: &[bool]| {
            let start = trunk.carrier(parts) * group.size();
            (group.name, all[start..start + group.size()].to_vec())
        };
        let mut shown = vec![false; trunk.of_carriers(OUTBOARD).size()];
        let inward_of = |(n, parts): (usize, &EqualParts)| {
            let equal = equal(request, group, parts, n);
            let masks = Masks::from([of_carrier(parts, CARRIER, carriers)]);
            let standing = trunk.standing_of_carrier(parts);
            let stage = stages::part_inward(parts.part.clone(), standing);
            let inward = of_part(request, &equal, &stage, &masks);
            let of_carrier = shown[trunk.carrier(parts) * OUTBOARD.size()..].iter_mut();
            of_carrier.zip(inward.live(OUTBOARD)).for_each(|(any, live)| *any |= live);
            (equal, inward)
        };
        let parts: Vec<(Equal, Traced)> = trunk.parts().iter().enumerate().map(inward_of).collect();
        let kept = outward.live(trunk.of_links(KEPT)).to_vec();
        let masks = Masks::from([(KEPT.name, kept), (OUTBOARD.name, shown)]);
        let trunk_inward = as_asked(stages::trunk_inward(trunk.clone()), request);
        let inward = of_trunk(&trunk_inward, &masks);
        let masks = Masks::from([(LIMB.name, inward.live(trunk.of_links(LIMB)).to_vec())]);
        let back = of_trunk(&stages::trunk_back(trunk.clone()), &masks);
        let rates = back.live(trunk.of_carriers(CARRIER_RATES));
        let back_of = |(parts, (equal, inward)): (&EqualParts, (Equal, Traced))| {
            let masks = Masks::from([
                of_carrier(parts, CARRIER, carriers),
                of_carrier(parts, CARRIER_RATES, rates),
                (LIMB.name, inward.live(of_limb(LIMB, &parts.part)).to_vec()),
            ]);
            let standing = trunk.standing_of_carrier(parts);
            let stage = stages::part_back(parts.part.clone(), standing);
            let back = of_part(request, &equal, &stage, &masks);
            (equal, [inward, back])
        };
        let parts = trunk.parts().iter().zip(parts).map(back_of).collect();
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
        let all_carriers = outward.mask(trunk.of_carriers(CARRIER)).to_vec();
        let all_shown = inward.mask(trunk.of_carriers(OUTBOARD)).to_vec();
        let all_rates = back.mask(trunk.of_carriers(CARRIER_RATES)).to_vec();
        let law = law_of_trunk(request, group, &trunk, places);
        let [outward, inward, back] = [outward, inward, back].map(|line| places.place(line, 1));
        let parts = trunk.parts().iter().zip(parts).map(|(parts, (equal, lines))| {
            let law = self::law(request, &equal, places);
            let [inward, back] = lines.map(|line| places.place(line, equal.count));
            let at = trunk.carrier(parts);
            let steps = PartSteps {
                part: parts.part.clone(),
                limb: group.prefix(),
                law,
                carrier: Among::new(&all_carriers, at, inward.traced.mask(CARRIER)),
                shown: Among::new(&all_shown, at, inward.traced.live(OUTBOARD)),
                carried_at: Among::new(&all_rates, at, back.traced.mask(CARRIER_RATES)),
                inward,
                back,
            };
            (equal, Steps::Part(Box::new(steps)))
        });
        let parts = parts.collect();
        TrunkSteps { trunk, law, outward, inward, back, parts }
    }
}

impl Among {
    /// Those of carrier `at` that are `live`, where `all` says which of all carriers are handed over.
    fn new(all: &[bool], at: usize, live: &[bool]) -> Self {
        let before = |place: usize| all[..place].iter().filter(|handed| **handed).count();
        let of_carrier = live.iter().enumerate().filter(|(_, live)| **live);
        let places = of_carrier.map(|(i, _)| before(at * live.len() + i)).collect();
        Self { places, all: before(all.len()) }
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
        coupling: RightSideLayout::coupling(&request.topology, hinge).start,
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
