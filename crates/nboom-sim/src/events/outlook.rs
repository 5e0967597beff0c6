use nboom_dynamics::Recursive;
use nboom_elements::Coordinate;
use nboom_ode::Stepper;

use crate::equations::Equations;
use crate::equations::state::State;
use crate::events::angles::Angles;
use crate::events::guard::{Guard, Guards, watched};
use crate::events::side::Side;

/// What to expect of the angles after the last step that was searched: that they go on as they did, but for what
/// an instant has changed since.
#[derive(Default)]
pub(crate) struct Outlook {
    /// When the present mode began, if no step of it was searched.
    since: Option<f64>,
    /// Of each hinge, what was added to angle, rate and acceleration then.
    jumps: Vec<[f64; 3]>,
}

impl Outlook {
    /// A step was searched, or none yet.
    pub fn goes_on(&mut self) {
        self.since = None;
    }

    /// The angle of a hinge at a time to come.
    fn angle(&self, angles: &Angles, hinge: usize, time: f64) -> Option<f64> {
        let going_on = angles.angle_at(hinge, time);
        match self.since {
            None => going_on,
            Some(since) => {
                let ([angle, rate, acceleration], s) = (self.jumps[hinge], time - since);
                Some(going_on.unwrap_or(0.0) + angle + s * (rate + 0.5 * s * acceleration))
            }
        }
    }
}

/// Polynomials are continued by so many times the length of the step.
const REACH: f64 = 2.0;

/// Secants after which it is known well enough when an angle comes to a level.
const SECANTS: usize = 12;

/// Share of the time until then to which it is to be known.
const CLOSE: f64 = 1e-3;

impl Guards {
    /// Notes what the instant has changed in which a mode began, at `state`, where `stepper` starts.
    pub fn expect_from(&mut self, equations: &Equations, stepper: &dyn Stepper, state: &State) {
        let Self { outlook: Outlook { since, jumps }, angles, .. } = self;
        let layout = &equations.variables.layout;
        let free = equations.entered.dynamics.free_hinges();
        *since = None;
        let Some(slopes) = stepper.slopes().filter(|_| !layout.has_momenta()) else {
            return angles.forget(state.beta.len());
        };
        *since = Some(state.time);
        jumps.clear();
        jumps.resize(state.beta.len(), [0.0; 3]);
        for (&hinge, acceleration) in free.iter().zip(&slopes[layout.hinge_motion()]) {
            let [angle, rate, bend] = angles.at(hinge, state.time).unwrap_or_default();
            jumps[hinge] =
                [state.beta[hinge] - angle, state.tau[hinge] - rate, acceleration - bend];
        }
    }

    /// When a guard is expected to change next, if that is between two times.
    pub fn expected(&self, equations: &Equations, (now, farthest): (f64, f64)) -> Option<f64> {
        let dynamics = &equations.entered.dynamics;
        let farthest = farthest.min(now + REACH * self.angles.length());
        let crossing = |hinge: usize, level: f64, side: f64| {
            if !self.comes_near(hinge, (level, side), farthest - now) {
                return None;
            }
            let above =
                |time: f64| Some((self.outlook.angle(&self.angles, hinge, time)? - level) * side);
            crossing(above, now, farthest)
        };
        let of_guard = |guard: &Guard| match (
            guard.range,
            guard.side,
            watched(guard.kind, dynamics.elements()),
        ) {
            (Some(range), ..) => {
                let hinge = dynamics.free_hinges()[range.hinge];
                let ends = range.ends().map(|(level, side)| crossing(hinge, level, side));
                ends.into_iter().flatten().reduce(f64::min)
            }
            (None, Side::Known(side), (Coordinate::Angle(hinge), level)) => {
                crossing(hinge, level, side)
            }
            (None, Side::Known(side), (Coordinate::Length(line), limit)) => {
                let above =
                    |time: f64| self.longer(dynamics, line, limit, time).map(|more| side * more);
                self::crossing(above, now, farthest)
            }
            _ => None,
        };
        self.list.iter().filter_map(of_guard).reduce(f64::min)
    }

    /// Whether an angle that goes on at twice the rate it has at the end of the step comes to a level soon; mostly
    /// it does not, and this costs next to nothing.
    fn comes_near(&self, hinge: usize, (level, side): (f64, f64), soon: f64) -> bool {
        let coefficients = match (self.outlook.since, self.angles.known(hinge)) {
            (None, Some(angle)) => angle.coefficients(),
            (since, _) => return since.is_some(),
        };
        let [.., before, last] = *coefficients else { return false };
        let rate = (coefficients.len() - 1) as f64 * (last - before) / self.angles.length();
        (last - level + 2.0 * soon * rate) * side < 0.0
    }

    /// By how much the squared length of a line is expected to exceed that of a limit.
    fn longer(&self, dynamics: &Recursive<f64>, line: usize, limit: f64, time: f64) -> Option<f64> {
        let free = dynamics.free_hinges();
        let angle = |position: usize| self.outlook.angle(&self.angles, free[position], time);
        let squared =
            dynamics.line_length_squared(line, |position| angle(position).unwrap_or(f64::NAN));
        (!squared.is_nan()).then_some(squared - limit * limit)
    }
}

/// About when a function that is positive `now` is zero, if it is negative at the `farthest` time.
fn crossing(above: impl Fn(f64) -> Option<f64>, now: f64, farthest: f64) -> Option<f64> {
    let mut far = (farthest, above(farthest).filter(|value| *value < 0.0)?);
    let mut near = (now, above(now).filter(|value| *value > 0.0)?);
    // The secant rule; the value at an end that stays twice counts for half (the Illinois rule).
    let (mut found, mut last_side) = (now, 0.0);
    for _ in 0..SECANTS {
        let time = near.0 + (far.0 - near.0) * near.1 / (near.1 - far.1);
        let (value, change) = (above(time)?, (time - found).abs());
        found = time;
        if change <= CLOSE * (time - now) {
            return Some(found);
        }
        let stays = if value.signum() == last_side { 0.5 } else { 1.0 };
        if value > 0.0 {
            (near, far.1) = ((time, value), stays * far.1);
        } else {
            (far, near.1) = ((time, value), stays * near.1);
        }
        last_side = value.signum();
    }
    None
}
