use std::cell::Cell;
use std::fs;

use nboom_study::{Outcome, Row, Runner, Value, columns, trajectory_columns};
use nboom_tables::TableWriter;
use proptest::prelude::*;

use super::{cell, complete, example, folder, row, rows, status, study};

const SPRINGS: &str = r#"
[run]
end_time = 2.5
samples = 20

[[vary]]
name = "spring"
path = "body.x panel.hinge.spring.stiffness"
as = "factor"
values = [0.0, 1.0, 2.0]

[[vary]]
name = "rate"
path = "initial.rate_deg[1]"
as = "offset"
values = [0.0, 10.0]
"#;

/// Rows whose numbers have the same bits.
fn same(a: &Row, b: &Row) -> bool {
    let bits = |value: &Value| match value {
        Value::Number(number) => Some(number.to_bits()),
        _ => None,
    };
    let cells = a.cells.iter().zip(&b.cells);
    a == b && cells.into_iter().all(|(a, b)| bits(a) == bits(b))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn rows_do_not_depend_on_those_before(order in prop::collection::vec(1..=6_u64, 1..8)) {
        let study = study("order", &example("cubesat.toml"), SPRINGS);
        let alone: Vec<Row> = (1..=6).map(|case| row(&study, case)).collect();
        for (row, case) in rows(&study, order.clone()).iter().zip(&order) {
            prop_assert!(same(row, &alone[*case as usize - 1]), "{case} of {order:?}");
        }
    }
}

#[test]
fn a_scene_of_a_case_says_what_was_drawn() {
    let study = study("scene", &example("cubesat.toml"), SPRINGS);
    let file = study.scene_of(&study.case(6)).expect("right");
    let stiffness = |i: usize| -file.scene.bodies[i].hinge.spring.linear;
    assert_eq!([0, 1, 2, 3].map(stiffness), [0.04, 0.04, 0.02, 0.02]);
    assert_eq!(file.scene.initial.omega_body.x, 13_f64.to_radians());
    // The end of its runs is that of the study; the scene's stays.
    assert_eq!(file.scene.end_time, 5.0);
    let text = study.document.text_with(&[]).expect("right");
    assert_eq!(text, nboom_io::write_scene(&study.nominal));
}

#[test]
fn rows_fit_their_columns() {
    let text = format!("trajectories = true\n{SPRINGS}");
    let study = study("columns", &example("cubesat.toml"), &text);
    let row = complete(row(&study, 1));
    let path = folder("columns").join("cases.csv");
    let mut table = TableWriter::csv(&path, columns(&study)).expect("writable");
    let cells: Vec<_> = row.cells.iter().map(Value::cell).collect();
    table.row(&cells).expect("it fits");
    let header = fs::read_to_string(&path).expect("readable");
    let header = header.lines().next().expect("a header");
    assert!(
        header.starts_with("case,seed,spring,rate,lock_time_of_x_panel_1,impulse_of_x_panel_1,")
    );
    assert!(
        header.ends_with("final_nutation,conservation_angular_momentum,conservation_energy,status"),
        "{header}"
    );
    let unit = |name: &str| {
        let columns = columns(&study);
        let found = columns.into_iter().find(|column| column.name == name);
        found.and_then(|column| column.unit)
    };
    assert_eq!(unit("impulse_of_x_panel_1").as_deref(), Some("N m s"));
    assert_eq!(unit("lock_time_of_x_panel_1").as_deref(), Some("s"));
    let trajectory = trajectory_columns(&study);
    assert_eq!(row.states.len(), 21);
    assert!(row.states.iter().all(|state| state.len() + 1 == trajectory.len()));
    assert_eq!((row.states[0][0], row.states[20][0]), (0.0, 2.5));
    let place = trajectory.iter().position(|column| column.name == "nutation").expect("a column");
    let nutation = Value::Number(row.states[20][place - 1]);
    assert_eq!(cell(&study, &row, "final_nutation"), &nutation);
}

