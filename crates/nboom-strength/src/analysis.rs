use nboom_loads::{LoadSet, Loads, LockUpShare, SceneMotion, VelocityChange};
use nboom_model::{HingeLabel, Scene, SectionShape, Structure};
use nboom_scalar::Wrench;
use nboom_sections::{Point, PointStress, Polygon, Section, SectionError, SectionWarning, Tube};
use nboom_sim::{Detail, LockUpMotion, Snapshot};

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
    warnings: Vec<SectionWarning>,
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
        let mut sections = Vec::new();
        for (segment, description) in structure.segments().iter().enumerate() {
            for (station, of_station) in description.stations.iter().enumerate() {
                let at_station =
                    |source| StrengthError::Section { segment: labels[segment], station, source };
                let section = section(&of_station.section).map_err(at_station)?;
                let warnings = section.warnings();
                let section = Formulas::new(section, settings.slips);
                sections.push(StationSection { segment, station, warnings, section });
            }
        }
        let loads = Loads::new(scene, Some(structure));
        let found = loads.load_set();
        let pulse_constants = structure.segments().iter().map(|s| s.pulse_constant).collect();
        let (stresses, envelope) = (Vec::new(), Vec::new());
        Ok(Self {
            settings,
            labels,
            pulse_constants,
            loads,
            found,
            sections,
            stresses,
            envelope,
            largest_residual: 0.0,
            most_residual: if scene.slips().obey_newton() { BALANCE } else { f64::INFINITY },
        })
    }

    /// Where thin-wall theory may not hold, a line for each station.
    pub fn warnings(&self) -> Vec<String> {
        let stations = self.sections.iter();
        let lines = stations.flat_map(|at| {
            let place = format!("segment {}, station {}", self.labels[at.segment], at.station + 1);
            at.warnings.iter().map(move |warning| format!("{place}: {warning}"))
        });
        lines.collect()
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
        self.load(snapshot, detail)?;
        self.hand_on(&snapshot.beta);
        Ok(self.judge(snapshot.time, Cause::Motion))
    }

    /// Peak loads and stresses of a lock-up: those of the motion just before and the pulses of the
    /// hinges that lock, eqs. (10.7) to (10.14).
    ///
    /// # Errors
    /// When the loads contradict the motion.
    pub fn lock_up(
        &mut self,
        lock_up: &LockUpMotion,
        detail: &Detail,
    ) -> Result<&[StationStress], StrengthError> {
        let before = &lock_up.before;
        self.load(before, detail)?;
        for jump in &lock_up.jumps {
            let share = LockUpShare {
                pulse_constant: self.pulse_constants[jump.hinge],
                jump: VelocityChange {
                    origin_body: jump.velocity_body,
                    omega_body: jump.omega_body,
                    tau: &jump.tau,
                },
            };
            let amplification = self.settings.amplification;
            self.loads.add_lock_up(&before.beta, &[share], amplification, &mut self.found);
        }
        self.hand_on(&before.beta);
        let hinge = lock_up.jumps.first().map_or(0, |jump| jump.hinge);
        Ok(self.judge(before.time, Cause::LockUp { hinge }))
    }

    /// Load and stresses of every station in the last motion or lock-up.
    pub fn stresses(&self) -> &[StationStress] {
        &self.stresses
    }

    /// Force and moment that each hinge exerts on its outboard body, about the hinge point,
    /// segment axes; of the last motion or lock-up.
    pub fn hinge_loads(&self) -> impl Iterator<Item = Wrench<f64>> {
        (0..self.labels.len()).map(|i| self.found.hinge(i))
    }

    /// The worst of each station so far; nothing before the first motion or lock-up.
    pub fn envelope(&self) -> &[Worst] {
        &self.envelope
    }

    /// The largest difference so far between the load about a free hinge's axis and its torque, in
    /// shares of what the load is made of.
    pub fn largest_residual(&self) -> f64 {
        self.largest_residual
    }

    fn load(&mut self, snapshot: &Snapshot, detail: &Detail) -> Result<(), StrengthError> {
        let motion = SceneMotion {
            omega_body: snapshot.omega_body,
            beta: &snapshot.beta,
            tau: &snapshot.tau,
            acceleration: VelocityChange {
                origin_body: detail.origin_acceleration_body,
                omega_body: detail.omega_dot_body,
                tau: &detail.beta_ddot,
            },
            kick_off: &detail.kick_off_pushes,
        };
        self.loads.continuous(&motion, &mut self.found);
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

    /// Replaces the loads found by those of 1970, if they are asked for.
    fn hand_on(&mut self, beta: &[f64]) {
        if self.settings.slips.contains(Slip::LoadTransfer) {
            self.loads.hand_on_as_in_1970(beta, &mut self.found);
        }
    }

    /// Stresses under the loads found, for the envelope too.
    fn judge(&mut self, time: f64, cause: Cause) -> &[StationStress] {
        let Self { settings, labels, found, sections, stresses, envelope, .. } = self;
        stresses.clear();
        stresses.extend(sections.iter().map(|at| {
            let load = found.stations(at.segment)[at.station];
            StationStress {
                segment: at.segment,
                station: at.station,
                load,
                axis_points: at.section.axis_points(&load),
                severest: at.section.severest(&load),
            }
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
        } else {
            for (worst_yet, now) in envelope.iter_mut().zip(sections.iter().zip(&*stresses)) {
                let von_mises = |point: &PointStress| point.stress.von_mises();
                if von_mises(&now.1.severest) > von_mises(&worst_yet.severest) {
                    *worst_yet = worst(now);
                }
            }
        }
        stresses
    }
}

fn section(shape: &SectionShape) -> Result<Section, SectionError> {
    match shape {
        SectionShape::Tube { radius, thickness } => {
            Tube::new(*radius, *thickness).map(Section::Tube)
        }
        SectionShape::Polygon(vertices) => {
            let places: Vec<Point> =
                vertices.iter().map(|v| Point { xi: v.xi, zeta: v.zeta }).collect();
            let thicknesses: Vec<f64> = vertices.iter().map(|v| v.thickness).collect();
            let polygon = Polygon::new(&places, &thicknesses);
            polygon.map(Section::Polygon).map_err(|mut errors| errors.swap_remove(0))
        }
    }
}
