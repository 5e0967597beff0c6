//! The right side of a mode's differential equations, written as one function, against what a run
//! composes of force elements, recursion and attitude.

use std::collections::BTreeMap;

use nboom::dynamics::{Accelerations, Motion, Recursive};
use nboom::elements::CouplingLaw;
use nboom::formulation::{
    Embedding, Forces, Formulation, HingeCoordinates, LinkLine, NoPlace, Parameters, Recognised,
    RightSideLayout, right_side,
};
use nboom::model::{
    Coupling, KickOffSpring, Rotor, RotorSpeed, Scene, SceneDescription, Topology, TorqueTable,
};
use nboom::scalar::{Quaternion, Vec3};

use crate::limbs::tree;
use crate::random_scene::{Moment, Rng, all_acting, moment_of};
use crate::satellites::{Satellite, random};
use crate::support::relative_error;

const RANDOM_SATELLITES: u64 = 3000;

/// Rounding of torques, which are sums of some dozen products.
const ROUNDING: f64 = 1e-13;

/// A random satellite of chains and paddles with every kind of spring and dashpot, on some of whose
/// bodies kick-off springs push, and torque tables about some hinges, which are anywhere.
fn pushed(seed: u64) -> Moment {
    let (of_seed, dice) = (random(seed), &mut Rng::new(seed ^ 0x9a5));
    let mut description = (*of_seed.scene).clone();
    let share = dice.between(0.0, 0.6);
    for body in &mut description.bodies {
        if body.inboard.is_some() {
            // Hinges off the segment's axis, some of them along the hinge axis.
            body.mount.point += dice.vector(0.3);
        }
        body.hinge.spring.quadratic = dice.between(-1.0, 1.0);
        body.hinge.dashpot.rate_quadratic = dice.between(-0.3, 0.3);
        body.hinge.dashpot.angle_linear = dice.between(-1.0, 0.0);
        body.hinge.kick_off = dice.chance(share).then(|| KickOffSpring {
            main_body_point: dice.vector(1.0),
            body_point: dice.vector(1.0),
            coefficients: [dice.between(1.0, 5.0), dice.between(-1.0, 1.0), 0.2, -0.05],
            limit_length: dice.between(1.0, 5.0),
        });
    }
    for hinge in 0..description.bodies.len() {
        if dice.chance(0.2) {
            let points = [-1.5, 0.2, 0.4].map(|angle| [angle, dice.between(-3.0, 3.0)]).to_vec();
            description.torque_tables.push(TorqueTable { hinge, points });
        }
    }
    couple(&mut description, dice);
    if dice.chance(0.3) {
        description.rotors = wheels(dice);
    }
    let scene = Scene::new(description).expect("random bodies are physical");
    let mut mode = all_acting(&scene, of_seed.mode.hinges);
    mode.externals.clone_from(&of_seed.mode.externals);
    let lines = mode.pieces.len() - scene.torque_tables.len();
    for (i, piece) in mode.pieces.iter_mut().enumerate() {
        *piece = if i < lines { usize::from(dice.chance(0.3)) } else { dice.below(4) };
    }
    Moment { scene, mode, ..of_seed }
}

/// Couples some hinges with the one inboard of them, a few with any other.
fn couple(description: &mut SceneDescription, dice: &mut Rng) {
    if dice.chance(0.5) {
        return;
    }
    for hinge in 0..description.bodies.len() {
        let other = match description.bodies[hinge].inboard {
            Some(inboard) if dice.chance(0.95) => inboard,
            _ if dice.chance(0.1) => dice.below(description.bodies.len()),
            _ => continue,
        };
        if other != hinge && dice.chance(0.6) {
            description.couplings.push(Coupling {
                hinges: if dice.chance(0.5) { [hinge, other] } else { [other, hinge] },
                ratio: dice.between(-2.0, 2.0),
                stiffness: dice.between(0.5, 3.0),
                rest: dice.between(-1.0, 1.0),
                damping: if dice.chance(0.5) { dice.between(0.0, 1.0) } else { 0.0 },
                is_mutual: dice.chance(0.98),
            });
        }
    }
}

