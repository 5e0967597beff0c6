use nboom_model::Scene;
use nboom_scalar::{Real, Vec3};

/// Uniform gravity as an acceleration −g ĝ, inertial axes; zero without gravity.
///
/// It never enters an evaluation: it accelerates all bodies alike, and the mass centre falls in
/// closed form.
pub fn gravity<R: Real>(scene: &Scene) -> Vec3<R> {
    scene.gravity.map_or(Vec3::zero(), |gravity| {
        Vec3::constant(gravity.up) * R::constant(-gravity.acceleration)
    })
}

/// Potential energy in gravity of the whole mass with its centre at `position`, inertial axes; zero
/// at the inertial origin.
pub fn gravity_potential(scene: &Scene, position: Vec3<f64>) -> f64 {
    -scene.total_mass() * gravity(scene).dot(position)
}
