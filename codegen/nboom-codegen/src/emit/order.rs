use nboom_expr::{Graph, Id, Node};

use crate::emit::fusion::{Fusion, fusions};
use crate::request::Level;

/// In which order nodes are computed, and how.
pub(crate) struct Order {
    /// What angles are computed from.
    pub early: Vec<Id>,
    /// The angles whose sines and cosines are then taken, all at once.
    pub angles: Vec<Id>,
    /// All else, by the parts of the computation.
    pub parts: Vec<(usize, Vec<Id>)>,
    /// What each node is fused with.
    pub fused: Vec<Option<Fusion>>,
    /// For each node, whether it may stand inside of the expression of the node that uses it.
    pub inside: Vec<bool>,
}

impl Order {
    /// Of the nodes for which `wanted` holds.
    pub fn of(graph: &Graph, wanted: &[bool], level: Level) -> Self {
        let fused = match level {
            Level::Exact => vec![None; wanted.len()],
            Level::Fast => fusions(graph, wanted),
        };
        let angles = angles(graph, wanted);
        let is_early = feeding(graph, &angles, wanted);
        let (mut early, mut parts): (Vec<Id>, Vec<(usize, Vec<Id>)>) = (Vec::new(), Vec::new());
        for id in graph.nodes().map(|(id, _)| id).filter(|id| wanted[id.index()]) {
            match parts.last_mut() {
                _ if is_early[id.index()] => early.push(id),
                Some((part, nodes)) if *part == graph.part(id) => nodes.push(id),
                _ => parts.push((graph.part(id), vec![id])),
            }
        }
        let place = |id: Id| (is_early[id.index()], graph.part(id));
        let mut inside = inside(graph, wanted, &fused, place);
        angles.iter().for_each(|angle| inside[angle.index()] = false);
        Self { early, angles, parts, fused, inside }
    }
}

/// The angles whose sine or cosine is wanted.
fn angles(graph: &Graph, wanted: &[bool]) -> Vec<Id> {
    let mut angles = Vec::new();
    for (_, node) in graph.nodes().filter(|(id, _)| wanted[id.index()]) {
        if let Node::Sin(angle) | Node::Cos(angle) = node
            && !angles.contains(&angle)
        {
            angles.push(angle);
        }
    }
    angles
}

/// The wanted nodes that the angles are computed from.
fn feeding(graph: &Graph, angles: &[Id], wanted: &[bool]) -> Vec<bool> {
    let mut feeding = vec![false; wanted.len()];
    angles.iter().for_each(|id| feeding[id.index()] = true);
    let nodes: Vec<Node> = graph.nodes().map(|(_, node)| node).collect();
    for i in (0..wanted.len()).rev().filter(|&i| wanted[i]) {
        if feeding[i] {
            nodes[i].operands().for_each(|operand| feeding[operand.index()] = true);
        }
    }
    feeding
}

/// Wanted nodes that one other alone uses, which is computed in the same place.
fn inside<P: PartialEq>(
    graph: &Graph,
    wanted: &[bool],
    fused: &[Option<Fusion>],
    place: impl Fn(Id) -> P,
) -> Vec<bool> {
    let mut user: Vec<Option<Id>> = vec![None; wanted.len()];
    for (id, node) in graph.nodes() {
        node.operands().for_each(|operand| user[operand.index()] = Some(id));
    }
    // A product that is fused is computed where its sum is.
    let computed = |id: Id| match fused[id.index()] {
        Some(Fusion::Inside) => user[id.index()].unwrap_or(id),
        _ => id,
    };
    let uses = graph.uses();
    let may = |id: Id| {
        let used_once = wanted[id.index()] && uses[id.index()] == 1;
        let user = user[id.index()].filter(|user| used_once && wanted[user.index()]);
        user.is_some_and(|user| place(computed(user)) == place(id))
    };
    graph.nodes().map(|(id, _)| may(id)).collect()
}
