//! The tests of a crate of routines, with their data.

use nboom_codegen::Output;

use crate::certificate::Routine;
use crate::certified::{Found, Tested};
use crate::manifest::rust_name;

const COMMON: &str = include_str!("../templates/certificate.rs");
const NUMBERS: &str = include_str!("../templates/certificate_numbers.rs");
const EQUATIONS: &str = include_str!("../templates/certificate_equations.rs");
const RIGHT_SIDE: &str = include_str!("../templates/certificate_right_side.rs");
const DERIVATIVES: &str = include_str!("../templates/certificate_derivatives.rs");
const TEST: &str = include_str!("../templates/certificate_test.rs");

/// `tests/certificate.rs` of the crate `name`.
pub(crate) fn code(name: &str, routines: &[Routine]) -> String {
    let has = |output: Output| routines.iter().any(|routine| routine.request.output == output);
    let only_if = |is_so: bool, text: &'static str| if is_so { text } else { "" };
    let parts = [
        NUMBERS,
        only_if(has(Output::Equations), EQUATIONS),
        only_if(has(Output::RightSide), RIGHT_SIDE),
    ];
    let parts = parts.concat();
    let name = rust_name(name);
    let tests: String = routines.iter().map(|routine| test(&name, routine)).collect();
    // The first routine is that for the scene's accelerations.
    let derivatives = DERIVATIVES.replace("/*NAME*/", &routines[0].request.name);
    (COMMON.to_owned() + &parts + &derivatives).replace("/*CRATE*/", &name) + &tests
}

/// The test of one routine.
fn test(of_crate: &str, routine: &Routine) -> String {
    let name = &routine.request.name;
    let (function, tolerance) = (name.to_lowercase(), routine.certified.tolerance());
    let off = match routine.certified.found {
        Found::Accelerations(_) | Found::InverseDynamics(_) => "off_numbers",
        Found::Equations { .. } => "off_equations",
        Found::RightSide { .. } => "off_rates",
    };
    let values = [
        ("FUNCTION", function.as_str()),
        ("CRATE", of_crate),
        ("NAME", name),
        ("TOLERANCE", &format!("{tolerance:e}")),
        ("OFF", off),
    ];
    let fill =
        |text: String, (key, value): (&str, &str)| text.replace(&format!("/*{key}*/"), value);
    values.into_iter().fold(TEST.to_owned(), fill)
}

/// Where the table of a routine stands.
pub(crate) fn table_path(routine: &Routine) -> String {
    format!("tests/{}.csv", routine.request.name)
}

/// Parameters, states, what is to come out and the least scale of deviations from it, a row for each state under
/// one that counts them.
pub(crate) fn table(routine: &Routine) -> String {
    let word = match routine.certified.found {
        Found::Accelerations(_) => "acceleration",
        Found::Equations { .. } => "unknown",
        Found::InverseDynamics(_) => "force",
        Found::RightSide { .. } => "rate",
    };
    let mut text = String::new();
    for (i, Tested { parameters, coordinates, expected, least, .. }) in
        routine.certified.tested.iter().enumerate()
    {
        let columns = [("parameter", parameters), ("state", coordinates), (word, expected)];
        if i == 0 {
            let names = columns
                .iter()
                .flat_map(|(word, row)| (0..row.len()).map(move |i| format!("{word}_{i}")));
            let names = names.chain(["least_scale".to_owned()]);
            text += &(names.collect::<Vec<_>>().join(",") + "\n");
        }
        let numbers = columns.iter().flat_map(|(_, row)| row.iter()).chain([least]);
        let cells = numbers.map(|x| format!("{x:?}"));
        text += &(cells.collect::<Vec<_>>().join(",") + "\n");
    }
    text
}
