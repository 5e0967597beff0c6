use nboom_elements::Ends;
use nboom_model::{
    External, ExternalAxes, ExternalKind, Joint, MassProperties, Rotor, Scene, SegmentStructure,
    Station, Structure,
};
use nboom_scalar::{Mat3, Real, RigidInertia, Sym3, Vec3};

/// Share of a segment's outermost station within which an attachment is at a station.
const SAME_PLACE: f64 = 1e-9;

/// What does not change of one hinged body; segment axes unless said otherwise.
#[derive(Clone, Debug)]
pub(crate) struct Segment<R> {
    pub inboard: Option<usize>,
    pub joint: Joint,
    /// The hinge at β = 0 from the inboard body's origin, inboard body's axes.
    pub point: Vec3<R>,
    /// Turns segment components at hinge angle zero into inboard components.
    pub rot_inboard_at_zero: Mat3<R>,
    pub axis: Vec3<R>,
    /// Of the whole segment, about the hinge; of rotors at rest.
    pub inertia: RigidInertia<R>,
    /// Its rotors. They count as being outboard of the last station alone.
    pub rotors: Vec<Carried<R>>,
    /// The outermost station of the inboard body that carries this one.
    pub carried_from: usize,
    pub stations: Vec<Cut<R>>,
    pub push: Option<Push<R>>,
    pub outside: Vec<Outside<R>>,
}

/// A force or torque from outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outside<R> {
    /// Its place among those on hinged bodies.
    pub place: usize,
    pub kind: ExternalKind,
    pub axes: ExternalAxes,
    pub point: Vec3<R>,
    /// The outermost station that carries it.
    pub carried_from: usize,
}

/// A rotor in a segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried<R> {
    /// Its place among those in hinged bodies.
    pub place: usize,
    /// J ā: inertia about its axis along a unit vector there.
    pub along: Vec3<R>,
}

/// A station and what of its segment is outboard of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cut<R> {
    /// On the η axis.
    pub point: Vec3<R>,
    /// About the hinge.
    pub outboard: RigidInertia<R>,
    pub influence: Option<Influence<R>>,
}

/// Six numbers that describe the stresses in a section, by P_ξ, P_η, P_ζ, Q_ξ, Q_η and Q_ζ; a row
/// for each number.
pub type Influence<R = f64> = [[R; 6]; 6];

/// A force along a line between a segment and the main body.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Push<R> {
    pub body_point: Vec3<R>,
    /// From O, main-body axes.
    pub main_body_point: Vec3<R>,
    /// The outermost station that carries its force.
    pub carried_from: usize,
}

impl<R: Copy> Segment<R> {
    /// The segment with what `f` makes of each of its numbers, always in the same order.
    pub fn map<S>(&self, mut f: impl FnMut(R) -> S) -> Segment<S> {
        Segment {
            inboard: self.inboard,
            joint: self.joint,
            point: self.point.map(&mut f),
            rot_inboard_at_zero: self.rot_inboard_at_zero.map(&mut f),
            axis: self.axis.map(&mut f),
            inertia: self.inertia.map(&mut f),
            rotors: self.rotors.iter().map(|rotor| rotor.map(&mut f)).collect(),
            carried_from: self.carried_from,
            stations: self.stations.iter().map(|cut| cut.map(&mut f)).collect(),
            push: self.push.map(|push| push.map(&mut f)),
            outside: self.outside.iter().map(|external| external.map(&mut f)).collect(),
        }
    }

    /// How it is attached, as numbers that no other arrangement has.
    pub fn arrangement(&self) -> Vec<f64> {
        let counted = |place: Option<usize>| place.map_or(0, |place| place + 1);
        let push = self.push.as_ref().map(|push| push.carried_from);
        let sections = self.stations.iter().filter(|cut| cut.influence.is_some()).count();
        let stations = self.stations.len();
        let (slides, rotors) = (usize::from(self.joint.slides()), self.rotors.len());
        let (inboard, push, outside) = (counted(self.inboard), counted(push), self.outside.len());
        let mut counts =
            vec![inboard, self.carried_from, stations, sections, push, slides, rotors, outside];
        counts.extend(self.rotors.iter().map(|rotor| rotor.place));
        for Outside { place, kind, axes, carried_from, .. } in &self.outside {
            let turns = usize::from(*axes == ExternalAxes::Inertial);
            let is_torque = usize::from(*kind == ExternalKind::Torque);
            counts.extend([*place, is_torque, turns, *carried_from]);
        }
        counts.into_iter().map(|count| count as f64).collect()
    }
}

