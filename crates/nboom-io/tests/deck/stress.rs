//! The stress groups: when they are read, and what is checked in them.

use nboom_scalar::Sym3;

use super::{REPORT_DECK, errors, lines, read, replaced};

fn changed(old: &str, new: &str) -> String {
    with_changes(REPORT_DECK, &[(old, new)])
}

fn without_groups() -> String {
    let start = REPORT_DECK.find(" &DYNSTA").unwrap();
    let end = REPORT_DECK.find(" &ROCK").unwrap();
    format!("{}{}", &REPORT_DECK[..start], &REPORT_DECK[end..])
}

#[test]
fn groups_and_flag_together_ask_for_stresses() {
    assert!(read(REPORT_DECK).structure.is_some());
    assert!(read(&changed("INSTR=3", "INSTR=1")).structure.is_some());

    let flag_alone = read(&without_groups());
    assert!(flag_alone.structure.is_none());
    assert_eq!(flag_alone.warnings[0].symbol, "INSTR");

    let groups_alone = read(&changed("INSTR=3", "INSTR=0"));
    assert!(groups_alone.structure.is_none());
    assert_eq!(groups_alone.warnings[0].symbol, "INSTR");
    assert_eq!(groups_alone.warnings.len(), 3);

    let neither = read(&without_groups().replace("INSTR=3", "INSTR=0"));
    assert!(neither.structure.is_none() && neither.warnings.is_empty());
}

/// The report's deck without one of its groups.
fn without(group: &str, next: &str) -> String {
    let (start, end) = (REPORT_DECK.find(group).unwrap(), REPORT_DECK.find(next).unwrap());
    format!("{}{}", &REPORT_DECK[..start], &REPORT_DECK[end..])
}

#[test]
fn stations_do_without_inertias_of_slices_which_are_then_zero() {
    let found = read(&without(" &DYNSTB", " &ROCK"));
    let segments = found.structure.as_ref().expect("stations are enough").segments();
    let slices = segments.iter().flat_map(|segment| &segment.stations).map(|at| at.slice);
    assert!(slices.clone().all(|slice| slice.inertia == Sym3::zero()));
    // All else is that of the whole deck.
    let whole = read(REPORT_DECK);
    let masses = whole.structure.iter().flat_map(|structure| structure.segments());
    let masses = masses.flat_map(|segment| &segment.stations).map(|at| at.slice.mass);
    assert!(slices.map(|slice| slice.mass).eq(masses));
    assert_eq!(found.scene, whole.scene);
    // Slices without inertia do not add up to their segments, which is told of each.
    let told = found.warnings.iter().filter(|warning| warning.symbol.starts_with("DLI"));
    assert_eq!(told.count(), segments.len());
}

#[test]
fn inertias_of_slices_are_nothing_without_stations() {
    let deck = without(" &DYNSTA", " &DYNSTB");
    let errors = lines(&errors(&deck));
    assert!(
        errors[0].ends_with("&DYNSTB: found &DYNSTB alone, expected &DYNSTA before it"),
        "{errors:?}"
    );
}

