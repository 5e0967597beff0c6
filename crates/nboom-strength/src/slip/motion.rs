//! What of the slips concerns the motion; `docs/the-1970-program.md` has the evidence.

use nboom_model::{Scene, SceneDescription, TurnOrder, Withheld};

/// The moments about each hinge of a chain that its kick-off springs do not hand on to the hinge
/// inboard of it: what lies between the force that belongs to α, eq. (6.17) as printed, and that of β.
pub(super) fn withheld(scene: &Scene) -> Vec<Withheld> {
    let springs = (0..scene.bodies.len()).filter(|&i| scene.bodies[i].hinge.kick_off.is_some());
    let of_spring = |line: usize| {
        let inward = std::iter::successors(Some(line), |&i| scene.bodies[i].inboard);
        let in_chain = inward.filter(|&i| scene.adds_to_inboard_angle(i));
        in_chain.filter_map(move |outboard| {
            let inboard = scene.bodies[outboard].inboard?;
            Some(Withheld { line, outboard, inboard })
        })
    };
    springs.flat_map(of_spring).collect()
}

/// The inertia of each paddle turned by R_y(α₂) R_x(α₁), while the paddle itself turns by
/// R_x(α₁) R_y(α₂).
pub(super) fn turned(scene: &Scene) -> Vec<TurnOrder> {
    let paddles = (0..scene.bodies.len()).filter_map(|i| Some((i, scene.arm_of_paddle(i)?)));
    let order = |(paddle, arm)| TurnOrder { body: paddle, mount: arm, hinges: vec![paddle, arm] };
    paddles.map(order).collect()
}

/// The scene without the kick-off springs of appendages that have a paddle.
pub(super) fn without_springs_on_paddles(scene: &Scene) -> Scene {
    let mut description = SceneDescription::clone(scene);
    let hinges = 0..scene.bodies.len();
    let paddles = hinges.clone().filter(|&i| scene.arm_of_paddle(i).is_some());
    let with_paddle: Vec<usize> = paddles.map(|i| scene.label(i).appendage).collect();
    for i in hinges.filter(|&i| with_paddle.contains(&scene.label(i).appendage)) {
        description.bodies[i].hinge.kick_off = None;
    }
    scene.with_description(description).expect("a scene is one without some of its springs")
}

#[cfg(test)]
mod tests {
    use nboom_model::{
        Appendage, BodyShape, Hinge, KickOffSpring, MassProperties, Mount, Segment, Shapes, Solid,
    };
    use nboom_scalar::{Sym3, Vec3};

    use super::*;

    const SPRING: KickOffSpring = KickOffSpring {
        main_body_point: Vec3 { x: 0.0, y: 0.0, z: 0.0 },
        body_point: Vec3 { x: 0.0, y: 1.0, z: 0.0 },
        coefficients: [1.0, 0.0, 0.0, 0.0],
        limit_length: 1.0,
    };

    fn ball() -> MassProperties {
        MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0))
    }

    fn segment(kick_off: Option<KickOffSpring>) -> Segment {
        let hinge = Hinge { kick_off, ..Hinge::free() };
        Segment { length: 1.0, mass_properties: ball(), hinge }
    }

    fn scene(appendage: &Appendage) -> Scene {
        let mut description = SceneDescription::at_rest("balls", ball(), 1.0);
        description.attach(appendage);
        Scene::new(description).expect("balls are bodies")
    }

    #[test]
    fn a_spring_withholds_a_moment_from_every_hinge_inboard_of_its_own() {
        let segments = vec![segment(None), segment(None), segment(Some(SPRING))];
        let mount = Mount::at(Vec3::unit_y());
        let found = withheld(&scene(&Appendage::Regular { mount, segments }));
        // The force that belongs to α of a hinge is that of β less that of the next hinge's β.
        let of = |outboard: usize, inboard: usize| Withheld { line: 2, outboard, inboard };
        assert_eq!(found, [of(2, 1), of(1, 0)]);
    }

    #[test]
    fn bodies_without_their_springs_keep_names_and_shapes() {
        let (mount, paddle) = (Mount::at(Vec3::unit_y()), segment(None));
        let scene = scene(&Appendage::Paddle { mount, arm: segment(Some(SPRING)), paddle });
        let cube = BodyShape::around(Vec3::zero(), Solid::Box(Vec3::new(1.0, 1.0, 1.0)));
        let shapes = Shapes { main_body: Some(cube), bodies: vec![Some(cube)] };
        let names = ["arm", "paddle"].map(str::to_owned).to_vec();
        let scene = scene.with_names(names).with_shapes(shapes);
        let without = without_springs_on_paddles(&scene);
        assert_eq!(without.bodies[0].hinge.kick_off, None);
        assert_eq!((without.labels(), without.shapes()), (scene.labels(), scene.shapes()));
    }
}
