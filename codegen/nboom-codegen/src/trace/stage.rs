//! One step of a sweep, traced.

use std::collections::BTreeMap;

use nboom_expr::{Expr, Graph, Id, Node};
use nboom_formulation::stages::{Group, Stage};

use crate::request::Level;
use crate::trace::Split;

/// Which numbers of each group can be other than zero.
pub(crate) type Masks = BTreeMap<&'static str, Vec<bool>>;

/// A group of numbers, and which of them are handed over.
pub(crate) type Masked = (Group, Vec<bool>);

/// A step traced with what is known of its parameters and inputs.
pub(crate) struct Traced {
    pub name: String,
    pub about: &'static str,
    pub parameters: Vec<Group>,
    pub split: Split,
    pub inputs: Vec<Masked>,
    pub outputs: Vec<Masked>,
}

impl Traced {
    /// Traces `stage`; `assumptions` has a value for each parameter that is assumed, and groups
    /// that `masks` does not name can hold anything.
    pub fn new(
        prefix: &str,
        stage: &Stage<Expr>,
        assumptions: &[Option<f64>],
        masks: &Masks,
    ) -> Self {
        let parameters: usize = stage.parameters.iter().map(|group| group.size()).sum();
        assert_eq!(parameters, assumptions.len(), "a value or none for each parameter");
        let inputs: Vec<Masked> =
            stage.inputs.iter().map(|&group| (group, mask_of(masks, group))).collect();
        let mut all = assumptions.to_vec();
        let zero_or_open = |live: &bool| if *live { None } else { Some(0.0) };
        all.extend(inputs.iter().flat_map(|(_, mask)| mask).map(zero_or_open));
        let graph = Graph::trace_with(&all, &stage.run);
        let mut ids = graph.outputs().iter();
        let outputs = stage.outputs.iter().map(|&group| {
            let live = ids.by_ref().take(group.size()).map(|&id| !is_zero(&graph, id)).collect();
            (group, live)
        });
        let outputs = outputs.collect();
        let (name, about) = (format!("{prefix}_{}", stage.name), stage.about);
        let split = Split::new(graph, parameters);
        Self { name, about, parameters: stage.parameters.clone(), split, inputs, outputs }
    }

    /// With sums regrouped, for a step that is taken once and that all others wait for.
    pub fn regrouped(self, level: Level) -> Self {
        Self { split: self.split.at(level), ..self }
    }

    /// Passes on the numbers of an output group that `mask` names, zeros among them, so that
    /// several steps hand over the same numbers.
    pub fn passing_on(mut self, group: Group, mask: &[bool]) -> Self {
        for (_, live) in self.outputs.iter_mut().filter(|(other, _)| *other == group) {
            live.copy_from_slice(mask);
        }
        self
    }

    /// The groups that it reads, parameters aside, of which any number can be other than zero.
    pub fn reads(&self) -> impl Iterator<Item = Group> {
        let is_live = |(_, mask): &&Masked| mask.contains(&true);
        self.inputs.iter().filter(is_live).map(|(group, _)| *group)
    }

    /// Whether it writes a group.
    pub fn writes(&self, group: Group) -> bool {
        self.outputs.iter().any(|(other, _)| *other == group)
    }

    /// Which numbers of an output group can be other than zero.
    pub fn live(&self, group: Group) -> &[bool] {
        let found = self.outputs.iter().find(|(other, _)| *other == group);
        &found.expect("the stage writes the group").1
    }

    /// Which numbers of an input or output group are handed over.
    pub fn mask(&self, group: Group) -> &[bool] {
        let groups = self.inputs.iter().chain(&self.outputs);
        let found = groups.into_iter().find(|(other, _)| *other == group);
        &found.expect("the stage has the group").1
    }

    /// How many numbers of an output group are passed on.
    pub fn size(&self, group: Group) -> usize {
        self.live(group).iter().filter(|live| **live).count()
    }

    /// Constants prepared for each set of parameters.
    pub fn constants(&self) -> usize {
        self.split.constants.len()
    }
}

fn mask_of(masks: &Masks, group: Group) -> Vec<bool> {
    masks.get(group.name).cloned().unwrap_or_else(|| vec![true; group.size()])
}

fn is_zero(graph: &Graph, id: Id) -> bool {
    matches!(graph.node(id), Node::Constant(bits) if f64::from_bits(bits) == 0.0)
}
