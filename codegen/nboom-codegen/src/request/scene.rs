//! What to generate for a scene.

use std::collections::BTreeMap;

use nboom_formulation::{Formulation, Layout, Recognised, Uncovered, recognise};
use nboom_model::{HingeState, Mode, Scene, Shape, Topology, WeldedTree};

use crate::request::{CodegenError, Level, Request, identifier};

/// Where a routine of a scene has the satellite's numbers from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Numbers {
    /// They are handed in; what is zero in the scene is assumed.
    RunTime,
    /// They are those of the scene.
    Baked,
}

/// Up to this many hinges, all combinations of held ones are looked at.
const FEW_HINGES: usize = 10;

/// The most routines for states with held hinges.
const LOCK_STATES: usize = 32;

/// The most links of limbs in all routines for states with held hinges: every one is some hundred
/// operations, and none repeats another.
const LIMB_LINKS: usize = 60;

/// Angles around which held hinges are welded to see which numbers are zero at any angle: of link frames there is a
/// choice, and another one where axes come close to each other.
pub(crate) const ANGLES: [f64; 8] = [0.723, -1.931, 0.31, -0.56, 1.47, -2.62, 2.97, -1.13];

impl Request {
    /// Code for a scene whose hinges are all free, with external wrench if something acts on the scene from
    /// outside. The type's name is that of the topology after `Satellite` or `Baked`.
    ///
    /// # Errors
    /// When a body is not rigid, carries a rotor or is one of too many.
    pub fn of_scene(scene: &Scene, numbers: Numbers, level: Level) -> Result<Self, CodegenError> {
        let free = vec![true; scene.bodies.len()];
        let Recognised { topology, parameters, .. } = welded(scene, &free, 0.0)?;
        let parameters = parameters.write();
        let word = match numbers {
            Numbers::RunTime => "Satellite",
            Numbers::Baked => "Baked",
        };
        let request = Self::new(&name(word, &topology), topology.clone(), level);
        let request = match numbers {
            Numbers::RunTime => Self { assumptions: fixed(&topology, &[parameters]), ..request },
            Numbers::Baked => request.baked(&parameters),
        };
        Ok(request.on(scene))
    }

    /// What a simulator for a scene has: code with the scene's numbers, with numbers at run time,
    /// for [`lock_states`](Self::lock_states), and by `articulated` also code `General` that
    /// assumes nothing, but that the main body is held if it is, in which other states with held hinges and other
    /// numbers can be embedded.
    ///
    /// # Errors
    /// When a body is not rigid, carries a rotor or is one of too many.
    pub fn of_simulator(
        scene: &Scene,
        formulation: Formulation,
        level: Level,
    ) -> Result<Vec<Self>, CodegenError> {
        let mut all = vec![
            Self::of_scene(scene, Numbers::Baked, level)?,
            Self::of_scene(scene, Numbers::RunTime, level)?,
        ];
        let topology = all[0].topology.clone();
        all.extend(Self::lock_states(scene, level)?);
        if formulation == Formulation::Articulated {
            let general = Self::new(&name("General", &topology), topology, level);
            all.push(general.on(scene).with_external_wrench());
        }
        Ok(all.into_iter().map(|request| request.by(formulation)).collect())
    }

    /// Code for topologies that a scene comes through while hinges are held, the most free
    /// hinges first.
    ///
    /// All combinations of up to ten hinges are looked at; of more, those in which all
    /// appendages hold equally many hinges at their inboard or outboard end. There are at most
    /// 32 routines, those of the most free hinges, and fewer of limbs of many links.
    ///
    /// # Errors
    /// When a body is not rigid, carries a rotor or is one of too many.
    pub fn lock_states(scene: &Scene, level: Level) -> Result<Vec<Self>, CodegenError> {
        let mut found: BTreeMap<Topology, Vec<Vec<f64>>> = BTreeMap::new();
        for free in combinations(scene) {
            for angle in ANGLES {
                let Recognised { topology, parameters, .. } = welded(scene, &free, angle)?;
                found.entry(topology).or_default().push(parameters.write());
            }
        }
        let mut requests: Vec<Self> = found
            .into_iter()
            .map(|(topology, cases)| Self {
                assumptions: fixed(&topology, &cases),
                ..Self::new(&name("Satellite", &topology), topology, level)
            })
            .map(|request| request.on(scene))
            .collect();
        requests.sort_by_key(|request| usize::MAX - request.topology.hinges());
        let mut links = 0;
        let few = requests.iter().take_while(|request| {
            links += limb_links(&request.topology);
            links <= LIMB_LINKS
        });
        let few = few.count().min(LOCK_STATES);
        requests.truncate(few);
        Ok(requests)
    }

