use nboom_loads::LoadEquations;
use nboom_model::{HingeLabel, Scene, Structure};
use nboom_scalar::{Kernel, Wrench};
use nboom_sections::{AtStation, Section};
use nboom_sim::{Detail, InstantMotion, MotionAt, Snapshot, StepMotion};

use crate::envelope::driver;
use crate::finder::LoadFinder;
use crate::formulas::Formulas;
use crate::gauge::{Gauge, Measure};
use crate::piece::{search_pulses, search_step};
use crate::pulse::Pulses;
use crate::record::{Record, Records};
use crate::search::Search;
use crate::station::{StationPlace, set_stresses};
use crate::{
    HingeQuantity, LatchImpulses, LockUpPeaks, Settings, Slip, StationStress, StrengthError, Worst,
    WorstHingeLoad,
};

/// Share of the largest stress below which that of a station is rounding.
const ROUNDING: f64 = 1e-13;

/// Follows the loads of a run, and its stresses where sections are known.
///
/// As a [`Recorder`](nboom_sim::Recorder) it sees the whole run, from which it makes the envelope;
/// [`finish`](Self::finish) ends it. It also computes loads at output times on request.
#[derive(Clone, Debug)]
pub struct StressAnalysis {
    settings: Settings,
    labels: Vec<HingeLabel>,
    /// `None` without a structure.
    pulse_constants: Option<Vec<f64>>,
    finder: LoadFinder,
    stations: Vec<StationPlace>,
    search: Search,
    pulses: Pulses,
    /// End of the last step or instant.
    reached: f64,
    /// The worst of the run.
    worst: Records,
    /// Loads of pulses just before and just after lock-ups, since the last one.
    at_lock_up: Records,
    /// The last lock-up, while its pulses last.
    pending: Option<f64>,
    settled: Vec<LockUpPeaks>,
    /// Loads of the motion at one time.
    row: Vec<f64>,
    stresses: Vec<StationStress>,
    hinge_loads: Vec<Wrench<f64>>,
    latch_impulses: Vec<LatchImpulses>,
}

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
        let sections =
            Section::all(structure).map_err(|AtStation { segment, station, here }| {
                StrengthError::Section { segment: scene.label(segment), station, source: here }
            })?;
        let equations = LoadEquations::new(scene, Some(structure));
        Self::of(scene, equations, sections, Some(pulse_constants(structure)), settings)
    }

    /// The analysis of the hinges of any scene, without stresses. Pulse constants belong to a
    /// structure; without one, latches appear only as impulses.
    ///
    /// # Errors
    /// When a setting is not one.
    pub fn of_hinges(
        scene: &Scene,
        structure: Option<&Structure>,
        settings: Settings,
    ) -> Result<Self, StrengthError> {
        let equations = LoadEquations::new(scene, None);
        Self::of(scene, equations, Vec::new(), structure.map(pulse_constants), settings)
    }

    fn of(
        scene: &Scene,
        equations: LoadEquations,
        sections: Vec<AtStation<Section>>,
        pulse_constants: Option<Vec<f64>>,
        settings: Settings,
    ) -> Result<Self, StrengthError> {
        settings.check()?;
        let labels: Vec<HingeLabel> = (0..scene.bodies.len()).map(|i| scene.label(i)).collect();
        let influences: Vec<_> = sections.iter().map(|at| at.here.influence()).collect();
        let equations = equations.with_sections(influences);
        let hands_on = settings.slips.contains(Slip::LoadTransfer);
        let finder = LoadFinder::new(scene, labels.clone(), equations, hands_on);
        let loads = finder.load_set();
        let (mut stations, mut gauges) = (Vec::new(), Vec::new());
        for (i, AtStation { segment, station, here }) in sections.into_iter().enumerate() {
            stations.push(StationPlace { segment, station });
            gauges.push(Gauge::of_station(i, &loads, Formulas::new(here, settings.slips)));
        }
        gauges.extend((0..labels.len()).flat_map(|hinge| Gauge::of_hinge(hinge, &loads)));
        let records = Records::new(&gauges);
        Ok(Self {
            settings,
            labels,
            pulse_constants,
            stations,
            pulses: Pulses::new(settings.pulses),
            reached: f64::NEG_INFINITY,
            worst: records.clone(),
            at_lock_up: records,
            pending: None,
            settled: Vec::new(),
            row: vec![0.0; loads.count()],
            search: Search::new(gauges, loads.count()),
            finder,
            stresses: Vec::new(),
            hinge_loads: Vec::new(),
            latch_impulses: Vec::new(),
        })
    }

    /// This analysis with the code among `kernels`, if any, that was generated for this scene and
    /// structure.
    pub fn with_kernels(self, kernels: &[Kernel]) -> Self {
        Self { finder: self.finder.with_kernels(kernels), ..self }
    }

    /// How stresses are judged.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Whether there are stations, and so stresses.
    pub fn has_stations(&self) -> bool {
        !self.stations.is_empty()
    }

    /// Instruction set of the generated code that finds the loads, if any does.
    pub fn generated_for(&self) -> Option<&'static str> {
        self.finder.loads.generated_for()
    }

    /// Loads and stresses of the motion at an output time. Output times are within a step or
    /// instant, which the envelope covers; only a run of no length adds its one output time to the
    /// envelope here.
    ///
    /// # Errors
    /// When the loads contradict the motion, or are no numbers.
    pub fn motion(
        &mut self,
        snapshot: &Snapshot,
        detail: &Detail,
    ) -> Result<&[StationStress], StrengthError> {
        self.finder.write(&MotionAt::of(snapshot, detail), &mut self.row)?;
        if self.reached == f64::NEG_INFINITY {
            let acting = self.pulses.acting(snapshot.time);
            acting.for_each(|acting| {
                self.worst.look(&self.search.gauges, (acting, snapshot.time), &self.row);
            });
        }
        let Self { search, stations, row, stresses, hinge_loads, labels, .. } = self;
        let of_row = |gauge: &Gauge| (gauge.load(row), gauge.numbers(row));
        set_stresses(stresses, stations, &search.gauges, |g| of_row(&search.gauges[g]));
        hinge_loads.clear();
        let forces = &search.gauges[stations.len()..];
        hinge_loads.extend((0..labels.len()).map(|i| forces[2 * i].load(row)));
        Ok(&self.stresses)
    }

    /// The largest loads of a step, for the envelope.
    ///
    /// # Errors
    /// When the loads contradict the motion, or are no numbers.
    pub fn step(&mut self, step: &mut dyn StepMotion) -> Result<(), StrengthError> {
        let Self { search, finder, pulses, worst, .. } = self;
        search_step(search, step, finder, pulses, worst)?;
        let [_, end] = step.span();
        self.reached = end;
        let u = end - self.pulses.since;
        if self.pulses.end() <= u { self.settle(u) } else { Ok(()) }
    }

    /// Both sides of an instant with events, for the envelope. The pulses of hinges that lock start
    /// here if their constants are known, eqs. (10.7) to (10.14).
    ///
    /// # Errors
    /// When the loads contradict the motion, or are no numbers.
    pub fn instant(&mut self, instant: &InstantMotion) -> Result<(), StrengthError> {
        let InstantMotion { before, jumps, after } = instant;
        self.finder.jump();
        self.reached = after.time;
        self.latch_impulses.clear();
        let mut sides = Vec::new();
        for side in before.iter().chain([after]) {
            let Some(detail) = &side.detail else { continue };
            let mut row = vec![0.0; self.row.len()];
            self.finder.write(&MotionAt::of(side, detail), &mut row)?;
            let u = side.time - self.pulses.since;
            for acting in self.pulses.acting(u) {
                self.row.copy_from_slice(&row);
                acting.add_to(&mut self.row, u);
                self.worst.look(&self.search.gauges, (acting, u), &self.row);
            }
            sides.push(row);
        }
        if jumps.is_empty() {
            return Ok(());
        }
        self.latch_impulses.extend(jumps.iter().map(|jump| LatchImpulses {
            latch: jump.hinge,
            hinges: self.finder.impulses(&after.beta, jump),
        }));
        if self.pulse_constants.is_none() {
            return Ok(());
        }
        self.settle(after.time - self.pulses.since)?;
        self.pending = Some(after.time);
        self.start_pulses(instant, sides)
    }

    fn start_pulses(
        &mut self,
        InstantMotion { jumps, after, .. }: &InstantMotion,
        sides: Vec<Vec<f64>>,
    ) -> Result<(), StrengthError> {
        let Some(constants) = &self.pulse_constants else { return Ok(()) };
        self.pulses.start_at(after.time);
        let mut longest: f64 = 0.0;
        for jump in jumps {
            let (constant, factor) = (constants[jump.hinge], self.settings.amplification);
            let peak = self.finder.peak(&after.beta, jump, constant, factor);
            if !peak.iter().all(|number| number.is_finite()) {
                return Err(StrengthError::NotFinite { time: after.time });
            }
            longest = longest.max(self.pulses.add(jump.hinge, constant, peak));
        }
        sides.into_iter().for_each(|loads| self.pulses.add_side(longest, loads));
        Ok(())
    }

    /// Searches and reports the peaks of the last lock-up, whose pulses are over or another one's begin
    /// at `u`, unless they were reported before.
    fn settle(&mut self, u: f64) -> Result<(), StrengthError> {
        let Some(time) = self.pending.take() else { return Ok(()) };
        let Self { search, pulses, at_lock_up, stations, worst, .. } = self;
        search_pulses(search, u, pulses, at_lock_up)?;
        pulses.forget_until(u);
        worst.merge(at_lock_up);
        let none = (Wrench::zero(), [0.0; 6]);
        let of_record = |g| at_lock_up.get(g).map_or(none, |found| (found.load, found.numbers));
        let mut stresses = Vec::new();
        set_stresses(&mut stresses, stations, &search.gauges, of_record);
        let moments = (stations.len()..search.gauges.len())
            .filter(|&g| matches!(search.gauges[g].measure, Measure::Moment));
        let hinge_loads = moments.map(|g| of_record(g).0).collect();
        at_lock_up.forget();
        self.settled.push(LockUpPeaks { time, stresses, hinge_loads });
        Ok(())
    }

    /// Whether the peaks of a lock-up are still to come.
    pub fn awaits_peaks(&self) -> bool {
        self.pending.is_some()
    }

    /// The peaks of lock-ups that have become known since the last call.
    pub fn settled(&mut self) -> Vec<LockUpPeaks> {
        std::mem::take(&mut self.settled)
    }

    /// Continues the pulses that still last to their ends, after the last step of a run.
    ///
    /// # Errors
    /// None are to be expected.
    pub fn finish(&mut self) -> Result<(), StrengthError> {
        self.settle(self.pulses.end())
    }

    /// Load and stresses of every station at the last output time.
    pub fn stresses(&self) -> &[StationStress] {
        &self.stresses
    }

    /// Force and moment that each hinge exerts on its outboard body, about the hinge point, segment
    /// axes, at the last output time.
    pub fn hinge_loads(&self) -> &[Wrench<f64>] {
        &self.hinge_loads
    }

    /// The impulses of each latch of the last instant.
    pub fn latch_impulses(&self) -> &[LatchImpulses] {
        &self.latch_impulses
    }

    /// The worst of each station so far; nothing before the first motion.
    pub fn envelope(&self) -> Vec<Worst> {
        let stations = self.stations.iter().enumerate();
        stations.filter_map(|(g, place)| self.worst_of(g, place)).collect()
    }

    fn worst_of(&self, g: usize, place: &StationPlace) -> Option<Worst> {
        let Record { value, time, cause, load, numbers } = *self.worst.get(g)?;
        let Measure::Stress(formulas) = &self.search.gauges[g].measure else { return None };
        let max_von_mises = formulas.max_von_mises_of(numbers);
        let has_load = value > ROUNDING * self.worst.largest_of_kind(g);
        let (segment, station) = (self.labels[place.segment], place.station);
        let driver = has_load.then(|| driver(formulas, &load, &max_von_mises));
        let margin = self.settings.margin(value).filter(|_| has_load);
        Some(Worst { segment, station, time, cause, load, max_von_mises, driver, margin })
    }

    /// The largest force and the largest moment of each hinge so far; nothing before the first motion.
    pub fn hinge_envelope(&self) -> Vec<WorstHingeLoad> {
        let of_hinge = |(i, hinge): (usize, &HingeLabel)| {
            let first = self.stations.len() + 2 * i;
            let hinge = *hinge;
            HingeQuantity::ALL.into_iter().enumerate().filter_map(move |(j, quantity)| {
                let Record { time, cause, load, .. } = *self.worst.get(first + j)?;
                Some(WorstHingeLoad { hinge, quantity, time, cause, load })
            })
        };
        self.labels.iter().enumerate().flat_map(of_hinge).collect()
    }

    /// The largest difference so far between the load about a free hinge's axis and its torque,
    /// relative to the sum of the magnitudes of the load's terms.
    pub fn largest_residual(&self) -> f64 {
        self.finder.largest_residual
    }
}

fn pulse_constants(structure: &Structure) -> Vec<f64> {
    structure.segments().iter().map(|segment| segment.pulse_constant).collect()
}
