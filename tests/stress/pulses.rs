//! Pulses of latches over time: rods that swing into their latches on a carrier that is held by a hub
//! too heavy to move, so that every impulse is known and nothing else turns the carrier's hinge.

use std::f64::consts::{FRAC_PI_2, PI};

use nboom::model::{
    Body, Hinge, HingeStart, HingeState, Joint, MassProperties, Material, Mount, Scene,
    SceneDescription, SectionShape, SegmentStructure, Station, Stops, Structure,
};
use nboom::scalar::{Mat3, Sym3, Vec3};
use nboom::sim::{EventKind, Options, SimError, simulate};
use nboom::strength::{
    Cause, HingeQuantity, PulseShape, Settings, StrengthError, StressAnalysis, WorstHingeLoad,
};

const MASS: f64 = 2.0;
const LENGTH: f64 = 1.5;

/// Of a rod about its end.
const INERTIA: f64 = MASS * LENGTH * LENGTH / 3.0;

/// How much more than the rods the hub is, and what the hub's own motion may change.
const HEAVY: f64 = 1e10;

/// By what the search may miss, and the hub's motion.
const TOLERANCE: f64 = 5e-8;

/// A rod that turns at `rate` and locks at `time`.
#[derive(Clone, Copy)]
struct Latch {
    time: f64,
    rate: f64,
    pulse_constant: f64,
}

impl Latch {
    /// The torque impulse by which the carrier's hinge takes the rod's angular momentum.
    fn impulse(&self) -> f64 {
        INERTIA * self.rate
    }

    fn duration(&self) -> f64 {
        FRAC_PI_2 * self.pulse_constant
    }

    fn torque(&self, time: f64) -> f64 {
        let phase = (time - self.time) / self.duration();
        let is_on = (0.0..=1.0).contains(&phase);
        if is_on { self.impulse() / self.pulse_constant * (PI * phase).sin() } else { 0.0 }
    }
}

fn scene(latches: &[Latch], end_time: f64) -> (Scene, Structure) {
    let hub = MassProperties::new(HEAVY, Vec3::zero(), Sym3::diagonal(HEAVY, HEAVY, HEAVY));
    let mut description = SceneDescription::at_rest("latches on a carrier", hub, end_time);
    let mount = Mount { point: Vec3::zero(), rot_inboard_from_hinge: Mat3::identity() };
    let body = |inboard, mass_properties, hinge| {
        let axis = Vec3::unit_x();
        let (joint, tip) = (Joint::Revolute, Vec3::zero());
        Body { inboard, mount, joint, axis, mass_properties, tip, hinge }
    };
    let small = MassProperties::new(0.1, Vec3::zero(), Sym3::diagonal(0.1, 0.1, 0.1));
    let held = HingeStart { angle: 0.0, rate: 0.0, state: HingeState::Locked };
    let held = Hinge { lock_angle: Some(0.0), start: held, ..Hinge::free() };
    description.bodies.push(body(None, small, held));
    let across = MASS * LENGTH * LENGTH / 12.0;
    let inertia = Sym3::diagonal(across, 1e-3, across);
    let rod = MassProperties::new(MASS, Vec3::unit_y() * (0.5 * LENGTH), inertia);
    for latch in latches {
        let (angle, rate) = (-latch.rate * latch.time, latch.rate);
        let start = HingeStart { angle, rate, state: HingeState::Free };
        let hinge = Hinge { lock_angle: Some(0.0), start, ..Hinge::free() };
        description.bodies.push(body(Some(0), rod, hinge));
    }
    let scene = Scene::new(description).expect("rods are bodies");
    let constants = [1.0].into_iter().chain(latches.iter().map(|latch| latch.pulse_constant));
    let segment = |(body, pulse_constant): (&Body, f64)| SegmentStructure {
        pulse_constant,
        material: Material::elastic(7e10, 0.3),
        stations: vec![Station {
            distance_from_hinge: 0.0,
            slice: body.mass_properties,
            section: SectionShape::Tube { radius: 0.05, thickness: 0.001 },
        }],
    };
    let segments = scene.bodies.iter().zip(constants).map(segment).collect();
    let structure = Structure::new(&scene, segments).expect("each slice is its body");
    (scene, structure)
}

