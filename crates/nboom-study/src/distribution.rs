//! Distributions of numbers that vary.

use std::f64::consts::{PI, SQRT_2};

use libm::erfc;

/// How a number is distributed.
#[derive(Clone, Debug, PartialEq)]
pub enum Distribution {
    /// All numbers between two alike.
    Uniform {
        /// The least.
        from: f64,
        /// The largest.
        to: f64,
    },
    /// By Gauss, between two numbers, which may be infinite.
    Normal {
        /// Of the whole distribution.
        mean: f64,
        /// Standard deviation of the whole distribution.
        deviation: f64,
        /// The least.
        from: f64,
        /// The largest.
        to: f64,
    },
    /// The logarithm by Gauss, between two numbers, the larger of which may be infinite.
    LogNormal {
        /// Of the whole distribution.
        median: f64,
        /// Standard deviation of the natural logarithm.
        sigma: f64,
        /// The least.
        from: f64,
        /// The largest.
        to: f64,
    },
    /// One of these numbers.
    Values {
        /// The numbers.
        values: Vec<f64>,
        /// In what proportion they come.
        weights: Vec<f64>,
        /// The places of the numbers from the smallest to the largest.
        ascending: Vec<usize>,
    },
    /// Points at equal distances, ends included.
    Points {
        /// The first.
        from: f64,
        /// The last.
        to: f64,
        /// How many there are.
        points: u64,
    },
}

/// A number of a distribution that makes it none.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unfit {
    /// The key of the number.
    pub key: &'static str,
    /// What is there.
    pub found: String,
    /// What would have been right.
    pub expected: &'static str,
}

/// A bound of the normal distribution beyond which no number of a double lies.
const FARTHEST: f64 = 38.0;

impl Distribution {
    /// Refuses numbers that make no distribution.
    ///
    /// # Errors
    /// The first of them.
    pub(crate) fn check(&self) -> Result<(), Unfit> {
        let refuse = |is_right: bool, key, found: f64, expected| {
            let found = found.to_string();
            if is_right { Ok(()) } else { Err(Unfit { key, found, expected }) }
        };
        let ascending =
            |from: f64, to: f64| refuse(from < to, "to", to, "a number above that of `from`");
        let finite = |key, number: f64| refuse(number.is_finite(), key, number, "a finite number");
        let positive = |key, number: f64| {
            refuse(number > 0.0 && number.is_finite(), key, number, "a number above zero")
        };
        match *self {
            Self::Uniform { from, to } => {
                finite("from", from)?;
                finite("to", to)?;
                ascending(from, to)
            }
            Self::Normal { mean, deviation, from, to } => {
                finite("mean", mean)?;
                positive("deviation", deviation)?;
                ascending(from, to)?;
                reaches("from", from, (from - mean) / deviation)?;
                reaches("to", to, (mean - to) / deviation)
            }
            Self::LogNormal { median, sigma, from, to } => {
                positive("median", median)?;
                positive("sigma", sigma)?;
                refuse(from >= 0.0, "from", from, "zero or a number above")?;
                ascending(from, to)?;
                reaches("from", from, (from / median).ln() / sigma)?;
                reaches("to", to, (median / to).ln() / sigma)
            }
            Self::Values { ref values, ref weights, .. } => {
                values.iter().try_for_each(|&value| finite("values", value))?;
                let is_weight = |weight: f64| weight >= 0.0 && weight.is_finite();
                weights.iter().try_for_each(|&weight| {
                    refuse(is_weight(weight), "weights", weight, "zero or a number above")
                })?;
                let (count, expected) = (values.len() as f64, "at least one number");
                refuse(!values.is_empty(), "values", count, expected)?;
                let (count, expected) = (weights.len() as f64, "as many numbers as `values`");
                refuse(weights.len() == values.len(), "weights", count, expected)?;
                let sum: f64 = weights.iter().sum();
                refuse(sum > 0.0 && sum.is_finite(), "weights", sum, "a finite sum above zero")
            }
            Self::Points { from, to, points } => {
                finite("from", from)?;
                finite("to", to)?;
                ascending(from, to)?;
                refuse(points >= 2, "points", points as f64, "at least 2")
            }
        }
    }

    /// One of these numbers, which come in proportion to these weights.
    pub fn one_of(values: Vec<f64>, weights: Vec<f64>) -> Self {
        let mut ascending: Vec<usize> = (0..values.len().min(weights.len())).collect();
        ascending.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        Self::Values { values, weights, ascending }
    }

    /// How many points it has in a grid; none of a distribution that has no points.
    pub(crate) fn points(&self) -> Option<u64> {
        match self {
            Self::Values { values, .. } => Some(values.len() as u64),
            Self::Points { points, .. } => Some(*points),
            _ => None,
        }
    }

    /// The point with this number, from 0, in a grid.
    pub(crate) fn point(&self, number: u64) -> f64 {
        match self {
            Self::Values { values, .. } => values[number as usize],
            Self::Points { from, to, points } => {
                let share = number as f64 / (points - 1) as f64;
                from * (1.0 - share) + to * share
            }
            other => other.quantile(0.5),
        }
    }

