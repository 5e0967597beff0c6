//! A scene in words: bodies refer to each other by name, and one may stand for several about an
//! axis.

mod names;
mod repeat;

use nboom_scalar::Vec3;

use crate::{
    Body, BodyShape, Errors, External, Finding, Hinge, Joint, MassProperties, Mount, Release,
    Rotor, SceneDescription, SegmentStructure, TorqueTable,
};
use names::Names;

pub use repeat::Repeat;

/// A scene in words, not yet resolved.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneDraft {
    /// Everything but the hinged bodies and their torque tables, of which it has none.
    pub scene: SceneDescription,
    /// The hinged bodies, in any order.
    pub bodies: Vec<BodyDraft>,
}

/// A hinged body in words.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyDraft {
    /// What others call it; unique.
    pub name: String,
    /// The inboard body; `None` is the main body, and so are [`MAIN_BODY_NAMES`] where no body is called so.
    pub on: Option<String>,
    /// Where the hinge sits on the inboard body.
    pub mount: Mount,
    /// Whether it turns about the axis or slides along it.
    pub joint: Joint,
    /// Unit vector along the hinge axis, body axes.
    pub axis: Vec3<f64>,
    /// Mass properties, from the hinge, body axes.
    pub mass_properties: MassProperties,
    /// The outer end, from the hinge, body axes.
    pub tip: Vec3<f64>,
    /// What acts about the hinge, and how it starts and locks; `release` takes the place of its
    /// own.
    pub hinge: Hinge,
    /// When the hinge becomes free, if it starts unreleased.
    pub release: ReleaseDraft,
    /// Points of a torque over the hinge angle, see [`TorqueTable`]; none without such a torque.
    pub torque_table: Vec<[f64; 2]>,
    /// Springs and dampers between its hinge and others.
    pub couplings: Vec<CouplingDraft>,
    /// Rotors in it; their `body` does not count.
    pub rotors: Vec<Rotor>,
    /// Forces and torques on it from outside; their `body` does not count.
    pub externals: Vec<External>,
    /// Of a body on the main body: how often it is there, with all that is outboard of it.
    pub repeat: Option<Repeat>,
    /// Material, pulse and stations.
    pub structure: Option<SegmentStructure>,
    /// What it looks like in pictures.
    pub shape: Option<BodyShape>,
}

/// A spring and a damper between the hinge of a body and that of another one, which it names; see
/// [`Coupling`](crate::Coupling).
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingDraft {
    /// Name of the other body.
    pub to: String,
    /// ρ.
    pub ratio: f64,
    /// k.
    pub stiffness: f64,
    /// θ.
    pub rest: f64,
    /// c.
    pub damping: f64,
    /// Whether it acts on the other hinge as well.
    pub is_mutual: bool,
}

/// A release that names the hinge it waits for.
#[derive(Clone, Debug, PartialEq)]
pub enum ReleaseDraft {
    /// At this time \[T\].
    At(f64),
    /// When the hinge of the body `when` passes the relative angle `passes` \[rad\] either way;
    /// where it slides the travel \[L\].
    Passes {
        /// Name of the body.
        when: String,
        /// The angle.
        passes: f64,
        /// Which kind of joint the words are for.
        joint: Joint,
    },
    /// Some time after the hinge of another body has locked.
    AfterLock {
        /// Name of the body.
        after: String,
        /// How long after \[T\].
        by: f64,
    },
    /// Not during the run.
    Never,
}

impl BodyDraft {
    /// A body on the main body with a free hinge at `point`, about `axis` (a unit vector),
    /// main-body axes.
    pub fn new(
        name: &str,
        mass_properties: MassProperties,
        point: Vec3<f64>,
        axis: Vec3<f64>,
    ) -> Self {
        Self {
            name: name.to_owned(),
            on: None,
            mount: Mount::at(point),
            joint: Joint::Revolute,
            axis,
            mass_properties,
            tip: Vec3::zero(),
            hinge: Hinge::free(),
            release: ReleaseDraft::Never,
            torque_table: Vec::new(),
            couplings: Vec::new(),
            rotors: Vec::new(),
            externals: Vec::new(),
            repeat: None,
            structure: None,
            shape: None,
        }
    }
}

/// Something wrong with the words of a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{defect}")]
pub struct DraftError {
    /// Which body of the draft, from 0.
    pub body: usize,
    /// What is wrong.
    pub defect: DraftDefect,
}

/// What is wrong with the words of a body.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.finding())]
#[non_exhaustive]
pub enum DraftDefect {
    /// Another body, or a copy of one, has the name.
    NameTaken(String),
    /// No body has the name of the inboard body.
    Inboard {
        /// The unknown name.
        name: String,
        /// What would have been right.
        expected: String,
    },
    /// The inboard bodies lead back to the body itself.
    Circle,
    /// No hinge has the name that the release waits for, or it is the hinge itself.
    Trigger {
        /// The name.
        name: String,
        /// What would have been right.
        expected: String,
    },
    /// No other hinge has the name that a coupling leads to.
    Coupling {
        /// The name.
        name: String,
        /// What would have been right.
        expected: String,
    },
    /// A release waits for an angle of a joint that slides, or for a travel of one that turns.
    TriggerJoint {
        /// Name of the body.
        name: String,
        /// What the words are for.
        waits: Joint,
        /// What it is.
        is: Joint,
    },
    /// A body is repeated that is not on the main body.
    RepeatOutboard(String),
    /// A repetition about an axis on which the body lies.
    RepeatOverlap,
    /// More bodies than a scene may have.
    Count(usize),
}