#[test]
fn faults_change_what_was_drawn() {
    let text = r#"
        results = ["lock_time of x panel 1", "lock_time of x panel 2", "final nutation"]
        [[vary]]
        name = "spring"
        path = "parameters.stiffness"
        values = [0.02, 0.05]
        [[fault]]
        name = "weak springs"
        change = [{ path = "body.x panel.hinge.spring.stiffness", factor = 0.5 }]
        [[fault]]
        name = "no latch"
        failed_latch = ["x panel 1"]"#;
    let study = study("faults", &example("cubesat.toml"), text);
    assert_eq!(study.cases(), 6);
    let weak = study.scene_of(&study.case(5)).expect("right");
    // Half of what was drawn, not of what the scene says.
    assert_eq!(weak.scene.bodies[0].hinge.spring.linear, -0.025);
    assert_eq!(weak.scene.bodies[2].hinge.spring.linear, -0.05);
    let unlatched = study.scene_of(&study.case(6)).expect("right");
    assert_eq!(unlatched.scene.name_of(0), Some("x panel 1"));
    assert_eq!(unlatched.scene.shapes(), study.nominal.scene.shapes());
    let rows: Vec<Row> = rows(&study, 4..=6).into_iter().map(complete).collect();
    let names: Vec<_> = rows.iter().map(|row| cell(&study, row, "fault").clone()).collect();
    let named = |name: &str| Value::Text(name.to_owned());
    assert_eq!(names, [Value::Empty, named("weak springs"), named("no latch")]);
    let lock =
        |row: &Row, hinge: u8| cell(&study, row, &format!("lock_time_of_x_panel_{hinge}")).clone();
    assert_eq!(lock(&rows[2], 1), Value::Empty);
    assert!(matches!(lock(&rows[2], 2), Value::Number(_)));
    match (lock(&rows[0], 1), lock(&rows[1], 1)) {
        (Value::Number(strong), Value::Number(weak)) => assert!(strong < weak),
        other => panic!("{other:?}"),
    }
}

#[test]
fn numbers_of_hundreds_of_digits_are_told_in_a_few() {
    for path in ["body.x panel.mass", "body.x panel.inertia[1]", "body.x panel.mass_centre[1]"] {
        let text = format!("[[vary]]\nname = \"it\"\npath = \"{path}\"\nvalues = [-1e308]\n");
        let row = row(&study("digits", &example("cubesat.toml"), &text), 1);
        assert_eq!(row.outcome, Outcome::Rejected, "{path}");
        assert!(status(&row).len() < 200, "{path}: {}", status(&row));
    }
}

#[test]
fn what_makes_no_scene_is_rejected_and_what_cannot_be_followed_fails() {
    let text = r#"
        results = ["final nutation", "steps_accepted"]
        trajectories = true
        [[vary]]
        name = "mass"
        path = "body.x panel.mass"
        values = [-1.0, 0.15]
        [[vary]]
        name = "spring"
        path = "body.y panel.hinge.spring.stiffness"
        values = [0.02, -1e9]"#;
    let study = study("status", &example("cubesat.toml"), text);
    let rows = rows(&study, 1..=4);
    let outcomes: Vec<Outcome> = rows.iter().map(|row| row.outcome).collect();
    use Outcome::{Failed, Ok, Rejected};
    assert_eq!(outcomes, [Rejected, Rejected, Ok, Failed]);
    let scene = fs::read_to_string(example("cubesat.toml")).expect("an example");
    let x_panel = scene.find("name = \"x panel\"").expect("the body");
    let mass = x_panel + scene[x_panel..].find("mass =").expect("its mass");
    let line = scene[..mass].matches('\n').count() + 1;
    let refused = "mass: found mass -1, expected a positive finite mass";
    assert_eq!(status(&rows[0]), format!("rejected: scene.toml:{line}: {refused}"));
    assert!(status(&rows[3]).starts_with("failed: at time "), "{}", status(&rows[3]));
    for row in [&rows[0], &rows[3]] {
        assert_eq!(cell(&study, row, "final_nutation"), &Value::Empty);
        assert_eq!(cell(&study, row, "steps_accepted"), &Value::Empty);
        assert!(row.states.is_empty());
        assert!(!status(row).contains('\n'));
    }
    assert_eq!(cell(&study, &rows[0], "mass"), &Value::Number(-1.0));
}

