use std::borrow::Borrow;

use nboom_scalar::Kernel;
use serde::Serialize;

use crate::VerifyError;
use crate::equations::EquationsCode;
use crate::label::{Hinges, Label, Quantity};
use crate::reference::{Deviation, Referee};
use crate::test_case::{NotCovered, TestCase};

/// The largest deviations of one code in one quantity, over the states that it covers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The code.
    #[serde(flatten)]
    pub label: Label,
    /// What it computes.
    pub quantity: Quantity,
    /// Which hinges turn.
    pub hinges: Hinges,
    /// How many states it covers.
    pub states: usize,
    /// Its largest deviation from the recursion in `f64`; none where it is the recursion.
    pub from_recursion: Option<f64>,
    /// Its largest deviation from the recursion in double-double, rounded to `f64`.
    pub from_double_double: f64,
    /// The state where its largest deviation that counts is, from 1.
    pub state: usize,
    #[serde(skip)]
    worst: f64,
}

impl Row {
    fn new(label: Label, quantity: Quantity, hinges: Hinges) -> Self {
        let from_recursion = (label != Label::RECURSION).then_some(0.0);
        Self {
            label,
            quantity,
            hinges,
            states: 0,
            from_recursion,
            from_double_double: 0.0,
            state: 0,
            worst: 0.0,
        }
    }

    /// The largest deviation that counts in any state: the larger one of both, or that from double-double alone
    /// where the recursion in `f64` is farther from it.
    pub fn worst(&self) -> f64 {
        self.worst
    }

    fn note(&mut self, state: usize, virtual_links: usize, off: Deviation) {
        if self.states == 0 || off.worst() > self.worst() {
            self.state = state;
        }
        self.states += 1;
        self.worst = self.worst.max(off.worst());
        self.label.virtual_links = self.label.virtual_links.max(virtual_links);
        self.from_recursion = self.from_recursion.map(|most| most.max(off.from_recursion));
        self.from_double_double = self.from_double_double.max(off.from_double_double);
    }
}

/// Rows while they are found.
struct Rows {
    rows: Vec<Row>,
    largest_condition: f64,
    largest_magnification: f64,
}

impl Rows {
    fn note(
        &mut self,
        label: Label,
        quantity: Quantity,
        hinges: Hinges,
        state: usize,
        off: Deviation,
    ) {
        let same = |row: &Row| {
            (row.label.code(), row.quantity, row.hinges) == (label.code(), quantity, hinges)
        };
        let at = self.rows.iter().position(same).unwrap_or_else(|| {
            self.rows.push(Row::new(label, quantity, hinges));
            self.rows.len() - 1
        });
        self.rows[at].note(state, label.virtual_links, off);
    }

