//! Hinges at rest that friction or stops may hold: which of them stick, and which way the others move
//! (docs/equations.md, Friction and Stops).

use faer::Mat;
use faer::linalg::solvers::Solve;
use nboom_dynamics::Accelerations;
use nboom_model::Mode;

use crate::code::under_own_laws;
use crate::equations::Equations;
use crate::equations::hold::{Hold, Unit};
use crate::equations::state::State;

/// Share of the accelerations that cancel below which one is rounding.
const NO_ACCELERATION: f64 = 1e-12;

/// Share of the accelerations that cancel below which motion starts without one.
const GRADUAL: f64 = 1e-6;

/// Likewise of motion off a stop, of what cancels about the hinge.
const GRADUAL_OFF_STOP: f64 = 1e-9;

/// A push without an answer that is a number is repeated so many times as hard, or as soft, and so often.
const PUSH: f64 = (1 << 26) as f64;
const MOST_PUSHES: usize = 40;

/// Changes for each hinge after which the search for those that stick is given up.
const MOST_TURNS: usize = 1000;

/// So many of them, for each hinge, change the one that is wrong by most.
const BY_MOST: usize = 10;

/// Rounding hides whether this one of the hinges at rest sticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Undecided(pub usize);

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

/// How the accelerations of hinges at rest depend on the torques that hold them: w = a + R x, where each x is a
/// torque as a share of the unit of the hinge.
#[derive(Clone, Debug)]
pub(crate) struct AtRest {
    holds: Vec<Hold>,
    /// a, without what holds them.
    without: Vec<f64>,
    /// R: column j is what the unit of hinge j adds.
    response: Mat<f64>,
}

