//! When friction or a stop lets a hinge go.

use nboom_ode::Interpolation;

use super::Run;
use crate::equations::hold::Hold;

/// A step is halved where torque and polynomial differ by more than this, as a share of the unit.
const RESOLVED: f64 = 1e-7;

/// The same, as a share of how far the torque is from letting go; the larger of the two counts.
const OF_MARGIN: f64 = 1e-2;

/// A step is searched in parts of no less than 2 to the power of minus this.
const MOST_HALVINGS: usize = 8;

/// Where in a part the polynomial is compared with the torque, between two of its points.
const BETWEEN: f64 = 0.3;

/// Ends of the step that are tried: more than halves have room between two numbers.
const TRIALS: usize = 120;

/// A hinge that sticks and moves within a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slip {
    pub hinge: usize,
    /// The sign of the torque that would hold it.
    sign: f64,
    /// The share at which it moves, and by how much the torque may be beyond.
    edge: f64,
    beyond: f64,
    /// The fraction of the step.
    fraction: f64,
    /// The fraction of the step after which something else happens.
    until: f64,
}

/// Hinges that stick, and what holds them.
#[derive(Clone, Copy)]
struct Stuck<'a> {
    hinges: &'a [usize],
    holds: &'a [Hold],
}

/// Whether all torques at this place of the lists are numbers.
fn is_finite(at_points: &[Vec<f64>], place: usize) -> bool {
    at_points.iter().all(|all| all[place].is_finite())
}

