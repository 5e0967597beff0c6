//! Random satellites with stations, and what their loads are at many times, found one by one.

use std::io;

use nboom::loads::{LoadSet, Loads, LockUpShare, SceneMotion, VelocityChange};
use nboom::model::{
    Dashpot, Material, Scene, SectionShape, SegmentStructure, Station, Structure, Vertex,
};
use nboom::sections::Section;
use nboom::sim::{InstantMotion, Jump, MotionAt, Options, Recorder, Side, StepMotion, simulate};
use nboom::strength::{Settings, StressAnalysis};

use crate::collect::forces_and_lengths;
use crate::random_scene::{Rng, description};

/// A satellite with stations.
pub struct Satellite {
    pub scene: Scene,
    pub structure: Structure,
}

impl Satellite {
    /// A random tree with tubes, boxes and triangles, of which some hinges lock.
    pub fn new(bodies: usize, seed: u64) -> Self {
        let dice = &mut Rng::new(seed ^ 0x57ae55);
        let mut description = description(bodies, seed);
        let mut segments = Vec::new();
        for body in &mut description.bodies {
            // Nothing feeds energy, so that a run may be as long as one likes.
            let rate_linear = body.hinge.dashpot.rate_linear;
            body.hinge.dashpot = Dashpot { rate_linear, ..Dashpot::default() };
            body.hinge.spring.quadratic = 0.0;
            let start = body.hinge.start;
            if dice.chance(0.6) {
                let swing = dice.between(0.1, 1.5);
                body.hinge.lock_angle = Some(start.angle + swing.copysign(start.rate));
            }
            let stations: Vec<Station> = [1.1, 0.6, 0.0]
                .map(|distance_from_hinge| Station {
                    distance_from_hinge,
                    slice: dice.mass_properties(1.5, 0.8),
                    section: section(dice),
                })
                .into();
            let pulse_constant = dice.between(0.02, 0.5);
            let material = Material::elastic(7e10, 0.3);
            let segment = SegmentStructure { pulse_constant, material, stations };
            body.mass_properties = segment.mass_properties().expect("there are slices");
            segments.push(segment);
        }
        description.end_time = 2.0;
        let scene = Scene::new(description).expect("random slices are physical");
        let structure = Structure::new(&scene, segments).expect("slices make the segment");
        Self { scene, structure }
    }

    pub fn analysis(&self, settings: Settings) -> StressAnalysis {
        StressAnalysis::new(&self.scene, &self.structure, settings).expect("sections")
    }
}

fn section(dice: &mut Rng) -> SectionShape {
    let thickness = dice.between(0.001, 0.004);
    let (width, height) = (dice.between(0.05, 0.1), dice.between(0.05, 0.1));
    let vertex = |xi, zeta| Vertex { xi, zeta, thickness };
    match dice.below(3) {
        0 => SectionShape::Tube { radius: width, thickness },
        1 => SectionShape::Polygon(vec![
            vertex(width, height),
            vertex(-width, height),
            vertex(-width, -height),
            vertex(width, -height),
        ]),
        _ => SectionShape::Polygon(vec![
            vertex(width, 0.0),
            vertex(-width, height),
            vertex(-height, -width),
        ]),
    }
}

/// Stresses of all stations, then force and moment of each hinge, under some loads.
pub fn quantities(sections: &[Section], loads: &LoadSet, hinges: usize) -> Vec<f64> {
    let stations = (0..hinges).flat_map(|i| loads.stations(i));
    let stresses = stations
        .zip(sections)
        .map(|(load, section)| section.stresses(load).max_von_mises().stress.von_mises());
    let of_hinge = |i| [loads.hinge(i).force.norm(), loads.hinge(i).moment.norm()];
    stresses.chain((0..hinges).flat_map(of_hinge)).collect()
}

/// What an analysis has found, in the same order.
pub fn envelope(analysis: &StressAnalysis) -> Vec<f64> {
    let stresses = analysis.envelope().into_iter().map(|w| w.max_von_mises.stress.von_mises());
    let of_hinges = analysis.hinge_envelope().into_iter().map(|worst| worst.magnitude());
    stresses.chain(of_hinges).collect()
}

/// Loads at very many times of each step, and the largest of all quantities.
///
/// Pulses are superposed as the documents say, without any of the code that is to be tested.
pub struct BruteForce {
    /// Times within each step.
    times: usize,
    loads: Loads,
    sections: Vec<Section>,
    constants: Vec<f64>,
    hinges: usize,
    pub largest: Vec<f64>,
    /// Start, duration and loads at the peak.
    pub pulses: Vec<(f64, f64, LoadSet)>,
    /// Until when, and loads on one side of a lock-up.
    pub sides: Vec<(f64, LoadSet)>,
    /// Largest pulses that acted together.
    pub together: usize,
}

impl BruteForce {
    pub fn new(satellite: &Satellite, times: usize) -> Self {
        let Satellite { scene, structure } = satellite;
        let segments = structure.segments();
        let stations = segments.iter().flat_map(|segment| &segment.stations);
        let section = |station: &Station| Section::of_shape(&station.section).expect("a section");
        let sections: Vec<Section> = stations.map(section).collect();
        let hinges = scene.bodies.len();
        Self {
            times,
            loads: Loads::new(scene, Some(structure)),
            constants: segments.iter().map(|segment| segment.pulse_constant).collect(),
            hinges,
            largest: vec![0.0; sections.len() + 2 * hinges],
            sections,
            pulses: Vec::new(),
            sides: Vec::new(),
            together: 0,
        }
    }

