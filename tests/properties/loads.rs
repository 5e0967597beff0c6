//! Loads of hinges and stations of random trees: balances of linear and angular momentum, the
//! torques about free hinges, and the same satellite cut in two at a station.

use nalgebra::Vector3;
use nboom::elements::KickOffLaw;
use nboom::loads::{LoadEquations, LoadSet, Loads, SceneMotion, VelocityChange};
use nboom::model::{
    Body, Course, External, ExternalAxes, Hinge, Joint, Material, Mount, Scene, SceneDescription,
    SectionShape, SegmentStructure, Station, Structure,
};
use nboom::scalar::{RigidInertia, Twist, Vec3, Wrench};
use nboom::sections::Section;
use nboom_codegen::{Level, StressRequest};

use crate::Prepared;
use crate::newton_euler::{Placed, accelerations, loads, place, vector};
use crate::random_scene::{Moment, Rng, moment};

type V3 = Vector3<f64>;

/// A random tree with random slices, in a random mode and state.
pub struct Sliced {
    pub moment: Moment,
    pub structure: Structure,
    /// Accelerations of O and the main body, and of every hinge.
    origin: Vec3<f64>,
    omega_dot: Vec3<f64>,
    pub tau_dot: Vec<f64>,
    /// Force of every kick-off spring that pushes, over its length.
    force_densities: Vec<f64>,
    /// What acts on hinged bodies from outside.
    outside: Vec<[f64; 3]>,
}

fn stations(dice: &mut Rng) -> Vec<Station> {
    let count = dice.below(4);
    let mut distances: Vec<f64> = (0..count).map(|_| dice.between(0.0, 1.2)).collect();
    distances.sort_by(|a, b| b.total_cmp(a));
    distances.push(0.0);
    let station = |distance_from_hinge| Station {
        distance_from_hinge,
        slice: dice.mass_properties(1.5, 0.8),
        section: SectionShape::Tube { radius: 0.1, thickness: 0.01 },
    };
    distances.into_iter().map(station).collect()
}

impl Sliced {
    fn new(bodies: usize, seed: u64) -> Self {
        let mut moment = moment(bodies, seed, 0.4);
        let dice = &mut Rng::new(seed ^ 0x10ad);
        let segment = |_| SegmentStructure {
            pulse_constant: dice.between(0.01, 1.0),
            material: Material::elastic(7e10, 0.3),
            stations: stations(dice),
        };
        let segments: Vec<_> = (0..bodies).map(segment).collect();
        let mut description = (*moment.scene).clone();
        for (body, segment) in description.bodies.iter_mut().zip(&segments) {
            body.mass_properties = segment.mass_properties().expect("there is a station");
        }
        moment.scene = Scene::new(description).expect("random slices are physical");
        let structure = Structure::new(&moment.scene, segments).expect("slices make the segment");
        let mut prepared = Prepared::new(&moment);
        let found = prepared.accelerations(&moment);
        let part = |at: usize| Vec3::new(found[at], found[at + 1], found[at + 2]);
        let tau_dot = of_all(prepared.dynamics.free_hinges(), &found.as_slice()[6..], bodies);
        let force_densities = force_densities(&moment);
        let outside = outside(&moment.scene);
        let (origin, omega_dot) = (part(0), part(3));
        Self { structure, origin, omega_dot, tau_dot, force_densities, outside, moment }
    }

    /// Random trees of one to eight hinged bodies.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..96).map(|seed| Self::new(1 + (seed % 8) as usize, seed))
    }

    fn motion(&self) -> SceneMotion<'_> {
        let Moment { omega: omega_body, beta, tau, .. } = &self.moment;
        let Self { origin: origin_body, omega_dot, force_densities, outside, .. } = self;
        let (origin_body, tau_dot) = (*origin_body, &self.tau_dot);
        let acceleration = VelocityChange { origin_body, omega_body: *omega_dot, tau: tau_dot };
        let (omega_body, rotors) = (*omega_body, &[]);
        SceneMotion { omega_body, beta, tau, acceleration, force_densities, outside, rotors }
    }

    fn continuous(&self) -> (Loads, LoadSet) {
        let mut loads = Loads::new(&self.moment.scene, Some(&self.structure));
        let mut found = loads.load_set();
        loads.continuous(&self.motion(), &mut found);
        (loads, found)
    }

    pub fn placed(&self) -> Vec<Placed> {
        placed(&self.moment)
    }
}

