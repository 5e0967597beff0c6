//! Hinged bodies in words.

use nboom_model::{BodyDraft, Joint, KickOffSpring, MOST_BODIES, MassProperties, Mount, Repeat};
use nboom_scalar::{Mat3, Sym3, Vec3};

use super::fields::{Fields, Reader};
use super::stations::Materials;
use super::{check_body_name, hinges};
use crate::words;

/// What stands for a body of which something is missing, so that reading goes on.
const ANY_MASS: f64 = 1.0;

impl Reader<'_, '_> {
    /// Mass properties; whatever is missing has been reported.
    pub fn mass_properties(&mut self, fields: &Fields<'_>) -> MassProperties {
        let mass = self.number(fields, "mass").unwrap_or(ANY_MASS);
        let mass_centre = self.vector(fields, "mass_centre").unwrap_or_else(Vec3::zero);
        let inertia = self.inertia(fields, "inertia");
        let any = Sym3::diagonal(ANY_MASS, ANY_MASS, ANY_MASS);
        MassProperties::new(mass, mass_centre, inertia.unwrap_or(any))
    }

    /// A body with its joint, in a table whose keys are not yet checked.
    pub fn body(&mut self, fields: &Fields<'_>, materials: &Materials) -> BodyDraft {
        self.check_keys(fields);
        let name = self.body_name(fields).unwrap_or_default();
        let mass_properties = self.mass_properties(fields);
        let mut body = BodyDraft::new(name, mass_properties, Vec3::zero(), Vec3::unit_x());
        body.on = self.text(fields, "on").map(str::to_owned);
        let tip = self.vector(fields, "tip");
        body.tip = tip.unwrap_or_else(|| words::tip_of(&mass_properties));
        for joint in Joint::ALL {
            let Some(table) = self.table(fields, joint.name()) else { continue };
            body.mount = self.mount(&table);
            body.axis = self.direction(&table, "axis").unwrap_or(body.axis);
            hinges::read(self, joint, &table, &mut body);
        }
        body.hinge.kick_off = self.table(fields, "kick_off").and_then(|t| self.kick_off(&t));
        body.rotors = self.rotors(fields);
        body.externals = self.externals(fields);
        body.couplings = self.couplings(fields, body.joint);
        body.repeat = self.table(fields, "repeat").and_then(|repeat| {
            let count = self.count(&repeat, "count", MOST_BODIES);
            let about = self.direction(&repeat, "about");
            Some(Repeat { count: count?, about: about? })
        });
        body.structure = self.structure(fields, materials);
        body.shape = self.shape(fields, &mass_properties);
        body
    }

    /// A name that fits into a line of text.
    fn body_name<'t>(&mut self, fields: &Fields<'t>) -> Option<&'t str> {
        let name = self.text(fields, "name")?;
        if let Err((found, expected)) = check_body_name(name) {
            self.error(&fields.place("name"), "name", &found, expected);
        }
        Some(name)
    }

    fn mount(&mut self, hinge: &Fields<'_>) -> Mount {
        let point = self.vector(hinge, "at").unwrap_or_else(Vec3::zero);
        let axes = self.table(hinge, "axes").and_then(|axes| self.rotation(&axes));
        Mount { point, rot_inboard_from_hinge: axes.unwrap_or_else(Mat3::identity) }
    }

    fn kick_off(&mut self, fields: &Fields<'_>) -> Option<KickOffSpring> {
        let main_body_point = self.vector(fields, "main_body_end");
        let body_point = self.vector(fields, "end");
        let coefficients = self.numbers(fields, "force");
        let limit_length = self.number(fields, "limit");
        Some(KickOffSpring {
            main_body_point: main_body_point?,
            body_point: body_point?,
            coefficients: coefficients?,
            limit_length: limit_length?,
        })
    }
}
