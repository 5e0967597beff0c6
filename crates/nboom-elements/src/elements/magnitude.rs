use nboom_scalar::Wrench;

use super::Elements;

impl Elements<f64> {
    /// Sum of all torques about hinges, each times the size of its hinge, and of all torques from outside, with every
    /// term by its magnitude. It is an energy: what is left where the terms cancel is rounding if it is nothing beside
    /// this sum.
    ///
    /// β \[rad; L\] and τ \[rad/T; L/T\] are those of all hinges of the scene, `lengths` \[L\] those of the lines, `sizes`
    /// \[rad; L\] those of the hinges; forces from outside act no farther from O than `reach` \[L\]. Friction is left out.
    pub fn magnitude(
        &self,
        [beta, tau]: [&[f64]; 2],
        lengths: impl Fn(usize) -> f64,
        sizes: impl Fn(usize) -> f64,
        reach: f64,
    ) -> f64 {
        let hinges = self.torques.iter().enumerate();
        let torques = hinges.map(|(i, law)| law.magnitude(beta[i], tau[i]) * sizes(i));
        let couplings = self.couplings.iter().map(|one| one.magnitude([beta, tau], &sizes));
        let lines = self.lines.iter().enumerate();
        let lines = lines.map(|(i, line)| line.reading(lengths(i)).force.abs() * line.size);
        let pushes = self.pushes.iter().map(|push| push.magnitude(reach));
        let commanded = self
            .commanded
            .map_or(0.0, |Wrench { moment, force }| moment.norm() + force.norm() * reach);
        torques.sum::<f64>()
            + couplings.sum::<f64>()
            + lines.sum::<f64>()
            + pushes.sum::<f64>()
            + commanded
    }
}

#[cfg(test)]
mod tests {
    use nboom_model::{
        Appendage, Coupling, External, ExternalKind, Hinge, KickOffSpring, MassProperties, Mode,
        Mount, Scene, SceneDescription, Segment, Spring, WeldedTree,
    };
    use nboom_scalar::{Sym3, Vec3};

    use super::*;
    use crate::Commands;

    const BETA: [f64; 2] = [0.5, -0.25];
    const TAU: [f64; 2] = [2.0, 3.0];

    fn length(_line: usize) -> f64 {
        1.5
    }

    fn size(hinge: usize) -> f64 {
        [1.0, 7.0][hinge]
    }

    /// What `change` makes of the sum of two hinges without forces.
    fn sum(change: impl Fn(&mut SceneDescription), commands: impl Fn(&mut Commands)) -> f64 {
        let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
        let mut description = SceneDescription::at_rest("two", body, 10.0);
        let segment = Segment { length: 1.0, mass_properties: body, hinge: Hinge::free() };
        let segments = vec![segment; 2];
        description.attach(&Appendage::Regular { mount: Mount::at(Vec3::zero()), segments });
        change(&mut description);
        let scene = Scene::new(description).expect("physical bodies");
        let mut mode = Mode::at_start(&scene);
        // Kick-off springs and thrusters push.
        mode.pieces.fill(0);
        mode.externals.fill(1);
        let mut elements =
            Elements::<f64>::new(&scene, &mode, &WeldedTree::new(&scene, &mode, &[0.0; 2]));
        let mut commanded = Commands::none(&scene);
        commands(&mut commanded);
        elements.command(&commanded);
        elements.magnitude([&BETA, &TAU], length, size, 3.0)
    }

    #[test]
    fn each_element_adds_its_terms_by_their_magnitudes() {
        let found = |change: fn(&mut SceneDescription)| sum(change, |_| ());
        assert_eq!(found(|_| ()), 0.0);
        // −2 (β − 0.5) is zero where it is.
        let spring = found(|scene| {
            let spring = Spring { linear: -2.0, preload_angle: -0.5, ..Spring::default() };
            scene.bodies[0].hinge.spring = spring;
        });
        assert_eq!(spring, 2.0 * 0.5 + 2.0 * 0.5);
        let coupling = Coupling {
            hinges: [0, 1],
            ratio: -4.0,
            stiffness: 5.0,
            rest: 0.75,
            damping: 0.5,
            is_mutual: true,
        };
        let pull = 5.0 * (0.5 + 4.0 * 0.25 + 0.75) + 0.5 * (2.0 + 4.0 * 3.0);
        let coupled = |one: Coupling| sum(|scene| scene.couplings.push(one), |_| ());
        assert_eq!(coupled(coupling), pull * (1.0 + 4.0 * 7.0));
        // One that acts on the first alone follows the second and not the first.
        let pull = 5.0 * (4.0 * 0.25 + 0.75) + 0.5 * (4.0 * 3.0);
        assert_eq!(coupled(Coupling { is_mutual: false, ..coupling }), pull);
        let line = found(|scene| {
            scene.bodies[1].hinge.kick_off = Some(KickOffSpring {
                main_body_point: Vec3::unit_x() * 2.0,
                body_point: Vec3::unit_y() * 3.0,
                coefficients: [-6.0, 0.0, 0.0, 0.0],
                limit_length: 9.0,
            });
        });
        assert_eq!(line, 6.0 * (2.0 + 3.0));
        let force = found(|scene| {
            let thrust = External::thrust(Vec3::unit_z() * -8.0, Vec3::unit_x(), [0.0, 5.0]);
            scene.externals.push(External { body: Some(1), ..thrust });
        });
        assert_eq!(force, 8.0 * 3.0);
        let torque = found(|scene| {
            let thrust = External::thrust(Vec3::unit_z() * -8.0, Vec3::unit_x(), [0.0, 5.0]);
            scene.externals.push(External { kind: ExternalKind::Torque, ..thrust });
        });
        assert_eq!(torque, 8.0);
    }

    #[test]
    fn commands_add_their_magnitudes() {
        let hinge = sum(|_| (), |commands| commands.hinge_torques_mut()[1] = -9.0);
        assert_eq!(hinge, 9.0 * 7.0);
        let main_body = |commands: &mut Commands| {
            let (moment, force) = (Vec3::unit_x() * -10.0, Vec3::unit_y() * 11.0);
            commands.main_body = Wrench { moment, force };
        };
        assert_eq!(sum(|_| (), main_body), 10.0 + 11.0 * 3.0);
    }
}
