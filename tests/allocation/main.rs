//! Evaluations and steps allocate nothing: a global allocator counts what each thread asks for.
//!
//! Setting a mode and starting an integration may allocate; everything between may not.

#[path = "../support/random_scene.rs"]
mod random_scene;

mod counting;
mod runs;

use counting::allocations;
use nboom::dynamics::{Accelerations, Momenta, Motion, Recursive};
use nboom::formulation::Layout;
use nboom::loads::{Loads, LockUpShare, SceneMotion, VelocityChange};
use nboom::model::{
    HingeState, Material, Mode, Scene, SectionShape, SegmentStructure, Station, Structure,
};
use nboom::ode::{Method, System, Tolerance};
use nboom::scalar::{Derivatives, Real, Vec3};
use nboom_expr::{Expr, Graph};
use nboom_series::Series;

/// A branching tree with every kind of force, and the mode in which all of them act.
fn scene_and_mode() -> (Scene, Mode) {
    let scene = (0..)
        .map(|seed| random_scene::description(9, seed))
        .find(|scene| {
            !scene.externals.is_empty()
                && scene.bodies.iter().any(|body| body.hinge.kick_off.is_some())
        })
        .expect("one in a few has both");
    let scene = Scene::new(scene).expect("a physical scene");
    let mut hinges = vec![HingeState::Free; 9];
    hinges[4] = HingeState::Locked;
    let mode = random_scene::all_acting(&scene, hinges);
    (scene, mode)
}

#[test]
fn the_counter_counts() {
    let mut kept = Vec::new();
    assert_eq!(allocations(|| kept.push(1)), 1);
    assert_eq!(allocations(|| kept.reserve_exact(1000)), 1);
    assert_eq!(allocations(|| kept[0] = 2), 0);
}

#[test]
fn evaluations_allocate_nothing() {
    let (scene, mode) = scene_and_mode();
    let beta: Vec<f64> = scene.bodies.iter().map(|body| body.hinge.start.angle).collect();
    let mut dynamics = Recursive::new(&scene);
    dynamics.set_mode(&mode, &beta);
    let free = dynamics.free_hinges().len();
    let (beta, tau) = (vec![0.3; free], vec![-0.7; free]);
    let motion = Motion { omega_body: Vec3::new(0.4, -1.0, 0.2), beta: &beta, tau: &tau };
    let mut found = Accelerations::for_hinges(free);
    let mut matrix = vec![0.0; (6 + free) * (6 + free)];
    let mut forcing = vec![0.0; 6 + free];
    let mut lengths = vec![0.0; dynamics.elements().lines().len()];
    // Not even the first evaluation in a mode does.
    assert_eq!(allocations(|| dynamics.accelerations(&motion, &mut found)), 0);
    assert_eq!(allocations(|| dynamics.mass_matrix(&beta, &mut matrix)), 0);
    assert_eq!(allocations(|| dynamics.forcing(&motion, &mut forcing)), 0);
    assert_eq!(
        allocations(|| {
            std::hint::black_box(dynamics.invariants(&motion, Vec3::unit_x()));
        }),
        0
    );
    assert_eq!(
        allocations(|| {
            std::hint::black_box(dynamics.line_length(0, |j| [motion.beta[j], motion.tau[j]]));
        }),
        0
    );
    let guarded = || dynamics.line_lengths_squared(&beta, &mut lengths);
    assert_eq!(allocations(guarded), 0);
    let (mut hinges, mut rates) = (tau.clone(), tau.clone());
    assert_eq!(
        allocations(|| {
            let angular_body = dynamics.momenta(&motion, &mut rates);
            let momenta = Momenta { angular_body, beta: &beta, hinges: &tau };
            dynamics.momentum_rates(&momenta, &mut hinges, &mut rates);
        }),
        0
    );
    assert!(found.tau_dot.iter().chain(&matrix).chain(&forcing).all(|x| x.is_finite()));
    assert!(lengths[0] > 0.0);
}

#[test]
fn derivatives_allocate_nothing() {
    let topology = "2xS3_P_Trr(p)(s)".parse().expect("a topology");
    let parameters: Vec<f64> =
        (0..Layout::parameters(&topology)).map(|i| 2.0 + (i as f64).sin()).collect();
    let mut derivatives = Derivatives::of(&Layout::tree(&topology), &parameters);
    let state = vec![0.3; Layout::coordinates(&topology)];
    let accelerations = vec![-0.7; Layout::outputs(&topology)];
    let mut found = vec![0.0; accelerations.len() * state.len()];
    let write = || derivatives.write(&state, &accelerations, 0..state.len(), &mut found);
    assert_eq!(allocations(write), 0);
}

/// A station at each hinge.
fn structure(scene: &Scene) -> Structure {
    let segment = |body: &nboom::model::Body| SegmentStructure {
        pulse_constant: 0.1,
        material: Material::elastic(7e10, 0.3),
        stations: vec![Station {
            distance_from_hinge: 0.0,
            slice: body.mass_properties,
            section: SectionShape::Tube { radius: 0.1, thickness: 0.01 },
        }],
    };
    let segments = scene.bodies.iter().map(segment).collect();
    Structure::new(scene, segments).expect("each slice is its segment")
}

