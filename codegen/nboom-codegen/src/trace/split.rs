use nboom_expr::{Graph, Id, Node, Operations};

use crate::request::Level;

/// A graph in two parts: what depends on parameters alone is prepared once, all else is evaluated
/// for each state.
pub(crate) struct Split {
    pub graph: Graph,
    /// How many of the inputs are parameters; the others vary.
    pub parameters: usize,
    /// For each node, whether it depends on inputs that vary.
    pub varies: Vec<bool>,
    /// Prepared nodes that an evaluation uses or that are results.
    pub constants: Vec<Id>,
}

impl Split {
    /// The first `parameters` inputs of the graph are parameters.
    pub fn new(graph: Graph, parameters: usize) -> Self {
        let varies = graph.depends_on(|input| input >= parameters);
        let constants = constants(&graph, &varies);
        Self { graph, parameters, varies, constants }
    }

    /// Regroups sums if the level permits it.
    pub fn at(self, level: Level) -> Self {
        match level {
            Level::Exact => self,
            Level::Fast => Self::new(self.graph.regrouped(&self.varies), self.parameters),
        }
    }

    /// For each node, whether it is prepared.
    pub fn is_prepared(&self) -> Vec<bool> {
        self.varies.iter().map(|varies| !varies).collect()
    }

    /// Operations of an evaluation.
    pub fn evaluation(&self) -> Operations {
        self.graph.operations_of(|i| self.varies[i])
    }

    /// Operations of a preparation.
    pub fn preparation(&self) -> Operations {
        self.graph.operations_of(|i| !self.varies[i])
    }
}

fn constants(graph: &Graph, varies: &[bool]) -> Vec<Id> {
    let mut needed = vec![false; varies.len()];
    for (_, node) in graph.nodes().filter(|(id, _)| varies[id.index()]) {
        for operand in node.operands().map(Id::index).filter(|&operand| !varies[operand]) {
            needed[operand] = true;
        }
    }
    for output in graph.outputs().iter().map(|id| id.index()).filter(|&output| !varies[output]) {
        needed[output] = true;
    }
    let is_literal = |node| matches!(node, Node::Constant(_));
    let wanted = graph.nodes().filter(|(id, node)| needed[id.index()] && !is_literal(*node));
    wanted.map(|(id, _)| id).collect()
}
