//! The rules of NAMELIST and of the table, one by one, on the small deck.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use nboom_io::{Extent, Group, Numbering, SYMBOLS, Symbol};
use nboom_model::{Dashpot, HingeState, Release, Spring};
use nboom_scalar::{Sym3, Vec3};

use super::{errors, lines, read, replaced, warnings, with_cards};

fn preload_degrees(cards: &str) -> Vec<f64> {
    let scene = read(&with_cards(cards)).scene;
    let angles = scene.bodies.iter().map(|body| body.hinge.spring.preload_angle);
    // Small whole numbers of degrees come back exactly after rounding to nine digits.
    angles.map(|angle| (angle.to_degrees() * 1e9).round() / 1e9).collect()
}

#[test]
fn values_in_all_the_ways_of_writing_them() {
    let table: &[(&str, [f64; 4])] = &[
        (" THETIK=1.0,2.0,3.0,4.0,", [1.0, 2.0, 3.0, 4.0]),
        (" thetik = 1. , 2.0\n,3.0 , +4", [1.0, 2.0, 3.0, 4.0]),
        (" THETIK=1.0,2.0,\n 3.0,4.0", [1.0, 2.0, 3.0, 4.0]),
        (" THETIK=1.0,2.0\n 3.0,4.0", [1.0, 2.0, 3.0, 4.0]),
        ("THETIK=.1E1,20.0D-1,3E0,4.d0", [1.0, 2.0, 3.0, 4.0]),
        (" THETIK=4*7.0,", [7.0; 4]),
        (" THETIK=2*7.0,2 * 8.0", [7.0, 7.0, 8.0, 8.0]),
        (" THETIK=1.0,,3.0,", [1.0, 0.0, 3.0, 0.0]),
        (" THETIK=,2.0,", [0.0, 2.0, 0.0, 0.0]),
        (" THETIK=2*,3.0,4.0", [0.0, 0.0, 3.0, 4.0]),
        (" THETIK=4*1.0,,", [1.0; 4]),
        (" THETIK=3.0,99*,", [3.0, 0.0, 0.0, 0.0]),
        (" THETIK(3)=5.0,6.0", [0.0, 0.0, 5.0, 6.0]),
        (" THETIK ( 2 ) = 5.0", [0.0, 5.0, 0.0, 0.0]),
        (" THETIK=1.0 ! the first,\n ! nothing = 5\n ,2.0", [1.0, 2.0, 0.0, 0.0]),
        (" THETIK=9.0,THETIK=1.0", [1.0, 0.0, 0.0, 0.0]),
        (" THETIK=1.0\r\n ,2.0\r\n", [1.0, 2.0, 0.0, 0.0]),
        (" THETIK ! one\n ! = 5\n =1.0,2.0", [1.0, 2.0, 0.0, 0.0]),
        (" THETIK ! one\n (2) ! two\n =2.0", [0.0, 2.0, 0.0, 0.0]),
        (" G=0.0 THETIK=1.0", [1.0, 0.0, 0.0, 0.0]),
        ("\t THETIK\n =\n 1.0", [1.0, 0.0, 0.0, 0.0]),
    ];
    for (cards, expected) in table {
        assert_eq!(preload_degrees(cards), expected, "{cards}");
    }
}

#[test]
fn a_null_keeps_what_was_set_before() {
    assert_eq!(preload_degrees(" THETIK=4*1.0,THETIK=,2.0"), [1.0, 2.0, 1.0, 1.0]);
}

#[test]
fn plus_marks_groups_too() {
    let deck = super::SMALL_DECK.replace('&', "+");
    assert_eq!(read(&deck).warnings, []);
    let deck = super::SMALL_DECK.replace(" &END", " + END").to_lowercase();
    assert_eq!(read(&deck).warnings, []);
}