impl<R: Real> Segment<R> {
    /// The hinge at β from the inboard body's origin, inboard body's axes.
    pub fn offset(&self, beta: R) -> Vec3<R> {
        match self.joint {
            Joint::Revolute => self.point,
            Joint::Prismatic => self.point + self.rot_inboard_at_zero * (self.axis * beta),
        }
    }
}

impl<R: Copy> Cut<R> {
    fn map<S>(&self, mut f: impl FnMut(R) -> S) -> Cut<S> {
        Cut {
            point: self.point.map(&mut f),
            outboard: self.outboard.map(&mut f),
            influence: self.influence.map(|rows| rows.map(|row| row.map(&mut f))),
        }
    }
}

impl<R: Copy> Push<R> {
    fn map<S>(&self, mut f: impl FnMut(R) -> S) -> Push<S> {
        Push {
            body_point: self.body_point.map(&mut f),
            main_body_point: self.main_body_point.map(f),
            carried_from: self.carried_from,
        }
    }
}

impl<R: Copy> Carried<R> {
    fn map<S>(&self, f: impl FnMut(R) -> S) -> Carried<S> {
        Carried { place: self.place, along: self.along.map(f) }
    }
}

impl<R: Copy> Outside<R> {
    fn map<S>(&self, f: impl FnMut(R) -> S) -> Outside<S> {
        let Self { place, kind, axes, carried_from, .. } = *self;
        Outside { place, kind, axes, point: self.point.map(f), carried_from }
    }
}

impl Segment<f64> {
    pub fn all(scene: &Scene, structure: Option<&Structure>) -> Vec<Self> {
        (0..scene.bodies.len()).map(|i| Self::new(scene, structure, i)).collect()
    }

    fn new(scene: &Scene, structure: Option<&Structure>, i: usize) -> Self {
        let body = &scene.bodies[i];
        let of = |i: usize| structure.map(|structure| &structure.segments()[i]);
        let stations_of = |i| of(i).map_or(&[][..], |segment| &segment.stations);
        let inboard_stations = body.inboard.map_or(&[][..], stations_of);
        let push = Ends::of(scene, i).map(|ends| Push {
            body_point: ends.body_point,
            main_body_point: ends.main_body_point,
            carried_from: carried_from(stations_of(i), ends.body_point),
        });
        let externals = scene.externals_on_hinged().enumerate();
        let on_it = externals.filter(|(_, external)| external.body == Some(i));
        let outside = on_it.map(|(place, &External { kind, axes, point, .. })| Outside {
            place,
            kind,
            axes,
            point,
            carried_from: carried_from(stations_of(i), point),
        });
        let rotors = scene.rotors_in_hinged().enumerate();
        let rotors = rotors.filter(|(_, rotor)| rotor.body == Some(i));
        let carried = |(place, rotor): (usize, &Rotor)| {
            let along = rotor.axis * rotor.inertia;
            Carried { place, along }
        };
        let mut inertia = about_hinge(&body.mass_properties);
        inertia.about_origin += scene.rotor_inertia_of(Some(i));
        Self {
            rotors: rotors.map(carried).collect(),
            inboard: body.inboard,
            joint: body.joint,
            point: body.mount.point,
            rot_inboard_at_zero: body.mount.rot_inboard_from_hinge,
            axis: body.axis,
            inertia,
            carried_from: carried_from(inboard_stations, body.mount.point),
            stations: of(i)
                .map(|own| cuts(own, scene.rotor_inertia_of(Some(i))))
                .unwrap_or_default(),
            push,
            outside: outside.collect(),
        }
    }
}

fn about_hinge(body: &MassProperties) -> RigidInertia<f64> {
    RigidInertia::new(body.mass, body.center_of_mass, body.inertia)
}

/// Its stations; the last one carries its rotors.
fn cuts(segment: &SegmentStructure, of_rotors: Sym3<f64>) -> Vec<Cut<f64>> {
    let outboard = segment.outboard_of_stations();
    let cut = |(station, outboard): (&Station, &MassProperties)| Cut {
        point: station.point(),
        outboard: about_hinge(outboard),
        influence: None,
    };
    let mut cuts: Vec<Cut<f64>> = segment.stations.iter().zip(&outboard).map(cut).collect();
    if let Some(last) = cuts.last_mut() {
        last.outboard.about_origin += of_rotors;
    }
    cuts
}

/// The outermost station that is not outboard of an attachment at `point`; what is attached is
/// outboard of the last station wherever it is.
fn carried_from(stations: &[Station], point: Vec3<f64>) -> usize {
    let Some(last) = stations.len().checked_sub(1) else { return 0 };
    let reach = point.y + SAME_PLACE * stations[0].distance_from_hinge;
    stations.iter().position(|station| station.distance_from_hinge <= reach).unwrap_or(last)
}