fn placed(moment: &Moment) -> Vec<Placed> {
    let Moment { scene, beta, tau, omega, velocity_body, .. } = moment;
    place(scene, beta, tau, vector(*omega), vector(*velocity_body))
}

fn force_densities(moment: &Moment) -> Vec<f64> {
    let density = |(i, placed): (usize, Placed)| {
        // In a moment all springs push.
        let spring = moment.scene.bodies[i].hinge.kick_off;
        spring.map_or(0.0, |spring| {
            let end = placed.origin + placed.rot * vector(spring.body_point);
            let length = (end - vector(spring.main_body_point)).norm();
            KickOffLaw::new(spring.coefficients).force(length) / length
        })
    };
    placed(moment).into_iter().skip(1).enumerate().map(density).collect()
}

/// Forces and torques on hinged bodies at the initial time and attitude, along body or main-body axes.
fn outside(scene: &Scene) -> Vec<[f64; 3]> {
    let attitude = scene.initial.attitude.to_matrix();
    let acting = |external: &External| {
        let share = match &external.course {
            Course::Pulse { .. } => 1.0,
            Course::Table(points) => {
                let ([t0, s0], [t1, s1]) = (points[0], points[1]);
                s0 - (s1 - s0) * t0 / (t1 - t0)
            }
        };
        let amount = match external.axes {
            ExternalAxes::Body => external.amount,
            ExternalAxes::Inertial => attitude.transpose_mul(external.amount),
        };
        (amount * share).to_array()
    };
    scene.externals.iter().filter(|external| external.body.is_some()).map(acting).collect()
}

/// Values of the free hinges among those of all, zero for held ones.
pub fn of_all(free: &[usize], values: &[f64], count: usize) -> Vec<f64> {
    let mut all = vec![0.0; count];
    free.iter().zip(values).for_each(|(&i, &value)| all[i] = value);
    all
}

/// The load of a hinge on the inboard body, along main-body axes about O: force and moment.
fn about_origin(load: Wrench<f64>, outboard: &Placed) -> (V3, V3) {
    let force = outboard.rot * vector(load.force);
    (force, outboard.rot * vector(load.moment) + outboard.origin.cross(&force))
}

/// The sum of the loads of all hinges on the main body, with the sum of their magnitudes.
pub fn on_main_body(scene: &Scene, placed: &[Placed], found: &LoadSet) -> [(V3, f64); 2] {
    let mut sums = [(V3::zeros(), 0.0); 2];
    for (i, _) in scene.bodies.iter().enumerate().filter(|(_, body)| body.inboard.is_none()) {
        let (force, moment) = about_origin(found.hinge(i), &placed[i + 1]);
        for ((sum, size), part) in sums.iter_mut().zip([force, moment]) {
            *sum -= part;
            *size += part.norm();
        }
    }
    sums
}

pub fn main_body(scene: &Scene) -> RigidInertia<f64> {
    let main = &scene.main_body;
    RigidInertia::new(main.mass, main.center_of_mass, main.inertia)
}

#[test]
fn hinge_loads_and_external_forces_move_the_main_body() {
    for case in Sliced::all() {
        let Moment { scene, mode, beta, tau, omega, .. } = &case.moment;
        let placed = case.placed();
        let (_, found) = case.continuous();
        let acceleration = Twist { angular: case.omega_dot, linear: case.origin };
        let rates = main_body(scene).inertia_wrench(*omega, acceleration);
        let [(mut force, force_size), (mut moment, moment_size)] =
            on_main_body(scene, &placed, &found);
        // Without the torques about hinges, which the loads contain.
        let free_of_torques = loads(scene, mode, &placed, beta, tau);
        let (acting, about_center) = free_of_torques.forces[0];
        let torques = scene.bodies.iter().enumerate().filter(|(_, body)| body.inboard.is_none());
        let at_joints =
            torques.map(|(i, _)| at_joint(scene, &placed[i + 1], i, free_of_torques.torques[i]));
        for (of_joint, torque) in at_joints {
            force += of_joint;
            moment += torque;
        }
        force += acting;
        moment += about_center + placed[0].center.cross(&acting);
        let sizes = [rates.force.norm() + force_size, rates.moment.norm() + moment_size];
        let residuals = [force - vector(rates.force), moment - vector(rates.moment)];
        for (residual, size) in residuals.iter().zip(sizes) {
            // The accelerations solve this equation to rounding times the tree's condition.
            assert!(residual.norm() < 1e-11 * size, "{residual} of {size}");
        }
    }
}

