/// A quantity of the motion, in one column of a table or in three.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Of O.
    Position,
    /// Of O.
    Velocity,
    /// Of the quaternion.
    AttitudeScalar,
    /// Of the quaternion.
    AttitudeVector,
    /// Of the main body.
    AngularRate,
    /// β of a hinge.
    Angle,
    /// τ of a hinge.
    Rate,
    /// α of a hinge.
    AngleSum,
    /// σ of a hinge.
    RateSum,
    /// Of a hinge.
    State,
    /// Of all bodies.
    KineticEnergy,
    /// Of all bodies.
    LinearMomentum,
    /// Of all bodies.
    AngularMomentum,
    /// Of the main body.
    Nutation,
    /// On a main body that is held.
    ReactionForce,
    /// On a main body that is held.
    ReactionMoment,
    /// Ω of a rotor.
    RotorSpeed,
    /// Of the motor of a rotor.
    MotorTorque,
}

impl Quantity {
    /// Those before the hinges, in the order of their columns.
    pub const BEFORE_HINGES: [Self; 5] = [
        Self::Position,
        Self::Velocity,
        Self::AttitudeScalar,
        Self::AttitudeVector,
        Self::AngularRate,
    ];

    /// Those of each hinge, in the order of their columns.
    pub const OF_A_HINGE: [Self; 5] =
        [Self::Angle, Self::Rate, Self::AngleSum, Self::RateSum, Self::State];

    /// Those after the hinges, in the order of their columns.
    pub const AFTER_HINGES: [Self; 4] =
        [Self::KineticEnergy, Self::LinearMomentum, Self::AngularMomentum, Self::Nutation];

    /// Those that stand only in a table that asks for them, of a scene whose main body is held.
    pub const OF_A_HELD_BODY: [Self; 2] = [Self::ReactionForce, Self::ReactionMoment];

    /// Those of each rotor, which stand only in a table that asks for them.
    pub const OF_A_ROTOR: [Self; 2] = [Self::RotorSpeed, Self::MotorTorque];

    /// All, in the order of their columns.
    pub fn all() -> impl Iterator<Item = Self> {
        let hinges = Self::BEFORE_HINGES.into_iter().chain(Self::OF_A_HINGE);
        let on_request = Self::OF_A_HELD_BODY.into_iter().chain(Self::OF_A_ROTOR);
        hinges.chain(Self::AFTER_HINGES).chain(on_request)
    }

    /// What all its columns together are called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "rho",
            Self::Velocity => "v",
            Self::AttitudeVector => "kappa",
            Self::AngularRate => "omega",
            Self::LinearMomentum => "linear_momentum",
            Self::AngularMomentum => "angular_momentum",
            Self::ReactionForce => "reaction_force",
            Self::ReactionMoment => "reaction_moment",
            one => one.columns()[0],
        }
    }

    /// Names of its columns, in files; the columns of a hinge have its numbers after that, those of
    /// a rotor its number.
    pub fn columns(self) -> &'static [&'static str] {
        match self {
            Self::Position => &["rho_x", "rho_y", "rho_z"],
            Self::Velocity => &["v_x", "v_y", "v_z"],
            Self::AttitudeScalar => &["chi"],
            Self::AttitudeVector => &["kappa_x", "kappa_y", "kappa_z"],
            Self::AngularRate => &["omega_x", "omega_y", "omega_z"],
            Self::Angle => &["beta"],
            Self::Rate => &["tau"],
            Self::AngleSum => &["alpha"],
            Self::RateSum => &["sigma"],
            Self::State => &["state"],
            Self::KineticEnergy => &["kinetic_energy"],
            Self::LinearMomentum => {
                &["linear_momentum_x", "linear_momentum_y", "linear_momentum_z"]
            }
            Self::AngularMomentum => {
                &["angular_momentum_x", "angular_momentum_y", "angular_momentum_z"]
            }
            Self::Nutation => &["nutation"],
            Self::ReactionForce => &["reaction_force_x", "reaction_force_y", "reaction_force_z"],
            Self::ReactionMoment => {
                &["reaction_moment_x", "reaction_moment_y", "reaction_moment_z"]
            }
            Self::RotorSpeed => &["rotor_speed"],
            Self::MotorTorque => &["motor_torque"],
        }
    }

    /// Its unit, made of those of length L, time T and force F.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Position => "L",
            Self::Velocity => "L/T",
            Self::AttitudeScalar | Self::AttitudeVector | Self::State => "1",
            Self::AngularRate | Self::Rate | Self::RateSum | Self::RotorSpeed => "rad/T",
            Self::Angle | Self::AngleSum | Self::Nutation => "rad",
            Self::KineticEnergy | Self::ReactionMoment | Self::MotorTorque => "F L",
            Self::ReactionForce => "F",
            Self::LinearMomentum => "F T",
            Self::AngularMomentum => "F L T",
        }
    }

    /// What it is, in one line.
    pub fn about(self) -> &'static str {
        match self {
            Self::Position => "position of O, inertial axes",
            Self::Velocity => "inertial velocity of O, inertial axes",
            Self::AttitudeScalar => "scalar of the attitude's quaternion",
            Self::AttitudeVector => {
                "vector of the attitude's quaternion, which turns main-body components into \
                 inertial ones"
            }
            Self::AngularRate => "angular rate of the main body, main-body axes",
            Self::Angle => "angle relative to the inboard body",
            Self::Rate => "rate relative to the inboard body",
            Self::AngleSum => {
                "sum of angles along the appendage, begun anew at slides and where axes are not parallel"
            }
            Self::RateSum => {
                "sum of rates along the appendage, begun anew at slides and where axes are not parallel"
            }
            Self::State => "-1 unreleased, 0 free, 1 locked, 2 stuck by friction or against a stop",
            Self::KineticEnergy => "kinetic energy",
            Self::LinearMomentum => "linear momentum, inertial axes",
            Self::AngularMomentum => "angular momentum about the system mass centre, inertial axes",
            Self::Nutation => "angle between angular momentum and the main body's x axis",
            Self::ReactionForce => "force of what holds the main body on it, main-body axes",
            Self::ReactionMoment => {
                "moment about O of what holds the main body on it, main-body axes"
            }
            Self::RotorSpeed => "speed of a rotor relative to its body",
            Self::MotorTorque => "torque of the motor of a rotor on it, about its axis",
        }
    }

    /// Whether a text is its name, alone or before a number.
    pub(crate) fn is_beginning_of(self, text: &str) -> bool {
        let number = text.strip_prefix(self.name());
        number.is_some_and(|number| number.is_empty() || number.starts_with('_'))
    }

    /// Whether each rotor has one.
    pub fn is_of_rotor(self) -> bool {
        Self::OF_A_ROTOR.contains(&self)
    }
}
