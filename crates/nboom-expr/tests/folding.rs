//! Folding changes no value, and leaves nothing behind that no result needs.

use nboom_expr::{Expr, Graph, Node, Operations};
use nboom_scalar::Real;
use proptest::prelude::*;

const INPUTS: usize = 4;

/// One step of a computation; operands are numbers of earlier values, taken modulo how many
/// there are.
#[derive(Clone, Copy, Debug)]
enum Step {
    Constant(f64),
    Add(usize, usize),
    Sub(usize, usize),
    Mul(usize, usize),
    Div(usize, usize),
    Neg(usize),
    Sqrt(usize),
    Sin(usize),
    Cos(usize),
    MulAdd(usize, usize, usize),
}

impl Step {
    fn run<R: Real>(self, values: &[R]) -> R {
        let at = |i: usize| values[i % values.len()];
        match self {
            Self::Constant(value) => R::constant(value),
            Self::Add(a, b) => at(a) + at(b),
            Self::Sub(a, b) => at(a) - at(b),
            Self::Mul(a, b) => at(a) * at(b),
            Self::Div(a, b) => at(a) / at(b),
            Self::Neg(a) => -at(a),
            Self::Sqrt(a) => at(a).sqrt(),
            Self::Sin(a) => at(a).sin_cos().0,
            Self::Cos(a) => at(a).sin_cos().1,
            Self::MulAdd(a, b, c) => at(a).mul_add(at(b), at(c)),
        }
    }
}

fn step() -> impl Strategy<Value = Step> {
    let operand = 0..64_usize;
    let two = || (operand.clone(), operand.clone());
    // Few different constants, so that they meet the folding rules often.
    let constant = prop_oneof![Just(0.0), Just(-0.0), Just(1.0), Just(-1.0), -3.0..3.0];
    prop_oneof![
        3 => constant.prop_map(Step::Constant),
        3 => two().prop_map(|(a, b)| Step::Add(a, b)),
        3 => two().prop_map(|(a, b)| Step::Sub(a, b)),
        4 => two().prop_map(|(a, b)| Step::Mul(a, b)),
        2 => two().prop_map(|(a, b)| Step::Div(a, b)),
        3 => operand.clone().prop_map(Step::Neg),
        1 => operand.clone().prop_map(Step::Sqrt),
        1 => operand.clone().prop_map(Step::Sin),
        1 => operand.clone().prop_map(Step::Cos),
        2 => (operand.clone(), operand.clone(), operand.clone())
            .prop_map(|(a, b, c)| Step::MulAdd(a, b, c)),
    ]
}

/// Steps and inputs; steps that would give an infinity or no number for them are left out.
fn computation() -> impl Strategy<Value = (Vec<Step>, [f64; INPUTS])> {
    let inputs = prop::array::uniform4(prop_oneof![4 => -3.0..3.0, 1 => Just(0.0)]);
    (prop::collection::vec(step(), 1..60), inputs).prop_map(|(steps, inputs)| {
        let mut values = inputs.to_vec();
        let mut kept = Vec::new();
        for step in steps {
            let value: f64 = step.run(&values);
            if value.is_finite() {
                values.push(value);
                kept.push(step);
            }
        }
        (kept, inputs)
    })
}

fn run<R: Real>(steps: &[Step], inputs: &[R]) -> Vec<R> {
    let mut values = inputs.to_vec();
    for step in steps {
        values.push(step.run(&values));
    }
    values
}

/// The last few values.
fn results<R: Real>(steps: &[Step], inputs: &[R]) -> Vec<R> {
    let values = run(steps, inputs);
    values[values.len().saturating_sub(3)..].to_vec()
}

fn is_zero(node: Node) -> bool {
    matches!(node, Node::Constant(bits) if f64::from_bits(bits) == 0.0)
}

