use nboom_dynamics::EffectiveInertias;
use nboom_model::{Body, External, MassProperties, Scene};
use nboom_scalar::{Sym3, Vec3};

use crate::equations::layout::VariableLayout;

/// Natural sizes of the variables: one for attitude and angles, a rate for rates, a stroke for travels, a
/// length for the way that the thrust displaces the mass centre. They follow the scene's units, so that no step depends
/// on these.
#[derive(Clone, Debug)]
pub(crate) struct Sizes {
    /// How far matter and the thrust are from O.
    length: f64,
    /// Of a change of β of each hinge.
    of_hinges: Vec<f64>,
    /// Of those that are free.
    of_free: Vec<f64>,
    /// The largest rate so far \[1/T\].
    rate: f64,
    /// What makes momenta of rates, of a mode that has them.
    inertias: Option<EffectiveInertias<f64>>,
}

/// Share of its size by which a wheel may be uneven, by rounding.
const EVEN: f64 = 1e-12;

/// Angle \[rad\] through which accelerations act at least.
const START: f64 = 1e-3;

impl Sizes {
    /// At the beginning of `scene`.
    pub fn of(scene: &Scene) -> Self {
        let point = scene.externals.iter().map(|one| distance(scene, one)).fold(0.0, f64::max);
        let of_hinges: Vec<f64> =
            (0..scene.bodies.len()).map(|i| scene.coordinate_scale(i)).collect();
        let mut sizes = Self {
            length: reach(scene).max(point),
            of_free: Vec::with_capacity(of_hinges.len()),
            of_hinges,
            rate: 0.0,
            inertias: None,
        };
        sizes.begin(scene);
        sizes
    }

    /// Begins anew with `scene`, whose satellite is the same, but for where hinges start: less than one radian in
    /// the whole run is no motion.
    pub fn begin(&mut self, scene: &Scene) {
        let sizes = self.of_hinges.iter_mut().enumerate();
        sizes.for_each(|(i, size)| *size = scene.coordinate_scale(i));
        self.rate = 1.0 / (scene.end_time - scene.initial.time).max(f64::MIN_POSITIVE);
        self.inertias = None;
    }

    /// The largest rate so far, or one radian in the whole run.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Notes which hinges are free in the mode that follows.
    pub fn enter(&mut self, free: &[usize]) {
        self.of_free.clear();
        self.of_free.extend(free.iter().map(|&i| self.of_hinges[i]));
    }

    /// Notes angular rates of the main body.
    pub fn saw_omega(&mut self, omega: &[f64]) {
        self.rate = largest(self.rate, omega.iter().copied());
    }

    /// Notes τ of the free hinges.
    pub fn saw_tau(&mut self, tau: &[f64]) {
        self.rate = largest(self.rate, tau.iter().zip(&self.of_free).map(|(tau, size)| tau / size));
    }

    /// Notes the inertias of a mode whose variables have momenta, or that they have none.
    pub fn weigh(&mut self, inertias: Option<EffectiveInertias<f64>>) {
        self.inertias = inertias;
    }

    /// Notes accelerations, which soon make rates: ω̇, τ̇ of the free hinges, and that of the mass centre.
    pub fn saw_accelerations(&mut self, omega_dot: Vec3<f64>, tau_dot: &[f64], linear: Vec3<f64>) {
        let linear = if self.length > 0.0 { linear.norm() / self.length } else { 0.0 };
        let of_hinges = tau_dot.iter().zip(&self.of_free).map(|(tau_dot, size)| tau_dot / size);
        let fastest = of_hinges.chain(omega_dot.to_array()).fold(linear, |a, b| a.max(b.abs()));
        self.rate = largest(self.rate, [(2.0 * START * fastest).sqrt()].into_iter());
    }

    /// Writes the size of each variable.
    pub fn write(&self, layout: &VariableLayout, sizes: &mut [f64]) {
        sizes.fill(1.0);
        sizes[layout.omega()].fill(self.rate);
        sizes[layout.beta()].copy_from_slice(&self.of_free);
        for (size, of_hinge) in sizes[layout.hinge_motion()].iter_mut().zip(&self.of_free) {
            *size = of_hinge * self.rate;
        }
        if let Some(EffectiveInertias { main, hinges }) = &self.inertias {
            sizes[layout.angular_impulse()].fill(main * self.rate);
            for (size, inertia) in sizes[layout.hinge_motion()].iter_mut().zip(hinges) {
                *size *= inertia;
            }
        }
        if let [displacement @ .., vx, vy, vz] = &mut sizes[layout.thrust_motion()] {
            displacement.fill(self.length);
            [*vx, *vy, *vz] = [self.length * self.rate; 3];
        }
    }
}

/// The largest size of these and of one before; what is no number any more is no size.
fn largest(before: f64, rates: impl Iterator<Item = f64>) -> f64 {
    rates.map(f64::abs).filter(|size| size.is_finite()).fold(before, f64::max)
}

/// How far from O something from outside can act, about.
fn distance(scene: &Scene, one: &External) -> f64 {
    let inward = std::iter::successors(one.body, |&body| scene.bodies[body].inboard);
    one.point.norm() + inward.map(|body| scene.bodies[body].mount.point.norm()).sum::<f64>()
}

/// Which hinged bodies are wheels, with a mass or without: nothing hangs on one, and it looks the same however it has
/// turned.
pub(crate) fn balanced(scene: &Scene) -> Vec<bool> {
    let is_wheel = |body: &Body| {
        let MassProperties { center_of_mass, inertia, .. } = body.mass_properties;
        let across = center_of_mass - body.axis * center_of_mass.dot(body.axis);
        let about = body.axis.dot(inertia * body.axis);
        let other = 0.5 * (inertia.trace() - about);
        let rest = inertia + Sym3::outer(body.axis) * (other - about);
        let uneven = rest + Sym3::diagonal(other, other, other) * -1.0;
        let turns = !body.joint.slides();
        turns
            && across.norm() <= EVEN * center_of_mass.norm()
            && uneven.largest_entry() <= EVEN * (about + other)
    };
    let mut all: Vec<bool> = scene.bodies.iter().map(is_wheel).collect();
    scene.bodies.iter().filter_map(|body| body.inboard).for_each(|inboard| all[inboard] = false);
    all
}

/// How far from O matter of the satellite can be, about: hinge distances along a branch, and the
/// radius of gyration at its end.
pub(crate) fn reach(scene: &Scene) -> f64 {
    let of_body = |body: &MassProperties| {
        let trace = body.inertia.trace();
        let gyration =
            if body.mass > 0.0 { (0.5 * trace / body.mass).max(0.0).sqrt() } else { 0.0 };
        body.center_of_mass.norm() + gyration
    };
    let mut farthest = of_body(&scene.main_body);
    let mut of_hinges: Vec<f64> = Vec::with_capacity(scene.bodies.len());
    for body in &scene.bodies {
        let inboard = body.inboard.map_or(0.0, |inboard| of_hinges[inboard]);
        let of_hinge = inboard + body.mount.point.norm();
        farthest = farthest.max(of_hinge + of_body(&body.mass_properties));
        of_hinges.push(of_hinge);
    }
    farthest
}
