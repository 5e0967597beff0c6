//! A limb in two straight lines, inward and back, and the choice between this and other ways to take it.

use nboom_formulation::stages::{self, LIMB};
use nboom_model::Limb;

use crate::request::Request;
use crate::trace::rolled::trunk::TrunkLines;
use crate::trace::rolled::{Equal, Joints, Placed, Places, Steps, as_asked, law};
use crate::trace::stage::Masks;
use crate::trace::{OPERATION_LIMIT, STRAIGHT_LINKS, Traced};

/// The steps of a limb as a whole, in the order in which their constants stand.
pub(crate) struct LimbSteps {
    pub limb: Limb,
    /// The torque about a hinge, of a right side.
    pub law: Option<Placed>,
    pub inward: Placed,
    pub back: Placed,
}

/// The steps of a limb. What its lines take adds to the operations `in_lines`: where that is too much, and where
/// it has too many links, it goes joint by joint.
pub(crate) fn steps(
    request: &Request,
    group: &Equal,
    limb: &Limb,
    in_lines: &mut usize,
    places: &mut Places,
) -> Steps {
    let room = OPERATION_LIMIT - *in_lines;
    if let Some(lines) = TrunkLines::of(request, group, limb).filter(|of| of.operations() <= room) {
        *in_lines += lines.operations();
        return Steps::Trunk(Box::new(lines.placed(request, group, places)));
    }
    if let Some(lines) = Lines::of(request, group, limb).filter(|of| of.operations() <= room) {
        *in_lines += lines.operations();
        return Steps::Limb(Box::new(lines.placed(request, group, places)));
    }
    Steps::Joints(Box::new(Joints::of(request, group, limb, places)))
}

/// Both lines of a limb, traced.
struct Lines {
    limb: Limb,
    inward: Traced,
    back: Traced,
}

impl Lines {
    /// `None` of a limb of so many links that none is tried.
    pub fn of(request: &Request, group: &Equal, limb: &Limb) -> Option<Self> {
        if limb.links().len() > STRAIGHT_LINKS {
            return None;
        }
        let prefix = group.prefix();
        let whole = group.assumptions(request, 0, group.parameters(), 1);
        let limb_in = as_asked(stages::limb_in(limb.clone()), request);
        let inward = Traced::new(&prefix, &limb_in, &whole, &Masks::new());
        let left = stages::of_limb(LIMB, limb);
        let masks = Masks::from([(LIMB.name, inward.live(left).to_vec())]);
        let back = Traced::new(&prefix, &stages::limb_back(limb.clone()), &whole, &masks);
        let [inward, back] = [inward, back].map(|step| step.regrouped(request.level));
        Some(Self { limb: limb.clone(), inward, back })
    }

    /// Operations of both lines.
    pub fn operations(&self) -> usize {
        [&self.inward, &self.back].map(|step| step.split.evaluation().flops()).iter().sum()
    }

    /// The steps, with places for their constants.
    pub fn placed(self, request: &Request, group: &Equal, places: &mut Places) -> LimbSteps {
        let Self { limb, inward, back } = self;
        LimbSteps {
            limb,
            law: law(request, group, places),
            inward: places.place(inward, group.count),
            back: places.place(back, group.count),
        }
    }
}
