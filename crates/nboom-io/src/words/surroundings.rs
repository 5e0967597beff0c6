use nboom_model::{Base, BodyShape, External, InitialMotion, MassProperties};
use nboom_scalar::{Sym3, Vec3};

use super::{Axes, DriveWords, ExternalWords, RotorWords, WordsError};

/// A thrust fixed in the main body: short for a [`thruster`](super::thruster) of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thrust {
    /// Force on the main body, its axes.
    pub force: [f64; 3],
    /// Where it acts, from O, main-body axes.
    pub point: [f64; 3],
    /// Time at which it starts.
    pub from: f64,
    /// Time at which it stops.
    pub until: f64,
}

impl From<Thrust> for External {
    fn from(Thrust { force, point, from, until }: Thrust) -> Self {
        Self::thrust(force.into(), point.into(), [from, until])
    }
}

/// The main body, in words. Its origin is the point O.
#[derive(Clone, Debug, Default, PartialEq)]
#[must_use]
pub struct MainBodyWords {
    mass: MassWords,
    pub(super) base: Base,
    pub(super) drive: Option<DriveWords>,
    pub(super) rotors: Vec<RotorWords>,
    pub(super) externals: Vec<External>,
    pub(super) shape: Option<BodyShape>,
}

/// The main body; `mass` and `inertia` must be given.
pub fn main_body() -> MainBodyWords {
    MainBodyWords::default()
}

impl MainBodyWords {
    /// Its mass.
    pub fn mass(mut self, mass: f64) -> Self {
        self.mass.mass = Some(mass);
        self
    }

    /// Mass centre, from O; by default O.
    pub fn mass_centre(mut self, mass_centre: impl Into<Vec3<f64>>) -> Self {
        self.mass.mass_centre = Some(mass_centre.into());
        self
    }

    /// Inertia about the mass centre: three moments, or a matrix.
    pub fn inertia(mut self, inertia: impl Into<Inertia>) -> Self {
        self.mass.inertia = Some(inertia.into().0);
        self
    }

    /// Fixed to the ground, as on a test rig.
    pub fn fixed(mut self) -> Self {
        self.base = Base::Fixed;
        self
    }

    /// Moved as prescribed; it starts with that motion.
    pub fn driven(mut self, drive: DriveWords) -> Self {
        self.drive = Some(drive);
        self
    }

    /// One more rotor in it.
    pub fn rotor(mut self, rotor: RotorWords) -> Self {
        self.rotors.push(rotor);
        self
    }

    /// One more force or torque on it from outside.
    pub fn external(mut self, external: ExternalWords) -> Self {
        self.externals.push(external.into());
        self
    }

    /// What it looks like in pictures.
    pub fn shape(mut self, shape: BodyShape) -> Self {
        self.shape = Some(shape);
        self
    }

    pub(super) fn properties(self, errors: &mut Vec<WordsError>) -> MassProperties {
        self.mass.properties("main_body", Some(Vec3::zero()), errors)
    }
}

/// An inertia: three moments, or a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia(pub(super) Sym3<f64>);

impl From<[f64; 3]> for Inertia {
    fn from([xx, yy, zz]: [f64; 3]) -> Self {
        Self(Sym3::diagonal(xx, yy, zz))
    }
}

impl From<Sym3<f64>> for Inertia {
    fn from(inertia: Sym3<f64>) -> Self {
        Self(inertia)
    }
}

/// What a table says about mass.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct MassWords {
    pub mass: Option<f64>,
    pub mass_centre: Option<Vec3<f64>>,
    pub inertia: Option<Sym3<f64>>,
}

impl MassWords {
    /// The mass properties, with stand-ins for what is missing.
    pub fn properties(
        &self,
        of: &str,
        mass_centre: Option<Vec3<f64>>,
        errors: &mut Vec<WordsError>,
    ) -> MassProperties {
        let mass_centre = self.mass_centre.or(mass_centre);
        let given = [
            ("mass", self.mass.is_some()),
            ("mass_centre", mass_centre.is_some()),
            ("inertia", self.inertia.is_some()),
        ];
        let missing = given.into_iter().filter(|(_, is_given)| !is_given);
        errors.extend(missing.map(|(key, _)| WordsError::Missing { of: of.to_owned(), key }));
        MassProperties::new(
            self.mass.unwrap_or(1.0),
            mass_centre.unwrap_or_else(Vec3::zero),
            self.inertia.unwrap_or_else(|| Sym3::diagonal(1.0, 1.0, 1.0)),
        )
    }
}

/// Motion of the main body at the start, in words.
#[derive(Clone, Debug, Default, PartialEq)]
#[must_use]
pub struct InitialWords {
    attitude: Option<Axes>,
    rate: Option<Vec3<f64>>,
    position: Option<Vec3<f64>>,
    velocity: Option<Vec3<f64>>,
}

/// Motion of the main body at the start; by default at rest at the inertial origin.
pub fn initial() -> InitialWords {
    InitialWords::default()
}

impl InitialWords {
    /// How its axes stand to the inertial ones; by default alike.
    pub fn attitude(mut self, attitude: Axes) -> Self {
        self.attitude = Some(attitude);
        self
    }

    /// Angular rate, main-body axes \[degrees/T\]; by default zero.
    pub fn rate_deg(self, rate: [f64; 3]) -> Self {
        self.rate_rad(rate.map(f64::to_radians))
    }

    /// Angular rate, main-body axes \[radians/T\]; by default zero.
    pub fn rate_rad(mut self, rate: [f64; 3]) -> Self {
        self.rate = Some(rate.into());
        self
    }

    /// Inertial position of O; by default the inertial origin.
    pub fn position(mut self, position: impl Into<Vec3<f64>>) -> Self {
        self.position = Some(position.into());
        self
    }

    /// Inertial velocity of O, inertial axes; by default zero.
    pub fn velocity(mut self, velocity: impl Into<Vec3<f64>>) -> Self {
        self.velocity = Some(velocity.into());
        self
    }

    /// Whether it says the rate, and the velocity.
    pub(super) fn given(&self) -> [bool; 2] {
        [self.rate.is_some(), self.velocity.is_some()]
    }

    /// Changes what the words say.
    pub(super) fn set(self, motion: &mut InitialMotion, errors: &mut Vec<WordsError>) {
        let attitude =
            self.attitude.map(|axes| axes.rotation().and_then(|rotation| rotation.attitude()));
        match attitude {
            Some(Ok(attitude)) => motion.attitude = attitude,
            Some(Err((found, expected))) => {
                let of = "initial".to_owned();
                errors.push(WordsError::Value { of, key: "attitude", found, expected });
            }
            None => {}
        }
        motion.omega_body = self.rate.unwrap_or(motion.omega_body);
        motion.position_inertial = self.position.unwrap_or(motion.position_inertial);
        motion.velocity_inertial = self.velocity.unwrap_or(motion.velocity_inertial);
    }
}
