//! Hinges at rest that friction may hold: which of them stick, and which way the others move (docs/equations.md,
//! Friction).

use faer::Mat;
use faer::linalg::solvers::Solve;

/// By this share of its friction more than that acts about a hinge when it slips.
pub(crate) const BEYOND_FRICTION: f64 = 1e-10;

/// What is more than friction by less than this share is rounding.
const ROUNDING: f64 = 0.5 * BEYOND_FRICTION;

/// Share of the accelerations that cancel below which one is rounding.
const NO_ACCELERATION: f64 = 1e-12;

/// Share of the accelerations that cancel below which motion starts without one.
const GRADUAL: f64 = 1e-6;

/// A push without an answer that is a number is repeated so many times as hard, or as soft, and so often.
const PUSH: f64 = (1 << 26) as f64;
const MOST_PUSHES: usize = 40;

/// How a hinge at rest goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Onset {
    Sticks,
    /// Its acceleration may be next to nothing in the beginning, so that the motion starts with what follows.
    Moves {
        up: bool,
        gradually: bool,
    },
}

/// How the accelerations of hinges at rest depend on the torques of their friction: w = a + R x, where each x is a
/// torque as a share of the hinge's friction, from −1 to 1.
#[derive(Clone, Debug)]
pub(crate) struct AtRest {
    /// a, without friction.
    without: Vec<f64>,
    /// R: column j is what all of the friction of hinge j adds.
    response: Mat<f64>,
}

impl AtRest {
    /// Of the hinges `resting`, whose accelerations `accelerate` tells when so many times the friction of one of them
    /// pushes it up, or of none.
    pub fn find(
        resting: &[usize],
        mut accelerate: impl FnMut(Option<(usize, f64)>) -> Vec<f64>,
    ) -> Self {
        let without = accelerate(None);
        let largest = |of: &[f64]| of.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let column = |&i: &usize| {
            let mut added = |times: f64| -> Vec<f64> {
                let pushed = accelerate(Some((i, times)));
                pushed.iter().zip(&without).map(|(a, b)| (a - b) / times).collect()
            };
            // Friction may be less than the rounding of what acts, or more than numbers can hold.
            let (mut times, mut found) = (1.0, added(1.0));
            for _ in 0..MOST_PUSHES {
                match largest(&found) {
                    0.0 if largest(&without) > 0.0 => times *= PUSH,
                    size if !size.is_finite() => times /= PUSH,
                    _ => break,
                }
                found = added(times);
            }
            // A push as large as what acts leaves all digits of the difference.
            let more = (largest(&without) / largest(&found)).log2().round().exp2();
            if more.is_finite() && more > 4.0 * times { added(more) } else { found }
        };
        let columns: Vec<Vec<f64>> = resting.iter().map(column).collect();
        let count = resting.len();
        let response = Mat::from_fn(count, count, |i, j| columns[j][i]);
        Self { without, response }
    }

    /// The torque that holds each hinge while all stick, as a share of its friction.
    pub fn holding(&self) -> Vec<f64> {
        let all: Vec<usize> = (0..self.without.len()).collect();
        self.shares(&all, &vec![0.0; all.len()])
    }

    /// How each hinge goes on: the shares from −1 to 1 at which those inside do not accelerate, and those at an end
    /// accelerate against their friction. There is exactly one such set, as R is, row by row times friction, symmetric
    /// and positive definite. Hinges change their places one at a time: first that which is wrong by most, then, so
    /// that no set comes back, the first wrong one (Murty's least index). None where a hinge has no inertia, or friction is
    /// nothing beside it.
    pub fn onsets(&self) -> Option<Vec<Onset>> {
        let count = self.without.len();
        let numbers =
            self.without.iter().chain(self.response.col_iter().flat_map(|col| col.iter()));
        let answers = (0..count).all(|i| self.response[(i, i)] != 0.0);
        if !(answers && numbers.copied().all(f64::is_finite)) {
            return None;
        }
        let mut onsets = vec![Onset::Sticks; count];
        for turn in 0..1000 * count {
            let wrong = self.wrong(&onsets);
            let by_most = || wrong.iter().max_by(|a, b| a.1.total_cmp(&b.1));
            let next = if turn < 10 * count { by_most() } else { wrong.first() };
            let Some(&(i, _, onset)) = next else { break };
            onsets[i] = onset;
        }
        debug_assert!(self.wrong(&onsets).is_empty(), "{self:?}");
        let shares = self.all_shares(&onsets);
        for (onset, (sum, size)) in onsets.iter_mut().zip(self.accelerations(&shares)) {
            if let Onset::Moves { gradually, .. } = onset {
                *gradually = sum.abs() <= GRADUAL * size;
            }
        }
        Some(onsets)
    }

    /// The hinges that go on otherwise than `onsets` say: by how much that is wrong, and how they would.
    fn wrong(&self, onsets: &[Onset]) -> Vec<(usize, f64, Onset)> {
        let shares = self.all_shares(onsets);
        let mut wrong = Vec::new();
        for (i, (sum, size)) in self.accelerations(&shares).enumerate() {
            match onsets[i] {
                Onset::Sticks if shares[i].abs() > 1.0 + ROUNDING => {
                    let onset = Onset::Moves { up: shares[i] < 0.0, gradually: false };
                    wrong.push((i, shares[i].abs() - 1.0, onset));
                }
                Onset::Moves { up, .. }
                    if (sum < 0.0) == up && sum.abs() > NO_ACCELERATION * size =>
                {
                    let by = sum.abs() / self.response[(i, i)].abs();
                    wrong.push((i, by, Onset::Sticks));
                }
                _ => {}
            }
        }
        wrong
    }

