//! Loads of a motion on any scalar.

use nboom_model::{ExternalAxes, ExternalKind, Joint, Scene, Structure};
use nboom_scalar::{Mat3, Real, RigidInertia, Twist, Vec3, Wrench};

use crate::load_set::LoadSet;
use crate::motion::{MotionSize, SceneMotion};
use crate::segment::{Carried, Influence, Segment};

/// The equations of the loads of one scene, on any scalar.
///
/// Evaluations allocate nothing and panic when a slice of the motion has not one entry for each
/// hinge of the scene.
#[derive(Clone, Debug)]
pub struct LoadEquations<R = f64> {
    pub(crate) segments: Vec<Segment<R>>,
    places: Vec<SegmentMotion<R>>,
}

/// Where a segment is and how it moves; segment axes unless said otherwise.
#[derive(Clone, Copy, Debug)]
struct SegmentMotion<R> {
    rot_inboard_from_body: Mat3<R>,
    rot_main_from_body: Mat3<R>,
    /// The hinge from O, main-body axes.
    origin: Vec3<R>,
    omega: Vec3<R>,
    /// Of the segment and its hinge point.
    acceleration: Twist<R>,
    bound: Bound<R>,
    /// Of what the load of its hinge is made of.
    size: Size<R>,
}

/// Magnitudes of a moment and a force.
#[derive(Clone, Copy, Debug)]
struct Size<R> {
    moment: R,
    force: R,
}

impl<R: Real> Size<R> {
    fn zero() -> Self {
        Self { moment: R::zero(), force: R::zero() }
    }

    fn add(&mut self, other: Self) {
        self.moment += other.moment;
        self.force += other.force;
    }
}

/// Sums of the magnitudes of what angular and linear acceleration are made of.
#[derive(Clone, Copy, Debug)]
struct Bound<R> {
    angular: R,
    linear: R,
}

impl LoadEquations {
    /// Those of `scene`: of its hinges, and with a structure of its stations.
    ///
    /// Hinge loads follow from the bodies' own mass properties, station loads from the slices.
    pub fn new(scene: &Scene, structure: Option<&Structure>) -> Self {
        Self::of(Segment::all(scene, structure))
    }

    /// Those that describe stresses too, by the sections of all stations, segment by segment.
    pub fn with_sections(mut self, influences: impl IntoIterator<Item = Influence>) -> Self {
        let cuts = self.segments.iter_mut().flat_map(|segment| &mut segment.stations);
        for (cut, influence) in cuts.zip(influences) {
            cut.influence = Some(influence);
        }
        self
    }

    /// All that the loads depend on but the motion: how segments are attached, then their numbers.
    pub fn numbers(&self) -> Vec<f64> {
        let mut numbers: Vec<f64> = self.segments.iter().flat_map(Segment::arrangement).collect();
        self.segments.iter().for_each(|segment| {
            segment.map(|number| numbers.push(number));
        });
        numbers
    }

    /// These equations with other [`numbers`](Self::numbers).
    ///
    /// # Panics
    /// When there are fewer.
    pub fn with_numbers<R: Real>(&self, numbers: &[R]) -> LoadEquations<R> {
        let arrangement: usize = self.segments.iter().map(|s| s.arrangement().len()).sum();
        let mut next = numbers[arrangement..].iter();
        let mut take = |_| *next.next().expect("a number for each");
        let segments = self.segments.iter().map(|segment| segment.map(&mut take));
        LoadEquations::of(segments.collect())
    }
}

impl<R: Real> LoadEquations<R> {
    fn of(segments: Vec<Segment<R>>) -> Self {
        let still = SegmentMotion {
            rot_inboard_from_body: Mat3::identity(),
            rot_main_from_body: Mat3::identity(),
            origin: Vec3::zero(),
            omega: Vec3::zero(),
            acceleration: Twist::zero(),
            bound: Bound { angular: R::zero(), linear: R::zero() },
            size: Size::zero(),
        };
        Self { places: vec![still; segments.len()], segments }
    }

    /// How many hinges there are.
    pub fn hinges(&self) -> usize {
        self.segments.len()
    }

    /// Of how much a motion is that loads follow from.
    pub fn motion_size(&self) -> MotionSize {
        let of_segments = |count: fn(&Segment<R>) -> usize| self.segments.iter().map(count).sum();
        MotionSize {
            hinges: self.hinges(),
            externals: of_segments(|segment| segment.outside.len()),
            rotors: of_segments(|segment| segment.rotors.len()),
        }
    }

