use nboom_model::{
    Dashpot, Hinge, HingeStart, HingeState, KickOffSpring, Release, Segment, Spring, Stops,
};
use nboom_scalar::Vec3;

use super::builder::Builder;
use super::layout::AppendageSegments;
use super::shown;
use super::values::plain;

/// Lock and release angles of a deck \[degrees\] of at least this magnitude never happen, nor do release times
/// from here on.
pub const NEVER: f64 = 1e6;

impl Builder<'_, '_, '_> {
    /// Segment `i`, from 0.
    pub fn segment(&mut self, i: usize, place: &AppendageSegments) -> Segment {
        let length = self.values.real("ELIK", i);
        if length < 0.0 {
            self.error(plain("ELIK"), i, shown(length), "none below zero");
        }
        Segment { length, mass_properties: self.segment_mass(i), hinge: self.hinge(i, place) }
    }

    fn hinge(&mut self, i: usize, place: &AppendageSegments) -> Hinge {
        Hinge {
            spring: self.spring(i),
            dashpot: self.dashpot(i),
            friction: 0.0,
            stops: Stops::NONE,
            kick_off: self.kick_off(i),
            release: self.release(i),
            lock_angle: self.lock_angle(i),
            start: self.start(i, place),
        }
    }

    fn spring(&self, i: usize) -> Spring {
        let k = |j| self.values.real("EKNIK", i + j * self.sizes.segments);
        let preload_angle = self.values.real("THETIK", i).to_radians();
        Spring { quadratic: k(0), linear: k(1), preload_angle }
    }

    fn dashpot(&self, i: usize) -> Dashpot {
        let q = |j| self.values.real("QNIK", i + j * self.sizes.segments);
        Dashpot {
            rate_quadratic: q(0),
            rate_linear: q(1),
            angle_quadratic: q(2),
            angle_linear: q(3),
            preload_angle: self.values.real("GAMAIK", i).to_radians(),
        }
    }

    fn kick_off(&mut self, i: usize) -> Option<KickOffSpring> {
        let coefficients = [0, 1, 2, 3].map(|j| self.values.real("AES", 4 * i + j));
        if coefficients == [0.0; 4] {
            return None;
        }
        let limit_length = self.limit_length(i)?;
        let point = |name| -> Vec3<f64> { self.values.vector(name, i) };
        let (main_body_point, body_point) = (point("RIK1"), point("SIK1"));
        Some(KickOffSpring { main_body_point, body_point, coefficients, limit_length })
    }

    fn limit_length(&mut self, i: usize) -> Option<f64> {
        let key = plain("XIKF");
        let limit = self.values.get("XIKF", i);
        if limit.is_none() && !self.values.is_damaged(key) {
            let at = self.values.position(plain("AES"), 4 * i);
            let label = self.values.label(key, i);
            self.report.error(at, &label, "nothing", "a value, since AES is not all zero");
        }
        limit
    }

    fn lock_angle(&mut self, i: usize) -> Option<f64> {
        let key = plain("BSIK");
        let angle = self.values.get("BSIK", i);
        if angle.is_none() && !self.values.is_damaged(key) {
            let expected = "a lock angle (1e6 for none); the hinge never locks";
            self.warn(key, i, "nothing".to_owned(), expected);
        }
        angle.filter(|angle| angle.abs() < NEVER).map(f64::to_radians)
    }

    fn release(&mut self, i: usize) -> Release {
        let value = self.values.real("RELTB", i);
        let trigger = self.values.real("IREL", i);
        let segments = self.sizes.segments;
        if trigger != 0.0
            && (!(1.0..=segments as f64).contains(&trigger) || trigger == (i + 1) as f64)
        {
            let expected = format!("0 or the number of another segment, at most {segments}");
            self.error(plain("IREL"), i, shown(trigger), &expected);
            return Release::Never;
        }
        if trigger != 0.0 {
            let hinge = trigger as usize - 1;
            let angle = Some(value).filter(|angle| angle.abs() < NEVER).map(f64::to_radians);
            return angle.map_or(Release::Never, |angle| Release::Angle { hinge, angle });
        }
        if value < NEVER {
            return Release::Time(value);
        }
        if self.values.real("SEGSTT", i) == 0.0 {
            self.check_never(i, value);
        }
        Release::Never
    }

    /// A time that means never should not lie within the run.
    fn check_never(&mut self, i: usize, time: f64) {
        let (from, to) = (self.values.real("TZO", 0), self.values.real("TF", 0));
        if time <= to {
            let found =
                format!("time {} in a run from {} to {}", shown(time), shown(from), shown(to));
            let expected =
                "less than 1e6; from there on it means never, and the hinge is not released";
            self.warn(plain("RELTB"), i, found, expected);
        }
    }

    fn start(&mut self, i: usize, place: &AppendageSegments) -> HingeStart {
        let absolute = self.values.real("IAB", 0) != 0.0;
        let (angle, rate) = if absolute { ("ALIK", "SIGIK") } else { ("BETAIK", "TAUIK") };
        let inboard = place.summed_inboard(i).filter(|_| absolute);
        let relative = |name| {
            // In degrees, where most angles and so their differences are exact.
            let inboard = inboard.map_or(0.0, |inboard| self.values.real(name, inboard));
            self.values.real(name, i) - inboard
        };
        let (angle, relative_rate) = (relative(angle), relative(rate));
        let state = self.state(i);
        let turns = state == HingeState::Free;
        if !turns && relative_rate != 0.0 {
            let found = format!("a relative rate of {}", shown(relative_rate));
            let expected = "zero of a hinge that starts held; it is taken as zero";
            self.warn(plain(rate), i, found, expected);
        }
        let rate = if turns { relative_rate.to_radians() } else { 0.0 };
        HingeStart { angle: angle.to_radians(), rate, state }
    }

    fn state(&mut self, i: usize) -> HingeState {
        match self.values.real("SEGSTT", i) {
            0.0 => HingeState::Unreleased,
            1.0 => HingeState::Free,
            2.0 => HingeState::Locked,
            other => {
                let expected = "0 (unreleased), 1 (released) or 2 (locked)";
                self.error(plain("SEGSTT"), i, shown(other), expected);
                HingeState::Unreleased
            }
        }
    }

    /// TSK, which IREL and RELTB superseded, may only repeat them.
    pub fn check_release_times(&mut self, place: &AppendageSegments) {
        let (k, first) = (place.appendage, place.segments.start);
        let Some(time) = self.values.get("TSK", k) else { return };
        let (trigger, value) = (self.values.real("IREL", first), self.values.real("RELTB", first));
        if trigger == 0.0 && value == time {
            self.warn(plain("TSK"), k, shown(time), "RELTB alone; they agree");
        } else {
            let label = self.values.label(plain("RELTB"), first);
            let means = if trigger == 0.0 { "the time" } else { "an angle," };
            let expected = format!("what {label} says, {means} {}", shown(value));
            self.error(plain("TSK"), k, shown(time), &expected);
        }
    }
}