#[test]
fn cases_have_as_many_hinges_as_all() {
    let text = r#"
        results = ["final nutation"]
        [[vary]]
        name = "panels"
        path = "body.x panel.repeat.count"
        values = [1, 2]"#;
    let study = study("hinges", &example("cubesat.toml"), text);
    let rows = rows(&study, 1..=2);
    assert_eq!(status(&rows[0]), "rejected: found 3 hinged bodies, expected 4 in all cases");
    assert_eq!(status(&rows[1]), "ok");
}

#[test]
fn a_study_says_how_its_cases_are_run() {
    let numbers = |run: &str| {
        let text =
            format!("results = [\"samples\", \"rtol\", \"end_time\", \"steps_accepted\"]\n{run}");
        let study = study(&format!("run-{}", run.len()), &example("cubesat.toml"), &text);
        let row = complete(row(&study, 1));
        let columns = ["samples", "rtol", "end_time"];
        let numbers = columns.map(|column| cell(&study, &row, column).clone());
        (numbers, cell(&study, &row, "steps_accepted").clone())
    };
    let integer = Value::Integer;
    let (plain, steps) = numbers("");
    assert_eq!(plain, [integer(500), Value::Number(1e-9), Value::Number(5.0)]);
    let (set, more) =
        numbers("run = { samples = 7, rtol = 1e-12, end_time = 3.0, max_step = 0.01 }");
    assert_eq!(set, [integer(7), Value::Number(1e-12), Value::Number(3.0)]);
    assert!(more != steps && matches!(more, Value::Integer(steps) if steps >= 300));
}

/// A force table that rises beyond its last point drives a slide out ever faster, as an exponential.
#[test]
fn a_case_that_runs_away_says_so_and_has_results() {
    let scene = "[run]\nend = 3.0\n[parameters]\npush = 1.0\n[main_body]\nmass = 100.0\n\
        inertia = [40.0, 30.0, 20.0]\n[[body]]\nname = 'mast'\nmass = 2.0\n\
        mass_centre = [0.0, 1.0, 0.0]\ninertia = [1.0, 0.1, 1.0]\n[body.slide]\n\
        at = [0.0, 1.0, 0.0]\naxis = 'y'\nstart = 0.1\nforce = [[0.0, 0.0], [0.1, '$push']]\n";
    fs::write(folder("runaway").join("mast.toml"), scene).expect("writable");
    let vary = "[[vary]]\nname = 'push'\npath = 'parameters.push'\nvalues = [0.1, 5.0]\n";
    let study = study("runaway", "mast.toml", vary);
    let rows = rows(&study, 1..=2);
    assert_eq!(rows.iter().map(status).collect::<Vec<_>>(), ["ok", "ok, runs away"]);
    assert!(rows.iter().all(|row| row.outcome == Outcome::Ok));
    let residual = cell(&study, &rows[1], "conservation_energy");
    assert!(matches!(residual, Value::Number(_)), "{residual:?}");
}

#[test]
fn an_interrupted_case_has_no_row() {
    let study = study("interrupt", &example("cubesat.toml"), SPRINGS);
    let mut runner = Runner::new(&study, &[], &[]);
    let asked = Cell::new(0);
    let interrupted = || {
        asked.set(asked.get() + 1);
        asked.get() > 5
    };
    assert_eq!(runner.run(&study.case(2), &interrupted), None);
    let after = runner.run(&study.case(2), &|| false).expect("not interrupted");
    assert!(same(&after, &row(&study, 2)));
}
