use std::collections::HashMap;

use nboom_scalar::Real;

use crate::Expr;
use crate::expr;

/// A node of a graph; operands have smaller numbers than the node that uses them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Id(pub(crate) u32);

impl Id {
    /// The node's number.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// What a node computes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// An input, by its number.
    Input(u32),
    /// A constant, by the bits of its `f64`.
    Constant(u64),
    /// Sum of two nodes.
    Add(Id, Id),
    /// First less second.
    Sub(Id, Id),
    /// Product of two nodes.
    Mul(Id, Id),
    /// First by second.
    Div(Id, Id),
    /// The node with its sign changed.
    Neg(Id),
    /// Square root.
    Sqrt(Id),
    /// Sine of an angle.
    Sin(Id),
    /// Cosine of an angle.
    Cos(Id),
}

impl Node {
    /// The nodes it uses.
    pub fn operands(self) -> impl Iterator<Item = Id> {
        let (first, second) = match self {
            Self::Input(_) | Self::Constant(_) => (None, None),
            Self::Add(a, b) | Self::Sub(a, b) | Self::Mul(a, b) | Self::Div(a, b) => {
                (Some(a), Some(b))
            }
            Self::Neg(a) | Self::Sqrt(a) | Self::Sin(a) | Self::Cos(a) => (Some(a), None),
        };
        first.into_iter().chain(second)
    }
}

/// What a computation does with its inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Graph {
    pub(crate) nodes: Vec<Node>,
    pub(crate) remarks: Remarks,
    pub(crate) outputs: Vec<Id>,
    pub(crate) inputs: usize,
}

/// What a computation says of its parts.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Remarks {
    words: Vec<String>,
    /// For each node how many remarks were made before it.
    pub(crate) before: Vec<usize>,
}

/// Nodes under construction, each stored once.
#[derive(Default)]
pub(crate) struct Builder {
    /// Whether operations on constants stay operations instead of being rounded to `f64`.
    pub exact: bool,
    /// How many remarks were made before the nodes that are added now.
    pub remarked: usize,
    remarks: Remarks,
    nodes: Vec<Node>,
    numbers: HashMap<Node, Id>,
}

impl Builder {
    /// No nodes yet, with remarks that are made already.
    pub fn remarked_as(remarks: &Remarks) -> Self {
        let remarks = Remarks { words: remarks.words.clone(), before: Vec::new() };
        Self { remarks, ..Self::default() }
    }

    /// The number of `node`, which is added when it is new.
    pub fn intern(&mut self, node: Node) -> Id {
        *self.numbers.entry(node).or_insert_with(|| {
            let id = Id(u32::try_from(self.nodes.len()).expect("graphs have fewer than 2³² nodes"));
            self.nodes.push(node);
            self.remarks.before.push(self.remarked);
            id
        })
    }

    pub fn remark(&mut self, words: String) {
        self.remarks.words.push(words);
        self.remarked = self.remarks.words.len();
    }

    pub fn node(&self, id: Id) -> Node {
        self.nodes[id.index()]
    }

    /// The graph of the nodes that the results need.
    pub fn finish(self, inputs: usize, outputs: Vec<Id>) -> Graph {
        let Self { nodes, remarks, .. } = self;
        Graph { nodes, remarks, outputs, inputs }.without_dead_nodes()
    }
}

impl Graph {
    /// Runs `computation` on `inputs` recording inputs and keeps what its results need.
    pub fn trace(inputs: usize, computation: impl FnOnce(&[Expr]) -> Vec<Expr>) -> Self {
        Self::trace_with(&vec![None; inputs], computation)
    }

    /// Like [`trace`](Self::trace), with the inputs that have a value in `assumptions` replaced by
    /// that constant.
    pub fn trace_with(
        assumptions: &[Option<f64>],
        computation: impl FnOnce(&[Expr]) -> Vec<Expr>,
    ) -> Self {
        Self::record(Builder::default(), assumptions, computation)
    }

    /// Like [`trace`](Self::trace), with no operation carried out, so that none is rounded:
    /// constants are those that `computation` states.
    pub fn trace_exactly(inputs: usize, computation: impl FnOnce(&[Expr]) -> Vec<Expr>) -> Self {
        Self::record(
            Builder { exact: true, ..Builder::default() },
            &vec![None; inputs],
            computation,
        )
    }

