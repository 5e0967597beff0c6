use nboom_model::Thrust;
use nboom_scalar::{Real, Vec3, Wrench};

/// A [`Thrust`] on the main body while it is on.
#[derive(Clone, Copy, Debug)]
pub struct ThrustForce<R> {
    /// The force, main-body axes.
    pub force: Vec3<R>,
    /// Where it acts, from O, main-body axes.
    pub point: Vec3<R>,
    /// Force and moment about O, main-body axes.
    pub wrench: Wrench<R>,
}

impl<R: Real> ThrustForce<R> {
    /// That of this thrust.
    pub fn new(thrust: &Thrust) -> Self {
        let (point, force) = (Vec3::constant(thrust.point), Vec3::constant(thrust.force));
        Self { force, point, wrench: Wrench::of_force(point, force) }
    }
}

/// Whether a thrust is on at `time`.
pub fn thrust_acts(thrust: &Thrust, time: f64) -> bool {
    thrust.on <= time && time < thrust.off
}

/// When a thrust next starts, or stops if it `acts`; that may be over.
pub fn thrust_change(thrust: &Thrust, acts: bool) -> f64 {
    if acts { thrust.off } else { thrust.on }
}