    /// Zero loads of this scene, to be filled in.
    pub fn load_set(&self) -> LoadSet<R> {
        LoadSet::new(self.segments.iter().map(|segment| segment.stations.len()))
    }

    /// Sets `out` to the loads of a motion: eqs. (10.4) to (10.6), corrected: note 24.
    pub fn evaluate(&mut self, motion: &SceneMotion<'_, R>, out: &mut LoadSet<R>) {
        place(&self.segments, &mut self.places, motion);
        gather(&self.segments, &mut self.places, motion, out);
        self.describe_stresses(out);
    }

    /// Brings the stresses of `out` up to its station loads.
    pub(crate) fn describe_stresses(&self, out: &mut LoadSet<R>) {
        let cuts = self.segments.iter().flat_map(|segment| &segment.stations);
        for ((cut, load), stress) in cuts.zip(&out.stations).zip(&mut out.stresses) {
            let Some(influence) = &cut.influence else { continue };
            let (p, q) = (load.force, load.moment);
            *stress = influence.map(|[px, py, pz, qx, qy, qz]| {
                (px * p.x + py * p.y + pz * p.z) + (qx * q.x + qy * q.y + qz * q.z)
            });
        }
    }
}

/// Walks outward: where every segment is and how it moves, eqs. (14.1) to (14.10), corrected:
/// note 27.
fn place<R: Real>(
    segments: &[Segment<R>],
    places: &mut [SegmentMotion<R>],
    motion: &SceneMotion<'_, R>,
) {
    let main = SegmentMotion {
        rot_inboard_from_body: Mat3::identity(),
        rot_main_from_body: Mat3::identity(),
        origin: Vec3::zero(),
        omega: motion.omega_body,
        acceleration: Twist {
            angular: motion.acceleration.omega_body,
            linear: motion.acceleration.origin_body,
        },
        bound: Bound {
            angular: motion.acceleration.omega_body.norm(),
            linear: motion.acceleration.origin_body.norm(),
        },
        size: Size::zero(),
    };
    for (i, segment) in segments.iter().enumerate() {
        let inboard = segment.inboard.map_or(main, |inboard| places[inboard]);
        let at = [motion.beta[i], motion.tau[i], motion.acceleration.tau[i]];
        places[i] = inboard.outward(segment, at);
    }
}

impl<R: Real> SegmentMotion<R> {
    /// The place of a segment that is hinged to this one, at β, τ and τ̇.
    fn outward(&self, segment: &Segment<R>, [beta, tau, tau_dot]: [R; 3]) -> Self {
        let (joint, axis) = (segment.joint, segment.axis);
        let rot = segment.rot_inboard_at_zero * joint.turn(axis, beta);
        let r = segment.offset(beta);
        let omega = rot.transpose_mul(self.omega);
        let Twist { angular, linear } = self.acceleration.at(r);
        let centripetal = self.omega.cross(self.omega.cross(r));
        let own = joint.motion(axis, tau);
        let mut acceleration = joint.motion(axis, tau_dot);
        let [driven, swept] = [tau_dot, self.omega.norm() * tau].map(|rate| (axis * rate).norm());
        let whirl = self.omega.norm_squared();
        let bound = Bound {
            angular: self.bound.angular,
            linear: self.bound.linear + (self.bound.angular + whirl) * r.norm(),
        };
        let bound = match joint {
            Joint::Revolute => Bound { angular: bound.angular + driven + swept, ..bound },
            Joint::Prismatic => Bound { linear: bound.linear + driven + swept + swept, ..bound },
        };
        acceleration.add(Twist {
            angular: rot.transpose_mul(angular) + omega.cross(own.angular),
            linear: rot.transpose_mul(linear + centripetal) + omega.cross(own.linear + own.linear),
        });
        Self {
            rot_inboard_from_body: rot,
            rot_main_from_body: self.rot_main_from_body * rot,
            origin: self.origin + self.rot_main_from_body * r,
            omega: omega + own.angular,
            acceleration,
            bound,
            size: Size::zero(),
        }
    }

    fn inertia_wrench(&self, inertia: &RigidInertia<R>) -> Wrench<R> {
        inertia.inertia_wrench(self.omega, self.acceleration)
    }

