//! Statements from a graph.

use std::collections::{BTreeMap, BTreeSet};

use nboom_expr::{Graph, Id, Node};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::emit::blocks::{Line, in_blocks};
use crate::emit::comment::comment;
use crate::emit::expression::Expression;
use crate::emit::fusion::Fusion;
use crate::emit::inputs::Inputs;
use crate::emit::order::Order;
use crate::emit::text::LINE;
use crate::request::Level;

/// What statements are wanted for.
pub(crate) struct Task<'a> {
    pub graph: &'a Graph,
    /// The nodes to compute; others that they use are inputs.
    pub wanted: &'a [bool],
    pub inputs: Inputs,
    /// What is read afterwards, each with a name for it, if it has one.
    pub results: Vec<(Id, Option<String>)>,
    pub level: Level,
    /// Whether to say what parts of the computation are for, and to bind inputs where they come in.
    pub remarks: bool,
    /// Columns that the statements stand from the left.
    pub indent: usize,
}

/// Statements, and what they compute.
pub(crate) struct Statements {
    pub lines: Vec<TokenStream>,
    pub results: Vec<Expression>,
}

impl Statements {
    /// Statements in the order of the nodes, operands first. What one other node alone uses becomes
    /// part of its expression as long as that fits in a line.
    pub fn of(task: Task) -> Self {
        let Order { early, angles, parts, fused, inside } =
            Order::of(task.graph, task.wanted, task.level);
        let mut writer = Writer::new(task, fused, inside);
        if !writer.task.remarks {
            writer.bind_all();
        }
        if !angles.is_empty() {
            writer.remark(0, "Sines and cosines of all angles.");
            writer.part(None, &early);
            writer.angles(&angles);
        }
        for (part, nodes) in parts {
            writer.part(writer.task.graph.remark(part), &nodes);
        }
        writer.finish()
    }
}

struct Writer<'a> {
    task: Task<'a>,
    fused: Vec<Option<Fusion>>,
    inside: Vec<bool>,
    /// Names of results.
    names: BTreeMap<usize, String>,
    /// How to read each node that has been computed.
    values: BTreeMap<usize, Expression>,
    /// Values that wait to become part of the expression of the only node that uses them.
    waiting: BTreeSet<usize>,
    lines: Vec<Line>,
}

impl<'a> Writer<'a> {
    fn new(task: Task<'a>, fused: Vec<Option<Fusion>>, inside: Vec<bool>) -> Self {
        let mut names = BTreeMap::new();
        for (id, name) in &task.results {
            if let Some(name) = name {
                names.entry(id.index()).or_insert_with(|| name.clone());
            }
        }
        let (values, waiting, lines) = (BTreeMap::new(), BTreeSet::new(), Vec::new());
        Self { task, fused, inside, names, values, waiting, lines }
    }

    fn part(&mut self, remark: Option<&'a str>, nodes: &[Id]) {
        let start = self.lines.len();
        let operands = nodes.iter().flat_map(|&id| self.task.graph.node(id).operands());
        self.bind(operands.collect());
        nodes.iter().for_each(|&id| self.node(id));
        if let Some(words) = remark.filter(|_| self.lines.len() > start) {
            self.remark(start, words);
        }
    }

    fn remark(&mut self, at: usize, words: &str) {
        if self.task.remarks {
            self.lines.insert(at, Line::Other(comment(words)));
        }
    }

    /// Binds all that is read, so that it stands together.
    fn bind_all(&mut self) {
        let Task { graph, wanted, results, .. } = &self.task;
        let nodes = graph.nodes().filter(|(id, _)| wanted[id.index()]);
        let operands = nodes.flat_map(|(_, node)| node.operands());
        let ids = operands.chain(results.iter().map(|&(id, _)| id)).collect();
        self.bind(ids);
    }

    fn bind(&mut self, ids: Vec<Id>) {
        let nodes = ids.into_iter().map(Id::index);
        let bindings = self.task.inputs.bind(nodes, self.task.indent);
        self.lines.extend(bindings.into_iter().map(Line::Other));
    }

