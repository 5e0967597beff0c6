use nboom_loads::{LoadEquations, LoadSet, Loads, LockUpShare, SceneMotion, VelocityChange};
use nboom_model::{HingeLabel, Scene, Structure};
use nboom_scalar::{Kernel, Wrench};
use nboom_sections::{AtStation, PointStress, Section};
use nboom_sim::{Detail, InstantMotion, Jump, Snapshot};

use crate::envelope::driver;
use crate::formulas::Formulas;
use crate::{Cause, Settings, Slip, StrengthError, Worst};

/// Follows the stresses of a run.
#[derive(Clone, Debug)]
pub struct StressAnalysis {
    settings: Settings,
    labels: Vec<HingeLabel>,
    pulse_constants: Vec<f64>,
    loads: Loads,
    found: LoadSet,
    force_densities: Vec<f64>,
    sections: Vec<StationSection>,
    stresses: Vec<StationStress>,
    /// The worst of each station; none before the first evaluation.
    envelope: Vec<Worst>,
    largest_residual: f64,
    most_residual: f64,
}

/// The section of a station.
#[derive(Clone, Debug)]
struct StationSection {
    segment: usize,
    station: usize,
    section: Formulas,
}

/// Load and stresses of one station at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StationStress {
    /// The segment, as its hinge is numbered in the scene.
    pub segment: usize,
    /// The station, from 0, outboard ones first.
    pub station: usize,
    /// Force and moment on the part outboard of the station, about the point on the η axis,
    /// segment axes.
    pub load: Wrench<f64>,
    /// At 0, 90, 180 and 270 degrees; a section that is not convex may lack some.
    pub axis_points: [Option<PointStress>; 4],
    /// Where the von Mises stress is largest.
    pub severest: PointStress,
}

/// Largest difference between the load about a free hinge's axis and its torque, in shares of what
/// the load is made of. Both follow from accelerations that are good to 1e-11 of their size, of
/// which a light boom on a heavy chain takes a small difference. A motion that repeats a slip by
/// which forces and accelerations contradict each other is not held to it.
const BALANCE: f64 = 1e-7;

impl StressAnalysis {
    /// The analysis of `scene`, whose stations are in `structure`.
    ///
    /// # Errors
    /// When a section or a setting is not one.
    pub fn new(
        scene: &Scene,
        structure: &Structure,
        settings: Settings,
    ) -> Result<Self, StrengthError> {
        settings.check()?;
        let labels: Vec<HingeLabel> = (0..scene.bodies.len()).map(|i| scene.label(i)).collect();
        let found = Section::all(structure).map_err(|AtStation { segment, station, here }| {
            StrengthError::Section { segment: labels[segment], station, source: here }
        })?;
        let influences: Vec<_> = found.iter().map(|at| at.here.influence()).collect();
        let sections = found.into_iter().map(|AtStation { segment, station, here }| {
            StationSection { segment, station, section: Formulas::new(here, settings.slips) }
        });
        let sections = sections.collect();
        let equations = LoadEquations::new(scene, Some(structure)).with_sections(influences);
        let loads = Loads::by(equations);
        let found = loads.load_set();
        let pulse_constants = structure.segments().iter().map(|s| s.pulse_constant).collect();
        let (stresses, envelope) = (Vec::new(), Vec::new());
        Ok(Self {
            settings,
            labels,
            pulse_constants,
            force_densities: vec![0.0; scene.bodies.len()],
            loads,
            found,
            sections,
            stresses,
            envelope,
            largest_residual: 0.0,
            most_residual: if scene.slips().obey_newton() { BALANCE } else { f64::INFINITY },
        })
    }

    /// The same with the code among `kernels`, if there is any, that was generated for this scene
    /// and structure.
    pub fn with_kernels(self, kernels: &[Kernel]) -> Self {
        Self { loads: self.loads.with_kernels(kernels), ..self }
    }

