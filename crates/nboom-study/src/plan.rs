//! What is drawn for each case, by its number alone.

pub(crate) mod draw;
mod latin_hypercube;
mod sobol;

use crate::correlation::Copula;
use crate::distribution::Distribution;
use crate::study::{Correlation, Method, Variable};
use draw::Numbers;
use latin_hypercube::Strata;
use sobol::Sequence;

/// Most draws of a study.
pub(crate) const MOST_DRAWS: u64 = 1_000_000_000;

/// What is drawn for a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Its number, from 1.
    pub number: u64,
    /// The seed of its draw.
    pub seed: u64,
    /// What is drawn for each variable.
    pub values: Vec<f64>,
    /// The number of its fault, from 0, if it has one.
    pub fault: Option<usize>,
}

/// What is drawn for each case of a study. Any case takes the same time and no memory that lasts.
#[derive(Clone, Debug)]
pub struct Plan {
    seed: u64,
    draws: u64,
    /// Cases of a draw: one without a fault, and one with each fault.
    cases_of_a_draw: u64,
    distributions: Vec<Distribution>,
    copula: Copula,
    way: Way,
}

#[derive(Clone, Debug)]
enum Way {
    Grid,
    LatinHypercube(Strata),
    Sobol(Sequence),
    MonteCarlo,
}

/// Why there is no plan of a study.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum PlanError {
    /// A grid has about so many points, more than draws may be.
    TooManyPoints(f64),
    /// A Sobol sequence has fewer dimensions than there are variables, of which there are so many.
    TooManyVariables(usize),
    /// Correlations of these variables contradict each other.
    Correlations(Vec<String>),
}

impl PlanError {
    /// The key of a study that it is about, what is there, and what is expected.
    pub fn told(&self) -> (&'static str, String, String) {
        match self {
            Self::TooManyPoints(points) => {
                let expected = format!("at most {MOST_DRAWS}");
                ("method", format!("a grid of {points:e} points"), expected)
            }
            Self::TooManyVariables(count) => {
                let expected = format!("at most {} by sobol", sobol::MOST_VARIABLES);
                ("method", format!("{count} variables"), expected)
            }
            Self::Correlations(names) => {
                let names = names.join(", ");
                let found = format!("coefficients of {names} that no numbers have together");
                ("correlation", found, "a positive definite matrix".to_owned())
            }
        }
    }
}

impl Plan {
    /// The plan of a study with so many draws, which a grid makes itself, and so many faults.
    ///
    /// # Errors
    /// When there is none.
    pub(crate) fn new(
        method: Method,
        seed: u64,
        draws: u64,
        variables: &[Variable],
        correlations: &[Correlation],
        faults: usize,
    ) -> Result<Self, PlanError> {
        let copula = Copula::new(correlations).map_err(|contradiction| {
            let names = contradiction.members.iter().map(|&i| variables[i].name.clone());
            PlanError::Correlations(names.collect())
        })?;
        let distributions: Vec<Distribution> =
            variables.iter().map(|variable| variable.distribution.clone()).collect();
        let (way, draws) = match method {
            Method::Grid => {
                let points = distributions.iter().map(|of| of.points().unwrap_or(1));
                let all = points.clone().try_fold(1_u64, |all, points| all.checked_mul(points));
                let about = || points.map(|points| points as f64).product();
                let all = all.filter(|all| *all <= MOST_DRAWS);
                (Way::Grid, all.ok_or_else(|| PlanError::TooManyPoints(about()))?)
            }
            Method::LatinHypercube => (Way::LatinHypercube(Strata::new(seed, draws)), draws),
            Method::Sobol => {
                let sequence = Sequence::new(seed, variables.len());
                let found = variables.len();
                (Way::Sobol(sequence.ok_or(PlanError::TooManyVariables(found))?), draws)
            }
            Method::MonteCarlo => (Way::MonteCarlo, draws),
        };
        Ok(Self { seed, draws, cases_of_a_draw: 1 + faults as u64, distributions, copula, way })
    }

    /// How many draws there are.
    pub fn draws(&self) -> u64 {
        self.draws
    }

    /// How many cases there are.
    pub fn cases(&self) -> u64 {
        self.draws * self.cases_of_a_draw
    }

    /// The case with this number, from 1.
    pub fn case(&self, number: u64) -> Case {
        let (draw, fault) =
            ((number - 1) / self.cases_of_a_draw, (number - 1) % self.cases_of_a_draw);
        let values = match &self.way {
            Way::Grid => self.point(draw),
            way => {
                let mut numbers = way.numbers(self.seed, draw, self.distributions.len());
                self.copula.correlate(&mut numbers);
                let values = self.distributions.iter().zip(&numbers);
                values.map(|(distribution, &u)| distribution.quantile(u)).collect()
            }
        };
        let seed = draw::seed(self.seed, draw);
        Case { number, seed, values, fault: fault.checked_sub(1).map(|fault| fault as usize) }
    }

