//! What generated code of S2_P costs is what the documents say.

use nboom_codegen::{Level, Request, generate};
use nboom_formulation::{Formulation, Symmetry};

const DOCUMENT: &str = include_str!("../../../docs/formulations.md");

/// Rows between the marks, and the last of their cells.
fn documented() -> Vec<(String, String)> {
    let (_, rest) = DOCUMENT.split_once("<!-- generated code of S2_P -->\n").expect("a begin mark");
    let (table, _) = rest.split_once("<!-- end of generated code -->").expect("an end mark");
    let cells = |row: &str| -> Option<(String, String)> {
        let (name, counts) = row.strip_prefix("| `")?.split_once("` | ")?;
        Some((name.to_owned(), counts.trim_end_matches(" |").to_owned()))
    };
    table.lines().filter_map(cells).collect()
}

/// Additions, multiplications and divisions of an evaluation with external wrench, in general and
/// with principal axes.
fn counted(formulation: Formulation) -> String {
    let topology = "S2_P".parse().expect("a topology");
    let general = Request::new("S2P", topology, Level::Fast).with_external_wrench().by(formulation);
    let requests = [general.clone(), general.with_symmetry(Symmetry::Principal)];
    let cells = requests.map(|request| {
        let cost = generate(&request).expect("S2_P can be generated").evaluation;
        format!("{} + {} + {}", cost.additions, cost.multiplications, cost.divisions)
    });
    cells.join(" | ")
}

#[test]
fn costs_of_generated_code_are_those_of_the_table() {
    let expected = Formulation::ALL.map(|f| (f.name().to_owned(), counted(f)));
    assert_eq!(documented(), expected);
}

#[test]
fn what_symmetries_save_is_as_told() {
    let text = include_str!("../../../docs/generator.md").replace('\n', " ");
    let operations = |symmetry: Symmetry| {
        let topology = "20xS5".parse().expect("a topology");
        let request = Request::new("Wings", topology, Level::Fast).with_external_wrench();
        let code = generate(&request.with_symmetry(symmetry)).expect("20xS5 can be generated");
        let cost = code.evaluation;
        let sum = cost.additions + cost.multiplications + cost.divisions;
        format!("{},{:03}", sum / 1000, sum % 1000)
    };
    let [principal, mirrored, general] = Symmetry::ALL.map(operations);
    let told = format!(
        "For 20xS5 `principal` takes {principal} operations, `mirrored` {mirrored} and a routine that assumes \
         nothing {general}."
    );
    assert!(text.contains(&told), "{told}");
}
