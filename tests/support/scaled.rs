//! A scene written in other units.
#![allow(dead_code, reason = "each test binary uses its own part")]

use nboom::model::{Course, ExternalKind, Joint, MassProperties, Release, SceneDescription};

/// How many new units there are in one old unit.
#[derive(Clone, Copy, Debug)]
pub struct Units {
    pub time: f64,
    pub mass: f64,
    pub length: f64,
}

impl Units {
    pub fn force(self) -> f64 {
        self.mass * self.length / (self.time * self.time)
    }

    pub fn torque(self) -> f64 {
        self.force() * self.length
    }

    /// Of a joint's coordinate.
    pub fn coordinate(self, joint: Joint) -> f64 {
        match joint {
            Joint::Revolute => 1.0,
            Joint::Prismatic => self.length,
        }
    }

    /// Of an impulsive torque or force at a joint.
    pub fn impulse(self, joint: Joint) -> f64 {
        self.torque() / self.coordinate(joint) * self.time
    }

    fn mass_properties(self, body: &mut MassProperties) {
        body.mass *= self.mass;
        body.center_of_mass = body.center_of_mass * self.length;
        body.inertia = body.inertia * (self.mass * self.length * self.length);
    }

    /// The scene with all numbers in the new units.
    pub fn scene(self, old: &SceneDescription) -> SceneDescription {
        let Self { time, length, .. } = self;
        let (force, torque) = (self.force(), self.torque());
        let mut scene = old.clone();
        self.mass_properties(&mut scene.main_body);
        for body in &mut scene.bodies {
            self.mass_properties(&mut body.mass_properties);
            body.mount.point = body.mount.point * length;
            let hinge = &mut body.hinge;
            let one = self.coordinate(body.joint);
            let acts = torque / one;
            hinge.spring.quadratic *= acts / (one * one);
            hinge.spring.linear *= acts / one;
            hinge.spring.preload_angle *= one;
            hinge.dashpot.rate_quadratic *= acts * time * time / (one * one);
            hinge.dashpot.rate_linear *= acts * time / one;
            hinge.dashpot.angle_quadratic *= acts / (one * one);
            hinge.dashpot.angle_linear *= acts / one;
            hinge.dashpot.preload_angle *= one;
            hinge.start.angle *= one;
            hinge.start.rate *= one / time;
            hinge.lock_angle = hinge.lock_angle.map(|at| at * one);
            match &mut hinge.release {
                Release::Time(at) | Release::AfterLock { delay: at, .. } => *at *= time,
                Release::Angle { hinge, angle } => {
                    *angle *= self.coordinate(old.bodies[*hinge].joint)
                }
                Release::Never => {}
            }
            if let Some(spring) = &mut hinge.kick_off {
                spring.main_body_point = spring.main_body_point * length;
                spring.body_point = spring.body_point * length;
                spring.limit_length *= length;
                for (power, coefficient) in spring.coefficients.iter_mut().enumerate() {
                    *coefficient *= force / length.powi(power as i32);
                }
            }
        }
        if let Some(gravity) = &mut scene.gravity {
            gravity.acceleration *= length / (time * time);
        }
        for external in &mut scene.externals {
            let amount = match external.kind {
                ExternalKind::Force => force,
                ExternalKind::Torque => torque,
            };
            external.amount = external.amount * amount;
            external.point = external.point * length;
            match &mut external.course {
                Course::Pulse { on, off } => [on, off].into_iter().for_each(|at| *at *= time),
                Course::Table(points) => points.iter_mut().for_each(|point| point[0] *= time),
            }
        }
        let initial = &mut scene.initial;
        initial.time *= time;
        initial.omega_body = initial.omega_body * (1.0 / time);
        initial.position_inertial = initial.position_inertial * length;
        initial.velocity_inertial = initial.velocity_inertial * (length / time);
        scene.end_time *= time;
        scene
    }
}
