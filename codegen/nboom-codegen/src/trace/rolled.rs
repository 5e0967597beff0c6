//! Sweeps step by step: over links, and over equal appendages side by side.

mod equal;
#[cfg(test)]
mod interpreted;
mod joints;
mod limb;
mod trunk;

use nboom_expr::{Expr, Operations};
use nboom_formulation::stages::{
    self, AT_ORIGIN, ELIMINATED, EXTERNAL, Group, INBOARD_TORQUE, MAIN_RATES, OUTBOARD_SHARE,
    PADDLE, POWER, REACHED, Stage, TORQUE, TURNED,
};
use nboom_formulation::{Layout, RightSideLayout};
use nboom_model::{Limb, Shape};

use crate::request::{Output, Request};
pub(crate) use crate::trace::rolled::equal::Equal;
pub(crate) use crate::trace::rolled::joints::{Joints, Kind};
pub(crate) use crate::trace::rolled::limb::LimbSteps;
use crate::trace::rolled::limb::Lines;
use crate::trace::rolled::trunk::TrunkLines;
pub(crate) use crate::trace::rolled::trunk::{Among, PartSteps, TrunkSteps, own_places};
use crate::trace::stage::Masks;
use crate::trace::{OPERATION_LIMIT, Traced};

/// A coupling adds to the torques about two hinges.
const TORQUES_OF_COUPLING: usize = 2;

/// The steps of all sweeps of a request.
pub(crate) struct Rolled {
    /// Equal appendages, and the steps that they take.
    pub groups: Vec<(Equal, Steps)>,
    /// From what all appendages show at O to the accelerations of the main body.
    pub base: Placed,
    /// The rate of change of the attitude, of a right side.
    pub attitude: Option<Placed>,
    /// Which numbers at O any appendage shows.
    pub at_origin: Vec<bool>,
    /// How many constants are prepared.
    pub constants: usize,
}

/// The steps of an appendage.
pub(crate) enum Steps {
    Chain(Box<Chain>),
    Paddle(Box<Paddle>),
    Limb(Box<LimbSteps>),
    Joints(Box<Joints>),
    Trunk(Box<TrunkSteps>),
    Part(Box<PartSteps>),
}

/// The steps of a chain, in the order in which their constants stand.
pub(crate) struct Chain {
    /// The torque about a hinge, of a right side.
    pub law: Option<Placed>,
    /// The torques about a hinge and the one inboard of it, of a right side with couplings.
    pub coupling: Option<Placed>,
    pub start: Placed,
    pub outward: Placed,
    pub inward: Placed,
    /// None where nothing asks what is seen at O.
    pub root: Option<Placed>,
    pub first: Placed,
    pub back: Placed,
}

/// The steps of a paddle, in the order in which their constants stand.
pub(crate) struct Paddle {
    /// The torque about a hinge, of a right side.
    pub law: Option<Placed>,
    pub inward: Placed,
    pub first: Placed,
    pub back: Placed,
}

/// A traced step and where its constants stand.
pub(crate) struct Placed {
    pub traced: Traced,
    pub start: usize,
    /// How often it is taken in an evaluation.
    pub times: usize,
}

impl Steps {
    fn all(&self) -> Vec<&Placed> {
        match self {
            Self::Chain(of) => {
                let inward = [&of.start, &of.outward, &of.inward];
                of.law
                    .iter()
                    .chain(&of.coupling)
                    .chain(inward)
                    .chain(&of.root)
                    .chain([&of.first, &of.back])
                    .collect()
            }
            Self::Paddle(of) => of.law.iter().chain([&of.inward, &of.first, &of.back]).collect(),
            Self::Limb(of) => of.law.iter().chain([&of.inward, &of.back]).collect(),
            Self::Joints(of) => of.law.iter().chain(of.all()).collect(),
            Self::Trunk(of) => {
                let parts = of.parts.iter().flat_map(|(_, steps)| steps.all());
                let own = [&of.outward, &of.inward, &of.back];
                of.law.iter().chain(own).chain(parts).collect()
            }
            Self::Part(of) => of.law.iter().chain([&of.inward, &of.back]).collect(),
        }
    }

