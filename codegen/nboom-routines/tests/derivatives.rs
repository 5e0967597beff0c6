//! Derivatives of generated routines by dual numbers against central differences of the recursion
//! in double-double: another derivation of the equations, differentiated in another way.

use std::path::Path;

use nboom_dynamics::{Accelerations, Motion, Recursive};
use nboom_formulation::{Layout, Recognised, recognise};
use nboom_model::{HingeState, Mode, Scene, SceneDescription};
use nboom_routines::{Principal4S5, PrincipalS2P};
use nboom_scalar::{DoubleDouble, Dual, Routine, Vec3};

use support::Rng;

mod support;

/// What a derivative is taken with respect to.
#[derive(Clone, Copy, Debug)]
enum Variable {
    Angle(usize),
    Rate(usize),
    /// The mass of a segment, whose first moment and inertia about its hinge change with it.
    Mass(usize),
}

/// A scene with all hinges free, and a state of it.
#[derive(Clone)]
struct Moment {
    scene: Scene,
    omega: [f64; 3],
    beta: Vec<DoubleDouble>,
    tau: Vec<DoubleDouble>,
}

impl Moment {
    fn of(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../benches/scenes").join(name);
        let scene = nboom_io::read_scene(&path).expect("the scene is in the clone").scene;
        let hinges = scene.bodies.len();
        let mut numbers = Rng::new(2);
        let omega = std::array::from_fn(|_| numbers.between(-1.5, 1.5));
        let mut some =
            |count: usize| -> Vec<f64> { (0..count).map(|_| numbers.between(-1.5, 1.5)).collect() };
        let wide = |all: Vec<f64>| all.into_iter().map(DoubleDouble::from).collect();
        Self { scene, omega, beta: wide(some(hinges)), tau: wide(some(hinges)) }
    }

    /// The moment with the variable changed by `step`.
    fn changed(&self, variable: Variable, step: f64) -> Self {
        let mut changed = self.clone();
        match variable {
            Variable::Angle(i) => changed.beta[i] += DoubleDouble::from(step),
            Variable::Rate(i) => changed.tau[i] += DoubleDouble::from(step),
            Variable::Mass(i) => {
                let mut description = SceneDescription::clone(&self.scene);
                description.bodies[i].mass_properties.mass += step;
                changed.scene = Scene::new(description).expect("still a satellite");
            }
        }
        changed
    }

    /// Torques of the hinges, then ω̇, a_O and τ̇, by recursion.
    fn by_recursion(&self) -> (Vec<DoubleDouble>, Vec<DoubleDouble>) {
        let hinges = self.beta.len();
        let mut dynamics = Recursive::<DoubleDouble>::new(&self.scene);
        dynamics.set_mode(&all_free(&self.scene), &self.beta);
        let omega_body = Vec3::constant(Vec3::new(self.omega[0], self.omega[1], self.omega[2]));
        let motion = Motion { omega_body, beta: &self.beta, tau: &self.tau };
        let mut found = Accelerations::for_hinges(hinges);
        dynamics.accelerations(&motion, &mut found);
        let mut torques = vec![DoubleDouble::from(0.0); hinges];
        dynamics.hinge_forces(&motion, &mut torques);
        let [angular, linear] = [found.omega_dot_body, found.origin_body].map(Vec3::to_array);
        (torques, [&angular[..], &linear, &found.tau_dot].concat())
    }

    fn recognised(&self) -> Recognised {
        let beta: Vec<f64> = self.beta.iter().map(|angle| angle.to_f64()).collect();
        let mut dynamics = Recursive::<f64>::new(&self.scene);
        dynamics.set_mode(&all_free(&self.scene), &beta);
        recognise(dynamics.tree()).expect("chains and paddles")
    }
}

fn all_free(scene: &Scene) -> Mode {
    let hinges = vec![HingeState::Free; scene.bodies.len()];
    Mode { hinges, ..Mode::at_start(scene) }
}

/// Values and derivatives by central differences over `step`.
fn differences(
    [before, at, after]: [&[DoubleDouble]; 3],
    step: f64,
) -> impl Iterator<Item = Dual<f64>> {
    let over = DoubleDouble::from(2.0 * step);
    (0..at.len()).map(move |i| {
        let derivative = ((after[i] - before[i]) / over).to_f64();
        Dual { value: at[i].to_f64(), derivative }
    })
}