#[test]
fn loads_allocate_nothing() {
    let (scene, mode) = scene_and_mode();
    let structure = structure(&scene);
    let mut loads = Loads::new(&scene, Some(&structure));
    let mut found = loads.load_set();
    let values = vec![0.3; scene.bodies.len()];
    let (origin_body, omega_body) = (Vec3::unit_x(), Vec3::unit_y());
    let change = VelocityChange { origin_body, omega_body, tau: &values };
    let motion = SceneMotion {
        omega_body,
        beta: &values,
        tau: &values,
        acceleration: change,
        force_densities: &values,
        outside: &[],
        rotors: &[],
    };
    let share = LockUpShare { pulse_constant: 0.1, jump: change };
    assert_eq!(allocations(|| loads.continuous(&motion, &mut found)), 0);
    assert_eq!(allocations(|| loads.add_lock_up(&values, &[share], 1.5, &mut found)), 0);
    assert_eq!(
        allocations(|| {
            std::hint::black_box(loads.largest_torque_residual(&found, &mode.hinges, &values));
        }),
        0
    );
    assert!(found.hinge(0).force.norm() > 0.0);
}

/// The rotational motion of a scene: ω, then β, then τ.
struct Rotation<R> {
    dynamics: Recursive<R>,
    found: Accelerations<R>,
    free: usize,
}

impl<R: Real> Rotation<R> {
    fn new(scene: &Scene, mode: &Mode) -> Self {
        let angle = |body: &nboom::model::Body| R::constant(body.hinge.start.angle);
        let beta: Vec<R> = scene.bodies.iter().map(angle).collect();
        let mut dynamics = Recursive::new(scene);
        dynamics.set_mode(mode, &beta);
        let free = dynamics.free_hinges().len();
        Self { dynamics, found: Accelerations::for_hinges(free), free }
    }

    fn write(&mut self, y: &[R], dy: &mut [R]) {
        let (beta, tau) = y[3..].split_at(self.free);
        let motion = Motion { omega_body: Vec3::new(y[0], y[1], y[2]), beta, tau };
        self.dynamics.accelerations(&motion, &mut self.found);
        dy[..3].copy_from_slice(&self.found.omega_dot_body.to_array());
        dy[3..3 + self.free].copy_from_slice(tau);
        dy[3 + self.free..].copy_from_slice(&self.found.tau_dot);
    }
}

/// A rotation with its power series up to some order.
struct WithSeries {
    rotation: Rotation<f64>,
    series: Series<f64>,
}

impl WithSeries {
    fn new(scene: &Scene, mode: &Mode, order: usize) -> Self {
        let rotation = Rotation::new(scene, mode);
        let size = 3 + 2 * rotation.free;
        let graph = Graph::trace(size + 1, |inputs| {
            let mut rates = vec![Expr::zero(); size];
            Rotation::new(scene, mode).write(&inputs[..size], &mut rates);
            rates
        });
        Self { rotation, series: Series::new(&graph, &[], order) }
    }
}

impl System for WithSeries {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        self.rotation.write(y, dy);
    }

    fn series(&mut self, t: f64, y: &[f64], order: usize, out: &mut [f64]) -> bool {
        assert_eq!(order, self.series.order());
        self.series.write(t, y, out);
        true
    }
}

#[test]
fn steps_allocate_nothing() {
    Method::ALL.into_iter().for_each(steps_of_a_method_allocate_nothing);
}

fn steps_of_a_method_allocate_nothing(method: Method) {
    let (scene, mode) = scene_and_mode();
    let tolerance = Tolerance { relative: 1e-9, absolute: 1e-12 };
    let order = Method::Taylor.order(tolerance) as usize;
    let mut system = WithSeries::new(&scene, &mode, order);
    let mut stepper = method.stepper(tolerance);
    let y = vec![0.1; 3 + 2 * system.rotation.free];
    stepper.start(&mut system, 0.0, &y, y.len());
    let mut within = y.clone();
    let mut steps = 0;
    let count = allocations(|| {
        while stepper.window().time < 0.3 {
            stepper.step(&mut system, 0.3).expect("an ordinary motion");
            stepper.prepare_dense(&mut system);
            stepper.interpolate(0.4, &mut within);
            if steps == 1 {
                let shorter = 0.5 * stepper.window().length();
                stepper.retake(&mut system, shorter);
            }
            stepper.advance();
            stepper.scale(0..3, 1.0);
            steps += 1;
        }
    });
    assert!(steps >= 3, "{steps} steps");
    assert_eq!(count, 0, "{method}, in {steps} steps");
    let polynomial = allocations(|| {
        std::hint::black_box(stepper.polynomial(0));
    });
    assert_eq!(polynomial, 0);
}

/// Heat along a rod.
struct Rod;

impl System for Rod {
    fn derivative(&mut self, _t: f64, y: &[f64], dy: &mut [f64]) {
        let at = |i: usize| y.get(i).copied().unwrap_or(0.0);
        for (i, rate) in dy.iter_mut().enumerate() {
            *rate = 1e4 * (at(i.wrapping_sub(1)) - 2.0 * y[i] + at(i + 1));
        }
    }
}

#[test]
fn implicit_steps_of_many_variables_allocate_nothing() {
    // So many that a library for large matrices multiplies them block by block.
    let y = vec![1.0; 200];
    let mut stepper = Method::Radau5.stepper(Tolerance { relative: 1e-6, absolute: 1e-9 });
    stepper.start(&mut Rod, 0.0, &y, y.len());
    let count = allocations(|| {
        while stepper.window().time < 1.0 {
            stepper.step(&mut Rod, 1.0).expect("heat spreads");
            stepper.advance();
        }
    });
    assert!(stepper.window().counts.factorizations > 3);
    assert_eq!(count, 0);
}