impl AtRest {
    /// Of the hinges that are held so, whose accelerations `accelerate` tells when a torque pushes one of them up, or none.
    pub fn find(
        holds: Vec<Hold>,
        mut accelerate: impl FnMut(Option<(usize, f64)>) -> Vec<f64>,
    ) -> Self {
        let without = accelerate(None);
        let largest = |of: &[f64]| of.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let mut column = |i: usize| {
            let unit = match holds[i].unit {
                Unit::Friction(friction) => friction,
                Unit::Sizes { .. } => 1.0,
            };
            let mut added = |times: f64| -> Vec<f64> {
                let pushed = accelerate(Some((i, times * unit)));
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
        let in_units = |i: usize, found: Vec<f64>| {
            let scale = match holds[i].unit {
                Unit::Sizes { torque, acceleration } => torque + acceleration / found[i],
                Unit::Friction(_) => 1.0,
            };
            let scale = if scale.is_normal() { scale } else { 1.0 };
            found.into_iter().map(|added| added * scale).collect()
        };
        let count = holds.len();
        let columns: Vec<Vec<f64>> = (0..count).map(|i| in_units(i, column(i))).collect();
        let response = Mat::from_fn(count, count, |i, j| columns[j][i]);
        Self { holds, without, response }
    }

    /// The torque that holds each hinge while all stick, as a share of its unit.
    pub fn holding(&self) -> Vec<f64> {
        let all: Vec<usize> = (0..self.without.len()).collect();
        self.shares(&all, &vec![0.0; all.len()])
    }

    /// How each hinge goes on: the shares from the least to the most at which those inside do not accelerate, and those
    /// at an end accelerate against it. There is exactly one such set, as R is, row by row times the units, symmetric
    /// and positive definite: a linear complementarity problem with bounds, by principal pivoting. Hinges change their
    /// places one at a time: first that which is wrong by most, then, so that no set comes back, the first wrong
    /// one (Murty's least index). None where a hinge has no inertia, or friction is nothing beside it.
    ///
    /// # Errors
    /// Where rounding hides how they go on.
    pub fn onsets(&self) -> Result<Option<Vec<Onset>>, Undecided> {
        let count = self.without.len();
        let numbers =
            self.without.iter().chain(self.response.col_iter().flat_map(|col| col.iter()));
        let answers = (0..count).all(|i| self.response[(i, i)] != 0.0);
        if !(answers && numbers.copied().all(f64::is_finite)) {
            return Ok(None);
        }
        let mut onsets = vec![Onset::Sticks; count];
        let mut turns = 0..MOST_TURNS * count;
        loop {
            let wrong = self.wrong(&onsets);
            let Some(&(first, ..)) = wrong.first() else { break };
            let turn = turns.next().ok_or(Undecided(first))?;
            let by_most = || wrong.iter().max_by(|a, b| a.1.total_cmp(&b.1));
            let next = if turn < BY_MOST * count { by_most() } else { wrong.first() };
            if let Some(&(i, _, onset)) = next {
                onsets[i] = onset;
            }
        }
        let shares = self.all_shares(&onsets);
        for (i, (sum, size)) in self.accelerations(&shares).enumerate() {
            if let Onset::Moves { gradually, .. } = &mut onsets[i] {
                *gradually = match self.holds[i].unit {
                    Unit::Friction(_) => sum.abs() <= GRADUAL * size,
                    Unit::Sizes { .. } => sum.abs() <= GRADUAL_OFF_STOP * self.response[(i, i)],
                };
            }
        }
        Ok(Some(onsets))
    }

    /// The hinges that go on otherwise than `onsets` say: by how much that is wrong, and how they would.
    fn wrong(&self, onsets: &[Onset]) -> Vec<(usize, f64, Onset)> {
        let shares = self.all_shares(onsets);
        let mut wrong = Vec::new();
        for (i, (sum, size)) in self.accelerations(&shares).enumerate() {
            match onsets[i] {
                Onset::Sticks if self.holds[i].excess(shares[i]) > 0.5 * self.holds[i].beyond() => {
                    let onset =
                        Onset::Moves { up: shares[i] < self.holds[i].least, gradually: false };
                    wrong.push((i, self.holds[i].excess(shares[i]), onset));
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
        let share = |(onset, hold): (&Onset, &Hold)| match onset {
            Onset::Sticks => 0.0,
            Onset::Moves { up, .. } => hold.moving(*up),
        };
        let mut shares: Vec<f64> = onsets.iter().zip(&self.holds).map(share).collect();
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

impl Equations {
    /// How the hinges `resting`, which `mode` has free and without friction, start to move from `state` under any
    /// torques of their friction and their stops. Leaves the equations in that mode.
    pub fn at_rest(&mut self, state: &mut State, mode: &Mode, resting: &[usize]) -> AtRest {
        state.spin_up(&self.scene, mode, Some(self.commands.rotor_accelerations()));
        self.go_to(mode, state);
        self.entered.dynamics.set_outside(state.attitude, state.time);
        let holds = self.holds(resting, state);
        let Self { entered, commands, own, .. } = self;
        let dynamics = &mut entered.dynamics;
        let motion = state.motion(dynamics);
        let free = dynamics.free_hinges().to_vec();
        let mut found = Accelerations::for_hinges(free.len());
        let mut trial = commands.clone();
        let place = |&i: &usize| dynamics.position_of(i).expect("hinges at rest are free");
        let places: Vec<usize> = resting.iter().map(place).collect();
        let at_rest = AtRest::find(holds, |pushed| {
            trial.hinge_torques_mut().copy_from_slice(commands.hinge_torques());
            if let Some((k, torque)) = pushed {
                trial.hinge_torques_mut()[resting[k]] += torque;
            }
            dynamics.command(&trial);
            under_own_laws(own, dynamics, &motion, &mut found);
            places.iter().map(|&place| found.tau_dot[place]).collect()
        });
        dynamics.command(commands);
        at_rest
    }
}

#[cfg(test)]
mod tests {
    use rand_xoshiro::Xoshiro256PlusPlus;
    use rand_xoshiro::rand_core::{Rng, SeedableRng};

    use nboom_model::Hinge;

    use super::*;

    /// A number from -1 to 1.
    fn any(random: &mut Xoshiro256PlusPlus) -> f64 {
        (random.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A push that turns a hinge the other way, as none does but by rounding: neither state of it is right.
    #[test]
    fn what_cannot_be_told_is_an_error() {
        let hinge = Hinge { friction: 1.0, ..Hinge::free() };
        let holds = vec![Hold::of(&hinge, 0.0, || [0.0; 2])];
        let response = Mat::from_fn(1, 1, |_, _| -1.0);
        let found = AtRest { holds, without: vec![2.0], response };
        assert_eq!(found.onsets(), Err(Undecided(0)));
    }

    /// A positive definite response, unit by unit, and any accelerations: every set of hinges that stick and
    /// move is right. A third of the hinges has friction, a third rests against a stop, and a third does both.
    #[test]
    fn what_holds_bears_no_more_than_it_can_and_the_others_move_against_it() {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(1781);
        let (mut stuck, mut moving) = ([0; 3], [0; 3]);
        for count in (1..=12).cycle().take(2000) {
            let root = Mat::from_fn(count, count, |_, _| any(&mut random));
            let inverse_mass =
                &root * root.transpose() + Mat::<f64>::identity(count, count) * faer::Scale(0.1);
            let kinds: Vec<usize> = (0..count).map(|_| (random.next_u64() % 3) as usize).collect();
            let hinges: Vec<Hinge> = (kinds.iter())
                .map(|&kind| {
                    let mut hinge = Hinge::free();
                    if kind != 1 {
                        hinge.friction = 10_f64.powf(3.0 * any(&mut random) - 1.5);
                    }
                    if kind > 0 {
                        let end = if any(&mut random) > 0.0 {
                            &mut hinge.stops.upper
                        } else {
                            &mut hinge.stops.lower
                        };
                        *end = 0.0;
                    }
                    hinge
                })
                .collect();
            let without: Vec<f64> = (0..count).map(|_| 3.0 * any(&mut random)).collect();
            let holds: Vec<Hold> =
                hinges.iter().map(|hinge| Hold::of(hinge, 0.0, || [0.5, 7.0])).collect();
            let found = AtRest::find(holds, |pushed| {
                let push =
                    |i: usize| pushed.map_or(0.0, |(j, torque)| inverse_mass[(i, j)] * torque);
                (0..count).map(|i| without[i] + push(i)).collect()
            });
            let onsets = found.onsets().expect("no rounding").expect("inertia everywhere");
            assert!(found.wrong(&onsets).is_empty(), "{onsets:?}");
            let shares = found.all_shares(&onsets);
            // The torques, of which a stop bears those that push away from it, and friction as much as it is.
            let torque = |j: usize| match hinges[j].friction {
                0.0 => shares[j] * (0.5 + 7.0 / inverse_mass[(j, j)]),
                friction => shares[j] * friction,
            };
            for (i, onset) in onsets.iter().enumerate() {
                let acceleration =
                    without[i] + (0..count).map(|j| inverse_mass[(i, j)] * torque(j)).sum::<f64>();
                let Hinge { friction, stops, .. } = hinges[i];
                let (least, most) = (-friction, friction);
                let most = if stops.lower == 0.0 { f64::INFINITY } else { most };
                let least = if stops.upper == 0.0 { f64::NEG_INFINITY } else { least };
                // Roundings of sums of a hundred numbers below 100, by a matrix of condition below 1e3.
                match onset {
                    Onset::Sticks => {
                        let slack = 1e-9 * (1.0 + friction);
                        assert!(
                            least - slack < torque(i) && torque(i) < most + slack,
                            "{onsets:?}"
                        );
                        assert!(acceleration.abs() < 1e-9);
                        stuck[kinds[i]] += 1;
                    }
                    Onset::Moves { up, .. } => {
                        assert!(if *up { acceleration > -1e-9 } else { acceleration < 1e-9 });
                        let by = if *up { least } else { most };
                        assert!((torque(i) - by).abs() < 1e-9 * (1.0 + friction), "{onsets:?}");
                        moving[kinds[i]] += 1;
                    }
                }
            }
        }
        assert!(stuck.into_iter().chain(moving).all(|times| times > 500), "{stuck:?}, {moving:?}");
    }
}
