//! Satellites of any topology from a seed: chains, paddles and limbs with hinges held, their parameters,
//! states, and what a routine may assume about them.

use std::f64::consts::FRAC_PI_2;

use nboom_elements::{CouplingLaw, HingeLaw, KickOffLaw};
use nboom_formulation::{Forces, Layout, LinkLine, Recognised, RightSideLayout, recognise};
use nboom_model::{
    Appendage, Body, Hinge, HingeState, Joint, MassProperties, Mode, Mount, Scene,
    SceneDescription, Segment, Shape, Topology, WeldedTree,
};
use nboom_scalar::{Mat3, Sym3, Vec3, Wrench};

use crate::random::Rng;

/// States of each satellite.
const STATES: usize = 2;

/// A satellite with all that a request and an evaluation of it take.
#[derive(Clone, Debug)]
pub struct Satellite {
    pub topology: Topology,
    /// How many hinges of the scene it came from are held.
    pub held: usize,
    pub parameters: Vec<f64>,
    /// Some of the parameters.
    pub assumptions: Vec<Option<f64>>,
    pub external: bool,
    pub states: Vec<Vec<f64>>,
    /// Numbers of what acts on it.
    pub forces: Vec<f64>,
    /// Some of them.
    pub force_assumptions: Vec<Option<f64>>,
    /// Attitude, ω, β and τ.
    pub variables: Vec<Vec<f64>>,
}

impl Satellite {
    /// Whether its main body is held, which is assumed then.
    pub fn is_on_a_rig(&self) -> bool {
        self.parameters[..Layout::MAIN] == Layout::held_main()
    }

    /// Whether a line pushes a link, hinges are coupled, rotors turn, or something is assumed of the forces.
    pub fn pushed_or_known(&self) -> bool {
        let hinges = self.topology.hinges();
        let forces = Forces::read(hinges, self.forces.iter().copied());
        let none = Forces::none(hinges);
        forces.lines != none.lines
            || forces.spin != none.spin
            || forces.couplings != none.couplings
            || self.force_assumptions.iter().any(Option::is_some)
    }

    pub fn random(seed: u64) -> Self {
        let dice = &mut Rng::new(seed);
        let (topology, held, mut parameters) = welded(dice);
        let mut assumptions = assumptions(dice, &topology, &mut parameters);
        let external = dice.chance(0.5);
        let states = (0..STATES).map(|_| state(dice, &topology, external)).collect();
        let (forces, force_assumptions) = forces(dice, &topology, external);
        let count = RightSideLayout::coordinates(&topology);
        let variables = (0..STATES).map(|_| numbers(dice, count)).collect();
        if dice.chance(0.15) {
            for (i, number) in Layout::held_main().into_iter().enumerate() {
                (parameters[i], assumptions[i]) = (number, Some(number));
            }
        }
        Self {
            topology,
            held,
            parameters,
            assumptions,
            external,
            states,
            forces,
            force_assumptions,
            variables,
        }
    }
}

impl Rng {
    fn vector(&mut self, size: f64) -> Vec3<f64> {
        let mut one = || self.between(-size, size);
        Vec3::new(one(), one(), one())
    }

    /// Any rotation, or one by quarter turns.
    fn rotation(&mut self, quarters: bool) -> Mat3<f64> {
        let mut angle = || match quarters {
            true => FRAC_PI_2 * self.below(4) as f64,
            false => self.between(-3.0, 3.0),
        };
        let rot = Mat3::from_euler_121(angle(), angle(), angle());
        if !quarters {
            return rot;
        }
        let exact = |v: Vec3<f64>| Vec3::new(v.x.round(), v.y.round(), v.z.round());
        Mat3 { rows: rot.rows.map(exact) }
    }

