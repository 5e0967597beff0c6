//! The elements of a robot.

use nboom_model::Joint;
use nboom_scalar::Vec3;
use roxmltree::{Document, Node};

use super::attributes::DYNAMICS_OF_OTHERS;
use super::left_out::{Kind, LeftOut};
use super::namespace::{elements, is_macro, tag, value};
use super::reader::{Inertial, Placement, Reader};
use crate::axes::unit_vector;
use crate::diagnostic::quoted;
use crate::scene::suggest;

/// A robot as written.
pub(super) struct Robot<'d> {
    /// The byte at which it begins.
    pub at: usize,
    pub name: Option<&'d str>,
    pub links: Vec<Link<'d>>,
    pub joints: Vec<JointElement<'d>>,
    left_out: LeftOut,
}

/// A rigid body.
pub(super) struct Link<'d> {
    pub name: &'d str,
    /// The byte at which it begins.
    pub at: usize,
    /// None where it says nothing about it.
    pub inertial: Option<Inertial>,
}

impl Link<'_> {
    /// Whether it has neither mass nor inertia, said or not.
    pub fn is_nothing(&self) -> bool {
        self.inertial.as_ref().is_none_or(|inertial| inertial.body.is_nothing())
    }
}

/// What joins a link to another one.
pub(super) struct JointElement<'d> {
    pub name: &'d str,
    /// The byte at which it begins.
    pub at: usize,
    pub motion: Motion,
    pub parent: &'d str,
    pub child: &'d str,
    /// The frame of the child in that of the parent, at angle zero.
    pub placement: Placement,
    /// The joint that it mimics, and the byte at which it says so.
    pub mimics: Option<(&'d str, usize)>,
}

/// How a child moves.
#[derive(Clone, Copy, Debug)]
pub(super) enum Motion {
    /// About or along a unit vector in the child's frame, braked by so much torque or force per rate.
    Joint {
        joint: Joint,
        axis: Vec3<f64>,
        damping: f64,
        friction: f64,
    },
    Fixed,
    /// In any way.
    Floats,
}

/// Types that are read.
const TYPES: [&str; 5] = ["revolute", "continuous", "prismatic", "fixed", "floating"];

impl<'d> Robot<'d> {
    /// Reads all links and joints; those that are wrong are reported.
    pub fn read(document: &'d Document<'d>, reader: &mut Reader<'_, 'd, '_>) -> Option<Self> {
        let root = document.root_element();
        if root.tag_name().name() != "robot" {
            let found = quoted(root.tag_name().name());
            reader.error(root, "robot", &found, "the root element `robot` of URDF");
            return None;
        }
        report_macros(root, reader);
        if !reader.report.errors.is_empty() {
            // The rest is known only when xacro has run.
            return None;
        }
        reader.check_attributes(root);
        let mut robot = Self {
            at: root.range().start,
            name: value(root, "name").filter(|name| !name.trim().is_empty()),
            links: Vec::new(),
            joints: Vec::new(),
            left_out: LeftOut::default(),
        };
        for node in root.children().filter(Node::is_element) {
            if reader.report.is_full() {
                break;
            }
            match node.tag_name().name() {
                _ if !reader.is_read(node, &mut robot.left_out) => {}
                "link" => robot.read_link(node, reader),
                _ => robot.read_joint(node, reader),
            }
        }
        robot.left_out.tell(reader);
        Some(robot)
    }

    fn read_link(&mut self, node: Node<'d, 'd>, reader: &mut Reader<'_, 'd, '_>) {
        reader.check_attributes(node);
        let (name, at) = (reader.text(node, "name"), node.range().start);
        let inertial = reader.inertial(node);
        for part in node.children().filter(Node::is_element) {
            if reader.is_read(part, &mut self.left_out) {
                for part in part.children().filter(Node::is_element) {
                    reader.is_read(part, &mut self.left_out);
                }
            }
        }
        self.links.extend(name.map(|name| Link { name, at, inertial }));
    }

    fn read_joint(&mut self, node: Node<'d, 'd>, reader: &mut Reader<'_, 'd, '_>) {
        reader.check_attributes(node);
        let (name, at) = (reader.text(node, "name"), node.range().start);
        let [parent, child] = ["parent", "child"].map(|tag| {
            let end = reader.child(node, tag);
            if end.is_none() {
                reader.error(node, tag, &format!("`joint` without `{tag}`"), "one");
            }
            reader.text(end?, "link")
        });
        let placement = reader.placement(node);
        self.note_left_out(node, name.unwrap_or_default(), reader);
        let motion = motion(node, name.unwrap_or_default(), reader);
        if let (Some(name), Some(parent), Some(child), Some(motion)) = (name, parent, child, motion)
        {
            let mimic = elements(node).find(|part| part.tag_name().name() == "mimic");
            let mimics =
                mimic.and_then(|mimic| Some((value(mimic, "joint")?, mimic.range().start)));
            let joint = JointElement { name, at, motion, parent, child, placement, mimics };
            self.joints.push(joint);
        }
    }

