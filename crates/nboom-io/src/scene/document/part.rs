//! Where the file of a scene describes a part of it.

use nboom_model::Scene;

use super::SceneDocument;
use super::path::{self, Step};
use crate::Format;
use crate::responsible::{Table, of_external, of_rotor};
use crate::words::external_table;

/// A part of a scene that has a table of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ScenePart {
    /// The rotor of this number in the scene, from 0.
    Rotor(usize),
    /// The force or torque from outside of this number.
    External(usize),
    /// The kick-off spring on the body of this hinge.
    KickOff(usize),
    /// The couplings of this hinge.
    Couplings(usize),
    /// The friction of this hinge.
    Friction(usize),
}

impl SceneDocument {
    /// File and line of the table of a part of its scene. There is none in a deck or a robot, and none of a body that
    /// `repeat` makes.
    ///
    /// # Panics
    /// When the scene has no such part.
    pub fn line_of(&self, scene: &Scene, part: ScenePart) -> Option<(&str, usize)> {
        if self.as_read()?.format != Format::Toml {
            return None;
        }
        let root = self.parts.root();
        let has_thrust = root.get("thrust").is_some();
        let (table, key) = match part {
            ScenePart::Rotor(rotor) => (of_rotor(scene, rotor), None),
            ScenePart::External(index) => (of_external(scene, has_thrust, index), None),
            ScenePart::KickOff(hinge) => (Table::KickOff(hinge), None),
            ScenePart::Couplings(hinge) => (Table::Body(hinge), Some("coupling")),
            ScenePart::Friction(hinge) => (Table::Joint(hinge), Some("friction")),
        };
        let of_key = key.map(|key| Step::Key(key.to_owned()));
        let steps: Vec<Step> = steps(scene, table)?.into_iter().chain(of_key).collect();
        let (_, node) = path::step(root, &steps)?;
        let (position, ..) = self.sources.locate(&node.at);
        Some((self.sources.name(node.at.file), position.line))
    }
}

/// The path of a table, if it is one of these.
fn steps(scene: &Scene, table: Table) -> Option<Vec<Step>> {
    let key = |name: &str| Step::Key(name.to_owned());
    let owner = |body: Option<usize>| match body {
        Some(body) => Some(vec![key("body"), key(scene.labels()[body].name.as_deref()?)]),
        None => Some(vec![key("main_body")]),
    };
    let in_list = |body, list: &str, number: usize| {
        Some([owner(body)?, vec![key(list), Step::Number(number + 1)]].concat())
    };
    match table {
        Table::Thrust => Some(vec![key("thrust")]),
        Table::Rotor(body, number) => in_list(body, "rotor", number),
        Table::External(body, kind, number) => in_list(body, external_table(kind), number),
        Table::KickOff(body) => Some([owner(Some(body))?, vec![key("kick_off")]].concat()),
        Table::Body(body) => owner(Some(body)),
        Table::Joint(body) => {
            Some([owner(Some(body))?, vec![key(scene.bodies[body].joint.name())]].concat())
        }
        _ => None,
    }
}