#[test]
fn what_is_checked() {
    let table = [
        ("NSTA=1,3,2,1,", "NSTA=1,6,2,1,", "NSTA(2)", "6", "a number from 1 to 5"),
        ("NSTA=1,3,2,1,", "NSTA=1,3,2,", "NSTA(4)", "nothing", "a number from 1 to 5"),
        ("NVER(2,2)=3", "NVER(2,2)=2", "NVER(2,2)", "2", "a number from 3 to 6"),
        ("NVER(2,2)=3,", "", "NVER(2,2)", "nothing", "a number from 3 to 6"),
        ("R(1,1)=2.0,", "", "R(1,1)", "nothing", "a positive value"),
        ("T1=.05", "T1=-.05", "T1(1,1)", "-0.05", "a positive value"),
        ("E=4*30.0E6", "E=3*30.0E6", "E(4)", "nothing", "a positive value"),
        ("CMN=4*.1", "CMN=4*.1,CMN(2)=0.0", "CMN(2)", "pulse constant 0", "a positive finite time"),
        (
            "DELM(2,2)=.2",
            "DELM(2,2)=-.2",
            "DELM(2,2)",
            "slice of mass -0.2",
            "a finite mass not below zero",
        ),
        (
            "DLI32=10.0,3*0.0,5.0",
            "DLI32=10.0,3*0.0,25.0",
            "DLI32(1,1)",
            "slice with principal moments of inertia 10, 10, 25",
            "the largest at most the sum of the two others",
        ),
        ("S(3,2)=0.0", "S(3,2)=1.0", "S(3,2)", "last station 1 from the hinge", "0"),
        (
            "E=4*30.0E6",
            "E=3*30.0E6,-1.0",
            "E(4)",
            "Young's modulus -1",
            "a positive finite modulus",
        ),
        (
            "S(2,2)=10.0",
            "S(2,2)=25.0",
            "S(2,2)",
            "distance 25 after 20",
            "at most that of the station before",
        ),
        ("DELC4=", "DELC5=", "DELC", "segment 5", "a segment from 1 to 4"),
        ("DLI41=", "DLI46=", "DLI", "station 6", "a station from 1 to 5"),
        ("DLI41=", "DLI51=", "DLI", "segment 5", "a segment from 1 to 4"),
        (
            "DLI41=20.0,3*0.0",
            "DLI41=20.0,1.0,2*0.0",
            "DLI41(2,1)",
            "1 beside DLI41(1,2) of 0",
            "a symmetric matrix",
        ),
        ("ICIR=0,1,0,1,", "ICIR=0,1,0,1,S(6,1)=0.0,", "S", "6", "a subscript from 1 to 5"),
    ];
    for (old, new, symbol, found, expected) in table {
        let errors = errors(&changed(old, new));
        assert_eq!(errors.len(), 1, "{new}: {errors:?}");
        let error = &errors[0];
        assert_eq!((&*error.symbol, &*error.found, &*error.expected), (symbol, found, expected));
    }
}

/// Sections of the report's deck: a tube, a pentagon, a triangle, a pentagon, two tubes and a
/// rectangle. All that are none are told at once, with the number that makes them so.
#[test]
fn sections_that_are_none_are_refused_where_they_stand() {
    let changes = [
        ("R(1,1)=2.0", "R(1,1)=.02"),
        ("XI2=2.15,.67,-1.74", "XI2=2.15,-1.74,.67"),
        ("4.33,-4.33,-4.33", "4.33,4.33,-4.33"),
        ("0.0,5.0,-5.0", "0.0,0.0,-5.0"),
        ("XI4=20.0,-20.0,-20.0,20.0", "XI4=20.0,-20.0,20.0,-20.0"),
    ];
    assert_eq!(
        lines(&errors(&with_changes(REPORT_DECK, &changes))),
        [
            "a.nml:54:5: T1(1,1): found thickness 0.05, expected above 0 and at most the radius 0.02",
            "a.nml:56:17: XI2(3,1): found walls 1 and 3 that cross or touch, expected one cell",
            "a.nml:56:40: XI2(2,2): found wall 1: length zero, expected vertices 1 and 2 at different \
             points",
            "a.nml:58:22: XI4(4,1): found walls 2 and 4 that cross or touch, expected one cell",
        ]
    );
}

#[test]
fn sections_with_missing_numbers_have_no_other_errors() {
    let deck = changed("T2=5*.15,0.0,3*.05,", "T2=2*.15,2*,.15,0.0,.05,,.05,");
    let found = lines(&errors(&deck));
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(found.iter().all(|line| line.contains(": T2(")), "{found:?}");
}

