use super::{TOLERANCE, stays_below};
use crate::gauge::Gauge;
use crate::nodes::{self, Basis, FINE};
use crate::peak::peak;

/// Most times that the polynomials of an interval are halved, where the place of the largest stress
/// in a section jumps.
const MOST_CUTS: usize = 24;

/// A gauge of polynomials in time.
pub(super) struct Curve<'a> {
    pub basis: &'a Basis<FINE>,
    pub places: &'a [f64; FINE],
    pub gauge: &'a Gauge,
}

impl Curve<'_> {
    /// Raises `largest`, and sets its place, to the largest value of the gauge over a part of the
    /// interval, where the polynomials have these coefficients and these numbers at the places.
    ///
    /// The square of a gauge is smooth wherever the place of the largest stress does not jump; the
    /// largest value of a polynomial through it is then the result. Where the place jumps the
    /// square has a corner, which may be a minimum but no maximum. Halving closes in on it until
    /// only the ends are left.
    pub fn climb(
        &self,
        coefficients: &[[f64; 6]; FINE],
        numbers: &[[f64; 6]; FINE],
        [from, to]: [f64; 2],
        cuts: usize,
        slack: f64,
        found: &mut (&mut f64, &mut Option<f64>),
    ) {
        let Self { basis, places, gauge } = self;
        let time = |x: f64| from + (to - from) * x;
        let raise = |value: f64, x: f64, found: &mut (&mut f64, &mut Option<f64>)| {
            if value > *found.0 {
                (*found.0, *found.1) = (value, Some(time(x)));
            }
        };
        let values: [f64; FINE] = std::array::from_fn(|k| gauge.value(&numbers[k]));
        places.iter().zip(values).for_each(|(&x, value)| raise(value, x, found));
        let unit = *found.0;
        let squares = values.map(|value| [(value / unit).powi(2)]);
        let left_out: f64 = basis.tails(&squares).iter().map(|[tail]| tail.abs()).sum();
        // Where numbers overflow it is none, and halves would be no better.
        let is_rough = left_out > TOLERANCE;
        if !is_rough || cuts == MOST_CUTS {
            let of_squares = basis.coefficients(&squares).map(|[c]| c);
            if let Some(x) = peak(&of_squares, 1.0 + TOLERANCE) {
                raise(gauge.value(&nodes::value(coefficients, x)), x, found);
            }
            return;
        }
        let middle = 0.5 * (from + to);
        for (half, part) in nodes::halves(coefficients).iter().zip([[from, middle], [middle, to]]) {
            if !stays_below(gauge, half, &[], *found.0 * (1.0 + TOLERANCE) + slack) {
                let numbers = places.map(|x| nodes::value(half, x));
                self.climb(half, &numbers, part, cuts + 1, slack, found);
            }
        }
    }
}