    fn note_left_out(&mut self, node: Node<'d, 'd>, name: &str, reader: &mut Reader<'_, 'd, '_>) {
        let has_limits = matches!(value(node, "type"), Some("revolute" | "prismatic"));
        for part in node.children().filter(Node::is_element) {
            let (tag, at) = (part.tag_name().name(), part.range().start);
            match tag {
                _ if !reader.is_read(part, &mut self.left_out) => {}
                "limit" => {
                    reader.check_attributes(part);
                    reader.check_numbers(part, ["lower", "upper"]);
                    if has_limits {
                        self.left_out.of_joint(Kind::Limits, "limits", at, name);
                    }
                }
                "mimic" => {
                    reader.check_attributes(part);
                    reader.text(part, "joint");
                    reader.check_numbers(part, ["multiplier", "offset"]);
                    self.left_out.of_joint(Kind::Mimicry, "mimicry", at, name);
                }
                "dynamics" => {
                    let has = |attribute: &&str| {
                        value(part, attribute).is_some_and(|text| text.trim().parse() != Ok(0.0))
                    };
                    let (kind, of_urdf) = match value(node, "type") {
                        Some("floating") => (Kind::Drag, &["damping", "friction"][..]),
                        _ => (Kind::Dynamics, &[][..]),
                    };
                    let all = of_urdf.iter().copied().chain(DYNAMICS_OF_OTHERS);
                    let left_out: Vec<&str> = all.filter(has).collect();
                    if !left_out.is_empty() {
                        self.left_out.of_joint(kind, &left_out.join(", "), at, name);
                    }
                }
                _ => {}
            }
        }
    }
}

fn report_macros<'d>(root: Node<'d, 'd>, reader: &mut Reader<'_, 'd, '_>) {
    for node in root.descendants().filter(|node| is_macro(*node)) {
        if reader.report.is_full() {
            break;
        }
        let owner = node.parent_element().unwrap_or(root).tag_name().name();
        let found = format!("macro {}", quoted(&tag(node)));
        reader.error(node, owner, &found, "a robot without macros, as xacro writes it");
    }
}

fn motion<'d>(node: Node<'d, 'd>, name: &str, reader: &mut Reader<'_, 'd, '_>) -> Option<Motion> {
    let axis = reader.child(node, "axis");
    let components = axis.and_then(|axis| reader.numbers(axis, "xyz"));
    let dynamics = reader.child(node, "dynamics");
    let [damping, friction] = ["damping", "friction"].map(|name| {
        let number = dynamics.and_then(|dynamics| reader.numbers(dynamics, name));
        number.map_or(0.0, |[number]| number)
    });
    match reader.text(node, "type")? {
        kind @ ("revolute" | "continuous" | "prismatic") => {
            if let Some(axis) = axis {
                reader.text(axis, "xyz");
            }
            let [x, y, z] = components.unwrap_or([1.0, 0.0, 0.0]);
            let Some(unit) = unit_vector(Vec3::new(x, y, z)) else {
                let at = axis.unwrap_or(node);
                reader.error(at, "axis", "a vector without direction", "a direction");
                return None;
            };
            let joint = match kind {
                "prismatic" => Joint::Prismatic,
                _ => Joint::Revolute,
            };
            Some(Motion::Joint { joint, axis: unit, damping, friction })
        }
        "fixed" => Some(Motion::Fixed),
        "floating" => Some(Motion::Floats),
        "planar" => {
            let found = format!("joint {} of type planar", quoted(name));
            reader.error(node, "type", &found, "a type with one axis, or fixed");
            None
        }
        other => {
            let found = format!("joint {} of type {}", quoted(name), quoted(other));
            let meant = suggest::nearest(other, TYPES.into_iter()).map(suggest::question);
            let meant = meant.map_or_else(String::new, |meant| format!("; {meant}"));
            let expected = format!("revolute, continuous, prismatic or fixed{meant}");
            reader.error(node, "type", &found, &expected);
            None
        }
    }
}
