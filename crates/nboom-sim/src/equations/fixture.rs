//! Equations of reference scenes in motion, for tests.

use nboom_elements::OwnLaws;
use nboom_model::{
    Course, External, ExternalAxes, ExternalKind, HingeState, Mode, Rotor, RotorSpeed, Scene,
    SceneDescription,
};
use nboom_scalar::Vec3;

use super::Equations;
use super::state::State;
use crate::code::fit::Repertoire;
use crate::options::{Form, Options};

/// Bodies without hinges, chains, paddles, gravity, laws with squares, and springs that push.
pub(super) const SCENES: [&str; 6] = [
    "s01_rigid_body",
    "s03_chain3_general",
    "s04_paddle_general",
    "s06_gravity_thrust",
    "s07_quadratic_terms",
    "s08_kickoff_disengage",
];

/// A reference scene, in motion, with every hinge free, every force acting, and rotors that speed up.
pub(super) fn in_motion(name: &str, formulation: Option<Form>) -> (Equations, Vec<f64>) {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/data/scenes");
    let path = std::path::Path::new(folder).join(name).with_extension("nml");
    let deck = nboom_io::read_scene(&path).expect("reference decks are valid").scene;
    let mut description = SceneDescription::clone(&deck);
    let thrust = External::thrust(Vec3::new(0.3, -0.2, 0.5), Vec3::unit_y(), [0.0, 1.0]);
    let course = Course::Table(vec![[0.0, 1.0], [2.0, -0.5]]);
    let (axes, body) = (ExternalAxes::Inertial, description.bodies.len().checked_sub(1));
    description.externals.push(External { axes, body, course, ..thrust.clone() });
    description.externals.push(External { kind: ExternalKind::Torque, body, ..thrust });
    // Momenta do not count rotors.
    if formulation.is_none() {
        let (axis, inertia) = (Vec3::unit_z(), 0.4);
        let speed = RotorSpeed::Table(vec![[-9.0, 1.0], [9.0, 7.0]]);
        description.rotors.push(Rotor { body: None, axis, inertia, speed: speed.clone() });
        description.rotors.push(Rotor { body, axis, inertia, speed });
    }
    let scene = Scene::new(description).expect("a valid deck under more forces");
    let mut state = State::initial(&scene);
    for (i, (beta, tau)) in state.beta.iter_mut().zip(&mut state.tau).enumerate() {
        *beta += 0.2 + 0.1 * i as f64;
        *tau = 0.7 - 0.3 * i as f64;
    }
    state.omega_body += Vec3::new(0.3, -0.2, 0.5);
    let mode = Mode {
        hinges: vec![HingeState::Free; scene.bodies.len()],
        pieces: vec![0; Mode::at_start(&scene).pieces.len()],
        externals: vec![1; scene.externals.len()],
        drive: 0,
        rotors: vec![1; scene.rotors.len()],
    };
    let options = Options { formulation, ..Options::default() };
    let (mut equations, mut y) = (
        Equations::new(&scene, OwnLaws::default(), Repertoire::shared(&options), &options),
        Vec::new(),
    );
    equations.enter(&mode, &mut state, &mut y);
    y.iter_mut().skip(equations.variables.layout.hinge_motion().end).for_each(|y| *y = 0.4);
    (equations, y)
}
