//! Steps as recorders see them.

use std::io;

use nboom::model::{External, Rotor, RotorSpeed, Scene};
use nboom::scalar::Vec3;
use nboom::sim::{Options, Recorder, Snapshot, StepMotion, simulate};

use crate::rotors::{description, free, oscillating};

/// When steps start that do not go on from the one before, and how many do.
#[derive(Default)]
struct Starts {
    anew: Vec<f64>,
    others: usize,
    end: f64,
}

impl Recorder for Starts {
    fn sample(&mut self, _: &Snapshot) -> io::Result<()> {
        Ok(())
    }

    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        let [start, end] = step.span();
        assert_eq!(start, self.end, "steps leave nothing out");
        self.end = end;
        if step.goes_on() {
            self.others += 1;
        } else {
            self.anew.push(start);
        }
        Ok(())
    }
}

/// A push begins and ends with events; where a rotor's speed bends accelerations jump, and there is no event.
#[test]
fn a_step_says_whether_accelerations_jump_where_it_starts() {
    let mut scene = description(&[oscillating(free(0.5, 0.0), 4.0, 0.0)], 9.0);
    let speed = RotorSpeed::Table(vec![[1.0, 3.0], [3.0, 40.0], [6.0, 10.0]]);
    scene.rotors = vec![Rotor { body: None, axis: Vec3::unit_x(), inertia: 0.2, speed }];
    scene.externals = vec![External::thrust(Vec3::unit_x(), Vec3::zero(), [2.0, 4.5])];
    let scene = Scene::new(scene).expect("rotors are bodies");
    let mut starts = Starts::default();
    simulate(&scene, &Options::default(), &mut starts).expect("it runs");
    assert_eq!(starts.anew, [0.0, 1.0, 2.0, 3.0, 4.5, 6.0]);
    assert!(starts.others > 20 && starts.end == 9.0);
}
