use nboom_scalar::{RigidInertia, Vec3};

use crate::{
    Errors, HingeLabel, MassProperties, Material, Scene, StructureDefect, StructureError,
    StructurePlace, structure_error,
};

/// How far the slices of a segment may differ from its own mass properties: shares of its mass,
/// of its radius of gyration about the hinge, and of its inertia about the hinge.
pub const SLICE_TOLERANCE: f64 = 1e-6;

/// What loads and stresses of sections need beside the motion, one entry for each hinged body
/// of a scene; checked.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    segments: Vec<SegmentStructure>,
}

/// Material, pulse and stations of one segment.
#[derive(Clone, Debug, PartialEq)]
pub struct SegmentStructure {
    /// c: impulse over peak of the pulses of the latch and stops of this segment's hinge \[T\], positive.
    pub pulse_constant: f64,
    /// What it is made of.
    pub material: Material,
    /// Outboard before inboard, the last one at the hinge; none where no loads are wanted.
    pub stations: Vec<Station>,
}

/// A section of a segment, and the slice from it to the next station outboard.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// S: from the inboard hinge along η, the second segment axis \[L\].
    pub distance_from_hinge: f64,
    /// The slice, whose mass may be zero; its mass centre from the inboard hinge, inertia about
    /// that centre, segment axes.
    pub slice: MassProperties,
    /// The walls.
    pub section: SectionShape,
}

/// The thin walls of a section, in the ξζ plane of the segment.
#[derive(Clone, Debug, PartialEq)]
pub enum SectionShape {
    /// A circular tube.
    Tube {
        /// R, to the middle of the wall \[L\].
        radius: f64,
        /// Of the wall \[L\].
        thickness: f64,
    },
    /// A closed polygon, vertices in order.
    Polygon(Vec<Vertex>),
}

/// A corner of a polygonal section, in the middle of the walls, and the wall to the next one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// ξ \[L\].
    pub xi: f64,
    /// ζ \[L\].
    pub zeta: f64,
    /// Of the wall \[L\].
    pub thickness: f64,
}

impl Structure {
    /// Checks the structure of every hinged body of `scene`, in its order.
    ///
    /// # Errors
    /// Everything that is wrong with it, slices that do not add up to their segment included.
    pub fn new(
        scene: &Scene,
        segments: Vec<SegmentStructure>,
    ) -> Result<Self, Errors<StructureError>> {
        let (structure, differences) = Self::with_differing_slices(scene, segments)?;
        if differences.is_empty() { Ok(structure) } else { Err(Errors(differences)) }
    }

    /// Checks a structure whose slices need not add up to their segment. Returns the structure, and
    /// where its slices do not.
    ///
    /// Motion and hinge loads then follow from the segment, station loads from the slices.
    ///
    /// # Errors
    /// Everything else that is wrong.
    pub fn with_differing_slices(
        scene: &Scene,
        segments: Vec<SegmentStructure>,
    ) -> Result<(Self, Vec<StructureError>), Errors<StructureError>> {
        let (found, expected) = (segments.len(), scene.bodies.len());
        if found != expected {
            return Err(Errors(vec![StructureError::Count { found, expected }]));
        }
        let of_segment = |(i, segment): (usize, &SegmentStructure)| segment.errors(scene.label(i));
        let errors: Vec<_> = segments.iter().enumerate().flat_map(of_segment).collect();
        if !errors.is_empty() {
            return Err(Errors(errors));
        }
        let difference = |(i, segment): (usize, &SegmentStructure)| {
            segment.differences(scene.label(i), &scene.bodies[i].mass_properties)
        };
        let differences = segments.iter().enumerate().flat_map(difference).collect();
        Ok((Self { segments }, differences))
    }

    /// What is allowed but probably not meant: stations whose slices lie inboard of them, or that do not
    /// carry a rotor of their body, and pulses that last longer than the run.
    pub fn warnings(&self, scene: &Scene) -> Vec<StructureError> {
        let segments = self.segments.iter().enumerate();
        segments.flat_map(|(i, segment)| structure_error::doubtful(scene, i, segment)).collect()
    }

    /// One entry for each hinged body of the scene.
    pub fn segments(&self) -> &[SegmentStructure] {
        &self.segments
    }

    /// The materials of the segments with stations.
    pub fn materials(&self) -> impl Iterator<Item = &Material> {
        let loaded = self.segments.iter().filter(|segment| !segment.stations.is_empty());
        loaded.map(|segment| &segment.material)
    }

    /// Whether any segment has a station.
    pub fn has_stations(&self) -> bool {
        self.segments.iter().any(|segment| !segment.stations.is_empty())
    }
}

impl Default for SegmentStructure {
    /// Of a segment whose hinge never locks and of which no loads are wanted.
    fn default() -> Self {
        let material = Material::elastic(1.0, 0.0);
        Self { pulse_constant: 1.0, material, stations: Vec::new() }
    }
}

impl SegmentStructure {
    /// Mass properties of everything of this segment that is outboard of each station, from the
    /// slices: eqs. (13.1) to (13.3), corrected: note 26.
    pub fn outboard_of_stations(&self) -> Vec<MassProperties> {
        let slices = self.stations.iter().map(|station| station.slice);
        let accumulate = |outboard: &mut Option<MassProperties>, slice: MassProperties| {
            *outboard = Some(outboard.map_or(slice, |outboard| outboard.joined_with(&slice)));
            *outboard
        };
        slices.scan(None, accumulate).collect()
    }

    /// Mass properties of the segment by its slices; `None` without stations.
    pub fn mass_properties(&self) -> Option<MassProperties> {
        self.outboard_of_stations().pop()
    }

    /// All errors in the structure of the segment that users call `label`, except those that depend
    /// on the segment's own mass properties.
    pub fn errors(&self, label: HingeLabel) -> Vec<StructureError> {
        structure_error::find(self, label)
    }

    /// Where the slices differ from the segment's own mass properties.
    fn differences(&self, label: HingeLabel, own: &MassProperties) -> Vec<StructureError> {
        let Some(sum) = self.mass_properties() else { return Vec::new() };
        let about_hinge = RigidInertia::new(own.mass, own.center_of_mass, own.inertia).about_origin;
        let inertia_scale = about_hinge.trace();
        let length_scale = (inertia_scale / own.mass).sqrt();
        let inertia = sum.inertia + own.inertia * -1.0;
        let mut defects = Vec::new();
        if (sum.mass - own.mass).abs() > SLICE_TOLERANCE * own.mass {
            defects.push(StructureDefect::Mass { found: sum.mass, expected: own.mass });
        }
        if (sum.center_of_mass - own.center_of_mass).norm() > SLICE_TOLERANCE * length_scale {
            let (found, expected) = (sum.center_of_mass, own.center_of_mass);
            defects.push(StructureDefect::CenterOfMass { found, expected });
        }
        if inertia.largest_entry() > SLICE_TOLERANCE * inertia_scale {
            let (found, expected) = (sum.inertia, own.inertia);
            defects.push(StructureDefect::Inertia { found, expected });
        }
        let place = StructurePlace { segment: label, station: None, vertex: None };
        let at_place = |defect| StructureError::Segment { place: place.clone(), defect };
        defects.into_iter().map(at_place).collect()
    }
}

impl Station {
    /// The point of the station on the η axis, from the inboard hinge, segment axes.
    pub fn point(&self) -> Vec3<f64> {
        Vec3::unit_y() * self.distance_from_hinge
    }
}