#[test]
fn hinge_loads_are_the_rates_of_momentum_of_all_that_is_outboard() {
    for mut case in Sliced::all() {
        let placed = case.placed();
        let Moment { scene, mode, beta, tau, .. } = &case.moment;
        let acting = loads(scene, mode, &placed, beta, tau);
        let solved = accelerations(scene, mode, &placed, tau, &acting);
        let body = |v: V3| Vec3::new(v.x, v.y, v.z);
        (case.origin, case.omega_dot) = (body(solved.origin), body(solved.omega_dots[0]));
        case.tau_dot = solved.tau_dots;
        let scene = &case.moment.scene;
        let (_, found) = case.continuous();
        let expected: Vec<(V3, V3)> = (0..scene.bodies.len())
            .map(|i| {
                let own = &placed[i + 1];
                let (force, about_o) = at_joint(scene, own, i, acting.torques[i]);
                let mut sum = (force, about_o - own.origin.cross(&force));
                for b in outboard_of(&scene.bodies, i).map(|j| j + 1) {
                    let (own, (force, moment)) = (&placed[b], acting.forces[b]);
                    let rate = solved.centers[b] * own.mass - force;
                    let spin = own.inertia * solved.omega_dots[b]
                        + own.omega.cross(&(own.inertia * own.omega));
                    sum.0 += rate;
                    sum.1 += spin - moment + (own.center - placed[i + 1].origin).cross(&rate);
                }
                let to_body = placed[i + 1].rot.transpose();
                (to_body * sum.0, to_body * sum.1)
            })
            .collect();
        let largest = |part: fn(&(V3, V3)) -> f64| expected.iter().map(part).fold(0.0, f64::max);
        let (force_size, moment_size) = (largest(|e| e.0.norm()), largest(|e| e.1.norm()));
        for (i, (force, moment)) in expected.iter().enumerate() {
            let load = found.hinge(i);
            // The dense solution keeps hinges together to rounding times its condition.
            assert!((vector(load.force) - force).norm() < 1e-11 * force_size, "hinge {i}");
            assert!((vector(load.moment) - moment).norm() < 1e-11 * moment_size, "hinge {i}");
        }
    }
}

/// What acts at the joint of body `i` on it: force, and moment about O.
fn at_joint(scene: &SceneDescription, placed: &Placed, i: usize, acts: f64) -> (V3, V3) {
    let along = placed.axis * acts;
    match scene.bodies[i].joint {
        Joint::Revolute => (V3::zeros(), along),
        Joint::Prismatic => (along, placed.origin.cross(&along)),
    }
}

/// The body and all that hangs on it.
fn outboard_of(bodies: &[Body], i: usize) -> impl Iterator<Item = usize> {
    let hangs_on = move |j: &usize| {
        let inward = std::iter::successors(Some(*j), |&j| bodies[j].inboard);
        inward.into_iter().any(|j| j == i)
    };
    (i..bodies.len()).filter(hangs_on)
}

#[test]
fn moments_about_free_hinges_are_those_of_springs_and_dashpots() {
    let mut seen = 0;
    for case in Sliced::all() {
        let Moment { scene, mode, beta, tau, .. } = &case.moment;
        let (finder, found) = case.continuous();
        let mut torques = loads(scene, mode, &case.placed(), beta, tau).torques;
        let Some((_, residual)) = finder.largest_torque_residual(&found, &mode.hinges, &torques)
        else {
            continue;
        };
        assert!(residual < 1e-11, "{residual}");
        // A wrong torque shows by its share of the load.
        let free = (0..torques.len()).find(|&i| mode.is_free(i)).expect("one is free");
        torques[free] += 1e-3;
        let (hinge, residual) =
            finder.largest_torque_residual(&found, &mode.hinges, &torques).expect("one is free");
        assert!(hinge == free && residual > 1e-8, "{residual} at {hinge}, {free} is wrong");
        seen += 1;
    }
    assert!(seen > 50, "{seen} cases with a free hinge");
}