    /// The shares of all hinges that go on so.
    fn all_shares(&self, onsets: &[Onset]) -> Vec<f64> {
        let mut shares: Vec<f64> = onsets.iter().map(|onset| onset.share()).collect();
        let is_stuck = |i: &usize| onsets[*i] == Onset::Sticks;
        let stuck: Vec<usize> = (0..onsets.len()).filter(is_stuck).collect();
        let held = self.shares(&stuck, &shares);
        stuck.iter().zip(held).for_each(|(&i, share)| shares[i] = share);
        shares
    }

    /// Accelerations at these shares, each with the sum of the magnitudes of its parts.
    fn accelerations(&self, shares: &[f64]) -> impl Iterator<Item = (f64, f64)> {
        self.without.iter().enumerate().map(move |(i, &without)| {
            let parts = shares.iter().enumerate().map(|(j, share)| self.response[(i, j)] * share);
            parts
                .fold((without, without.abs()), |(sum, size), part| (sum + part, size + part.abs()))
        })
    }

    /// The shares at which the hinges `stuck` do not accelerate while the others have the `given` ones.
    fn shares(&self, stuck: &[usize], given: &[f64]) -> Vec<f64> {
        let others: Vec<usize> = (0..given.len()).filter(|i| !stuck.contains(i)).collect();
        let rest = |i: usize| -> f64 {
            others.iter().map(|&j| self.response[(i, j)] * given[j]).sum::<f64>() + self.without[i]
        };
        let response =
            Mat::from_fn(stuck.len(), stuck.len(), |i, j| self.response[(stuck[i], stuck[j])]);
        let wanted = Mat::from_fn(stuck.len(), 1, |i, _| -rest(stuck[i]));
        let found = response.partial_piv_lu().solve(&wanted);
        (0..stuck.len()).map(|i| found[(i, 0)]).collect()
    }
}

impl Onset {
    /// The torque of friction as a share of the most; of a hinge that sticks it is still to be found.
    fn share(self) -> f64 {
        match self {
            Self::Sticks => 0.0,
            Self::Moves { up: true, .. } => -1.0,
            Self::Moves { up: false, .. } => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use rand_xoshiro::Xoshiro256PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    use super::*;

    /// A number from -1 to 1.
    fn any(random: &mut Xoshiro256PlusPlus) -> f64 {
        (random.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A positive definite response, friction by friction, and any accelerations: every set of hinges that stick and
    /// move is right.
    #[test]
    fn stuck_hinges_bear_no_more_than_friction_and_the_others_move_against_it() {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(1781);
        let (mut stuck, mut moving) = (0, 0);
        for count in (1..=12).cycle().take(2000) {
            let root = Mat::from_fn(count, count, |_, _| any(&mut random));
            let inverse_mass =
                &root * root.transpose() + Mat::<f64>::identity(count, count) * faer::Scale(0.1);
            let friction: Vec<f64> =
                (0..count).map(|_| 10_f64.powf(3.0 * any(&mut random) - 1.5)).collect();
            let without: Vec<f64> = (0..count).map(|_| 3.0 * any(&mut random)).collect();
            let hinges: Vec<usize> = (0..count).collect();
            let found = AtRest::find(&hinges, |pushed| {
                let push = |i: usize| {
                    pushed.map_or(0.0, |(j, times)| inverse_mass[(i, j)] * friction[j] * times)
                };
                hinges.iter().map(|&i| without[i] + push(i)).collect()
            });
            let onsets = found.onsets().expect("inertia everywhere");
            assert!(found.wrong(&onsets).is_empty(), "{onsets:?}");
            let mut shares: Vec<f64> = onsets.iter().map(|onset| onset.share()).collect();
            let sticking: Vec<usize> =
                hinges.iter().copied().filter(|&i| onsets[i] == Onset::Sticks).collect();
            let held = found.shares(&sticking, &shares);
            sticking.iter().zip(held).for_each(|(&i, share)| shares[i] = share);
            for (i, onset) in onsets.iter().enumerate() {
                let torque = |j: usize| shares[j] * friction[j];
                let acceleration = without[i]
                    + hinges.iter().map(|&j| inverse_mass[(i, j)] * torque(j)).sum::<f64>();
                // Roundings of sums of a hundred numbers below 100, by a matrix of condition below 1e3.
                match onset {
                    Onset::Sticks => {
                        assert!(shares[i].abs() < 1.0 + 1e-9 && acceleration.abs() < 1e-9);
                        stuck += 1;
                    }
                    Onset::Moves { up, .. } => {
                        assert!(if *up { acceleration > -1e-9 } else { acceleration < 1e-9 });
                        moving += 1;
                    }
                }
            }
        }
        assert!(stuck > 1000 && moving > 1000, "{stuck}, {moving}");
    }
}
