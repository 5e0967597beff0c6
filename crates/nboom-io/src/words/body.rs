use nboom_model::{
    BodyDraft, BodyShape, External, KickOffSpring, MOST_BODIES, MassProperties, Repeat,
    SegmentStructure,
};
use nboom_scalar::Vec3;

use super::error::of_body;
use super::rotor::rotors;
use super::surroundings::MassWords;
use super::{
    CouplingWords, Direction, ExternalWords, HingeWords, Inertia, RotorWords, SlideWords,
    WordsError, hinge,
};
use crate::scene::check_body_name;

/// A hinged body, in words.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct BodyWords {
    name: String,
    on: Option<String>,
    mass: MassWords,
    tip: Option<Vec3<f64>>,
    hinge: HingeWords,
    kick_off: Option<KickOff>,
    couplings: Vec<CouplingWords>,
    rotors: Vec<RotorWords>,
    externals: Vec<External>,
    repeat: Option<(usize, Direction)>,
    structure: Option<SegmentStructure>,
    shape: Option<BodyShape>,
}

/// A spring between the main body and a hinged one. Its force depends on its length and ends at a limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KickOff {
    /// Its end on the main body, from O.
    pub main_body_end: [f64; 3],
    /// Its end on the body, from the hinge, body axes.
    pub end: [f64; 3],
    /// Force a + b x + c x² + d x³ at the length x, as \[a, b, c, d\].
    pub force: [f64; 4],
    /// Length from which on it does not push.
    pub limit: f64,
}

/// A body of this name, unique and in one line; `mass`, `mass_centre`, `inertia` and `hinge` or `slide` must be given.
pub fn body(name: &str) -> BodyWords {
    BodyWords {
        name: name.to_owned(),
        on: None,
        mass: MassWords::default(),
        tip: None,
        hinge: hinge(),
        kick_off: None,
        couplings: Vec::new(),
        rotors: Vec::new(),
        externals: Vec::new(),
        repeat: None,
        structure: None,
        shape: None,
    }
}

/// The outer end of a body that does not say it, twice as far as its mass centre.
pub(crate) fn tip_of(properties: &MassProperties) -> Vec3<f64> {
    properties.center_of_mass * 2.0
}

impl BodyWords {
    /// Name of the inboard body; by default the main body, which `main_body` means too if no body is called
    /// so.
    pub fn on(mut self, name: &str) -> Self {
        self.on = Some(name.to_owned());
        self
    }

    /// Mass of the body.
    pub fn mass(mut self, mass: f64) -> Self {
        self.mass.mass = Some(mass);
        self
    }

    /// Mass centre, from the hinge, body axes.
    pub fn mass_centre(mut self, mass_centre: impl Into<Vec3<f64>>) -> Self {
        self.mass.mass_centre = Some(mass_centre.into());
        self
    }

    /// Inertia about the mass centre, body axes: three moments, or a matrix.
    pub fn inertia(mut self, inertia: impl Into<Inertia>) -> Self {
        self.mass.inertia = Some(inertia.into().0);
        self
    }

    /// The outer end, from the hinge, body axes; for pictures only. By default twice as far as the mass
    /// centre.
    pub fn tip(mut self, tip: impl Into<Vec3<f64>>) -> Self {
        self.tip = Some(tip.into());
        self
    }

    /// The hinge that joins it to its inboard body.
    pub fn hinge(mut self, hinge: HingeWords) -> Self {
        self.hinge = hinge;
        self
    }

    /// The joint that slides, in place of a hinge.
    pub fn slide(mut self, slide: SlideWords) -> Self {
        self.hinge = slide.0;
        self
    }

    /// A spring that pushes it off the main body.
    pub fn kick_off(mut self, kick_off: KickOff) -> Self {
        self.kick_off = Some(kick_off);
        self
    }

    /// One more spring and damper between its hinge and another one.
    pub fn coupling(mut self, coupling: CouplingWords) -> Self {
        self.couplings.push(coupling);
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

    /// Makes several of it, with all that is outboard of it, evenly about an axis through O; for a body
    /// on the main body. Copies are called "name 1", "name 2", …
    pub fn repeat(mut self, count: usize, about: impl Into<Direction>) -> Self {
        self.repeat = Some((count, about.into()));
        self
    }

    /// Material, pulse and stations; needed for stresses.
    pub fn structure(mut self, structure: SegmentStructure) -> Self {
        self.structure = Some(structure);
        self
    }

    /// What it looks like in pictures.
    pub fn shape(mut self, shape: BodyShape) -> Self {
        self.shape = Some(shape);
        self
    }

    /// The body that the words mean. Stand-ins take the place of what is wrong.
    pub(super) fn draft(self, errors: &mut Vec<WordsError>) -> BodyDraft {
        let of = of_body(&self.name);
        if let Err((found, expected)) = check_body_name(&self.name) {
            errors.push(WordsError::Value { of: of.clone(), key: "name", found, expected });
        }
        let properties = self.mass.properties(&of, None, errors);
        let (mount, axis) = self.hinge.place(&self.name, errors);
        let mut body = BodyDraft::new(&self.name, properties, mount.point, axis);
        body.mount = mount;
        body.on = self.on;
        body.tip = self.tip.unwrap_or_else(|| tip_of(&properties));
        self.hinge.act_on(&mut body);
        body.hinge.kick_off = self.kick_off.map(KickOffSpring::from);
        body.rotors = rotors(&self.rotors, &of, errors);
        body.externals = self.externals;
        body.couplings = self.couplings.into_iter().map(Into::into).collect();
        body.repeat = self.repeat.and_then(|(count, about)| {
            let wrong = |(found, expected)| {
                let of = of.clone();
                errors.push(WordsError::Value { of, key: "repeat", found, expected });
            };
            let is_count = (1..=MOST_BODIES).contains(&count);
            let expected = "a number of copies from 1 to 10000";
            let count = if is_count { Ok(count) } else { Err((count.to_string(), expected)) };
            count.and_then(|count| Ok(Repeat { count, about: about.unit()? })).map_err(wrong).ok()
        });
        body.structure = self.structure;
        body.shape = self.shape;
        body
    }
}

impl From<KickOff> for KickOffSpring {
    fn from(KickOff { main_body_end, end, force, limit }: KickOff) -> Self {
        Self {
            main_body_point: main_body_end.into(),
            body_point: end.into(),
            coefficients: force,
            limit_length: limit,
        }
    }
}