    /// The number that is not exceeded with probability `u`, above 0 and below 1.
    pub fn quantile(&self, u: f64) -> f64 {
        match self {
            Self::Uniform { from, to } | Self::Points { from, to, .. } => from * (1.0 - u) + to * u,
            Self::Normal { mean, deviation, from, to } => {
                let score = |number: f64| (number - mean) / deviation;
                let found = mean + deviation * normal_between(score(*from), score(*to), u);
                found.clamp(*from, *to)
            }
            Self::LogNormal { median, sigma, from, to } => {
                let score = |number: f64| (number / median).ln() / sigma;
                let found = median * (sigma * normal_between(score(*from), score(*to), u)).exp();
                found.clamp(*from, *to)
            }
            Self::Values { values, weights, ascending } => {
                let mut left = u * weights.iter().sum::<f64>();
                let mut places = ascending.iter().copied().filter(|&place| weights[place] > 0.0);
                // Rounding may leave something beyond the last one that comes at all.
                let last = places.clone().next_back();
                let place = places.find(|&place| {
                    left -= weights[place];
                    left < 0.0
                });
                values[place.or(last).unwrap_or(0)]
            }
        }
    }
}

/// Refuses a bound that cuts off all that is likely; `score` is its distance from the middle in standard
/// deviations, towards the rest.
fn reaches(key: &'static str, bound: f64, score: f64) -> Result<(), Unfit> {
    if score < FARTHEST {
        return Ok(());
    }
    let expected = "a bound within 38 standard deviations of the middle";
    Err(Unfit { key, found: bound.to_string(), expected })
}

/// The probability of a standard normal number below `z`.
pub(crate) fn normal_probability(z: f64) -> f64 {
    0.5 * erfc(-z / SQRT_2)
}

/// The standard normal number that is not exceeded with probability `u`.
pub(crate) fn normal_score(u: f64) -> f64 {
    // Of the smaller tail, whose probability has all its digits.
    if u <= 0.5 { lower_score(u) } else { -lower_score(1.0 - u) }
}

/// Steps of Newton's method after which a score is as good as it gets.
const STEPS: usize = 20;

/// The standard normal number, at most zero, that is not exceeded with probability `u`.
///
/// The logarithm of the distribution function is concave, so Newton's method comes to its zero from anywhere to
/// the left, as where the function's bound ½ exp(-z²/2) is `u` / 2.
fn lower_score(u: f64) -> f64 {
    let mut z = -(-2.0 * u.ln()).sqrt();
    for _ in 0..STEPS {
        let probability = normal_probability(z);
        let density = (-0.5 * z * z).exp() / (2.0 * PI).sqrt();
        let step = (u / probability).ln() * probability / density;
        if !step.is_finite() {
            break;
        }
        z += step;
        if step.abs() < 4.0 * f64::EPSILON * (1.0 + z.abs()) {
            break;
        }
    }
    z.min(0.0)
}

/// Of standard normal numbers between two the one that is not exceeded with probability `u`.
fn normal_between(from: f64, to: f64, u: f64) -> f64 {
    if from.is_infinite() && to.is_infinite() {
        return normal_score(u);
    }
    if from > 0.0 {
        // The upper tail mirrored, since probabilities near 1 have lost their digits.
        return -normal_between(-to, -from, 1.0 - u);
    }
    let below = [from, to].map(normal_probability);
    let probability = below[0] * (1.0 - u) + below[1] * u;
    if probability <= 0.5 {
        return normal_score(probability);
    }
    let above = [from, to].map(|z| normal_probability(-z));
    -normal_score(above[0] * (1.0 - u) + above[1] * u)
}

#[cfg(test)]
mod tests {
    use super::*;

    const INFINITE: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

    fn normal(from: f64, to: f64) -> Distribution {
        Distribution::Normal { mean: 0.0, deviation: 1.0, from, to }
    }

    /// Quantiles of the standard normal distribution, of tables to 16 digits.
    #[test]
    fn normal_quantiles_are_those_of_tables() {
        for (u, z) in [
            (0.5, 0.0),
            (0.975, 1.959963984540054),
            (0.025, -1.959963984540054),
            (0.999, 3.090232306167813),
            (1e-10, -6.361340902404056),
            (1e-20, -9.262340089798408),
            (1e-300, -37.0471),
        ] {
            let found = normal(INFINITE.0, INFINITE.1).quantile(u);
            let allowed = if u == 1e-300 { 1e-4 } else { 2e-15 * (1.0 + f64::abs(z)) };
            assert!((found - z).abs() <= allowed, "{u}: {found}, {z}");
        }
    }

