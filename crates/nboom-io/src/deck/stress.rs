use nboom_model::{
    Finding, MassProperties, Material, MaterialDefect, Scene, SegmentStructure, Station, Structure,
    StructureDefect, StructureError, StructurePlace,
};
use nboom_scalar::Vec3;

use super::assignment::MOST_STATIONS;
use super::builder::Builder;
use super::shown;
use super::symbols::Group;
use super::values::{Key, plain};

/// What messages expect of most numbers of the stress groups.
const POSITIVE: &str = "a positive value";

impl Builder<'_, '_, '_> {
    /// The stress groups, Table 16.1, if stresses are asked for and the groups are there; their
    /// errors are reported.
    pub fn stress(&mut self) -> Option<Vec<SegmentStructure>> {
        if self.values.has_slices() {
            return Some((0..self.sizes.segments).map(|i| self.stress_segment(i)).collect());
        }
        let position = |group| self.values.groups.get(&group).copied();
        let present = (position(Group::Dynsta), position(Group::Dynstb));
        let wanted = self.values.wants_stresses();
        match present {
            (None, None) if wanted => {
                let interval = shown(self.values.real("INSTR", 0));
                let expected = "&DYNSTA; no stresses are computed";
                self.warn(plain("INSTR"), 0, interval, expected);
            }
            (None, Some(at)) if wanted => {
                self.report.error(at, "&DYNSTB", "&DYNSTB alone", "&DYNSTA before it");
            }
            (Some(at), _) | (None, Some(at)) => {
                let expected = "INSTR above 0 for stresses; the stress groups are ignored";
                self.report.warn(at, "INSTR", "0", expected);
            }
            (None, None) => {}
        }
        None
    }

    /// The structure of `scene`. The motion follows the segments; slices that differ from them, and what is
    /// doubtful, give warnings.
    pub fn structure(&mut self, scene: &Scene) -> Option<Structure> {
        let checked = Structure::with_differing_slices(scene, self.structures.take()?);
        // Errors have been reported segment by segment.
        let (structure, differences) = checked.ok()?;
        let warnings = structure.warnings(scene);
        let all = differences.iter().chain(&warnings);
        all.for_each(|warning| self.report_structure(warning, Self::warn));
        Some(structure)
    }

    fn stress_segment(&mut self, i: usize) -> SegmentStructure {
        let count = self.count_in("NSTA", i, 1..=MOST_STATIONS);
        self.warn_ignored_of_stations(i, count);
        let segment = SegmentStructure {
            pulse_constant: self.required_element(plain("CMN"), i),
            material: self.material(i),
            stations: (0..count).map(|j| self.station(i, j)).collect(),
        };
        for error in segment.errors(self.label_of_segment(i)) {
            self.report_structure(&error, Self::error);
        }
        segment
    }

    fn material(&mut self, i: usize) -> Material {
        let youngs_modulus = self.required_element(plain("E"), i);
        Material::elastic(youngs_modulus, self.values.real("XNU", i))
    }

    /// Finds the assignment of the deck that is responsible for an error in the structure.
    fn report_structure(
        &mut self,
        error: &StructureError,
        report: fn(&mut Self, Key, usize, String, &str),
    ) {
        let StructureError::Segment { place, defect } = error else { return };
        let (key, index) = responsible(self.number_of_segment(&place.segment), place, defect);
        let Finding { found, expected } = defect.finding();
        report(self, key, index, found, &expected);
    }

    fn station(&mut self, i: usize, j: usize) -> Station {
        let flat = MOST_STATIONS * i + j;
        let mass = self.values.real("DELM", flat);
        let center = self.values.reals(("DELC", i + 1, 0), 3 * j..3 * j + 3);
        let center_of_mass = Vec3::new(center[0], center[1], center[2]);
        let inertia = self.slice_inertia(("DLI", i + 1, j + 1));
        Station {
            distance_from_hinge: self.values.real("S", flat),
            slice: MassProperties::new(mass, center_of_mass, inertia),
            section: self.section(i, j),
        }
    }

    fn slice_inertia(&mut self, key: Key) -> nboom_scalar::Sym3<f64> {
        let has_moments = [0, 4, 8].iter().all(|&d| self.values.cell(key, d).is_some());
        if has_moments {
            return self.inertia(key, 0);
        }
        let given = self.values.arrays.get(&key).filter(|array| !array.damaged);
        if given.is_some_and(|array| array.cells.iter().any(Option::is_some)) {
            let found = "a matrix without all three moments".to_owned();
            self.error(key, 0, found, "moments on the diagonal");
        }
        nboom_scalar::Sym3::zero()
    }

    /// A count in range, or 0.
    pub fn count_in(
        &mut self,
        name: &'static str,
        index: usize,
        range: std::ops::RangeInclusive<usize>,
    ) -> usize {
        let (least, most) = (*range.start(), *range.end());
        let expected = format!("a number from {least} to {most}");
        let count = self.element(plain(name), index, &expected);
        if let Some(wrong) = count.filter(|n| !(least as f64..=most as f64).contains(n)) {
            self.error(plain(name), index, shown(wrong), &expected);
            return 0;
        }
        count.map_or(0, |count| count as usize)
    }

    pub fn positive_element(&mut self, key: Key, index: usize) -> f64 {
        let value = self.required_element(key, index);
        if value <= 0.0 {
            self.error(key, index, shown(value), POSITIVE);
        }
        value
    }

    /// An element that must be given and positive, or 1.
    fn required_element(&mut self, key: Key, index: usize) -> f64 {
        self.element(key, index, POSITIVE).unwrap_or(1.0)
    }

    /// An element that must be given.
    fn element(&mut self, key: Key, index: usize, expected: &str) -> Option<f64> {
        let value = self.values.cell(key, index).map(|cell| cell.value);
        if value.is_none() && !self.values.is_damaged(key) {
            self.error(key, index, "nothing".to_owned(), expected);
        }
        value
    }
}

/// The symbol and the element in storage order, for segment `i`.
fn responsible(i: usize, place: &StructurePlace, defect: &StructureDefect) -> (Key, usize) {
    let j = place.station.unwrap_or_default();
    let flat = MOST_STATIONS * i + j;
    match defect {
        StructureDefect::PulseConstant(_) | StructureDefect::LongPulse { .. } => (plain("CMN"), i),
        StructureDefect::Material(MaterialDefect::PoissonsRatio(_)) => (plain("XNU"), i),
        StructureDefect::Material(_) => (plain("E"), i),
        StructureDefect::Order { .. }
        | StructureDefect::NotAtHinge(_)
        | StructureDefect::SliceInboard { .. } => (plain("S"), flat),
        StructureDefect::SliceMass(_) | StructureDefect::Mass { .. } => (plain("DELM"), flat),
        StructureDefect::CenterOfMass { .. } => (("DELC", i + 1, 0), 3 * j),
        // The inertia of a slice, or of all; what is not finite is an overflow in one.
        _ => (("DLI", i + 1, j + 1), 0),
    }
}
