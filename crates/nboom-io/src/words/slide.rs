use nboom_model::{Dashpot, HingeState, Joint, ReleaseDraft, Spring};
use nboom_scalar::Vec3;

use super::{Axes, Direction, HingeWords, joint};

/// A joint that slides, in words. Its travel is zero where the body is drawn.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct SlideWords(pub(super) HingeWords);

/// A joint that slides; `at` and `axis` must be given.
pub fn slide() -> SlideWords {
    SlideWords(joint(Joint::Prismatic))
}

impl SlideWords {
    /// Where the body's origin is on the inboard body at travel zero, from its origin, its axes.
    pub fn at(self, at: impl Into<Vec3<f64>>) -> Self {
        Self(self.0.at(at))
    }

    /// Direction in which the travel grows, body axes.
    pub fn axis(self, axis: impl Into<Direction>) -> Self {
        Self(self.0.axis(axis))
    }

    /// Turns the body's axes; by default they are parallel to those of its inboard body.
    pub fn axes(self, axes: Axes) -> Self {
        Self(self.0.axes(axes))
    }

    /// Travel at the start \[L\]; by default 0.
    pub fn start(self, start: f64) -> Self {
        Self(self.0.start_rad(start))
    }

    /// Speed at the start, of a free joint \[L/T\]; by default 0.
    pub fn speed(self, speed: f64) -> Self {
        Self(self.0.rate_rad(speed))
    }

    /// How it starts; by default held if it has a release, else free.
    pub fn state(self, state: HingeState) -> Self {
        Self(self.0.state(state))
    }

    /// When the held joint becomes free: [`at`](super::at()), [`when`](super::when) or
    /// [`after`](super::after()); by default never.
    pub fn release(self, release: impl Into<ReleaseDraft>) -> Self {
        Self(self.0.release(release))
    }

    /// Travel at which it locks for good \[L\]; by default it never does.
    pub fn latch(self, latch: f64) -> Self {
        Self(self.0.latch_rad(latch))
    }

    /// The least and the largest travel, at which its motion ends \[L\]; infinite for none on that side, and by default
    /// none.
    pub fn stops(self, stops: [f64; 2]) -> Self {
        Self(self.0.stops_rad(stops))
    }

    /// Share of its speed at which it rebounds from its stops, from 0 to 1; by default 0.
    pub fn restitution(self, restitution: f64) -> Self {
        Self(self.0.restitution(restitution))
    }

    /// A [`spring`](super::spring()) along its axis.
    pub fn spring(self, spring: impl Into<Spring>) -> Self {
        Self(self.0.spring(spring))
    }

    /// A [`damper`](super::damper()) along its axis.
    pub fn damper(self, damper: impl Into<Dashpot>) -> Self {
        Self(self.0.damper(damper))
    }

    /// The force of Coulomb's friction, zero or more; by default 0.
    pub fn friction(self, friction: f64) -> Self {
        Self(self.0.friction(friction))
    }

    /// Force by travel as pairs, smooth between them, straight beyond the first and last; positive drives to larger travel.
    pub fn force(self, points: &[[f64; 2]]) -> Self {
        Self(self.0.torque_rad(points))
    }
}
