//! Which attributes and parts elements have. A misspelled one would leave its default in place with no word.

use roxmltree::{Attribute, Node};

use super::left_out::LeftOut;
use super::namespace::{is_foreign, tag};
use super::reader::Reader;
use crate::diagnostic::quoted;
use crate::scene::suggest;

/// Attributes of `dynamics` by which other programs brake joints or make them springy.
pub(super) const DYNAMICS_OF_OTHERS: [&str; 4] = ["D", "K", "mu_coulomb", "mu_viscous"];

/// The attributes of an element.
struct Known {
    read: &'static [&'static str],
    /// Those of URDF or of other programs that are not read, and no slips of a key.
    besides: &'static [&'static str],
    /// Whether attributes are all that it says.
    is_leaf: bool,
}

impl Known {
    /// None of an element of which nothing depends on attributes.
    fn of(tag: &str) -> Option<Self> {
        let (read, besides): (&[&str], &[&str]) = match tag {
            "robot" => (&["name"], &["version"]),
            "link" => (&["name"], &["type"]),
            "joint" => (&["name", "type"], &["dont_collapse"]),
            "parent" | "child" => (&["link"], &[]),
            "origin" => (&["xyz", "rpy"], &[]),
            "axis" => (&["xyz"], &[]),
            "dynamics" => (&["damping", "friction"], &DYNAMICS_OF_OTHERS),
            "limit" => (
                &["lower", "upper", "effort", "velocity"],
                &["acceleration", "deceleration", "jerk"],
            ),
            "mimic" => (&["joint", "multiplier", "offset"], &[]),
            "mass" => (&["value"], &[]),
            "inertia" => (&["ixx", "ixy", "ixz", "iyy", "iyz", "izz"], &[]),
            _ => return None,
        };
        Some(Self { read, besides, is_leaf: !matches!(tag, "robot" | "link" | "joint") })
    }

    fn contains(&self, attribute: &Attribute<'_, '_>) -> bool {
        attribute.namespace().is_some()
            || self.read.contains(&attribute.name())
            || self.besides.contains(&attribute.name())
    }
}

/// Names, the last one after `and` or `or`.
fn listed(names: &[&str], last_after: &str) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match &quoted[..] {
        [others @ .., last] if !others.is_empty() => {
            format!("{} {last_after} {last}", others.join(", "))
        }
        _ => quoted.concat(),
    }
}

/// The parts of an element that are read, some of them only to be named, and those that are known not to be.
fn parts(tag: &str) -> [&'static [&'static str]; 2] {
    match tag {
        "robot" => [&["link", "joint"], &["material", "gazebo", "transmission", "sensor", "group"]],
        "link" => [&["inertial"], &["visual", "collision", "material", "sensor", "contact"]],
        "inertial" => [&["origin", "mass", "inertia"], &[]],
        "joint" => [
            &["origin", "parent", "child", "axis", "dynamics", "limit", "mimic"],
            &["calibration", "safety_controller"],
        ],
        _ => [&[], &[]],
    }
}

impl<'d> Reader<'_, 'd, '_> {
    /// Whether a part of an element is one that is read. One that seems to be meant for such a part is an error,
    /// for without it the robot is another one; what is neither is `left_out`, and so is what stands in one that says
    /// all by attributes.
    pub fn is_read(&mut self, part: Node<'d, 'd>, left_out: &mut LeftOut) -> bool {
        let (name, at) = (part.tag_name().name(), part.range().start);
        let owner = part.parent().map_or("", |owner| owner.tag_name().name());
        let [read, besides] = parts(owner);
        let is_others = is_foreign(&part);
        if read.contains(&name) && !is_others {
            if Known::of(name).is_some_and(|known| known.is_leaf) {
                let inside = part.children().filter(Node::is_element).filter(is_foreign);
                inside.for_each(|inner| left_out.element(&tag(inner), inner.range().start));
            }
            return true;
        }
        let is_known = is_others || besides.contains(&name);
        match suggest::nearest(name, read.iter().copied()).filter(|_| !is_known) {
            Some(meant) => {
                let found = format!("element {} in `{owner}`", quoted(name));
                let expected = format!("{}; {}", listed(read, "and"), suggest::question(meant));
                self.error_at(at, meant, found, expected);
            }
            None => left_out.element(&tag(part), at),
        }
        false
    }

    /// Reports attributes that the element does not have, and what it says otherwise than by attributes.
    pub fn check_attributes(&mut self, node: Node<'d, 'd>) {
        let tag = node.tag_name().name();
        let Some(known) = Known::of(tag) else { return };
        for attribute in node.attributes().filter(|attribute| !known.contains(attribute)) {
            let name = attribute.name();
            let found = format!("attribute {} of `{tag}`", quoted(name));
            let meant = suggest::nearest(name, known.read.iter().copied()).map(suggest::question);
            let meant = meant.map_or_else(String::new, |meant| format!("; {meant}"));
            let expected = format!("{}{meant}", listed(known.read, "or"));
            self.error_at(attribute.range().start, tag, found, expected);
        }
        let says = |part: &Node<'_, '_>| match part.text() {
            Some(text) if part.is_text() => !text.trim().is_empty(),
            _ => part.is_element() && !is_foreign(part),
        };
        if known.is_leaf && node.children().any(|part| says(&part)) {
            let expected = format!("{} as attributes", listed(known.read, "or"));
            self.error(node, tag, &format!("`{tag}` with content"), &expected);
        }
    }
}
