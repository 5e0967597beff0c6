//! Hinges in words: how they start, what acts about them, when they are released and lock.

use nboom_model::{BodyDraft, Dashpot, HingeStart, HingeState, ReleaseDraft, Spring};

use super::catalog::STATES;
use super::fields::{Fields, Reader};

/// Reads what the table of a hinge says about how it moves.
pub(super) fn read(reader: &mut Reader<'_, '_>, hinge: &Fields<'_>, body: &mut BodyDraft) {
    body.release = reader.release(hinge);
    body.hinge.start = reader.start(hinge);
    body.hinge.lock_angle = reader.angle(hinge, "latch");
    body.hinge.spring = reader.spring(hinge);
    body.hinge.dashpot = reader.damper(hinge);
    body.torque_table = reader.angle_pairs(hinge, "torque");
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
            let by = self.number(&release, "by").unwrap_or(0.0);
            self.refuse_beside(&release, "after", "passes");
            return ReleaseDraft::AfterLock { after: after.to_owned(), by };
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

    fn start(&mut self, hinge: &Fields<'_>) -> HingeStart {
        let state = match self.choice(hinge, "state", STATES) {
            Some("free") => HingeState::Free,
            Some("locked") => HingeState::Locked,
            Some(_) => HingeState::Unreleased,
            None if hinge.has("release") => HingeState::Unreleased,
            None => HingeState::Free,
        };
        let is_held = state != HingeState::Free;
        if state != HingeState::Unreleased && hinge.has("release") {
            let found = format!("a release of a hinge that starts {}", word(state));
            self.error(
                &hinge.place("release"),
                "release",
                &found,
                "state = \"held\", or no release",
            );
        }
        let rate = self.angle(hinge, "rate").unwrap_or(0.0);
        if is_held && rate != 0.0 {
            let found = format!("a rate of a hinge that starts {}", word(state));
            self.error(&hinge.place("rate"), "rate", &found, "zero, or state = \"free\"");
        }
        HingeStart {
            angle: self.angle(hinge, "start").unwrap_or(0.0),
            rate: if is_held { 0.0 } else { rate },
            state,
        }
    }

    fn spring(&mut self, hinge: &Fields<'_>) -> Spring {
        let Some(spring) = self.table(hinge, "spring") else { return Spring::default() };
        let mut number = |key| self.number(&spring, key).unwrap_or(0.0);
        let (stiffness, quadratic) = (number("stiffness"), number("quadratic"));
        let rest = self.angle(&spring, "rest").unwrap_or(0.0);
        Spring { quadratic, linear: opposite(stiffness), preload_angle: opposite(rest) }
    }

    fn damper(&mut self, hinge: &Fields<'_>) -> Dashpot {
        let Some(damper) = self.table(hinge, "damper") else { return Dashpot::default() };
        let mut number = |key| self.number(&damper, key).unwrap_or(0.0);
        let numbers = ["damping", "rate_squared", "angle", "angle_squared"].map(&mut number);
        let [damping, rate_quadratic, angle_linear, angle_quadratic] = numbers;
        let preload_angle = opposite(self.angle(&damper, "rest").unwrap_or(0.0));
        let rate_linear = opposite(damping);
        Dashpot { rate_quadratic, rate_linear, angle_quadratic, angle_linear, preload_angle }
    }
}

/// The negative number, but zero of zero.
fn opposite(number: f64) -> f64 {
    0.0 - number
}

fn word(state: HingeState) -> &'static str {
    match state {
        HingeState::Free => "free",
        HingeState::Unreleased => "held",
        HingeState::Locked => "locked",
    }
}