    #[test]
    fn quantiles_invert_probabilities_everywhere() {
        for i in 1..2000 {
            let z = -30.0 + 0.03 * f64::from(i);
            let u = normal_probability(z);
            // Near 1 a probability has an absolute error of rounding, which the slope magnifies.
            let slope = (-0.5 * z * z).exp() / (2.0 * PI).sqrt();
            if u < 0.5 || slope > 1e-6 {
                let allowed = 1e-12 * (1.0 + z.abs()) + 4.0 * f64::EPSILON * u / slope;
                assert!((normal_score(u) - z).abs() <= allowed, "{z}: {}", normal_score(u));
            }
        }
    }

    /// Of a tail the mean distance from its bound is that of an exponential distribution.
    #[test]
    fn far_tails_keep_their_digits() {
        for bound in [8.0, 20.0, 37.0] {
            for (from, to) in [(bound, f64::INFINITY), (f64::NEG_INFINITY, -bound)] {
                let tail = normal(from, to);
                assert_eq!(tail.check(), Ok(()));
                let numbers: Vec<f64> =
                    (1..100).map(|i| tail.quantile(f64::from(i) / 100.0)).collect();
                assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]), "{numbers:?}");
                assert!(numbers.iter().all(|z| (from..=to).contains(z)));
                // P(beyond z) / P(beyond bound) = u to the first order in 1 / bound².
                let beyond = |z: f64| normal_probability(-z.abs()) / normal_probability(-bound);
                for (i, z) in numbers.iter().enumerate() {
                    let u = (i + 1) as f64 / 100.0;
                    let expected = if from > 0.0 { 1.0 - u } else { u };
                    assert!((beyond(*z) / expected - 1.0).abs() < 1e-10, "{bound}: {z}");
                }
            }
        }
    }

    #[test]
    fn a_cut_distribution_has_the_probabilities_between_its_ends() {
        let (from, to) = (-0.5, 2.0);
        let whole = normal_probability(to) - normal_probability(from);
        for i in 1..1000 {
            let u = f64::from(i) / 1000.0;
            let z = normal(from, to).quantile(u);
            let below = (normal_probability(z) - normal_probability(from)) / whole;
            assert!((below - u).abs() < 1e-14, "{u}: {z}");
        }
    }

    #[test]
    fn logarithms_are_normal() {
        let (median, sigma) = (20.0, 0.3);
        let all = Distribution::LogNormal { median, sigma, from: 0.0, to: f64::INFINITY };
        for u in [1e-9, 0.1, 0.5, 0.9] {
            let expected = median * (sigma * normal_score(u)).exp();
            assert!((all.quantile(u) / expected - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn values_come_in_proportion_to_their_weights() {
        // In whatever order they are given: a quantile is not exceeded with its probability.
        for (values, weights) in
            [([5.0, 1.0, 7.0], [1.0, 0.0, 3.0]), ([7.0, 5.0, 1.0], [3.0, 1.0, 0.0])]
        {
            let few = Distribution::one_of(values.to_vec(), weights.to_vec());
            for (u, value) in [(1e-12, 5.0), (0.2499, 5.0), (0.2501, 7.0), (1.0 - 1e-16, 7.0)] {
                assert_eq!(few.quantile(u), value, "{u}");
            }
            assert_eq!([0, 1, 2].map(|number| few.point(number)), values);
        }
    }

    #[test]
    fn points_include_both_ends() {
        let points = Distribution::Points { from: -1.0, to: 0.3, points: 14 };
        assert_eq!((points.point(0), points.point(13)), (-1.0, 0.3));
        assert!((points.point(1) - -0.9).abs() < 1e-15);
    }

    #[test]
    fn what_makes_no_distribution_is_refused_by_its_key() {
        let key = |distribution: Distribution| distribution.check().expect_err("unfit").key;
        let normal = |mean, deviation, from, to| Distribution::Normal { mean, deviation, from, to };
        let (low, high) = INFINITE;
        assert_eq!(key(Distribution::Uniform { from: 1.0, to: 1.0 }), "to");
        assert_eq!(key(Distribution::Uniform { from: f64::NAN, to: 1.0 }), "from");
        assert_eq!(key(normal(0.0, -1.0, low, high)), "deviation");
        assert_eq!(key(normal(f64::INFINITY, 1.0, low, high)), "mean");
        assert_eq!(key(normal(0.0, 1.0, 50.0, high)), "from");
        assert_eq!(key(normal(0.0, 1.0, low, -50.0)), "to");
        let log = |median, from| Distribution::LogNormal { median, sigma: 0.1, from, to: 9.0 };
        assert_eq!(key(log(0.0, 0.0)), "median");
        assert_eq!(key(log(1.0, -1.0)), "from");
        let values = |values: &[f64], weights: &[f64]| {
            Distribution::one_of(values.to_vec(), weights.to_vec())
        };
        assert_eq!(key(values(&[], &[])), "values");
        assert_eq!(key(values(&[1.0], &[0.0])), "weights");
        assert_eq!(key(values(&[1.0, 2.0], &[1.0])), "weights");
        assert_eq!(key(Distribution::Points { from: 0.0, to: 1.0, points: 1 }), "points");
    }
}