#[test]
fn segment_first_arrays_take_subscripts_and_fill_their_column() {
    let scene =
        read(&with_cards(" QNIK(3,2)=-1.0,-2.0,QNIK(1,4)=-3.0,EKNIK(1,1)=4*5.0,CNIK(2,3)=.5"))
            .scene;
    let dashpot = |i: usize| scene.bodies[i].hinge.dashpot;
    assert_eq!([dashpot(2).rate_linear, dashpot(3).rate_linear], [-1.0, -2.0]);
    assert_eq!([dashpot(0).rate_linear, dashpot(0).angle_linear], [0.0, -3.0]);
    assert!(scene.bodies.iter().all(|body| body.hinge.spring.quadratic == 5.0));
    assert_eq!(scene.bodies[1].mass_properties.center_of_mass, Vec3::new(0.0, 0.0, 0.5));
}

#[test]
fn arrays_are_stored_first_subscript_fastest() {
    let cards = " RIK1(2,3)=1.0,2.0,3.0,AES(1,3)=1.0,AES(1,4)=1.0,XIKF=4*1.0";
    let scene = read(&with_cards(cards)).scene;
    let point = |i: usize| scene.bodies[i].hinge.kick_off.unwrap().main_body_point;
    assert_eq!(point(2), Vec3::new(0.0, 1.0, 2.0));
    assert_eq!(point(3), Vec3::new(3.0, 0.0, 0.0));
    assert!(scene.bodies[0].hinge.kick_off.is_none());
}

#[test]
fn products_of_inertia() {
    let deck =
        replaced("HM=30.0,3*0.0,40.0,3*0.0,50.0", "HM=30.0,1.0,2.0,1.0,40.0,3.0,2.0,3.0,50.0");
    let expected = Sym3 { xx: 30.0, yy: 40.0, zz: 50.0, xy: 1.0, xz: 2.0, yz: 3.0 };
    assert_eq!(read(&deck).scene.main_body.inertia, expected);
    // One of two opposite products is enough.
    let deck = replaced(
        "HM=30.0,3*0.0,40.0,3*0.0,50.0",
        "HM(1,1)=30.0,HM(2,2)=40.0,HM(3,3)=50.0,HM(1,2)=1.0,HM(3,1)=2.0,HM(2,3)=3.0",
    );
    assert_eq!(read(&deck).scene.main_body.inertia, expected);
    // Rounding in the tenth digit is averaged.
    let deck = replaced("HM=30.0,3*0.0,", "HM=30.0,1.0,2*0.0,");
    assert_eq!(errors(&deck)[0].symbol, "HM(2,1)");
    let deck = replaced("HM=30.0,3*0.0,", "HM=30.0,1.00000004,0.0,1.0,");
    assert!((read(&deck).scene.main_body.inertia.xy - 1.00000002).abs() < 1e-15);
}

#[test]
fn integers_with_a_point_are_integers() {
    let deck = replaced(" TF=1.0,", " TF=1.0,SEGSTT=1.0,2.0,0.0,1,");
    let scene = read(&deck).scene;
    let states: Vec<_> = scene.bodies.iter().map(|body| body.hinge.start.state).collect();
    use HingeState::{Free, Locked, Unreleased};
    assert_eq!(states, [Free, Locked, Unreleased, Free]);
    assert_eq!(errors(&replaced("NK=2,2", "NK=2,1.5"))[0].symbol, "NK(2)");
}

#[test]
fn the_letter_o_and_the_digit_0() {
    assert_eq!(
        warnings(" 0MEG=1O.0,ØMEG=10.0"),
        [
            "a.nml:16:2: OMEG: found `0MEG`, expected OMEG; it is read as that",
            "a.nml:16:7: OMEG(1): found `1O.0`, expected the digit 0 for the letter O; it is \
             read as 10",
            "a.nml:16:12: OMEG: found `ØMEG`, expected OMEG; it is read as that",
        ]
    );
    let file = read(&replaced("&ROCK", "&R0CK"));
    assert_eq!(
        lines(&file.warnings),
        ["a.nml:17:2: &ROCK: found `R0CK`, expected &ROCK; it is read as that"]
    );
}

