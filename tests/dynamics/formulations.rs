//! All closed forms against the recursive path, which shares only spatial algebra with them,
//! and against each other.

use nalgebra::{DMatrix, DVector};
use nboom::formulation::momentum::{self, Momenta, Velocities};
use nboom::formulation::report::{self, OriginMotion};
use nboom::formulation::{
    Coordinates, Equations, Formulation, Parameters, Recognised, Solution, relative, symmetric,
};
use nboom::model::{Base, Drive, DrivePoint, Gravity, HingeState, Mode, Scene, Shape, Topology};
use nboom::scalar::{Dual, Twist, Vec3, Wrench};

use crate::forward_dynamics::{Case, cases};
use crate::random_scene::{Moment, Rng, moment};
use crate::satellites::{Satellite, extreme, flat, random};
use crate::support::{numbers, relative_error};

/// Rounding of a sum of some dozen products, each of a few roundings.
const ROUNDING: f64 = 1e-13;

const RANDOM_SATELLITES: u64 = 1000;

/// For accelerations: each one another satellite in another state with other hinges held.
const MANY_SATELLITES: u64 = 10_000;

fn assert_same_accelerations(satellite: &Satellite, label: &str) {
    let recognised = satellite.recognised();
    let coordinates = satellite.coordinates_of(&recognised);
    let expected = satellite.expected(&recognised.links);
    let allowed = satellite.allowed();
    let Recognised { topology, parameters, .. } = &recognised;
    for formulation in Formulation::ALL {
        let found = formulation.solve(topology, parameters, &coordinates);
        let error = relative_error(&flat(&found), &expected, 0.0);
        assert!(error < allowed, "{label}, {topology}, {formulation}: {error:e} of {allowed:e}");
    }
}

#[test]
fn all_give_the_accelerations_of_the_reference_states() {
    for (id, case) in cases().iter().enumerate() {
        assert_same_accelerations(&Satellite::of_case(case), &format!("case {id}"));
    }
}

#[test]
fn all_give_the_accelerations_of_random_satellites() {
    let mut topologies = std::collections::BTreeSet::new();
    for seed in 0..MANY_SATELLITES {
        let satellite = Satellite::of_moment(&random(seed));
        assert_same_accelerations(&satellite, &format!("seed {seed}"));
        topologies.insert(satellite.recognised().topology);
    }
    assert!(topologies.len() > 150, "{} topologies", topologies.len());
}

#[test]
fn all_give_the_accelerations_of_satellites_with_masses_over_many_decades() {
    for seed in 0..MANY_SATELLITES {
        let satellite = Satellite::of_moment(&extreme(seed));
        let recognised = satellite.recognised();
        let coordinates = satellite.coordinates_of(&recognised);
        let expected = satellite.expected(&recognised.links);
        let Recognised { topology, parameters, .. } = &recognised;
        for formulation in Formulation::ALL {
            let found = formulation.solve(topology, parameters, &coordinates);
            let error = relative_error(&flat(&found), &expected, 0.0);
            let allowed = satellite.allowed();
            assert!(error < allowed, "seed {seed}, {topology}, {formulation}: {error:e}");
        }
    }
}

/// The satellite on a rig that is fixed, or that turns and slides along an axis ever faster.
fn on_a_rig(moment: Moment, seed: u64) -> Moment {
    let dice = &mut Rng::new(seed ^ 0x0419);
    let mut scene = (*moment.scene).clone();
    let axis = dice.direction();
    let attitude = scene.initial.attitude.normalized().to_matrix();
    scene.gravity = Some(Gravity { acceleration: 3.0, up: attitude * axis });
    scene.base = match seed % 2 {
        0 => Base::Fixed,
        _ => {
            let [alpha, a] = [dice.between(-2.0, 2.0), dice.between(-5.0, 5.0)];
            let point = |time: f64| DrivePoint { time, rate: 0.4 + alpha * time, speed: a * time };
            Base::Driven(Drive { axis, points: vec![point(0.0), point(1.0)] })
        }
    };
    scene.begin_driven([false; 2]);
    let omega = scene.initial.omega_body;
    let scene = Scene::new(scene).expect("what was physical on a rig");
    let mode = Mode { drive: 1, ..moment.mode };
    Moment { scene, mode, omega, ..moment }
}

#[test]
fn all_give_the_accelerations_of_satellites_on_rigs() {
    for seed in 0..RANDOM_SATELLITES {
        let satellite = Satellite::of_moment(&on_a_rig(random(seed), seed));
        assert!(satellite.accelerations.origin_body != Vec3::zero());
        assert_same_accelerations(&satellite, &format!("seed {seed}"));
    }
}

