//! Hinges in words: how they start, what acts about them, when they are released and lock.

use nboom_model::{BodyDraft, Dashpot, HingeState, ReleaseDraft, Spring};

use super::catalog::STATES;
use super::fields::{Fields, Reader};
use crate::words::{self, DamperWords};

/// Reads what the table of a hinge says about how it moves.
pub(super) fn read(reader: &mut Reader<'_, '_>, hinge: &Fields<'_>, body: &mut BodyDraft) {
    let mut words = words::hinge();
    words.release = hinge.has("release").then(|| reader.release(hinge));
    words.state = reader.state(hinge);
    words.start = reader.angle(hinge, "start").unwrap_or(words.start);
    words.rate = reader.angle(hinge, "rate").unwrap_or(words.rate);
    words.latch = reader.angle(hinge, "latch");
    words.spring = reader.spring(hinge);
    words.damper = reader.damper(hinge);
    words.torque = reader.angle_pairs(hinge, "torque");
    for (key, found, expected) in words.contradictions() {
        reader.error(&hinge.place(key), key, &found, expected);
    }
    words.act_on(body);
}

impl Reader<'_, '_> {
    fn release(&mut self, hinge: &Fields<'_>) -> ReleaseDraft {
        let Some(release) = self.table(hinge, "release") else { return ReleaseDraft::Never };
        if let Some(time) = self.number(&release, "at") {
            self.refuse_beside(&release, "at", "passes");
            self.refuse_beside(&release, "at", "by");
            return ReleaseDraft::At(time);
        }
        if let Some(after) = self.text(&release, "after") {
            let after = words::after(after);
            self.refuse_beside(&release, "after", "passes");
            let by = self.number(&release, "by");
            return by.map_or(after.clone(), |by| after.by(by)).into();
        }
        self.refuse_beside(&release, "when", "by");
        let passes = self.angle(&release, "passes");
        match (self.text(&release, "when"), passes) {
            (Some(when), Some(passes)) => ReleaseDraft::Passes { when: when.to_owned(), passes },
            (Some(_), None) if !release.has("passes") => {
                let expected = "passes_deg or passes_rad beside it, the angle";
                self.error(&release.at, "release", "`when` alone", expected);
                ReleaseDraft::Never
            }
            _ => ReleaseDraft::Never,
        }
    }

    /// Reports a key that says nothing beside another.
    fn refuse_beside(&mut self, release: &Fields<'_>, given: &str, vain: &'static str) {
        if release.has(vain) {
            let found = format!("`{vain}` beside `{given}`");
            self.error(&release.place(vain), vain, &found, "a key that belongs to it");
        }
    }

    fn state(&mut self, hinge: &Fields<'_>) -> Option<HingeState> {
        self.choice(hinge, "state", STATES).map(|state| match state {
            "free" => HingeState::Free,
            "locked" => HingeState::Locked,
            _ => HingeState::Unreleased,
        })
    }

    fn spring(&mut self, hinge: &Fields<'_>) -> Spring {
        let Some(spring) = self.table(hinge, "spring") else { return Spring::default() };
        let mut words = words::spring(self.number(&spring, "stiffness").unwrap_or(0.0));
        if let Some(quadratic) = self.number(&spring, "quadratic") {
            words = words.quadratic(quadratic);
        }
        self.angle(&spring, "rest").map_or(words, |rest| words.rest_rad(rest)).into()
    }

    fn damper(&mut self, hinge: &Fields<'_>) -> Dashpot {
        let Some(damper) = self.table(hinge, "damper") else { return Dashpot::default() };
        let mut words = words::damper(self.number(&damper, "damping").unwrap_or(0.0));
        let mut set = |key, to: fn(DamperWords, f64) -> DamperWords| {
            if let Some(number) = self.number(&damper, key) {
                words = to(words, number);
            }
        };
        set("rate_squared", DamperWords::rate_squared);
        set("angle", DamperWords::angle);
        set("angle_squared", DamperWords::angle_squared);
        self.angle(&damper, "rest").map_or(words, |rest| words.rest_rad(rest)).into()
    }
}
