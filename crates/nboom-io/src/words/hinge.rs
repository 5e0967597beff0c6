use nboom_model::{
    BodyDraft, Dashpot, HingeStart, HingeState, Joint, Mount, ReleaseDraft, Spring, Stops,
};
use nboom_scalar::{Mat3, Vec3};

use super::error::of_body;
use super::{Axes, Direction, WordsError};

/// The hinge of a body, in words.
#[derive(Clone, Debug, Default, PartialEq)]
#[must_use]
pub struct HingeWords {
    pub(crate) joint: Joint,
    at: Option<Vec3<f64>>,
    axis: Option<Direction>,
    axes: Option<Axes>,
    pub(crate) start: f64,
    pub(crate) rate: f64,
    pub(crate) state: Option<HingeState>,
    pub(crate) release: Option<ReleaseDraft>,
    pub(crate) latch: Option<f64>,
    pub(crate) stops: Stops,
    pub(crate) spring: Spring,
    pub(crate) damper: Dashpot,
    pub(crate) friction: f64,
    pub(crate) torque: Vec<[f64; 2]>,
}

/// A hinge; `at` and `axis` must be given.
pub fn hinge() -> HingeWords {
    HingeWords::default()
}

/// A joint of this kind, in words.
pub(crate) fn joint(joint: Joint) -> HingeWords {
    HingeWords { joint, ..HingeWords::default() }
}

impl HingeWords {
    /// Where it is on the inboard body, from its origin, its axes.
    pub fn at(mut self, at: impl Into<Vec3<f64>>) -> Self {
        self.at = Some(at.into());
        self
    }

    /// Direction of its axis, body axes; angles follow the right hand.
    pub fn axis(mut self, axis: impl Into<Direction>) -> Self {
        self.axis = Some(axis.into());
        self
    }

    /// Turns the body's axes at angle zero; by default they are parallel to those of its inboard body.
    pub fn axes(mut self, axes: Axes) -> Self {
        self.axes = Some(axes);
        self
    }

    /// Angle at the start \[degrees\]; by default 0.
    pub fn start_deg(self, start: f64) -> Self {
        self.start_rad(start.to_radians())
    }

    /// Angle at the start \[radians\]; by default 0.
    pub fn start_rad(mut self, start: f64) -> Self {
        self.start = start;
        self
    }

    /// Rate at the start, of a free hinge \[degrees/T\]; by default 0.
    pub fn rate_deg(self, rate: f64) -> Self {
        self.rate_rad(rate.to_radians())
    }

    /// Rate at the start, of a free hinge \[radians/T\]; by default 0.
    pub fn rate_rad(mut self, rate: f64) -> Self {
        self.rate = rate;
        self
    }

    /// How it starts; by default held if it has a release, else free.
    pub fn state(mut self, state: HingeState) -> Self {
        self.state = Some(state);
        self
    }

    /// When the held hinge becomes free: [`at`](super::at()), [`when`](super::when) or
    /// [`after`](super::after()); by default never.
    pub fn release(mut self, release: impl Into<ReleaseDraft>) -> Self {
        self.release = Some(release.into());
        self
    }

    /// Angle at which it locks for good \[degrees\]; by default it never does.
    pub fn latch_deg(self, latch: f64) -> Self {
        self.latch_rad(latch.to_radians())
    }

    /// Angle at which it locks for good \[radians\]; by default it never does.
    pub fn latch_rad(mut self, latch: f64) -> Self {
        self.latch = Some(latch);
        self
    }

    /// The least and the largest angle, at which its motion ends \[degrees\]; infinite for none on that side, and by
    /// default none.
    pub fn stops_deg(self, stops: [f64; 2]) -> Self {
        self.stops_rad(stops.map(f64::to_radians))
    }

    /// The least and the largest angle, at which its motion ends \[radians\]; infinite for none on that side, and by
    /// default none.
    pub fn stops_rad(mut self, [lower, upper]: [f64; 2]) -> Self {
        self.stops = Stops { lower, upper, ..self.stops };
        self
    }

    /// Share of its rate at which it rebounds from its stops, from 0 to 1; by default 0.
    pub fn restitution(mut self, restitution: f64) -> Self {
        self.stops.restitution = restitution;
        self
    }

    /// A [`spring`](super::spring()) about its axis.
    pub fn spring(mut self, spring: impl Into<Spring>) -> Self {
        self.spring = spring.into();
        self
    }