impl Run<'_> {
    /// The hinge that moves first of those that stick within the step just taken, before the fraction `until` of it.
    pub(super) fn first_slip(&mut self, until: f64) -> Option<Slip> {
        let stuck = self.rest.stuck(&self.situation.mode);
        if stuck.is_empty() {
            return None;
        }
        let (scene, beta) = (&self.equations.scene, &self.situation.state.beta);
        // Edges are shares of units, whatever these are.
        let hold = |&i: &usize| Hold::of(&scene.bodies[i].hinge, beta[i], || [0.0; 2]);
        let holds: Vec<Hold> = stuck.iter().map(hold).collect();
        let stuck_so = Stuck { hinges: &stuck, holds: &holds };
        let (place, sign, fraction) =
            self.slip_within(&Interpolation::new(), stuck_so, [0.0, until], 0)?;
        let (hinge, hold) = (stuck[place], holds[place]);
        Some(Slip { hinge, sign, edge: hold.edge(sign), beyond: hold.beyond(), fraction, until })
    }

    /// The place of the first of the hinges `stuck` to move in a part of the step, the sign of what would hold it, and
    /// the fraction of the step.
    fn slip_within(
        &mut self,
        interpolation: &Interpolation,
        stuck: Stuck<'_>,
        [from, to]: [f64; 2],
        halvings: usize,
    ) -> Option<(usize, f64, f64)> {
        let within = |point: f64| from + point * (to - from);
        let count = stuck.hinges.len();
        let at_points =
            interpolation.points().map(|point| self.holding(stuck.hinges, within(point)));
        if let Some(place) = (0..count).find(|&place| !is_finite(&at_points, place)) {
            // Friction is nothing beside what acts.
            return Some((place, 1.0, from));
        }
        let polynomial =
            |place: usize| interpolation.through(&at_points.each_ref().map(|all| all[place]));
        let polynomials: Vec<_> = (0..count).map(polynomial).collect();
        let between = self.holding(stuck.hinges, within(BETWEEN));
        let is_off = |place: usize| {
            let all = at_points.iter().map(|all| all[place]).chain([between[place]]);
            let margin =
                all.map(|share| stuck.holds[place].margin(share)).fold(f64::INFINITY, f64::min);
            let off = (polynomials[place].at(BETWEEN) - between[place]).abs();
            off > RESOLVED.max(OF_MARGIN * margin)
        };
        if halvings < MOST_HALVINGS && (0..count).any(is_off) {
            let middle = within(0.5);
            let first = self.slip_within(interpolation, stuck, [from, middle], halvings + 1);
            return first
                .or_else(|| self.slip_within(interpolation, stuck, [middle, to], halvings + 1));
        }
        let slips = stuck.holds.iter().zip(&polynomials).enumerate();
        let slips = slips.flat_map(|(place, (hold, polynomial))| {
            [1.0, -1.0].map(|sign| {
                let edge = Some(hold.edge(sign)).filter(|edge| edge.is_finite())?;
                let fraction = polynomial.leaves(edge, -sign)?;
                Some((place, sign, within(fraction)))
            })
        });
        slips.flatten().min_by(|a, b| a.2.total_cmp(&b.2))
    }

    /// The torques that hold the hinges `stuck` at a fraction of the step just taken, as shares of their units.
    fn holding(&mut self, stuck: &[usize], fraction: f64) -> Vec<f64> {
        let (start, length) = (self.stepper.window().time, self.stepper.window().length());
        self.variables.resize(self.equations.variables.layout.len(), 0.0);
        self.stepper.interpolate(fraction, self.variables);
        self.equations.read(start + fraction * length, self.variables, self.scratch);
        self.holding_in_scratch(stuck)
    }

    /// The same in the state in `scratch`.
    fn holding_in_scratch(&mut self, stuck: &[usize]) -> Vec<f64> {
        let Self { rest, situation, equations, scratch, .. } = self;
        rest.holding(equations, &situation.mode, scratch, stuck)
    }

    /// Ends the step where the hinge moves, not after something else happens; dense output is over a step of length
    /// `full`. Returns whether it does: dense output may say so where the motion itself does not come to it.
    pub(super) async fn locate_slip(&mut self, slip: Slip, full: f64) -> bool {
        let Slip { hinge, sign, edge, beyond: most, fraction, until } = slip;
        let stuck = self.rest.stuck(&self.situation.mode);
        let place = stuck.binary_search(&hinge).expect("a hinge that slips has been stuck");
        let slope = self.slope_of_slip(&slip, &stuck, place, full);
        // No step is taken that leaves the time as it is.
        let time = self.stepper.window().time;
        let least = 4.0 * (time.abs().next_up() - time.abs());
        let (mut inside, mut outside) = (0.0, (until * full).max(least));
        let (mut step, mut slips) = ((fraction * full).clamp(least, outside), false);
        for _ in 0..TRIALS {
            let width = outside - inside;
            self.end_at(step, full).await;
            let window = self.stepper.window();
            self.equations.read(window.end_time, &window.end_state, self.scratch);
            let beyond = sign * (self.holding_in_scratch(&stuck)[place] - edge);
            if (0.0..=most).contains(&beyond) {
                return true;
            }
            if beyond < 0.0 {
                inside = step;
            } else {
                (outside, slips) = (step, true);
            }
            // The end that is left may not have been tried.
            if outside - inside <= least && slips || inside >= outside {
                break;
            }
            let newton = step + (0.5 * most - beyond) / slope;
            let gets_on = outside - inside <= 0.5 * width;
            step = if gets_on && inside < newton && newton < outside {
                newton
            } else if slips {
                0.5 * (inside + outside)
            } else {
                outside
            };
        }
        if slips {
            self.end_at(outside, full).await;
        } else {
            // Nothing begins anew here, so the step is to be whole: it has been taken shorter, or ends inside.
            self.retake(outside).await;
        }
        slips
    }

    /// How fast the torque grows that holds the hinge, as a share of its unit, where it moves.
    fn slope_of_slip(&mut self, slip: &Slip, stuck: &[usize], place: usize, full: f64) -> f64 {
        let aside = 1e-3;
        let from = (slip.fraction - aside).max(0.0);
        let [before, after] = [from, from + aside].map(|at| self.holding(stuck, at)[place]);
        slip.sign * (after - before) / (aside * full)
    }
}