    fn angles(&mut self, angles: &[Id]) {
        self.bind(angles.to_vec());
        let names: Vec<String> = angles.iter().map(|&angle| self.name(angle)).collect();
        let pairs = names.iter().map(|name| {
            let (sine, cosine) = (format_ident!("sin_{name}"), format_ident!("cos_{name}"));
            quote!((#sine, #cosine))
        });
        let values = names.iter().map(|name| format_ident!("{name}"));
        let line = quote!(let [#(#pairs),*] = R::sin_cos_all([#(#values),*]););
        self.lines.push(Line::Other(line));
    }

    /// What a node's value is called.
    fn name(&self, id: Id) -> String {
        let given = self.task.inputs.name(id.index());
        let given = given.or_else(|| self.names.get(&id.index()).map(String::as_str));
        given.map_or_else(|| format!("t{}", id.index()), str::to_owned)
    }

    fn read(&self, id: Id) -> Expression {
        match (self.task.graph.node(id), self.values.get(&id.index())) {
            (Node::Constant(bits), _) => Expression::constant(f64::from_bits(bits)),
            (_, Some(value)) => value.clone(),
            (_, None) => Expression::named(&self.name(id)),
        }
    }

    fn node(&mut self, id: Id) {
        if self.task.inputs.name(id.index()).is_some() {
            return;
        }
        let node = self.task.graph.node(id);
        let operands: Vec<Id> = match (node, self.fused[id.index()]) {
            (_, Some(Fusion::Inside)) | (Node::Input(_) | Node::Constant(_), _) => return,
            (Node::Sin(angle), _) => return self.turn(id, "sin", angle),
            (Node::Cos(angle), _) => return self.turn(id, "cos", angle),
            (_, Some(Fusion::Outside { a, b, term, .. } | Fusion::Less { a, b, term })) => {
                vec![a, b, term]
            }
            _ => node.operands().collect(),
        };
        let name = self.name(id);
        let room = LINE - self.task.indent - "let  = ;".len() - name.len();
        let mut value = self.value(id);
        while value.width > room
            && let Some(&widest) = operands
                .iter()
                .filter(|operand| self.waiting.contains(&operand.index()))
                .max_by_key(|operand| self.values[&operand.index()].width)
        {
            self.write(widest);
            value = self.value(id);
        }
        for operand in operands {
            self.waiting.remove(&operand.index());
        }
        self.values.insert(id.index(), value);
        if self.inside[id.index()] {
            self.waiting.insert(id.index());
        } else {
            self.write(id);
        }
    }

    fn turn(&mut self, id: Id, function: &str, angle: Id) {
        let name = format!("{function}_{}", self.name(angle));
        self.values.insert(id.index(), Expression::named(&name));
    }

    fn value(&self, id: Id) -> Expression {
        let read = |id: Id| self.read(id);
        match (self.task.graph.node(id), self.fused[id.index()]) {
            (_, Some(Fusion::Outside { negative, a, b, term })) => {
                let a = if negative { read(a).negated() } else { read(a) };
                Expression::fused(&a, &read(b), &read(term))
            }
            (_, Some(Fusion::Less { a, b, term })) => {
                Expression::fused(&read(a), &read(b), &read(term).negated())
            }
            (Node::Add(a, b), _) => Expression::sum(&read(a), &read(b)),
            (Node::Sub(a, b), _) => Expression::difference(&read(a), &read(b)),
            (Node::Mul(a, b), _) => Expression::product(&read(a), &read(b)),
            (Node::Div(a, b), _) => Expression::quotient(&read(a), &read(b)),
            (Node::Neg(a), _) => read(a).negated(),
            (Node::Sqrt(a), _) => read(a).square_root(),
            _ => read(id),
        }
    }

    /// Binds the value of a node to its name.
    fn write(&mut self, id: Id) {
        let name = self.name(id);
        let value = self.values.insert(id.index(), Expression::named(&name));
        self.waiting.remove(&id.index());
        if let Some(Expression { tokens: value, .. }) = value {
            self.lines.push(Line::Value { name: format_ident!("{name}"), value });
        }
    }

    fn finish(mut self) -> Statements {
        let ids: Vec<Id> = self.task.results.iter().map(|&(id, _)| id).collect();
        self.bind(ids.clone());
        let results: Vec<Expression> = ids.into_iter().map(|id| self.read(id)).collect();
        let read: Vec<TokenStream> = results.iter().map(|result| result.tokens.clone()).collect();
        Statements { lines: in_blocks(&self.lines, &read), results }
    }
}