    /// Takes all code through the states of a test case, the first of which has the number `first`.
    fn compare(
        &mut self,
        interrupted: &dyn Fn() -> bool,
        test_case: &TestCase,
        first: usize,
        (kernels, of_equations): (&'static [Kernel], &[Kernel]),
    ) -> Result<(), VerifyError> {
        let all_free = test_case.held().iter().all(Option::is_none);
        let hinges = if all_free { Hinges::Free } else { Hinges::Held };
        let mut codes = test_case.codes(kernels)?;
        let equations = EquationsCode::all(test_case, of_equations)?;
        let mut referee = Referee::new(test_case, first);
        for (i, state) in test_case.coordinates().enumerate() {
            if interrupted() {
                return Err(VerifyError::Interrupted);
            }
            let (reference, number) = (referee.reference(i)?, first + i);
            self.largest_condition = self.largest_condition.max(reference.condition);
            self.largest_magnification = self.largest_magnification.max(reference.magnification);
            for (label, code) in &mut codes {
                let off = reference.off_accelerations(&code.accelerations(i));
                self.note(*label, Quantity::Accelerations, hinges, number, off);
            }
            let of_codes = equations.iter().map(|code| {
                (code.label, reference.off_equations(code.formulation, &code.equations(&state)))
            });
            let of_recursion = (Label::RECURSION, reference.off_recursion());
            for (label, [matrix, forcing]) in [of_recursion].into_iter().chain(of_codes) {
                self.note(label, Quantity::MassMatrix, hinges, number, matrix);
                self.note(label, Quantity::Forcing, hinges, number, forcing);
            }
        }
        Ok(())
    }
}

/// What comparing all code that covers a test case has found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Name of the scene.
    pub scene: String,
    /// Its topology with all hinges free; none where it is not made of chains, paddles and limbs.
    pub topology: Option<String>,
    /// How many states there were.
    pub states: usize,
    /// How many of them have held hinges; they come last.
    pub held: usize,
    /// What they were drawn from.
    pub seed: u64,
    /// The largest deviation allowed.
    pub tolerance: f64,
    /// The largest condition of the mass matrix, as [`Quantity`] scales it.
    pub largest_condition: f64,
    /// The most that rounding is magnified in accelerations, as [`Quantity`] has it.
    pub largest_magnification: f64,
    /// All hinges free: accelerations of all code, the recursion first; then its mass matrices;
    /// then its forcings. The same with held hinges.
    pub rows: Vec<Row>,
    /// What does not cover the scene with all hinges free.
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

    /// The comparison in JSON. A number that is not finite is `null`.
    pub fn json(&self) -> String {
        let file = ComparisonFile { comparison: self, passed: self.passed() };
        serde_json::to_string_pretty(&file).expect("the keys are texts and numbers") + "\n"
    }
}

/// Takes all code that covers a test case through its states: the recursion, the factored mass matrix, the
/// closed forms, and the routines that fit among `kernels`, which compute accelerations, and `of_equations`, which
/// compute a formulation's matrix row by row and then its right side, hinges appendage by
/// appendage. First the test case `free`, all of whose hinges are free, then those of `held`.
///
/// Matrices and right sides of a formulation are compared with those of the recursion, turned
/// into the formulation's unknowns.
///
/// # Errors
/// [`VerifyError::NoReference`] where the recursion has no accelerations in a state, and
/// [`VerifyError::Sizes`] or [`VerifyError::NoEquations`] where a routine is not what it says.
pub fn compare(
    free: &TestCase,
    held: &[TestCase],
    kernels: &'static [Kernel],
    of_equations: &[Kernel],
    tolerance: f64,
) -> Result<Comparison, VerifyError> {
    compare_unless(&|| false, free, held.iter().map(Ok), (kernels, of_equations), tolerance)
}

/// [Compares](compare) unless it is `interrupted`, which it asks at each state; `routines` are those for accelerations
/// and those of equations.
///
/// # Errors
/// As [`compare`], and [`VerifyError::Interrupted`].
pub fn compare_unless<T: Borrow<TestCase>>(
    interrupted: &dyn Fn() -> bool,
    free: &TestCase,
    held: impl Iterator<Item = Result<T, VerifyError>>,
    routines: (&'static [Kernel], &[Kernel]),
    tolerance: f64,
) -> Result<Comparison, VerifyError> {
    let mut found = Rows { rows: Vec::new(), largest_condition: 1.0, largest_magnification: 1.0 };
    found.compare(interrupted, free, 1, routines)?;
    let mut states = free.states().len();
    for test_case in held {
        let test_case = test_case?;
        found.compare(interrupted, test_case.borrow(), states + 1, routines)?;
        states += test_case.borrow().states().len();
    }
    found.rows.sort_by_key(|row| (row.hinges, row.quantity));
    Ok(Comparison {
        scene: free.scene().name.clone(),
        topology: free.recognised().map(|recognised| recognised.topology.to_string()),
        states,
        held: states - free.states().len(),
        seed: free.seed(),
        tolerance,
        largest_condition: found.largest_condition,
        largest_magnification: found.largest_magnification,
        rows: found.rows,
        not_covered: free.not_covered(routines.0),
    })
}