/// Segment 1 is a tube with one station, segment 2 has polygons with five, three and five vertices.
#[test]
fn numbers_of_stations_and_walls_that_are_not_there_are_ignored_with_a_warning() {
    let ignored = |old: &str, new: &str| -> Vec<String> {
        let warnings = read(&changed(old, new)).warnings.into_iter();
        let ignored = warnings.filter(|warning| warning.expected.ends_with("it is ignored"));
        ignored.map(|w| format!("{}: {}", w.symbol, w.expected)).collect()
    };
    assert_eq!(ignored("INSTR=3", "INSTR=3"), [""; 0]);
    for (old, new, expected) in [
        ("S(1,1)=0.0", "S(1,1)=0.0,1.0", "S(2,1): none since NSTA(1) is 1"),
        ("DLI21=9*0.0", "DLI21=9*0.0,DLI14=1.0", "DLI14(1,1): none since NSTA(1) is 1"),
        ("T1=.05", "T1=.05,.06", "T1(2,1): none since ICIR(1) is 0, a tube"),
        ("XI4=20.0", "XI1=20.0,XI4=20.0", "XI1(1,1): none since ICIR(1) is 0, a tube"),
        ("R(1,1)=2.0", "R(1,1)=2.0,R(2,2)=1.0", "R(2,2): none since ICIR(2) is not 0, a polygon"),
        ("T2=5*.15,0.0", "T2=6*.15", "T2(6,1): none since NVER(1,2) is 5"),
    ] {
        assert_eq!(ignored(old, new), [format!("{expected}; it is ignored")], "{new}");
    }
}

#[test]
fn thick_walls_are_worth_a_warning() {
    let of_walls = |deck: &str| {
        let warnings = read(deck).warnings.into_iter();
        let texts = warnings.map(|warning| warning.to_string());
        texts.filter(|text| text.contains("thin-wall theory")).collect::<Vec<_>>()
    };
    assert_eq!(of_walls(REPORT_DECK), [""; 0]);
    let thick =
        with_changes(REPORT_DECK, &[("T1=.05", "T1=.3"), (".05,.1,.05,.1", ".05,.3,.05,.1")]);
    assert_eq!(
        of_walls(&thick),
        [
            "a.nml:54:5: T1(1,1): found thickness 0.150 of the radius, expected at most 0.1 for \
             thin-wall theory",
            "a.nml:54:69: T4(2,1): found wall 2: thickness 0.158 of the mean radius of the cell, expected at most \
             0.1 for thin-wall theory",
        ]
    );
}

#[test]
fn a_station_beyond_its_slice_is_worth_a_warning() {
    let of_stations = |deck: &str| {
        let warnings = read(deck).warnings.into_iter();
        let texts = warnings.map(|warning| warning.to_string());
        texts.filter(|text| text.contains("outboard of its station")).collect::<Vec<_>>()
    };
    // Two slices of the report are as far from the hinge as their stations.
    assert_eq!(of_stations(REPORT_DECK), [""; 0]);
    assert_eq!(
        of_stations(&changed("S(2,2)=10.0", "S(2,2)=16.0")),
        [
            "a.nml:69:32: S(2,2): found distance 16 of a station whose slice has its mass centre at 15 along the long axis, \
          expected a slice outboard of its station"
        ]
    );
}

#[test]
fn spelling_is_checked_even_when_no_stresses_are_wanted() {
    let deck = replaced(" &ROCK", " &DYNSTA\n BAD=1.0,\n &END\n &ROCK");
    assert_eq!(
        lines(&errors(&deck)),
        ["a.nml:18:2: &DYNSTA: found `BAD`, expected a symbol of the deck"]
    );
}

fn with_changes(deck: &str, changes: &[(&str, &str)]) -> String {
    let change = |deck: String, &(old, new): &(&str, &str)| {
        assert_eq!(deck.matches(old).count(), 1, "{old}");
        deck.replace(old, new)
    };
    changes.iter().fold(deck.to_owned(), change)
}

