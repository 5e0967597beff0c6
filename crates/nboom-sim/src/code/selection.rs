use std::sync::Arc;

use nboom_formulation::Formulation;

use crate::options::Path;

/// Which code computed accelerations from a time on.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// Time from which on.
    pub since: f64,
    /// [`GENERATED`](Self::GENERATED), [`GENERIC`](Self::GENERIC) or [`SERIES`](Self::SERIES).
    pub path: &'static str,
    /// Name of the formulation.
    pub formulation: &'static str,
    /// Which routine, or why none.
    pub reason: Arc<str>,
    /// Evaluations of the accelerations that integration has asked of it.
    pub evaluations: usize,
}

impl Selection {
    /// The path of generated code.
    pub const GENERATED: &'static str = Path::Generated.name();
    /// The path of library code.
    pub const GENERIC: &'static str = Path::Generic.name();
    /// The path of power series of recorded equations.
    pub const SERIES: &'static str = "series";
    /// The path of a run in which generated and library code both had their turns.
    pub const MIXED: &'static str = "mixed";

    /// Whether it is of the same code, for the same reason.
    pub(crate) fn is_same_code(&self, other: &Self) -> bool {
        let of = |selection: &'_ Self| (selection.path, selection.formulation);
        of(self) == of(other) && self.reason == other.reason
    }

    /// That of a mode whose momenta are integrated.
    pub(crate) fn of_momenta(since: f64) -> Self {
        let (path, formulation) = (Self::GENERIC, Formulation::Momentum.name());
        Self { since, path, formulation, reason: AS_DEMANDED.into(), evaluations: 0 }
    }
}

/// Why code runs that was asked for by name.
pub(crate) const AS_DEMANDED: &str = "as demanded";

/// What stands for all code of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CodeOfRun {
    /// The path; [`Selection::MIXED`] where evaluations went on more than one.
    pub path: &'static str,
    /// The formulation of most evaluations.
    pub formulation: &'static str,
    /// Share of the evaluations by generated code.
    pub generated_share: f64,
}

impl CodeOfRun {
    /// Of these selections; before the first, the recursion.
    pub fn of(selections: &[Selection]) -> Self {
        let count = |which: &dyn Fn(&Selection) -> bool| -> usize {
            selections.iter().filter(|selection| which(selection)).map(|s| s.evaluations).sum()
        };
        let all = count(&|_| true);
        // A run that ends where it starts has evaluated nothing.
        let ran = |selection: &&Selection| all == 0 || selection.evaluations > 0;
        let mut paths = selections.iter().filter(ran).map(|selection| selection.path);
        let path = paths.next().unwrap_or(Selection::GENERIC);
        let path = if paths.all(|other| other == path) { path } else { Selection::MIXED };
        let of_form = |form: &Selection| count(&|other| other.formulation == form.formulation);
        let most = selections.iter().rev().max_by_key(|selection| of_form(selection));
        let generated = count(&|selection| selection.path == Selection::GENERATED);
        Self {
            path,
            formulation: most.map_or("recursive", |selection| selection.formulation),
            generated_share: match all {
                0 => f64::from(u8::from(path == Selection::GENERATED)),
                all => generated as f64 / all as f64,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(selections: &[(&'static str, &'static str, usize)]) -> CodeOfRun {
        let selection = |&(path, formulation, evaluations)| {
            let reason = "".into();
            Selection { since: 0.0, path, formulation, reason, evaluations }
        };
        CodeOfRun::of(&selections.iter().map(selection).collect::<Vec<_>>())
    }

    #[test]
    fn what_ran_stands_for_the_run() {
        const ROUTINE: (&str, &str) = ("generated", "articulated");
        for (selections, path, formulation, generated_share) in [
            (&[][..], "generic", "recursive", 0.0),
            (&[(ROUTINE.0, ROUTINE.1, 0)], "generated", "articulated", 1.0),
            (&[(ROUTINE.0, ROUTINE.1, 7)], "generated", "articulated", 1.0),
            (&[("series", "articulated", 9)], "series", "articulated", 0.0),
            (
                &[("generic", "recursive", 30), (ROUTINE.0, ROUTINE.1, 10)],
                "mixed",
                "recursive",
                0.25,
            ),
            (
                &[
                    ("generic", "recursive", 1),
                    (ROUTINE.0, ROUTINE.1, 2),
                    ("generic", "recursive", 1),
                ],
                "mixed",
                "recursive",
                0.5,
            ),
            (
                &[("generic", "symmetric", 5), ("generic", "recursive", 6)],
                "generic",
                "recursive",
                0.0,
            ),
            // Chosen for a mode that lasted no time.
            (
                &[("generic", "recursive", 0), (ROUTINE.0, ROUTINE.1, 10)],
                "generated",
                "articulated",
                1.0,
            ),
        ] {
            let expected = CodeOfRun { path, formulation, generated_share };
            assert_eq!(of(selections), expected, "{selections:?}");
        }
    }
}
