use nboom_expr::{Graph, Id, Node};
use nboom_scalar::Real;

use crate::schedule::Task;

/// The action of an instruction for one power of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// Values `a` and `b`.
    Add,
    /// Values `a` and `b`.
    Sub,
    /// Value `a`.
    Neg,
    /// Value `a` times factor `b`.
    Scale,
    /// Appends value `a` to `history`.
    Keep,
    /// Histories `a` and `b`.
    Mul,
    /// Value `a` by history `b`; the quotient is kept in `history`.
    Div,
    /// Value `a`; the root is kept in `history`.
    Sqrt,
    /// Value `a`, results in `to` and `b`; three histories in a row, those of the angle's rate,
    /// of the sine and of the cosine.
    SinCos,
}

/// Where a result goes and operands are.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Instruction {
    pub to: u32,
    pub a: u32,
    pub b: u32,
    pub history: u32,
}

impl Instruction {
    fn new(to: usize, a: usize, b: usize, history: usize) -> Self {
        let short = |i| u32::try_from(i).expect("graphs have fewer than 2³² coefficients");
        Self { to: short(to), a: short(a), b: short(b), history: short(history) }
    }
}

/// Makes instructions of nodes; a node's value has the node's number.
pub(crate) struct Compiler<R> {
    varies: Vec<bool>,
    stride: usize,
    pub tasks: Vec<Task<Kind, Instruction>>,
    /// How many values there are.
    pub values: usize,
    /// Constants, with their indices among values.
    pub constants: Vec<(usize, R)>,
    pub factors: Vec<R>,
    /// Inputs, with their indices among values.
    pub inputs: Vec<(usize, usize)>,
    pub histories: usize,
    /// The inputs that do not change; they follow those that do.
    fixed_inputs: Vec<R>,
    fixed: Vec<R>,
    /// The task that computes each node's value.
    value_tasks: Vec<Option<usize>>,
    /// Each node's history, and the task that keeps it.
    kept: Vec<Option<(usize, usize)>>,
    /// For each angle, the instruction for its sine and cosine.
    angles: Vec<Option<usize>>,
}

impl<R: Real> Compiler<R> {
    /// Of `graph`, whose last inputs are `fixed`, with histories `stride` apart.
    pub fn new(graph: &Graph, fixed: &[R], stride: usize) -> Self {
        let varying = graph.inputs() - fixed.len();
        let varies = graph.depends_on(|input| input < varying);
        let mut fixed_inputs = vec![R::zero(); varying];
        fixed_inputs.extend(fixed);
        let values = varies.len();
        Self {
            varies,
            stride,
            tasks: Vec::new(),
            values,
            constants: Vec::new(),
            factors: Vec::new(),
            inputs: Vec::new(),
            histories: 0,
            fixed_inputs,
            fixed: vec![R::zero(); values],
            value_tasks: vec![None; values],
            kept: vec![None; values],
            angles: vec![None; values],
        }
    }

