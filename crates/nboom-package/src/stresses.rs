//! The routine for loads and stresses in a crate of routines.

use std::fmt::Write;

use nboom_codegen::StressRequest;
use nboom_loads::SceneMotion;
use nboom_scalar::{DoubleDouble, Real};

use crate::manifest::rust_name;

const TEST: &str = include_str!("../templates/stresses.rs");

/// What `README.md` says of the numbers.
pub(crate) const NUMBERS: &str = include_str!("../templates/stresses.txt");

/// Motions that the compiled code is tested on.
const MOTIONS: usize = 20;

/// The row of the routine among those of `README.md`.
pub(crate) fn row(request: &StressRequest) -> String {
    let StressRequest { name, equations, level, .. } = request;
    let (hinges, numbers) = (equations.hinges(), equations.numbers().len());
    format!(
        "| `{name}` | {hinges} hinges | loads and stresses | | {} | all {numbers} numbers of \
         the scene |\n",
        level.name()
    )
}

/// The test of the crate `of_crate` for the routine, and its data.
pub(crate) fn checks(of_crate: &str, request: &StressRequest) -> [(String, String); 2] {
    let name = &request.name;
    let hinges = request.equations.hinges().to_string();
    let code = TEST.replace("/*CRATE*/", &rust_name(of_crate)).replace("/*NAME*/", name);
    let code = code.replace("/*HINGES*/", &hinges);
    [("tests/stresses.rs".to_owned(), code), (format!("tests/{name}.csv"), table(request))]
}

/// Motions and the loads and stresses that the equations give with 32 digits, a row for each.
fn table(request: &StressRequest) -> String {
    let numbers: Vec<DoubleDouble> =
        request.equations.numbers().into_iter().map(DoubleDouble::constant).collect();
    let mut equations = request.equations.with_numbers(&numbers);
    let mut found = equations.load_set();
    let mut text = String::new();
    for motion in 0..MOTIONS {
        let size = equations.motion_size();
        let number = |i: usize| 3.0 * (1.7 * i as f64 + 0.9 * motion as f64 + 0.3).sin();
        let row: Vec<f64> = (0..size.count()).map(number).collect();
        let exact: Vec<DoubleDouble> = row.iter().copied().map(DoubleDouble::constant).collect();
        let motion = SceneMotion::of_numbers(&exact, size);
        equations.evaluate(&motion, &mut found);
        let expected = found.numbers().into_iter().map(DoubleDouble::to_f64);
        let cells = row.into_iter().chain(expected).map(|number| format!("{number:?}"));
        writeln!(text, "{}", cells.collect::<Vec<_>>().join(",")).expect("a string takes any text");
    }
    text
}
