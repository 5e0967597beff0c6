use nboom_scalar::Real;

use crate::{Graph, Id, Node};

impl Node {
    /// Its value, where those of its operands are `of` and those of all inputs are `inputs`.
    pub fn value<R: Real>(self, inputs: &[R], of: impl Fn(Id) -> R) -> R {
        match self {
            Self::Input(i) => inputs[i as usize],
            Self::Constant(bits) => R::constant(f64::from_bits(bits)),
            Self::Add(a, b) => of(a) + of(b),
            Self::Sub(a, b) => of(a) - of(b),
            Self::Mul(a, b) => of(a) * of(b),
            Self::Div(a, b) => of(a) / of(b),
            Self::Neg(a) => -of(a),
            Self::Sqrt(a) => of(a).sqrt(),
            Self::Sin(a) => of(a).sin_cos().0,
            Self::Cos(a) => of(a).sin_cos().1,
        }
    }
}

impl Graph {
    /// The results for these inputs, node by node.
    ///
    /// # Panics
    /// When `inputs` has another length than the graph was traced with.
    pub fn evaluate<R: Real>(&self, inputs: &[R]) -> Vec<R> {
        assert_eq!(inputs.len(), self.inputs(), "one value for each input");
        let mut values: Vec<R> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            values.push(node.value(inputs, |id| values[id.index()]));
        }
        self.outputs.iter().map(|id| values[id.index()]).collect()
    }
}
