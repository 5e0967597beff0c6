use nboom_dynamics::Recursive;
use nboom_elements::{Coordinate, Elements};
use nboom_model::{HingeState, Mode, Release, Scene, Stop};
use nboom_ode::{Interpolation, Stepper};
use nboom_scalar::{Eight, Number, Real};

use crate::equations::Equations;
use crate::equations::state::State;
use crate::events::angle_range::AngleRange;
use crate::events::angles::Angles;
use crate::events::bound::Bound;
use crate::events::event::EventKind;
use crate::events::instant::{self, Outcome};
use crate::events::line_path::LinePath;
use crate::events::outlook::Outlook;
use crate::events::side::{LockSide, Side};

/// A quantity whose change of sign is an event.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guard {
    pub kind: GuardKind,
    pub(super) side: Side,
    /// The angles at which it keeps its side, of a line's length that one hinge changes.
    pub(super) range: Option<AngleRange>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum GuardKind {
    /// β of the hinge less its lock angle.
    Lock { hinge: usize, angle: f64 },
    /// β of `trigger` less the angle at which it releases `hinge`.
    Trigger { hinge: usize, trigger: usize, angle: f64 },
    /// β of the hinge less the angle at a stop of it.
    Stop { hinge: usize, stop: Stop },
    /// The length or angle of an element less a bound of its law.
    Bound(Bound),
}

impl GuardKind {
    /// The hinge to which something happens when it changes sign.
    pub fn hinge(self) -> usize {
        match self {
            Self::Lock { hinge, .. } | Self::Trigger { hinge, .. } | Self::Stop { hinge, .. } => {
                hinge
            }
            Self::Bound(bound) => bound.element.hinge,
        }
    }

    /// What happens to the hinge when it changes sign.
    pub fn event(self) -> EventKind {
        match self {
            Self::Lock { .. } => EventKind::LockUp,
            Self::Stop { .. } => EventKind::Impact,
            Self::Trigger { .. } => EventKind::Release,
            Self::Bound(Bound { element, rises: true, .. }) => EventKind::Rise(element.kind),
            Self::Bound(Bound { element, rises: false, .. }) => EventKind::Fall(element.kind),
        }
    }

    /// How fast it goes, in natural sizes of what it watches per time unit: radians, strokes, or lengths at
    /// the bound.
    pub fn pace<R: Number>(
        self,
        scene: &Scene,
        elements: &Elements<R>,
        reading: Reading<R>,
    ) -> f64 {
        let rate = reading.rate.to_f64().abs();
        match self {
            Self::Lock { hinge, .. }
            | Self::Trigger { trigger: hinge, .. }
            | Self::Stop { hinge, .. } => rate / scene.coordinate_scale(hinge),
            Self::Bound(bound) => match bound.scale(elements) {
                0.0 => 0.0,
                scale => rate / scale,
            },
        }
    }

    /// The size by which a difference from a bound is told from rounding; zero for other guards,
    /// which are exact.
    fn scale<R: Real>(self, elements: &Elements<R>) -> f64 {
        match self {
            Self::Lock { .. } | Self::Trigger { .. } | Self::Stop { .. } => 0.0,
            Self::Bound(bound) => bound.scale(elements),
        }
    }
}

impl Guard {
    /// How long before or after the reading it is zero, if it leaves its side there.
    pub fn time_away<R: Number>(&self, reading: Reading<R>) -> Option<f64> {
        let (value, rate) = (reading.value.to_f64(), reading.rate.to_f64());
        let sign = match (self.side, self.kind) {
            (Side::Known(sign), _) => sign,
            // It may leave its stop and come back within one step.
            (Side::Leaving { .. }, GuardKind::Stop { stop, .. }) => stop.away,
            (Side::Leaving { .. }, _) => return None,
        };
        (rate * sign < 0.0).then(|| (value / rate).abs())
    }
}

/// What a guard is at one state.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading<R> {
    pub value: R,
    pub rate: R,
}

/// The largest hinge motion over which a line's length is represented by one polynomial.
const PIECE: f64 = 0.5;

