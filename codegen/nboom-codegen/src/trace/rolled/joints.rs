//! The steps of a limb joint by joint: recorded once for each kind of joint and of mount.

#[cfg(test)]
mod tests;

use nboom_expr::Expr;
use nboom_formulation::Layout;
use nboom_formulation::stages::{
    self, BIAS, HINGE_RATES, JOINT, Mounting, OUTBOARD, REACHED, SHARE, STANCE, Stage, Standing,
    TURNING, W,
};
use nboom_model::Limb;

use crate::request::Request;
use crate::trace::Traced;
use crate::trace::rolled::{Equal, Placed, Places, law, settled};
use crate::trace::stage::Masks;

/// The steps of a limb joint by joint, in the order in which their constants stand.
pub(crate) struct Joints {
    pub limb: Limb,
    /// The torque about a joint, of a right side.
    pub law: Option<Placed>,
    /// From the main body to the first mount.
    pub start: Placed,
    /// From the first mount to the main body; none where nothing asks what is seen at O.
    pub root: Option<Placed>,
    /// From the accelerations of the main body to those of the first mount.
    pub first: Placed,
    /// Those of mounts on links.
    pub mounts: Vec<Kind>,
    pub joints: Vec<Kind>,
}

/// The steps of all joints, or of all mounts, of one kind.
pub(crate) struct Kind {
    /// The links on these joints.
    pub links: Vec<usize>,
    pub outward: Placed,
    pub inward: Placed,
    pub back: Placed,
}

impl Kind {
    /// How many parameters the steps of each read.
    pub fn parameters(&self) -> usize {
        self.outward.traced.split.parameters
    }
}

/// Kinds beyond which joints, or mounts, are not told apart by what is assumed of them: with so many of either,
/// the steps are about as long as the longest straight line.
const MOST_KINDS: usize = 24;

impl Joints {
    pub fn of(request: &Request, group: &Equal, limb: &Limb, places: &mut Places) -> Self {
        let links = limb.links();
        let mounts: Vec<Alike<Mounting>> = alike((1..links.len()).filter_map(|i| {
            let assumed = group.assumptions(request, group.link(i), Layout::mount(limb, i), 1);
            Some((i, Mounting::of(links, i)?, assumed))
        }));
        let joints: Vec<Alike<Standing>> = alike((0..links.len()).map(|i| {
            let body = group.link(i) + Layout::mount(limb, i);
            let assumed = group.assumptions(request, body, Layout::BODY, 1);
            (i, Standing::of(links, i), assumed)
        }));
        let prefix = group.prefix();
        let branch = group.assumptions(request, 0, Layout::BRANCH, 1);
        // The step of the main body, then those of mounts, then those of joints.
        let all = |of_main: Stage<Expr>,
                   of_mount: &dyn Fn(Mounting) -> Stage<Expr>,
                   of_joint: &dyn Fn(Standing) -> Stage<Expr>,
                   masks: &Masks| {
            let mut all = vec![Traced::new(&prefix, &of_main, &branch, masks)];
            all.extend(mounts.iter().enumerate().map(|(n, alike)| {
                alike.traced(&format!("{prefix}_mount{}", n + 1), &of_mount(alike.kind), masks)
            }));
            all.extend(joints.iter().enumerate().map(|(n, alike)| {
                alike.traced(&format!("{prefix}_joint{}", n + 1), &of_joint(alike.kind), masks)
            }));
            // Each joint waits for the one before.
            all.into_iter().map(|step| step.regrouped(request.level)).collect()
        };
        let mut masks: Masks =
            [STANCE, W, REACHED, BIAS, OUTBOARD, SHARE, JOINT, TURNING, HINGE_RATES]
                .map(|group| (group.name, vec![false; group.size()]))
                .into();
        let outward = settled(&mut masks, |masks| {
            all(stages::start(), &stages::mount_outward, &stages::joint_outward, masks)
        });
        let inward = settled(&mut masks, |masks| {
            all(stages::limb_root(), &stages::mount_inward, &stages::joint_inward, masks)
        });
        let back = settled(&mut masks, |masks| {
            all(stages::first(), &stages::mount_back, &stages::joint_back, masks)
        });
        let law = law(request, group, places);
        let mut sweeps = [outward, inward, back].map(Vec::into_iter);
        let mut next = || {
            let next = |sweep: &mut std::vec::IntoIter<Traced>| sweep.next();
            let steps = sweeps.each_mut().map(next);
            steps.map(|step| step.expect("one of the main body and of each kind"))
        };
        let [start, root, first] = next();
        let shows = !request.holds_main_body();
        let start = places.place(start, group.count);
        let root = shows.then(|| places.place(root, group.count));
        let first = places.place(first, group.count);
        let mut kind = |links: &[usize]| {
            let placed = |step| places.place(step, links.len() * group.count);
            let [outward, inward, back] = next().map(placed);
            Kind { links: links.to_vec(), outward, inward, back }
        };
        let mounts = mounts.iter().map(|alike| kind(&alike.links)).collect();
        let joints = joints.iter().map(|alike| kind(&alike.links)).collect();
        Self { limb: limb.clone(), law, start, root, first, mounts, joints }
    }