#[test]
fn relative_and_absolute_angles() {
    let angles = |deck: &str| -> Vec<f64> {
        let scene = read(deck).scene;
        scene.bodies.iter().map(|body| body.hinge.start.angle.to_degrees().round()).collect()
    };
    assert_eq!(angles(super::SMALL_DECK), [10.0, 20.0, 30.0, 40.0]);
    let absolute = replaced("BETAIK=", "ALIK=").replace("IXK=4", "IXK=4,IAB=1");
    // The second body of the chain relative to the first; the paddle's is relative already.
    assert_eq!(angles(&absolute), [10.0, 10.0, 30.0, 40.0]);
}

#[test]
fn springs_and_dashpots_of_hinges() {
    let deck = with_cards(
        " EKNIK(2,1)=1.5,EKNIK(2,2)=-2.5,THETIK(2)=90.0,
 QNIK(3,1)=0.1,QNIK(3,2)=0.2,QNIK(3,3)=0.3,QNIK(3,4)=0.4,GAMAIK(3)=-45.0,",
    );
    let file = read(&deck);
    let hinge = |i: usize| file.scene.bodies[i].hinge;
    let spring = Spring { quadratic: 1.5, linear: -2.5, preload_angle: FRAC_PI_2 };
    let dashpot = Dashpot {
        rate_quadratic: 0.1,
        rate_linear: 0.2,
        angle_quadratic: 0.3,
        angle_linear: 0.4,
        preload_angle: -FRAC_PI_4,
    };
    assert_eq!((hinge(1).spring, hinge(1).dashpot), (spring, Dashpot::default()));
    assert_eq!((hinge(2).spring, hinge(2).dashpot), (Spring::default(), dashpot));
}

#[test]
fn rates_of_free_hinges_only() {
    let deck = replaced("IXK=4", "IXK=4,IAB=2")
        .replace("BETAIK=", "SIGIK=5.0,7.0,1.0,2.0,ALIK=")
        .replace("TF=1.0", "TF=1.0,SEGSTT=1,1,0,2");
    let file = read(&deck);
    let rates: Vec<_> =
        file.scene.bodies.iter().map(|body| body.hinge.start.rate.to_degrees().round()).collect();
    assert_eq!(rates, [5.0, 2.0, 0.0, 0.0]);
    let held = "expected zero of a hinge that starts held; it is taken as zero";
    assert_eq!(
        lines(&file.warnings),
        [
            format!("a.nml:5:16: SIGIK(3): found a relative rate of 1, {held}"),
            format!("a.nml:5:20: SIGIK(4): found a relative rate of 2, {held}"),
        ]
    );
}

#[test]
fn values_of_the_way_that_is_not_taken_are_ignored() {
    assert_eq!(
        warnings(" ALIK=4*1.0,SIGIK=4*0.0,EMO=1.0,"),
        [
            "a.nml:16:2: ALIK: found values, expected none since IAB is 0; they are ignored",
            "a.nml:16:25: EMO: found values, expected none since IXYZ is 0; they are ignored",
        ]
    );
}

#[test]
fn releases() {
    let scene = read(&with_cards(" IREL=0,1,0,3,RELTB=.25,30.0,-2E6,-1.0E30")).scene;
    let releases: Vec<_> = scene.bodies.iter().map(|body| body.hinge.release).collect();
    let by_angle = Release::Angle { hinge: 0, angle: 30.0_f64.to_radians() };
    let before_all = Release::Time(-2e6);
    assert_eq!(releases, [Release::Time(0.25), by_angle, before_all, Release::Never]);
}

#[test]
fn limits_in_the_wrong_order_are_worth_a_warning() {
    let deck = replaced("TF=1.0", "TF=1.0,HMIN=5.0,HMAX=1.0,EL1=2.0,EU1=1.0");
    assert_eq!(
        lines(&read(&deck).warnings),
        [
            "a.nml:18:14: HMIN: found 5, expected at most HMAX, which is 1, for --integrator rkam",
            "a.nml:18:31: EL1: found 2, expected at most EU1, which is 1, for --integrator rkam",
        ]
    );
    assert_eq!(read(&replaced("TF=1.0", "TF=1.0,HMIN=1.0,HMAX=1.0,EL1=2.0")).warnings, []);
}

