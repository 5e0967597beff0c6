//! What is no thin-walled section with one cell.

use nboom_sections::{Point, Polygon, SectionError, Tube};

fn refused(corners: &[(f64, f64)], thickness: &[f64]) -> Vec<SectionError> {
    let corners: Vec<Point> = corners.iter().map(|&(xi, zeta)| Point { xi, zeta }).collect();
    Polygon::new(&corners, thickness).expect_err("refused")
}

fn told(errors: &[SectionError]) -> Vec<String> {
    errors.iter().map(SectionError::to_string).collect()
}

const SQUARE: [(f64, f64); 4] = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];

#[test]
fn numbers() {
    let errors = refused(&SQUARE[..2], &[0.1; 2]);
    assert_eq!(errors, [SectionError::TooFewVertices { found: 2 }]);
    assert_eq!(told(&errors), ["2 vertices found, at least 3 expected"]);
    let errors = refused(&SQUARE, &[0.1; 3]);
    assert_eq!(told(&errors), ["3 wall thicknesses found, 4 expected, as many as vertices"]);
    let mut corners = SQUARE;
    corners[2].1 = f64::NAN;
    let errors = told(&refused(&corners, &[0.1, 0.0, f64::INFINITY, -0.1]));
    assert_eq!(
        errors,
        [
            "vertex 3: coordinates -1 and NaN found, finite numbers expected",
            "wall 2: thickness 0 found, a positive finite number expected",
            "wall 3: thickness inf found, a positive finite number expected",
            "wall 4: thickness -0.1 found, a positive finite number expected",
        ]
    );
    let many = told(&refused(&[(0.0, 0.0); 1001], &[0.1; 1001]));
    assert_eq!(many, ["1001 vertices found, at most 1000 expected"]);
    assert_eq!(refused(&[], &[]), [SectionError::TooFewVertices { found: 0 }]);
}

#[test]
fn walls_without_length() {
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)];
    assert_eq!(
        told(&refused(&corners, &[0.1; 4])),
        ["wall 2: length zero found, vertices 2 and 3 at different points expected"]
    );
    // The first vertex repeated at the end, as in file formats that close outlines.
    let corners = [&SQUARE[..], &SQUARE[..1]].concat();
    assert_eq!(
        told(&refused(&corners, &[0.1; 5])),
        ["wall 5: length zero found, vertices 5 and 1 at different points expected"]
    );
}

#[test]
fn outlines_that_meet_themselves() {
    for (corners, walls, what) in [
        (&[(1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0)][..], (0, 2), "a bow tie"),
        (
            &[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 0.0), (0.0, 2.0)],
            (0, 2),
            "a vertex on a wall",
        ),
        (&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 1.0)], (0, 1), "a wall folded back"),
        (
            &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (3.0, 1.0), (3.0, 0.0), (0.5, 0.0), (0.5, -1.0)],
            (0, 4),
            "walls on one line that overlap",
        ),
    ] {
        let errors = refused(corners, &vec![0.1; corners.len()]);
        let (wall, other) = walls;
        assert!(errors.contains(&SectionError::Crossing { wall, other }), "{what}: {errors:?}");
        let words = format!("walls {} and {} that cross or touch found", wall + 1, other + 1);
        assert!(told(&errors).iter().any(|line| line.starts_with(&words)), "{what}");
    }
}

#[test]
fn outlines_that_only_come_near_are_accepted() {
    // A slit, parallel walls on one line apart, and a vertex just off a wall.
    for corners in [
        vec![
            (0.0, 0.0),
            (3.0, 0.0),
            (3.0, 1.0),
            (2.0, 1.0),
            (2.0, 1e-6),
            (1.0, 1e-6),
            (1.0, 1.0),
            (0.0, 1.0),
        ],
        vec![
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 1.0),
            (3.0, 1.0),
            (3.0, 0.5),
            (1.0, 0.5),
            (1.0, 1.0),
            (0.0, 1.0),
        ],
    ] {
        let corners: Vec<Point> = corners.iter().map(|&(xi, zeta)| Point { xi, zeta }).collect();
        Polygon::new(&corners, &vec![1e-7; corners.len()]).expect("a section");
    }
}

#[test]
fn nothing_enclosed() {
    let errors = refused(&[(0.0, 0.0), (1.0, 0.5), (2.0, 1.0)], &[0.1; 3]);
    assert!(matches!(errors[..], [SectionError::NoEnclosedArea { .. }]), "{errors:?}");
    assert!(told(&errors)[0].ends_with("found, a closed cell expected"));
}

#[test]
fn tubes() {
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = Tube::new(radius, 0.1).expect_err("refused").to_string();
        assert_eq!(error, format!("radius {radius} found, a positive finite number expected"));
    }
    for thickness in [0.0, -0.1, 2.1, f64::NAN, f64::INFINITY] {
        let error = Tube::new(2.0, thickness).expect_err("refused").to_string();
        let words =
            format!("thickness {thickness} found, above 0 and at most the radius 2 expected");
        assert_eq!(error, words);
    }
    assert!(Tube::new(2.0, 2.0).is_ok());
}

#[test]
fn numbers_whose_powers_do_not_exist() {
    assert_eq!(Tube::new(1e100, 1e99), Err(SectionError::Range));
    assert_eq!(Tube::new(1e-100, 1e-101), Err(SectionError::Range));
    for unit in [1e100, 1e-100, 1e308] {
        let corners = SQUARE.map(|(xi, zeta)| (xi * unit, zeta * unit));
        assert_eq!(refused(&corners, &[0.1 * unit; 4]), [SectionError::Range]);
    }
}