    /// Instruction set of the generated code that finds the loads, if any does.
    pub fn generated_for(&self) -> Option<&'static str> {
        self.loads.generated_for()
    }

    /// Loads and stresses of the motion at an output time.
    ///
    /// # Errors
    /// When the loads contradict the motion.
    pub fn motion(
        &mut self,
        snapshot: &Snapshot,
        detail: &Detail,
    ) -> Result<&[StationStress], StrengthError> {
        self.load(snapshot, detail, &[])?;
        self.judge(snapshot.time, Cause::Motion);
        Ok(self.with_axis_points())
    }

    /// Loads and stresses on both sides of an instant with events, for the envelope. Where hinges
    /// lock, those of the peaks are returned: what the motion just before makes, and the pulses of
    /// the hinges that lock, eqs. (10.7) to (10.14).
    ///
    /// # Errors
    /// When the loads contradict the motion.
    pub fn instant(&mut self, instant: &InstantMotion) -> Result<&[StationStress], StrengthError> {
        let InstantMotion { before, jumps, after } = instant;
        for side in before.iter().chain([after]) {
            if let Some(detail) = &side.detail {
                self.load(side, detail, &[])?;
                self.judge(side.time, Cause::Motion);
            }
        }
        self.stresses.clear();
        let detailed = before.as_ref().and_then(|before| Some((before, before.detail.as_ref()?)));
        if let (Some((before, detail)), [first, ..]) = (detailed, &jumps[..]) {
            self.load(before, detail, jumps)?;
            self.judge(before.time, Cause::LockUp { hinge: first.hinge });
        }
        Ok(self.with_axis_points())
    }

    /// Load and stresses of every station at the last output time or lock-up; none after an instant in
    /// which no hinge locks.
    pub fn stresses(&self) -> &[StationStress] {
        &self.stresses
    }

    /// Force and moment that each hinge exerts on its outboard body, about the hinge point,
    /// segment axes; of the same time.
    pub fn hinge_loads(&self) -> impl Iterator<Item = Wrench<f64>> {
        (0..self.labels.len()).map(|i| self.found.hinge(i))
    }

    /// The worst of each station so far; nothing before the first motion.
    pub fn envelope(&self) -> &[Worst] {
        &self.envelope
    }

    /// The largest difference so far between the load about a free hinge's axis and its torque, in
    /// shares of what the load is made of.
    pub fn largest_residual(&self) -> f64 {
        self.largest_residual
    }

    /// Finds the loads of a motion, and of the pulses of hinges that lock.
    fn load(
        &mut self,
        snapshot: &Snapshot,
        detail: &Detail,
        jumps: &[Jump],
    ) -> Result<(), StrengthError> {
        let springs = detail.kick_off_force.iter().zip(&detail.kick_off_length);
        for (density, (&force, &length)) in self.force_densities.iter_mut().zip(springs) {
            *density = if force == 0.0 { 0.0 } else { force / length };
        }
        let motion = SceneMotion {
            omega_body: snapshot.omega_body,
            beta: &snapshot.beta,
            tau: &snapshot.tau,
            acceleration: VelocityChange {
                origin_body: detail.origin_acceleration_body,
                omega_body: detail.omega_dot_body,
                tau: &detail.beta_ddot,
            },
            force_densities: &self.force_densities,
        };
        self.loads.continuous(&motion, &mut self.found);
        self.check_balance(snapshot, detail)?;
        jumps.iter().for_each(|jump| self.add_pulse(&snapshot.beta, jump));
        if self.settings.slips.contains(Slip::LoadTransfer) {
            self.loads.hand_on_as_in_1970(&snapshot.beta, &mut self.found);
        }
        Ok(())
    }

    fn check_balance(&mut self, snapshot: &Snapshot, detail: &Detail) -> Result<(), StrengthError> {
        let torques = &detail.hinge_torque;
        let residual = self.loads.largest_torque_residual(&self.found, &snapshot.hinges, torques);
        let Some((hinge, residual)) = residual else { return Ok(()) };
        self.largest_residual = self.largest_residual.max(residual);
        let most = self.most_residual;
        if residual <= most {
            return Ok(());
        }
        let hinge = self.labels[hinge];
        Err(StrengthError::Unbalanced { time: snapshot.time, hinge, residual, most })
    }

    fn add_pulse(&mut self, beta: &[f64], jump: &Jump) {
        let share = LockUpShare {
            pulse_constant: self.pulse_constants[jump.hinge],
            jump: VelocityChange {
                origin_body: jump.velocity_body,
                omega_body: jump.omega_body,
                tau: &jump.tau,
            },
        };
        self.loads.add_lock_up(beta, &[share], self.settings.amplification, &mut self.found);
    }

    /// The largest stresses under the loads found, for the envelope too.
    fn judge(&mut self, time: f64, cause: Cause) {
        let Self { settings, labels, found, sections, stresses, envelope, .. } = self;
        stresses.clear();
        stresses.extend(sections.iter().map(|at| {
            let load = found.stations(at.segment)[at.station];
            let stresses = at.section.stresses(&load, found.stresses(at.segment)[at.station]);
            let (segment, station, severest) = (at.segment, at.station, stresses.severest());
            StationStress { segment, station, load, axis_points: [None; 4], severest }
        }));
        let worst = |(at, stress): (&StationSection, &StationStress)| Worst {
            segment: labels[at.segment],
            station: at.station,
            time,
            cause,
            load: stress.load,
            severest: stress.severest,
            driver: driver(&at.section, &stress.load, &stress.severest),
            margin: settings.margin(stress.severest.stress.von_mises()),
        };
        if envelope.is_empty() {
            envelope.extend(sections.iter().zip(&*stresses).map(worst));
            return;
        }
        for (worst_yet, now) in envelope.iter_mut().zip(sections.iter().zip(&*stresses)) {
            let von_mises = |point: &PointStress| point.stress.von_mises();
            if von_mises(&now.1.severest) > von_mises(&worst_yet.severest) {
                *worst_yet = worst(now);
            }
        }
    }

    /// Adds the axis points to the largest stresses.
    fn with_axis_points(&mut self) -> &[StationStress] {
        for (at, stress) in self.sections.iter().zip(&mut self.stresses) {
            let numbers = self.found.stresses(at.segment)[at.station];
            stress.axis_points = at.section.stresses(&stress.load, numbers).axis_points();
        }
        &self.stresses
    }
}
