//! All derivatives of generated accelerations at once, against the recursion on dual numbers: another
//! derivation of the equations, differentiated in the same way.

use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::{Layout, Recognised, recognise};
use nboom_model::{Body, Hinge, Joint, MassProperties, Mount, Scene, SceneDescription};
use nboom_routines::{General2Trr, GeneralTrrr, PrincipalS2P};
use nboom_scalar::{Dual, Mat3, Routine, Sym3, Vec3, jacobian};

use support::{Rng, parameters, state};

mod support;

/// Two booms of two canted hinges each, or one of three, without springs.
fn booms(booms: usize, hinges: usize, dice: &mut Rng) -> Scene {
    let main = MassProperties::new(80.0, Vec3::zero(), Sym3::diagonal(30.0, 40.0, 50.0));
    let mut description = SceneDescription::at_rest("canted", main, 1.0);
    for boom in 0..booms {
        for i in 0..hinges {
            let mut vector = |size: f64| {
                let mut one = || dice.between(-size, size);
                Vec3::new(one(), one(), one())
            };
            let (center, point, turn) = (vector(0.4), vector(1.0), vector(3.0));
            description.bodies.push(Body {
                inboard: (i > 0).then(|| boom * hinges + i - 1),
                mount: Mount {
                    point,
                    rot_inboard_from_hinge: Mat3::from_euler_121(turn.x, turn.y, turn.z),
                },
                joint: Joint::Revolute,
                axis: Vec3::unit_z(),
                mass_properties: MassProperties::new(2.0, center, Sym3::diagonal(0.5, 0.7, 0.9)),
                tip: Vec3::zero(),
                hinge: Hinge::free(),
            });
        }
    }
    Scene::new(description).expect("the bodies are physical")
}

/// One state: ω, then β, τ and torque of each hinge of the scene.
struct State {
    omega: [f64; 3],
    hinges: Vec<[f64; 3]>,
}

/// Accelerations by the recursion, hinges in the scene's order, and their derivatives by the entry
/// `along` of β, τ or torque of a hinge, or of ω.
fn by_recursion(scene: &Scene, state: &State, along: (Option<usize>, usize)) -> Vec<Dual<f64>> {
    let dual = |of: Option<usize>, i: usize, value: f64| {
        if (of, i) == along { Dual::variable(value) } else { Dual::constant(value) }
    };
    let [x, y, z] = std::array::from_fn(|i| dual(None, i, state.omega[i]));
    let of_hinges = |row: usize| -> Vec<Dual<f64>> {
        let hinges = state.hinges.iter().enumerate();
        hinges.map(|(hinge, numbers)| dual(Some(hinge), row, numbers[row])).collect()
    };
    let (beta, tau, torques) = (of_hinges(0), of_hinges(1), of_hinges(2));
    let mut dynamics = Recursive::<Dual<f64>>::new(scene);
    let motion = Motion { omega_body: Vec3::new(x, y, z), beta: &beta, tau: &tau };
    let mut found = Accelerations::for_hinges(beta.len());
    let add = |_: &[usize], all: &mut [Dual<f64>]| {
        all.iter_mut().zip(&torques).for_each(|(sum, torque)| *sum += *torque);
    };
    dynamics.accelerations_with(add, &motion, &mut found);
    let [angular, linear] = [found.omega_dot_body, found.origin_body].map(Vec3::to_array);
    [&angular[..], &linear, &found.tau_dot].concat()
}

fn agrees<T: Routine>(scene: &Scene, dice: &mut Rng) {
    let Recognised { topology, parameters, links, .. } =
        recognise(Recursive::<f64>::new(scene).tree()).expect("rigid bodies");
    assert_eq!(topology.to_string(), T::TOPOLOGY);
    let mut three = || [(); 3].map(|()| dice.between(-1.5, 1.5));
    let state = State { omega: three(), hinges: links.iter().map(|_| three()).collect() };
    let (mut k, mut x) = (vec![0.0; T::CONSTANTS], vec![0.0; T::COORDINATES]);
    T::prepare(&parameters.write(), &mut k);
    x[..3].copy_from_slice(&state.omega);
    let places: Vec<_> = links.iter().copied().zip(Layout::places(&topology)).collect();
    for &(link, place) in &places {
        let at = Layout::hinge_in_state(&topology, place);
        at.into_iter().zip(state.hinges[link]).for_each(|(at, value)| x[at] = value);
    }
    let (mut found, mut all) = (vec![0.0; T::OUTPUTS], vec![0.0; T::OUTPUTS * T::COORDINATES]);
    jacobian::<T>(&k, &x, 0..T::COORDINATES, &mut found, &mut all);
    let in_scene = |output: usize| match output.checked_sub(Layout::OUTPUT) {
        None => output,
        Some(place) => {
            let (link, _) = places.iter().find(|&&(_, at)| at == place).expect("a hinge");
            Layout::OUTPUT + link
        }
    };
    let check = |along: (Option<usize>, usize), column: usize| {
        let expected = by_recursion(scene, &state, along);
        let most = |of: fn(&Dual<f64>) -> f64| {
            expected.iter().fold(0.0_f64, |most, dual| most.max(of(dual).abs()))
        };
        let (values, scale) = (most(|dual| dual.value), most(|dual| dual.derivative));
        assert!(scale > 1e-3, "{along:?} matters");
        for output in 0..T::OUTPUTS {
            let expected = expected[in_scene(output)];
            assert!((found[output] - expected.value).abs() < 1e-12 * values, "{along:?}");
            let off = all[output * T::COORDINATES + column] - expected.derivative;
            // Rounding on mass matrices of condition up to 1e3.
            assert!(off.abs() < 1e-12 * scale, "{}, {along:?}: {off:e} of {scale:e}", T::TOPOLOGY);
        }
    };
    (0..3).for_each(|i| check((None, i), i));
    for &(link, place) in &places {
        let at = Layout::hinge_in_state(&topology, place);
        at.into_iter().enumerate().for_each(|(row, column)| check((Some(link), row), column));
    }
}

#[test]
fn derivatives_of_limbs_are_those_of_the_recursion() {
    let dice = &mut Rng::new(7);
    for _ in 0..20 {
        agrees::<General2Trr>(&booms(2, 2, dice), dice);
        agrees::<GeneralTrrr>(&booms(1, 3, dice), dice);
    }
}

#[test]
fn any_coordinates_are_asked_for() {
    let dice = &mut Rng::new(11);
    let topology = PrincipalS2P::TOPOLOGY.parse().expect("a topology");
    let (mut k, x) = (vec![0.0; PrincipalS2P::CONSTANTS], state(&topology, true, dice));
    PrincipalS2P::prepare(&parameters(&topology, PrincipalS2P::ASSUMPTIONS, dice), &mut k);
    let ask = |by: std::ops::Range<usize>| {
        let mut found = vec![0.0; PrincipalS2P::OUTPUTS];
        let mut derivatives = vec![0.0; PrincipalS2P::OUTPUTS * by.len()];
        jacobian::<PrincipalS2P>(&k, &x, by, &mut found, &mut derivatives);
        (found, derivatives)
    };
    let (values, all) = ask(0..PrincipalS2P::COORDINATES);
    for by in [0..0, 3..4, 5..14, 20..21] {
        let (found, derivatives) = ask(by.clone());
        assert_eq!(found, values);
        let of = |row: usize| &all[row * PrincipalS2P::COORDINATES..][by.clone()];
        let expected: Vec<f64> = (0..values.len()).flat_map(|row| of(row).to_vec()).collect();
        assert_eq!(derivatives, expected);
    }
}
