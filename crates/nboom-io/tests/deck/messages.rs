//! What is said of wrong decks, and where: line, column and symbol.

use nboom_io::parse_deck;

use super::{REPORT_DECK, SMALL_DECK, errors, lines, read, replaced, with_cards};

/// Cards at line 16 of the small deck, and the one error they cause.
#[test]
fn one_wrong_card() {
    let table = [
        (" FOO=1.0,", "16:2: &NXPUT: found `FOO`, expected a symbol of the deck"),
        (" EMLK=4*1.0,", "16:2: &NXPUT: found `EMLK`, expected a symbol of the deck, such as EMIK"),
        (" TF=1.0,", "16:2: TF: found it in &NXPUT, expected it in &ROCK"),
        (" THETIK=1.0,2.0,1.2.3,", "16:17: THETIK(3): found `1.2.3`, expected a finite number"),
        (" THETIK=NAN,", "16:9: THETIK(1): found `NAN`, expected a finite number"),
        (" THETIK=-INF,", "16:9: THETIK(1): found `-INF`, expected a finite number"),
        (" THETIK=1.0E999,", "16:9: THETIK(1): found `1.0E999`, expected a number below 1.8e308"),
        (" THETIK(5)=1.0,", "16:9: THETIK: found 5, expected a subscript from 1 to 4"),
        (" THETIK(0)=1.0,", "16:9: THETIK: found 0, expected a subscript from 1 to 4"),
        (" THETIK(-1)=1.0,", "16:9: THETIK: found `-1`, expected a subscript"),
        (" THETIK(1,2)=1.0,", "16:8: THETIK: found 2 subscripts, expected 1"),
        (" THETIK(1=1.0,", "16:10: THETIK: found `=`, expected `)`"),
        (" THETIK(1),1.0,", "16:11: THETIK: found `,`, expected `=`"),
        (" THETIK=5*1.0,", "16:9: THETIK: found more than 4 values, expected at most 4"),
        (" THETIK=4*1.0,,2.0", "16:16: THETIK: found more than 4 values, expected at most 4"),
        (" THETIK(4)=1.0,2.0", "16:16: THETIK: found more than 1 values, expected at most 1"),
        (
            " THETIK=99999999999999999999*0.0,",
            "16:9: THETIK: found more than 4 values, expected at most 4",
        ),
        (" THETIK=0*1.0,", "16:9: THETIK: found `0`, expected a positive integer before `*`"),
        (" THETIK=1.0-2.0,", "16:12: THETIK: found `-2.0`, expected a comma before it"),
        (" THETIK==1.0,", "16:9: THETIK: found `=`, expected a number, a comma or the next symbol"),
        (" THETIK=G=0.0,", "16:2: THETIK: found no value, expected a number"),
        // A card after HM's last comma continues HM.
        (" THETIK#1.0,", "16:2: HM: found `THETIK`, expected a finite number"),
        (
            " QNIK=4*0.0,",
            "16:2: QNIK: found an assignment to the whole array, expected subscripts, as in \
             QNIK(1,1)=",
        ),
        (
            " QNIK(3,1)=1.0,2.0,3.0,",
            "16:20: QNIK: found more than 2 values, expected at most 2; the next column needs its \
             own subscripts",
        ),
        (" QNIK(1,5)=1.0,", "16:9: QNIK: found 5, expected a subscript from 1 to 4"),
        (" IREL=0,0.5,", "16:9: IREL(2): found `0.5`, expected an integer"),
        (
            " IREL=0,2,",
            "16:9: IREL(2): found 2, expected 0 or the number of another segment, at most 4",
        ),
        (
            " IREL(3)=5,",
            "16:10: IREL(3): found 5, expected 0 or the number of another segment, at most 4",
        ),
        (
            " IREL(3)=-1,",
            "16:10: IREL(3): found -1, expected 0 or the number of another segment, at most 4",
        ),
        (
            " AES(1,2)=1.0,",
            "16:11: XIKF(2): found nothing, expected a value, since AES is not all zero",
        ),
        (
            " AES=1.0,XIKF=-1.0",
            "16:15: XIKF(1): found segment 1,1: kick-off spring up to length -1, expected a length not below zero",
        ),
        (
            " X=1.0\u{fffd}",
            "16:7: X: found `\u{fffd}`, expected a number, a comma or the next symbol",
        ),
        (" INSTR=-1,", "16:8: INSTR: found -1, expected none below zero"),
    ];
    for (cards, expected) in table {
        assert_eq!(lines(&errors(&with_cards(cards))), [format!("a.nml:{expected}")], "{cards}");
    }
}

