use nboom_scalar::Real;
use tables::{BINOMIALS, TERM_COEFFICIENTS, binomial};

mod tables;

/// Highest degree of a polynomial.
pub(crate) const HIGHEST: usize = 24;

/// Width below which an interval counts as a point, in parts of the whole.
const RESOLUTION: f64 = 1e-14;

/// Width below which a polynomial is flat about an extreme, in parts of the whole.
const FLAT: f64 = 1e-8;

/// A polynomial on [0, 1] by its Bernstein coefficients, between whose extremes it lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bernstein {
    degree: usize,
    coefficients: [f64; HIGHEST + 1],
}

impl Bernstein {
    /// The polynomial with these coefficients, whose degree is one less than their number.
    ///
    /// # Panics
    /// Without coefficients, or with more than 25.
    pub fn new(coefficients: &[f64]) -> Self {
        let mut all = [0.0; HIGHEST + 1];
        all[..coefficients.len()].copy_from_slice(coefficients);
        Self { degree: coefficients.len() - 1, coefficients: all }
    }

    /// start + x (c₀ + x̄ (c₁ + x (c₂ + x̄ (…)))) with x̄ = 1 − x, as dense output of
    /// Runge-Kutta methods is written.
    pub(crate) fn of_terms(start: f64, terms: &[f64]) -> Self {
        let degree = terms.len();
        let mut coefficients = [0.0; HIGHEST + 1];
        coefficients[..=degree].fill(start);
        for (row, c) in TERM_COEFFICIENTS[degree].iter().zip(terms) {
            for (sum, weight) in coefficients[..=degree].iter_mut().zip(row) {
                *sum += c * weight;
            }
        }
        Self { degree, coefficients }
    }

    /// Its value at `x`, or those at several places side by side: on [0, 1] a sum of coefficients by positive shares, so
    /// that it errs by rounding alone.
    #[inline(always)]
    pub fn at<R: Real>(&self, x: R) -> R {
        let (rest, powers) = (R::one() - x, powers(x, self.degree));
        let (mut sum, mut power_of_rest) = (R::zero(), R::one());
        for k in (0..=self.degree).rev() {
            let weighted = R::constant(BINOMIALS[self.degree][k] * self.coefficients[k]);
            sum = (powers[k] * power_of_rest).mul_add(weighted, sum);
            power_of_rest = power_of_rest * rest;
        }
        sum
    }

    /// Σ c_k xᵏ, whose degree is one less than the number of coefficients.
    ///
    /// # Panics
    /// Without coefficients, or with more than 25.
    pub fn of_powers(coefficients: &[f64]) -> Self {
        let mut found = Self::new(coefficients);
        let degree = found.degree;
        for (k, c) in found.coefficients[..=degree].iter_mut().enumerate() {
            *c /= binomial(degree, k);
        }
        // Σ_k C(j, k) d_k for each j, as the j-th numbers of a table of sums.
        for level in 1..=degree {
            for j in (level..=degree).rev() {
                found.coefficients[j] += found.coefficients[j - 1];
            }
        }
        found
    }

