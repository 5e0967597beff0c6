//! Control laws that command the speeds of rotors.

use nboom_formulation::Formulation;
use nboom_model::{Base, Rotor, RotorSpeed, SceneDescription};
use nboom_scalar::Vec3;
use nboom_sim::{
    Commands, Control, Form, Nobody, Options, Path, Selection, Simulator, Snapshot, Summary,
    simulate,
};

use crate::{HUB, Told, free, rotors, scene, tight};

/// Inertia of a wheel about its axis.
const WHEEL: f64 = 0.02;

/// A hub alone that turns about x, with a wheel about x at these speeds.
fn hub(omega: f64, speed: RotorSpeed) -> SceneDescription {
    let mut description = rotors(&[], 4.0);
    description.initial.omega_body = Vec3::unit_x() * omega;
    let axis = Vec3::unit_x();
    description.rotors = vec![Rotor { body: None, axis, inertia: WHEEL, speed }];
    description
}

fn controlled(
    description: SceneDescription,
    period: f64,
    mut law: impl FnMut(&Snapshot, &mut Commands),
) -> (Told, Summary) {
    let mut simulator = Simulator::new(&scene(description), tight(16));
    let mut told = Told::default();
    let control = Control { period, law: &mut law };
    let summary = simulator.run_controlled(control, &mut told).expect("it runs to its end");
    (told, summary.clone())
}

fn balances(summary: &Summary) {
    let found = summary.conservation;
    let angular = found.angular_momentum.expect("a free main body");
    assert!(found.energy < 1e-12 && angular < 1e-12, "{found:?}");
}

/// The speed at each sample is that which was meant for it, whatever the table does beside, and in
/// between it goes straight; the hub turns back by J / (I + J) of that.
#[test]
fn a_law_reaches_a_speed_at_the_next_sample() {
    let (period, start) = (0.25, 0.3);
    let table = RotorSpeed::Table(vec![[0.6, 5.0], [1.7, 8.0]]);
    let meant = |k: usize| [20.0, -30.0, 0.0, 11.0][k % 4];
    let mut asked = 0;
    let mut beside = 5.0;
    let (told, summary) = controlled(hub(start, table.clone()), period, |seen, commands| {
        let expected =
            if asked == 0 { 5.0 } else { meant(asked - 1) + table.at(seen.time) - beside };
        assert!((seen.rotor_speeds[0] - expected).abs() < 1e-12, "{}", seen.time);
        let change = meant(asked) - seen.rotor_speeds[0];
        commands.rotor_accelerations_mut()[0] = change / period;
        beside = table.at(seen.time);
        asked += 1;
    });
    assert_eq!(asked, 16);
    balances(&summary);
    for seen in &told.samples {
        let omega = start - WHEEL / (HUB + WHEEL) * (seen.rotor_speeds[0] - 5.0);
        assert!((seen.omega_body.x - omega).abs() < 1e-13, "{} {omega}", seen.omega_body.x);
    }
    let work = told.last().account.expect("an output time has one").motor_work;
    let gained = told.last().kinetic_energy - told.samples[0].kinetic_energy;
    assert!((work - gained).abs() < 1e-12, "{work} {gained}");
}

/// A wheel takes all of the hub's angular momentum, and holds an attitude.
#[test]
fn a_wheel_holds_an_attitude() {
    let mut description = hub(0.4, RotorSpeed::Constant(0.0));
    description.end_time = 60.0;
    let (told, summary) = controlled(description, 0.05, |seen, commands| {
        let angle = 2.0 * seen.attitude.vector.x.atan2(seen.attitude.scalar);
        let torque = HUB * (0.25 * angle + seen.omega_body.x);
        commands.rotor_accelerations_mut()[0] = torque / WHEEL;
    });
    let last = told.last();
    assert!(last.omega_body.norm() < 1e-9 && last.attitude.vector.norm() < 1e-9, "{last:?}");
    let expected = (HUB + WHEEL) * 0.4 / WHEEL;
    assert!((last.rotor_speeds[0] - expected).abs() < 1e-8, "{}", last.rotor_speeds[0]);
    let energy = summary.conservation.energy;
    assert!(energy < 1e-10, "{energy:e}");
}

/// Momenta do not count the motors of rotors, nor what holds a main body: another formulation takes their place unless
/// library code of this one is demanded.
#[test]
fn momenta_give_way_where_they_do_not_cover_a_scene() {
    let with_wheel = hub(0.3, RotorSpeed::Constant(5.0));
    let mut fixed = rotors(&[free(0.0, 0.5)], 4.0);
    fixed.base = Base::Fixed;
    for (description, what) in [(with_wheel, "rotors"), (fixed, "a main body that is held")] {
        let scene = scene(description);
        let formulation = Some(Form::Closed(Formulation::Momentum));
        let options = Options { formulation, ..tight(4) };
        let summary = simulate(&scene, &options, &mut Nobody).expect("it runs to its end");
        let why = format!("formulation momentum does not cover {what}");
        let Selection { path, formulation, reason, .. } = &summary.selections[0];
        assert_eq!((*path, *formulation, &**reason), ("generic", "recursive", &*why));
        let generic = Options { path: Path::Generic, ..options };
        let refused = simulate(&scene, &generic, &mut Nobody).expect_err("not covered").error;
        assert!(refused.to_string().contains(&why), "{refused}");
    }
}

#[test]
fn an_acceleration_that_is_no_number_is_refused() {
    let scene = scene(hub(0.0, RotorSpeed::Constant(1.0)));
    let law = &mut |_: &Snapshot, commands: &mut Commands| {
        commands.rotor_accelerations_mut()[0] = f64::NAN;
    };
    let control = Control { period: 0.25, law };
    let failure = Simulator::new(&scene, tight(1)).run_controlled(control, &mut Nobody).map(|_| ());
    let told = failure.expect_err("no number").error.to_string();
    let expected = "at time 0: commanded acceleration of a rotor is not finite";
    assert!(told.starts_with(expected), "{told}");
}