/// Share of its scale by which a length or angle may miss a bound and count as being there.
const AT_BOUND: f64 = 1e-13;

/// Share of its scale by which a length or angle that leaves a bound must have moved before the way
/// it moves is told from rounding.
const BEYOND_ROUNDING: f64 = 1e-12;

/// The guards of one mode.
pub(crate) struct Guards {
    pub list: Vec<Guard>,
    interpolation: Interpolation,
    path: LinePath,
    pub(super) angles: Angles,
    pub(super) outlook: Outlook,
}

impl Guards {
    pub fn new() -> Self {
        Self {
            list: Vec::new(),
            interpolation: Interpolation::new(),
            path: LinePath::default(),
            angles: Angles::default(),
            outlook: Outlook::default(),
        }
    }

    /// Sets the guards of `mode` at `state`. `lock_sides` has the side of its lock angle that each
    /// hinge is on, none for one that was on it when it became free and has not left it; `outcome` is that of
    /// the instant in which the mode begins.
    pub fn set<R: Number>(
        &mut self,
        scene: &Scene,
        mode: &Mode,
        dynamics: &Recursive<R>,
        state: &State<R>,
        lock_sides: &[Option<LockSide>],
        outcome: &Outcome<R>,
    ) {
        self.list.clear();
        // How an angle leaves the level of its guard.
        let leaving = |hinge: usize, sign: Option<f64>, at_rest: bool| {
            let gradually = at_rest && outcome.starts_gradually(hinge);
            Side::Leaving { sign, zeros: 1 + usize::from(at_rest), gradually }
        };
        // Steps that look for events allocate nothing.
        self.path.make_room(dynamics.free_hinges().len());
        for (i, body) in scene.bodies.iter().enumerate() {
            if let Some(angle) = body.hinge.lock_angle.filter(|_| mode.is_free(i)) {
                let leaving = leaving(i, None, state.tau[i] == R::zero());
                let side = lock_sides[i].map_or(leaving, |side| Side::Known(side.sign()));
                let kind = GuardKind::Lock { hinge: i, angle };
                self.list.push(Guard { kind, side, range: None });
            }
            for stop in body.hinge.stops.iter().filter(|_| mode.is_free(i)) {
                let leaving = leaving(i, Some(stop.away), state.tau[i] == R::zero());
                let is_at_stop = state.beta[i].to_f64() == stop.angle;
                let side = if is_at_stop { leaving } else { Side::Known(stop.away) };
                let kind = GuardKind::Stop { hinge: i, stop };
                self.list.push(Guard { kind, side, range: None });
            }
            if let Release::Angle { hinge: trigger, angle } = body.hinge.release
                && mode.hinges[i] == HingeState::Unreleased
                && mode.is_free(trigger)
            {
                let side = Side::Known((state.beta[trigger].to_f64() - angle).signum());
                let kind = GuardKind::Trigger { hinge: i, trigger, angle };
                self.list.push(Guard { kind, side, range: None });
            }
        }
        for bound in Bound::all(dynamics, mode) {
            let (kind, sign) = (GuardKind::Bound(bound), if bound.rises { -1.0 } else { 1.0 });
            let Reading { value, rate } = read(kind, dynamics, state);
            let at_bound = outcome.has_crossed(bound)
                || value.to_f64().abs() <= AT_BOUND * bound.scale(dynamics.elements());
            let coordinate = watched(kind, dynamics.elements());
            let at_rest = rate == R::zero();
            let leaving = match coordinate.0 {
                // A rate at rest is zero itself; its derivative is not.
                Coordinate::Rate(hinge) => {
                    let gradually = outcome.starts_gradually(hinge);
                    Side::Leaving { sign: Some(sign), zeros: 1, gradually }
                }
                Coordinate::Angle(hinge) => leaving(hinge, Some(sign), at_rest),
                Coordinate::Length(_) => {
                    let zeros = 1 + usize::from(at_rest);
                    Side::Leaving { sign: Some(sign), zeros, gradually: false }
                }
            };
            let side = if at_bound { leaving } else { Side::Known(sign) };
            let free = dynamics.free_hinges();
            let beta = |j: usize| state.beta[free[j]].to_f64();
            let range = match coordinate {
                (Coordinate::Length(line), limit) if !at_bound => {
                    AngleRange::of(dynamics, (line, limit), beta, sign)
                }
                _ => None,
            };
            self.list.push(Guard { kind, side, range });
        }
    }

