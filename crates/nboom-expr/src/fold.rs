//! Nodes for operations, simplified where that changes no value.

use crate::graph::{Builder, Id, Node};

/// The constant that an operation on `operands` is, if they are constants and it need not be exact.
fn rounded<const N: usize>(
    builder: &mut Builder,
    operands: [Option<f64>; N],
    operation: impl FnOnce([f64; N]) -> f64,
) -> Option<Id> {
    if builder.exact || operands.contains(&None) {
        return None;
    }
    let value = operation(operands.map(|operand| operand.unwrap_or(f64::NAN)));
    Some(constant(builder, value))
}

pub(crate) fn constant(builder: &mut Builder, value: f64) -> Id {
    // One zero, so that x · 0 and 0 are the same node.
    let value = if value == 0.0 { 0.0 } else { value };
    builder.intern(Node::Constant(value.to_bits()))
}

fn value(builder: &Builder, id: Id) -> Option<f64> {
    match builder.node(id) {
        Node::Constant(bits) => Some(f64::from_bits(bits)),
        _ => None,
    }
}

fn negated(builder: &Builder, id: Id) -> Option<Id> {
    match builder.node(id) {
        Node::Neg(a) => Some(a),
        _ => None,
    }
}

pub(crate) fn add(builder: &mut Builder, a: Id, b: Id) -> Id {
    let (of_a, of_b) = (value(builder, a), value(builder, b));
    if let Some(folded) = rounded(builder, [of_a, of_b], |[x, y]| x + y) {
        return folded;
    }
    match (of_a, of_b) {
        (Some(0.0), _) => return b,
        (_, Some(0.0)) => return a,
        _ => {}
    }
    match (negated(builder, a), negated(builder, b)) {
        (Some(a), Some(b)) => {
            let sum = add(builder, a, b);
            neg(builder, sum)
        }
        (Some(a), None) => sub(builder, b, a),
        (None, Some(b)) => sub(builder, a, b),
        (None, None) => builder.intern(Node::Add(a.min(b), a.max(b))),
    }
}

pub(crate) fn sub(builder: &mut Builder, a: Id, b: Id) -> Id {
    let (of_a, of_b) = (value(builder, a), value(builder, b));
    if let Some(folded) = rounded(builder, [of_a, of_b], |[x, y]| x - y) {
        return folded;
    }
    match (of_a, of_b) {
        (Some(0.0), _) => return neg(builder, b),
        (_, Some(0.0)) => return a,
        _ if a == b => return constant(builder, 0.0),
        _ => {}
    }
    match (negated(builder, a), negated(builder, b)) {
        (Some(a), Some(b)) => sub(builder, b, a),
        (Some(a), None) => {
            let sum = add(builder, a, b);
            neg(builder, sum)
        }
        (None, Some(b)) => add(builder, a, b),
        (None, None) => builder.intern(Node::Sub(a, b)),
    }
}

pub(crate) fn mul(builder: &mut Builder, a: Id, b: Id) -> Id {
    let (of_a, of_b) = (value(builder, a), value(builder, b));
    if let Some(folded) = rounded(builder, [of_a, of_b], |[x, y]| x * y) {
        return folded;
    }
    match (of_a, of_b) {
        (Some(0.0), _) | (_, Some(0.0)) => return constant(builder, 0.0),
        (Some(1.0), _) => return b,
        (_, Some(1.0)) => return a,
        (Some(-1.0), _) => return neg(builder, b),
        (_, Some(-1.0)) => return neg(builder, a),
        _ => {}
    }
    match (negated(builder, a), negated(builder, b)) {
        (Some(a), Some(b)) => mul(builder, a, b),
        (Some(a), None) => {
            let product = mul(builder, a, b);
            neg(builder, product)
        }
        (None, Some(b)) => {
            let product = mul(builder, a, b);
            neg(builder, product)
        }
        (None, None) => builder.intern(Node::Mul(a.min(b), a.max(b))),
    }
}

pub(crate) fn div(builder: &mut Builder, a: Id, b: Id) -> Id {
    let (of_a, of_b) = (value(builder, a), value(builder, b));
    if let Some(folded) = rounded(builder, [of_a, of_b], |[x, y]| x / y) {
        return folded;
    }
    match (of_a, of_b) {
        (Some(0.0), _) => return constant(builder, 0.0),
        (_, Some(1.0)) => return a,
        (_, Some(-1.0)) => return neg(builder, a),
        _ => {}
    }
    match (negated(builder, a), negated(builder, b)) {
        (Some(a), Some(b)) => div(builder, a, b),
        (Some(a), None) => {
            let quotient = div(builder, a, b);
            neg(builder, quotient)
        }
        (None, Some(b)) => {
            let quotient = div(builder, a, b);
            neg(builder, quotient)
        }
        (None, None) => builder.intern(Node::Div(a, b)),
    }
}

pub(crate) fn neg(builder: &mut Builder, a: Id) -> Id {
    match builder.node(a) {
        Node::Constant(bits) => constant(builder, -f64::from_bits(bits)),
        Node::Neg(inner) => inner,
        Node::Sub(x, y) => sub(builder, y, x),
        _ => builder.intern(Node::Neg(a)),
    }
}

pub(crate) fn sqrt(builder: &mut Builder, a: Id) -> Id {
    let of_a = value(builder, a);
    rounded(builder, [of_a], |[x]| x.sqrt()).unwrap_or_else(|| builder.intern(Node::Sqrt(a)))
}

pub(crate) fn sin_cos(builder: &mut Builder, a: Id) -> (Id, Id) {
    match value(builder, a) {
        Some(0.0) => (a, constant(builder, 1.0)),
        Some(x) if !builder.exact => (constant(builder, x.sin()), constant(builder, x.cos())),
        _ => (builder.intern(Node::Sin(a)), builder.intern(Node::Cos(a))),
    }
}
