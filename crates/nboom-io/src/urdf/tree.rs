//! From links and joints to the words of a scene.

use std::collections::BTreeMap;

use nboom_model::{
    Base, BodyDraft, Dashpot, Finding, Hinge, InitialMotion, MOST_BODIES, MassDefect,
    MassProperties, SceneDescription, SceneDraft,
};
use nboom_scalar::Quaternion;

use super::links::{JointElement, Motion, Robot};
use super::reader::{Inertial, Placement, Reader};
use crate::diagnostic::quoted;
use crate::scene::{check_body_name, folder_name, suggest};

/// When the run ends \[s\].
const END: f64 = 10.0;

/// The name of a root by which other programs know that a robot is fixed.
const WORLD: &str = "world";

/// A link, and where it is in the body that it belongs to.
struct Welded {
    link: usize,
    /// Index of the body; `None` is the main body.
    body: Option<usize>,
    placement: Placement,
}

/// Puts the links together. All that is wrong with them is reported; half of a tree is none.
pub(super) fn assemble(
    robot: &Robot<'_>,
    (name, base): (&str, Base),
    reader: &mut Reader<'_, '_, '_>,
) -> Option<SceneDraft> {
    let outboard = Outboard::find(robot, reader)?;
    let (root, start) = outboard.root(robot, reader)?;
    if robot.links[root].name == WORLD && base == Base::Free {
        let at = reader.lines.position(robot.links[root].at);
        let found = format!("{} as the root", quoted(WORLD));
        let expected = "another name: the robot floats, unless --fixed-base is given";
        reader.report.warn(at, "link", found, expected);
    }
    let mut parts = Parts { main: Part::of(root), bodies: Vec::new() };
    let mut links = vec![Welded { link: root, body: None, placement: Placement::none() }];
    while let Some(welded) = links.pop() {
        parts.add(robot, &welded);
        for &joint in &outboard.joints[welded.link] {
            links.extend(parts.carry(robot, &welded, joint, outboard.child[joint], reader));
        }
    }
    if parts.bodies.len() > MOST_BODIES {
        let found = format!("{} joints that move", parts.bodies.len());
        reader.error_at(robot.at, "robot", found, format!("at most {MOST_BODIES}"));
    }
    if !parts.bodies.is_empty() {
        parts.main.needs = (!base.is_held()).then_some(MASS_OR_GROUND);
    }
    parts.check(robot, reader);
    if !reader.report.errors.is_empty() {
        return None;
    }
    let name = folder_name(robot.name.unwrap_or(name));
    let at_rest = SceneDescription::at_rest(&name, parts.main.joined, END);
    let initial = InitialMotion {
        attitude: Quaternion::from_matrix(&start.rot),
        position_inertial: start.point,
        ..at_rest.initial
    };
    let scene = SceneDescription { base, initial, ..at_rest };
    Some(SceneDraft { scene, bodies: parts.bodies.into_iter().map(|(draft, _)| draft).collect() })
}

/// Which joints each link carries.
struct Outboard {
    joints: Vec<Vec<usize>>,
    /// The link inboard of each joint.
    parent: Vec<usize>,
    /// The link outboard of each joint.
    child: Vec<usize>,
    /// The joint that carries each link.
    carried_by: Vec<Option<usize>>,
}

impl Outboard {
    /// Reports names that two have or none, and links that two joints carry.
    fn find(robot: &Robot<'_>, reader: &mut Reader<'_, '_, '_>) -> Option<Self> {
        let are_joints_right = reader.report.errors.is_empty();
        let mut numbers = BTreeMap::new();
        for (i, link) in robot.links.iter().enumerate() {
            if let Err((found, expected)) = check_body_name(link.name) {
                reader.error_at(link.at, "link", found, expected);
            }
            if numbers.insert(link.name, i).is_some() {
                let found = format!("a second link {}", quoted(link.name));
                reader.error_at(link.at, "link", found, "names of their own");
            }
        }
        let mut joint_names = BTreeMap::new();
        for joint in &robot.joints {
            if joint_names.insert(joint.name, ()).is_some() {
                let found = format!("a second joint {}", quoted(joint.name));
                reader.error_at(joint.at, "joint", found, "names of their own");
            }
        }
        // A joint that is wrong, and told, is none of these.
        let joints = robot.joints.iter().filter(|_| are_joints_right);
        for joint in joints {
            if reader.report.is_full() {
                return None;
            }
            if let Some((name, at)) =
                joint.mimics.filter(|(name, _)| !joint_names.contains_key(name))
            {
                let found = format!("{} of joint {}", quoted(name), quoted(joint.name));
                let others = joint_names.keys().copied().filter(|other| *other != joint.name);
                let expected = known("a joint", name, others);
                reader.error_at(at, "mimic", found, expected);
            }
        }
        let links = robot.links.len();
        let mut found = Self {
            joints: vec![Vec::new(); links],
            parent: Vec::new(),
            child: Vec::new(),
            carried_by: vec![None; links],
        };
        for (j, joint) in robot.joints.iter().enumerate() {
            if reader.report.is_full() {
                return None;
            }
            let ends = [("parent", joint.parent), ("child", joint.child)].map(|(tag, name)| {
                let number = numbers.get(name).copied();
                if number.is_none() {
                    report_unknown(tag, name, joint, robot, reader);
                }
                number
            });
            let [Some(parent), Some(child)] = ends else { continue };
            if let Some(other) = found.carried_by[child].replace(j) {
                let other = quoted(robot.joints[other].name);
                let found = format!("link {}, which joint {other} carries", quoted(joint.child));
                reader.error_at(joint.at, "child", found, "a link that no joint carries: a tree");
            }
            found.joints[parent].push(j);
            found.parent.push(parent);
            found.child.push(child);
        }
        reader.report.errors.is_empty().then_some(found)
    }

