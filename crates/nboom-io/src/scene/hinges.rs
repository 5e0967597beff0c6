//! Joints in words: how they start, what acts about or along them, when they are released and lock.

use nboom_model::{BodyDraft, Dashpot, HingeState, Joint, ReleaseDraft, Spring};

use super::catalog::STATES;
use super::fields::{Fields, Reader};
use crate::words::{self, DamperWords};

/// Reads what the table of a joint says about how it moves.
pub(super) fn read(
    reader: &mut Reader<'_, '_>,
    joint: Joint,
    table: &Fields<'_>,
    body: &mut BodyDraft,
) {
    let mut words = words::joint(joint);
    words.release = table.has("release").then(|| reader.release(table));
    words.state = reader.state(table);
    words.start = reader.coordinate(joint, table, "start").unwrap_or(words.start);
    words.rate = reader.coordinate(joint, table, joint.rate_name()).unwrap_or(words.rate);
    words.latch = reader.coordinate(joint, table, "latch");
    if let Some([lower, upper]) = reader.limits(table, "stops") {
        (words.stops.lower, words.stops.upper) = (lower, upper);
    }
    words.stops.restitution = reader.number(table, "restitution").unwrap_or(0.0);
    reader.warn_if_stops_are_idle(table, &words);
    words.spring = reader.spring(joint, table);
    words.damper = reader.damper(joint, table);
    words.friction = reader.number(table, "friction").unwrap_or(0.0);
    words.torque = match joint {
        Joint::Revolute => reader.angle_pairs(table, "torque"),
        Joint::Prismatic => reader.rows(table, "force"),
    };
    for key in ["torque", "force"] {
        reader.warn_if_idle(table, key, &[]);
        reader.warn_if_zero_throughout(table, key);
    }
    for (key, found, expected) in words.contradictions() {
        reader.error(&table.place(key), table.written(key), &found, expected);
    }
    words.act_on(body);
}

impl Reader<'_, '_> {
    /// A coordinate of a joint, or its rate.
    fn coordinate(&mut self, joint: Joint, table: &Fields<'_>, key: &'static str) -> Option<f64> {
        match joint {
            Joint::Revolute => self.angle(table, key),
            Joint::Prismatic => self.number(table, key),
        }
    }

    fn release(&mut self, hinge: &Fields<'_>) -> ReleaseDraft {
        let Some(release) = self.table(hinge, "release") else { return ReleaseDraft::Never };
        if let Some(time) = self.number(&release, "at") {
            for key in ["passes", "reaches", "by"] {
                self.refuse_beside(&release, "at", key);
            }
            return ReleaseDraft::At(time);
        }
        if let Some(after) = self.text(&release, "after") {
            let after = words::after(after);
            self.refuse_beside(&release, "after", "passes");
            self.refuse_beside(&release, "after", "reaches");
            let by = self.number(&release, "by");
            return by.map_or(after.clone(), |by| after.by(by)).into();
        }
        self.refuse_beside(&release, "when", "by");
        let (passes, reaches) = (self.angle(&release, "passes"), self.number(&release, "reaches"));
        let Some(when) = self.text(&release, "when") else { return ReleaseDraft::Never };
        match (passes, reaches) {
            (Some(_), Some(_)) => self.refuse_beside(&release, "passes", "reaches"),
            (Some(passes), None) => return words::when(when).passes_rad(passes),
            (None, Some(reaches)) => return words::when(when).reaches(reaches),
            (None, None) if !release.has("passes") && !release.has("reaches") => {
                let expected = "passes_deg, passes_rad or reaches beside it";
                self.error(&release.at, "release", "`when` alone", expected);
            }
            (None, None) => {}
        }
        ReleaseDraft::Never
    }

    /// Reports a key that says nothing beside another.
    fn refuse_beside(&mut self, release: &Fields<'_>, given: &str, vain: &'static str) {
        if release.has(vain) {
            let found = format!("`{vain}` beside `{given}`");
            self.error(&release.place(vain), vain, &found, "a key that belongs to it");
        }
    }

    fn state(&mut self, hinge: &Fields<'_>) -> Option<HingeState> {
        self.choice(hinge, "state", STATES).and_then(HingeState::named)
    }

    fn spring(&mut self, joint: Joint, of: &Fields<'_>) -> Spring {
        let Some(spring) = self.table(of, "spring") else { return Spring::default() };
        let mut words = words::spring(self.number(&spring, "stiffness").unwrap_or(0.0));
        if let Some(quadratic) = self.number(&spring, "quadratic") {
            words = words.quadratic(quadratic);
        }
        self.coordinate(joint, &spring, "rest").map_or(words, |rest| words.rest_rad(rest)).into()
    }

    fn damper(&mut self, joint: Joint, of: &Fields<'_>) -> Dashpot {
        let Some(damper) = self.table(of, "damper") else { return Dashpot::default() };
        let [rate_squared, angle, angle_squared] = joint.damper_names();
        self.warn_if_idle(of, "damper", &["damping", rate_squared, angle, angle_squared]);
        let has_rest = [angle, angle_squared].iter().any(|key| damper.has(key));
        if let (Some((rest, _)), false, true) =
            (damper.entry("rest"), has_rest, damper.has("damping") || damper.has(rate_squared))
        {
            let expected = format!("{angle} or {angle_squared} beside it");
            let found = "a rest on which nothing depends";
            self.report.warn_at(self.sources, &rest.node.at, &rest.key, found, &expected);
        }
        let mut words = words::damper(self.number(&damper, "damping").unwrap_or(0.0));
        let mut set = |key, to: fn(DamperWords, f64) -> DamperWords| {
            if let Some(number) = self.number(&damper, key) {
                words = to(words, number);
            }
        };
        set(rate_squared, DamperWords::rate_squared);
        set(angle, DamperWords::angle);
        set(angle_squared, DamperWords::angle_squared);
        self.coordinate(joint, &damper, "rest").map_or(words, |rest| words.rest_rad(rest)).into()
    }
}