#[test]
fn the_reports_equations_hold_wherever_the_satellite_is() {
    for seed in 0..RANDOM_SATELLITES {
        let satellite = Satellite::of_moment(&random(seed));
        let recognised = satellite.recognised();
        let coordinates = satellite.coordinates_of(&recognised);
        let expected = satellite.expected(&recognised.links);
        let dice = &mut Rng::new(seed);
        let place = OriginMotion { rho: dice.vector(10.0), v: dice.vector(10.0) };
        let Recognised { topology, parameters, .. } = &recognised;
        for (name, found) in [
            ("report", report::solve_at(topology, parameters, &coordinates, &place)),
            ("relative", relative::solve_at(topology, parameters, &coordinates, &place)),
        ] {
            let error = relative_error(&flat(&found), &expected, 0.0);
            // A few digits go: the satellites measure about 1, and ρ̄ is ten times as long.
            let allowed = 30.0 * satellite.allowed();
            assert!(error < allowed, "seed {seed}, {topology}, {name}: {error:e}");
        }
    }
}

/// Largest difference, each entry relative to what its row and column bear.
fn matrix_error(found: &DMatrix<f64>, expected: &DMatrix<f64>) -> f64 {
    let scale = |i: usize, j: usize| (expected[(i, i)] * expected[(j, j)]).sqrt();
    let n = expected.nrows();
    let error = |i: usize, j: usize| (found[(i, j)] - expected[(i, j)]).abs() / scale(i, j);
    (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).map(|(i, j)| error(i, j)).fold(0.0, f64::max)
}

fn square(entries: &[f64]) -> DMatrix<f64> {
    let size = entries.len().isqrt();
    DMatrix::from_row_slice(size, size, entries)
}

/// B₀ and u₀.
fn equations(
    topology: &Topology,
    parameters: &Parameters<f64>,
    coordinates: &Coordinates<f64>,
) -> Equations<f64> {
    let found = Formulation::Symmetric.equations(topology, parameters, coordinates);
    found.expect("it solves a system")
}

pub fn assert_same_equations(satellite: &Satellite, label: &str) {
    let recognised = satellite.recognised();
    let Recognised { topology, parameters, .. } = &recognised;
    let coordinates = satellite.coordinates_of(&recognised);
    let expected = satellite.mass_matrix_of(&recognised);
    let Equations { matrix, forcing } = equations(topology, parameters, &coordinates);
    let found = square(&matrix);
    assert_eq!(found, found.transpose());
    let error = matrix_error(&found, &expected);
    assert!(error < ROUNDING, "{label}, {topology}: {error:e}");

    let error = relative_error(&forcing, &satellite.forcing_of(&recognised), 1.0);
    assert!(error < 10.0 * ROUNDING, "{label}, {topology}: {error:e}");
}

#[test]
fn symmetric_has_the_matrix_and_right_side_of_the_recursive_path() {
    for (id, case) in cases().iter().enumerate() {
        assert_same_equations(&Satellite::of_case(case), &format!("case {id}"));
    }
    for seed in 0..RANDOM_SATELLITES {
        assert_same_equations(&Satellite::of_moment(&random(seed)), &format!("seed {seed}"));
    }
}

#[test]
fn symmetric_has_the_mass_matrix_of_the_reference_states() {
    for (id, case) in cases().into_iter().enumerate() {
        let mode = Mode { hinges: vec![HingeState::Free; case.beta.len()], ..case.mode.clone() };
        let case = Case { mode, ..case };
        let satellite = Satellite::of_case(&case);
        let recognised = satellite.recognised();
        let Recognised { topology, parameters, links, .. } = &recognised;
        let coordinates = satellite.coordinates_of(&recognised);
        let found = square(&equations(topology, parameters, &coordinates).matrix);
        let expected = square(&numbers(&case.expected["mass_matrix"]));
        let order: Vec<usize> = (0..6).chain(links.iter().map(|&j| 6 + j)).collect();
        let error = matrix_error(&found, &expected.select_rows(&order).select_columns(&order));
        assert!(error < ROUNDING, "case {id}: {error:e}");
        let of_tree = symmetric::tree_mass_matrix(&satellite.tree, &satellite.coordinates);
        let error = matrix_error(&square(&of_tree), &expected);
        assert!(error < ROUNDING, "case {id}, as a tree: {error:e}");
    }
}

