use std::fmt::Write;

use nboom_io::read_scene;

use crate::codes::{Label, State, Subject, head};
use crate::condition::condition;
use crate::format::{count, short};
use crate::{CliError, VerifyArgs, check, print, say};

/// Up to this condition of the mass matrix deviations count as they are; beyond it they are
/// divided by what it magnifies rounding by.
const HARMLESS_CONDITION: f64 = 1e4;

/// Beyond this condition f64 holds no accelerations to compare.
const LARGEST_CONDITION: f64 = 1e14;

/// The largest deviation of one code from the recursion.
struct Deviation {
    label: Label,
    largest: f64,
    /// The state where it is, from 1.
    state: usize,
}

/// What the recursion says about one state.
struct Reference {
    accelerations: Vec<f64>,
    largest: f64,
    condition: f64,
}

/// Compares all code that computes accelerations and prints the largest deviations.
pub(crate) fn verify(args: &VerifyArgs) -> Result<String, CliError> {
    let file = read_scene(&args.scene)?;
    check::warnings(&file).iter().for_each(|warning| say("warning", warning));
    let subject = Subject::new(file.scene, args.states, args.seed);
    let references = references(&subject)?;
    let deviations = deviations(&subject, &references);
    print(&table(args, &subject, &references, &deviations))?;
    match deviations.iter().max_by(|a, b| a.largest.total_cmp(&b.largest)) {
        Some(worst) if worst.largest > args.tol => Err(CliError::Deviation {
            code: worst.label.words(),
            deviation: worst.largest,
            state: worst.state,
            tol: args.tol,
        }),
        _ => Ok(String::new()),
    }
}

fn references(subject: &Subject) -> Result<Vec<Reference>, CliError> {
    let mut dynamics = subject.dynamics.clone();
    let (_, mut recursion) = subject.recursion();
    let size = subject.scene.degrees_of_freedom();
    let mut matrix = vec![0.0; size * size];
    let mut references = Vec::new();
    for (i, State { beta, .. }) in subject.states.iter().enumerate() {
        let singular = dynamics.singular_hinge(beta);
        dynamics.mass_matrix(beta, &mut matrix);
        let reference = Reference::new(recursion.accelerations(i), condition(&matrix));
        if singular.is_some() || !reference.is_good() {
            let hinge = singular.flatten().map(|hinge| subject.scene.label(hinge));
            return Err(CliError::NoReference { state: i + 1, hinge });
        }
        references.push(reference);
    }
    Ok(references)
}

fn deviations(subject: &Subject, references: &[Reference]) -> Vec<Deviation> {
    let mut deviations = Vec::new();
    for (label, mut code) in subject.others() {
        let mut worst = Deviation { label, largest: 0.0, state: 1 };
        for (i, reference) in references.iter().enumerate() {
            let deviation = reference.deviation(&code.accelerations(i));
            if deviation > worst.largest {
                (worst.largest, worst.state) = (deviation, i + 1);
            }
        }
        deviations.push(worst);
    }
    deviations
}

impl Reference {
    fn new(accelerations: Vec<f64>, condition: f64) -> Self {
        let largest = accelerations.iter().fold(0.0, |largest: f64, a| largest.max(a.abs()));
        Self { accelerations, largest, condition }
    }

    /// Whether there is something to compare with.
    fn is_good(&self) -> bool {
        self.condition < LARGEST_CONDITION && self.accelerations.iter().all(|a| a.is_finite())
    }

    /// Relative to the largest acceleration and to what the condition allows; infinite where
    /// the accelerations found are no numbers.
    fn deviation(&self, found: &[f64]) -> f64 {
        let pairs = found.iter().zip(&self.accelerations);
        let off = pairs.map(|(found, expected)| (found - expected).abs());
        let off = off.fold(
            0.0,
            |worst: f64, off| {
                if off.is_nan() { f64::INFINITY } else { worst.max(off) }
            },
        );
        let scale = self.largest.max(f64::MIN_POSITIVE);
        off / scale / (self.condition / HARMLESS_CONDITION).max(1.0)
    }
}

fn table(
    args: &VerifyArgs,
    subject: &Subject,
    references: &[Reference],
    deviations: &[Deviation],
) -> String {
    let states = count(args.states, "random state", "random states");
    let mut text = format!(
        "{}: accelerations in {states} from seed {}, all hinges free\n{} {:>17} {:>6}\n",
        subject.scene.name,
        args.seed,
        head(),
        "largest deviation",
        "state",
    );
    let mut line = |line: String| writeln!(text, "{line}").expect("a string takes any text");
    let (reference, _) = subject.recursion();
    line(format!("{} {:>17} {:>6}", reference.columns(), "reference", "-"));
    for Deviation { label, largest, state } in deviations {
        line(format!("{} {largest:>17.1e} {state:>6}", label.columns()));
    }
    subject.not_covered().into_iter().for_each(&mut line);
    let condition = references.iter().map(|reference| reference.condition).fold(1.0, f64::max);
    line(format!(
        "tolerance {:e}; largest condition of the mass matrix {}",
        args.tol,
        short(condition, 3)
    ));
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn deviations_are_relative_and_scaled_by_the_condition() {
        let reference = |condition| Reference::new(vec![1.0, -4.0], condition);
        assert_eq!(reference(10.0).deviation(&[1.0, -4.0]), 0.0);
        assert_eq!(reference(10.0).deviation(&[1.0, -3.0]), 0.25);
        assert_eq!(reference(1e5).deviation(&[1.0, -3.0]), 0.025);
        assert!(reference(1e5).deviation(&[f64::NAN, -4.0]).is_infinite());
    }
}