    /// A point of a grid; the last variable changes fastest.
    fn point(&self, draw: u64) -> Vec<f64> {
        let mut left = draw;
        let mut values = vec![0.0; self.distributions.len()];
        for (value, distribution) in values.iter_mut().zip(&self.distributions).rev() {
            let points = distribution.points().unwrap_or(1);
            *value = distribution.point(left % points);
            left /= points;
        }
        values
    }
}

impl Way {
    /// Uniform numbers above 0 and below 1, one for each of so many variables.
    fn numbers(&self, seed: u64, draw: u64, count: usize) -> Vec<f64> {
        let mut random = Numbers::of_draw(seed, draw);
        match self {
            Self::LatinHypercube(strata) => {
                (0..count).map(|i| strata.place(i, draw, random.next())).collect()
            }
            Self::Sobol(sequence) => sequence.point(draw),
            Self::Grid | Self::MonteCarlo => random.take(count),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variable(distribution: Distribution) -> Variable {
        let relation = crate::study::Relation::Value;
        Variable { name: "x".to_owned(), slots: Vec::new(), relation, distribution }
    }

    fn uniform(count: usize) -> Vec<Variable> {
        vec![variable(Distribution::Uniform { from: 0.0, to: 1.0 }); count]
    }

    #[test]
    fn a_grid_has_each_combination_once_and_each_fault_of_it() {
        let values = |values: &[f64]| {
            let weights = vec![1.0; values.len()];
            variable(Distribution::one_of(values.to_vec(), weights))
        };
        let variables =
            [values(&[1.0, 2.0]), variable(Distribution::Points { from: 0.0, to: 2.0, points: 3 })];
        let plan = Plan::new(Method::Grid, 1, 0, &variables, &[], 1).expect("small");
        assert_eq!((plan.draws(), plan.cases()), (6, 12));
        let cases: Vec<_> = (1..=12).map(|number| plan.case(number)).collect();
        let of = |case: &Case| (case.values.clone(), case.fault);
        assert_eq!(of(&cases[0]), (vec![1.0, 0.0], None));
        assert_eq!(of(&cases[1]), (vec![1.0, 0.0], Some(0)));
        assert_eq!(of(&cases[2]), (vec![1.0, 1.0], None));
        assert_eq!(of(&cases[11]), (vec![2.0, 2.0], Some(0)));
        assert_eq!(cases[0].seed, cases[1].seed);
        assert_ne!(cases[1].seed, cases[2].seed);
    }

    #[test]
    fn grids_and_sequences_have_limits() {
        let many = variable(Distribution::Points { from: 0.0, to: 1.0, points: 1 << 40 });
        let found = Plan::new(Method::Grid, 1, 0, &[many.clone(), many], &[], 0);
        assert_eq!(
            found.err(),
            Some(PlanError::TooManyPoints((1_u64 << 40) as f64 * (1_u64 << 40) as f64))
        );
        let found = Plan::new(Method::Sobol, 1, 10, &uniform(101), &[], 0);
        assert_eq!(found.err(), Some(PlanError::TooManyVariables(101)));
    }

    /// The largest distance of an empirical distribution from the uniform one, times √n, stays below 2.2 but
    /// for one sample in 10,000 (Kolmogorov).
    #[test]
    fn independent_draws_are_uniform_and_independent() {
        let draws = 20_000;
        let plan = Plan::new(Method::MonteCarlo, 7, draws, &uniform(3), &[], 0).expect("a plan");
        let all: Vec<Vec<f64>> = (1..=draws).map(|number| plan.case(number).values).collect();
        for i in 0..3 {
            let mut of: Vec<f64> = all.iter().map(|values| values[i]).collect();
            of.sort_by(f64::total_cmp);
            let distance = of.iter().enumerate().map(|(k, u)| (u - k as f64 / draws as f64).abs());
            assert!(distance.fold(0.0, f64::max) * (draws as f64).sqrt() < 2.2);
        }
        let mean =
            |f: &dyn Fn(&[f64]) -> f64| all.iter().map(|of| f(of)).sum::<f64>() / draws as f64;
        for (i, j) in [(0, 1), (1, 2), (0, 2)] {
            let covariance = mean(&|of| (of[i] - 0.5) * (of[j] - 0.5));
            // Five standard deviations, of a product of two of variance 1/12.
            assert!(covariance.abs() < 5.0 / 12.0 / (draws as f64).sqrt(), "{covariance}");
        }
    }

    #[test]
    fn other_seeds_draw_other_numbers() {
        for method in [Method::MonteCarlo, Method::LatinHypercube, Method::Sobol] {
            let of = |seed| {
                let plan = Plan::new(method, seed, 50, &uniform(2), &[], 0).expect("a plan");
                (1..=50).map(|number| plan.case(number).values).collect::<Vec<_>>()
            };
            assert_eq!(of(3), of(3));
            assert!(of(3).iter().zip(&of(4)).all(|(a, b)| a != b), "{method:?}");
        }
    }
}