    /// Its coefficients; the first and last are its values at 0 and 1.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients[..=self.degree]
    }

    /// The polynomial lowered by `level`.
    pub fn minus(mut self, level: f64) -> Self {
        self.coefficients.iter_mut().for_each(|c| *c -= level);
        self
    }

    /// A bound on the distance from its value at 0, over [0, 1].
    pub fn excursion(&self) -> f64 {
        let start = self.coefficients[0];
        self.coefficients().iter().map(|c| (c - start).abs()).fold(0.0, f64::max)
    }

    /// The polynomial divided by its variable, its value at 0 being taken for zero.
    pub fn without_root_at_start(&self) -> Self {
        let mut coefficients = [0.0; HIGHEST + 1];
        let degree = self.degree.max(1) - 1;
        for (j, c) in coefficients[..=degree].iter_mut().enumerate() {
            *c = self.coefficients[j + 1] * self.degree as f64 / (j + 1) as f64;
        }
        Self { degree, coefficients }
    }

    /// The first point of [0, 1] beyond which the polynomial, times `side`, is negative.
    ///
    /// Touching zero without going through is not a change of side.
    pub fn leaves_side(&self, side: f64) -> Option<f64> {
        if self.coefficients().iter().all(|c| c * side >= 0.0) {
            return None;
        }
        let mut scaled = *self;
        scaled.coefficients.iter_mut().for_each(|c| *c *= side);
        scaled.first_negative(0.0, 1.0)
    }

    /// The first point of [0, 1] beyond which the polynomial is on the other side of `level`, `side` being the
    /// sign of their difference before.
    pub fn leaves(&self, level: f64, side: f64) -> Option<f64> {
        if self.coefficients().iter().all(|c| (c - level) * side >= 0.0) {
            return None;
        }
        self.minus(level).leaves_side(side)
    }

    /// Where on [0, `end`] the polynomial is nearest to `level`, on the side of it that has the sign `side`, and
    /// its distance there, negative beyond. An extreme between the ends is found to 1e-8 of the way, over which it is
    /// flat to rounding.
    pub fn nearest(&self, level: f64, side: f64, end: f64) -> (f64, f64) {
        let above = |c: f64| (c - level) * side;
        // Mostly it comes nearer all the way, or goes away.
        if end <= 1.0 && self.is_monotone() {
            let [first, last] = [self.coefficients[0], self.at(end)].map(above);
            return if last < first { (end, last) } else { (0.0, first) };
        }
        let mut from_level = if end == 1.0 { *self } else { self.until(end) };
        from_level.coefficients.iter_mut().for_each(|c| *c = above(*c));
        let [first, last] = [0, self.degree].map(|k| from_level.coefficients[k]);
        let mut least = if last < first { (1.0, last) } else { (0.0, first) };
        from_level.find_less(0.0, 1.0, &mut least);
        (least.0 * end, least.1)
    }

    /// Whether the coefficients never turn back, so that the polynomial does not.
    fn is_monotone(&self) -> bool {
        let c = self.coefficients();
        c.is_sorted() || c.is_sorted_by(|a, b| a >= b)
    }

    /// Takes the place of the least value into `least`, if it is less than what is there. This is the part of a
    /// polynomial on [`from`, `to`], whose values at these are there already.
    fn find_less(&self, from: f64, to: f64, least: &mut (f64, f64)) {
        if to - from < FLAT || self.coefficients().iter().all(|&c| c >= least.1) {
            return;
        }
        let (middle, (left, right)) = (0.5 * (from + to), self.halves());
        if right.coefficients[0] < least.1 {
            *least = (middle, right.coefficients[0]);
        }
        left.find_less(from, middle, least);
        right.find_less(middle, to, least);
    }

    fn first_negative(&self, from: f64, to: f64) -> Option<f64> {
        let c = self.coefficients();
        if c.iter().all(|&c| c >= 0.0) {
            return None;
        }
        if c[0] < 0.0 {
            return Some(from);
        }
        if to - from < RESOLUTION {
            return (c[self.degree] < 0.0).then_some(from);
        }
        if self.changes_sign_once() {
            return Some(from + (to - from) * self.only_root());
        }
        let middle = 0.5 * (from + to);
        let (left, right) = self.halves();
        left.first_negative(from, middle).or_else(|| right.first_negative(middle, to))
    }

    /// Whether the coefficients, the first of which is not negative, change sign once, and the
    /// polynomial therefore does (Descartes).
    fn changes_sign_once(&self) -> bool {
        let c = self.coefficients();
        let first = c.iter().position(|&c| c < 0.0).unwrap_or(c.len());
        c[..first].iter().any(|&c| c > 0.0) && c[first..].iter().all(|&c| c <= 0.0)
    }

    /// The root of a polynomial that is positive to the left and negative to the right of it:
    /// Newton's method, with bisection where that does not get on.
    fn only_root(&self) -> f64 {
        let (mut left, mut right) = (0.0, 1.0);
        let (first, last) = (self.coefficients[0], self.coefficients[self.degree]);
        // An end where the value is zero, but for rounding, is not the root.
        let is_between = first > 0.0 && -last > 1e-6 * first;
        let (mut x, mut last_step) =
            if is_between { (first / (first - last), 1.0) } else { (0.5, 0.5) };
        while right - left > RESOLUTION {
            let [value, slope, _] = self.derivatives(x);
            *(if value < 0.0 { &mut right } else { &mut left }) = x;
            let newton = x - value / slope;
            let gets_on = (newton - x).abs() < 0.5 * last_step;
            let inside = left <= newton && newton <= right;
            let next = if gets_on && inside { newton } else { 0.5 * (left + right) };
            last_step = (next - x).abs();
            x = next;
            if last_step < RESOLUTION {
                break;
            }
        }
        x
    }

    /// Value and two derivatives at `x`, on [0, 1] or beyond.
    pub fn derivatives(&self, x: f64) -> [f64; 3] {
        let (c, n) = (self.coefficients(), self.degree);
        let [of_value, of_slope, of_bend] = [n, n.saturating_sub(1), n.saturating_sub(2)];
        let powers = powers(x, n);
        let (mut value, mut slope, mut bend, mut of_rest) = (0.0, 0.0, 0.0, 1.0);
        for k in (0..=n).rev() {
            value += BINOMIALS[of_value][k] * c[k] * powers[k] * of_rest;
            if let Some(j) = k.checked_sub(1) {
                slope += BINOMIALS[of_slope][j] * (c[k] - c[j]) * powers[j] * of_rest;
            }
            if let Some(i) = k.checked_sub(2) {
                let second = (c[k] - c[k - 1]) - (c[k - 1] - c[i]);
                bend += BINOMIALS[of_bend][i] * second * powers[i] * of_rest;
            }
            of_rest *= 1.0 - x;
        }
        let n = n as f64;
        [value, n * slope, n * (n - 1.0) * bend]
    }

    /// The part of the polynomial on [0, `end`], as one on [0, 1] (de Casteljau).
    fn until(&self, end: f64) -> Self {
        let mut part = *self;
        for level in 1..=self.degree {
            for j in (level..=self.degree).rev() {
                part.coefficients[j] =
                    (1.0 - end) * part.coefficients[j - 1] + end * part.coefficients[j];
            }
        }
        part
    }

    /// The polynomial on the left and right half of its interval (de Casteljau).
    fn halves(&self) -> (Self, Self) {
        let (mut left, mut right) = (*self, *self);
        let mut row = self.coefficients;
        for level in 0..=self.degree {
            left.coefficients[level] = row[0];
            right.coefficients[self.degree - level] = row[self.degree - level];
            for j in 0..self.degree - level {
                row[j] = 0.5 * (row[j] + row[j + 1]);
            }
        }
        (left, right)
    }
}