    /// Adds what computes `node`, whose operands have been compiled.
    pub fn compile(&mut self, id: Id, node: Node) {
        let to = id.index();
        if !self.varies[to] {
            self.fixed[to] = node.value(&self.fixed_inputs, |id| self.fixed[id.index()]);
            self.constants.push((to, self.fixed[to]));
            return;
        }
        let fixed = |id: Id| !self.varies[id.index()];
        match node {
            Node::Input(input) => self.inputs.push((to, input as usize)),
            Node::Constant(_) => unreachable!("constants do not vary"),
            Node::Add(a, b) => self.linear(Kind::Add, to, a, Some(b)),
            Node::Sub(a, b) => self.linear(Kind::Sub, to, a, Some(b)),
            Node::Neg(a) => self.linear(Kind::Neg, to, a, None),
            Node::Mul(a, b) if fixed(a) => self.scale(to, b, self.fixed[a.index()]),
            Node::Mul(a, b) if fixed(b) => self.scale(to, a, self.fixed[b.index()]),
            Node::Div(a, b) if fixed(b) => self.scale(to, a, R::one() / self.fixed[b.index()]),
            Node::Mul(a, b) => {
                let ((a, kept_a), (b, kept_b)) = (self.history(a), self.history(b));
                let at = Instruction::new(to, a, b, 0);
                self.push_value(Kind::Mul, at, vec![kept_a, kept_b]);
            }
            Node::Div(a, b) => {
                let ((b, kept_b), history) = (self.history(b), self.new_histories(1));
                let after = self.after(a).into_iter().chain([kept_b]).collect();
                let at = Instruction::new(to, a.index(), b, history);
                let task = self.push_value(Kind::Div, at, after);
                self.kept[to] = Some((history, task));
            }
            Node::Sqrt(a) => {
                let history = self.new_histories(1);
                let at = Instruction::new(to, a.index(), 0, history);
                let task = self.push_value(Kind::Sqrt, at, self.after(a).into_iter().collect());
                self.kept[to] = Some((history, task));
            }
            Node::Sin(a) => self.sine_or_cosine(to, a, true),
            Node::Cos(a) => self.sine_or_cosine(to, a, false),
        }
    }

    fn linear(&mut self, kind: Kind, to: usize, a: Id, b: Option<Id>) {
        let after = [Some(a), b].into_iter().flatten().filter_map(|id| self.after(id)).collect();
        let at = Instruction::new(to, a.index(), b.map_or(0, Id::index), 0);
        self.push_value(kind, at, after);
    }

    fn scale(&mut self, to: usize, a: Id, factor: R) {
        self.factors.push(factor);
        let at = Instruction::new(to, a.index(), self.factors.len() - 1, 0);
        self.push_value(Kind::Scale, at, self.after(a).into_iter().collect());
    }

    /// One instruction computes both sine and cosine; the one without a node in the graph gets a
    /// value of its own.
    fn sine_or_cosine(&mut self, node: usize, angle: Id, sine: bool) {
        let task = self.angles[angle.index()].unwrap_or_else(|| {
            let history = self.new_histories(3);
            let (to, b) = (self.values, self.values + 1);
            self.values += 2;
            let at = Instruction::new(to, angle.index(), b, history);
            let after = self.after(angle).into_iter().collect();
            self.push(Kind::SinCos, at, after)
        });
        self.angles[angle.index()] = Some(task);
        let Instruction { to, b, history, .. } = &mut self.tasks[task].instruction;
        let (value, apart) = if sine { (to, 1) } else { (b, 2) };
        *value = node as u32;
        let history = *history as usize + apart * self.stride;
        self.value_tasks[node] = Some(task);
        self.kept[node] = Some((history, task));
    }

    /// The history of a node, and the task that keeps it.
    fn history(&mut self, node: Id) -> (usize, usize) {
        if let Some(kept) = self.kept[node.index()] {
            return kept;
        }
        let history = self.new_histories(1);
        let at = Instruction::new(0, node.index(), 0, history);
        let task = self.push(Kind::Keep, at, self.after(node).into_iter().collect());
        self.kept[node.index()] = Some((history, task));
        (history, task)
    }

    fn new_histories(&mut self, count: usize) -> usize {
        let first = self.histories * self.stride;
        self.histories += count;
        first
    }

    /// The task that must be done before a node's value is there.
    fn after(&self, node: Id) -> Option<usize> {
        self.value_tasks[node.index()]
    }

    fn push_value(&mut self, kind: Kind, at: Instruction, after: Vec<usize>) -> usize {
        let task = self.push(kind, at, after);
        self.value_tasks[at.to as usize] = Some(task);
        task
    }

    fn push(&mut self, kind: Kind, instruction: Instruction, after: Vec<usize>) -> usize {
        self.tasks.push(Task { kind, instruction, after });
        self.tasks.len() - 1
    }
}