    /// Forgets the steps of a run of `scene` before.
    pub fn begin(&mut self, scene: &Scene) {
        self.angles.forget(scene.bodies.len());
        self.outlook.goes_on();
    }

    /// The guard that first changes sign within the step that dense output was prepared for,
    /// and at which fraction of it.
    pub fn first_change(
        &mut self,
        equations: &Equations,
        stepper: &dyn Stepper,
    ) -> Option<(GuardKind, f64)> {
        let mut first: Option<(GuardKind, f64)> = None;
        let dynamics = &equations.entered.dynamics;
        let free = dynamics.free_hinges();
        let position_of =
            |hinge| dynamics.position_of(hinge).expect("guards watch only free hinges");
        let layout = &equations.variables.layout;
        let (first_angle, first_rate) = (layout.beta().start, layout.hinge_motion().start);
        self.angles.begin(stepper.window());
        self.outlook.goes_on();
        for i in 0..self.list.len() {
            let guard = self.list[i];
            let watched = watched(guard.kind, dynamics.elements());
            let change = match (guard.range, watched) {
                (Some(range), _) => {
                    let variable = first_angle + range.hinge;
                    range.left_by(self.angles.of(free[range.hinge], variable, stepper))
                }
                (None, (Coordinate::Length(line), limit)) => {
                    self.length_change(equations, stepper, (line, limit), guard.side)
                }
                (None, (Coordinate::Angle(hinge), angle)) => {
                    let position = position_of(hinge);
                    let polynomial = self.angles.of(hinge, first_angle + position, stepper);
                    guard.side.change(polynomial, angle)
                }
                (None, (Coordinate::Rate(hinge), rate)) => {
                    let polynomial = &stepper.polynomial(first_rate + position_of(hinge));
                    guard.side.change(polynomial, rate)
                }
            };
            if let Some(fraction) = change.filter(|&f| first.is_none_or(|(_, g)| f < g)) {
                first = Some((guard.kind, fraction));
            }
        }
        first
    }

    /// The hinges that wait for their lock angles, where each is nearest to it in the beginning of the step that was
    /// [searched](Self::first_change), as a fraction of that step up to `end`, and its distance there. Those that
    /// became free at their lock angles are left out.
    pub fn nearest(
        &self,
        equations: &Equations,
        end: f64,
    ) -> impl Iterator<Item = (usize, [f64; 2])> {
        let bodies = &equations.scene.bodies;
        self.list.iter().filter_map(move |guard| match (guard.kind, guard.side) {
            (GuardKind::Lock { hinge, angle }, Side::Known(sign))
                if bodies[hinge].hinge.start.angle != angle =>
            {
                let over_step = self.angles.known(hinge)?;
                let (fraction, distance) = over_step.nearest(angle, sign, end);
                Some((hinge, [fraction, distance.max(0.0)]))
            }
            _ => None,
        })
    }

    /// Notes on which side of zero each guard that had been leaving it is at `state`.
    pub fn note_sides<R: Number>(&mut self, dynamics: &Recursive<R>, state: &State<R>) {
        for guard in &mut self.list {
            if let Side::Leaving { .. } = guard.side {
                let value = read(guard.kind, dynamics, state).value.to_f64();
                let scale = guard.kind.scale(dynamics.elements());
                // What leaves a stop is not beyond it, but for rounding.
                let is_beyond =
                    matches!(guard.kind, GuardKind::Stop { stop, .. } if value * stop.away <= 0.0);
                if value.abs() > BEYOND_ROUNDING * scale && !is_beyond {
                    guard.side = Side::Known(value.signum());
                }
            }
        }
    }