/// Those of `x` up to this one.
#[inline(always)]
fn powers<R: Real>(x: R, highest: usize) -> [R; HIGHEST + 1] {
    let mut powers = [R::one(); HIGHEST + 1];
    for k in 0..highest {
        powers[k + 1] = powers[k] * x;
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Interpolation;

    fn through(f: impl Fn(f64) -> f64) -> Bernstein {
        let interpolation = Interpolation::new();
        interpolation.through(&interpolation.points().map(f))
    }

    #[test]
    fn a_double_crossing_inside_is_seen_at_its_first_root() {
        let dip = through(|x| (x - 0.5) * (x - 0.5001));
        let root = dip.leaves_side(1.0).expect("it dips below zero");
        assert!((root - 0.5).abs() < 1e-10, "{root}");
    }

    #[test]
    fn touching_is_not_crossing() {
        let exact = Bernstein::new(&[0.25, -0.25, 0.25]);
        assert_eq!(exact.leaves_side(1.0), None);
        assert_eq!(through(|x| (x - 0.3).powi(2) + 1e-9).leaves_side(1.0), None);
    }

    #[test]
    fn an_excursion_counts_from_the_start_and_all_the_way() {
        // Largest distances from the value at 0; the first polynomial comes back to it, the second
        // ends nearer to all of its values than it starts.
        for (expected, p) in [
            (0.25, through(|x| 2.0 + x * (1.0 - x))),
            (1.0, through(|x| 1.0 - (1.0 - 1.5 * x).powi(2))),
        ] {
            let (found, start) = (p.excursion(), p.coefficients()[0]);
            assert!(found >= expected - 1e-14, "{found} {expected}");
            // Coefficients of degree 7 bound these to within a sixth.
            assert!(found < 1.2 * expected, "{found} {expected}");
            assert!((0..=20).all(|i| (p.at(f64::from(i) / 20.0) - start).abs() <= found + 1e-14));
        }
    }

    #[test]
    fn the_nearest_place_of_a_part_is_found() {
        // 4 x (1 − x) rises to 1 in the middle; cubes turn back twice.
        let hill = through(|x| 4.0 * x * (1.0 - x));
        let waves = through(|x| (x - 0.2) * (x - 0.5) * (x - 0.9));
        let turns = [0.0_f64, 1.0].map(|k| {
            let (mean, root) = (1.6 / 3.0, (1.6_f64.powi(2) - 3.0 * 0.73).sqrt() / 3.0);
            mean + (2.0 * k - 1.0) * root
        });
        let wave = |x: f64| (x - 0.2) * (x - 0.5) * (x - 0.9);
        let rising = through(|x| x * x);
        // Its coefficients rise, and it turns back just beyond 1.
        let almost = Bernstein::of_powers(&[0.0, 2.0 / 1.004, -1.0 / (1.004 * 1.004)]);
        for (p, level, side, end, place, distance) in [
            (hill, 2.0, -1.0, 1.0, 0.5, 1.0),
            (hill, 2.0, -1.0, 0.25, 0.25, 1.25),
            (hill, 2.0, -1.0, 0.75, 0.5, 1.0),
            (hill, -1.0, 1.0, 1.0, 0.0, 1.0),
            (hill, -1.0, 1.0, 0.75, 0.0, 1.0),
            (waves, 1.0, -1.0, 0.8, turns[0], 1.0 - wave(turns[0])),
            (waves, -1.0, 1.0, 1.0, 0.0, 1.0 + wave(0.0)),
            (waves, 1.0, -1.0, 1.0, 1.0, 1.0 - wave(1.0)),
            (rising, 2.0, -1.0, 1.0, 1.0, 1.0),
            (rising, 2.0, -1.0, 0.5, 0.5, 1.75),
            (rising, 2.0, -1.0, 1.01, 1.01, 2.0 - 1.01 * 1.01),
            (rising, -1.0, 1.0, 0.5, 0.0, 1.0),
            (rising.minus(0.5), -1.0, 1.0, 1.01, 0.0, 0.5),
            (almost, 2.0, -1.0, 1.01, 1.004, 1.0),
        ] {
            let (found, nearest) = p.nearest(level, side, end);
            assert!((found - place).abs() < 2e-8, "{found} {place}");
            assert!((nearest - distance).abs() < 1e-14, "{nearest} {distance}");
        }
    }

    #[test]
    fn a_root_at_the_start_can_be_divided_out() {
        let p = through(|x| x * (x - 0.25));
        assert!(p.leaves_side(1.0).is_some_and(|root| root < 1e-12));
        let quotient = p.without_root_at_start();
        let root = quotient.leaves_side(-1.0).expect("it comes back");
        assert!((root - 0.25).abs() < 1e-12);
    }

    #[test]
    fn first_of_seven_roots() {
        let roots = [0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95];
        let p = through(|x| roots.iter().map(|r| x - r).product());
        let side = p.coefficients()[0].signum();
        assert!((p.leaves_side(side).expect("seven roots") - 0.05).abs() < 1e-9);
    }

    #[test]
    fn terms_are_the_polynomial_they_stand_for() {
        let nested = |x: f64| 0.3 + x * (-1.0 + (1.0 - x) * (0.5 + x * (2.0 - 0.7 * (1.0 - x))));
        let of_terms = Bernstein::of_terms(0.3, &[-1.0, 0.5, 2.0, -0.7]);
        for x in [0.0_f64, 0.2, 0.5, 0.9, 1.0] {
            let basis = |j: usize| binomial(4, j) * x.powi(j as i32) * (1.0 - x).powi(4 - j as i32);
            let terms = of_terms.coefficients().iter().enumerate();
            let found: f64 = terms.map(|(j, c)| c * basis(j)).sum();
            assert!((found - nested(x)).abs() < 1e-15, "{x}: {found}");
        }
    }
}
