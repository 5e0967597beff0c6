use std::collections::BTreeMap;

use nboom_model::{HingeLabel, Scene, UnitSystem, WantedTable};
use nboom_sim::{CodeOfRun, Conservation, Integration, OutputTimes, Selection, Summary};
use nboom_strength::{PulseShape, StressAnalysis};
use serde::Serialize;

use crate::verdict::{VerdictKeys, WorstLoads};
use crate::{Headings, StressSigns};

/// What is known about a run before it starts.
#[derive(Clone, Debug, PartialEq)]
pub struct RunDescription {
    /// Name of the scene.
    pub scene: String,
    /// Six, plus one for each hinge.
    pub degrees_of_freedom: usize,
    /// Name of the integrator.
    pub integrator: &'static str,
    /// Relative error allowed in a step.
    pub rtol: f64,
    /// Absolute error allowed in a step.
    pub atol: f64,
    /// The initial time and the end of the run.
    pub span: [f64; 2],
    /// Output times are the initial time and this many after it, unless `output` has others.
    pub samples: usize,
    /// What is asked for beside the usual output.
    pub output: WantedOutput,
    /// Labels of the scene's units.
    pub units: UnitSystem,
    /// How stresses are found and written.
    pub stresses: Option<StressDescription>,
    /// Whether loads have the pulses of all hinges that latch or have stops; `None` if no loads are computed.
    pub latch_pulses: Option<bool>,
    /// By what loads and margins are judged that is neither the scene's nor usual, in words.
    pub judged_by: Option<String>,
    /// After the twentieth output time, the printout has one in this many: `IAX` of a deck.
    pub print_interval: usize,
    /// What is not computed since the scene lacks it.
    pub skipped: Vec<String>,
    /// What is allowed in the scene but probably a mistake.
    pub warnings: Vec<String>,
    /// What its results repeat of 1970, wrong on purpose, in words.
    pub slips: Option<String>,
    /// SHA-256 of the scene's file, in hexadecimal digits; `None` for a scene that was made in
    /// memory.
    pub input_sha256: Option<String>,
    /// The scene as a text that stands alone, if there is one.
    pub scene_text: Option<String>,
    /// The record by which the run is repeated, if there is one.
    pub record: Option<String>,
    /// Parameters of the scene with the values of this run, by name.
    pub parameters: Vec<(String, f64)>,
    /// Labels of the scene's hinges.
    pub hinges: Vec<HingeLabel>,
}

impl RunDescription {
    /// The description of a run of `scene` under `options`.
    pub fn new(scene: &Scene, options: &nboom_sim::Options, units: UnitSystem) -> Self {
        Self {
            scene: scene.name.clone(),
            degrees_of_freedom: scene.degrees_of_freedom(),
            integrator: options.integrator.name(),
            rtol: options.rtol,
            atol: options.atol,
            span: [scene.initial.time, scene.end_time],
            samples: options.samples,
            output: WantedOutput::default(),
            units,
            stresses: None,
            latch_pulses: None,
            judged_by: None,
            print_interval: 1,
            skipped: nboom_model::skipped(scene),
            warnings: Vec::new(),
            slips: None,
            input_sha256: None,
            scene_text: None,
            record: None,
            parameters: Vec::new(),
            hinges: scene.labels().to_vec(),
        }
    }

    /// All that is warned of before the run begins.
    pub fn told_before(&self) -> impl Iterator<Item = &String> {
        self.warnings.iter().chain(&self.slips)
    }
}

/// What a scene or a person asks a run to write beside the usual output.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WantedOutput {
    /// Output times in place of uniform ones.
    pub times: Option<OutputTimes>,
    /// A table of its own.
    pub table: Option<WantedTable>,
    /// The printout.
    pub listing: bool,
    /// How tables call their columns.
    pub headings: Headings,
}

