//! What a scene asks a run to write.

use nboom_io::Sampling;
use nboom_model::{Column, Quantity};

use super::{BUS, body, right, wrong};

fn with(output: &str) -> String {
    let bodies = body("inner", "", "") + &body("outer", "on = \"inner\"", "");
    format!("{BUS}\n[output]\n{output}\n{bodies}")
}

#[test]
fn output_times_are_given_in_one_of_three_ways() {
    let sampling = |output: &str| right(&with(output)).settings.sampling;
    assert_eq!(sampling(""), None);
    assert_eq!(sampling("samples = 7"), Some(Sampling::Uniform(7)));
    assert_eq!(sampling("every = 0.5"), Some(Sampling::Every(0.5)));
    assert_eq!(sampling("times = [1, \"2 * 2\"]"), Some(Sampling::At(vec![1.0, 4.0])));
    for (output, told) in [
        ("samples = 7\nevery = 1", "every: found `every` beside `samples`, expected one of them"),
        ("every = 0", "every: found output times every 0 from 0 to 10, expected a positive time"),
        ("every = 1e-9", "expected a positive time and at most 10000000 of them"),
        (
            "times = [1, 11]",
            "times: found 11, expected a time from the start to the end of the run",
        ),
        ("times = [2, 1]", "times: found 1 after 2, expected ascending times"),
        ("times = 2", "times: found a number, expected a list of numbers"),
        ("angles = \"gon\"", "angles: found `gon`, expected one of radians, degrees"),
        ("files = [\"lisitng\"]", "did you mean `listing`?"),
        ("columns = [\"omga\"]", "did you mean `omega`?"),
        ("columns = [\"beta of iner\"]", "did you mean `beta of inner`?"),
        ("columns = [3]", "columns: found a number, expected a text in quotes"),
    ] {
        let errors = wrong(&with(output));
        assert_eq!(errors.len(), 1, "{errors:#?}");
        assert!(errors[0].contains(told), "{told}: {}", errors[0]);
    }
}

#[test]
fn columns_are_called_by_quantity_body_or_table() {
    let table = |output: &str| right(&with(output)).settings.table;
    assert_eq!(table(""), None);
    assert_eq!(table("angles = \"radians\""), None);
    let degrees = table("angles = \"degrees\"").expect("a table");
    assert!(degrees.in_degrees);
    assert_eq!(degrees.columns, Column::all(2));
    let columns = "columns = [\"beta of outer\", \"v_y\", \"tau\", \"tau_1_2\", \"rho\"]";
    let found = table(columns).expect("a table");
    assert!(!found.in_degrees);
    let column = |quantity, component, hinge| Column { quantity, component, hinge };
    let expected = [
        column(Quantity::Angle, 0, Some(1)),
        column(Quantity::Velocity, 1, None),
        column(Quantity::Rate, 0, Some(0)),
        // Each once.
        column(Quantity::Rate, 0, Some(1)),
        column(Quantity::Position, 0, None),
        column(Quantity::Position, 1, None),
        column(Quantity::Position, 2, None),
    ];
    assert_eq!(found.columns, expected);
}
