use std::collections::HashMap;

use super::{
    BodyDraft, CouplingDraft, DraftDefect, DraftError, MAIN_BODY_NAMES, MOST_BODIES, ReleaseDraft,
    Repeat, SceneDraft,
};
use crate::{Coupling, Errors, Release};

/// A body of the scene, as the draft has it.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub draft: usize,
    /// The body of the draft that it hangs on the main body by; itself perhaps.
    pub root: usize,
    /// Which copy it is, from 0, if its root is repeated.
    pub copy: Option<usize>,
    /// Index in the scene.
    pub inboard: Option<usize>,
    name: String,
}

/// All bodies of the scene, branch by branch, inboard before outboard, and what they are called.
pub(super) struct Names {
    pub places: Vec<Place>,
    by_name: HashMap<String, usize>,
    /// For each body of the draft, those of the scene, copy after copy.
    of_draft: Vec<Vec<usize>>,
    /// For each name of the draft, its body there.
    in_draft: HashMap<String, usize>,
}

impl Names {
    pub fn of(bodies: &[BodyDraft]) -> Result<Self, Errors<DraftError>> {
        let mut errors = Vec::new();
        let mut error = |body, defect| errors.push(DraftError { body, defect });
        let mut in_draft = HashMap::new();
        for (i, body) in bodies.iter().enumerate() {
            if in_draft.insert(body.name.clone(), i).is_some() {
                error(i, DraftDefect::NameTaken(body.name.clone()));
            }
        }
        let mut outboard = vec![Vec::new(); bodies.len()];
        let mut on_main_body = Vec::new();
        let is_main_body =
            |on: &&String| MAIN_BODY_NAMES.contains(&on.as_str()) && !in_draft.contains_key(*on);
        for (i, body) in bodies.iter().enumerate() {
            let Some(inboard) = body.on.as_ref().filter(|on| !is_main_body(on)) else {
                on_main_body.push(i);
                continue;
            };
            match in_draft.get(inboard) {
                Some(&at) => outboard[at].push(i),
                None => error(i, unknown_inboard(inboard, &in_draft)),
            }
            if body.repeat.is_some() {
                error(i, DraftDefect::RepeatOutboard(inboard.clone()));
            }
        }
        for &root in &on_main_body {
            if bodies[root].repeat.is_some_and(|repeat| repeat.overlaps(&bodies[root])) {
                error(root, DraftDefect::RepeatOverlap);
            }
        }
        let reached = reach(&on_main_body, &outboard);
        let circling = (0..bodies.len()).filter(|&i| {
            !reached[i] && bodies[i].on.as_ref().is_some_and(|name| in_draft.contains_key(name))
        });
        // Bodies outboard of one that has no place are not in a circle.
        if errors.is_empty() {
            errors.extend(circling.map(|body| DraftError { body, defect: DraftDefect::Circle }));
        }
        if !errors.is_empty() {
            return Err(Errors(errors));
        }
        let places = places(bodies, &on_main_body, &outboard)?;
        let mut of_draft = vec![Vec::new(); bodies.len()];
        let mut by_name = HashMap::new();
        for (i, place) in places.iter().enumerate() {
            of_draft[place.draft].push(i);
            if by_name.insert(place.name.clone(), i).is_some() {
                let defect = DraftDefect::NameTaken(place.name.clone());
                errors.push(DraftError { body: place.draft, defect });
            }
        }
        if errors.is_empty() {
            Ok(Self { places, by_name, of_draft, in_draft })
        } else {
            Err(Errors(errors))
        }
    }

    /// For each body of the scene, its name.
    pub fn all(self) -> Vec<String> {
        self.places.into_iter().map(|place| place.name).collect()
    }

    /// How the appendage of a body is repeated.
    pub fn repeat(&self, bodies: &[BodyDraft], place: &Place) -> Option<Repeat> {
        bodies[place.root].repeat
    }

    /// The release of a body, with the hinge that it waits for. Within a repeated appendage a name is that of
    /// the same copy.
    pub fn release(
        &self,
        bodies: &[BodyDraft],
        place: &Place,
        release: &ReleaseDraft,
    ) -> Result<Release, DraftDefect> {
        match release {
            ReleaseDraft::At(time) => Ok(Release::Time(*time)),
            ReleaseDraft::Never => Ok(Release::Never),
            ReleaseDraft::Passes { when, passes, joint } => {
                let hinge = self.hinge(place, when)?;
                let (waits, is) = (*joint, bodies[self.places[hinge].draft].joint);
                if waits != is {
                    return Err(DraftDefect::TriggerJoint { name: when.clone(), waits, is });
                }
                Ok(Release::Angle { hinge, angle: *passes })
            }
            ReleaseDraft::AfterLock { after, by } => {
                Ok(Release::AfterLock { hinge: self.hinge(place, after)?, delay: *by })
            }
        }
    }