    fn inertia_size(&self, inertia: &RigidInertia<R>) -> Size<R> {
        let turning = self.bound.angular + self.omega.norm_squared();
        let (c, j) = (inertia.first_moment.norm(), inertia.about_origin);
        Size {
            moment: c * self.bound.linear + j.trace() * turning,
            force: inertia.mass * self.bound.linear + c * turning,
        }
    }
}

/// Walks inward: the load of every hinge and station, and hands those of hinges on,
/// eq. (14.13), corrected: note 28.
fn gather<R: Real>(
    segments: &[Segment<R>],
    places: &mut [SegmentMotion<R>],
    motion: &SceneMotion<'_, R>,
    out: &mut LoadSet<R>,
) {
    for (i, (segment, place)) in segments.iter().zip(&mut *places).enumerate() {
        out.hinges[i] = place.inertia_wrench(&segment.inertia);
        for (load, cut) in out.stations_mut(i).iter_mut().zip(&segment.stations) {
            *load = place.inertia_wrench(&cut.outboard);
        }
        place.size = place.inertia_size(&segment.inertia);
        let last = segment.stations.len().saturating_sub(1);
        for Carried { place: rotor, along } in &segment.rotors {
            let [speed, acceleration] = motion.rotors[*rotor];
            let (momentum, driven) = (*along * speed, *along * acceleration);
            let moment = place.omega.cross(momentum) + driven;
            carry(i, last, Wrench { moment, force: Vec3::zero() }, out);
            // Rotors may cancel each other's moments, but not each other's rounding.
            place.size.moment += place.omega.norm() * momentum.norm() + driven.norm();
        }
    }
    for (i, segment) in segments.iter().enumerate().rev() {
        push_apart(segment, &mut places[i], motion.force_densities[i], i, out);
        push_from_outside(segment, &mut places[i], motion.outside, i, out);
        let place = places[i];
        let Size { moment, force } = place.size;
        out.sizes[i] = match segment.joint {
            Joint::Revolute => moment,
            Joint::Prismatic => force,
        };
        for (load, cut) in out.stations_mut(i).iter_mut().zip(&segment.stations) {
            *load = load.seen_from(-cut.point);
        }
        if let Some(inboard) = segment.inboard {
            let carried = out.hinges[i].rotated(&place.rot_inboard_from_body);
            let offset = segment.offset(motion.beta[i]);
            carry(inboard, segment.carried_from, carried.seen_from(offset), out);
            let moment = moment + offset.norm() * force;
            places[inboard].size.add(Size { moment, force });
        }
    }
}

/// Takes the force along the line from the main body to segment `i` off its loads.
fn push_apart<R: Real>(
    segment: &Segment<R>,
    place: &mut SegmentMotion<R>,
    force_density: R,
    i: usize,
    out: &mut LoadSet<R>,
) {
    let Some(push) = segment.push else { return };
    let end = place.origin + place.rot_main_from_body * push.body_point;
    let along = end - push.main_body_point;
    let force = place.rot_main_from_body.transpose_mul(along * force_density);
    carry(i, push.carried_from, Wrench::of_force(push.body_point, -force), out);
    let size = force.norm();
    place.size.add(Size { moment: push.body_point.norm() * size, force: size });
}

/// Takes what acts on segment `i` from outside off its loads.
fn push_from_outside<R: Real>(
    segment: &Segment<R>,
    place: &mut SegmentMotion<R>,
    outside: &[[R; 3]],
    i: usize,
    out: &mut LoadSet<R>,
) {
    for external in &segment.outside {
        let given = Vec3::from(outside[external.place]);
        let acting = match external.axes {
            ExternalAxes::Body => given,
            ExternalAxes::Inertial => place.rot_main_from_body.transpose_mul(given),
        };
        let size = acting.norm();
        let (wrench, size) = match external.kind {
            ExternalKind::Force => (
                Wrench::of_force(external.point, -acting),
                Size { moment: external.point.norm() * size, force: size },
            ),
            ExternalKind::Torque => (
                Wrench { moment: -acting, force: Vec3::zero() },
                Size { moment: size, force: R::zero() },
            ),
        };
        carry(i, external.carried_from, wrench, out);
        place.size.add(size);
    }
}

/// Adds a wrench about the hinge point of segment `i` to its hinge and the stations that carry it.
fn carry<R: Real>(i: usize, carried_from: usize, wrench: Wrench<R>, out: &mut LoadSet<R>) {
    out.hinges[i].add(wrench);
    let stations = out.stations_mut(i);
    stations.iter_mut().skip(carried_from).for_each(|load| load.add(wrench));
}
