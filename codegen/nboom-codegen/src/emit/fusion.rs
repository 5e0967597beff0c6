use nboom_expr::{Graph, Id, Node};

/// A product and the sum it goes into, taken together.
#[derive(Clone, Copy)]
pub(crate) enum Fusion {
    /// The product: part of another node.
    Inside,
    /// term ± a b
    Outside { negative: bool, a: Id, b: Id, term: Id },
    /// a b − term
    Less { a: Id, b: Id, term: Id },
}

/// What each of the `wanted` nodes is fused with: a product that one sum uses and nothing else.
pub(crate) fn fusions(graph: &Graph, wanted: &[bool]) -> Vec<Option<Fusion>> {
    let uses = graph.uses();
    let mut fused: Vec<Option<Fusion>> = vec![None; wanted.len()];
    let product = |id: Id, fused: &[Option<Fusion>]| match graph.node(id) {
        Node::Mul(a, b)
            if uses[id.index()] == 1 && wanted[id.index()] && fused[id.index()].is_none() =>
        {
            Some((a, b))
        }
        _ => None,
    };
    for (id, node) in graph.nodes().filter(|(id, _)| wanted[id.index()]) {
        let (fusion, inside) = match node {
            Node::Add(x, y) => match (product(x, &fused), product(y, &fused)) {
                (_, Some((a, b))) => (Fusion::Outside { negative: false, a, b, term: x }, y),
                (Some((a, b)), None) => (Fusion::Outside { negative: false, a, b, term: y }, x),
                (None, None) => continue,
            },
            Node::Sub(x, y) => match (product(x, &fused), product(y, &fused)) {
                (_, Some((a, b))) => (Fusion::Outside { negative: true, a, b, term: x }, y),
                (Some((a, b)), None) => (Fusion::Less { a, b, term: y }, x),
                (None, None) => continue,
            },
            _ => continue,
        };
        fused[inside.index()] = Some(Fusion::Inside);
        fused[id.index()] = Some(fusion);
    }
    fused
}