/// The report's deck without EMIK, CNIK and HIIK of segment 1, whose one slice they repeat.
fn with_slices_alone() -> String {
    let changes = [
        ("EMIK=.5,.4", "EMIK(2)=.4"),
        ("HIIK=10.0,3*0.0,5.0,3*0.0,10.0,\n 45.0", "HIIK(1,1,2)=\n 45.0"),
        ("CNIK(1,2)=10.0,", ""),
    ];
    with_changes(REPORT_DECK, &changes)
}

#[test]
fn a_segment_with_slices_alone_has_the_mass_of_its_slices() {
    let (with_both, with_slices) = (read(REPORT_DECK), read(&with_slices_alone()));
    assert_eq!(with_slices.scene, with_both.scene);
    assert_eq!(with_slices.structure, with_both.structure);
    assert_eq!(with_slices.warnings, with_both.warnings);
}

/// Segment 2 has three slices, which in the report's deck do not add up to it.
#[test]
fn several_slices_alone_are_a_segment_as_one_and_differ_from_nothing() {
    let changes = [
        ("EMIK(2)=.4,", "EMIK(3)="),
        ("HIIK(1,1,2)=\n 45.0,3*0.0,40.0,3*0.0,85.0,", "HIIK(1,1,3)=\n "),
        ("CNIK(2,2)=10.0,", ""),
    ];
    let differing = |deck: &str| {
        let warnings = read(deck).warnings.into_iter();
        warnings.filter(|warning| warning.found.starts_with("slices")).count()
    };
    let deck = with_changes(&with_slices_alone(), &changes);
    // Mass, mass centre and inertia of segment 2.
    assert_eq!((differing(REPORT_DECK), differing(&deck)), (7, 4));
    let body = read(&deck).scene.bodies[1].mass_properties;
    let centre = (0.001 * 20.0 + 0.2 * 15.0 + 0.2 * 5.0) / 0.401;
    assert!((body.mass - 0.401).abs() < 1e-15, "{body:?}");
    assert!((body.center_of_mass.y - centre).abs() < 1e-14, "{body:?}");
}

#[test]
fn a_segment_with_a_part_of_its_mass_properties_is_refused() {
    let slices = "or none of EMIK, CNIK and HIIK for segment 1, whose slices then say them";
    let mass = " EMIK(1)=.5,\n &END\n &DYNSTA";
    let centre = " CNIK(1,2)=10.0,\n &END\n &DYNSTA";
    let product = " HIIK(1,2,1)=0.0,\n &END\n &DYNSTA";
    for (cards, symbols) in [
        (mass, &["HIIK(1,1,1)"][..]),
        (centre, &["EMIK(1)", "HIIK(1,1,1)"]),
        (product, &["EMIK(1)", "HIIK(1,1,1)"]),
    ] {
        let deck = with_changes(&with_slices_alone(), &[(" &END\n &DYNSTA", cards)]);
        let errors = errors(&deck);
        let found: Vec<&str> = errors.iter().map(|error| &*error.symbol).collect();
        assert_eq!(found, symbols, "{errors:?}");
        for error in errors {
            assert_eq!(error.found, "nothing");
            assert!(error.line > 1 && error.expected.ends_with(slices), "{error}");
        }
    }
}

#[test]
fn slices_that_are_not_read_say_no_mass() {
    let deck = with_slices_alone().replace("INSTR=3", "INSTR=0");
    let errors = errors(&deck);
    let told: Vec<(&str, &str)> = errors.iter().map(|e| (&*e.symbol, &*e.expected)).collect();
    let values = [("EMIK(1)", "a value"), ("HIIK(1,1,1)", "a value (2 more are missing)")];
    assert_eq!(told, values);
}

#[test]
fn slices_without_mass_are_no_body() {
    let deck = with_slices_alone().replace("DELM(1,1)=.5", "DELM(1,1)=0.0");
    let errors = errors(&deck);
    let told: Vec<(&str, &str)> = errors.iter().map(|e| (&*e.symbol, &*e.found)).collect();
    assert_eq!(told, [("DELM(1,1)", "mass 0")]);
}