#[test]
fn a_b_and_the_symmetric_matrix_are_columns_of_each_other() {
    for seed in 0..RANDOM_SATELLITES {
        let satellite = Satellite::of_moment(&random(seed));
        let recognised = satellite.recognised();
        let Recognised { topology, parameters, .. } = &recognised;
        let coordinates = satellite.coordinates_of(&recognised);
        let dice = &mut Rng::new(seed);
        let place = OriginMotion { rho: dice.vector(2.0), v: dice.vector(2.0) };
        let a = report::equations_at(topology, parameters, &coordinates, &place);
        let b = relative::equations_at(topology, parameters, &coordinates, &place);
        assert_eq!(a.forcing, b.forcing);
        let size = a.forcing.len();
        // σ = a τ, and a_O = v̇ − J(ρ̄) ω̇ + …
        let mut sigma_of_tau = DMatrix::identity(size, size);
        let mut first = 6;
        for shape in topology.shapes() {
            for j in first..first + shape.hinges() {
                for i in j..first + shape.hinges() {
                    sigma_of_tau[(i, j)] = match shape {
                        Shape::Chain(_) => 1.0,
                        Shape::Paddle | Shape::Limb(_) => sigma_of_tau[(i, j)],
                    };
                }
            }
            first += shape.hinges();
        }
        let b_matrix = square(&b.matrix);
        let summed = square(&a.matrix) * sigma_of_tau;
        let error = (&summed - &b_matrix).amax() / b_matrix.amax();
        assert!(error < ROUNDING, "seed {seed}, A a = B: {error:e}");

        let mut to_components = DMatrix::identity(size, size);
        let rho = place.rho;
        for (i, j, entry) in [(0, 1, -rho.z), (0, 2, rho.y), (1, 2, -rho.x)] {
            to_components[(i, 3 + j)] = entry;
            to_components[(j, 3 + i)] = -entry;
        }
        let kinetic = &b_matrix * to_components;
        let expected = square(&equations(topology, parameters, &coordinates).matrix);
        let error = (&kinetic - &expected).amax() / b_matrix.amax();
        assert!(error < ROUNDING, "seed {seed}, B C = B₀: {error:e}");

        let at_origin =
            relative::equations_at(topology, parameters, &coordinates, &OriginMotion::origin());
        let forcing = equations(topology, parameters, &coordinates).forcing;
        let error = relative_error(&at_origin.forcing, &forcing, 1.0);
        assert!(error < 10.0 * ROUNDING, "seed {seed}, u₀: {error:e}");
    }
}

fn assert_tree_agrees(satellite: &Satellite, label: &str) {
    let Satellite { tree, coordinates, .. } = satellite;
    let found = symmetric::solve_tree(tree, coordinates);
    let links: Vec<usize> = (0..tree.links.len()).collect();
    let error = relative_error(&flat(&found), &satellite.expected(&links), 0.0);
    assert!(error < satellite.allowed(), "{label}: {error:e}");
    let matrix = square(&symmetric::tree_mass_matrix(tree, coordinates));
    let error = matrix_error(&matrix, &satellite.mass_matrix);
    assert!(error < ROUNDING, "{label}: {error:e}");
    let forcing = symmetric::tree_forcing(tree, coordinates);
    let error = relative_error(&forcing, &satellite.forcing, 1.0);
    assert!(error < 10.0 * ROUNDING, "{label}: {error:e}");
}

#[test]
fn the_tree_form_covers_chains_paddles_and_whatever_branches() {
    let mut refused = 0;
    for seed in 0..RANDOM_SATELLITES {
        assert_tree_agrees(&Satellite::of_moment(&random(seed)), &format!("seed {seed}"));
        let bodies = 1 + (seed % 12) as usize;
        let tree = Satellite::of_moment(&moment(bodies, seed, 0.25));
        assert_tree_agrees(&tree, &format!("tree of {bodies}, seed {seed}"));
        for formulation in Formulation::ALL {
            let covered = formulation.covers(&tree.tree);
            let recognised = nboom::formulation::recognise(&tree.tree);
            let has_limbs = recognised.is_ok_and(|found| found.topology.has_limbs());
            let takes_limbs = [Formulation::Symmetric, Formulation::Articulated];
            assert_eq!(covered.is_ok(), !has_limbs || takes_limbs.contains(&formulation));
        }
        refused += usize::from(Formulation::Report.covers(&tree.tree).is_err());
    }
    assert!(refused > 500, "{refused}");
}

/// A satellite in motion with its momenta.
struct Moving {
    recognised: Recognised,
    coordinates: Coordinates<f64>,
    beta: Vec<f64>,
    velocities: Velocities<f64>,
    momenta: Momenta<f64>,
}

impl Moving {
    fn new(satellite: &Satellite, velocity: Vec3<f64>) -> Self {
        let recognised = satellite.recognised();
        let coordinates = satellite.coordinates_of(&recognised);
        let beta: Vec<f64> = coordinates.hinges.iter().map(|hinge| hinge.beta).collect();
        let velocities = Velocities {
            main: Twist { angular: coordinates.omega, linear: velocity },
            tau: coordinates.hinges.iter().map(|hinge| hinge.tau).collect(),
        };
        let Recognised { topology, parameters, .. } = &recognised;
        let momenta = momentum::momenta(topology, parameters, &beta, &velocities);
        Self { recognised, coordinates, beta, velocities, momenta }
    }
}