    /// All steps but that of the torque.
    pub fn all(&self) -> impl Iterator<Item = &Placed> {
        let kinds = self.mounts.iter().chain(&self.joints);
        let of_kinds = kinds.flat_map(|kind| [&kind.outward, &kind.inward, &kind.back]);
        [&self.start].into_iter().chain(&self.root).chain([&self.first]).chain(of_kinds)
    }

    /// How many numbers each joint shows its inboard link.
    pub fn shown(&self) -> usize {
        self.mounts.first().map_or(0, |kind| kind.inward.traced.size(OUTBOARD))
    }
}

/// Joints, or mounts, that take the same steps.
struct Alike<K> {
    kind: K,
    /// The links on them.
    links: Vec<usize>,
    /// What is assumed of all of them.
    assumed: Vec<Option<f64>>,
}

impl<K> Alike<K> {
    /// A step, traced; steps that read no parameters assume none.
    fn traced(&self, prefix: &str, stage: &Stage<Expr>, masks: &Masks) -> Traced {
        let assumed = if stage.parameters.is_empty() { &[] } else { &self.assumed[..] };
        Traced::new(prefix, stage, assumed, masks)
    }
}

/// Links with the kinds of their joints and what is assumed of these, put together where both are alike: of
/// assumptions zeros and ones have to be, for they save operations.
fn alike<K: PartialEq>(links: impl Iterator<Item = (usize, K, Vec<Option<f64>>)>) -> Vec<Alike<K>> {
    let all: Vec<Alike<K>> =
        links.map(|(i, kind, assumed)| Alike { kind, links: vec![i], assumed }).collect();
    let fine = merged(all, |a, b| a.kind == b.kind && simple(&a.assumed).eq(simple(&b.assumed)));
    if fine.len() <= MOST_KINDS { fine } else { merged(fine, |a, b| a.kind == b.kind) }
}

fn merged<K>(all: Vec<Alike<K>>, same: impl Fn(&Alike<K>, &Alike<K>) -> bool) -> Vec<Alike<K>> {
    let mut merged: Vec<Alike<K>> = Vec::new();
    for next in all {
        let Some(like) = merged.iter_mut().find(|like| same(like, &next)) else {
            merged.push(next);
            continue;
        };
        like.links.extend(next.links);
        for (common, other) in like.assumed.iter_mut().zip(next.assumed) {
            *common = common.filter(|value| other == Some(*value));
        }
    }
    merged
}

/// Zeros and ones, each with its sign, of what is assumed.
fn simple(assumed: &[Option<f64>]) -> impl Iterator<Item = Option<f64>> {
    assumed.iter().map(|value| value.filter(|value| *value == 0.0 || value.abs() == 1.0))
}
