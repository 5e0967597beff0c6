//! Right sides of the differential equations of a scene's modes.

use std::collections::BTreeMap;

use nboom_elements::Elements;
use nboom_formulation::{Forces, Layout, NoPlace, RightSideLayout, recognise};
use nboom_model::{Mode, Rotor, RotorSpeed, Scene, Topology};

use crate::request::scene::{ANGLES, combinations, held, mode_with, welded};
use crate::request::{CodegenError, Request};

/// What acts in the modes of a topology, numbers of [`Forces`]; `None` where a right side has no place
/// for what acts in one of them.
type Cases = BTreeMap<Topology, Option<Vec<Vec<f64>>>>;

/// The most hinges of a right side that is compiled for eight states at once.
const MOST_ON_EIGHT_STATES: usize = 20;

impl Request {
    /// The right sides beside requests for the `accelerations` of a scene's modes: for each request one
    /// that assumes as much and that no line pushes a link, and one whose links kick-off springs push,
    /// where they do; of a topology with all numbers built in, that one takes the place of others that
    /// assume something. Modes in which a right side has no place for what acts have none.
    pub fn right_sides(scene: &Scene, accelerations: &[Self]) -> Vec<Self> {
        let all_free = vec![true; scene.bodies.len()];
        let (mut cases, mut pushed) = (Cases::new(), Cases::new());
        for free in combinations(scene).iter().chain([&all_free]) {
            for angle in ANGLES {
                note(&mut cases, scene, free, angle, false);
            }
            note(&mut pushed, scene, free, ANGLES[0], true);
        }
        let mut requests = Vec::new();
        for request in accelerations {
            let of_topology = |cases: &Cases| cases.get(&request.topology).cloned().flatten();
            requests.extend(of_topology(&cases).map(|cases| request.right_side(&cases)));
            let is_built_in = |other: &Self| other.is_baked() && other.topology == request.topology;
            let stands_alone = request.is_baked() || request.is_general();
            if stands_alone || !accelerations.iter().any(is_built_in) {
                requests.extend(of_topology(&pushed).and_then(|cases| request.pushed(&cases)));
            }
        }
        requests
    }

    /// The right side beside this request for the accelerations of a scene with all hinges free, which takes lines
    /// where kick-off springs push. Of hinge laws it assumes what the request assumes of bodies: nothing, zeros or all.
    /// What a line is, is handed in, so that it is also for springs that have let go.
    ///
    /// # Errors
    /// When a body is not rigid, carries a rotor or is one of too many, and when something acts on the scene that a
    /// right side has no place for.
    pub fn right_side_of(&self, scene: &Scene) -> Result<Self, CodegenError> {
        let all_free = vec![true; scene.bodies.len()];
        // Refuses what is not recognised.
        welded(scene, &all_free, ANGLES[0])?;
        let acting = acting(scene, &all_free, ANGLES[0], (true, 1));
        let (_, cases) = acting.expect("the scene is recognised");
        let no_place = |what| CodegenError::no_place(scene, what);
        // A table may begin later.
        let varies = |rotor: &Rotor| matches!(rotor.speed, RotorSpeed::Table(_));
        if let Some(rotor) = scene.rotors.iter().position(varies) {
            return Err(no_place(NoPlace::Rotor { rotor }));
        }
        if let Some(hinge) = scene.hinges_with_friction().next() {
            return Err(no_place(NoPlace::Friction { hinge }));
        }
        let cases = cases.map_err(no_place)?;
        let places = self.places_that_push(&cases);
        Ok(self.right_side(&cases).with_lines_at(&places))
    }

    fn is_baked(&self) -> bool {
        self.assumptions.iter().all(Option::is_some)
    }

    /// Whether it assumes nothing, but that the main body is held if it is.
    fn is_general(&self) -> bool {
        let known = if self.holds_main_body() { Layout::MAIN } else { 0 };
        self.assumptions[known..].iter().all(Option::is_none)
    }

    /// No line pushes; numbers that laws have in all cases are built in, or zeros among them, or nothing.
    fn right_side(&self, cases: &[Vec<f64>]) -> Self {
        let name = format!("RightSide{}", self.name);
        // What assumes nothing is taken where nothing else is; it is not worth compilers' time, but of a
        // main body alone.
        let is_special = !self.is_general() || self.topology.hinges() == 0;
        let on_eight_states = is_special && self.topology.hinges() <= MOST_ON_EIGHT_STATES;
        let mut request = Self { name, on_eight_states, ..self.clone() }.for_right_side();
        let of_laws = RightSideLayout::external(&self.topology).start;
        let start = Layout::parameters(&self.topology);
        let known = |at: usize| {
            let value = cases[0][at - start];
            let same = cases.iter().all(|case| case[at - start] == value);
            let simple = !self.is_general() && value == 0.0;
            (same && (self.is_baked() || simple)).then_some(value + 0.0)
        };
        for at in start..of_laws {
            request.assumptions[at] = known(at);
        }
        if self.is_baked() {
            let of_lines = RightSideLayout::external(&self.topology).end;
            for (i, assumed) in request.assumptions[of_lines..].iter_mut().enumerate() {
                *assumed = Some(cases[0][of_lines - start + i]);
            }
        }
        let spin = RightSideLayout::spin(&self.topology);
        if spin.clone().any(|at| cases.iter().any(|case| case[at - start] != 0.0)) {
            spin.for_each(|at| request.assumptions[at] = known(at));
        }
        let acts = |hinge: &usize| {
            let strength = RightSideLayout::strength(&self.topology, *hinge);
            cases.iter().any(|case| strength.iter().any(|at| case[at - start] != 0.0))
        };
        let coupled: Vec<usize> = (0..self.topology.hinges()).filter(acts).collect();
        if self.is_general() && !coupled.is_empty() {
            // States with held hinges that have no code of their own run in this one.
            return request.with_couplings();
        }
        for hinge in coupled {
            let numbers = RightSideLayout::coupling(&self.topology, hinge);
            numbers.for_each(|at| request.assumptions[at] = known(at));
        }
        request
    }