    /// A coupling of the body `i`, which is at `place`.
    pub fn coupling(
        &self,
        i: usize,
        place: &Place,
        draft: &CouplingDraft,
    ) -> Result<Coupling, DraftDefect> {
        let CouplingDraft { ref to, ratio, stiffness, rest, damping, is_mutual } = *draft;
        let other = match self.hinge(place, to) {
            Ok(other) if other != i => other,
            Ok(_) => {
                let expected = "another body".to_owned();
                return Err(DraftDefect::Coupling { name: to.clone(), expected });
            }
            Err(DraftDefect::Trigger { name, expected }) => {
                return Err(DraftDefect::Coupling { name, expected });
            }
            Err(defect) => return Err(defect),
        };
        Ok(Coupling { hinges: [i, other], ratio, stiffness, rest, damping, is_mutual })
    }

    fn hinge(&self, place: &Place, name: &str) -> Result<usize, DraftDefect> {
        let drafted = self.in_draft.get(name).map(|&draft| &self.of_draft[draft]);
        let beside = drafted.and_then(|copies| {
            let is_beside = |&&i: &&usize| {
                let other = &self.places[i];
                (other.root, other.copy) == (place.root, place.copy)
            };
            copies.iter().find(is_beside)
        });
        let found = beside.or_else(|| self.by_name.get(name)).copied();
        found.ok_or_else(|| DraftDefect::Trigger {
            name: name.to_owned(),
            expected: match drafted.and_then(|copies| copies.first()) {
                Some(&first) => format!("the name of one copy, as `{}`", self.places[first].name),
                None => "the name of another body".to_owned(),
            },
        })
    }
}

impl SceneDraft {
    /// What releases and couplings of a body of the draft may call the others: one of the same appendage by its name
    /// in the draft, copies elsewhere by their own. None while bodies do not hang together.
    pub fn names_for(&self, body: usize) -> Vec<String> {
        let places = Names::of(&self.bodies).map_or_else(|_| Vec::new(), |names| names.places);
        let Some(own) = places.iter().find(|place| place.draft == body) else { return Vec::new() };
        let others = places.iter().filter(|place| place.draft != body);
        let name = |place: &Place| match (place.root, place.copy) == (own.root, own.copy) {
            true => self.bodies[place.draft].name.clone(),
            false => place.name.clone(),
        };
        others.map(name).collect()
    }
}

fn unknown_inboard(name: &str, in_draft: &HashMap<String, usize>) -> DraftDefect {
    let expected = if in_draft.is_empty() { "the main body" } else { "the name of another body" };
    DraftDefect::Inboard { name: name.to_owned(), expected: expected.to_owned() }
}

/// Which bodies have a way to the main body.
fn reach(on_main_body: &[usize], outboard: &[Vec<usize>]) -> Vec<bool> {
    let mut reached = vec![false; outboard.len()];
    let mut next = on_main_body.to_vec();
    while let Some(i) = next.pop() {
        reached[i] = true;
        next.extend(&outboard[i]);
    }
    reached
}

/// The bodies of the scene, appendage by appendage.
fn places(
    bodies: &[BodyDraft],
    on_main_body: &[usize],
    outboard: &[Vec<usize>],
) -> Result<Vec<Place>, Errors<DraftError>> {
    let mut places: Vec<Place> = Vec::new();
    for &root in on_main_body {
        let copies = bodies[root].repeat.map_or(1, |repeat| repeat.count);
        for number in 0..copies {
            let copy = bodies[root].repeat.map(|_| number);
            // The next body, and where its inboard one is.
            let mut next = vec![(root, None)];
            while let Some((draft, inboard)) = next.pop() {
                if places.len() == MOST_BODIES {
                    let defect = DraftDefect::Count(MOST_BODIES + 1);
                    return Err(Errors(vec![DraftError { body: draft, defect }]));
                }
                let name = match copy {
                    Some(number) => format!("{} {}", bodies[draft].name, number + 1),
                    None => bodies[draft].name.clone(),
                };
                next.extend(outboard[draft].iter().rev().map(|&i| (i, Some(places.len()))));
                places.push(Place { draft, root, copy, inboard, name });
            }
        }
    }
    Ok(places)
}