#[test]
fn a_time_that_means_never_is_worth_a_warning_within_the_run() {
    let run =
        |cards: &str, span: &str| lines(&read(&with_cards(cards).replace("TF=1.0", span)).warnings);
    let told = |at: &str, time: &str, span: &str| {
        format!(
            "a.nml:16:{at}: found time {time} in a run from {span}, expected less than 1e6; from \
             there on it means never, and the hinge is not released"
        )
    };
    assert_eq!(
        run(" RELTB=1.0E6,2.0E6,2.0E6,3.0E6,", "TZO=0.0,TF=2.0E6"),
        [
            told("8: RELTB(1)", "1000000", "0 to 2000000"),
            told("14: RELTB(2)", "2000000", "0 to 2000000"),
            told("20: RELTB(3)", "2000000", "0 to 2000000"),
        ]
    );
    // An early time, an angle, a hinge that is free, and a time that is never reached.
    assert_eq!(run(" RELTB=-1.0E6,", "TZO=-2.0E6,TF=1.0"), [""; 0]);
    assert_eq!(run(" IREL=0,1,RELTB=0.0,1.0E6,", "TF=2.0E6"), [""; 0]);
    assert_eq!(run(" RELTB=1.0E6,", "TF=2.0E6,SEGSTT=1,"), [""; 0]);
    assert_eq!(run(" RELTB=1.0E6,", "TF=9.0E5"), [""; 0]);
}

#[test]
fn superseded_release_times_must_agree() {
    assert_eq!(
        warnings(" TSK=0.5,0.0,RELTB=0.5,"),
        [
            "a.nml:16:6: TSK(1): found 0.5, expected RELTB alone; they agree",
            "a.nml:16:10: TSK(2): found 0, expected RELTB alone; they agree",
        ]
    );
    let found = lines(&errors(&with_cards(" TSK=0.5,0.5,IREL=0,0,1,RELTB=0.25,1.0,0.5")));
    assert_eq!(
        found,
        [
            "a.nml:16:6: TSK(1): found 0.5, expected what RELTB(1) says, the time 0.25",
            "a.nml:16:10: TSK(2): found 0.5, expected what RELTB(3) says, an angle, 0.5",
        ]
    );
}

#[test]
fn lock_angles() {
    let deck = replaced("BSIK=4*1E6", "BSIK=-999999.0,1.0E6,-1.0E30");
    let file = read(&deck);
    let locks: Vec<_> = file.scene.bodies.iter().map(|body| body.hinge.lock_angle).collect();
    assert_eq!(locks, [Some((-999999.0_f64).to_radians()), None, None, None]);
    assert_eq!(
        lines(&file.warnings),
        ["a.nml:6:2: BSIK(4): found nothing, expected a lock angle (1e6 for none); the hinge \
          never locks"]
    );
    let without = read(&replaced(" BSIK=4*1E6,\n", ""));
    assert_eq!(without.warnings.len(), 4);
    assert!(without.scene.bodies.iter().all(|body| body.hinge.lock_angle.is_none()));
}

#[test]
fn a_scene_without_appendages() {
    let deck =
        " &DIM NA=0,IXK=0, &END\n &NXPUT EMM=1.0,HM=3*1.0,1.0,5*1.0, &END\n &ROCK TF=2.0, &END";
    let deck = deck.replace("HM=3*1.0,1.0,5*1.0", "HM(1,1)=1.0,HM(2,2)=1.0,HM(3,3)=1.0");
    let file = read(&deck);
    assert_eq!(file.scene.degrees_of_freedom(), 6);
    // The three &END stand behind values, not in column 2.
    assert_eq!(file.warnings.len(), 3);
}