    /// The link that no joint carries; of a root without mass that carries one floating link, this one, and where
    /// its joint puts it.
    fn root(
        &self,
        robot: &Robot<'_>,
        reader: &mut Reader<'_, '_, '_>,
    ) -> Option<(usize, Placement)> {
        if robot.links.is_empty() {
            reader.error_at(robot.at, "robot", "no link", "at least one");
            return None;
        }
        let carried = |i: &usize| self.carried_by[*i].is_some();
        let mut roots = (0..robot.links.len()).filter(|i| !carried(i));
        let Some(mut root) = roots.next() else {
            self.report_circle(robot, reader);
            return None;
        };
        for other in roots {
            let carries = !self.joints[other].is_empty();
            let [first, other] = [root, other].map(|i| &robot.links[i]);
            let found = if carries {
                format!("a second root, link {}", quoted(other.name))
            } else {
                format!("link {} on no joint", quoted(other.name))
            };
            let expected = format!("joints to all links but the root, {}", quoted(first.name));
            reader.error_at(other.at, "link", found, expected);
        }
        self.report_circle(robot, reader);
        let mut placement = Placement::none();
        while let [joint] = self.joints[root][..]
            && matches!(robot.joints[joint].motion, Motion::Floats)
            && robot.links[root].is_nothing()
        {
            placement = placement.then(&robot.joints[joint].placement);
            root = self.child[joint];
        }
        reader.report.errors.is_empty().then_some((root, placement))
    }

    /// Every link is carried by one joint at most, so what the roots do not lead to hangs on a circle.
    fn report_circle(&self, robot: &Robot<'_>, reader: &mut Reader<'_, '_, '_>) {
        let mut seen = vec![false; robot.links.len()];
        let mut next: Vec<usize> =
            (0..seen.len()).filter(|&i| self.carried_by[i].is_none()).collect();
        while let Some(link) = next.pop() {
            seen[link] = true;
            next.extend(self.joints[link].iter().map(|&joint| self.child[joint]));
        }
        let Some(link) = seen.iter().position(|seen| !seen) else { return };
        if let Some(joint) = self.circle_inboard(link).into_iter().min() {
            let joint = &robot.joints[joint];
            let found = format!("joint {} in a circle of joints", quoted(joint.name));
            reader.error_at(joint.at, "joint", found, "a tree, whose root no joint carries");
        }
    }

    /// The joints of the circle on which a link hangs, or none.
    fn circle_inboard(&self, link: usize) -> Vec<usize> {
        let mut way = Vec::new();
        let mut passed = vec![false; self.carried_by.len()];
        let mut link = link;
        while let Some(joint) = self.carried_by[link] {
            if std::mem::replace(&mut passed[link], true) {
                // The way to this link, which may hang beside the circle, is no part of it.
                let start = way.iter().position(|&joint| self.child[joint] == link);
                return way.split_off(start.unwrap_or_default());
            }
            way.push(joint);
            link = self.parent[joint];
        }
        Vec::new()
    }
}

fn report_unknown(
    tag: &str,
    name: &str,
    joint: &JointElement<'_>,
    robot: &Robot<'_>,
    reader: &mut Reader<'_, '_, '_>,
) {
    let found = format!("{} of joint {}", quoted(name), quoted(joint.name));
    let expected = known("a link", name, robot.links.iter().map(|link| link.name));
    reader.error_at(joint.at, tag, found, expected);
}

/// What is expected in place of an unknown name, and which name may be meant.
fn known<'n>(what: &str, name: &str, names: impl Iterator<Item = &'n str>) -> String {
    match suggest::nearest(name, names) {
        Some(meant) => format!("{what}; {}", suggest::question(meant)),
        None => what.to_owned(),
    }
}

/// A rigid part: links that are fixed to each other, as one body in the frame of the first.
struct Part {
    first: usize,
    /// The links that say something of their mass, each in the frame of the first.
    links: Vec<(usize, Inertial)>,
    joined: MassProperties,
    /// What it should have where it has no mass; nothing if another part hangs on it, and the ground holds it if it is the
    /// root.
    needs: Option<&'static str>,
}

const MASS: &str = "a mass, of the link or of one that is fixed to it";
const MASS_OR_GROUND: &str = "a mass, of the link or of one that is fixed to it, or --fixed-base, by which the ground holds it";

