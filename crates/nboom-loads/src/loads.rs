use nboom_model::{HingeState, Scene, Structure};
use nboom_scalar::{Mat3, RigidInertia, Twist, Vec3, Wrench};

use crate::load_set::{LoadSet, Size};
use crate::motion::{LockUpShare, SceneMotion, VelocityChange};
use crate::segment::Segment;

/// Finds hinge and station loads of one scene.
///
/// Evaluations allocate nothing and panic when a slice of the motion has not one entry for each
/// hinge of the scene.
#[derive(Clone, Debug)]
pub struct Loads {
    pub(crate) segments: Vec<Segment>,
    places: Vec<Place>,
    /// Of one lock-up.
    impulses: LoadSet,
    still: Still,
}

/// Nothing turns and no kick-off spring pushes, one entry for each hinge.
#[derive(Clone, Debug)]
struct Still {
    tau: Vec<f64>,
    kick_off: Vec<bool>,
}

impl Still {
    /// The motion whose loads are the impulses of `jump`: at rest, with jumps for accelerations.
    fn suddenly<'a>(&'a self, beta: &'a [f64], jump: &VelocityChange<'a>) -> SceneMotion<'a> {
        let Self { tau, kick_off } = self;
        SceneMotion { omega_body: Vec3::zero(), beta, tau, acceleration: *jump, kick_off }
    }
}

/// Where a segment is and how it moves; segment axes unless said otherwise.
#[derive(Clone, Copy, Debug)]
struct Place {
    rot_inboard_from_body: Mat3<f64>,
    rot_main_from_body: Mat3<f64>,
    /// The hinge from O, main-body axes.
    origin: Vec3<f64>,
    omega: Vec3<f64>,
    /// Of the segment and its hinge point.
    acceleration: Twist<f64>,
    bound: Bound,
}

/// Sums of the magnitudes of what angular and linear acceleration are made of.
#[derive(Clone, Copy, Debug)]
struct Bound {
    angular: f64,
    linear: f64,
}

impl Loads {
    /// The loads of `scene`: those of its hinges, and with a structure those of its stations.
    ///
    /// Hinge loads follow from the bodies' own mass properties, station loads from the slices.
    pub fn new(scene: &Scene, structure: Option<&Structure>) -> Self {
        let segments = Segment::all(scene, structure);
        let still = Place {
            rot_inboard_from_body: Mat3::identity(),
            rot_main_from_body: Mat3::identity(),
            origin: Vec3::zero(),
            omega: Vec3::zero(),
            acceleration: Twist::zero(),
            bound: Bound { angular: 0.0, linear: 0.0 },
        };
        let hinges = segments.len();
        Self {
            impulses: LoadSet::new(segments.iter().map(|segment| segment.stations.len())),
            segments,
            places: vec![still; hinges],
            still: Still { tau: vec![0.0; hinges], kick_off: vec![false; hinges] },
        }
    }

    /// Zero loads of this scene, to be filled in.
    pub fn load_set(&self) -> LoadSet {
        LoadSet::new(self.segments.iter().map(|segment| segment.stations.len()))
    }

    /// Loads by the motion and the kick-off springs: eqs. (10.4) to (10.6), corrected: note 24.
    pub fn continuous(&mut self, motion: &SceneMotion<'_>, out: &mut LoadSet) {
        load(&self.segments, &mut self.places, motion, out);
    }

    /// Impulses by a jump of the velocities in the posture `beta`, for hinges that lock, that
    /// are free and that have been held alike: eqs. (10.7) to (10.12), corrected: note 25.
    pub fn impulses(&mut self, beta: &[f64], jump: &VelocityChange<'_>, out: &mut LoadSet) {
        load(&self.segments, &mut self.places, &self.still.suddenly(beta, jump), out);
    }

