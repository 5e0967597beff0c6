//! Materials, sections and stations in words.

use std::collections::HashMap;

use nboom_model::{
    Finding, MassProperties, Material, MaterialDefect, SectionShape, SegmentStructure, Station,
    StructureDefect, Vertex,
};
use nboom_scalar::{Sym3, Vec3};

use super::catalog::SLICES;
use super::fields::{Fields, Reader};
use super::suggest;
use crate::diagnostic::quoted;

/// Materials by name.
pub(super) type Materials = HashMap<String, Material>;

/// Poisson's ratio of most metals.
const USUAL_POISSONS_RATIO: f64 = 0.3;

/// What stands for a wrong or unknown material, so that reading goes on.
const ANY_MATERIAL: Material = Material::elastic(1.0, USUAL_POISSONS_RATIO);

impl Reader<'_, '_> {
    /// Adds the materials of one file.
    pub fn materials(&mut self, root: &Fields<'_>, materials: &mut Materials) {
        let Some(kind) = root.kind.key_called("materials").and_then(|key| key.holds.table()) else {
            return;
        };
        for entry in self.named(root, "materials") {
            let Some(fields) = self.open(kind, &entry.key, &entry.node) else { continue };
            let material = self.properties(&fields);
            if materials.insert(entry.key.clone(), material).is_some() {
                self.error(&entry.key_at, &entry.key, "a material twice", "each name once");
            }
        }
    }

    /// The properties of a material; those of any material if some are wrong.
    fn properties(&mut self, fields: &Fields<'_>) -> Material {
        let [youngs_modulus, poissons_ratio, yield_stress, ultimate_stress] =
            ["youngs_modulus", "poissons_ratio", "yield_stress", "ultimate_stress"]
                .map(|key| self.number(fields, key));
        let material = Material {
            youngs_modulus: youngs_modulus.unwrap_or(ANY_MATERIAL.youngs_modulus),
            poissons_ratio: poissons_ratio.unwrap_or(USUAL_POISSONS_RATIO),
            yield_stress,
            ultimate_stress,
        };
        let defects = material.defects();
        for defect in &defects {
            let key = match defect {
                MaterialDefect::YoungsModulus(_) => "youngs_modulus",
                MaterialDefect::PoissonsRatio(_) => "poissons_ratio",
                MaterialDefect::YieldStress(_) => "yield_stress",
                _ => "ultimate_stress",
            };
            let Finding { found, expected } = defect.finding();
            self.error(&fields.place(key), key, &found, &expected);
        }
        if defects.is_empty() { material } else { ANY_MATERIAL }
    }

    /// What stresses need of a body, if it has stations or says it.
    pub fn structure(
        &mut self,
        body: &Fields<'_>,
        materials: &Materials,
    ) -> Option<SegmentStructure> {
        let stations: Vec<Station> = self
            .tables(body, "station")
            .iter()
            .filter_map(|station| self.station(station))
            .collect();
        let material = self.material(body, materials);
        // What it allows is asked for when bodies and slices are compared.
        self.choice(body, "slices", SLICES);
        let pulse_constant = self.pulse_constant(body);
        if stations.is_empty() && pulse_constant.is_none() {
            return None;
        }
        if !stations.is_empty() && !body.has("material") {
            let expected = "`material`, the name of its material, since the body has stations";
            self.error(&body.at, "material", "a body without it", expected);
        }
        let material = material.unwrap_or(ANY_MATERIAL);
        let none = SegmentStructure::default().pulse_constant;
        Some(SegmentStructure {
            pulse_constant: pulse_constant.unwrap_or(none),
            material,
            stations,
        })
    }

    /// The constant of the pulses of its latch, which is right even where nothing asks for loads.
    fn pulse_constant(&mut self, body: &Fields<'_>) -> Option<f64> {
        let constant = self.number(body, "pulse_constant")?;
        if constant > 0.0 {
            return Some(constant);
        }
        let Finding { found, expected } = StructureDefect::PulseConstant(constant).finding();
        self.error(&body.place("pulse_constant"), "pulse_constant", &found, &expected);
        None
    }

    fn material(&mut self, body: &Fields<'_>, materials: &Materials) -> Option<Material> {
        let name = self.text(body, "material")?;
        if let Some(material) = materials.get(name) {
            return Some(*material);
        }
        let help =
            suggest::nearest(name, materials.keys().map(String::as_str)).map(suggest::question);
        let (at, expected) = (body.place("material"), "the name of a table [materials.NAME]");
        self.report.error_with_help(self.sources, &at, "material", &quoted(name), expected, help);
        None
    }

    fn station(&mut self, fields: &Fields<'_>) -> Option<Station> {
        let distance_from_hinge = self.number(fields, "at");
        let mass = self.number(fields, "mass").unwrap_or(0.0);
        let mass_centre = self.vector(fields, "mass_centre").unwrap_or_else(Vec3::zero);
        let inertia = self.inertia(fields, "inertia").unwrap_or_else(Sym3::zero);
        let section = self.table(fields, "section").and_then(|section| self.section(&section));
        Some(Station {
            distance_from_hinge: distance_from_hinge?,
            slice: MassProperties::new(mass, mass_centre, inertia),
            section: section?,
        })
    }

    fn section(&mut self, fields: &Fields<'_>) -> Option<SectionShape> {
        if let Some(tube) = self.table(fields, "tube") {
            let (radius, thickness) =
                (self.number(&tube, "radius"), self.number(&tube, "thickness"));
            let shape = SectionShape::Tube { radius: radius?, thickness: thickness? };
            self.check_walls(fields, &shape);
            return Some(shape);
        }
        let corners = self.rows::<3>(fields, "polygon");
        let vertex = |[xi, zeta, thickness]: [f64; 3]| Vertex { xi, zeta, thickness };
        let shape = SectionShape::Polygon(corners.into_iter().map(vertex).collect());
        self.check_walls(fields, &shape);
        Some(shape)
    }
}
