use std::f64::consts::{PI, TAU};

use nboom_dynamics::{LineCircle, Recursive};
use nboom_ode::Bernstein;
use nboom_scalar::Number;

/// The angles of one hinge over which a line that it alone moves stays on one side of a limit.
///
/// The square of the length is a + r cos(β − φ), so that the limit is a pair of angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct AngleRange {
    /// Position among the free hinges.
    pub hinge: usize,
    low: f64,
    high: f64,
}

/// Closer than this to the longest or shortest length in units of r, a limit is as good as touched.
const TOUCHED: f64 = 1e-4;

/// Share of the square of the length below which the hinge hardly changes it. Beyond this and what is
/// touched, the angles of the limit are known to a few 1e-12 radians, less than turns in an instant.
const NO_RADIUS: f64 = 1e-2;

impl AngleRange {
    /// That of `line`, whose length is below (`side` < 0) or above `limit` with the hinge at `beta`. `None`
    /// where other hinges move the line too, where the hinge slides, and where rounding decides whether it comes to the limit.
    pub fn of<R: Number>(
        dynamics: &Recursive<R>,
        (line, limit): (usize, f64),
        beta: impl Fn(usize) -> f64,
        side: f64,
    ) -> Option<Self> {
        let LineCircle { position: hinge, mean, along_cos, along_sin } =
            dynamics.line_circle(line)?;
        let [mean, along_cos, along_sin] = [mean, along_cos, along_sin].map(R::to_f64);
        let radius = along_cos.hypot(along_sin);
        let cosine = (limit * limit - mean) / radius;
        let hardly_moves = radius <= NO_RADIUS * mean.max(limit * limit);
        // Beyond one the limit is out of reach; near one rounding tells.
        if hardly_moves || (cosine.abs() - 1.0).abs() < TOUCHED {
            return None;
        }
        if cosine.abs() > 1.0 {
            return Some(Self { hinge, low: f64::NEG_INFINITY, high: f64::INFINITY });
        }
        let (beta, phase) = (beta(hinge), along_sin.atan2(along_cos));
        let (half, from_longest) = (cosine.acos(), (beta - phase).rem_euclid(TAU));
        let [low, high] = if side < 0.0 {
            [half - from_longest, TAU - half - from_longest]
        } else {
            let from_longest = if from_longest > PI { from_longest - TAU } else { from_longest };
            [-half - from_longest, half - from_longest]
        };
        (low < 0.0 && 0.0 < high).then_some(Self { hinge, low: beta + low, high: beta + high })
    }

    /// The angles where it ends, each with the sign of what is inside.
    pub fn ends(&self) -> [(f64, f64); 2] {
        [(self.low, 1.0), (self.high, -1.0)]
    }

    /// Where on [0, 1] an angle leaves the range.
    pub fn left_by(&self, angle: &Bernstein) -> Option<f64> {
        let ends = self.ends().map(|(level, side)| angle.leaves(level, side));
        ends.into_iter().flatten().reduce(f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_angle_that_swings_beyond_both_ends_leaves_at_the_first() {
        let range = AngleRange { hinge: 0, low: -1.0, high: 1.0 };
        // c x (x − 1/2) (x − 1) swings to ∓1.5 where its slope is zero.
        let first = 0.5 - 1.0 / 12.0_f64.sqrt();
        let swinging = |sign: f64| {
            let c = sign * 1.5 / (first * (first - 0.5) * (first - 1.0));
            Bernstein::of_powers(&[0.0, 0.5 * c, -1.5 * c, c])
        };
        for angle in [swinging(1.0), swinging(-1.0)] {
            let left = range.left_by(&angle).expect("it is beyond both");
            assert!(left < first, "{left}");
            // The ends are simple zeros, found to rounding.
            assert!((angle.at(left).abs() - 1.0).abs() < 1e-12, "{left}");
        }
    }
}