    fn record(
        builder: Builder,
        assumptions: &[Option<f64>],
        computation: impl FnOnce(&[Expr]) -> Vec<Expr>,
    ) -> Self {
        let (builder, outputs) = expr::record(builder, || {
            let inputs: Vec<Expr> = assumptions
                .iter()
                .enumerate()
                .map(|(i, value)| match value {
                    Some(value) => Expr::constant(*value),
                    None => Expr::input(i),
                })
                .collect();
            computation(&inputs)
        });
        builder.finish(assumptions.len(), outputs.into_iter().map(Expr::id).collect())
    }

    /// How many inputs there are, used or not.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// The nodes, operands first.
    pub fn nodes(&self) -> impl Iterator<Item = (Id, Node)> {
        self.nodes.iter().enumerate().map(|(i, &node)| (Id(i as u32), node))
    }

    /// One node.
    pub fn node(&self, id: Id) -> Node {
        self.nodes[id.index()]
    }

    /// The results.
    pub fn outputs(&self) -> &[Id] {
        &self.outputs
    }

    /// For each node, whether it depends on an input for which `varies` holds.
    pub fn depends_on(&self, varies: impl Fn(usize) -> bool) -> Vec<bool> {
        let mut depends: Vec<bool> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let from_input = matches!(node, Node::Input(i) if varies(*i as usize));
            let inherited = node.operands().any(|operand| depends[operand.index()]);
            depends.push(from_input || inherited);
        }
        depends
    }

    /// How often each node is used, results included.
    pub fn uses(&self) -> Vec<usize> {
        let mut uses = vec![0; self.nodes.len()];
        let operands = self.nodes.iter().flat_map(|node| node.operands());
        operands.chain(self.outputs.iter().copied()).for_each(|id| uses[id.index()] += 1);
        uses
    }

    /// Which remark of the computation the node comes under, from 1; 0 before the first.
    pub fn part(&self, id: Id) -> usize {
        self.remarks.before[id.index()]
    }

    /// What the computation said before part `part`.
    pub fn remark(&self, part: usize) -> Option<&str> {
        part.checked_sub(1).map(|i| self.remarks.words[i].as_str())
    }

    fn without_dead_nodes(self) -> Self {
        let mut live = vec![false; self.nodes.len()];
        self.outputs.iter().for_each(|id| live[id.index()] = true);
        for i in (0..self.nodes.len()).rev() {
            if live[i] {
                self.nodes[i].operands().for_each(|operand| live[operand.index()] = true);
            }
        }
        self.keep(&live)
    }

    fn keep(&self, live: &[bool]) -> Self {
        let mut new_ids: Vec<Option<Id>> = vec![None; self.nodes.len()];
        let mut nodes = Vec::new();
        for (i, node) in self.nodes.iter().enumerate().filter(|(i, _)| live[*i]) {
            new_ids[i] = Some(Id(nodes.len() as u32));
            nodes.push(node.renumbered(|id| new_ids[id.index()].expect("operands are live")));
        }
        let renumber = |id: &Id| new_ids[id.index()].expect("outputs are live");
        let outputs = self.outputs.iter().map(renumber).collect();
        let before = self.remarks.before.iter().zip(live).filter(|(_, live)| **live);
        let before = before.map(|(&before, _)| before).collect();
        let remarks = Remarks { words: self.remarks.words.clone(), before };
        Self { nodes, remarks, outputs, inputs: self.inputs }
    }
}

impl Node {
    fn renumbered(self, new: impl Fn(Id) -> Id) -> Self {
        match self {
            Self::Input(_) | Self::Constant(_) => self,
            Self::Add(a, b) => Self::Add(new(a), new(b)),
            Self::Sub(a, b) => Self::Sub(new(a), new(b)),
            Self::Mul(a, b) => Self::Mul(new(a), new(b)),
            Self::Div(a, b) => Self::Div(new(a), new(b)),
            Self::Neg(a) => Self::Neg(new(a)),
            Self::Sqrt(a) => Self::Sqrt(new(a)),
            Self::Sin(a) => Self::Sin(new(a)),
            Self::Cos(a) => Self::Cos(new(a)),
        }
    }
}
