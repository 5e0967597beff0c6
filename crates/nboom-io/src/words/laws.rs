use nboom_model::{Dashpot, Spring};

/// A spring about a hinge: torque −stiffness (β − rest) + quadratic (β − rest)²; along a joint that slides: force,
/// by travel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[must_use]
pub struct SpringWords {
    stiffness: f64,
    rest: f64,
    quadratic: f64,
}

/// A spring of this torque per radian, or force per length, positive if it drives towards rest.
pub fn spring(stiffness: f64) -> SpringWords {
    SpringWords { stiffness, ..SpringWords::default() }
}

impl SpringWords {
    /// Angle without torque \[degrees\]; by default 0.
    pub fn rest_deg(self, rest: f64) -> Self {
        self.rest_rad(rest.to_radians())
    }

    /// Angle without torque \[radians\]; by default 0.
    pub fn rest_rad(self, rest: f64) -> Self {
        Self { rest, ..self }
    }

    /// Travel without force \[L\], of a joint that slides; by default 0.
    pub fn rest(self, rest: f64) -> Self {
        self.rest_rad(rest)
    }

    /// Torque per square radian, or force per squared length; by default 0.
    pub fn quadratic(self, quadratic: f64) -> Self {
        Self { quadratic, ..self }
    }
}

impl From<SpringWords> for Spring {
    fn from(SpringWords { stiffness, rest, quadratic }: SpringWords) -> Self {
        Self { quadratic, linear: opposite(stiffness), preload_angle: opposite(rest) }
    }
}

/// A damper about a hinge: torque −damping τ + rate_squared τ² + angle (β − rest) + angle_squared (β − rest)²;
/// along a joint that slides: force, by travel and speed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[must_use]
pub struct DamperWords {
    damping: f64,
    rate_squared: f64,
    angle: f64,
    angle_squared: f64,
    rest: f64,
}

/// A damper of this torque per rate, or force per speed, positive if it brakes.
pub fn damper(damping: f64) -> DamperWords {
    DamperWords { damping, ..DamperWords::default() }
}

impl DamperWords {
    /// Torque per squared rate; by default 0.
    pub fn rate_squared(self, rate_squared: f64) -> Self {
        Self { rate_squared, ..self }
    }

    /// Torque per radian; by default 0.
    pub fn angle(self, angle: f64) -> Self {
        Self { angle, ..self }
    }

    /// Torque per square radian; by default 0.
    pub fn angle_squared(self, angle_squared: f64) -> Self {
        Self { angle_squared, ..self }
    }

    /// Angle from which these two count \[degrees\]; by default 0.
    pub fn rest_deg(self, rest: f64) -> Self {
        self.rest_rad(rest.to_radians())
    }

    /// Force per squared speed; by default 0.
    pub fn speed_squared(self, speed_squared: f64) -> Self {
        self.rate_squared(speed_squared)
    }

    /// Force per length; by default 0.
    pub fn travel(self, travel: f64) -> Self {
        self.angle(travel)
    }

    /// Force per squared length; by default 0.
    pub fn travel_squared(self, travel_squared: f64) -> Self {
        self.angle_squared(travel_squared)
    }

    /// Travel from which these two count \[L\]; by default 0.
    pub fn rest(self, rest: f64) -> Self {
        self.rest_rad(rest)
    }

    /// Angle from which these two count \[radians\]; by default 0.
    pub fn rest_rad(self, rest: f64) -> Self {
        Self { rest, ..self }
    }
}

impl From<DamperWords> for Dashpot {
    fn from(words: DamperWords) -> Self {
        Self {
            rate_quadratic: words.rate_squared,
            rate_linear: opposite(words.damping),
            angle_quadratic: words.angle_squared,
            angle_linear: words.angle,
            preload_angle: opposite(words.rest),
        }
    }
}

/// The negative number, but zero of zero.
fn opposite(number: f64) -> f64 {
    0.0 - number
}
