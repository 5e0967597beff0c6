//! Regrouped sums have the same value to rounding, wait less, and are computed once where they
//! are used twice.

use nboom_expr::{Expr, Graph, Id, Node};
use nboom_scalar::Real;

/// Steps from inputs to the last result, a sum or a product each.
fn depth(graph: &Graph) -> usize {
    let mut depths: Vec<usize> = Vec::new();
    for (_, node) in graph.nodes() {
        let deepest = node.operands().map(|id| depths[id.index()]).max();
        depths.push(deepest.map_or(0, |deepest| deepest + 1));
    }
    graph.outputs().iter().map(|id| depths[id.index()]).max().unwrap_or(0)
}

fn regrouped(graph: &Graph) -> Graph {
    graph.regrouped(&graph.depends_on(|_| true))
}

fn inputs(count: usize) -> Vec<f64> {
    (0..count).map(|i| (1.7 * i as f64 + 0.4).sin()).collect()
}

/// Signs +, −, + and so on.
fn alternating(x: &[Expr]) -> Expr {
    let terms = x.iter().enumerate();
    terms.fold(Expr::zero(), |sum, (i, &x)| if i % 2 == 0 { sum + x } else { sum - x })
}

#[test]
fn terms_that_are_ready_together_are_added_in_pairs() {
    let chain = Graph::trace(16, |x| vec![alternating(x)]);
    let tree = regrouped(&chain);
    assert_eq!((depth(&chain), depth(&tree)), (15, 4));
    let (x, sum) = (inputs(16), |graph: &Graph| graph.evaluate(&inputs(16))[0]);
    let magnitude: f64 = x.iter().map(|x| x.abs()).sum();
    assert!((sum(&chain) - sum(&tree)).abs() < 16.0 * f64::EPSILON * magnitude);
}

#[test]
fn a_late_term_comes_last() {
    let late = |x: &[Expr]| {
        let late = x[0].sin_cos().0;
        late + x[1] + x[2] + x[3]
    };
    let graph = regrouped(&Graph::trace(4, |x| vec![late(x)]));
    let Node::Add(a, b) = graph.node(graph.outputs()[0]) else { panic!("a sum") };
    let is_sine = |id: Id| matches!(graph.node(id), Node::Sin(_));
    assert!(is_sine(a) || is_sine(b));
}

#[test]
fn a_sum_used_twice_is_computed_once() {
    let graph = Graph::trace(4, |x| {
        let shared = x[0] + x[1] + x[2];
        vec![shared + x[3], shared * shared]
    });
    let operations = |graph: &Graph| {
        let of = graph.operations_of(|_| true);
        (of.additions, of.multiplications)
    };
    assert_eq!(operations(&regrouped(&graph)), operations(&graph));
}

#[test]
fn any_graph_keeps_its_values() {
    let graph = Graph::trace(12, |x| {
        let mut made = x.to_vec();
        for i in 0..300 {
            let (a, b, c) = (made[i % made.len()], made[i * 7 % made.len()], x[i * 5 % 12]);
            made.push(match i % 6 {
                0 => a + b - c,
                1 => c - (a - b),
                2 => (a * b + c * c) * c,
                3 => -(a * c) - b,
                4 => a.sin_cos().1 * b,
                _ => (a - b) / (c * c + Expr::one()),
            });
        }
        made[made.len() - 20..].to_vec()
    });
    let (found, expected) = (regrouped(&graph).evaluate(&inputs(12)), graph.evaluate(&inputs(12)));
    for (found, expected) in found.iter().zip(&expected) {
        // Some hundred roundings, none of them magnified by much.
        assert!((found - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{found} {expected}");
    }
}