    /// Along the axes and on the second one, or anyhow.
    fn body(&mut self, mass: f64, along_axes: bool) -> MassProperties {
        let [x, y, z] = [(); 3].map(|()| self.between(0.05, 0.5) * mass);
        let moments = Sym3::diagonal(y + z, x + z, x + y);
        if along_axes {
            return MassProperties::new(mass, Vec3::unit_y() * self.between(-1.0, 1.0), moments);
        }
        let inertia = moments.rotated(&self.rotation(false));
        MassProperties::new(mass, self.vector(0.6), inertia)
    }
}

/// Topology, held hinges and parameters of a random scene: mostly up to 10 hinges, now and then
/// up to 30.
fn welded(dice: &mut Rng) -> (Topology, usize, Vec<f64>) {
    let hinges = if dice.chance(0.97) { dice.below(11) } else { 11 + dice.below(20) };
    let scene = scene(dice, hinges);
    let share = if dice.chance(0.5) { 0.3 } else { 0.0 };
    let states: Vec<HingeState> = (0..scene.bodies.len())
        .map(|_| if dice.chance(share) { HingeState::Locked } else { HingeState::Free })
        .collect();
    let held = states.iter().filter(|state| **state == HingeState::Locked).count();
    let mode = Mode { hinges: states, ..Mode::at_start(&scene) };
    let beta: Vec<f64> = scene.bodies.iter().map(|_| dice.between(-3.0, 3.0)).collect();
    let tree = WeldedTree::new(&scene, &mode, &beta);
    let Recognised { topology, parameters, .. } = recognise(&tree).expect("rigid bodies");
    (topology, held, parameters.write())
}

fn scene(dice: &mut Rng, hinges: usize) -> Scene {
    let along_axes = dice.chance(0.5);
    let mut main_body = dice.body(50.0, along_axes);
    if along_axes {
        main_body.center_of_mass = Vec3::zero();
    }
    let mut description = SceneDescription::at_rest("random", main_body, 1.0);
    let limbs = if dice.chance(0.3) { 0.6 } else { 0.0 };
    while description.bodies.len() < hinges {
        let most = hinges - description.bodies.len();
        if dice.chance(limbs) {
            limb(dice, along_axes, most, &mut description.bodies);
        } else {
            description.attach(&appendage(dice, along_axes, most));
        }
    }
    Scene::new(description).expect("the bodies are physical")
}

/// A tree of at most this many joints: parallel to the inboard one, across it, or slides.
fn limb(dice: &mut Rng, along_axes: bool, most: usize, bodies: &mut Vec<Body>) {
    let first = bodies.len();
    for i in first..first + 1 + dice.below(most) {
        let inboard = (i > first).then(|| first + dice.below(i - first));
        let rot_inboard_from_hinge = match dice.chance(0.4) {
            true => Mat3::identity(),
            false => dice.rotation(along_axes),
        };
        let joint = if dice.chance(0.2) { Joint::Prismatic } else { Joint::Revolute };
        bodies.push(Body {
            inboard,
            mount: Mount { point: dice.vector(1.0), rot_inboard_from_hinge },
            joint,
            axis: Vec3::unit_x(),
            mass_properties: dice.body(2.0, along_axes),
            tip: Vec3::zero(),
            hinge: Hinge::free(),
        });
    }
}

/// A chain or a paddle of at most this many hinges.
fn appendage(dice: &mut Rng, along_axes: bool, most: usize) -> Appendage {
    let rot_inboard_from_hinge = dice.rotation(along_axes);
    let mount = Mount { point: dice.vector(1.0), rot_inboard_from_hinge };
    let is_paddle = most >= 2 && dice.chance(0.3);
    let longest = 1 + dice.below(most);
    let links = 1 + dice.below(longest);
    let mut segment = || Segment {
        length: dice.between(0.2, 1.5),
        mass_properties: dice.body(2.0, along_axes),
        hinge: Hinge::free(),
    };
    if is_paddle {
        return Appendage::Paddle { mount, arm: segment(), paddle: segment() };
    }
    Appendage::Regular { mount, segments: (0..links).map(|_| segment()).collect() }
}