    /// Whether a guard other than `located` has left its side before `state`, and not in the same
    /// instant.
    pub fn missed<R: Number>(
        &self,
        scene: &Scene,
        dynamics: &Recursive<R>,
        state: &State<R>,
        located: Option<GuardKind>,
    ) -> bool {
        let of_located = located.map_or(0.0, |kind| {
            let reading = read(kind, dynamics, state);
            kind.pace(scene, dynamics.elements(), reading)
        });
        let mut others = self.list.iter().filter(|guard| Some(guard.kind) != located);
        others.any(|guard| {
            let reading = read(guard.kind, dynamics, state);
            let value = reading.value.to_f64();
            let has_left = match guard.side {
                Side::Known(sign) => value * sign < 0.0,
                Side::Leaving { sign, .. } => sign.is_some_and(|s| {
                    value * s < -BEYOND_ROUNDING * guard.kind.scale(dynamics.elements())
                }),
            };
            let pace = guard.kind.pace(scene, dynamics.elements(), reading).max(of_located);
            let instant = instant::duration(scene, state.time.to_f64(), pace);
            has_left && guard.time_away(reading).is_none_or(|away| away > instant)
        })
    }

    /// The side that a lock guard of `hinge` is known to be on.
    pub fn lock_side(&self, hinge: usize) -> Option<LockSide> {
        let locks =
            |guard: &&Guard| matches!(guard.kind, GuardKind::Lock { hinge: of, .. } if of == hinge);
        match self.list.iter().find(locks)?.side {
            Side::Known(sign) => LockSide::of_sign(sign),
            Side::Leaving { .. } => None,
        }
    }

    /// Follows a line's length in pieces, each so short that a polynomial represents it.
    fn length_change(
        &mut self,
        equations: &Equations,
        stepper: &dyn Stepper,
        (line, limit): (usize, f64),
        side: Side,
    ) -> Option<f64> {
        let Self { path, angles, interpolation, .. } = self;
        let dynamics = &equations.entered.dynamics;
        let first = equations.variables.layout.beta().start;
        let free = dynamics.free_hinges();
        let angle = |hinge| *angles.of(free[hinge], first + hinge, stepper);
        path.follow(dynamics, (line, limit), angle);
        let pieces = (path.turned / PIECE).ceil().clamp(1.0, 1e4) as usize;
        let mut side = side;
        (0..pieces).find_map(|piece| {
            let within = |point: f64| (piece as f64 + point) / pieces as f64;
            let squares = path.squares_at(dynamics, Eight(interpolation.points().map(within)));
            let values = squares.0.map(|squared| squared - limit * limit);
            let polynomial = interpolation.through(&values);
            let has_left = polynomial.excursion() > BEYOND_ROUNDING * limit * limit;
            let known = matches!(side, Side::Known(_));
            let change = side.change(&polynomial, 0.0).filter(|_| known || has_left);
            if let Side::Leaving { .. } = side {
                side = Side::Known(values[values.len() - 1].signum());
            }
            change.map(|within| (piece as f64 + within) / pieces as f64)
        })
    }
}

/// Value and rate of a guard at `state`.
pub(crate) fn read<R: Number>(
    kind: GuardKind,
    dynamics: &Recursive<R>,
    state: &State<R>,
) -> Reading<R> {
    let (coordinate, bound) = watched(kind, dynamics.elements());
    let [value, rate] = state.coordinate(dynamics, coordinate);
    Reading { value: value - R::constant(bound), rate }
}

/// What a guard watches, and the value that it waits for.
pub(crate) fn watched<R: Real>(kind: GuardKind, elements: &Elements<R>) -> (Coordinate, f64) {
    match kind {
        GuardKind::Lock { hinge, angle } | GuardKind::Trigger { trigger: hinge, angle, .. } => {
            (Coordinate::Angle(hinge), angle)
        }
        GuardKind::Stop { hinge, stop } => (Coordinate::Angle(hinge), stop.angle),
        GuardKind::Bound(bound) => {
            let element = &elements.switched()[bound.element.index];
            (element.coordinate, element.bounds[bound.number])
        }
    }
}