    /// The torque about a hinge, of a right side; that of trunks, whose hinges do not follow each other, is theirs.
    pub fn law(&self) -> Option<&Placed> {
        match self {
            Self::Chain(of) => of.law.as_ref(),
            Self::Paddle(of) => of.law.as_ref(),
            Self::Limb(of) => of.law.as_ref(),
            Self::Joints(of) => of.law.as_ref(),
            Self::Trunk(_) => None,
            Self::Part(of) => of.law.as_ref(),
        }
    }

    /// The step that tells what an appendage shows at O, if one does.
    pub fn shows(&self) -> Option<&Placed> {
        let step = match self {
            Self::Chain(of) => of.root.as_ref(),
            Self::Paddle(of) => Some(&of.inward),
            Self::Limb(of) => Some(&of.inward),
            Self::Joints(of) => of.root.as_ref(),
            Self::Trunk(of) => Some(&of.inward),
            Self::Part(_) => None,
        };
        step.filter(|step| step.traced.writes(AT_ORIGIN))
    }
}

impl Rolled {
    /// Traces the steps of a request by `articulated`.
    pub fn of(request: &Request) -> Self {
        let mut places = Places::default();
        let mut groups = Vec::new();
        let mut at_origin = vec![false; AT_ORIGIN.size()];
        let (mut parameter, mut hinge, mut in_lines) = (Layout::MAIN, 0, 0);
        for (shape, count) in request.topology.groups() {
            let links = shape.hinges();
            let law = RightSideLayout::law(&request.topology, hinge).start;
            let coupling = RightSideLayout::coupling(&request.topology, hinge).start;
            let group = Equal { shape, count, parameter, hinge, law, coupling, part: None };
            let steps = match &group.shape {
                Shape::Chain(_) => {
                    Steps::Chain(Box::new(chain(request, &group, links, &mut places)))
                }
                Shape::Paddle => Steps::Paddle(Box::new(paddle(request, &group, &mut places))),
                Shape::Limb(of) => limb(request, &group, of, &mut in_lines, &mut places),
            };
            if let Some(shows) = steps.shows() {
                let live = shows.traced.live(AT_ORIGIN);
                at_origin.iter_mut().zip(live).for_each(|(any, live)| *any |= live);
            }
            parameter += count * group.parameters();
            hinge += count * links;
            groups.push((group, steps));
        }
        let base = places.place(base(request, &at_origin), 1);
        let attitude = (request.output == Output::RightSide)
            .then(|| Traced::new("main", &stages::attitude(), &[], &Masks::new()))
            .map(|traced| places.place(traced, 1));
        Self { groups, base, attitude, at_origin, constants: places.constants }
    }

    /// All steps in the order in which their constants stand.
    pub fn steps(&self) -> Vec<&Placed> {
        let of_groups = self.groups.iter().flat_map(|(_, steps)| steps.all());
        of_groups.chain([&self.base]).chain(&self.attitude).collect()
    }

    /// Operations of an evaluation.
    pub fn evaluation(&self) -> Operations {
        let mut operations = self.sum(|traced| traced.split.evaluation());
        // Sines of absolute angles are taken, and what joints show their inboard links and torques of couplings are
        // added up, between steps.
        for (group, steps) in &self.groups {
            match steps {
                Steps::Chain(chain) => {
                    operations.angles += chain.outward.times;
                    let coupled = chain.coupling.iter().map(|coupling| coupling.times);
                    operations.additions += TORQUES_OF_COUPLING * coupled.sum::<usize>();
                }
                Steps::Joints(joints) => {
                    operations.angles += group.count * group.shape.hinges();
                    let shown = joints.mounts.iter().map(|kind| kind.inward.times * joints.shown());
                    operations.additions += shown.sum::<usize>();
                }
                Steps::Trunk(trunk) => {
                    for (equal, part) in &trunk.parts {
                        let Steps::Part(part) = part else { continue };
                        operations.additions += equal.count * part.shown.places.len();
                    }
                }
                Steps::Paddle(_) | Steps::Limb(_) | Steps::Part(_) => {}
            }
        }
        operations
    }