/// Rotors in the main body at constant speed, seldom one that changes it.
fn wheels(dice: &mut Rng) -> Vec<Rotor> {
    let mut wheel = |speed| Rotor {
        body: None,
        axis: dice.direction(),
        inertia: dice.between(0.01, 0.2),
        speed: RotorSpeed::Constant(speed),
    };
    let mut wheels = vec![wheel(25.0), wheel(-40.0)];
    if dice.chance(0.1) {
        wheels[0].speed = RotorSpeed::Table(vec![[-1.0, 3.0], [1.0, 9.0]]);
    }
    wheels
}

/// A tree with limbs, some of whose links lines push.
fn pushed_tree(seed: u64) -> Moment {
    let dice = &mut Rng::new(seed ^ 0x11fe);
    let mut description = (*tree(seed)).clone();
    couple(&mut description, dice);
    let tree = Scene::new(description).expect("random bodies are physical");
    let mut moment = moment_of(tree, seed, 0.2);
    for piece in &mut moment.mode.pieces {
        *piece = usize::from(dice.chance(0.3));
    }
    moment
}

fn is_there(coupling: &CouplingLaw<f64>) -> bool {
    coupling.numbers()[2] != 0.0
}

/// A satellite in a mode and a state, hinges in the order of its topology.
struct Pushed {
    satellite: Satellite,
    recognised: Recognised,
    dynamics: Recursive<f64>,
    forces: Result<Forces<f64>, NoPlace>,
    attitude: Quaternion<f64>,
}

impl Pushed {
    fn random(seed: u64) -> Self {
        let moment = if seed % 3 == 2 { pushed_tree(seed) } else { pushed(seed) };
        let satellite = Satellite::of_moment(&moment);
        let recognised = satellite.recognised();
        let mut dynamics = Recursive::new(&moment.scene);
        dynamics.set_mode(&moment.mode, &moment.beta);
        let forces = Forces::of(dynamics.elements(), dynamics.tree(), &recognised);
        let attitude = Rng::new(seed).attitude();
        // As integration leaves it, not quite of norm 1.
        let attitude = Quaternion { scalar: attitude.scalar * 1.01, ..attitude };
        Self { satellite, recognised, dynamics, forces, attitude }
    }

    fn of_hinges(&self) -> [Vec<f64>; 3] {
        let hinges = self.satellite.coordinates_of(&self.recognised).hinges;
        let all = |of: fn(&HingeCoordinates<f64>) -> f64| hinges.iter().map(of).collect();
        [all(|hinge| hinge.beta), all(|hinge| hinge.tau), all(|hinge| hinge.torque)]
    }

    fn variables(&self) -> Vec<f64> {
        let [beta, tau, _] = self.of_hinges();
        let mut y = vec![self.attitude.scalar];
        y.extend(self.attitude.vector.to_array());
        y.extend(self.satellite.coordinates.omega.to_array());
        y.extend(beta.into_iter().chain(tau));
        y
    }

    /// ẏ and the power, put together of force elements, recursion and attitude.
    fn composed(&mut self) -> Vec<f64> {
        let coordinates = &self.satellite.coordinates;
        let of_links = |of: fn(&HingeCoordinates<f64>) -> f64| -> Vec<f64> {
            coordinates.hinges.iter().map(of).collect()
        };
        let (beta, tau) = (of_links(|hinge| hinge.beta), of_links(|hinge| hinge.tau));
        let motion = Motion { omega_body: coordinates.omega, beta: &beta, tau: &tau };
        let mut found = Accelerations::for_hinges(beta.len());
        self.dynamics.accelerations(&motion, &mut found);
        let rate = self.attitude.rate(coordinates.omega);
        let links = &self.recognised.links;
        let mut rates = vec![rate.scalar];
        rates.extend(rate.vector.to_array());
        rates.extend(found.omega_dot_body.to_array());
        rates.extend(links.iter().map(|&j| tau[j]));
        rates.extend(links.iter().map(|&j| found.tau_dot[j]));
        rates.push(self.dynamics.elements().rate_power(self.dynamics.free_hinges(), [&beta, &tau]));
        rates
    }
}