#[test]
fn a_hundred_segments() {
    let deck = replaced("NA=2,NP=1,IXK=4", "NA=1,IXK=100")
        .replace("BETAIK=10.0,20.0,30.0,40.0", "BETAIK=100*1.0")
        .replace("BSIK=4*1E6", "BSIK=100*1E6")
        .replace("NK=2,2", "NK=100")
        .replace("DBK=1.0,2.0,3.0,4.0,5.0,6.0", "DBK=3*0.0")
        .replace("FTSIK=6*0.0", "FTSIK=3*0.0")
        .replace("ELIK=1.0,2.0,3.0,4.0", "ELIK=100*1.0")
        .replace("EMIK=4*2.0", "EMIK=100*2.0");
    let start = deck.find(" HIIK").unwrap();
    let end = deck.find(" EMM").unwrap();
    let inertias = "1.0,3*0.0,1.0,3*0.0,1.0,\n".repeat(100);
    let deck = format!("{} HIIK={inertias}{}", &deck[..start], &deck[end..]);
    assert_eq!(read(&deck).scene.bodies.len(), 100);
}

#[test]
fn text_between_groups_is_passed_over() {
    let file = read(&format!("N-BOOM TEST CASE\n{}", super::SMALL_DECK));
    assert_eq!(
        lines(&file.warnings),
        ["a.nml:1:1: deck: found `N` outside of a group, expected a group such as &DIM; it is \
          ignored"]
    );
}

#[test]
fn settings_of_the_original() {
    let deck = replaced(" TF=1.0,", " TF=1.0,EU=.1,EL=.2,HZO=0.0,LSTEP=7,IAX=0,HMAX=5.0,");
    let legacy = read(&deck).legacy;
    assert_eq!((legacy.upper_error, legacy.lower_error), (Some(0.1), Some(0.2)));
    assert_eq!((legacy.first_step, legacy.max_step), (None, Some(5.0)));
    assert_eq!((legacy.max_steps, legacy.print_interval), (Some(7), None));
    assert_eq!((legacy.stress_interval, legacy.plots), (0, None));
    assert_eq!(read(&replaced("NA=2,", "NA=2,NOPLT=1,")).legacy.plots, Some(false));
    assert_eq!(read(&replaced("NA=2,", "NA=2,NOPLT=0,")).legacy.plots, Some(true));
}

/// An assignment to the first element, under one of the symbol's names.
fn first_element(symbol: &Symbol, name: &str) -> String {
    let number = match symbol.numbering {
        Numbering::None => "",
        Numbering::Segment => "4",
        Numbering::SegmentAndStation => "45",
    };
    let ones = vec!["1"; symbol.shape.len()].join(",");
    let subscripts = if ones.is_empty() { ones } else { format!("({ones})") };
    format!("\n {name}{number}{subscripts}=,\n &END")
}

#[test]
fn every_symbol_is_known_in_its_group_and_in_no_other() {
    let deck = super::SMALL_DECK.replace(" &ROCK", " &DYNSTA\n &END\n &DYNSTB\n &END\n &ROCK");
    for symbol in SYMBOLS {
        for name in symbol.aliases.iter().chain([&symbol.name]) {
            for group in Group::ALL {
                let start = deck.find(&format!(" {}", group.name())).unwrap();
                let end = start + deck[start..].find("\n &END").unwrap();
                let card = first_element(symbol, name);
                let changed = format!("{}{card}{}", &deck[..end], &deck[end + 6..]);
                let result = nboom_io::parse_deck("a.nml", &changed, "a");
                assert_eq!(
                    result.is_ok(),
                    group == symbol.group,
                    "{name} in {group:?}: {result:?}"
                );
            }
        }
    }
}

#[test]
fn the_table_says_what_is_needed_for_its_docs() {
    for symbol in SYMBOLS {
        assert!(!symbol.meaning.is_empty() && !symbol.unit.is_empty(), "{}", symbol.name);
        let last_is_fixed = matches!(symbol.shape.last(), Some(Extent::Fixed(_)));
        let segment_first = symbol.shape.first() == Some(&Extent::Segments);
        assert_eq!(symbol.needs_subscripts(), segment_first && last_is_fixed, "{}", symbol.name);
    }
    assert!(SYMBOLS.is_sorted_by_key(|symbol| symbol.group));
}
