use std::fs;
use std::path::Path;

use nboom_scalar::Kernel;
use serde::Serialize;

use crate::VerifyError;
use crate::equations::EquationsCode;
use crate::label::{Label, Quantity};
use crate::reference::{Off, Referee};
use crate::subject::{NotCovered, Subject};

/// The largest deviations of one code in one quantity.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The code.
    #[serde(flatten)]
    pub label: Label,
    /// What it computes.
    pub quantity: Quantity,
    /// Its largest deviation from the recursion in `f64`; none where it is the recursion.
    pub from_recursion: Option<f64>,
    /// Its largest deviation from the recursion in double-double, rounded to `f64`.
    pub from_double_double: f64,
    /// The state where the larger of both is, from 1.
    pub state: usize,
}

impl Row {
    fn new(label: Label, quantity: Quantity) -> Self {
        let from_recursion = (label != Label::RECURSION).then_some(0.0);
        Self { label, quantity, from_recursion, from_double_double: 0.0, state: 1 }
    }

    /// The larger one of both deviations.
    pub fn worst(&self) -> f64 {
        self.from_recursion.unwrap_or(0.0).max(self.from_double_double)
    }

    fn note(&mut self, i: usize, off: Off) {
        if off.worst() > self.worst() {
            self.state = i + 1;
        }
        self.from_recursion = self.from_recursion.map(|most| most.max(off.from_recursion));
        self.from_double_double = self.from_double_double.max(off.from_double_double);
    }
}

/// What comparing all code that covers a subject has found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Name of the scene.
    pub scene: String,
    /// Its topology with all hinges free; none where it is not made of chains and paddles.
    pub topology: Option<String>,
    /// How many states there were.
    pub states: usize,
    /// What they were drawn from.
    pub seed: u64,
    /// The largest deviation allowed.
    pub tolerance: f64,
    /// The largest condition of the mass matrix, scaled to diagonal 1.
    pub largest_condition: f64,
    /// Accelerations of all code, the recursion first; then its mass matrices; then its forcings.
    pub rows: Vec<Row>,
    /// What does not cover the scene.
    pub not_covered: Vec<NotCovered>,
}

/// The keys of the file: those of the comparison, and whether it passed.
#[derive(Serialize)]
struct ComparisonFile<'a> {
    #[serde(flatten)]
    comparison: &'a Comparison,
    passed: bool,
}

impl Comparison {
    /// The row with the largest deviation.
    pub fn worst(&self) -> &Row {
        let rows = self.rows.iter();
        rows.max_by(|a, b| a.worst().total_cmp(&b.worst())).expect("the recursion has a row")
    }

    /// Whether no deviation is above the tolerance.
    pub fn passed(&self) -> bool {
        self.worst().worst() <= self.tolerance
    }

    /// Writes the comparison in JSON, into a folder that is made if need be. A number that is not
    /// finite is written as `null`.
    ///
    /// # Errors
    /// [`VerifyError::Write`].
    pub fn write(&self, path: &Path) -> Result<(), VerifyError> {
        let file = ComparisonFile { comparison: self, passed: self.passed() };
        let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
        let text = folder.and_then(|()| Ok(serde_json::to_string_pretty(&file)?));
        let written = text.and_then(|text| fs::write(path, text + "\n"));
        written.map_err(|source| VerifyError::Write { path: path.to_owned(), source })
    }
}

/// Takes all code that covers the subject through its states: the recursion, the closed forms, and
/// the routines that fit among `kernels`, which compute accelerations, and `of_equations`, which
/// compute a formulation's matrix row by row and then its right side, hinges appendage by
/// appendage.
///
/// Matrices and right sides of a formulation are compared with those of the recursion, turned
/// into the formulation's unknowns.
///
/// # Errors
/// [`VerifyError::NoReference`] where the recursion has no accelerations in a state, and
/// [`VerifyError::Sizes`] or [`VerifyError::NoEquations`] where a routine is not what it says.
pub fn compare(
    subject: &Subject,
    kernels: &[Kernel],
    of_equations: &[Kernel],
    tolerance: f64,
) -> Result<Comparison, VerifyError> {
    let mut codes = subject.codes(kernels)?;
    let equations = EquationsCode::all(subject, of_equations)?;
    let rows = |quantity| move |label| Row::new(label, quantity);
    let labels = || [Label::RECURSION].into_iter().chain(equations.iter().map(|code| code.label));
    let mut accelerations: Vec<Row> =
        codes.iter().map(|(label, _)| *label).map(rows(Quantity::Accelerations)).collect();
    let mut matrices: Vec<Row> = labels().map(rows(Quantity::MassMatrix)).collect();
    let mut forcings: Vec<Row> = labels().map(rows(Quantity::Forcing)).collect();
    let mut largest_condition = 1.0_f64;
    let mut referee = Referee::new(subject);
    for (i, state) in subject.coordinates().enumerate() {
        let reference = referee.reference(i)?;
        largest_condition = largest_condition.max(reference.condition);
        for ((_, code), row) in codes.iter_mut().zip(&mut accelerations) {
            row.note(i, reference.off_accelerations(&code.accelerations(i)));
        }
        let of_codes = equations
            .iter()
            .map(|code| reference.off_equations(code.formulation, &code.equations(&state)));
        let all = [reference.off_recursion()].into_iter().chain(of_codes);
        for ((off, matrix), forcing) in all.zip(&mut matrices).zip(&mut forcings) {
            matrix.note(i, off[0]);
            forcing.note(i, off[1]);
        }
    }
    Ok(Comparison {
        scene: subject.scene().name.clone(),
        topology: subject.recognised().map(|recognised| recognised.topology.to_string()),
        states: subject.states().len(),
        seed: subject.seed(),
        tolerance,
        largest_condition,
        rows: [accelerations, matrices, forcings].concat(),
        not_covered: subject.not_covered(kernels),
    })
}