#[test]
fn forces_that_are_set_anew_are_those_of_the_other_satellite() {
    let mut known: BTreeMap<usize, Forces<f64>> = BTreeMap::new();
    for seed in 0..RANDOM_SATELLITES {
        let Pushed { recognised, dynamics, forces, .. } = Pushed::random(seed);
        let Ok(expected) = forces else { continue };
        let of_size = known.entry(expected.laws.len()).or_insert_with(|| expected.clone());
        let set = of_size.set(dynamics.elements(), dynamics.tree(), &recognised);
        assert_eq!((set, &*of_size), (Ok(()), &expected), "seed {seed}");
    }
    assert!(known.len() > 5, "{} sizes", known.len());
}

#[test]
fn torques_of_lines_and_hinges_are_those_of_the_recursion() {
    let (mut lines, mut of_two, mut too_many, mut coupled, mut apart) = (0, 0, 0, 0, 0);
    let (mut spun, mut spun_up) = (0, 0);
    for seed in 0..RANDOM_SATELLITES {
        let pushed = Pushed::random(seed);
        let pushing = pushed.dynamics.elements().pushing().count();
        let forces = match &pushed.forces {
            Ok(forces) => forces,
            Err(NoPlace::Lines { .. }) => {
                too_many += 1;
                continue;
            }
            Err(NoPlace::Coupling { .. }) => {
                apart += 1;
                continue;
            }
            Err(NoPlace::Rotor { .. }) => {
                spun_up += 1;
                continue;
            }
            Err(why) => panic!("seed {seed}: {why}"),
        };
        let Recognised { topology, parameters, .. } = &pushed.recognised;
        let second = &forces.lines[topology.hinges()..];
        of_two += usize::from(second.iter().any(|line| *line != LinkLine::absent()));
        let [beta, tau, expected] = pushed.of_hinges();
        let found = forces.torques(topology, parameters, [&beta, &tau]);
        let error = relative_error(&found, &expected, 1.0);
        assert!(error < ROUNDING, "seed {seed}, {topology}: {error:e}");
        lines += pushing;
        coupled += forces.couplings.iter().filter(|law| is_there(law)).count();
        spun += usize::from(forces.spin != Vec3::zero());
    }
    let told = format!(
        "{lines} lines, {of_two} modes with two on one link, {too_many} with more, {coupled} couplings, \
         {apart} modes with others"
    );
    assert!(lines > 1000 && of_two > 50 && too_many > 0, "{told}");
    assert!(coupled > 500 && apart > 10, "{told}");
    assert!(spun > 100 && spun_up > 10, "{spun} modes with rotors, {spun_up} with others");
}

#[test]
fn all_formulations_give_the_right_side_that_a_run_composes() {
    for seed in 0..RANDOM_SATELLITES {
        let mut pushed = Pushed::random(seed);
        let Ok(forces) = pushed.forces.clone() else { continue };
        let (y, expected) = (pushed.variables(), pushed.composed());
        let Recognised { topology, parameters, .. } = &pushed.recognised;
        for formulation in Formulation::ALL.into_iter().filter(|form| form.takes(topology)) {
            let found = right_side(formulation, topology, parameters, &forces, &y);
            assert_eq!(found.len(), RightSideLayout::outputs(topology));
            let same = |range: std::ops::Range<usize>| found[range.clone()] == expected[range];
            assert!(same(RightSideLayout::ATTITUDE) && same(RightSideLayout::beta(topology)));
            let power = RightSideLayout::power(topology);
            let error = (found[power] - expected[power]).abs() / expected[power].abs().max(1.0);
            assert!(error < ROUNDING, "seed {seed}, {topology}: power {error:e}");
            let error = relative_error(&found[..power], &expected[..power], 0.0);
            let allowed = pushed.satellite.allowed();
            assert!(error < allowed, "seed {seed}, {topology}, {formulation}: {error:e}");
        }
    }
}

