//! What a scene has besides bodies: times, initial motion, gravity, thrust.

use nboom_model::{External, Gravity, InitialMotion, SceneDescription};
use nboom_scalar::Vec3;

use super::fields::{Fields, Reader};

impl Reader<'_, '_> {
    /// The scene without hinged bodies.
    pub fn surroundings(&mut self, root: &Fields<'_>, name: &str) -> SceneDescription {
        let main_body = self.table(root, "main_body").map(|fields| self.mass_properties(&fields));
        let main_body = main_body.unwrap_or_else(super::any_body);
        let (mut start, mut end) = (0.0, None);
        if let Some(run) = self.table(root, "run") {
            start = self.number(&run, "start").unwrap_or(0.0);
            end = self.number(&run, "end");
        }
        let mut scene = SceneDescription::at_rest(name, main_body, end.unwrap_or(start));
        scene.initial.time = start;
        if let Some(initial) = self.table(root, "initial") {
            self.initial(&initial, &mut scene.initial);
        }
        if let Some(main_body) = root.inner("main_body") {
            scene.base = self.base(&main_body);
            let given = root
                .inner("initial")
                .map(|initial| ["rate", "velocity"].map(|key| initial.has(key)));
            scene.begin_driven(given.unwrap_or_default());
            scene.rotors = self.rotors(&main_body);
            scene.externals = self.externals(&main_body);
        }
        scene.gravity = self.table(root, "gravity").and_then(|fields| self.gravity(&fields));
        if let Some(thrust) = self.table(root, "thrust").and_then(|fields| self.thrust(&fields)) {
            scene.externals.insert(0, thrust);
        }
        scene
    }

    fn initial(&mut self, fields: &Fields<'_>, motion: &mut InitialMotion) {
        if let Some(axes) = self.table(fields, "attitude") {
            motion.attitude = self.attitude(&axes).unwrap_or(motion.attitude);
        }
        motion.omega_body = self.angles(fields, "rate").unwrap_or_else(Vec3::zero);
        motion.position_inertial = self.vector(fields, "position").unwrap_or_else(Vec3::zero);
        motion.velocity_inertial = self.vector(fields, "velocity").unwrap_or_else(Vec3::zero);
    }

    fn gravity(&mut self, fields: &Fields<'_>) -> Option<Gravity> {
        let (acceleration, up) =
            (self.number(fields, "acceleration"), self.direction(fields, "up"));
        let (acceleration, up) = (acceleration?, up?);
        if acceleration < 0.0 {
            let expected = "none below zero; turn `up` round";
            let found = crate::deck::shown(acceleration);
            self.error(&fields.place("acceleration"), "acceleration", &found, expected);
        }
        (acceleration > 0.0).then_some(Gravity { acceleration, up })
    }

    fn thrust(&mut self, fields: &Fields<'_>) -> Option<External> {
        let (force, point) = (self.vector(fields, "force"), self.vector(fields, "point"));
        let (on, off) = (self.number(fields, "from"), self.number(fields, "until"));
        self.warn_if_zero(fields, "force");
        Some(External::thrust(force?, point?, [on?, off?]))
    }
}
