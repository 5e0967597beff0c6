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

/// Share of the step by which, at most, the second end that is tried is beyond the first.
const SOON: f64 = 1e-3;

/// Ends of the step that are tried: more than halves have room between two numbers.
const TRIALS: usize = 120;

/// A hinge that sticks and moves within a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slip {
    hinge: usize,
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
    /// The length of the step that dense output is over.
    full: f64,
}

impl Slip {
    /// By how much the torque is beyond the edge, of those that hold the hinges `stuck`.
    fn beyond_edge(&self, holding: &[f64], stuck: &[usize]) -> f64 {
        let place = stuck.binary_search(&self.hinge).expect("a hinge that slips has been stuck");
        self.sign * (holding[place] - self.edge)
    }
}

/// Whether all torques at this place of the lists are numbers.
fn is_finite(at_points: &[Vec<f64>], place: usize) -> bool {
    at_points.iter().all(|all| all[place].is_finite())
}

impl Run<'_> {
    /// The hinge that moves first of those that stick within the step just taken, before the fraction `until` of it.
    pub(super) fn first_slip(&mut self, until: f64) -> Option<Slip> {
        let stuck = self.rest.stuck(&self.situation.mode);
        let full = self.stepper.window().length();
        self.slip_between(&stuck, [0.0, until], full)
    }

    /// The hinge that moves first of those `stuck`, between these fractions of the step, whose dense output is over a
    /// step of length `full`.
    fn slip_between(
        &mut self,
        stuck: &[usize],
        [from, until]: [f64; 2],
        full: f64,
    ) -> Option<Slip> {
        if stuck.is_empty() {
            return None;
        }
        let (scene, beta) = (&self.equations.scene, &self.situation.state.beta);
        // Edges are shares of units, whatever these are.
        let hold = |&i: &usize| Hold::of(&scene.bodies[i].hinge, beta[i], || [0.0; 2]);
        let holds: Vec<Hold> = stuck.iter().map(hold).collect();
        let stuck_so = Stuck { hinges: stuck, holds: &holds, full };
        let (place, sign, fraction) =
            self.slip_within(&Interpolation::new(), stuck_so, [from, until], 0)?;
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
        let at_points = interpolation
            .points()
            .map(|point| self.holding(stuck.hinges, within(point), stuck.full));
        if let Some(place) = (0..count).find(|&place| !is_finite(&at_points, place)) {
            // Friction is nothing beside what acts.
            return Some((place, 1.0, from));
        }
        let polynomial =
            |place: usize| interpolation.through(&at_points.each_ref().map(|all| all[place]));
        let polynomials: Vec<_> = (0..count).map(polynomial).collect();
        let between = self.holding(stuck.hinges, within(BETWEEN), stuck.full);
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

    /// The torques that hold the hinges `stuck` at a fraction of the step just taken, as shares of their units, by dense
    /// output over a step of length `full`.
    fn holding(&mut self, stuck: &[usize], fraction: f64, full: f64) -> Vec<f64> {
        let start = self.stepper.window().time;
        self.variables.resize(self.equations.variables.layout.len(), 0.0);
        self.stepper.interpolate(fraction, self.variables);
        self.equations.read(start + fraction * full, self.variables, self.scratch);
        self.holding_in_scratch(stuck)
    }

    /// The same in the state in `scratch`.
    fn holding_in_scratch(&mut self, stuck: &[usize]) -> Vec<f64> {
        let Self { rest, situation, equations, scratch, .. } = self;
        rest.holding(equations, &situation.mode, scratch, stuck)
    }

    /// Ends the step where a hinge moves that dense output, over a step of length `full`, says to move by `slip`, and not
    /// after something else happens. Returns which moves; none where the motion itself does not come to it.
    pub(super) async fn locate_slip(&mut self, mut slip: Slip, full: f64) -> Option<usize> {
        let stuck = self.rest.stuck(&self.situation.mode);
        let mut slope = self.slope_of_slip(&slip, &stuck, full);
        // No step is taken that leaves the time as it is.
        let time = self.stepper.window().time;
        let least = 4.0 * (time.abs().next_up() - time.abs());
        let (mut inside, mut outside) = (0.0, (slip.until * full).max(least));
        let (mut step, mut slips) = ((slip.fraction * full).clamp(least, outside), false);
        // How much further the next end is tried, until one is beyond.
        let mut ahead = 0.0_f64;
        for _ in 0..TRIALS {
            let width = outside - inside;
            self.end_at(step, full).await;
            let window = self.stepper.window();
            self.equations.read(window.end_time, &window.end_state, self.scratch);
            let beyond = slip.beyond_edge(&self.holding_in_scratch(&stuck), &stuck);
            if (0.0..=slip.beyond).contains(&beyond) {
                return Some(slip.hinge);
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
            let newton = step + (0.5 * slip.beyond - beyond) / slope;
            if slips {
                let gets_on = outside - inside <= 0.5 * width;
                let is_between = inside < newton && newton < outside;
                step = if gets_on && is_between { newton } else { 0.5 * (inside + outside) };
                continue;
            }
            let fraction = inside / full;
            if ahead > 0.0 && slip.beyond_edge(&self.holding(&stuck, fraction, full), &stuck) < 0.0
            {
                // The torque has come back and the motion has not come to it; there may be another.
                let Some(next) = self.slip_between(&stuck, [fraction, slip.until], full) else {
                    break;
                };
                slope = self.slope_of_slip(&next, &stuck, full);
                slip = next;
                if next.fraction * full > inside + ahead {
                    (step, ahead) = ((next.fraction * full).min(outside), 0.0);
                    continue;
                }
            }
            ahead = (newton - step).min(SOON * full).max(2.0 * ahead).max(least);
            step = (inside + ahead).min(outside);
        }
        if slips {
            self.end_at(outside, full).await;
            return Some(slip.hinge);
        }
        // Nothing begins anew here, so the step is to be whole: it has been taken shorter, or ends inside.
        self.retake(outside).await;
        None
    }

    /// How fast the torque grows that holds the hinge, as a share of its unit, where it moves.
    fn slope_of_slip(&mut self, slip: &Slip, stuck: &[usize], full: f64) -> f64 {
        let aside = 1e-3;
        let from = (slip.fraction - aside).max(0.0);
        let [before, after] =
            [from, from + aside].map(|at| slip.beyond_edge(&self.holding(stuck, at, full), stuck));
        (after - before) / (aside * full)
    }
}