/// Linear, angular, and those of the hinges.
fn of_momenta(momenta: &Momenta<f64>) -> Vec<f64> {
    let Wrench { moment, force } = momenta.main;
    let mut all = [force.to_array(), moment.to_array()].concat();
    all.extend(&momenta.hinges);
    all
}

fn of_velocities(velocities: &Velocities<f64>) -> Vec<f64> {
    let Twist { angular, linear } = velocities.main;
    flat(&Solution { main: Twist { angular, linear }, tau_dot: velocities.tau.clone() })
}

#[test]
fn momenta_are_the_mass_matrix_times_the_velocities_and_back() {
    for seed in 0..RANDOM_SATELLITES {
        let moment = random(seed);
        let satellite = Satellite::of_moment(&moment);
        let moving = Moving::new(&satellite, moment.velocity_body);
        let matrix = satellite.mass_matrix_of(&moving.recognised);
        let velocities = of_velocities(&moving.velocities);
        let expected = &matrix * DVector::from_vec(velocities.clone());
        let error = relative_error(&of_momenta(&moving.momenta), expected.as_slice(), 1.0);
        assert!(error < ROUNDING, "seed {seed}: {error:e}");
        let Recognised { topology, parameters, .. } = &moving.recognised;
        let back = momentum::velocities(topology, parameters, &moving.beta, &moving.momenta);
        let error = relative_error(&of_velocities(&back), &velocities, 0.0);
        assert!(error < satellite.allowed(), "seed {seed}: {error:e}");
    }
}

/// The derivative of (Π, P, π) along the motion that `articulated` gives.
fn momenta_along_the_motion(moving: &Moving) -> Momenta<f64> {
    let Recognised { topology, parameters, .. } = &moving.recognised;
    let found = Formulation::Articulated.solve(topology, parameters, &moving.coordinates);
    let dual = |value: f64, derivative: f64| Dual { value, derivative };
    let vector =
        |v: Vec3<f64>, d: Vec3<f64>| Vec3::new(dual(v.x, d.x), dual(v.y, d.y), dual(v.z, d.z));
    let Twist { angular: omega, linear: velocity } = moving.velocities.main;
    // V̇ is the rate of components: a_O less ω × V.
    let v_dot = found.main.linear - omega.cross(velocity);
    let tau = &moving.velocities.tau;
    let velocities = Velocities {
        main: Twist { angular: vector(omega, found.main.angular), linear: vector(velocity, v_dot) },
        tau: tau.iter().zip(&found.tau_dot).map(|(&tau, &rate)| dual(tau, rate)).collect(),
    };
    let beta: Vec<_> = moving.beta.iter().zip(tau).map(|(&beta, &tau)| dual(beta, tau)).collect();
    let constants = parameters.write().into_iter().map(Dual::constant);
    let parameters = Parameters::read(topology, constants);
    let momenta = momentum::momenta(topology, &parameters, &beta, &velocities);
    let derivative = |v: Vec3<Dual<f64>>| Vec3::new(v.x.derivative, v.y.derivative, v.z.derivative);
    let Wrench { moment, force } = momenta.main;
    Momenta {
        main: Wrench { moment: derivative(moment), force: derivative(force) },
        hinges: momenta.hinges.iter().map(|pi| pi.derivative).collect(),
    }
}

#[test]
fn rates_of_the_momenta_are_their_derivatives_along_the_motion() {
    for seed in 0..RANDOM_SATELLITES {
        let moment = random(seed);
        let satellite = Satellite::of_moment(&moment);
        let moving = Moving::new(&satellite, moment.velocity_body);
        let Recognised { topology, parameters, .. } = &moving.recognised;
        let torques: Vec<f64> = moving.coordinates.hinges.iter().map(|h| h.torque).collect();
        let rates = momentum::rates(
            topology,
            parameters,
            &moving.beta,
            (&moving.momenta, &moving.velocities),
            moving.coordinates.external,
            &torques,
        );
        let expected = of_momenta(&momenta_along_the_motion(&moving));
        let error = relative_error(&of_momenta(&rates), &expected, 1.0);
        // Terms of the derivative are as large as B₀ times accelerations and cancel in part.
        assert!(error < satellite.allowed(), "seed {seed}: {error:e}");
    }
}

#[test]
fn formulations_are_found_by_name() {
    for formulation in Formulation::ALL {
        assert_eq!(Formulation::named(formulation.name()), Some(formulation));
        assert!(!formulation.about().is_empty());
    }
    assert_eq!(Formulation::named("recursive"), None);
}