#[test]
fn numbers_that_are_written_are_read_back_and_stand_where_the_layout_says() {
    let pushed = (0..).map(Pushed::random).find(|pushed| {
        let pushing = pushed.dynamics.elements().pushing().count();
        let couples = |forces: &Forces<f64>| forces.couplings.iter().any(is_there);
        pushed.forces.as_ref().is_ok_and(couples)
            && pushing > 1
            && pushed.dynamics.elements().external().is_some()
    });
    let pushed = pushed.expect("there are infinitely many");
    let forces = pushed.forces.expect("it was looked for");
    let topology = &pushed.recognised.topology;
    let all = [pushed.recognised.parameters.write(), forces.write()].concat();
    assert_eq!(all.len(), RightSideLayout::parameters(topology));
    let start = RightSideLayout::law(topology, 0).start;
    assert_eq!(Forces::read(topology.hinges(), all[start..].iter().copied()), forces);
    let external = &all[RightSideLayout::external(topology)];
    assert_eq!(external[..3], forces.external.moment.to_array());
    assert_eq!(all[RightSideLayout::spin(topology)], forces.spin.to_array());
    for hinge in 0..topology.hinges() {
        assert_eq!(all[RightSideLayout::law(topology, hinge)], forces.laws[hinge].numbers());
    }
    assert_eq!(forces.lines.len(), RightSideLayout::lines(topology));
    for (place, LinkLine { point, law, .. }) in forces.lines.iter().enumerate() {
        assert_eq!(all[RightSideLayout::line(topology, place)][..3], point.to_array());
        assert_eq!(all[RightSideLayout::coefficients(topology, place)], law.numbers());
    }
    for (hinge, law) in forces.couplings.iter().enumerate() {
        assert_eq!(all[RightSideLayout::coupling(topology, hinge)], law.numbers());
        let strength = RightSideLayout::strength(topology, hinge).map(|at| all[at]);
        assert_eq!(strength, [2, 4].map(|at| law.numbers()[at]));
    }
}

/// What is virtual stays at rest and shows nowhere.
#[test]
fn the_right_side_of_an_embedded_satellite_is_its_own() {
    let outer: Topology = "4xS6_4xP".parse().expect("a topology");
    for seed in 0..200 {
        let pushed = Pushed::random(seed);
        let Ok(forces) = &pushed.forces else { continue };
        let Recognised { topology: inner, parameters, .. } = &pushed.recognised;
        if inner.has_limbs() {
            continue;
        }
        let embedding = Embedding::new(inner, &outer).expect("it is larger");
        let y = pushed.variables();
        let form = Formulation::Articulated;
        let expected = right_side(form, inner, parameters, forces, &y);
        let mut wide = vec![0.0; RightSideLayout::coordinates(&outer)];
        wide[..RightSideLayout::STATE].copy_from_slice(&y[..RightSideLayout::STATE]);
        for of in [RightSideLayout::beta, RightSideLayout::tau] {
            for (&hinge, value) in embedding.hinges().iter().zip(&y[of(inner)]) {
                wide[of(&outer)][hinge] = *value;
            }
        }
        let numbers = embedding.parameters(parameters, &[]);
        let satellite = Parameters::read(&outer, numbers);
        let mut numbers = Vec::new();
        forces.write_embedded(&embedding, &mut numbers);
        let forces = Forces::read(outer.hinges(), numbers);
        let found = right_side(form, &outer, &satellite, &forces, &wide);
        assert!(found.iter().all(|number| number.is_finite()));
        let mut of_inner = found[..RightSideLayout::STATE].to_vec();
        for of in [RightSideLayout::beta, RightSideLayout::tau] {
            of_inner.extend(embedding.hinges().iter().map(|&hinge| found[of(&outer)][hinge]));
        }
        of_inner.push(found[RightSideLayout::power(&outer)]);
        let error = relative_error(&of_inner, &expected, 0.0);
        assert!(error < pushed.satellite.allowed(), "seed {seed}, {inner}: {error:e}");
    }
}
