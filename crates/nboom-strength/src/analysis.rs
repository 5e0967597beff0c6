use nboom_loads::LoadEquations;
use nboom_model::{HingeLabel, Material, Scene, Structure};
use nboom_scalar::{Kernel, Wrench};
use nboom_sections::{AtStation, Section};
use nboom_sim::{Detail, EventKind, InstantMotion, MotionAt, Side, Snapshot, StepMotion};

use crate::envelope::driver;
use crate::finder::LoadFinder;
use crate::gauge::Gauge;
use crate::piece::{search_pulses, search_step};
use crate::pulse::Pulses;
use crate::record::{Record, Records};
use crate::search::Search;
use crate::station::Station;
use crate::{
    HingeQuantity, LatchImpulses, Margins, PulsePeaks, Settings, Slip, StationLoad, Stations,
    StrengthError, Worst, WorstHingeLoad,
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
    has_pulses: bool,
    /// Those of the segments, if there are stations.
    materials: Vec<Material>,
    finder: LoadFinder,
    stations: Stations,
    search: Search,
    pulses: Pulses,
    /// Whether the run has no length, so that its output time is all that loads are found at.
    pub(crate) is_moment: bool,
    /// End of the last step or instant.
    reached: f64,
    /// The worst of the run.
    worst: Records,
    /// Loads of pulses just before and just after lock-ups and impacts, since the last one.
    at_lock_up: Records,
    /// Time and kind of the last lock-up or impact, while its pulses last.
    pending: Option<(f64, EventKind)>,
    settled: Vec<PulsePeaks>,
    /// The row of the motion at one time.
    row: Vec<f64>,
    station_loads: Vec<StationLoad>,
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
        let all = Self::of(scene, equations, sections, Some(pulse_constants(structure)), settings)?;
        let materials = structure.segments().iter().map(|segment| segment.material).collect();
        Ok(Self { materials, ..all })
    }

    /// The analysis of the hinges of any scene, without stresses. Pulse constants belong to a
    /// structure; without one, latches and stops appear only as impulses.
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
        let labels = scene.labels().to_vec();
        let influences: Vec<_> = sections.iter().map(|at| at.here.influence()).collect();
        let equations = equations.with_sections(influences);
        let hands_on = settings.slips.contains(Slip::LoadTransfer);
        let finder = LoadFinder::new(scene, labels.clone(), equations, hands_on);
        let loads = finder.load_set();
        let stations = Stations::new(sections, settings.slips);
        let of_station = |(i, at): (usize, &Station)| Gauge::of_station(i, &loads, at);
        let mut gauges: Vec<Gauge> = stations.iter().enumerate().map(of_station).collect();
        gauges.extend(scene.bodies.iter().enumerate().flat_map(|(hinge, body)| {
            Gauge::of_hinge(hinge, &loads, (!body.joint.slides()).then_some(body.axis))
        }));
        let records = Records::new(&gauges);
        let is_struck = scene.bodies.iter().any(|body| body.hinge.may_be_struck());
        Ok(Self {
            settings,
            labels,
            has_pulses: pulse_constants.is_some() || !is_struck,
            pulse_constants,
            materials: Vec::new(),
            stations,
            pulses: Pulses::new(settings.pulses),
            is_moment: scene.initial.time == scene.end_time,
            reached: f64::NEG_INFINITY,
            worst: records.clone(),
            at_lock_up: records,
            pending: None,
            settled: Vec::new(),
            row: vec![0.0; finder.width()],
            search: Search::new(gauges, finder.width()),
            finder,
            station_loads: Vec::new(),
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
        self.stations.iter().len() > 0
    }

    /// Whether loads have the pulses of all hinges that latch or have stops; without pulse constants they have none.
    pub fn has_pulses(&self) -> bool {
        self.has_pulses
    }

    /// How long the pulse of each hinge's latch or stop lasts; nothing where loads have none.
    pub fn pulse_durations(&self) -> Vec<f64> {
        let constants = self.pulse_constants.iter().flatten();
        constants.map(|constant| self.settings.pulses.duration(*constant)).collect()
    }

    /// The segments that margins leave out since their materials have no strength, in words; `None` if
    /// all stations have a margin, or none has.
    pub fn without_margins(&self) -> Option<String> {
        let mut segments: Vec<usize> = self.stations.iter().map(|at| at.segment).collect();
        segments.dedup();
        let has_margin =
            |i: &usize| self.settings.margins(&self.materials[*i], 1.0).smallest().is_some();
        let (with, without): (Vec<usize>, Vec<usize>) = segments.into_iter().partition(has_margin);
        let names: Vec<String> = without.iter().map(|i| self.labels[*i].to_string()).collect();
        let (first, others) = names.split_first().filter(|_| !with.is_empty())?;
        let others: String = others.iter().map(|name| format!(" and {name}")).collect();
        Some(format!(
            "margins leave out stations whose material has no strength: those of segment {first}{others}"
        ))
    }

    /// The stations, which find stresses.
    pub fn stations(&self) -> &Stations {
        &self.stations
    }

    /// Instruction set of the generated code that finds the loads, if any does.
    pub fn generated_for(&self) -> Option<&'static str> {
        self.finder.loads.generated_for()
    }

    /// Finds the loads of the motion at an output time. Output times are within a step or instant,
    /// which the envelope covers; only a run of no length adds its one output time to the envelope
    /// here.
    ///
    /// # Errors
    /// When the loads contradict the motion, or are no numbers.
    pub fn motion(&mut self, snapshot: &Snapshot, detail: &Detail) -> Result<(), StrengthError> {
        self.finder.write(&MotionAt::of(snapshot, detail), &mut self.row)?;
        if self.reached == f64::NEG_INFINITY {
            for acting in self.pulses.acting(snapshot.time) {
                self.worst.look(&self.search.gauges, (acting, snapshot.time), &self.row)?;
            }
        }
        let Self { search, stations, row, station_loads, hinge_loads, .. } = self;
        let (of_stations, of_hinges) = search.gauges.split_at(stations.iter().len());
        station_loads.clear();
        station_loads.extend(of_stations.iter().map(|gauge| gauge.station_load(row)));
        hinge_loads.clear();
        hinge_loads.extend(of_hinges.iter().step_by(2).map(|force| force.load(row)));
        Ok(())
    }

    /// The largest loads of a step, for the envelope.
    ///
    /// # Errors
    /// When the loads contradict the motion, or are no numbers.
    pub fn step(&mut self, step: &mut dyn StepMotion) -> Result<(), StrengthError> {
        let Self { search, finder, pulses, worst, .. } = self;
        finder.begin(step.goes_on());
        search_step(search, step, finder, pulses, worst)?;
        let [_, end] = step.span();
        self.reached = end;
        let u = end - self.pulses.since;
        if self.pulses.end() <= u { self.settle(u) } else { Ok(()) }
    }

    /// Both sides of an instant with events, for the envelope. The pulses of hinges that lock or hit stops start
    /// here if their constants are known, eqs. (10.7) to (10.14).
    ///
    /// # Errors
    /// When the loads contradict the motion, or are no numbers.
    pub fn instant(&mut self, instant: &InstantMotion) -> Result<(), StrengthError> {
        let InstantMotion { jumps, after, .. } = *instant;
        self.reached = after.snapshot.time;
        self.latch_impulses.clear();
        let mut sides = Vec::new();
        for Side { snapshot, detail } in instant.sides() {
            let mut row = vec![0.0; self.row.len()];
            self.finder.write(&MotionAt::of(snapshot, detail), &mut row)?;
            let u = snapshot.time - self.pulses.since;
            for acting in self.pulses.acting(u) {
                self.row.copy_from_slice(&row);
                acting.add_to(&mut self.row, u);
                self.worst.look(&self.search.gauges, (acting, u), &self.row)?;
            }
            sides.push(row);
        }
        if jumps.is_empty() {
            return Ok(());
        }
        self.latch_impulses.extend(jumps.iter().map(|jump| LatchImpulses {
            hinge: jump.hinge,
            hinges: self.finder.impulses(&after.snapshot.beta, jump),
        }));
        if self.pulse_constants.is_none() {
            return Ok(());
        }
        let time = after.snapshot.time;
        self.settle(time - self.pulses.since)?;
        let kind = jumps.iter().map(|jump| jump.kind).min();
        self.pending = kind.map(|kind| (time, kind));
        self.start_pulses(instant, sides)
    }

    fn start_pulses(
        &mut self,
        InstantMotion { jumps, after, .. }: &InstantMotion,
        sides: Vec<Vec<f64>>,
    ) -> Result<(), StrengthError> {
        let Some(constants) = &self.pulse_constants else { return Ok(()) };
        let Snapshot { time, beta, .. } = after.snapshot;
        self.pulses.start_at(*time);
        let mut longest: f64 = 0.0;
        for jump in *jumps {
            let (constant, factor) = (constants[jump.hinge], self.settings.amplification);
            let peak = self.finder.peak(beta, jump, constant, factor);
            if !peak.iter().all(|number| number.is_finite()) {
                return Err(StrengthError::NotFinite { time: *time });
            }
            longest = longest.max(self.pulses.add((jump.hinge, jump.kind), constant, peak));
        }
        sides.into_iter().for_each(|loads| self.pulses.add_side(longest, loads));
        Ok(())
    }

    /// Searches and reports the peaks of the last lock-up or impact, whose pulses are over or another one's begin
    /// at `u`, unless they were reported before.
    fn settle(&mut self, u: f64) -> Result<(), StrengthError> {
        let Some((time, kind)) = self.pending.take() else { return Ok(()) };
        let Self { search, pulses, at_lock_up, stations, worst, .. } = self;
        search_pulses(search, u, pulses, at_lock_up)?;
        pulses.forget_until(u);
        worst.merge(at_lock_up);
        let of_record = |g| at_lock_up.get(g).map_or(StationLoad::none(), Record::station_load);
        let (first, end) = (stations.iter().len(), search.gauges.len());
        let of_stations = (0..first).map(of_record).collect();
        let moments = (first..end).skip(1).step_by(2);
        let hinge_loads = moments.map(|g| of_record(g).load).collect();
        at_lock_up.forget();
        self.settled.push(PulsePeaks { time, kind, stations: of_stations, hinge_loads });
        Ok(())
    }

    /// Whether the peaks of a lock-up or an impact are still to come.
    pub fn awaits_peaks(&self) -> bool {
        self.pending.is_some()
    }

    /// The peaks of lock-ups and impacts that have become known since the last call.
    pub fn settled(&mut self) -> Vec<PulsePeaks> {
        std::mem::take(&mut self.settled)
    }

    /// Continues the pulses that still last to their ends, after the last step of a run.
    ///
    /// # Errors
    /// When a load or stress is infinite.
    pub fn finish(&mut self) -> Result<(), StrengthError> {
        self.settle(self.pulses.end())
    }

    /// Load of every station at the last output time.
    pub fn station_loads(&self) -> &[StationLoad] {
        &self.station_loads
    }

    /// Force and moment that each hinge exerts on its outboard body, about the hinge point, segment
    /// axes, at the last output time.
    pub fn hinge_loads(&self) -> &[Wrench<f64>] {
        &self.hinge_loads
    }

    /// The impulses of each latch and stop of the last instant.
    pub fn latch_impulses(&self) -> &[LatchImpulses] {
        &self.latch_impulses
    }

    /// The worst of each station so far; nothing before the first motion.
    pub fn envelope(&self) -> Vec<Worst> {
        let stations = self.stations.iter().enumerate();
        stations.filter_map(|(g, at)| self.worst_of(g, at)).collect()
    }

    fn worst_of(&self, g: usize, at: &Station) -> Option<Worst> {
        let Record { value, time, cause, load, numbers } = *self.worst.get(g)?;
        let max_von_mises = at.formulas.max_von_mises_of(numbers);
        let has_load = value > ROUNDING * self.worst.largest_of_kind(g);
        let (segment, station) = (self.labels[at.segment].clone(), at.station);
        let driver = has_load.then(|| driver(&at.formulas, &load, &max_von_mises));
        let of_load = || self.settings.margins(&self.materials[at.segment], value);
        let margins = if has_load { of_load() } else { Margins::default() };
        Some(Worst { segment, station, time, cause, load, max_von_mises, driver, margins })
    }

    /// The largest force and the largest moment of each hinge so far; nothing before the first motion.
    pub fn hinge_envelope(&self) -> Vec<WorstHingeLoad> {
        let of_hinge = |i: usize| {
            let first = self.stations.iter().len() + 2 * i;
            HingeQuantity::ALL.into_iter().enumerate().filter_map(move |(j, quantity)| {
                let Record { time, cause, load, .. } = *self.worst.get(first + j)?;
                let hinge = self.labels[i].clone();
                Some(WorstHingeLoad { hinge, quantity, time, cause, load })
            })
        };
        (0..self.labels.len()).flat_map(of_hinge).collect()
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
