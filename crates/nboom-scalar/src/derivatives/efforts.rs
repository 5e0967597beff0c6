//! One sweep outward and one inward over the links of a tree. All is along the axes of the main body, about the joint of each
//! link, and O is taken to be at rest for an instant.

use super::tree::{BodyOnMount, TreeJoint, TreeLink};
use crate::{Mat3, RigidInertia, Sym3, Twist, Vec3, Wrench};

/// A body in motion, and sums over it and all that is outboard of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving {
    rot: Mat3<f64>,
    /// The joint from O.
    pub joint: Vec3<f64>,
    velocity: Twist<f64>,
    acceleration: Twist<f64>,
    /// The motion at a rate of one, S.
    pub axis: Twist<f64>,
    /// Ψ̇ = V × S, with V of what carries the link: how its axis is carried along.
    pub carried: Twist<f64>,
    /// Ψ̈ = A × S + V × Ψ̇, with A and V of what carries the link.
    pub carried_twice: Twist<f64>,
    /// Of the body and all that is outboard, as are the fields below.
    pub inertia: RigidInertia<f64>,
    /// Y, the symmetric part of the angular block of 2 B, where B is the Coriolis matrix.
    coriolis: Sym3<f64>,
    /// Angular and linear momentum.
    momentum: Wrench<f64>,
    /// F, the wrench that the motion takes.
    effort: Wrench<f64>,
}

/// How efforts change with the motion of one joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Changes {
    /// I S, the effort for an acceleration of one.
    pub by_acceleration: Wrench<f64>,
    /// How the effort of any body inboard of the joint changes with the angle.
    pub by_angle: Wrench<f64>,
    /// The same with the rate.
    pub by_rate: Wrench<f64>,
    /// How the joint's own effort changes with the velocity of what carries the link, beyond inertia: it depends on the
    /// angular part alone.
    pub by_turning: Vec3<f64>,
}

impl Changes {
    /// Moves the efforts to a reference point from which the old one is seen at `way`.
    #[inline(always)]
    pub fn seen_from(&mut self, way: Vec3<f64>) {
        for effort in [&mut self.by_acceleration, &mut self.by_angle, &mut self.by_rate] {
            *effort = effort.seen_from(way);
        }
    }
}

impl Moving {
    /// A body at rest, nothing outboard.
    pub fn at_rest(inertia: RigidInertia<f64>) -> Self {
        let zero = Twist::zero();
        Self {
            rot: Mat3::identity(),
            joint: Vec3::zero(),
            velocity: zero,
            acceleration: zero,
            axis: zero,
            carried: zero,
            carried_twice: zero,
            inertia,
            coriolis: Sym3::zero(),
            momentum: Wrench::zero(),
            effort: Wrench::zero(),
        }
    }

    /// Begins the sums with the body itself in its motion.
    #[inline(always)]
    fn move_body(&mut self, inertia: RigidInertia<f64>) {
        let Twist { angular: w, linear: v } = self.velocity;
        let RigidInertia { first_moment: c, about_origin: j, .. } = inertia;
        let momentum = inertia.momentum(self.velocity);
        // ω × J − J ω×, and what the velocity of the reference point adds.
        let turned = Mat3::skew(w) * j.to_matrix();
        let both = turned + turned.transpose();
        self.inertia = inertia;
        self.coriolis = Sym3::upper_of(&both) + Sym3::across(c, v) * 2.0;
        self.momentum = momentum;
        self.effort = inertia.momentum(self.acceleration);
        self.effort.add(self.velocity.cross_wrench(momentum));
    }

    /// Adds what is outboard.
    #[inline(always)]
    fn add(&mut self, outboard: &Self) {
        let way = outboard.joint - self.joint;
        let p = outboard.momentum.force;
        self.inertia.add(outboard.inertia.seen_from(way));
        let shift = Sym3::across(p, way) * 2.0;
        self.coriolis += outboard.coriolis + shift;
        self.momentum.add(outboard.momentum.seen_from(way));
        self.effort.add(outboard.effort.seen_from(way));
    }

    /// 2 B Ψ, which depends on the angular part of the motion Ψ alone.
    #[inline(always)]
    fn of_velocity(&self, angular: Vec3<f64>) -> Wrench<f64> {
        let Wrench { moment: l, force: p } = self.momentum;
        let force = angular.cross(p);
        Wrench { moment: self.coriolis * angular - l.cross(angular), force: force + force }
    }

