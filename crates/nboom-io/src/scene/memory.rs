//! What is read once of scenes that differ in a few numbers.

use std::sync::OnceLock;

use nboom_model::{BodyDraft, Structure};

use super::fields::Reader;
use super::parameters::Parameters;
use super::tree::{Node, Table, Value};
use crate::diagnostic::Diagnostic;

/// Something that is read once, and the warnings that it gives.
type Once<T> = OnceLock<(T, Vec<Diagnostic>)>;

/// What has been read of a tree without errors. It holds of each tree that shares the same tables, as far as
/// the parameters in them are the same.
#[derive(Debug)]
pub(super) struct Memory {
    root: Table,
    parameters: Parameters,
    bodies: Vec<Once<BodyDraft>>,
    structure: Once<Option<Structure>>,
}

/// What of a memory holds of another tree.
#[derive(Default)]
pub(super) struct Recalled<'m> {
    bodies: Vec<Option<&'m Once<BodyDraft>>>,
    /// Which follows from all bodies.
    pub structure: Option<&'m Once<Option<Structure>>>,
}

impl Memory {
    /// Of a tree with these parameters, still empty.
    pub fn of(root: &Table, parameters: Parameters) -> Self {
        let bodies = bodies(root).iter().map(|_| Once::new()).collect();
        Self { root: root.clone(), parameters, bodies, structure: Once::new() }
    }

    /// What holds of a tree with these parameters.
    pub fn recall(&self, root: &Table, parameters: &Parameters) -> Recalled<'_> {
        let changed = self.parameters.other_than(parameters);
        let is_same = |own: &Node, other: &Node| {
            own.value.is_shared_with(&other.value) && !own.value.mentions(&changed)
        };
        let materials = [&self.root, root].map(|root| root.get("materials"));
        let are_materials_same = match materials {
            [Some(own), Some(other)] => is_same(&own.node, &other.node),
            [own, other] => own.is_none() && other.is_none(),
        };
        let both = bodies(&self.root).iter().zip(bodies(root));
        let holds = both.map(|(own, other)| are_materials_same && is_same(own, other));
        let bodies: Vec<_> =
            holds.zip(&self.bodies).map(|(holds, it)| holds.then_some(it)).collect();
        let structure = bodies.iter().all(Option::is_some).then_some(&self.structure);
        Recalled { bodies, structure }
    }
}

impl<'m> Recalled<'m> {
    /// The body number `i` of the tree.
    pub fn body(&self, i: usize) -> Option<&'m Once<BodyDraft>> {
        self.bodies.get(i).copied().flatten()
    }
}

fn bodies(root: &Table) -> &[Node] {
    match root.get("body").map(|entry| &entry.node.value) {
        Some(Value::List(nodes)) => nodes,
        _ => &[],
    }
}

impl Reader<'_, '_> {
    /// What is known already, or what is read now; it is known from then on, unless something is wrong.
    pub fn once<T: Clone>(
        &mut self,
        known: Option<&Once<T>>,
        read: impl FnOnce(&mut Self) -> T,
    ) -> T {
        let Some(known) = known else { return read(self) };
        if let Some((found, warnings)) = known.get() {
            self.report.warn_again(warnings);
            return found.clone();
        }
        let before = self.report.warnings.len();
        let found = read(self);
        if self.report.has_all_of_a_scene() {
            let warnings = self.report.warnings[before..].to_vec();
            known.get_or_init(|| (found.clone(), warnings));
        }
        found
    }
}
