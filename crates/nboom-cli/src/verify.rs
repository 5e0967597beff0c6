use std::fmt::Write;

use nboom_io::read_scene;
use nboom_verify::{Comparison, Quantity, Row, Subject, compare};

use crate::format::{code_columns, code_head, count, not_covered, short};
use crate::run::default_directory;
use crate::{CliError, Routines, VerifyArgs, check, print, say};

const FILE: &str = "verify.json";

/// Compares all code that computes accelerations, writes the largest deviations and prints them.
pub(crate) fn verify(args: &VerifyArgs, routines: &Routines) -> Result<String, CliError> {
    let file = read_scene(&args.scene)?;
    check::warnings(&file).iter().for_each(|warning| say("warning", warning));
    let subject = Subject::new(file.scene, args.states, args.seed)?;
    let comparison = compare(&subject, routines.accelerations, routines.equations, args.tol)?;
    print(&table(&comparison))?;
    let beside = || default_directory(&comparison.scene).join(FILE);
    let path = args.output.clone().unwrap_or_else(beside);
    comparison.write(&path)?;
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
    let states = count(comparison.states, "random state", "random states");
    let mut text = format!(
        "{}: largest deviations in {states} from seed {}, all hinges free\n",
        comparison.scene, comparison.seed,
    );
    let mut line = |line: String| writeln!(text, "{line}").expect("a string takes any text");
    for quantity in [Quantity::Accelerations, Quantity::MassMatrix, Quantity::Forcing] {
        line(format!(
            "\n{quantity}\n{} {:>14} {:>18} {:>6}",
            code_head(),
            "from recursion",
            "from double-double",
            "state"
        ));
        comparison.rows.iter().filter(|row| row.quantity == quantity).map(row).for_each(&mut line);
        if quantity == Quantity::Accelerations {
            comparison.not_covered.iter().map(not_covered).for_each(&mut line);
        }
    }
    line(format!(
        "\ntolerance {:e}; largest condition of the mass matrix {}",
        comparison.tolerance,
        short(comparison.largest_condition, 3)
    ));
    text
}

fn row(row: &Row) -> String {
    let Row { label, from_recursion, from_double_double, state, .. } = row;
    let from_recursion = from_recursion.map_or("-".to_owned(), |off| format!("{off:.1e}"));
    let columns = code_columns(label);
    format!("{columns} {from_recursion:>14} {from_double_double:>18.1e} {state:>6}")
}
