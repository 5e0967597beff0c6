/// A torque about a hinge as a function of its angle, given at points; `docs/equations.md` says how
/// it runs between them.
#[derive(Clone, Debug, PartialEq)]
pub struct TorqueTable {
    /// Index of the hinge, from 0.
    pub hinge: usize,
    /// Angles \[rad\], ascending, each with its torque, positive when it increases the angle; at
    /// least two.
    pub points: Vec<[f64; 2]>,
}

impl TorqueTable {
    /// The slope of the torque at each point \[torque/rad\]: zero at a turn, else between those of the two secants, at
    /// the ends that of a parabola (Fritsch and Butland). Before the first point and beyond the last one it stays.
    pub fn slopes(&self) -> Vec<f64> {
        let points = &self.points;
        let secant = |pair: &[[f64; 2]]| (pair[1][1] - pair[0][1]) / (pair[1][0] - pair[0][0]);
        let secants: Vec<f64> = points.windows(2).map(secant).collect();
        let widths: Vec<f64> = points.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
        let inner = (0..secants.len() - 1).map(|k| {
            let ([a, b], [h, g]) = ([secants[k], secants[k + 1]], [widths[k], widths[k + 1]]);
            let (of_a, of_b) = (2.0 * g + h, g + 2.0 * h);
            if a * b <= 0.0 { 0.0 } else { (of_a + of_b) / (of_a / a + of_b / b) }
        });
        let [first, last] = self.end_slopes();
        [first].into_iter().chain(inner).chain([last]).collect()
    }

    /// The [slopes](Self::slopes) at the first and at the last point.
    fn end_slopes(&self) -> [f64; 2] {
        let secant = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]) / (b[0] - a[0]);
        let width = |a: [f64; 2], b: [f64; 2]| (b[0] - a[0]).abs();
        let slope = |inward: &mut dyn Iterator<Item = &[f64; 2]>| {
            let mut point = || inward.next().copied();
            match [point(), point(), point()] {
                [Some(a), Some(b), Some(c)] => {
                    end_slope([secant(a, b), secant(b, c)], [width(a, b), width(b, c)])
                }
                [Some(a), Some(b), None] => secant(a, b),
                _ => 0.0,
            }
        };
        [slope(&mut self.points.iter()), slope(&mut self.points.iter().rev())]
    }

    /// Whether an angle is beyond one of its ends, where the torque stays the same.
    pub fn is_level_beyond(&self, beta: f64) -> bool {
        let ends = [self.points.first(), self.points.last()];
        let [Some([first, _]), Some([last, _])] = ends else { return false };
        let [before, after] = self.end_slopes();
        (before == 0.0 && beta <= *first) || (after == 0.0 && beta >= *last)
    }

    /// The torque at this angle by these [slopes](Self::slopes).
    pub(crate) fn at(&self, slopes: &[f64], beta: f64) -> f64 {
        let points = &self.points;
        let tangent = |k: usize| points[k][1] + slopes[k] * (beta - points[k][0]);
        match points.partition_point(|point| point[0] < beta) {
            0 => tangent(0),
            after if after == points.len() => tangent(after - 1),
            after => {
                let (from, [c0, c1, c2, c3]) = self.cubic(slopes, after - 1);
                let x = beta - from;
                ((c3 * x + c2) * x + c1) * x + c0
            }
        }
    }

    /// The cubic from point `k` to the next one by these [slopes](Self::slopes): the angle \[rad\] from which it counts,
    /// and its coefficients, that of the torque itself first.
    ///
    /// # Panics
    /// When there is no next point.
    pub fn cubic(&self, slopes: &[f64], k: usize) -> (f64, [f64; 4]) {
        let ([from, torque], [to, next]) = (self.points[k], self.points[k + 1]);
        let (h, d0, d1) = (to - from, slopes[k], slopes[k + 1]);
        let secant = (next - torque) / h;
        let (c2, c3) = ((3.0 * secant - 2.0 * d0 - d1) / h, (d0 + d1 - 2.0 * secant) / (h * h));
        (from, [torque, d0, c2, c3])
    }
}

/// The slope at an end by the parabola through three points, held to where the cubic is monotone;
/// secants and widths from the end inward.
fn end_slope([a, b]: [f64; 2], [h, g]: [f64; 2]) -> f64 {
    let slope = ((2.0 * h + g) * a - h * b) / (h + g);
    if slope * a <= 0.0 {
        0.0
    } else if a * b <= 0.0 && slope.abs() > 3.0 * a.abs() {
        3.0 * a
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_level_beyond_an_end_whose_torque_stays() {
        let is_level = |points: &[[f64; 2]]| {
            let table = TorqueTable { hinge: 0, points: points.to_vec() };
            [-1.0, 0.0, 0.5, 2.0, 3.0].map(|beta| table.is_level_beyond(beta))
        };
        assert_eq!(is_level(&[[0.0, 2.0], [2.0, 2.0]]), [true, true, false, true, true]);
        assert_eq!(is_level(&[[0.0, 2.0], [2.0, 3.0]]), [false; 5]);
        let rises_first = [[0.0, 0.0], [0.5, 2.0], [1.0, 2.0], [2.0, 2.0]];
        assert_eq!(is_level(&rises_first), [false, false, false, true, true]);
        let rises_last = [[0.0, 1.0], [1.0, 1.0], [2.0, 4.0]];
        assert_eq!(is_level(&rises_last), [true, true, false, false, false]);
    }
}
