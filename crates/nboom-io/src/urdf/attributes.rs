//! Which attributes elements have. A misspelled one would leave its default in place with no word.

use roxmltree::{Attribute, Node};

use super::reader::Reader;
use crate::diagnostic::quoted;
use crate::scene::suggest;

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
            "dynamics" => (&["damping", "friction"], &["D", "K", "mu_coulomb", "mu_viscous"]),
            "mass" => (&["value"], &[]),
            "inertia" => (&["ixx", "ixy", "ixz", "iyy", "iyz", "izz"], &[]),
            _ => return None,
        };
        Some(Self { read, besides, is_leaf: !matches!(tag, "robot" | "link" | "joint") })
    }

    fn contains(&self, attribute: &Attribute<'_, '_>) -> bool {
        // Those of a namespace are for the program that it belongs to.
        attribute.namespace().is_some()
            || self.read.contains(&attribute.name())
            || self.besides.contains(&attribute.name())
    }

    fn listed(&self) -> String {
        let quoted: Vec<String> = self.read.iter().map(|name| format!("`{name}`")).collect();
        match &quoted[..] {
            [others @ .., last] if !others.is_empty() => {
                format!("{} or {last}", others.join(", "))
            }
            _ => quoted.concat(),
        }
    }
}

impl<'d> Reader<'_, 'd, '_> {
    /// Reports attributes that the element does not have, and what it says otherwise than by attributes.
    pub fn check_attributes(&mut self, node: Node<'d, 'd>) {
        let tag = node.tag_name().name();
        let Some(known) = Known::of(tag) else { return };
        for attribute in node.attributes().filter(|attribute| !known.contains(attribute)) {
            let name = attribute.name();
            let found = format!("attribute {} of `{tag}`", quoted(name));
            let meant = suggest::nearest(name, known.read.iter().copied()).map(suggest::question);
            let meant = meant.map_or_else(String::new, |meant| format!("; {meant}"));
            let expected = format!("{}{meant}", known.listed());
            self.error_at(attribute.range().start, tag, found, expected);
        }
        let says = |part: &Node<'_, '_>| match part.text() {
            Some(text) if part.is_text() => !text.trim().is_empty(),
            _ => part.is_element(),
        };
        if known.is_leaf && node.children().any(|part| says(&part)) {
            let expected = format!("{} as attributes", known.listed());
            self.error(node, tag, &format!("`{tag}` with content"), &expected);
        }
    }
}
