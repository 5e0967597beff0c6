//! Rates of energy and momenta by given accelerations, body by body.

use nalgebra::{DVector, Vector3};
use nboom::model::{Joint, SceneDescription};

use crate::newton_euler::{Placed, inboard_of};

type V3 = Vector3<f64>;

/// Rates of energy and momenta, about O as far as moments go.
pub struct Rates {
    pub kinetic_energy: f64,
    pub energy_scale: f64,
    pub linear: V3,
    pub linear_scale: f64,
    pub angular: V3,
    pub angular_scale: f64,
}

/// Spreads given accelerations (a_O, ω̇, …) and `tau_dot` over the bodies and adds up.
pub fn rates(
    scene: &SceneDescription,
    placed: &[Placed],
    tau: &[f64],
    of_main: &DVector<f64>,
    tau_dot: &[f64],
) -> Rates {
    let mut moved: Vec<(V3, V3)> = vec![(
        V3::new(of_main[0], of_main[1], of_main[2]),
        V3::new(of_main[3], of_main[4], of_main[5]),
    )];
    let at = |body: &Placed, (a, w): (V3, V3), arm: V3| {
        a + w.cross(&arm) + body.omega.cross(&body.omega.cross(&arm))
    };
    for (i, body) in scene.bodies.iter().enumerate() {
        let (p, own) = (inboard_of(body), placed[i + 1]);
        let origin = at(&placed[p], moved[p], own.origin - placed[p].origin);
        let (carried, driven) =
            (placed[p].omega.cross(&(own.axis * tau[i])), own.axis * tau_dot[i]);
        moved.push(match body.joint {
            Joint::Revolute => (origin, moved[p].1 + carried + driven),
            Joint::Prismatic => (origin + carried * 2.0 + driven, moved[p].1),
        });
    }
    let mut rates = Rates {
        kinetic_energy: 0.0,
        energy_scale: 0.0,
        linear: V3::zeros(),
        linear_scale: 0.0,
        angular: V3::zeros(),
        angular_scale: 0.0,
    };
    for (body, &acceleration) in placed.iter().zip(&moved) {
        let force = at(body, acceleration, body.center - body.origin) * body.mass;
        let moment = body.inertia * acceleration.1 + body.gyroscopic();
        let about_o = body.center.cross(&force) + moment;
        let powers = [body.center_velocity.dot(&force), body.omega.dot(&moment)];
        rates.kinetic_energy += powers[0] + powers[1];
        rates.energy_scale += powers[0].abs() + powers[1].abs();
        rates.linear += force;
        rates.linear_scale += force.norm();
        rates.angular += about_o;
        rates.angular_scale += about_o.norm();
    }
    rates
}
