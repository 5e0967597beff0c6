//! What a computation says of its parts stays with their nodes.

use nboom_expr::{Expr, Graph, Id};
use nboom_scalar::{Dual, Real};

/// For each node what was said before it.
fn remarks(graph: &Graph) -> Vec<Option<&str>> {
    let of_node = |(id, _): (Id, _)| graph.remark(graph.part(id));
    graph.nodes().map(of_node).collect()
}

/// (a + b)² − c, with a remark before each operation.
fn computation(x: &[Expr]) -> Vec<Expr> {
    let say = |words: &str| Expr::remark(|| words.to_owned());
    say("A sum.");
    let sum = x[0] + x[1];
    say("Its square.");
    let square = sum * sum;
    // The same node again stays where it is.
    let again = x[0] + x[1];
    say("Not needed.");
    let _ = again * x[2];
    say("A difference.");
    vec![square - x[2]]
}

#[test]
fn nodes_come_under_the_remark_before_them() {
    let graph = Graph::trace(3, computation);
    let said = ["A sum.", "Its square.", "A difference."].map(Some);
    assert_eq!(remarks(&graph), [&[None; 3][..], &said].concat());
    let regrouped = graph.regrouped(&graph.depends_on(|_| true));
    assert_eq!(remarks(&regrouped), remarks(&graph));
}

#[test]
fn a_dual_number_hands_remarks_on() {
    let graph = Graph::trace(1, |x| {
        Dual::<Expr>::remark(|| "A square.".to_owned());
        let x = Dual { value: x[0], derivative: Expr::one() };
        vec![(x * x).derivative]
    });
    assert_eq!(remarks(&graph).last(), Some(&Some("A square.")));
}
