//! A compiled scene with a wheel and a cable: all modes have right sides of their own, which give the motion of the
//! recursion, also when a control law has changed the speed of the wheel.

use nboom::scalar::Vec3;
use nboom::sim::{Commands, Control, Options, Path, Recorder, Simulator, Snapshot, Summary};

const WHEEL: nboom::CompiledScene = nboom::scene!("tests/scenes/wheel.toml");

/// The last state.
#[derive(Default)]
struct Last {
    omega: [f64; 3],
    of_hinges: Vec<f64>,
}

impl Recorder for Last {
    fn sample(&mut self, snapshot: &Snapshot) -> std::io::Result<()> {
        self.omega = snapshot.omega_body.to_array();
        self.of_hinges = [&snapshot.beta[..], &snapshot.tau[..]].concat();
        Ok(())
    }
}

impl Last {
    fn off(&self, other: &Self) -> f64 {
        let all = |last: &Self| [&last.omega[..], &last.of_hinges].concat();
        let pairs = all(self).into_iter().zip(all(other));
        pairs.fold(0.0, |most, (a, b)| f64::max(most, (a - b).abs()))
    }
}

/// Speeds the wheel up for some time.
fn law(seen: &Snapshot, commands: &mut Commands) {
    let speeds_up = (0.3..0.5).contains(&seen.time);
    commands.rotor_accelerations_mut()[0] = if speeds_up { 300.0 } else { 0.0 };
}

fn run(options: Options, controlled: bool) -> (Last, Summary) {
    let scene = WHEEL.scene().expect("it was read when this was compiled");
    let options = Options { rtol: 1e-12, atol: 1e-13, ..options };
    let mut simulator = Simulator::new(&scene, options);
    let mut last = Last::default();
    let summary = if controlled {
        simulator.run_controlled(Control { period: 0.05, law: &mut law }, &mut last)
    } else {
        simulator.run(&mut last)
    };
    let summary = summary.expect("the scene runs").clone();
    (last, summary)
}

#[test]
fn a_wheel_and_a_cable_are_in_the_right_sides_of_all_modes() {
    let own = Options { path: Path::Generated, kernels: WHEEL.kernels(), ..Options::default() };
    let generic = Options { path: Path::Generic, ..Options::default() };
    let mut speeds = Vec::new();
    for controlled in [false, true] {
        let ((found, summary), (expected, _)) = (run(own, controlled), run(generic, controlled));
        let off = found.off(&expected);
        // Tolerances are 1e-12, in some hundred steps.
        assert!(off < 1e-9, "controlled: {controlled}: {off:e}");
        for (_, residual) in summary.conservation.laws() {
            assert!(residual < 1e-9, "{:?}", summary.conservation);
        }
        let is_whole = |reason: &str| reason.contains("whole right side");
        // While the wheel speeds up there is no right side, and after that there is again.
        let speeds_up = |since: f64| controlled && (0.3 - 1e-9..0.5 - 1e-9).contains(&since);
        for of in &summary.selections {
            assert_eq!(is_whole(&of.reason), !speeds_up(of.since), "{:?}", summary.selections);
        }
        let after = summary.selections.iter().filter(|of| (of.since - 0.5).abs() < 1e-9).count();
        assert_eq!(after, usize::from(controlled), "{:?}", summary.selections);
        speeds.push(Vec3::new(found.omega[0], found.omega[1], found.omega[2]));
    }
    assert!((speeds[0] - speeds[1]).norm() > 1e-3, "the wheel takes no momentum: {speeds:?}");
}

#[test]
fn a_controlled_run_leaves_nothing_to_the_next_one() {
    let scene = WHEEL.scene().expect("it was read when this was compiled");
    let options = Options { kernels: WHEEL.kernels(), rtol: 1e-9, ..Options::default() };
    let fresh = |simulator: &mut Simulator| {
        let mut last = Last::default();
        let summary = simulator.run(&mut last).expect("the scene runs").clone();
        (last.omega, last.of_hinges, summary)
    };
    let mut simulator = Simulator::new(&scene, options);
    // The command is still there when this run ends.
    let mut spin_up = |_: &Snapshot, commands: &mut Commands| {
        commands.rotor_accelerations_mut()[0] = 300.0;
    };
    let control = Control { period: 0.05, law: &mut spin_up };
    simulator.run_controlled(control, &mut Last::default()).expect("the scene runs");
    assert_eq!(fresh(&mut simulator), fresh(&mut Simulator::new(&scene, options)));
}