#[test]
fn a_station_carries_what_a_held_hinge_in_its_place_would() {
    let mut seen = 0;
    for case in Sliced::all() {
        let (_, found) = case.continuous();
        for (i, segment) in case.structure.segments().iter().enumerate() {
            let (hinge, stations) = (found.hinge(i), found.stations(i));
            let size = (1.0 + hinge.force.norm(), 1.0 + hinge.moment.norm() + hinge.force.norm());
            for (j, load) in stations.iter().enumerate() {
                let whole = j + 1 == stations.len();
                let expected = if whole { hinge } else { load_of_cut(&case, i, segment, j) };
                // The cut tree adds the same terms in another order.
                let error = (load.force - expected.force).norm() / size.0;
                assert!(error < 1e-13, "force at {i}, {j}: {error}");
                let error = (load.moment - expected.moment).norm() / size.1;
                assert!(error < 1e-13, "moment at {i}, {j}: {error}");
                seen += usize::from(!whole);
            }
        }
    }
    assert!(seen > 300, "{seen} stations");
}

#[test]
fn recorded_loads_are_those_of_the_equations() {
    for case in Sliced::all() {
        let sections = case.structure.segments().iter().flat_map(|segment| &segment.stations);
        let influences = sections
            .map(|station| Section::of_shape(&station.section).expect("a tube").influence());
        let equations = LoadEquations::new(&case.moment.scene, Some(&case.structure));
        let mut equations = equations.with_sections(influences);
        let mut expected = equations.load_set();
        equations.evaluate(&case.motion(), &mut expected);
        let (name, scalar_path) = ("Stresses".to_owned(), "::nboom_scalar".to_owned());
        let numbers = equations.numbers().len();
        let mut inputs = vec![f64::NAN; numbers + equations.motion_size().count()];
        let request = StressRequest { name, scalar_path, equations, level: Level::Exact };
        case.motion().write(&mut inputs[numbers..]);
        assert_eq!(request.trace().evaluate(&inputs), expected.numbers());
    }
}

/// The load of a held hinge that joins the two parts of segment `i` at station `j`.
fn load_of_cut(case: &Sliced, i: usize, segment: &SegmentStructure, j: usize) -> Wrench<f64> {
    let cut = segment.stations[j].point();
    let joined = |stations: &[Station]| {
        let slices = stations.iter().map(|station| station.slice);
        slices.reduce(|a, b| a.joined_with(&b)).expect("there is a station")
    };
    let mut scene: SceneDescription = (*case.moment.scene).clone();
    let (mut outer_mass, inner_mass) =
        (joined(&segment.stations[..=j]), joined(&segment.stations[j + 1..]));
    outer_mass.center_of_mass -= cut;
    scene.bodies[i].mass_properties = inner_mass;
    let is_outboard = |point: Vec3<f64>| point.y >= cut.y;
    for body in &mut scene.bodies[i + 1..] {
        body.inboard = body.inboard.map(|inboard| match inboard {
            _ if inboard > i => inboard + 1,
            _ if inboard == i && is_outboard(body.mount.point) => {
                body.mount.point -= cut;
                i + 1
            }
            _ => inboard,
        });
    }
    let kick_off = scene.bodies[i].hinge.kick_off.filter(|spring| is_outboard(spring.body_point));
    let mut hinge = Hinge { kick_off, ..Hinge::free() };
    if let Some(spring) = &mut hinge.kick_off {
        spring.body_point -= cut;
        scene.bodies[i].hinge.kick_off = None;
    }
    for external in &mut scene.externals {
        external.body = external.body.map(|body| match body {
            _ if body > i => body + 1,
            _ if body == i && is_outboard(external.point) => {
                external.point -= cut;
                i + 1
            }
            _ => body,
        });
    }
    let outer = Body {
        inboard: Some(i),
        mount: Mount::at(cut),
        joint: Joint::Revolute,
        axis: Vec3::unit_x(),
        mass_properties: outer_mass,
        tip: Vec3::zero(),
        hinge,
    };
    scene.bodies.insert(i + 1, outer);
    let with_zero = |values: &[f64]| {
        let mut values = values.to_vec();
        values.insert(i + 1, 0.0);
        values
    };
    let motion = case.motion();
    let (beta, tau) = (with_zero(motion.beta), with_zero(motion.tau));
    let tau_dot = with_zero(motion.acceleration.tau);
    let mut force_densities = with_zero(motion.force_densities);
    if hinge.kick_off.is_some() {
        force_densities.swap(i, i + 1);
    }
    let acceleration = VelocityChange { tau: &tau_dot, ..motion.acceleration };
    let motion = SceneMotion {
        beta: &beta,
        tau: &tau,
        force_densities: &force_densities,
        acceleration,
        ..motion
    };
    let scene = Scene::new(scene).expect("parts of bodies are bodies");
    let mut loads = Loads::new(&scene, None);
    let mut found = loads.load_set();
    loads.continuous(&motion, &mut found);
    found.hinge(i + 1)
}