impl DraftDefect {
    /// What was found and what expected.
    pub fn finding(&self) -> Finding {
        match self {
            Self::NameTaken(name) => {
                Finding::new(format!("name `{name}` of two bodies"), "a name of its own")
            }
            Self::Inboard { name, expected } => {
                Finding::new(format!("inboard body `{name}`"), expected.clone())
            }
            Self::Circle => Finding::new("inboard bodies in a circle", "a way to the main body"),
            Self::Trigger { name, expected } => {
                Finding::new(format!("release by `{name}`"), expected.clone())
            }
            Self::Coupling { name, expected } => {
                Finding::new(format!("coupling to `{name}`"), expected.clone())
            }
            Self::TriggerJoint { name, waits, is } => Finding::new(
                format!("release by {} of `{name}`, which {}", coordinate(*waits), is.does()),
                coordinate(*is),
            ),
            Self::RepeatOutboard(name) => Finding::new(
                format!("repetition of a body on `{name}`"),
                "one of a body on the main body",
            ),
            Self::RepeatOverlap => Finding::new(
                "repetition about an axis through hinge and outer end",
                "bodies in places of their own",
            ),
            Self::Count(count) => Finding::new(
                format!("{count} bodies with all repetitions"),
                format!("at most {MOST_BODIES}"),
            ),
        }
    }
}

/// What words call a coordinate.
fn coordinate(joint: Joint) -> &'static str {
    match joint {
        Joint::Revolute => "an angle (`passes`)",
        Joint::Prismatic => "a travel (`reaches`)",
    }
}

/// What the main body may be called as an inboard body. The name of a body comes first, for robots have
/// links of any name.
pub const MAIN_BODY_NAMES: [&str; 2] = ["main_body", "main body"];

/// Most bodies of a scene in words.
pub const MOST_BODIES: usize = 10_000;

/// What a draft means.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    /// The scene, bodies branch by branch.
    pub description: SceneDescription,
    /// For each body, its name; copies are numbered from 1.
    pub names: Vec<String>,
    /// For each body, which one of the draft it is, from 0.
    pub of_draft: Vec<usize>,
    /// For each body, its structure.
    pub structures: Vec<Option<SegmentStructure>>,
    /// For each body, its shape.
    pub shapes: Vec<Option<BodyShape>>,
}

impl SceneDraft {
    /// The scene that the words mean, branch by branch, in the order of the draft where it is free.
    ///
    /// # Errors
    /// Everything that is wrong with names, references and repetitions.
    pub fn resolve(&self) -> Result<Resolved, Errors<DraftError>> {
        let names = Names::of(&self.bodies)?;
        let mut description = self.scene.clone();
        let (mut structures, mut shapes, mut of_draft) = (Vec::new(), Vec::new(), Vec::new());
        let mut errors = Vec::new();
        let mut rotors = Vec::new();
        for (i, place) in names.places.iter().enumerate() {
            let draft = &self.bodies[place.draft];
            let release = match names.release(&self.bodies, place, &draft.release) {
                Ok(Release::Angle { hinge, .. } | Release::AfterLock { hinge, .. })
                    if hinge == i =>
                {
                    Err(DraftDefect::Trigger {
                        name: draft.name.clone(),
                        expected: "another body".to_owned(),
                    })
                }
                other => other,
            };
            let release = release.unwrap_or_else(|defect| {
                errors.push(DraftError { body: place.draft, defect });
                Release::Never
            });
            let mut body = Body {
                inboard: place.inboard,
                mount: draft.mount,
                joint: draft.joint,
                axis: draft.axis,
                mass_properties: draft.mass_properties,
                tip: draft.tip,
                hinge: Hinge { release, ..draft.hinge },
            };
            if let (Some(copy), Some(repeat)) = (place.copy, names.repeat(&self.bodies, place)) {
                repeat.place(copy, place.inboard.is_none(), &mut body);
            }
            let in_body = |rotor: &Rotor| Rotor { body: Some(i), ..rotor.clone() };
            rotors.extend(draft.rotors.iter().map(|rotor| (place.draft, in_body(rotor))));
            let on_body = |external: &External| External { body: Some(i), ..external.clone() };
            description.externals.extend(draft.externals.iter().map(on_body));
            for coupling in &draft.couplings {
                match names.coupling(i, place, coupling) {
                    Ok(coupling) => description.couplings.push(coupling),
                    Err(defect) => errors.push(DraftError { body: place.draft, defect }),
                }
            }
            if !draft.torque_table.is_empty() {
                let points = draft.torque_table.clone();
                description.torque_tables.push(TorqueTable { hinge: i, points });
            }
            description.bodies.push(body);
            structures.push(draft.structure.clone());
            shapes.push(draft.shape);
            of_draft.push(place.draft);
        }
        // They are numbered as they were described, which bodies need not be.
        rotors.sort_by_key(|(of_draft, _)| *of_draft);
        description.rotors.extend(rotors.into_iter().map(|(_, rotor)| rotor));
        errors.dedup();
        if errors.is_empty() {
            Ok(Resolved { description, names: names.all(), of_draft, structures, shapes })
        } else {
            Err(Errors(errors))
        }
    }
}
