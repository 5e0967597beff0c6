use nboom_elements::KickOffLaw;
use nboom_model::{MassProperties, Scene, SegmentStructure, Station, Structure};
use nboom_scalar::{Mat3, RigidInertia, Vec3};

/// Share of a segment's outermost station within which an attachment is at a station.
const SAME_PLACE: f64 = 1e-9;

/// What does not change of one hinged body; segment axes unless said otherwise.
#[derive(Clone, Debug)]
pub(crate) struct Segment {
    pub inboard: Option<usize>,
    /// The hinge from the inboard body's origin, inboard body's axes.
    pub point: Vec3<f64>,
    /// Turns segment components at hinge angle zero into inboard components.
    pub rot_inboard_at_zero: Mat3<f64>,
    pub axis: Vec3<f64>,
    /// Of the whole segment, about the hinge.
    pub inertia: RigidInertia<f64>,
    /// The outermost station of the inboard body that carries this one.
    pub carried_from: usize,
    pub stations: Vec<Cut>,
    pub kick_off: Option<KickOff>,
}

/// A station and what of its segment is outboard of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut {
    /// On the η axis.
    pub point: Vec3<f64>,
    /// About the hinge.
    pub outboard: RigidInertia<f64>,
}

/// A kick-off spring, between a segment and the main body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KickOff {
    pub body_point: Vec3<f64>,
    /// From O, main-body axes.
    pub main_body_point: Vec3<f64>,
    pub law: KickOffLaw<f64>,
    /// The outermost station that carries its force.
    pub carried_from: usize,
}

impl Segment {
    pub fn all(scene: &Scene, structure: Option<&Structure>) -> Vec<Self> {
        (0..scene.bodies.len()).map(|i| Self::new(scene, structure, i)).collect()
    }

    fn new(scene: &Scene, structure: Option<&Structure>, i: usize) -> Self {
        let body = &scene.bodies[i];
        let of = |i: usize| structure.map(|structure| &structure.segments()[i]);
        let stations_of = |i| of(i).map_or(&[][..], |segment| &segment.stations);
        let inboard_stations = body.inboard.map_or(&[][..], stations_of);
        let kick_off = body.hinge.kick_off.map(|spring| KickOff {
            body_point: spring.body_point,
            main_body_point: spring.main_body_point,
            law: KickOffLaw::new(spring.coefficients),
            carried_from: carried_from(stations_of(i), spring.body_point),
        });
        Self {
            inboard: body.inboard,
            point: body.mount.point,
            rot_inboard_at_zero: body.mount.rot_inboard_from_hinge,
            axis: body.axis,
            inertia: about_hinge(&body.mass_properties),
            carried_from: carried_from(inboard_stations, body.mount.point),
            stations: of(i).map(cuts).unwrap_or_default(),
            kick_off,
        }
    }
}

fn about_hinge(body: &MassProperties) -> RigidInertia<f64> {
    RigidInertia::new(body.mass, body.center_of_mass, body.inertia)
}

fn cuts(segment: &SegmentStructure) -> Vec<Cut> {
    let outboard = segment.outboard_of_stations();
    let cut = |(station, outboard): (&Station, &MassProperties)| Cut {
        point: station.point(),
        outboard: about_hinge(outboard),
    };
    segment.stations.iter().zip(&outboard).map(cut).collect()
}

/// The outermost station that is not outboard of an attachment at `point`; what is attached is
/// outboard of the last station wherever it is.
fn carried_from(stations: &[Station], point: Vec3<f64>) -> usize {
    let Some(last) = stations.len().checked_sub(1) else { return 0 };
    let reach = point.y + SAME_PLACE * stations[0].distance_from_hinge;
    stations.iter().position(|station| station.distance_from_hinge <= reach).unwrap_or(last)
}