/// The keys of `summary.json`.
///
/// A number that is not finite is written as `null`.
#[derive(Clone, Debug, Serialize)]
pub struct SummaryFile<'a> {
    scene: &'a str,
    version: &'static str,
    input_sha256: Option<&'a str>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    parameters: BTreeMap<&'a str, f64>,
    degrees_of_freedom: usize,
    path: &'a str,
    formulation: &'a str,
    generated_share: f64,
    selections: Vec<SelectionKeys<'a>>,
    integrator: &'a str,
    integrations: Vec<IntegrationKeys>,
    rtol: f64,
    atol: f64,
    samples: usize,
    units: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    stresses: Option<StressKeys>,
    #[serde(skip_serializing_if = "Option::is_none")]
    latch_pulses: Option<bool>,
    #[serde(skip_serializing_if = "Option::is_none")]
    judged_by: Option<&'a str>,
    complete: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<&'a str>,
    end_time: Option<f64>,
    steps_accepted: usize,
    steps_rejected: usize,
    evaluations: usize,
    jacobians: usize,
    factorizations: usize,
    events: usize,
    verdict: Option<VerdictKeys>,
    wall_seconds: f64,
    conservation: ConservationKeys,
    attitude_drift: f64,
    skipped: &'a [String],
    /// All of them, those about the results too.
    warnings: Vec<String>,
    /// Those about the results.
    troubles: Vec<String>,
    /// Names of the run's files; without them, all names that a run may write are its own.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    files: Vec<&'static str>,
}

#[derive(Clone, Debug, Serialize)]
struct SelectionKeys<'a> {
    since: f64,
    path: &'a str,
    formulation: &'a str,
    reason: &'a str,
    evaluations: usize,
}

impl<'a> From<&'a Selection> for SelectionKeys<'a> {
    fn from(selection: &'a Selection) -> Self {
        let Selection { since, path, formulation, reason, evaluations } = selection;
        Self { since: *since, path, formulation, reason, evaluations: *evaluations }
    }
}

#[derive(Clone, Debug, Serialize)]
struct IntegrationKeys {
    since: f64,
    integrator: &'static str,
    reason: &'static str,
}

impl From<&Integration> for IntegrationKeys {
    fn from(&Integration { since, choice }: &Integration) -> Self {
        Self { since, integrator: choice.method.name(), reason: choice.reason }
    }
}

/// How the stresses of a run are found and written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressDescription {
    /// Which sign they have.
    pub signs: StressSigns,
    /// How pulses run.
    pub pulses: PulseShape,
    /// Instruction set of the generated code that finds loads, if any does.
    pub generated_for: Option<&'static str>,
}

impl StressDescription {
    /// That of an analysis; none if it has no stations, and so no stresses.
    pub fn of(analysis: &StressAnalysis, signs: StressSigns) -> Option<Self> {
        let (pulses, generated_for) = (analysis.settings().pulses, analysis.generated_for());
        analysis.has_stations().then_some(Self { signs, pulses, generated_for })
    }
}

/// What the stresses leave out.
const LEFT_OUT: &str = "stresses are those of thin walls: concentrations at corners, holes, welds and \
     fittings are not in them, nor is buckling";

#[derive(Clone, Debug, Serialize)]
struct StressKeys {
    signs: &'static str,
    pulses: &'static str,
    left_out: &'static str,
    path: &'static str,
    reason: String,
}

impl From<StressDescription> for StressKeys {
    fn from(description: StressDescription) -> Self {
        let StressDescription { signs, pulses, generated_for } = description;
        let (path, reason) = match generated_for {
            Some(instructions) => {
                (Selection::GENERATED, format!("{instructions} code for this scene"))
            }
            None => (Selection::GENERIC, "no code was generated for this scene".to_owned()),
        };
        let (signs, pulses) = (signs.name(), pulses.name());
        Self { signs, pulses, left_out: LEFT_OUT, path, reason }
    }
}