proptest! {
    #[test]
    fn an_interpreted_graph_gives_the_values_of_the_computation(
        (steps, inputs) in computation()
    ) {
        let graph = Graph::trace(INPUTS, |inputs| run(&steps, inputs));
        prop_assert_eq!(graph.evaluate(&inputs), run(&steps, &inputs));
    }

    #[test]
    fn pinned_inputs_vanish_and_change_no_value(
        (steps, inputs) in computation(),
        pins in prop::array::uniform4(any::<bool>()),
    ) {
        let assumptions: Vec<Option<f64>> =
            inputs.iter().zip(pins).map(|(&value, pin)| pin.then_some(value)).collect();
        let graph = Graph::trace_with(&assumptions, |inputs| run(&steps, inputs));
        for (_, node) in graph.nodes() {
            prop_assert!(!matches!(node, Node::Input(i) if pins[i as usize]));
        }
        let poisoned: Vec<f64> =
            inputs.iter().zip(pins).map(|(&value, pin)| if pin { f64::NAN } else { value }).collect();
        prop_assert_eq!(graph.evaluate(&poisoned), run(&steps, &inputs));
    }

    #[test]
    fn every_node_is_needed_new_and_after_its_operands((steps, _) in computation()) {
        let graph = Graph::trace(INPUTS, |inputs| results(&steps, inputs));
        prop_assert!(graph.uses().iter().all(|&uses| uses > 0));
        let nodes: Vec<Node> = graph.nodes().map(|(_, node)| node).collect();
        for (i, node) in nodes.iter().enumerate() {
            prop_assert!(node.operands().all(|operand| operand.index() < i));
            prop_assert!(!nodes[..i].contains(node));
        }
    }

    #[test]
    fn nothing_is_left_that_could_have_been_folded((steps, _) in computation()) {
        let graph = Graph::trace(INPUTS, |inputs| results(&steps, inputs));
        for (_, node) in graph.nodes() {
            let of_zero = node.operands().any(|id| is_zero(graph.node(id)));
            prop_assert!(!of_zero || matches!(node, Node::Div(..)), "{:?}", node);
            let constants =
                node.operands().filter(|id| matches!(graph.node(*id), Node::Constant(_))).count();
            let operands = node.operands().count();
            prop_assert!(operands == 0 || constants < operands, "{:?}", node);
            let of_neg = node.operands().any(|id| matches!(graph.node(id), Node::Neg(_)));
            let may_be_of_neg = matches!(node, Node::Sqrt(_) | Node::Sin(_) | Node::Cos(_));
            prop_assert!(!of_neg || may_be_of_neg, "{:?}", node);
        }
    }

    #[test]
    fn what_depends_on_no_input_that_varies_is_the_same_for_all_of_its_values(
        (steps, inputs) in computation()
    ) {
        let graph = Graph::trace(INPUTS, |inputs| run(&steps, inputs));
        let varies = graph.depends_on(|input| input == 0);
        let mut other = inputs;
        other[0] += 1.0;
        let (before, after) = (graph.evaluate(&inputs), graph.evaluate(&other));
        for ((id, before), after) in graph.outputs().iter().zip(before).zip(after) {
            prop_assert!(varies[id.index()] || before == after);
        }
    }
}

/// The graph of one result.
fn one(computation: impl FnOnce(&[Expr]) -> Expr) -> Graph {
    Graph::trace(2, |inputs| vec![computation(inputs)])
}

fn result(graph: &Graph) -> Node {
    graph.node(graph.outputs()[0])
}

#[test]
fn zeros_and_ones_are_folded() {
    let zero = Expr::zero;
    assert!(is_zero(result(&one(|x| x[0] * zero()))));
    assert!(is_zero(result(&one(|x| zero() * x[0]))));
    assert!(is_zero(result(&one(|x| zero() / x[0]))));
    assert!(is_zero(result(&one(|x| x[0] - x[0]))));
    assert!(is_zero(result(&one(|x| x[0] + -x[0]))));
    assert!(is_zero(result(&one(|_| -Expr::zero()))));
    let same: [fn(&[Expr]) -> Expr; 8] = [
        |x| x[0] + Expr::zero(),
        |x| Expr::zero() + x[0],
        |x| x[0] - Expr::zero(),
        |x| x[0] * Expr::one(),
        |x| Expr::one() * x[0],
        |x| x[0] / Expr::one(),
        |x| -(-x[0]),
        |x| (x[0] * Expr::constant(-1.0)) / Expr::constant(-1.0),
    ];
    for computation in same {
        let graph = one(computation);
        assert_eq!(result(&graph), Node::Input(0));
        assert_eq!(graph.nodes().count(), 1);
    }
}