/// Accelerations by the routine, in the order of the recursion, with their derivatives; those of
/// parameters and torques are given.
fn by_routine<T: Routine>(
    moment: &Moment,
    variable: Variable,
    parameters: &[Dual<f64>],
    torques: &[Dual<f64>],
) -> Vec<Dual<f64>> {
    let Recognised { topology, links, .. } = moment.recognised();
    assert_eq!(topology.to_string(), T::TOPOLOGY);
    let zero = Dual::constant(0.0);
    let (mut k, mut x) = (vec![zero; T::CONSTANTS], vec![zero; T::COORDINATES]);
    for i in 0..3 {
        x[i] = Dual::constant(moment.omega[i]);
    }
    let places = Layout::places(&topology);
    for (&link, &place) in links.iter().zip(&places) {
        let [beta, tau, torque] = Layout::hinge_in_state(&topology, place);
        x[beta] = Dual::constant(moment.beta[link].to_f64());
        x[tau] = Dual::constant(moment.tau[link].to_f64());
        x[torque] = torques[link];
        match variable {
            Variable::Angle(i) if i == link => x[beta].derivative = 1.0,
            Variable::Rate(i) if i == link => x[tau].derivative = 1.0,
            _ => (),
        }
    }
    let mut out = vec![zero; T::OUTPUTS];
    T::prepare(parameters, &mut k);
    T::evaluate(&k, &x, &mut out);
    let mut ordered = out.clone();
    for (&link, place) in links.iter().zip(places) {
        ordered[Layout::OUTPUT + link] = out[Layout::OUTPUT + place];
    }
    ordered
}

fn agrees<T: Routine>(moment: &Moment, variable: Variable) {
    // Masses are changed in f64, and by powers of two, so that the change is exact.
    let step = 2.0_f64.powi(-26);
    let (before, after) = (moment.changed(variable, -step), moment.changed(variable, step));
    let [low, at, high] = [&before, moment, &after].map(Moment::by_recursion);
    let torques: Vec<_> = differences([&low.0, &at.0, &high.0], step).collect();
    let expected: Vec<_> = differences([&low.1, &at.1, &high.1], step).collect();

    // Parameters are linear in a mass, so that a large step loses nothing.
    let large = 2.0_f64.powi(-4);
    let of = |moment: &Moment| -> Vec<DoubleDouble> {
        moment.recognised().parameters.write().into_iter().map(DoubleDouble::from).collect()
    };
    let (before, after) = (moment.changed(variable, -large), moment.changed(variable, large));
    let all = [of(&before), of(moment), of(&after)];
    let parameters: Vec<_> = differences([&all[0], &all[1], &all[2]], large).collect();

    let found = by_routine::<T>(moment, variable, &parameters, &torques);
    let scale = |of: fn(&Dual<f64>) -> f64| {
        expected.iter().fold(0.0_f64, |most, dual| most.max(of(dual).abs()))
    };
    let (value_scale, scale) = (scale(|dual| dual.value), scale(|dual| dual.derivative));
    assert!(scale > 1e-3, "{variable:?} matters");
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found.value - expected.value).abs() < 1e-12 * value_scale, "{variable:?}");
        let off = (found.derivative - expected.derivative).abs() / scale;
        // A step of 1.5e-8 leaves 2e-16 of a third derivative; the rest is rounding of the
        // routine and of the parameters, on mass matrices of condition up to 1e3.
        assert!(off < 1e-12, "{}, {variable:?}: {off:e}", T::TOPOLOGY);
    }
}

fn agrees_in_all_variables<T: Routine>(deck: &str) {
    let moment = Moment::of(deck);
    for i in 0..moment.beta.len() {
        for variable in [Variable::Angle(i), Variable::Rate(i), Variable::Mass(i)] {
            agrees::<T>(&moment, variable);
        }
    }
}

#[test]
fn routine_of_the_report_satellite() {
    agrees_in_all_variables::<PrincipalS2P>("T1.nml");
}

#[test]
fn routine_of_four_equal_booms() {
    agrees_in_all_variables::<Principal4S5>("T2.nml");
}