#[derive(Clone, Debug, Serialize)]
struct ConservationKeys {
    linear_momentum: Option<f64>,
    angular_momentum: Option<f64>,
    energy: f64,
}

impl From<Conservation> for ConservationKeys {
    fn from(residuals: Conservation) -> Self {
        let Conservation { linear_momentum, angular_momentum, energy } = residuals;
        Self { linear_momentum, angular_momentum, energy }
    }
}

impl<'a> SummaryFile<'a> {
    /// The state from before the first step until the run ends: not complete.
    pub fn unfinished(run: &'a RunDescription) -> Self {
        Self {
            scene: &run.scene,
            version: env!("CARGO_PKG_VERSION"),
            input_sha256: run.input_sha256.as_deref(),
            parameters: run
                .parameters
                .iter()
                .map(|(name, value)| (name.as_str(), *value))
                .collect(),
            degrees_of_freedom: run.degrees_of_freedom,
            path: Selection::GENERIC,
            formulation: "recursive",
            generated_share: 0.0,
            selections: Vec::new(),
            integrator: run.integrator,
            integrations: Vec::new(),
            rtol: run.rtol,
            atol: run.atol,
            samples: OutputTimes::intervals(run.output.times.as_ref(), run.samples, run.span),
            units: run.units.name(),
            stresses: run.stresses.map(StressKeys::from),
            latch_pulses: run.latch_pulses,
            judged_by: run.judged_by.as_deref(),
            complete: false,
            error: Some("the run is going on or was interrupted"),
            end_time: None,
            steps_accepted: 0,
            steps_rejected: 0,
            evaluations: 0,
            jacobians: 0,
            factorizations: 0,
            events: 0,
            verdict: None,
            wall_seconds: 0.0,
            conservation: Conservation::default().into(),
            attitude_drift: 0.0,
            skipped: &run.skipped,
            warnings: run.told_before().cloned().collect(),
            troubles: run.slips.iter().cloned().collect(),
            files: Vec::new(),
        }
    }

    /// The summary of a run of which only the error is known.
    pub fn failed(run: &'a RunDescription, error: &'a str, files: Vec<&'static str>) -> Self {
        Self { error: Some(error), files, ..Self::unfinished(run) }
    }

    /// The summary of a run that has ended; it is complete when there is no `error`.
    ///
    /// `worst` has the worst stresses and hinge loads, if any were computed.
    pub fn ended(
        run: &'a RunDescription,
        summary: &'a Summary,
        worst: &WorstLoads,
        wall_seconds: f64,
        error: Option<&'a str>,
        files: Vec<&'static str>,
    ) -> Self {
        let CodeOfRun { path, formulation, generated_share } = summary.code();
        Self {
            path,
            formulation,
            generated_share,
            selections: summary.selections.iter().map(SelectionKeys::from).collect(),
            integrator: summary.integrator,
            integrations: summary.integrations.iter().map(IntegrationKeys::from).collect(),
            complete: error.is_none(),
            error,
            end_time: Some(summary.end_time),
            steps_accepted: summary.steps_accepted,
            steps_rejected: summary.steps_rejected,
            evaluations: summary.evaluations,
            jacobians: summary.jacobians,
            factorizations: summary.factorizations,
            events: summary.events,
            verdict: Some(VerdictKeys::new(&run.hinges, &summary.verdict, worst)),
            wall_seconds,
            conservation: summary.conservation.into(),
            attitude_drift: summary.attitude_drift,
            files,
            ..Self::unfinished(run)
        }
    }

    /// With more of what is wrong with the results.
    #[must_use]
    pub fn with_troubles(mut self, troubles: &[String]) -> Self {
        self.warnings.extend_from_slice(troubles);
        self.troubles.extend_from_slice(troubles);
        self
    }

    /// The text of the file.
    pub fn text(&self) -> Vec<u8> {
        let mut text = serde_json::to_vec_pretty(self).expect("the keys are texts and numbers");
        text.push(b'\n');
        text
    }
}
