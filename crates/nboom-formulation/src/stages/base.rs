//! Steps of the main body.

use nboom_scalar::{Real, RigidInertia, Twist, Vec3, Wrench};

use crate::base::AtOrigin;
use crate::parameters::Reader;
use crate::stages::{AT_ORIGIN, EXTERNAL, MAIN, MAIN_RATES, OMEGA, SPIN, Stage};

/// Accelerations of a main body that is held.
pub fn held_base<R: Real>() -> Stage<R> {
    Stage {
        name: "base",
        about: "Accelerations of the main body, as it is held.",
        parameters: vec![MAIN],
        inputs: vec![EXTERNAL],
        outputs: vec![MAIN_RATES],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let main = reader.rigid();
            let external = Wrench { moment: reader.vector(), force: reader.vector() };
            flat(AtOrigin::accelerations_of_held(&main, &external))
        }),
    }
}

/// Accelerations of the main body from the sum of what all appendages show.
pub fn base<R: Real>() -> Stage<R> {
    Stage {
        name: "base",
        about: "Accelerations of the main body from the sum of what all appendages show.",
        parameters: vec![MAIN],
        inputs: vec![OMEGA, EXTERNAL, AT_ORIGIN],
        outputs: vec![MAIN_RATES],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let main = reader.rigid();
            let omega = reader.vector();
            let external = Wrench { moment: reader.vector(), force: reader.vector() };
            main_rates(&main, omega, &external, &AtOrigin::read(&mut reader))
        }),
    }
}

fn main_rates<R: Real>(
    main: &RigidInertia<R>,
    omega: Vec3<R>,
    external: &Wrench<R>,
    seen: &AtOrigin<R>,
) -> Vec<R> {
    let mut total = AtOrigin::of_main_body(main, omega, external);
    total.add(seen);
    flat(total.accelerations())
}

fn flat<R: Real>(rates: Twist<R>) -> Vec<R> {
    [rates.angular.to_array(), rates.linear.to_array()].concat()
}

/// [`base`] with an external wrench, and an angular momentum of rotors, that stay the same as long as the mode.
pub fn base_in_mode<R: Real>() -> Stage<R> {
    Stage {
        name: "base",
        about: "Accelerations of the main body from the sum of what all appendages show.",
        parameters: vec![MAIN, EXTERNAL, SPIN],
        inputs: vec![OMEGA, AT_ORIGIN],
        outputs: vec![MAIN_RATES],
        run: Box::new(|numbers| {
            let mut reader = Reader(numbers.iter().copied());
            let main = reader.rigid();
            let mut external = Wrench { moment: reader.vector(), force: reader.vector() };
            let (spin, omega) = (reader.vector(), reader.vector());
            external.moment -= omega.cross(spin);
            main_rates(&main, omega, &external, &AtOrigin::read(&mut reader))
        }),
    }
}

/// [`held_base`] with an external wrench that stays the same as long as the mode.
pub fn held_base_in_mode<R: Real>() -> Stage<R> {
    let held = held_base();
    let parameters = [held.parameters, held.inputs, vec![SPIN]].concat();
    Stage { parameters, inputs: vec![], ..held }
}