/// A piece of the small deck replaced, and the one error that causes.
#[test]
fn one_wrong_piece() {
    let table = [
        ("EMM=100.0,", "", "4:2: EMM: found nothing, expected a value"),
        ("EMM=100.0", "EMM=0.0", "14:6: EMM: found mass 0, expected a positive finite mass"),
        ("EMIK=4*2.0", "EMIK=3*2.0", "11:2: EMIK(4): found nothing, expected a value"),
        (
            "EMIK=4*2.0",
            "EMIK=2*2.0",
            "11:2: EMIK(3): found nothing, expected a value (1 more are missing)",
        ),
        (
            "EMIK=4*2.0",
            "EMIK=2*2.0,-1.0,2.0",
            "11:13: EMIK(3): found mass -1, expected a positive finite mass",
        ),
        (
            "HIIK=3.0",
            "HIIK=30.0",
            "12:7: HIIK(1,1,1): found principal moments of inertia 4, 5, 30, expected the largest \
             at most the sum of the two others",
        ),
        (
            "\n 3.0,3*0.0,4.0",
            "\n 3.0,1.0,2*0.0,4.0",
            "13:6: HIIK(2,1,3): found 1 beside HIIK(1,2,3) of 0, expected a symmetric matrix",
        ),
        ("BETAIK=10.0,20.0,30.0,40.0,", "", "4:2: BETAIK: found nothing, expected 4 values"),
        ("NK=2,2", "NK=3,1", "7:7: NK(2): found 1, expected 2 for a paddle"),
        ("NK=2,2", "NK=1,2", "2:16: IXK: found 4, expected 3, the sum of NK"),
        ("NK=2,2", "NK=0,2", "7:5: NK(1): found 0, expected at least 1 and at most IXK = 4"),
        ("NP=1", "NP=3", "2:10: NP: found 3, expected at least 0 and at most NA = 2"),
        ("IXK=4", "IXK=1001", "2:16: IXK: found 1001, expected a number from 0 to 1000"),
        ("IXK=4", "IXK=-1", "2:16: IXK: found -1, expected a number from 0 to 1000"),
        ("IXK=4", "", "1:2: IXK: found nothing, expected a value"),
        ("NA=2,", "NA=2,IXYZ=2,", "2:12: IXYZ: found 2, expected 0 or 1"),
        ("ELIK=1.0", "ELIK=-1.0", "10:7: ELIK(1): found -1, expected none below zero"),
        (
            "TF=1.0",
            "TF=-1.0",
            "18:5: TF: found end time -1, expected a time not before the initial time 0",
        ),
        ("TF=1.0,", "", "17:2: TF: found nothing, expected a value"),
        (
            "TF=1.0",
            "TF=1.0,SEGSTT=3",
            "18:16: SEGSTT(1): found 3, expected 0 (unreleased), 1 (released) or 2 (locked)",
        ),
    ];
    for (old, new, expected) in table {
        let found = lines(&errors(&replaced(old, new)));
        assert_eq!(found, [format!("a.nml:{expected}")], "{old} -> {new}");
    }
}

/// What is lost with a group mark is missed too; this is the first thing said.
#[test]
fn one_wrong_group_mark() {
    let table = [
        (
            "&NXPUT\n",
            "&NXPUTS\n",
            "4:2: deck: found `&NXPUTS`, expected one of the groups &DIM, &NXPUT, &DYNSTA, &DYNSTB, &ROCK",
        ),
        (" &END\n &NXPUT", " &NXPUT", "3:2: &DIM: found `&NXPUT`, expected &END before it"),
        (
            "TF=1.0,\n &END\n",
            "TF=1.0,\n",
            "19:1: &ROCK: found the end of the file, expected &END before it",
        ),
        (
            " &ROCK\n",
            " /\n",
            "18:2: deck: found `TF` outside of a group, expected a group such as &DIM",
        ),
        (
            "\n &NXPUT\n",
            "\n &NXPUT\n 17 CARDS\n",
            "5:2: &NXPUT: found `17`, expected a symbol followed by =, or &END",
        ),
    ];
    for (old, new, expected) in table {
        let found = lines(&errors(&replaced(old, new)));
        assert_eq!(found[0], format!("a.nml:{expected}"), "{old} -> {new}");
    }
}

