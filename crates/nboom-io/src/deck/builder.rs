use nboom_model::{Appendage, MassProperties, Mount, SceneDescription, SegmentStructure};
use nboom_scalar::{Sym3, Vec3};

use super::layout::AppendageSegments;
use super::shown;
use super::values::{Key, Sizes, Values, plain};
use crate::angles;
use crate::diagnostic::Report;

/// Share of an inertia's largest entry by which it may fail to be symmetric.
const SYMMETRY_TOLERANCE: f64 = 1e-9;

/// Deviation from length 1 that counts as rounding in the deck.
const UNIT_TOLERANCE: f64 = 1e-6;

/// Makes the parts of a scene from a deck's values.
///
/// A wrong part is reported and replaced by one that passes all further checks.
pub(crate) struct Builder<'v, 'r, 'f> {
    pub values: &'v Values,
    pub sizes: Sizes,
    pub report: &'r mut Report<'f>,
    /// Those of each segment, if the stress groups are read.
    pub structures: Option<Vec<SegmentStructure>>,
}

impl Builder<'_, '_, '_> {
    pub fn description(&mut self, name: &str) -> SceneDescription {
        let mass = self.values.get("EMM", 0).unwrap_or(1.0);
        let center_of_mass = self.values.vector("BBM", 0);
        let main_body = MassProperties::new(mass, center_of_mass, self.inertia(plain("HM"), 0));
        let initial = self.initial_motion();
        let end_time = self.values.get("TF", 0).unwrap_or(initial.time);
        let mut description = SceneDescription::at_rest(name, main_body, end_time);
        description.gravity = self.gravity();
        description.externals.extend(self.thrust());
        description.initial = initial;
        for place in self.layout().unwrap_or_default() {
            description.attach(&self.appendage(&place));
        }
        description
    }

    fn appendage(&mut self, place: &AppendageSegments) -> Appendage {
        let [psi, theta, phi] = self.values.vector("FTSIK", place.appendage).to_array();
        let mount = Mount {
            point: self.values.vector("DBK", place.appendage),
            rot_inboard_from_hinge: angles::rotation_from_degrees(psi, theta, phi),
        };
        let mut segments: Vec<_> = place.segments.clone().map(|i| self.segment(i, place)).collect();
        self.check_release_times(place);
        match (place.is_paddle, segments.len()) {
            (true, 2) => {
                let paddle = segments.remove(1);
                Appendage::Paddle { mount, arm: segments.remove(0), paddle }
            }
            _ => Appendage::Regular { mount, segments },
        }
    }

    /// EMIK, CNIK and HIIK of a segment, or the sum of its slices.
    pub fn segment_mass(&mut self, i: usize) -> MassProperties {
        let structure = self.structures.as_ref().filter(|_| self.values.is_by_slices(i));
        if let Some(sum) = structure.and_then(|structures| structures[i].mass_properties()) {
            return sum;
        }
        let segments = self.sizes.segments;
        let component = |j| self.values.real("CNIK", i + j * segments);
        let center_of_mass = Vec3::new(component(0), component(1), component(2));
        let mass = self.values.get("EMIK", i).unwrap_or(1.0);
        MassProperties::new(mass, center_of_mass, self.inertia(plain("HIIK"), i))
    }

    /// The `number`th 3×3 matrix of an array, which must be symmetric; an entry that is not
    /// given is the opposite one, or zero.
    pub fn inertia(&mut self, key: Key, number: usize) -> Sym3<f64> {
        let entry = |i, j| self.values.cell(key, i + 3 * j + 9 * number).map(|cell| cell.value);
        let either = |i, j| entry(i, j).or(entry(j, i)).unwrap_or(0.0);
        let diagonal = [entry(0, 0), entry(1, 1), entry(2, 2)];
        let [Some(xx), Some(yy), Some(zz)] = diagonal else {
            return Sym3::diagonal(1.0, 1.0, 1.0);
        };
        let pairs = [(0, 1), (0, 2), (1, 2)];
        let products = pairs.map(|(i, j)| (either(i, j), either(j, i)));
        let entries = products.iter().flat_map(|&(a, b)| [a, b]).chain([xx, yy, zz]);
        let largest = entries.map(f64::abs).fold(0.0, f64::max);
        for ((i, j), (upper, lower)) in pairs.into_iter().zip(products) {
            if (upper - lower).abs() > SYMMETRY_TOLERANCE * largest {
                let other = self.values.label(key, i + 3 * j + 9 * number);
                let found = format!("{} beside {other} of {}", shown(lower), shown(upper));
                self.error(key, j + 3 * i + 9 * number, found, "a symmetric matrix");
                return Sym3::diagonal(1.0, 1.0, 1.0);
            }
        }
        let [xy, xz, yz] = products.map(|(upper, lower)| 0.5 * upper + 0.5 * lower);
        Sym3 { xx, yy, zz, xy, xz, yz }
    }

    /// A vector that must have length 1, scaled to it exactly.
    pub fn unit_vector(&mut self, name: &'static str) -> Option<Vec3<f64>> {
        super::required::require(name, self.values, self.report);
        let vector = self.values.vector(name, 0);
        let complete = (0..3).all(|i| self.values.get(name, i).is_some());
        if !complete {
            return None;
        }
        let length = vector.norm();
        if (length - 1.0).abs() <= UNIT_TOLERANCE {
            return Some(vector * (1.0 / length));
        }
        let [x, y, z] = vector.to_array().map(shown);
        let found = format!("({x}, {y}, {z}) of length {}", shown(length));
        self.error(plain(name), 0, found, "a unit vector");
        None
    }

    /// An error about one element; shown without subscripts where a vector is meant.
    pub fn error(&mut self, key: Key, index: usize, found: String, expected: &str) {
        let (at, label) = (self.values.position(key, index), self.values.label(key, index));
        self.report.error(at, &label, found, expected);
    }

    /// A warning about one element.
    pub fn warn(&mut self, key: Key, index: usize, found: String, expected: &str) {
        let (at, label) = (self.values.position(key, index), self.values.label(key, index));
        self.report.warn(at, &label, found, expected);
    }
}
