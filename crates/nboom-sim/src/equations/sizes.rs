use nboom_dynamics::EffectiveInertias;
use nboom_model::{MassProperties, Scene};
use nboom_scalar::Vec3;

use crate::equations::layout::VariableLayout;

/// Natural sizes of the variables: one for attitude and angles, a rate for rates, a length for the way
/// that the thrust displaces the mass centre. They follow the scene's units, so that no step depends
/// on these.
#[derive(Clone, Debug)]
pub(crate) struct Sizes {
    /// How far matter and the thrust are from O.
    length: f64,
    /// The largest rate so far \[1/T\].
    rate: f64,
    /// What makes momenta of rates, of a mode that has them.
    inertias: Option<EffectiveInertias<f64>>,
}

/// Angle \[rad\] through which accelerations act at least.
const START: f64 = 1e-3;

impl Sizes {
    /// At the beginning of `scene`.
    pub fn of(scene: &Scene) -> Self {
        let point = scene.thrust.map_or(0.0, |thrust| thrust.point.norm());
        let mut sizes = Self { length: reach(scene).max(point), rate: 0.0, inertias: None };
        sizes.begin(scene);
        sizes
    }

    /// Begins anew with `scene`, whose satellite is the same: less than one radian in the whole run is no
    /// motion.
    pub fn begin(&mut self, scene: &Scene) {
        self.rate = 1.0 / (scene.end_time - scene.initial.time).max(f64::MIN_POSITIVE);
        self.inertias = None;
    }

    /// The largest rate so far, or one radian in the whole run.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Notes rates; what is no number any more is no size.
    pub fn saw(&mut self, rates: &[f64]) {
        let sizes = rates.iter().map(|rate| rate.abs()).filter(|size| size.is_finite());
        self.rate = sizes.fold(self.rate, f64::max);
    }

    /// Notes the inertias of a mode whose variables have momenta, or that they have none.
    pub fn weigh(&mut self, inertias: Option<EffectiveInertias<f64>>) {
        self.inertias = inertias;
    }

    /// Notes accelerations, which soon make rates: angular ones, and one of the mass centre.
    pub fn saw_accelerations(&mut self, angular: impl Iterator<Item = f64>, linear: Vec3<f64>) {
        let linear = if self.length > 0.0 { linear.norm() / self.length } else { 0.0 };
        let largest = angular.fold(linear, |largest, rate| largest.max(rate.abs()));
        self.saw(&[(2.0 * START * largest).sqrt()]);
    }

    /// Writes the size of each variable.
    pub fn write(&self, layout: &VariableLayout, sizes: &mut [f64]) {
        sizes.fill(1.0);
        sizes[layout.omega()].fill(self.rate);
        sizes[layout.hinge_motion()].fill(self.rate);
        if let Some(EffectiveInertias { main, hinges }) = &self.inertias {
            sizes[layout.angular_impulse()].fill(main * self.rate);
            for (size, inertia) in sizes[layout.hinge_motion()].iter_mut().zip(hinges) {
                *size = inertia * self.rate;
            }
        }
        if let [displacement @ .., vx, vy, vz] = &mut sizes[layout.thrust_motion()] {
            displacement.fill(self.length);
            [*vx, *vy, *vz] = [self.length * self.rate; 3];
        }
    }
}

/// How far from O matter of the satellite can be, about: hinge distances along a branch, and the
/// radius of gyration at its end.
pub(crate) fn reach(scene: &Scene) -> f64 {
    let of_body = |body: &MassProperties| {
        let trace = body.inertia.xx + body.inertia.yy + body.inertia.zz;
        body.center_of_mass.norm() + (0.5 * trace / body.mass).max(0.0).sqrt()
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