fn analysed(latches: &[Latch], end_time: f64, pulses: PulseShape) -> StressAnalysis {
    analysis_of(&scene(latches, end_time), pulses)
}

fn analysis_of((scene, structure): &(Scene, Structure), pulses: PulseShape) -> StressAnalysis {
    let settings = Settings { pulses, ..Settings::default() };
    let mut analysis = StressAnalysis::new(scene, structure, settings).expect("tubes");
    let options = Options { samples: 1, rtol: 1e-12, atol: 1e-14, ..Options::default() };
    simulate(scene, &options, &mut analysis).expect("rods that turn");
    analysis.finish().expect("finite loads");
    analysis
}

/// The largest moment of the carrier's hinge.
fn worst(latches: &[Latch], end_time: f64, pulses: PulseShape) -> WorstHingeLoad {
    worst_of(&analysed(latches, end_time, pulses))
}

fn worst_of(analysis: &StressAnalysis) -> WorstHingeLoad {
    let envelope = analysis.hinge_envelope();
    let [_, moment, ..] = &envelope[..] else { panic!("two quantities for each hinge") };
    assert_eq!((moment.hinge.appendage, moment.hinge.segment), (0, 0));
    assert_eq!(moment.quantity, HingeQuantity::Moment);
    moment.clone()
}

fn is_near(found: f64, expected: f64) {
    assert!((found / expected - 1.0).abs() < TOLERANCE, "{found}, not {expected}");
}

/// The largest sum of torques at very many times.
fn largest_sum(latches: &[Latch], until: f64) -> f64 {
    let times = (0..=2_000_000).map(|i| until * f64::from(i) / 2e6);
    let sum = |time: f64| latches.iter().map(|latch| latch.torque(time)).sum::<f64>();
    // Where a pulse ends there is a corner.
    let ends = latches.iter().map(|latch| latch.time + latch.duration());
    times.chain(ends).map(|time| sum(time).abs()).fold(0.0, f64::max)
}

const FIRST: Latch = Latch { time: 0.4, rate: 1.0, pulse_constant: 0.1 };

#[test]
fn a_pulse_is_half_a_sine_that_starts_with_the_lock_up() {
    let found = worst(&[FIRST], 1.0, PulseShape::HalfSine);
    is_near(found.magnitude(), FIRST.impulse() / FIRST.pulse_constant);
    assert!((found.time - FIRST.time - 0.5 * FIRST.duration()).abs() < 1e-9, "{found:?}");
    let Cause::Pulse { hinge: 1, kind: EventKind::LockUp, share } = found.cause else {
        panic!("{found:?}")
    };
    is_near(share, 1.0);
}

/// A spring brings its body to rest in a quarter of its period.
#[test]
fn a_latch_as_stiff_as_a_spring_has_the_springs_largest_torque() {
    for (rate, stiffness) in [(0.5, 6000.0), (-2.0, 50.0)] {
        let latch = Latch { rate, pulse_constant: f64::sqrt(INERTIA / stiffness), ..FIRST };
        let found = worst(&[latch], 1.0, PulseShape::HalfSine);
        is_near(found.magnitude(), rate.abs() * f64::sqrt(INERTIA * stiffness));
        let stopped = worst_of(&analysis_of(&on_a_spring(latch, stiffness), PulseShape::HalfSine));
        is_near(found.magnitude(), stopped.magnitude());
        // The top is flat: a share of 1e-8 of the height is a share of 1e-4 of the width.
        let until_rest = stopped.time / latch.duration() - 1.0;
        assert!(until_rest.abs() < 1e-4, "{stopped:?}");
    }
}