    /// Adds the peaks of a lock-up to `loads`: `amplification` times the impulses of each hinge
    /// that locks over its pulse constant, eqs. (10.13) and (10.14).
    ///
    /// All pulses peak together. `loads` holds the continuous loads at that instant; an
    /// amplification of 1 is a pulse that is slow against the bending of the segments.
    pub fn add_lock_up(
        &mut self,
        beta: &[f64],
        shares: &[LockUpShare<'_>],
        amplification: f64,
        loads: &mut LoadSet,
    ) {
        for share in shares {
            let motion = self.still.suddenly(beta, &share.jump);
            load(&self.segments, &mut self.places, &motion, &mut self.impulses);
            loads.add_scaled(&self.impulses, amplification / share.pulse_constant);
        }
    }

    /// The free hinge at which the load about the axis departs most from the `torques` that act
    /// there, and by which share of what the load is made of; `None` when all are held.
    ///
    /// Of a motion, torques are those of springs and dashpots; of impulses, those of latches.
    pub fn largest_torque_residual(
        &self,
        loads: &LoadSet,
        hinges: &[HingeState],
        torques: &[f64],
    ) -> Option<(usize, f64)> {
        let free = (0..hinges.len()).filter(|&i| hinges[i] == HingeState::Free);
        let residual = |i: usize| {
            let difference = (self.segments[i].axis.dot(loads.hinges[i].moment) - torques[i]).abs();
            let size = loads.sizes[i].moment + torques[i].abs();
            (i, if difference == 0.0 { 0.0 } else { difference / size })
        };
        free.map(residual).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Sets `out` to the loads of a motion.
fn load(segments: &[Segment], places: &mut [Place], motion: &SceneMotion<'_>, out: &mut LoadSet) {
    place(segments, places, motion);
    gather(segments, places, motion.kick_off, out);
}

/// Walks outward: where every segment is and how it moves, eqs. (14.1) to (14.10), corrected:
/// note 27.
fn place(segments: &[Segment], places: &mut [Place], motion: &SceneMotion<'_>) {
    let main = Place {
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
    };
    for (i, segment) in segments.iter().enumerate() {
        let inboard = segment.inboard.map_or(main, |inboard| places[inboard]);
        let turn = Mat3::about_axis(segment.axis, motion.beta[i]);
        let (rate, rate_dot) = (motion.tau[i], motion.acceleration.tau[i]);
        places[i] = inboard.outward(segment, &turn, rate, rate_dot);
    }
}

impl Place {
    /// The place of a segment that is hinged to this one and turned from it by `turn`.
    fn outward(&self, segment: &Segment, turn: &Mat3<f64>, tau: f64, tau_dot: f64) -> Self {
        let rot = segment.rot_inboard_at_zero * *turn;
        let (r, omega) = (segment.point, rot.transpose_mul(self.omega));
        let Twist { angular, linear } = self.acceleration.at(r);
        let centripetal = self.omega.cross(self.omega.cross(r));
        let turning = segment.axis * tau;
        let whirl = self.omega.norm_squared();
        Self {
            rot_inboard_from_body: rot,
            rot_main_from_body: self.rot_main_from_body * rot,
            origin: self.origin + self.rot_main_from_body * r,
            omega: omega + turning,
            acceleration: Twist {
                angular: rot.transpose_mul(angular) + segment.axis * tau_dot + omega.cross(turning),
                linear: rot.transpose_mul(linear + centripetal),
            },
            bound: Bound {
                angular: self.bound.angular + tau_dot.abs() + whirl.sqrt() * tau.abs(),
                linear: self.bound.linear + (self.bound.angular + whirl) * r.norm(),
            },
        }
    }

    fn inertia_wrench(&self, inertia: &RigidInertia<f64>) -> Wrench<f64> {
        inertia.inertia_wrench(self.omega, self.acceleration)
    }

    fn inertia_size(&self, inertia: &RigidInertia<f64>) -> Size {
        let turning = self.bound.angular + self.omega.norm_squared();
        let (c, j) = (inertia.first_moment.norm(), inertia.about_origin);
        Size {
            moment: c * self.bound.linear + (j.xx + j.yy + j.zz) * turning,
            force: inertia.mass * self.bound.linear + c * turning,
        }
    }
}

/// Walks inward: the load of every hinge and station, and hands those of hinges on,
/// eq. (14.13), corrected: note 28.
fn gather(segments: &[Segment], places: &[Place], kick_off: &[bool], out: &mut LoadSet) {
    for (i, (segment, place)) in segments.iter().zip(places).enumerate() {
        out.hinges[i] = place.inertia_wrench(&segment.inertia);
        out.sizes[i] = place.inertia_size(&segment.inertia);
        for (load, cut) in out.stations_mut(i).iter_mut().zip(&segment.stations) {
            *load = place.inertia_wrench(&cut.outboard);
        }
    }
    for (i, (segment, place)) in segments.iter().zip(places).enumerate().rev() {
        if kick_off[i] {
            push(segment, place, i, out);
        }
        for (load, cut) in out.stations_mut(i).iter_mut().zip(&segment.stations) {
            *load = load.seen_from(-cut.point);
        }
        if let Some(inboard) = segment.inboard {
            let carried = out.hinges[i].rotated(&place.rot_inboard_from_body);
            carry(inboard, segment.carried_from, carried.seen_from(segment.point), out);
            let Size { moment, force } = out.sizes[i];
            out.sizes[inboard].add(Size { moment: moment + segment.point.norm() * force, force });
        }
    }
}

/// Takes the force of the kick-off spring of segment `i` off its loads.
fn push(segment: &Segment, place: &Place, i: usize, out: &mut LoadSet) {
    let Some(spring) = segment.kick_off else { return };
    let end = place.origin + place.rot_main_from_body * spring.body_point;
    let along = end - spring.main_body_point;
    let length = along.norm();
    let force = place.rot_main_from_body.transpose_mul(along * (spring.law.force(length) / length));
    carry(i, spring.carried_from, Wrench::of_force(spring.body_point, -force), out);
    let size = force.norm();
    out.sizes[i].add(Size { moment: spring.body_point.norm() * size, force: size });
}

/// Adds a wrench about the hinge point of segment `i` to its hinge and the stations that carry it.
fn carry(i: usize, carried_from: usize, wrench: Wrench<f64>, out: &mut LoadSet) {
    out.hinges[i].add(wrench);
    let stations = out.stations_mut(i);
    stations.iter_mut().skip(carried_from).for_each(|load| load.add(wrench));
}
