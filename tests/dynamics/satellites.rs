//! Satellites in a state, as the recursive path and as closed forms see them.

use nalgebra::DMatrix;
use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::formulation::{Coordinates, HingeCoordinates, Recognised, Solution, recognise};
use nboom::model::{
    Appendage, Dashpot, External, Hinge, HingeState, Mode, Mount, Scene, SceneDescription, Segment,
    Spring, WeldedTree,
};
use nboom::scalar::{DoubleDouble, Vec3};

use crate::forward_dynamics::{Case, condition};
use crate::random_scene::{Moment, Rng};

/// A satellite in one state with what the recursive path says about it.
pub struct Satellite {
    pub tree: WeldedTree<f64>,
    /// Hinges in the order of the tree's links.
    pub coordinates: Coordinates<f64>,
    pub accelerations: Accelerations<f64>,
    /// B₀ and u₀ over (V, ω, τ).
    pub mass_matrix: DMatrix<f64>,
    pub forcing: Vec<f64>,
}

impl Satellite {
    pub fn of_case(case: &Case) -> Self {
        Self::new(&case.scene, &case.mode, (&case.beta, &case.tau), case.omega)
    }

    pub fn of_moment(moment: &Moment) -> Self {
        let Moment { scene, mode, beta, tau, omega, .. } = moment;
        Self::new(scene, mode, (beta, tau), *omega)
    }

    fn new(scene: &Scene, mode: &Mode, (beta, tau): (&[f64], &[f64]), omega: Vec3<f64>) -> Self {
        let mut dynamics = Recursive::new(scene);
        dynamics.set_mode(mode, beta);
        let of_free =
            |all: &[f64]| -> Vec<f64> { dynamics.free_hinges().iter().map(|&i| all[i]).collect() };
        let (free_beta, free_tau) = (of_free(beta), of_free(tau));
        let motion = Motion { omega_body: omega, beta: &free_beta, tau: &free_tau };
        let size = 6 + free_beta.len();
        let (mut matrix, mut forcing) = (vec![0.0; size * size], vec![0.0; size]);
        dynamics.mass_matrix(&free_beta, &mut matrix);
        dynamics.forcing(&motion, &mut forcing);
        let mut accelerations = Accelerations::for_hinges(free_beta.len());
        dynamics.accelerations(&motion, &mut accelerations);
        let mut torques = vec![0.0; free_beta.len()];
        dynamics.hinge_forces(&motion, &mut torques);
        let hinge = |(j, &torque): (usize, &f64)| HingeCoordinates {
            beta: free_beta[j],
            tau: free_tau[j],
            torque,
        };
        let coordinates = Coordinates {
            omega,
            external: dynamics.acting_on_main_body(omega),
            hinges: torques.iter().enumerate().map(hinge).collect(),
        };
        Self {
            tree: WeldedTree::new(scene, mode, beta),
            coordinates,
            accelerations,
            mass_matrix: DMatrix::from_row_slice(size, size, &matrix),
            forcing,
        }
    }

    pub fn recognised(&self) -> Recognised {
        recognise(&self.tree).expect("chains and paddles")
    }

    /// The state with its hinges in the order of a topology.
    pub fn coordinates_of(&self, recognised: &Recognised) -> Coordinates<f64> {
        let hinges = recognised.links.iter().map(|&j| self.coordinates.hinges[j]).collect();
        Coordinates { hinges, ..self.coordinates.clone() }
    }

    /// Accelerations (a_O, ω̇, τ̇) by the recursive path, hinges in this order.
    pub fn expected(&self, links: &[usize]) -> Vec<f64> {
        let Accelerations { origin_body, omega_dot_body, tau_dot } = &self.accelerations;
        let mut all = [origin_body.to_array(), omega_dot_body.to_array()].concat();
        all.extend(links.iter().map(|&j| tau_dot[j]));
        all
    }

    /// Rows and columns of B₀ in the order of a topology.
    pub fn mass_matrix_of(&self, recognised: &Recognised) -> DMatrix<f64> {
        let order: Vec<usize> = (0..6).chain(recognised.links.iter().map(|&j| 6 + j)).collect();
        self.mass_matrix.select_rows(&order).select_columns(&order)
    }

    /// u₀ in the order of a topology.
    pub fn forcing_of(&self, recognised: &Recognised) -> Vec<f64> {
        let order = (0..6).chain(recognised.links.iter().map(|&j| 6 + j));
        order.map(|i| self.forcing[i]).collect()
    }

    /// What two ways to the same accelerations may differ by, relative to the largest. 1e-11
    /// as such, and beyond a condition of 1e4 in proportion to it: rounding of the matrix, a
    /// few 1e-16 of each entry, is magnified by the condition.
    pub fn allowed(&self) -> f64 {
        1e-11 * (self.condition() / 1e4).max(1.0)
    }

    /// Of B₀ with its diagonal scaled to 1.
    pub fn condition(&self) -> f64 {
        condition(&self.mass_matrix)
    }
}