/// A stop in the latch's place, from which the rod rebounds.
#[test]
fn a_stop_has_the_pulse_of_its_impulse() {
    let (scene, structure) = scene(&[FIRST], 1.0);
    let mut description = SceneDescription::clone(&scene);
    let hinge = &mut description.bodies[1].hinge;
    hinge.lock_angle = None;
    hinge.stops = Stops { upper: 0.0, restitution: 0.4, ..Stops::NONE };
    let scene = Scene::new(description).expect("a stop");
    let found = worst_of(&analysis_of(&(scene, structure), PulseShape::HalfSine));
    is_near(found.magnitude(), 1.4 * FIRST.impulse() / FIRST.pulse_constant);
    assert!((found.time - FIRST.time - 0.5 * FIRST.duration()).abs() < 1e-9, "{found:?}");
    let Cause::Pulse { hinge: 1, kind: EventKind::Impact, .. } = found.cause else {
        panic!("{found:?}")
    };
}

/// The rod of a latch with a spring in the latch's place, from the time when it arrives on.
fn on_a_spring(latch: Latch, stiffness: f64) -> (Scene, Structure) {
    let at_once = Latch { time: 0.0, ..latch };
    let (scene, structure) = scene(&[at_once], 1.5 * latch.duration());
    let mut description = SceneDescription::clone(&scene);
    let hinge = &mut description.bodies[1].hinge;
    hinge.lock_angle = None;
    hinge.spring.linear = -stiffness;
    (Scene::new(description).expect("a spring"), structure)
}

/// A sin θ + A sin(θ − φ) is 2 A cos(φ/2) at θ = (π + φ)/2.
#[test]
fn two_half_sines_are_superposed_over_time() {
    for apart in [0.01, 0.1, 0.3, 0.6, 0.8] {
        let later = FIRST.time + apart * FIRST.duration();
        let latches = [FIRST, Latch { time: later, ..FIRST }];
        let found = worst(&latches, 1.0, PulseShape::HalfSine);
        let (peak, phase) = (FIRST.impulse() / FIRST.pulse_constant, PI * apart);
        let alone = if phase > FRAC_PI_2 { peak } else { 0.0 };
        is_near(found.magnitude(), (2.0 * peak * (0.5 * phase).cos()).max(alone));
        if alone == 0.0 {
            let middle = FIRST.time + 0.5 * (1.0 + apart) * FIRST.duration();
            // The top is flat: a share of 1e-8 of the height is a share of 1e-4 of the width.
            assert!((found.time - middle).abs() < 1e-4 * FIRST.duration(), "{found:?}");
        }
        let at_once = worst(&latches, 1.0, PulseShape::AllAtOnce);
        is_near(at_once.magnitude(), 2.0 * peak);
    }
}

/// Where pulses counteract, one may act without the other, before or after it.
#[test]
fn all_at_once_bounds_pulses_that_counteract() {
    for (rate, apart) in [(-0.4, 0.2), (-1.0, 0.2), (-3.0, 0.2), (-1.0, 0.0)] {
        let other = Latch { time: FIRST.time + apart * FIRST.duration(), rate, ..FIRST };
        let peak = |latch: &Latch| latch.impulse().abs() / latch.pulse_constant;
        let at_once = worst(&[FIRST, other], 1.0, PulseShape::AllAtOnce).magnitude();
        is_near(at_once, peak(&FIRST).max(peak(&other)));
        let over_time = worst(&[FIRST, other], 1.0, PulseShape::HalfSine).magnitude();
        let expected = largest_sum(&[FIRST, other], 1.0);
        assert!((over_time - expected).abs() < TOLERANCE * at_once, "{over_time} {expected}");
        assert!(over_time < at_once, "{rate}: {over_time} {at_once}");
    }
}