    /// Operations of a preparation.
    pub fn preparation(&self) -> Operations {
        self.sum(|traced| traced.split.preparation())
    }

    /// Operations of the steps of all joints and mounts, each step once.
    pub fn joint_operations(&self) -> usize {
        let steps = self.groups.iter().filter_map(|(_, steps)| match steps {
            Steps::Joints(joints) => Some(joints.all()),
            _ => None,
        });
        steps.flatten().map(|step| step.traced.split.evaluation().flops()).sum()
    }

    fn sum(&self, of: impl Fn(&Traced) -> Operations) -> Operations {
        let steps = self.steps().into_iter();
        let all = steps.flat_map(|step| std::iter::repeat_n(of(&step.traced), step.times));
        all.fold(Operations::default(), |sum, operations| sum + operations)
    }
}

/// Where the constants of the next step stand.
#[derive(Default)]
pub(crate) struct Places {
    constants: usize,
}

impl Places {
    fn place(&mut self, traced: Traced, times: usize) -> Placed {
        let start = self.constants;
        self.constants += traced.constants() * times;
        Placed { traced, start, times }
    }
}

/// The step of the main body, with what any appendage shows at O.
fn base(request: &Request, at_origin: &[bool]) -> Traced {
    let masks = Masks::from([
        (AT_ORIGIN.name, at_origin.to_vec()),
        (EXTERNAL.name, vec![request.external; EXTERNAL.size()]),
    ]);
    let mut assumptions = request.assumptions[..Layout::MAIN].to_vec();
    let in_mode = request.output == Output::RightSide;
    if in_mode {
        let external = RightSideLayout::external(&request.topology);
        let spin = RightSideLayout::spin(&request.topology);
        assumptions.extend(&request.assumptions[external.start..spin.end]);
    }
    let stage = match (request.holds_main_body(), in_mode) {
        (true, true) => stages::held_base_in_mode(),
        (true, false) => stages::held_base(),
        (false, true) => stages::base_in_mode(),
        (false, false) => stages::base(),
    };
    let traced = Traced::new("main", &stage, &assumptions, &masks);
    // Of a main body that is held and that nothing moves all of them are zero.
    traced.passing_on(MAIN_RATES, &[true; MAIN_RATES.numbers.len()]).regrouped(request.level)
}

/// The torque about a hinge of a group, of a right side.
fn law(request: &Request, group: &Equal, places: &mut Places) -> Option<Placed> {
    let traced = || traced_law(&group.prefix(), &group.of_laws(request));
    let of_right_side = (request.output == Output::RightSide).then(traced);
    of_right_side.map(|traced| places.place(traced, group.shape.hinges() * group.count))
}

/// The torques of a coupling about two hinges of a group, of a right side that may have one in it.
fn coupling(request: &Request, group: &Equal, places: &mut Places) -> Option<Placed> {
    let hinges = group.count * group.shape.hinges();
    let of_group = group.hinge..group.hinge + hinges;
    if !request.coupled().any(|hinge| of_group.contains(&hinge)) {
        return None;
    }
    let assumed = group.of_couplings(request);
    let traced = Traced::new(&group.prefix(), &stages::coupling(), &assumed, &Masks::new());
    let all = [TORQUE, INBOARD_TORQUE, POWER];
    let traced = all.into_iter().fold(traced, |traced, of| traced.passing_on(of, &[true]));
    Some(places.place(traced, hinges - group.count))
}

fn traced_law(prefix: &str, assumed: &[Option<f64>]) -> Traced {
    let law = Traced::new(prefix, &stages::law(), assumed, &Masks::new());
    law.passing_on(TORQUE, &[true]).passing_on(POWER, &[true])
}

