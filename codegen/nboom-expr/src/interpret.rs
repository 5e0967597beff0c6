use nboom_scalar::Real;

use crate::{Graph, Node};

impl Graph {
    /// The results for these inputs, node by node.
    ///
    /// # Panics
    /// When `inputs` has another length than the graph was traced with.
    pub fn evaluate<R: Real>(&self, inputs: &[R]) -> Vec<R> {
        assert_eq!(inputs.len(), self.inputs(), "one value for each input");
        let mut values: Vec<R> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let of = |id: crate::Id| values[id.index()];
            let value = match *node {
                Node::Input(i) => inputs[i as usize],
                Node::Constant(bits) => R::constant(f64::from_bits(bits)),
                Node::Add(a, b) => of(a) + of(b),
                Node::Sub(a, b) => of(a) - of(b),
                Node::Mul(a, b) => of(a) * of(b),
                Node::Div(a, b) => of(a) / of(b),
                Node::Neg(a) => -of(a),
                Node::Sqrt(a) => of(a).sqrt(),
                Node::Sin(a) => of(a).sin_cos().0,
                Node::Cos(a) => of(a).sin_cos().1,
            };
            values.push(value);
        }
        self.outputs.iter().map(|id| values[id.index()]).collect()
    }
}