/// Nothing, all zeros and ones, some numbers, or all. Of those that may be zero, some are set to
/// zero first.
fn assumptions(dice: &mut Rng, topology: &Topology, parameters: &mut [f64]) -> Vec<Option<f64>> {
    match dice.below(4) {
        0 => vec![None; parameters.len()],
        1 => {
            let plain = |&value: &f64| (value == 0.0 || value.abs() == 1.0).then_some(value);
            parameters.iter().map(plain).collect()
        }
        2 => {
            let share = dice.between(0.0, 1.0);
            for at in rigid_bodies(topology) {
                for couples in [1, 2, 3, 7, 8, 9].map(|i| at + i) {
                    if dice.chance(0.5 * share) {
                        parameters[couples] = 0.0;
                    }
                }
            }
            parameters.iter().map(|&value| dice.chance(share).then_some(value)).collect()
        }
        _ => parameters.iter().copied().map(Some).collect(),
    }
}

/// Where the ten numbers of the main body and of each link begin.
fn rigid_bodies(topology: &Topology) -> Vec<usize> {
    let (mut at, mut all) = (Layout::MAIN, vec![0]);
    for shape in topology.shapes() {
        at += Layout::BRANCH;
        for link in 0..shape.hinges() {
            let mount = if let Shape::Limb(limb) = shape { Layout::mount(limb, link) } else { 0 };
            all.push(at + mount);
            at += Layout::link(shape, link);
        }
    }
    all
}

/// Numbers of order one, some of them zero at times.
fn numbers(dice: &mut Rng, count: usize) -> Vec<f64> {
    let zeros = if dice.chance(0.3) { 0.5 } else { 0.0 };
    let mut number = |_| if dice.chance(zeros) { 0.0 } else { dice.between(-3.0, 3.0) };
    (0..count).map(&mut number).collect()
}

fn state(dice: &mut Rng, topology: &Topology, external: bool) -> Vec<f64> {
    let mut state = numbers(dice, Layout::coordinates(topology));
    if !external {
        state[3..9].fill(0.0);
    }
    state
}

/// Hinge laws, an external wrench, rotors, lines that push some links and couplings of some hinges; of them nothing, that
/// no line pushes, no hinge is coupled and no rotor turns, some numbers or all are assumed.
fn forces(dice: &mut Rng, topology: &Topology, external: bool) -> (Vec<f64>, Vec<Option<f64>>) {
    let mut forces = Forces::none(topology.hinges());
    for law in &mut forces.laws {
        *law = HingeLaw::of_numbers([(); 7].map(|()| dice.between(-1.0, 1.0)));
    }
    if external {
        forces.external = Wrench { moment: dice.vector(1.0), force: dice.vector(1.0) };
    }
    let kind = dice.below(4);
    for line in &mut forces.lines {
        if kind == 1 || dice.chance(0.5) {
            continue;
        }
        let law = KickOffLaw::new([(); 4].map(|()| dice.between(-1.0, 1.0)));
        *line = LinkLine { point: dice.vector(1.0), main_body_point: dice.vector(1.0), law };
    }
    if kind != 1 && dice.chance(0.5) {
        forces.spin = dice.vector(1.0);
    }
    for coupling in &mut forces.couplings {
        if kind != 1 && dice.chance(0.3) {
            let law = [(); RightSideLayout::COUPLING].map(|()| dice.between(-1.0, 1.0));
            *coupling = CouplingLaw::of_numbers(law);
        }
    }
    let numbers = forces.write();
    let assumptions = match kind {
        0 | 1 => vec![None; numbers.len()],
        2 => numbers.iter().map(|&value| dice.chance(0.5).then_some(value)).collect(),
        _ => numbers.iter().copied().map(Some).collect(),
    };
    (numbers, assumptions)
}
