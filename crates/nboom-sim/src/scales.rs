use nboom_model::{MassProperties, Scene};

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