#[test]
fn groups_in_order_and_once() {
    let group = |name: &str| {
        let start = SMALL_DECK.find(&format!(" &{name}")).unwrap();
        let end = start + SMALL_DECK[start..].find(" &END\n").unwrap() + 6;
        SMALL_DECK[start..end].to_owned()
    };
    let (dim, nxput, rock) = (group("DIM"), group("NXPUT"), group("ROCK"));
    let first = |deck: String| lines(&errors(&deck))[0].clone();
    let order = "expected the order &DIM, &NXPUT, &DYNSTA, &DYNSTB, &ROCK";
    assert_eq!(
        first(format!("{dim}{rock}{nxput}")),
        format!("a.nml:7:2: &NXPUT: found &NXPUT after &ROCK, {order}")
    );
    assert_eq!(
        first(format!("{nxput}{dim}{rock}")),
        format!("a.nml:14:2: &DIM: found &DIM after &NXPUT, {order}")
    );
    assert_eq!(
        first(format!("{dim}{nxput}{rock}{rock}")),
        "a.nml:20:2: &ROCK: found &ROCK once more, expected each group once"
    );
    assert_eq!(
        lines(&errors(&format!("{dim}{nxput}"))),
        ["a.nml:17:1: &ROCK: found the end of the deck, expected the group &ROCK"]
    );
    assert_eq!(errors("").len(), 3);
}

#[test]
fn a_group_mark_in_another_column_is_accepted() {
    let file = read(&replaced(" &ROCK", "&ROCK"));
    assert_eq!(
        lines(&file.warnings),
        ["a.nml:17:1: &ROCK: found a group mark in column 1, expected column 2; it is accepted"]
    );
}

#[test]
fn blanks_for_commas_are_accepted_with_a_warning() {
    assert_eq!(
        super::warnings(" BBM=1.0 2.0,"),
        ["a.nml:16:10: BBM: found a blank before `2.0`, expected a comma; it is read as one"]
    );
}

/// Errors of spelling, of counting, of the table and of the model all at once, in order.
#[test]
fn all_errors_together() {
    let deck = with_cards(" FOO=1.0,\n IREL=9,")
        .replace("EMM=100.0", "EMM=-1.0")
        .replace("ELIK=1.0,2.0", "ELIK=1.0,x")
        .replace("TF=1.0", "TF=1.0,HMIN=-2.0")
        .replace("EMIK=4*2.0", "EMIK=2.0,0.0,2.0,2.0");
    let found: Vec<_> = errors(&deck).into_iter().map(|e| (e.line, e.symbol)).collect();
    let expected = [
        (10, "ELIK(2)"),
        (11, "EMIK(2)"),
        (14, "EMM"),
        (16, "&NXPUT"),
        (17, "IREL(1)"),
        (20, "HMIN"),
    ];
    assert_eq!(found, expected.map(|(line, symbol)| (line, symbol.to_owned())));
}

#[test]
fn the_message_tells_up_to_fifty_errors_with_their_cards() {
    let wrong: String = (0..60).map(|i| format!(" BAD{i}=1.0,\n")).collect();
    let error = parse_deck("a.nml", &with_cards(&wrong), "a").unwrap_err().to_string();
    assert_eq!(error.lines().filter(|line| line.starts_with("a.nml:")).count(), 50);
    // The first ten with their cards.
    assert_eq!(error.lines().filter(|line| line.contains(" |  BAD")).count(), 10);
    assert!(error.ends_with("\nand 10 more"));
}

#[test]
fn lines_of_the_report_deck_count_from_its_comment() {
    let deck = REPORT_DECK.replace("EMM=25.0", "EMM=-25.0");
    assert_eq!(
        lines(&errors(&deck)),
        ["a.nml:33:6: EMM: found mass -25, expected a positive finite mass"]
    );
}

#[test]
fn cards_may_end_in_a_carriage_return() {
    let deck = format!("! A comment & more\n{}", with_cards(" FOO=1.0, ! = 3\n BBM=x,"));
    for end in ["\r", "\r\n"] {
        assert_eq!(errors(&deck.replace('\n', end)), errors(&deck));
    }
}