#[test]
fn signs_move_outward() {
    type Pair = fn(&[Expr]) -> [Expr; 2];
    // What each becomes: the other one, recorded in the same graph, is the same node.
    let pairs: [Pair; 10] = [
        |x| [-x[0] + x[1], x[1] - x[0]],
        |x| [x[0] + -x[1], x[0] - x[1]],
        |x| [-x[0] + -x[1], -(x[0] + x[1])],
        |x| [x[0] - -x[1], x[0] + x[1]],
        |x| [-x[0] - x[1], -(x[0] + x[1])],
        |x| [-(x[0] - x[1]), x[1] - x[0]],
        |x| [-x[0] * x[1], -(x[0] * x[1])],
        |x| [-x[0] * -x[1], x[0] * x[1]],
        |x| [-x[0] / x[1], -(x[0] / x[1])],
        |x| [Expr::zero() - x[0], -x[0]],
    ];
    for (i, pair) in pairs.into_iter().enumerate() {
        let graph = Graph::trace(2, |x| pair(x).to_vec());
        assert_eq!(graph.outputs()[0], graph.outputs()[1], "pair {i}");
    }
}

#[test]
fn operands_commute_and_equal_nodes_are_one() {
    let graph =
        Graph::trace(2, |x| vec![x[0] + x[1], x[1] + x[0], x[0] * x[1], x[1] * x[0], x[0] - x[1]]);
    assert_eq!(graph.outputs()[0], graph.outputs()[1]);
    assert_eq!(graph.outputs()[2], graph.outputs()[3]);
    assert_eq!(graph.nodes().count(), 5);
}

#[test]
fn dead_nodes_are_removed() {
    let graph = one(|x| {
        let _ = (x[0] / x[1]).sqrt();
        let (_, cos) = x[1].sin_cos();
        cos
    });
    let nodes: Vec<Node> = graph.nodes().map(|(_, node)| node).collect();
    assert!(matches!(nodes[..], [Node::Input(1), Node::Cos(_)]), "{nodes:?}");
    assert_eq!(graph.inputs(), 2);
}

#[test]
fn operations_are_counted_by_kind_and_angles_once() {
    let graph = one(|x| {
        let (sin, cos) = x[0].sin_cos();
        ((sin * x[1] + cos) / (x[1] - cos)).sqrt() + Expr::constant(2.0)
    });
    let expected =
        Operations { additions: 3, multiplications: 1, divisions: 1, square_roots: 1, angles: 1 };
    assert_eq!(graph.operations(), expected);
    assert_eq!(expected.flops(), 5);
    assert_eq!(expected.to_string(), "3 add, 1 mul, 1 div, 1 sqrt, 1 sin_cos");
    let varies = graph.depends_on(|input| input == 0);
    assert_eq!(graph.operations_of(|i| !varies[i]), Operations::default());
    assert_eq!(expected + Operations::default(), expected);
}

#[test]
#[should_panic(expected = "Expr is used only inside Graph::trace")]
fn a_constant_outside_of_a_trace_panics() {
    let _ = Expr::constant(1.0);
}

#[test]
#[should_panic(expected = "Expr is used only inside Graph::trace")]
fn an_expression_that_escapes_its_trace_cannot_be_used() {
    let mut escaped = None;
    Graph::trace(1, |inputs| {
        escaped = Some(inputs[0]);
        inputs.to_vec()
    });
    let _ = escaped.map(|x| x + x);
}

#[test]
#[should_panic(expected = "one value for each input")]
fn a_graph_wants_a_value_for_each_input() {
    one(|x| x[0]).evaluate(&[1.0]);
}