    /// The request for the main body of a scene, on which something acts from outside or nothing, or rotors that it
    /// carries along, and which may be held.
    fn on(self, scene: &Scene) -> Self {
        if scene.base.is_held() {
            return self.with_held_main_body().with_external_wrench();
        }
        let is_alone = scene.externals.is_empty() && scene.rotors.is_empty();
        if is_alone { self } else { self.with_external_wrench() }
    }

    /// Which hinges are free in the first of a scene's lock states that has the request's
    /// topology.
    ///
    /// # Errors
    /// When a body is not rigid, carries a rotor or is one of too many.
    pub fn free_hinges(&self, scene: &Scene) -> Result<Option<Vec<bool>>, CodegenError> {
        for free in combinations(scene) {
            for angle in ANGLES {
                if welded(scene, &free, angle)?.topology == self.topology {
                    return Ok(Some(free));
                }
            }
        }
        Ok(None)
    }
}

/// Links of limbs that are not equal to others.
fn limb_links(topology: &Topology) -> usize {
    let groups = topology.groups();
    let limbs = groups.filter(|(shape, _)| matches!(shape, Shape::Limb(_)));
    limbs.map(|(shape, _)| shape.hinges()).sum()
}

/// `word` and the topology without what cannot stand in a name.
pub(crate) fn name(word: &str, topology: &Topology) -> String {
    format!("{word}{}", identifier(topology))
}

/// For each hinge that is not `free`, the angle at which it is held, different ones around `angle`.
pub fn held_at(free: &[bool], angle: f64) -> Vec<Option<f64>> {
    let of_hinge = |(i, &free): (usize, &bool)| (!free).then_some(angle * (1.0 + 0.1 * i as f64));
    free.iter().enumerate().map(of_hinge).collect()
}

/// The scene with the hinges that are not `free` held, at different angles around `angle`.
pub(crate) fn held(scene: &Scene, free: &[bool], angle: f64) -> WeldedTree<f64> {
    let beta: Vec<f64> = held_at(free, angle).iter().map(|held| held.unwrap_or(0.0)).collect();
    WeldedTree::new(scene, &mode_with(scene, free), &beta)
}

/// The mode in which the hinges that are not `free` are held.
pub(crate) fn mode_with(scene: &Scene, free: &[bool]) -> Mode {
    let state = |&free: &bool| if free { HingeState::Free } else { HingeState::Locked };
    Mode {
        hinges: free.iter().map(state).collect(),
        externals: vec![1; scene.externals.len()],
        ..Mode::at_start(scene)
    }
}

/// The chains and paddles of a scene in which the hinges that are not `free` are held.
pub(crate) fn welded(scene: &Scene, free: &[bool], angle: f64) -> Result<Recognised, CodegenError> {
    let tree = held(scene, free, angle);
    recognise(&tree).map_err(|Uncovered { link, why }| {
        let hinge = scene.label(tree.links[link].hinge).to_string();
        CodegenError::NotCovered { scene: scene.name.clone(), hinge, why }
    })
}

/// Which hinges are free in each state to look at; all free is not among them.
pub(crate) fn combinations(scene: &Scene) -> Vec<Vec<bool>> {
    let hinges = scene.bodies.len();
    if hinges <= FEW_HINGES {
        let free = |bits: usize| (0..hinges).map(|i| bits >> i & 1 == 1).collect();
        return (0..(1 << hinges) - 1).map(free).collect();
    }
    let mut inboard = vec![0; hinges];
    let mut outboard = vec![0; hinges];
    for (i, body) in scene.bodies.iter().enumerate() {
        inboard[i] = body.inboard.map_or(0, |inner| inboard[inner] + 1);
    }
    for (i, body) in scene.bodies.iter().enumerate().rev() {
        if let Some(inner) = body.inboard {
            outboard[inner] = outboard[inner].max(outboard[i] + 1);
        }
    }
    let longest = inboard.iter().max().map_or(0, |most| most + 1);
    let beyond = |depths: &[usize], held: usize| depths.iter().map(|&d| d >= held).collect();
    (1..=longest).flat_map(|held| [beyond(&inboard, held), beyond(&outboard, held)]).collect()
}

/// What is the same number in all cases: zeros, and ones in rotations.
fn fixed(topology: &Topology, cases: &[Vec<f64>]) -> Vec<Option<f64>> {
    let rotations = rotations(topology);
    let simple = |i: usize, value: f64| value == 0.0 || (rotations[i] && value.abs() == 1.0);
    let fixed = |i: usize| {
        let value = cases[0][i];
        let same = cases.iter().all(|case| case[i] == value);
        (same && simple(i, value)).then_some(value + 0.0)
    };
    (0..Layout::parameters(topology)).map(fixed).collect()
}