    /// How efforts change with the joint.
    #[inline(always)]
    pub fn changes(&self) -> Changes {
        let Twist { angular: s, linear: l } = self.axis;
        let Wrench { moment: angular_momentum, force: p } = self.momentum;
        let mut by_angle = self.axis.cross_wrench(self.effort);
        by_angle.add(self.inertia.momentum(self.carried_twice));
        by_angle.add(self.of_velocity(self.carried.angular));
        let mut by_rate = self.inertia.momentum(self.carried * 2.0);
        by_rate.add(self.of_velocity(s));
        let by_force = p.cross(l);
        Changes {
            by_acceleration: self.inertia.momentum(self.axis),
            by_angle,
            by_rate,
            by_turning: self.coriolis * s + angular_momentum.cross(s) + (by_force + by_force),
        }
    }

    /// How the efforts of the whole satellite change with one component of ω of the main body.
    #[inline(always)]
    pub fn by_omega(&self, along: Vec3<f64>) -> Wrench<f64> {
        let angular = self.velocity.angular.cross(along);
        let mut by_omega = self.inertia.momentum(Twist { angular, linear: Vec3::zero() });
        by_omega.add(self.of_velocity(along));
        by_omega
    }
}

/// Sets how main body and links move, and begins their sums.
#[inline(always)]
pub(super) fn outward(
    links: &[TreeLink],
    bodies: &[BodyOnMount],
    main: &mut Moving,
    moving: &mut [Moving],
    [state, accelerations]: [&[f64]; 2],
) {
    let vector = |of: &[f64], i: usize| Vec3::new(of[i], of[i + 1], of[i + 2]);
    main.velocity = Twist { angular: vector(state, 0), linear: Vec3::zero() };
    main.acceleration =
        Twist { angular: vector(accelerations, 0), linear: vector(accelerations, 3) };
    main.move_body(main.inertia);
    for (i, (link, on_mount)) in links.iter().zip(bodies).enumerate() {
        let carrier = link.inboard.map_or(&*main, |inboard| &moving[inboard]);
        let (q, rate, acceleration) =
            (state[link.angle], state[link.rate], accelerations[link.acceleration]);
        let axes = carrier.rot * on_mount.rot;
        let mut way = carrier.rot * on_mount.point;
        let mut rot = axes;
        let mut axis = Twist::zero();
        match link.joint {
            TreeJoint::Prismatic => {
                axis.linear = axes.column(0);
                way += axis.linear * q;
            }
            TreeJoint::Revolute => {
                axis.angular = axes.column(0);
                rot = turned(&axes, q.sin_cos());
            }
            TreeJoint::RevoluteAboutSecond => {
                axis.angular = axes.column(1);
                rot = turned_about_second(&axes, q.sin_cos());
            }
        }
        let joint = carrier.joint + way;
        let (mut velocity, mut motion) = (carrier.velocity.at(way), carrier.acceleration.at(way));
        let carried = velocity.cross(axis);
        let mut carried_twice = motion.cross(axis);
        carried_twice.add(velocity.cross(carried));
        velocity.add(axis * rate);
        motion.add(axis * acceleration);
        motion.add(carried * rate);
        let moved = &mut moving[i];
        *moved = Moving {
            rot,
            joint,
            velocity,
            acceleration: motion,
            axis,
            carried,
            carried_twice,
            ..*moved
        };
        moved.move_body(on_mount.body.rotated(&rot));
    }
}

/// Adds up what is outboard of each link and of the main body; `visit` is called for each link once all of that
/// is known.
#[inline(always)]
pub(super) fn inward(
    links: &[TreeLink],
    main: &mut Moving,
    moving: &mut [Moving],
    mut visit: impl FnMut(&[Moving], usize),
) {
    for (i, link) in links.iter().enumerate().rev() {
        visit(moving, i);
        let (before, outboard) = moving.split_at_mut(i);
        link.inboard.map_or(&mut *main, |inboard| &mut before[inboard]).add(&outboard[0]);
    }
}

/// Axes that have turned about the first of themselves.
#[inline(always)]
fn turned(axes: &Mat3<f64>, (sin, cos): (f64, f64)) -> Mat3<f64> {
    let row = |Vec3 { x, y, z }| Vec3::new(x, y * cos + z * sin, z * cos - y * sin);
    Mat3 { rows: axes.rows.map(row) }
}

/// Axes that have turned about the second of themselves.
#[inline(always)]
fn turned_about_second(axes: &Mat3<f64>, (sin, cos): (f64, f64)) -> Mat3<f64> {
    let row = |Vec3 { x, y, z }| Vec3::new(x * cos - z * sin, y, x * sin + z * cos);
    Mat3 { rows: axes.rows.map(row) }
}