    /// A [`damper`](super::damper()) about its axis.
    pub fn damper(mut self, damper: impl Into<Dashpot>) -> Self {
        self.damper = damper.into();
        self
    }

    /// The torque of Coulomb's friction, zero or more; by default 0.
    pub fn friction(mut self, friction: f64) -> Self {
        self.friction = friction;
        self
    }

    /// Torque by angle \[degrees\] as pairs, smooth between them, straight beyond the first and last; positive opens to larger angles.
    pub fn torque_deg(self, points: &[[f64; 2]]) -> Self {
        let radians = points.iter().map(|[angle, torque]| [angle.to_radians(), *torque]);
        self.torque_rad(&radians.collect::<Vec<_>>())
    }

    /// Torque by angle \[radians\] as pairs, smooth between them, straight beyond the first and last; positive opens to larger angles.
    pub fn torque_rad(mut self, points: &[[f64; 2]]) -> Self {
        self.torque = points.to_vec();
        self
    }

    /// How the hinge starts. One with a release is held unless `state` says otherwise, and one that does not
    /// start free has no rate.
    pub(crate) fn starts(&self) -> HingeStart {
        let by_default =
            if self.release.is_some() { HingeState::Unreleased } else { HingeState::Free };
        let state = self.state.unwrap_or(by_default);
        let rate = if state == HingeState::Free { self.rate } else { 0.0 };
        HingeStart { angle: self.start, rate, state }
    }

    /// Whether it starts free or something releases it.
    pub(crate) fn can_move(&self) -> bool {
        match self.starts().state {
            HingeState::Free => true,
            HingeState::Unreleased => self.release.is_some(),
            HingeState::Locked | HingeState::Stuck => false,
        }
    }

    /// What a state has no use for: a release of a hinge that is not held, or a rate of one that is not
    /// free; the key, what was found, what is expected.
    pub(crate) fn contradictions(&self) -> Vec<(&'static str, String, &'static str)> {
        let state = self.starts().state;
        let word = state.name();
        let mut found = Vec::new();
        if state != HingeState::Unreleased && self.release.is_some() {
            let release = format!("a release of a hinge that starts {word}");
            found.push(("release", release, "state = \"held\", or no release"));
        }
        if state != HingeState::Free && self.rate != 0.0 {
            let rate = format!("a rate of a hinge that starts {word}");
            found.push((self.joint.rate_name(), rate, "zero, or state = \"free\""));
        }
        found
    }

    /// Gives a body what acts at its joint, and how it starts and locks.
    pub(crate) fn act_on(self, body: &mut BodyDraft) {
        body.joint = self.joint;
        body.hinge.start = self.starts();
        body.hinge.lock_angle = self.latch;
        body.hinge.stops = self.stops;
        body.hinge.spring = self.spring;
        body.hinge.dashpot = self.damper;
        body.hinge.friction = self.friction;
        body.release = self.release.unwrap_or(ReleaseDraft::Never);
        body.torque_table = self.torque;
    }

    /// Where it is and about which axis. Stand-ins take the place of what is wrong.
    pub(super) fn place(&self, body: &str, errors: &mut Vec<WordsError>) -> (Mount, Vec3<f64>) {
        let of = || format!("{}, {}", of_body(body), self.joint.name());
        let wrong = |key, (found, expected)| WordsError::Value { of: of(), key, found, expected };
        let missing = |key| WordsError::Missing { of: of(), key };
        errors.extend(
            (self.contradictions().into_iter())
                .map(|(key, found, expected)| wrong(key, (found, expected))),
        );
        if self.at.is_none() {
            errors.push(missing("at"));
        }
        let point = self.at.unwrap_or_else(Vec3::zero);
        let axis = match &self.axis {
            Some(axis) => axis.unit().map_err(|why| wrong("axis", why)),
            None => Err(missing("axis")),
        };
        let axes = self.axes.as_ref().map(|axes| axes.rotation().and_then(|axes| axes.matrix()));
        let axes = axes.unwrap_or_else(|| Ok(Mat3::identity())).map_err(|why| wrong("axes", why));
        let mut or = |error| errors.push(error);
        let rot_inboard_from_hinge = axes.map_err(&mut or).unwrap_or_else(|()| Mat3::identity());
        let axis = axis.map_err(or).unwrap_or_else(|()| Vec3::unit_x());
        (Mount { point, rot_inboard_from_hinge }, axis)
    }
}
