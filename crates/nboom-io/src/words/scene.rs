use nboom_model::{
    Base, Errors, Gravity, Scene, SceneDescription, SceneDraft, SegmentStructure, Shapes, Structure,
};

use super::error::of_body;
use super::rotor::rotors;
use super::tables::Tables;
use super::{
    BodyWords, Direction, InitialWords, MainBodyWords, Thrust, WordsError, WordsErrors, initial,
    main_body,
};
use crate::deck::shown;
use crate::scene::check_folder_name;

/// A scene, in words.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct SceneWords {
    name: String,
    start: f64,
    end: Option<f64>,
    main_body: MainBodyWords,
    initial: InitialWords,
    gravity: Option<(f64, Direction)>,
    thrust: Option<Thrust>,
    bodies: Vec<BodyWords>,
}

/// A scene of this name, which becomes that of a folder; `end` and `main_body` must be given.
pub fn scene(name: &str) -> SceneWords {
    SceneWords {
        name: name.to_owned(),
        start: 0.0,
        end: None,
        main_body: main_body(),
        initial: initial(),
        gravity: None,
        thrust: None,
        bodies: Vec::new(),
    }
}

impl SceneWords {
    /// Initial time; by default 0.
    pub fn start(mut self, start: f64) -> Self {
        self.start = start;
        self
    }

    /// Time at which the run ends.
    pub fn end(mut self, end: f64) -> Self {
        self.end = Some(end);
        self
    }

    /// The body that carries all others.
    pub fn main_body(mut self, main_body: MainBodyWords) -> Self {
        self.main_body = main_body;
        self
    }

    /// Motion of the main body at the start; by default at rest.
    pub fn initial(mut self, initial: InitialWords) -> Self {
        self.initial = initial;
        self
    }

    /// Uniform gravity: magnitude of the acceleration, and the direction away from the attracting body,
    /// inertial axes.
    pub fn gravity(mut self, acceleration: f64, up: impl Into<Direction>) -> Self {
        self.gravity = Some((acceleration, up.into()));
        self
    }

    /// A thrust fixed in the main body.
    pub fn thrust(mut self, thrust: Thrust) -> Self {
        self.thrust = Some(thrust);
        self
    }

    /// One more hinged body; they may come in any order.
    pub fn body(mut self, body: BodyWords) -> Self {
        self.bodies.push(body);
        self
    }

    /// The scene, in radians, with the names of its bodies.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn build(self) -> Result<Scene, WordsErrors> {
        self.build_with_structure().map(|(scene, _)| scene)
    }

    /// The scene, and what stresses need if a body has it.
    ///
    /// # Errors
    /// Everything that is wrong with it, slices that do not add up to their body included.
    pub fn build_with_structure(self) -> Result<(Scene, Option<Structure>), WordsErrors> {
        let mut errors = Vec::new();
        let main_body = self.main_body.shape;
        let has_thrust = self.thrust.is_some();
        let draft = self.draft(&mut errors);
        let resolved = draft.resolve().map_err(|found| {
            let of = |body: usize| of_body(&draft.bodies[body].name);
            let found = found.into_iter();
            errors.extend(found.map(|e| WordsError::Draft { of: of(e.body), defect: e.defect }));
        });
        let (Ok(resolved), true) = (resolved, errors.is_empty()) else {
            return Err(Errors(errors));
        };
        let scene = Scene::new(resolved.description.clone()).map_err(|errors| {
            Tables { draft: &draft, resolved: &resolved, has_thrust }.errors(errors)
        })?;
        let structures = resolved.structures;
        let shapes = Shapes { main_body, bodies: resolved.shapes };
        let scene = scene.with_names(resolved.names).with_shapes(shapes);
        let structure = structure(&scene, structures)?;
        Ok((scene, structure))
    }

    fn draft(self, errors: &mut Vec<WordsError>) -> SceneDraft {
        if let Err((found, expected)) = check_folder_name(&self.name) {
            let of = "scene".to_owned();
            errors.push(WordsError::Value { of, key: "name", found, expected });
        }
        if self.end.is_none() {
            errors.push(WordsError::Missing { of: "scene".to_owned(), key: "end" });
        }
        let end = self.end.unwrap_or(self.start);
        let rotors = rotors(&self.main_body.rotors, "main_body", errors);
        let externals = self.thrust.map(Into::into).into_iter();
        let externals = externals.chain(self.main_body.externals.iter().cloned()).collect();
        let drive = self.main_body.drive.as_ref().and_then(|drive| drive.drive(errors));
        let base = drive.map_or(self.main_body.base.clone(), Base::Driven);
        let given = self.initial.given();
        let main_body = self.main_body.properties(errors);
        let mut scene = SceneDescription::at_rest(&self.name, main_body, end);
        (scene.base, scene.rotors, scene.externals) = (base, rotors, externals);
        scene.initial.time = self.start;
        self.initial.set(&mut scene.initial, errors);
        scene.begin_driven(given);
        scene.gravity = self.gravity.and_then(|(acceleration, up)| {
            let mut wrong = |key, found, expected| {
                let of = "gravity".to_owned();
                errors.push(WordsError::Value { of, key, found, expected });
            };
            match up.unit() {
                Err((found, expected)) => wrong("up", found, expected),
                Ok(_) if acceleration < 0.0 => {
                    let expected = "none below zero; turn `up` round";
                    wrong("acceleration", shown(acceleration), expected);
                }
                // Zero is no gravity; what is no number at all is found later.
                Ok(up) if acceleration != 0.0 => return Some(Gravity { acceleration, up }),
                Ok(_) => {}
            }
            None
        });
        let bodies = self.bodies.into_iter().map(|body| body.draft(errors)).collect();
        SceneDraft { scene, bodies }
    }
}

/// The structure of a scene, if a body has one. Without one a body has no stations, and nothing strikes its hinge.
fn structure(
    scene: &Scene,
    structures: Vec<Option<SegmentStructure>>,
) -> Result<Option<Structure>, WordsErrors> {
    if structures.iter().all(Option::is_none) {
        return Ok(None);
    }
    let lacks = |(i, structure): &(usize, &Option<SegmentStructure>)| {
        structure.is_none() && scene.bodies[*i].hinge.may_be_struck()
    };
    let missing = structures.iter().enumerate().filter(lacks).map(|(i, _)| {
        let of = of_body(scene.name_of(i).unwrap_or_default());
        WordsError::Missing { of, key: "structure" }
    });
    let missing: Vec<WordsError> = missing.collect();
    if !missing.is_empty() {
        return Err(Errors(missing));
    }
    let segments = structures.into_iter().map(Option::unwrap_or_default).collect();
    let errors = |all: Errors<_>| Errors(all.into_iter().map(Into::into).collect());
    Structure::new(scene, segments).map(Some).map_err(errors)
}