impl Part {
    fn of(first: usize) -> Self {
        let joined = MassProperties::nothing();
        Self { first, links: Vec::new(), joined, needs: Some(MASS) }
    }

    fn add(&mut self, robot: &Robot<'_>, welded: &Welded) {
        let Some(inertial) = &robot.links[welded.link].inertial else { return };
        let body = welded.placement.of_body(&inertial.body);
        self.joined = self.joined.joined_with(&body);
        self.links.push((welded.link, Inertial { body, ..*inertial }));
    }

    /// Reports what no body is; a part on which another one hangs may be without mass.
    fn check(&self, robot: &Robot<'_>, reader: &mut Reader<'_, '_, '_>) {
        let mut are_right = true;
        for (link, inertial) in &self.links {
            are_right &= self.check_link(robot.links[*link].name, inertial, reader);
        }
        if !are_right {
            return;
        }
        let (name, at) = (quoted(robot.links[self.first].name), robot.links[self.first].at);
        if self.joined.is_nothing() {
            if let Some(expected) = self.needs {
                reader.error_at(at, "link", format!("link {name} without mass"), expected);
            }
        } else if let Some(defect) = self.joined.defect() {
            let Finding { found, expected } = defect.finding();
            reader.error_at(at, "inertial", format!("{found} of link {name}"), expected);
        }
    }

    /// Whether a link by itself may be of this part. Files of robots that others use have links with inertia but no
    /// mass, and such that miss the triangle inequality; where the part is a body, these are warnings.
    fn check_link(&self, name: &str, link: &Inertial, reader: &mut Reader<'_, '_, '_>) -> bool {
        let Inertial { body, mass_at, inertia_at } = link;
        let defect = match body.defect().filter(|_| !body.is_nothing()) {
            Some(massless @ MassDefect::Mass(0.0)) => {
                body.defect_apart_from_mass().or(Some(massless))
            }
            defect => defect,
        };
        let Some(defect) = defect else { return true };
        let (at, tag) = match defect {
            MassDefect::Mass(_) | MassDefect::Overflow { .. } => (mass_at, "mass"),
            _ => (inertia_at, "inertia"),
        };
        let Finding { found, expected } = defect.finding();
        let found = format!("{found} of link {}", quoted(name));
        let is_right = match defect {
            MassDefect::Mass(0.0) => self.joined.mass > 0.0,
            MassDefect::Triangle(_) => self.joined.defect().is_none(),
            _ => false,
        };
        if is_right {
            let expected = format!("{expected}: added as it is to the links that it is fixed to");
            reader.report.warn(reader.lines.position(*at), tag, found, expected);
        } else {
            reader.error_at(*at, tag, found, expected);
        }
        is_right
    }
}

/// The bodies so far.
struct Parts {
    main: Part,
    bodies: Vec<(BodyDraft, Part)>,
}

impl Parts {
    fn part(&mut self, body: Option<usize>) -> &mut Part {
        match body {
            Some(i) => &mut self.bodies[i].1,
            None => &mut self.main,
        }
    }

    fn add(&mut self, robot: &Robot<'_>, welded: &Welded) {
        self.part(welded.body).add(robot, welded);
    }

    /// The link outboard of a joint of a welded link.
    fn carry(
        &mut self,
        robot: &Robot<'_>,
        inboard: &Welded,
        joint: usize,
        child: usize,
        reader: &mut Reader<'_, '_, '_>,
    ) -> Option<Welded> {
        let joint = &robot.joints[joint];
        let placement = inboard.placement.then(&joint.placement);
        match joint.motion {
            Motion::Fixed => Some(Welded { link: child, body: inboard.body, placement }),
            Motion::Joint { joint, axis, damping, friction } => {
                let body = Some(self.bodies.len());
                if let Some(i) = inboard.body {
                    self.bodies[i].1.needs = None;
                }
                let nothing = MassProperties::nothing();
                let name = robot.links[child].name.replace(char::is_control, "\u{fffd}");
                let mut draft = BodyDraft::new(&name, nothing, placement.point, axis);
                draft.joint = joint;
                draft.mount.rot_inboard_from_hinge = placement.rot;
                draft.on = inboard.body.map(|i| self.bodies[i].0.name.clone());
                let dashpot = Dashpot { rate_linear: -damping, ..Dashpot::default() };
                draft.hinge = Hinge { dashpot, friction, ..Hinge::free() };
                self.bodies.push((draft, Part::of(child)));
                Some(Welded { link: child, body, placement: Placement::none() })
            }
            Motion::Floats => {
                let found = format!("joint {} of type floating", quoted(joint.name));
                let expected = "one only between a root without mass and the robot";
                reader.error_at(joint.at, "type", found, expected);
                None
            }
        }
    }

    /// Gives each body its mass properties; reports those that no body has.
    fn check(&mut self, robot: &Robot<'_>, reader: &mut Reader<'_, '_, '_>) {
        self.main.check(robot, reader);
        for (draft, part) in &mut self.bodies {
            part.check(robot, reader);
            draft.mass_properties = part.joined;
            draft.tip = part.joined.center_of_mass * 2.0;
        }
    }
}
