//! A limb in two straight lines, inward and back.

use nboom_formulation::stages::{self, LIMB};
use nboom_model::Limb;

use crate::request::Request;
use crate::trace::rolled::{Equal, Placed, Places, as_asked, law};
use crate::trace::stage::Masks;
use crate::trace::{STRAIGHT_LINKS, Traced};

/// The steps of a limb as a whole, in the order in which their constants stand.
pub(crate) struct LimbSteps {
    pub limb: Limb,
    /// The torque about a hinge, of a right side.
    pub law: Option<Placed>,
    pub inward: Placed,
    pub back: Placed,
}

/// Both lines of a limb, traced.
pub(super) struct Lines {
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
