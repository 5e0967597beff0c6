use std::fmt::Write;

use nboom_verify::{Comparison, Hinges, Quantity, Row, TestCase, compare};

#[cfg(feature = "generator")]
use crate::compile::with_compiled;
use crate::format::{code_columns, code_head, count, not_covered, routine_topology, short};
use crate::run::default_directory;
use crate::{CliError, Routines, VerifyArgs, check, output, print};

const FILE: &str = "verify.json";

/// Compares all code that computes accelerations, writes the largest deviations and prints them.
pub(crate) fn verify(args: &VerifyArgs, routines: &Routines) -> Result<String, CliError> {
    let file = check::scene(&args.scene)?;
    #[cfg(feature = "generator")]
    let routines = &with_compiled(routines, &file, args.compiled)?;
    let beside = || default_directory(&file.scene.name).join(FILE);
    let path = args.output.clone().unwrap_or_else(beside);
    output::check(&path, &args.scene.scene)?;
    let held = TestCase::with_held_hinges(&file.scene, args.states / 2, args.seed)?;
    let free = TestCase::new(file.scene, args.states - held.len(), args.seed)?;
    let Routines { for_runs, equations, .. } = *routines;
    let comparison = compare(&free, &held, for_runs, equations, args.tol)?;
    print(&table(&comparison))?;
    output::write(&path, &args.scene.scene, &comparison.json())?;
    let worst = comparison.worst();
    if !comparison.passed() {
        return Err(CliError::Deviation {
            code: format!("{} of {}", worst.quantity, worst.label),
            deviation: worst.worst(),
            state: worst.state,
            tol: args.tol,
        });
    }
    Ok(format!("results in {}\n", path.display()))
}

fn table(comparison: &Comparison) -> String {
    let Comparison { scene, states, held, seed, tolerance, .. } = comparison;
    let random = count(*states, "random state", "random states");
    let mut text = format!("{scene}: largest deviations in {random} from seed {seed}\n");
    let mut line = |line: String| writeln!(text, "{line}").expect("a string takes any text");
    for (hinges, states, head) in [
        (Hinges::Free, states - held, "all hinges free"),
        (Hinges::Held, *held, "random hinges held at random angles"),
    ] {
        if states == 0 {
            continue;
        }
        let rows = comparison.rows.iter().filter(|row| row.hinges == hinges);
        for quantity in [Quantity::Accelerations, Quantity::MassMatrix, Quantity::Forcing] {
            line(format!("\n{quantity}, {head}, {}", count(states, "state", "states")));
            line(row_head());
            rows.clone().filter(|row| row.quantity == quantity).map(row).for_each(&mut line);
            if (hinges, quantity) == (Hinges::Free, Quantity::Accelerations) {
                comparison.not_covered.iter().map(not_covered).for_each(&mut line);
            }
        }
    }
    line(format!(
        "\ntolerance {tolerance:e}; condition of the mass matrix up to {}, rounding magnified up to {} times",
        short(comparison.largest_condition, 3),
        short(comparison.largest_magnification, 3)
    ));
    text
}

fn row_head() -> String {
    let [recursion, exact] = ["from recursion", "from double-double"];
    format!("{} {recursion:>14} {exact:>18} {:>6} {:>7}", code_head(), "state", "covered")
}

fn row(row: &Row) -> String {
    let Row { label, from_recursion, from_double_double, state, states, .. } = row;
    let from_recursion = from_recursion.map_or("-".to_owned(), |off| format!("{off:.1e}"));
    let (columns, routine) = (code_columns(label), routine_topology(label));
    format!(
        "{columns} {from_recursion:>14} {from_double_double:>18.1e} {state:>6} {states:>7}{routine}"
    )
}
