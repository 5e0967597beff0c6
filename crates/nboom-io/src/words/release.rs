use nboom_model::{Joint, ReleaseDraft};

/// At this time \[T\].
pub fn at(time: f64) -> ReleaseDraft {
    ReleaseDraft::At(time)
}

/// When the hinge of this body passes an angle or reaches a travel, either way.
pub fn when(body: &str) -> When {
    When { body: body.to_owned() }
}

/// After the hinge of this body has latched; at the same instant unless [`After::by`] says more.
pub fn after(body: &str) -> After {
    After { body: body.to_owned(), by: 0.0 }
}

/// A release that lacks its angle or travel.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct When {
    body: String,
}

impl When {
    /// That angle \[degrees\].
    pub fn passes_deg(self, angle: f64) -> ReleaseDraft {
        self.passes_rad(angle.to_radians())
    }

    /// That angle \[radians\].
    pub fn passes_rad(self, angle: f64) -> ReleaseDraft {
        ReleaseDraft::Passes { when: self.body, passes: angle, joint: Joint::Revolute }
    }

    /// That travel \[L\], of a joint that slides.
    pub fn reaches(self, travel: f64) -> ReleaseDraft {
        ReleaseDraft::Passes { when: self.body, passes: travel, joint: Joint::Prismatic }
    }
}

/// A release after another hinge has latched.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct After {
    body: String,
    by: f64,
}

impl After {
    /// How long after \[T\].
    pub fn by(self, by: f64) -> Self {
        Self { by, ..self }
    }
}

impl From<After> for ReleaseDraft {
    fn from(After { body, by }: After) -> Self {
        Self::AfterLock { after: body, by }
    }
}