/// (a_O, ω̇, τ̇) by the recursive path in double-double, hinges in this order.
pub fn exact(moment: &Moment, links: &[usize]) -> Vec<DoubleDouble> {
    let wide = |numbers: &[f64]| -> Vec<DoubleDouble> {
        numbers.iter().map(|&number| DoubleDouble::from(number)).collect()
    };
    let mut dynamics = Recursive::new(&moment.scene);
    dynamics.set_mode(&moment.mode, &wide(&moment.beta));
    let of_free =
        |all: &[f64]| -> Vec<f64> { dynamics.free_hinges().iter().map(|&i| all[i]).collect() };
    let (beta, tau) = (wide(&of_free(&moment.beta)), wide(&of_free(&moment.tau)));
    let omega_body = Vec3::constant(moment.omega);
    let mut found = Accelerations::for_hinges(beta.len());
    dynamics.accelerations(&Motion { omega_body, beta: &beta, tau: &tau }, &mut found);
    let Accelerations { origin_body, omega_dot_body, tau_dot } = &found;
    let mut all = [origin_body.to_array(), omega_dot_body.to_array()].concat();
    all.extend(links.iter().map(|&j| tau_dot[j]));
    all
}

/// (a_O, ω̇, τ̇) in one list.
pub fn flat(solution: &Solution<f64>) -> Vec<f64> {
    let main = &solution.main;
    let mut all = [main.linear.to_array(), main.angular.to_array()].concat();
    all.extend(&solution.tau_dot);
    all
}

/// Chains and paddles with full inertias in any direction, in a random state; each hinge is
/// held with probability 0.25.
pub fn random(seed: u64) -> Moment {
    of_kind(seed, Kind { longest: 6, decades: 0.0 })
}

/// A random satellite with masses over six decades, light main bodies with heavy booms among them, and
/// chains of up to 20 links.
pub fn extreme(seed: u64) -> Moment {
    of_kind(seed, Kind { longest: 20, decades: 3.0 })
}

/// What random satellites are like.
#[derive(Clone, Copy)]
struct Kind {
    /// The most links of a chain.
    longest: usize,
    /// By how many powers of ten masses are scaled up or down.
    decades: f64,
}

impl Kind {
    fn mass(self, dice: &mut Rng, (low, high): (f64, f64)) -> f64 {
        let mass = dice.between(low, high);
        if self.decades == 0.0 {
            return mass;
        }
        mass * 10.0_f64.powf(dice.between(-self.decades, self.decades))
    }
}

fn of_kind(seed: u64, kind: Kind) -> Moment {
    let dice = &mut Rng::new(seed);
    let mass = kind.mass(dice, (5.0, 50.0));
    let main_body = dice.mass_properties(mass, 1.5);
    let mut description = SceneDescription::at_rest("chains and paddles", main_body, 1.0);
    for _ in 0..1 + dice.below(4) {
        description.attach(&appendage(dice, kind));
    }
    if dice.chance(0.5) {
        let (force, point) = (dice.vector(10.0), dice.vector(1.0));
        description.externals = vec![External::thrust(force, point, [0.0, 0.5])];
    }
    let scene = Scene::new(description).expect("random bodies are physical");
    let held = |dice: &mut Rng| {
        if dice.chance(0.25) { HingeState::Locked } else { HingeState::Free }
    };
    let hinges: Vec<HingeState> = scene.bodies.iter().map(|_| held(dice)).collect();
    let externals = vec![1; scene.externals.len()];
    let mode = Mode { externals, hinges, ..Mode::at_start(&scene) };
    let beta = scene.bodies.iter().map(|_| dice.between(-3.0, 3.0)).collect();
    let mut rate = |i: usize| {
        let rate = dice.between(-2.0, 2.0);
        if mode.is_free(i) { rate } else { 0.0 }
    };
    let tau = (0..scene.bodies.len()).map(&mut rate).collect();
    let (omega, velocity_body) = (dice.vector(2.0), dice.vector(2.0));
    Moment { scene, mode, beta, tau, omega, velocity_body }
}

fn appendage(dice: &mut Rng, kind: Kind) -> Appendage {
    let mount = Mount { point: dice.vector(1.0), rot_inboard_from_hinge: dice.rotation() };
    if dice.chance(0.4) {
        return Appendage::Paddle { mount, arm: segment(dice, kind), paddle: segment(dice, kind) };
    }
    let segments = (0..1 + dice.below(kind.longest)).map(|_| segment(dice, kind)).collect();
    Appendage::Regular { mount, segments }
}

fn segment(dice: &mut Rng, kind: Kind) -> Segment {
    let mass = kind.mass(dice, (0.5, 10.0));
    let mass_properties = dice.mass_properties(mass, 0.8);
    let mut hinge = Hinge::free();
    hinge.spring = Spring {
        linear: dice.between(-8.0, 0.0),
        preload_angle: dice.between(-1.0, 1.0),
        ..hinge.spring
    };
    hinge.dashpot = Dashpot { rate_linear: dice.between(-2.0, 0.0), ..hinge.dashpot };
    Segment { length: dice.between(0.1, 2.0), mass_properties, hinge }
}