    pub fn run(satellite: &Satellite, options: &Options, times: usize) -> Self {
        let mut found = Self::new(satellite, times);
        simulate(&satellite.scene, options, &mut found).expect("a run");
        let end = found.pulses.iter().map(|(start, duration, _)| start + duration);
        let (end, last) = (end.fold(0.0, f64::max), satellite.scene.end_time);
        if end > last {
            found.scan_sides([last, end]);
        }
        found
    }

    fn of_motion(&mut self, motion: &MotionAt<'_>) -> LoadSet {
        let [forces, lengths] = forces_and_lengths(motion.lines, motion.beta.len());
        let density = |(f, l): (f64, f64)| if f == 0.0 { 0.0 } else { f / l };
        let densities: Vec<f64> = forces.into_iter().zip(lengths).map(density).collect();
        let motion = SceneMotion {
            omega_body: motion.omega_body,
            beta: motion.beta,
            tau: motion.tau,
            acceleration: VelocityChange {
                origin_body: motion.origin_acceleration_body,
                omega_body: motion.omega_dot_body,
                tau: motion.beta_ddot,
            },
            force_densities: &densities,
            outside: motion.outside,
            rotors: motion.rotors,
        };
        let mut found = self.loads.load_set();
        self.loads.continuous(&motion, &mut found);
        found
    }

    /// All quantities at a time, from the loads of the motion.
    fn at(&self, time: f64, mut loads: LoadSet) -> Vec<f64> {
        for (start, duration, peak) in &self.pulses {
            let phase = (time - start) / duration;
            if (0.0..=1.0).contains(&phase) {
                loads.add_scaled(peak, (std::f64::consts::PI * phase).sin());
            }
        }
        quantities(&self.sections, &loads, self.hinges)
    }

    fn look(&mut self, time: f64, loads: LoadSet) {
        let found = self.at(time, loads);
        self.largest.iter_mut().zip(found).for_each(|(most, now)| *most = most.max(now));
    }

    /// Looks at many times, and closer around the one at which a quantity is largest if it is
    /// larger than it has been.
    fn scan(&mut self, [start, end]: [f64; 2], loads: &mut dyn FnMut(&mut Self, f64) -> LoadSet) {
        let spacing = (end - start) / self.times as f64;
        let mut best = vec![(0.0, start); self.largest.len()];
        for i in 0..=self.times {
            let time = start + spacing * i as f64;
            let found = loads(self, time);
            for (best, value) in best.iter_mut().zip(self.at(time, found)) {
                if value > best.0 {
                    *best = (value, time);
                }
            }
        }
        for (q, (value, time)) in best.into_iter().enumerate() {
            if value <= self.largest[q] {
                continue;
            }
            self.largest[q] = value;
            let (mut from, mut to) = ((time - spacing).max(start), (time + spacing).min(end));
            for _ in 0..40 {
                let third = (to - from) / 3.0;
                let [a, b] = [from + third, to - third].map(|time| {
                    let found = loads(self, time);
                    self.at(time, found)[q]
                });
                self.largest[q] = self.largest[q].max(a).max(b);
                if a < b { from += third } else { to -= third }
            }
        }
    }

    fn scan_sides(&mut self, [start, end]: [f64; 2]) {
        for (until, side) in self.sides.clone() {
            if start < until {
                self.scan([start, end.min(until)], &mut |_, _| side.clone());
            }
        }
    }

    fn add_pulse(&mut self, time: f64, beta: &[f64], jump: &Jump) -> f64 {
        let pulse_constant = self.constants[jump.hinge];
        let (origin_body, omega_body) = (jump.velocity_body, jump.omega_body);
        let jump = VelocityChange { origin_body, omega_body, tau: &jump.tau };
        let mut peak = self.loads.load_set();
        let share = LockUpShare { pulse_constant, jump };
        self.loads.add_lock_up(beta, &[share], 1.0, &mut peak);
        // The area of half a sine of height 1/c is 1.
        let duration = std::f64::consts::FRAC_PI_2 * pulse_constant;
        self.pulses.push((time, duration, peak));
        time + duration
    }
}

impl Recorder for BruteForce {
    fn needs_instants(&self) -> bool {
        true
    }

    fn instant(&mut self, instant: &InstantMotion) -> io::Result<()> {
        let time = instant.after.snapshot.time;
        let mut until: f64 = 0.0;
        let mut sides = Vec::new();
        for Side { snapshot, detail } in instant.sides() {
            let loads = self.of_motion(&MotionAt::of(snapshot, detail));
            self.look(time, loads.clone());
            sides.push(loads);
        }
        for jump in instant.jumps {
            until = until.max(self.add_pulse(time, &instant.after.snapshot.beta, jump));
        }
        let acts = |(start, duration, _): &&(f64, f64, LoadSet)| start + duration > time;
        self.together = self.together.max(self.pulses.iter().filter(acts).count());
        if !instant.jumps.is_empty() {
            self.sides.extend(sides.into_iter().map(|loads| (until, loads)));
        }
        Ok(())
    }

    fn needs_steps(&self) -> bool {
        true
    }

    fn step(&mut self, step: &mut dyn StepMotion) -> io::Result<()> {
        let span = step.span();
        self.scan(span, &mut |all, time| all.of_motion(&step.at(time)));
        self.scan_sides(span);
        Ok(())
    }
}
