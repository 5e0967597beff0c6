use nboom_model::CouplingDraft;

/// A spring and a damper between the hinge of a body and that of another one, in words: on the body's hinge the
/// torque −stiffness (β − ratio β′ − rest) − damping (τ − ratio τ′), on the other −ratio times that.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct CouplingWords {
    to: String,
    pub(crate) ratio: f64,
    pub(crate) stiffness: f64,
    pub(crate) rest: f64,
    pub(crate) damping: f64,
    pub(crate) is_mutual: bool,
}

/// A coupling to the hinge of the body of this name; it does nothing until it has a stiffness or a damping.
pub fn coupling(to: &str) -> CouplingWords {
    let to = to.to_owned();
    CouplingWords { to, ratio: 1.0, stiffness: 0.0, rest: 0.0, damping: 0.0, is_mutual: true }
}

impl CouplingWords {
    /// How far this hinge goes for each unit of the other; by default 1.
    pub fn ratio(self, ratio: f64) -> Self {
        Self { ratio, ..self }
    }

    /// Torque per radian, or of a slide force per length, positive if it drives towards rest; by default 0.
    pub fn stiffness(self, stiffness: f64) -> Self {
        Self { stiffness, ..self }
    }

    /// Angle without torque \[degrees\], of a hinge that turns; by default 0.
    pub fn rest_deg(self, rest: f64) -> Self {
        self.rest_rad(rest.to_radians())
    }

    /// Angle without torque \[radians\], of a hinge that turns; by default 0.
    pub fn rest_rad(self, rest: f64) -> Self {
        Self { rest, ..self }
    }

    /// Travel without force \[L\], of a slide; by default 0.
    pub fn rest_length(self, rest: f64) -> Self {
        self.rest_rad(rest)
    }

    /// Torque or force per rate, positive if it brakes; by default 0.
    pub fn damping(self, damping: f64) -> Self {
        Self { damping, ..self }
    }

    /// Makes it follow the other hinge and act on this one alone: −stiffness (ratio β′ − rest) − damping ratio
    /// τ′.
    pub fn acts_on_this(self) -> Self {
        Self { is_mutual: false, ..self }
    }
}

impl From<CouplingWords> for CouplingDraft {
    fn from(words: CouplingWords) -> Self {
        let CouplingWords { to, ratio, stiffness, rest, damping, is_mutual } = words;
        Self { to, ratio, stiffness, rest, damping, is_mutual }
    }
}
