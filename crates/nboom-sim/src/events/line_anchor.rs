use nboom_dynamics::LineJoint;
use nboom_model::Joint;

/// Where a line's length was computed last. Nearby it cannot come to its limit.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineAnchor {
    /// By how much it was longer or shorter than its limit there, or less.
    away: f64,
    /// The angles there, of the hinges that move the line, inward.
    angles: Vec<f64>,
}

/// Share of a length that covers the rounding of one that is computed.
const ROUNDING: f64 = 1e-12;

impl LineAnchor {
    /// Forgets where that was; makes room for so many hinges.
    pub fn begin(&mut self, hinges: usize) {
        self.away = 0.0;
        self.angles.clear();
        self.angles.reserve(hinges);
    }

    /// Notes a length beside its limit, and the angles at which it was found.
    pub fn note(&mut self, [length, limit]: [f64; 2], angles: impl Iterator<Item = f64>) {
        self.away = (length - limit).abs() - ROUNDING * (length + limit);
        self.angles.clear();
        self.angles.extend(angles);
    }

    /// Whether the length keeps its side of the limit over a step, by how far the hinges come from where they were:
    /// the line's end moves at most by the sum of these ways, each times its distance from the hinge.
    /// `farthest` has the distance of a free hinge from an angle over the step, or more.
    pub fn keeps_side(
        &self,
        joints: impl Iterator<Item = LineJoint<f64>>,
        mut farthest: impl FnMut(usize, f64) -> f64,
    ) -> bool {
        let (mut from_end, mut displaced) = (0.0, 0.0);
        if self.away <= 0.0 {
            return false;
        }
        for (LineJoint { position, joint, arm }, &anchor) in joints.zip(&self.angles) {
            let moved = farthest(position, anchor);
            from_end += arm;
            match joint {
                Joint::Revolute => displaced += moved * from_end,
                Joint::Prismatic => {
                    displaced += moved;
                    from_end += anchor.abs() + moved;
                }
            }
        }
        displaced < self.away
    }
}