    /// Lines push, with numbers at run time, so that the code is for modes in which some have let go, too;
    /// where there is none, that is built in. `None` where none pushes.
    fn pushed(&self, cases: &[Vec<f64>]) -> Option<Self> {
        let places = self.places_that_push(cases);
        if places.is_empty() {
            return None;
        }
        let pushed = Self { name: format!("Pushed{}", self.name), ..self.right_side(cases) };
        if self.is_general() {
            // As for couplings.
            return Some(Self { on_eight_states: self.on_eight_states, ..pushed }.with_lines(1));
        }
        Some(pushed.with_lines_at(&places))
    }

    /// The places of the lines that push in one of the `cases`.
    fn places_that_push(&self, cases: &[Vec<f64>]) -> Vec<usize> {
        let (topology, start) = (&self.topology, Layout::parameters(&self.topology));
        let pushes = |&place: &usize| {
            let mut numbers = RightSideLayout::coefficients(topology, place);
            numbers.any(|at| cases.iter().any(|case| case[at - start] != 0.0))
        };
        (0..RightSideLayout::lines(topology)).filter(pushes).collect()
    }

    /// The numbers of the lines at these places are handed in.
    fn with_lines_at(mut self, places: &[usize]) -> Self {
        for &place in places {
            self.assumptions[RightSideLayout::line(&self.topology, place)].fill(None);
        }
        self
    }
}

/// Notes what acts on a scene in which the hinges that are not `free` are held at angles around `angle`,
/// and lines push or do not, on every piece of torque tables.
fn note(cases: &mut Cases, scene: &Scene, free: &[bool], angle: f64, pushing: bool) {
    let Some((topology, found)) = acting(scene, free, angle, (pushing, 0)) else { return };
    let known = cases.entry(topology).or_insert_with(|| Some(Vec::new()));
    match (known.as_mut(), found) {
        (Some(all), Ok(forces)) => all.extend(forces),
        // Other modes of the topology may have fewer lines.
        _ if pushing => {}
        _ => *known = None,
    }
}

/// What acts in each of some modes, numbers of [`Forces`]; or what a right side has no place for.
type Acting = Result<Vec<Vec<f64>>, NoPlace>;

/// What [`note`] notes, with the topology, while all that acts from outside is in this piece of its course; `None`
/// where the scene has no topology.
fn acting(
    scene: &Scene,
    free: &[bool],
    angle: f64,
    (pushing, piece_outside): (bool, usize),
) -> Option<(Topology, Acting)> {
    let externals = vec![piece_outside; scene.externals.len()];
    let mode = Mode { externals, ..mode_with(scene, free) };
    let mut mode = mode.with_kick_offs(scene, pushing);
    let tree = held(scene, free, angle);
    let recognised = recognise(&tree).ok()?;
    // Lines come first, then friction, whose pieces are three.
    let frictions = scene.friction_pieces();
    let points = scene.torque_tables.iter().map(|table| table.points.len());
    let last = points.max().unwrap_or(0).max(if frictions.is_empty() { 0 } else { 2 });
    let on_piece = |piece: usize| {
        mode.pieces[frictions.clone()].fill(piece.min(2));
        for (of_table, table) in mode.pieces[frictions.end..].iter_mut().zip(&scene.torque_tables) {
            *of_table = piece.min(table.points.len());
        }
        let elements = Elements::new(scene, &mode, &tree);
        Forces::of(&elements, &tree, &recognised).map(|forces| forces.write())
    };
    let found = (0..=last).map(on_piece).collect();
    Some((recognised.topology, found))
}

#[cfg(test)]
mod tests {
    use nboom_formulation::Formulation;
    use nboom_model::{
        Base, Body, Coupling, Hinge, Joint, MassProperties, Mount, SceneDescription, Spring,
        TorqueTable,
    };
    use nboom_scalar::{Sym3, Vec3};

    use super::*;
    use crate::Level;
    use crate::request::Numbers;