/// Which parameters are entries of an appendage's rotation.
fn rotations(topology: &Topology) -> Vec<bool> {
    let mut all = vec![false; Layout::MAIN];
    for shape in topology.shapes() {
        let is_entry = |i: usize| i < 9;
        all.extend((0..Layout::BRANCH).map(is_entry));
        for link in 0..shape.hinges() {
            let end = all.len() + Layout::link(shape, link);
            if let Shape::Limb(limb) = shape
                && Layout::mount(limb, link) == Layout::BRANCH
            {
                all.extend((0..Layout::BRANCH).map(is_entry));
            }
            all.resize(end, false);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_model::{Appendage, Hinge, MassProperties, Mount, SceneDescription, Segment};
    use nboom_scalar::{Sym3, Vec3};

    fn booms(count: usize, segments: usize) -> Scene {
        let body = MassProperties::new(1.0, Vec3::unit_y() * 0.5, Sym3::diagonal(1.0, 0.4, 1.2));
        let segment = Segment { length: 1.0, mass_properties: body, hinge: Hinge::free() };
        let mut description = SceneDescription::at_rest("booms", body, 1.0);
        for i in 0..count {
            let (mount, segments) =
                (Mount::at(Vec3::unit_z() * i as f64), vec![segment.clone(); segments]);
            description.attach(&Appendage::Regular { mount, segments });
        }
        Scene::new(description).expect("the bodies are physical")
    }

    fn states(scene: &Scene) -> Vec<String> {
        let requests = Request::lock_states(scene, Level::Fast).expect("chains are covered");
        requests.iter().map(|request| request.topology.to_string()).collect()
    }

    #[test]
    fn lock_states_are_all_topologies_with_fewer_hinges() {
        assert_eq!(states(&booms(1, 3)), ["S2", "S1", "M"]);
        assert_eq!(states(&booms(2, 2)), ["S2_S1", "2xS1", "S2", "S1", "M"]);
    }

    #[test]
    fn many_hinges_are_held_in_step() {
        assert_eq!(states(&booms(3, 4)), ["3xS3", "3xS2", "3xS1", "M"]);
        assert_eq!(states(&booms(1, 100)).len(), LOCK_STATES);
    }

    #[test]
    fn every_lock_state_is_told_which_hinges_are_free() {
        let scene = booms(2, 2);
        for request in Request::lock_states(&scene, Level::Fast).expect("chains are covered") {
            let free = request.free_hinges(&scene).expect("chains").expect("it is one of them");
            assert_eq!(free.iter().filter(|&&free| free).count(), request.topology.hinges());
        }
        let whole = Request::of_scene(&scene, Numbers::RunTime, Level::Fast).expect("chains");
        assert_eq!(whole.free_hinges(&scene), Ok(None));
    }

    #[test]
    fn a_simulator_has_code_that_assumes_nothing() {
        let names = |formulation| -> Vec<String> {
            let all = Request::of_simulator(&booms(1, 2), formulation, Level::Fast);
            all.expect("a chain").into_iter().map(|request| request.name).collect()
        };
        let special = ["BakedS2", "SatelliteS2", "SatelliteS1", "SatelliteM"];
        assert_eq!(names(Formulation::Relative), special);
        let articulated = names(Formulation::Articulated);
        assert_eq!(articulated, [&special[..], &["GeneralS2"]].concat());
        let all = Request::of_simulator(&booms(1, 2), Formulation::Articulated, Level::Fast);
        let general = all.expect("a chain").pop().expect("it is the last");
        assert!(general.external && general.assumptions.iter().all(Option::is_none));
    }

    #[test]
    fn what_a_held_hinge_makes_other_than_zero_is_not_assumed() {
        let scene = booms(1, 2);
        let requests = Request::lock_states(&scene, Level::Fast).expect("chains are covered");
        let link = Layout::MAIN + Layout::BRANCH;
        let (across, along_axis) = (link + 3, link + 1);
        // With the outer hinge held at an angle, the mass centre is off the η axis.
        assert_eq!(requests[0].assumptions[across], None);
        assert_eq!(requests[0].assumptions[along_axis], Some(0.0));
        let all_free = Request::of_scene(&scene, Numbers::RunTime, Level::Fast).expect("a chain");
        assert_eq!(all_free.assumptions[across], Some(0.0));
        assert_eq!(all_free.name, "SatelliteS2");
        assert!(all_free.assumptions[link].is_none(), "a mass is handed in");
        let baked = Request::of_scene(&scene, Numbers::Baked, Level::Fast).expect("a chain");
        assert!(baked.assumptions.iter().all(Option::is_some) && baked.name == "BakedS2");
    }
}