/// Peaks of two lock-ups that a pulse is longer than apart: each until the other locks.
#[test]
fn peaks_of_lock_ups_are_never_above_the_envelope() {
    for rate in [2.0, -2.0] {
        let latches = [FIRST, Latch { time: FIRST.time + 0.3 * FIRST.duration(), rate, ..FIRST }];
        let mut analysis = analysed(&latches, 1.0, PulseShape::HalfSine);
        let envelope = analysis.hinge_envelope()[1].magnitude();
        let peaks = analysis.settled();
        let moments = peaks.iter().map(|peaks| peaks.hinge_loads[0].moment.norm());
        let [first, second] = moments.collect::<Vec<f64>>()[..] else { panic!("{peaks:?}") };
        // The first pulse rises until the other hinge locks.
        is_near(first, FIRST.torque(latches[1].time));
        is_near(second, envelope);
        is_near(second, largest_sum(&latches, 1.0));
    }
}

#[test]
fn unlike_pulses_are_superposed_over_time() {
    let rates = [(0.7, 0.03), (-0.8, 0.06), (-2.0, 0.1), (1.3, 0.25)];
    for (i, (rate, pulse_constant)) in rates.into_iter().enumerate() {
        let other = Latch { time: 0.43 + 0.02 * i as f64, rate, pulse_constant };
        let latches = [FIRST, other];
        let found = worst(&latches, 0.9, PulseShape::HalfSine);
        is_near(found.magnitude(), largest_sum(&latches, 1.2));
    }
}

#[test]
fn what_locks_almost_at_once_acts_as_at_once() {
    for rate in [1.0, 3.0, -0.5] {
        let together = Latch { rate, pulse_constant: 0.07, ..FIRST };
        let at_once = worst(&[FIRST, together], 1.0, PulseShape::HalfSine).magnitude();
        for apart in [1e-10, 1e-8] {
            let after = Latch { time: FIRST.time + apart, ..together };
            let found = worst(&[FIRST, after], 1.0, PulseShape::HalfSine).magnitude();
            // By what torques change meanwhile, π/T of a peak per unit of time.
            let change = (found / at_once - 1.0).abs();
            assert!(change < TOLERANCE + 50.0 * apart, "{rate} {apart:e}: {change:e}");
        }
    }
}

#[test]
fn the_hinge_with_the_largest_share_is_named() {
    let small = Latch { rate: 0.5, ..FIRST };
    for (latches, largest) in [([FIRST, small], 1), ([small, FIRST], 2)] {
        let found = worst(&latches, 1.0, PulseShape::HalfSine);
        let Cause::Pulse { hinge, share, .. } = found.cause else { panic!("{found:?}") };
        assert_eq!(hinge, largest);
        is_near(share, 2.0 / 3.0);
        let stresses = analysed(&latches, 1.0, PulseShape::HalfSine).envelope();
        let Cause::Pulse { hinge, share, .. } = stresses[0].cause else { panic!("{stresses:?}") };
        assert_eq!(hinge, largest);
        // The rods pull as well.
        assert!(share > 0.6 && share < 2.0 / 3.0, "{share}");
    }
}

#[test]
fn a_pulse_comes_to_its_end_after_the_run() {
    let whole = worst(&[FIRST], 1.0, PulseShape::HalfSine);
    let cut = worst(&[FIRST], FIRST.time + 1e-3, PulseShape::HalfSine);
    is_near(cut.magnitude(), whole.magnitude());
    assert!((cut.time - whole.time).abs() < 1e-9, "{cut:?} {whole:?}");
}

#[test]
fn a_pulse_may_be_shorter_than_times_are_apart() {
    let sudden = Latch { pulse_constant: 1e-20, ..FIRST };
    let found = worst(&[sudden], 1.0, PulseShape::HalfSine);
    is_near(found.magnitude(), sudden.impulse() / sudden.pulse_constant);
}

