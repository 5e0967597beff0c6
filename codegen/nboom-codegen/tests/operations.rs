//! What recorded graphs and generated code cost is what the documents say.

use nboom_codegen::{Level, Request, generate, trace};
use nboom_expr::{Graph, Node};
use nboom_formulation::{Formulation, Symmetry};

const DOCUMENT: &str = include_str!("../../../docs/formulations.md");

/// What stands between the marks.
fn marked(what: &str, end: &str) -> &'static str {
    let (_, rest) = DOCUMENT.split_once(&format!("<!-- {what} -->\n")).expect("a begin mark");
    rest.split_once(&format!("<!-- end of {end} -->")).expect("an end mark").0
}

/// Rows between the marks, and the last of their cells.
fn documented() -> Vec<(String, String)> {
    let table = marked("generated code of S2_P", "generated code");
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

/// Additions, multiplications and divisions of a graph that depend on more than its first inputs.
fn recorded(graph: &Graph, parameters: usize) -> usize {
    let mut varies: Vec<bool> = Vec::new();
    for (_, node) in graph.nodes() {
        varies.push(match node {
            Node::Input(input) => input as usize >= parameters,
            other => other.operands().any(|id| varies[id.index()]),
        });
    }
    let cost = graph.operations_of(|node| varies[node]);
    cost.additions + cost.multiplications + cost.divisions
}

#[test]
fn costs_of_recorded_graphs_are_those_of_the_tables() {
    let topologies = ["S2_P", "4xS5", "S100", "20xS5", "S1", "S2", "S3", "S5", "P"];
    let mut rows = 0;
    for row in marked("recorded graphs", "recorded graphs").lines() {
        let Some((name, cells)) = row.strip_prefix("| `").and_then(|row| row.split_once("` | "))
        else {
            continue;
        };
        // The page says how these two are counted otherwise.
        if name == "momentum" || name == "recursive" {
            continue;
        }
        let formulation = Formulation::named(name).expect("a formulation's name");
        let cells: Vec<&str> = cells.trim_end_matches(" |").split(" | ").collect();
        let first = if cells.len() == 4 { 0 } else { 4 };
        for (topology, cell) in topologies[first..].iter().zip(cells) {
            let of = |symmetry: Symmetry| {
                let topology = topology.parse().expect("a topology");
                let request = Request::new("Recorded", topology, Level::Exact);
                let request = request.by(formulation).with_symmetry(symmetry);
                recorded(&trace(&request), request.assumptions.len())
            };
            let found = format!("{} / {}", of(Symmetry::General), of(Symmetry::Principal));
            assert_eq!(cell.replace(' ', ""), found.replace(' ', ""), "{name} {topology}");
        }
        rows += 1;
    }
    assert_eq!(rows, 7);
}