    /// A boom of two segments with springs, a torque table about the outer hinge.
    fn scene() -> Scene {
        let properties = MassProperties::new(2.0, Vec3::unit_y(), Sym3::diagonal(0.5, 0.1, 0.5));
        let mut scene = SceneDescription::at_rest("boom", properties, 1.0);
        let (tip, axis) = (Vec3::unit_y() * 2.0, Vec3::unit_x());
        for inboard in [None, Some(0)] {
            let spring = Spring { quadratic: 0.0, linear: -0.7, preload_angle: 0.2 };
            let hinge = Hinge { spring, ..Hinge::free() };
            scene.bodies.push(Body {
                inboard,
                mount: Mount::at(tip),
                joint: Joint::Revolute,
                axis,
                mass_properties: properties,
                tip,
                hinge,
            });
        }
        let points = vec![[-1.0, 3.0], [0.5, -1.0], [1.5, 2.0]];
        scene.torque_tables.push(TorqueTable { hinge: 1, points });
        Scene::new(scene).expect("a valid scene")
    }

    #[test]
    fn code_for_a_rig_takes_the_wrench_that_holds_the_main_body() {
        let rig = SceneDescription { base: Base::Fixed, ..(*scene()).clone() };
        let rig = Scene::new(rig).expect("a valid scene");
        let requests = Request::of_simulator(&rig, Formulation::Articulated, Level::Fast);
        let requests = requests.expect("two links");
        for request in Request::right_sides(&rig, &requests).iter().chain(&requests) {
            assert!(request.external, "{}", request.name);
        }
        for right_side in Request::right_sides(&rig, &requests) {
            let wrench = RightSideLayout::external(&right_side.topology);
            assert!(right_side.assumptions[wrench].iter().all(Option::is_none));
        }
    }

    #[test]
    fn a_law_with_a_table_is_assumed_only_where_all_pieces_agree() {
        let scene = scene();
        for numbers in [Numbers::Baked, Numbers::RunTime] {
            let accelerations = Request::of_scene(&scene, numbers, Level::Fast).expect("two links");
            let found = Request::right_sides(&scene, &[accelerations]);
            let [right_side] = &found[..] else { panic!("one right side: no line pushes") };
            let of_hinge = |hinge| {
                let law = RightSideLayout::law(&right_side.topology, hinge);
                right_side.assumptions[law].to_vec()
            };
            let zero = Some(0.0);
            // A table adds nothing that depends on the rate.
            let beyond = [zero, zero, None, None, None, None, None];
            assert_eq!(of_hinge(1), beyond, "{numbers:?}");
            let spring = match numbers {
                Numbers::Baked => [zero, zero, zero, zero, Some(-0.7), Some(-0.7 * 0.2), zero],
                Numbers::RunTime => [zero, zero, zero, zero, None, None, zero],
            };
            assert_eq!(of_hinge(0), spring, "{numbers:?}");
        }
    }

    /// The boom with one segment more, whose hinge is coupled with the one inboard of it.
    fn coupled() -> Scene {
        let mut description = (*scene()).clone();
        description.bodies.push(Body { inboard: Some(1), ..description.bodies[1] });
        description.couplings.push(Coupling {
            hinges: [1, 2],
            ratio: -2.0,
            stiffness: 3.0,
            rest: 0.0,
            damping: 0.5,
            is_mutual: true,
        });
        Scene::new(description).expect("a valid scene")
    }

    #[test]
    fn couplings_are_assumed_as_laws_are() {
        let scene = coupled();
        let (zero, none) = (Some(0.0), [None, None, Some(0.0), None, Some(0.0)]);
        for (numbers, of_none, of_coupling) in [
            (Numbers::RunTime, none, [None, None, None, zero, None]),
            (Numbers::Baked, [zero; 5], [Some(2.0), Some(1.0), Some(3.0), zero, Some(0.5)]),
        ] {
            let accelerations = Request::of_scene(&scene, numbers, Level::Fast).expect("a boom");
            let found = Request::right_sides(&scene, &[accelerations]);
            let [right_side] = &found[..] else { panic!("one right side: no line pushes") };
            let of_hinge = |hinge| {
                let coupling = RightSideLayout::coupling(&right_side.topology, hinge);
                right_side.assumptions[coupling].to_vec()
            };
            assert_eq!([0, 1].map(of_hinge), [of_none; 2], "{numbers:?}");
            assert_eq!(of_hinge(2), of_coupling, "{numbers:?}");
        }
    }

    /// With the first hinge held, the coupling is that of the second hinge.
    #[test]
    fn what_takes_states_with_held_hinges_takes_their_couplings() {
        let scene = coupled();
        let requests = Request::of_simulator(&scene, Formulation::Articulated, Level::Fast);
        let requests = requests.expect("a boom");
        let general: Vec<_> = requests.into_iter().filter(Request::is_general).collect();
        let right_sides = Request::right_sides(&scene, &general);
        assert!(!right_sides.is_empty());
        for request in right_sides {
            for hinge in 0..request.topology.hinges() {
                let strength = RightSideLayout::strength(&request.topology, hinge);
                assert_eq!(strength.map(|at| request.assumptions[at]), [None; 2]);
            }
        }
    }
}