#[test]
fn impulses_are_told_apart_from_the_motions_loads() {
    use std::io;

    use nboom::sim::{InstantMotion, Recorder};

    /// Keeps the impulses of the carrier's hinge.
    struct Impulses(StressAnalysis, Vec<(usize, f64, f64)>);

    impl Recorder for Impulses {
        fn needs_instants(&self) -> bool {
            true
        }
        fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
            self.0.instant(instant).map_err(io::Error::other)?;
            let of_carrier = self.0.latch_impulses().iter().map(|found| {
                let load = found.hinges[0];
                (found.hinge, load.moment.x, load.force.norm())
            });
            self.1.extend(of_carrier);
            Ok(())
        }
    }

    let latches = [FIRST, Latch { rate: -2.0, ..FIRST }];
    let (scene, _) = scene(&latches, 1.0);
    // No structure, no pulse constants: impulses are known nevertheless.
    let analysis = StressAnalysis::of_hinges(&scene, None, Settings::default());
    let mut found = Impulses(analysis.expect("settings"), Vec::new());
    simulate(&scene, &Options::default(), &mut found).expect("rods that turn");
    // The two may take turns by a rounding.
    found.1.sort_by_key(|(latch, ..)| *latch);
    let [(1, first, _), (2, second, force)] = found.1[..] else { panic!("{:?}", found.1) };
    // The hinge stops what turns outboard of it.
    is_near(first, -latches[0].impulse());
    is_near(second, -latches[1].impulse());
    is_near(force, MASS * 0.5 * LENGTH * 2.0);
    // The envelope then has the motion alone, which turns no carrier.
    let envelope = found.0.hinge_envelope();
    assert!(envelope[1].magnitude() < 1e-6 && envelope[1].cause == Cause::Motion);
    is_near(envelope[4].magnitude(), MASS * 0.5 * LENGTH * 4.0);
}

/// A spring swings a rod with the angle B cos ω t. With B above 1 the hinge pulls most as the rod
/// passes the middle of its swing, m B² ω² L/2, wherever output times are.
#[test]
fn a_pendulum_is_pulled_most_in_the_middle_of_its_swing() {
    let (stiffness, amplitude, end_time) = (3.0, 1.4, 2.9);
    let swinging = Latch { time: 0.0, rate: 0.0, pulse_constant: 1.0 };
    let (scene, structure) = scene(&[swinging], end_time);
    let mut description = SceneDescription::clone(&scene);
    let hinge = &mut description.bodies[1].hinge;
    hinge.spring.linear = -stiffness;
    hinge.lock_angle = None;
    hinge.start.angle = amplitude;
    let scene = Scene::new(description).expect("a spring may be added");
    for samples in [1, 7] {
        let mut analysis = StressAnalysis::new(&scene, &structure, Settings::default());
        let analysis = analysis.as_mut().expect("tubes");
        let options = Options { samples, rtol: 1e-11, atol: 1e-13, ..Options::default() };
        simulate(&scene, &options, analysis).expect("a pendulum");
        analysis.finish().expect("finite loads");
        let force = &analysis.hinge_envelope()[2];
        assert_eq!(force.quantity, HingeQuantity::Force);
        let omega_squared = stiffness / INERTIA;
        let expected = MASS * 0.5 * LENGTH * amplitude * amplitude * omega_squared;
        is_near(force.magnitude(), expected);
        let quarter = FRAC_PI_2 / omega_squared.sqrt();
        let passes = [1.0, 3.0].map(|quarters| (force.time - quarters * quarter).abs());
        // A flat top again.
        assert!(passes[0].min(passes[1]) < 1e-3, "{force:?}");
    }
}

#[test]
fn a_pulse_so_short_that_stresses_overflow_ends_the_run() {
    // The first makes moments whose squares overflow, the second stresses that do.
    for pulse_constant in [1e-200, 1e-302] {
        let latch = Latch { time: 0.1, rate: 2.0, pulse_constant };
        let (scene, structure) = scene(&[latch], 0.2);
        let mut analysis =
            StressAnalysis::new(&scene, &structure, Settings::default()).expect("tubes");
        let failure = simulate(&scene, &Options::default(), &mut analysis).expect_err("overflow");
        let SimError::Record { source, .. } = &failure.error else { panic!("{failure}") };
        let cause = source.get_ref().and_then(|source| source.downcast_ref());
        let Some(StrengthError::NotFinite { time }) = cause else { panic!("{failure}") };
        is_near(*time, latch.time);
    }
}