fn chain(request: &Request, group: &Equal, links: usize, places: &mut Places) -> Chain {
    let prefix = group.prefix();
    let branch = group.assumptions(request, 0, Layout::BRANCH, 1);
    let link = group.assumptions(request, Layout::BRANCH, Layout::LINK, links);
    let trace = |stage: &Stage<Expr>, assumptions: &[Option<f64>], masks: &Masks| {
        Traced::new(&prefix, stage, assumptions, masks)
    };
    let outward = trace(&stages::outward(), &link, &Masks::new());
    let start =
        trace(&stages::start(), &branch, &Masks::new()).passing_on(REACHED, outward.live(REACHED));
    let mut masks = Masks::from([
        (TURNED.name, outward.live(TURNED).to_vec()),
        (OUTBOARD_SHARE.name, vec![false; OUTBOARD_SHARE.size()]),
    ]);
    let inward =
        settled(&mut masks, |masks| vec![trace(&stages::inward(), &link, masks)]).remove(0);
    let shows = !request.holds_main_body();
    let root = shows.then(|| trace(&stages::root(), &branch, &masks));
    let first = trace(&stages::first(), &branch, &Masks::new());
    masks.insert(ELIMINATED.name, inward.live(ELIMINATED).to_vec());
    let back = trace(&stages::back(), &[], &masks);
    let (once, each) = (group.count, links * group.count);
    Chain {
        law: law(request, group, places),
        coupling: coupling(request, group, places),
        start: places.place(start, once),
        outward: places.place(outward, each),
        inward: places.place(inward, each),
        root: root.map(|root| places.place(root, once)),
        first: places.place(first, once),
        back: places.place(back, each),
    }
}

fn paddle(request: &Request, group: &Equal, places: &mut Places) -> Paddle {
    let prefix = group.prefix();
    let whole = group.assumptions(request, 0, group.parameters(), 1);
    let branch = group.assumptions(request, 0, Layout::BRANCH, 1);
    let paddle_in = as_asked(stages::paddle_in(), request);
    let inward = Traced::new(&prefix, &paddle_in, &whole, &Masks::new());
    let first = Traced::new(&prefix, &stages::first(), &branch, &Masks::new());
    let masks = Masks::from([
        (ELIMINATED.name, inward.live(ELIMINATED).to_vec()),
        (PADDLE.name, inward.live(PADDLE).to_vec()),
    ]);
    let back = Traced::new(&prefix, &stages::paddle_back(), &[], &masks);
    Paddle {
        law: law(request, group, places),
        inward: places.place(inward, group.count),
        first: places.place(first, group.count),
        back: places.place(back, group.count),
    }
}

/// The steps of a limb. What its lines take adds to the operations `in_lines`: where that is too much, and where
/// it has too many links, it goes joint by joint.
fn limb(
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

/// A step without what it shows at O, where a main body that is held does not ask.
fn as_asked(stage: Stage<Expr>, request: &Request) -> Stage<Expr> {
    if request.holds_main_body() { stage.without(AT_ORIGIN) } else { stage }
}

/// Traces steps again and again until the numbers that can be other than zero stay the same, of all groups that
/// they write and that `masks` names to begin with.
fn settled(masks: &mut Masks, trace: impl Fn(&Masks) -> Vec<Traced>) -> Vec<Traced> {
    loop {
        let traced = trace(masks);
        let mut grown = false;
        for (group, live) in traced.iter().flat_map(|step| &step.outputs) {
            let Some(known) = masks.get_mut(group.name) else { continue };
            for (known, live) in known.iter_mut().zip(live) {
                grown |= *live && !*known;
                *known |= *live;
            }
        }
        if !grown {
            let passing_on = |step: Traced| {
                let groups: Vec<Group> = step.outputs.iter().map(|&(group, _)| group).collect();
                let known =
                    groups.iter().filter_map(|group| Some((*group, masks.get(group.name)?)));
                known.fold(step, |step, (group, known)| step.passing_on(group, known))
            };
            return traced.into_iter().map(passing_on).collect();
        }
    }
}
