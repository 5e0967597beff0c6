//! Exit code 2: files that are no scenes. Each is refused by `check` and by `run` alike, and
//! nothing is written.

use std::fs;
use std::os::unix::fs::symlink;

use super::place::{Place, REPORT_DECK};

fn refuse(place: &Place, told: &str, words: &[&str]) {
    for verb in ["check", "run"] {
        place.nboom(&[verb, "deck.nml"]).refused(&format!("{verb}: {told}"), 2, words);
    }
    assert!(!place.path("out").exists(), "{told}");
}

/// A group of the report's deck, from its name to its end.
fn group(name: &str) -> &'static str {
    let start = REPORT_DECK.find(&format!(" &{name}\n")).expect("the deck has the group");
    let end = REPORT_DECK[start..].find(" &END\n").expect("groups end") + 6;
    &REPORT_DECK[start..start + end]
}

#[test]
fn the_report_deck_itself_is_accepted() {
    let place = Place::new("accepted");
    place.write("deck.nml", REPORT_DECK);
    let finished = place.nboom(&["check", "deck.nml"]);
    assert_eq!(finished.code(), Some(0), "{}", finished.stderr());
}

#[test]
fn groups_missing_or_doubled() {
    let place = Place::new("groups");
    for name in ["DIM", "NXPUT", "ROCK"] {
        let mark = format!("&{name}");
        place.write("deck.nml", REPORT_DECK.replace(group(name), ""));
        refuse(&place, &format!("no {name}"), &[&mark]);
        place.write("deck.nml", REPORT_DECK.replace(group(name), &group(name).repeat(2)));
        refuse(&place, &format!("two {name}"), &[&mark, "each group once"]);
    }
}

/// A piece of the report's deck replaced, and what the message must name.
#[test]
fn one_wrong_piece() {
    let place = Place::new("pieces");
    let table: &[(&str, &str, &[&str])] = &[
        ("EMM=25.0", "EMMM=25.0", &["EMMM", "such as EMM"]),
        ("EMM=25.0", "BAFFLE=1.0,EMM=25.0", &["BAFFLE", "expected a symbol"]),
        ("EMM=25.0", "EMM=25.0,26.0", &["EMM", "at most 1"]),
        ("EMIK=.5,.4,.5,.5", "EMIK=5*.5", &["EMIK", "more than 4"]),
        ("EMIK=.5,.4,.5,.5", "EMIK=99999999999*0.0", &["EMIK", "more than 4"]),
        ("X=1.0", "X=99999999999*0.0", &["X", "more than 1"]),
        ("QNIK(4,2)", "QNIK(5,2)", &["QNIK", "from 1 to 4"]),
        ("QNIK(4,2)", "QNIK(4,99999999999999999999)", &["QNIK"]),
        ("QNIK(4,2)", "QNIK(0,2)", &["QNIK", "from 1 to 4"]),
        ("RHO=3*0.0", "RHO=0.0,NAN,0.0", &["RHO(2)", "finite"]),
        ("RHO=3*0.0", "RHO=0.0,-INF,0.0", &["RHO(2)", "finite"]),
        ("RHO=3*0.0", "RHO=0.0,1.0E400,0.0", &["RHO(2)", "1.8e308"]),
        ("EMM=25.0", "EMM=0.0", &["EMM", "positive"]),
        ("EMM=25.0", "EMM=-25.0", &["EMM", "positive"]),
        ("EMIK=.5,.4", "EMIK=.5,-.4", &["EMIK(2)", "positive"]),
        ("HM=4000.0", "HM=4000.1", &["HM", "moments of inertia"]),
        ("HM=4000.0", "HM=-4000.0", &["HM", "moment"]),
        ("HIIK=10.0", "HIIK=16.0", &["HIIK(1,1,1)", "moments of inertia"]),
        ("IXK=4", "IXK=5", &["deck.nml:7:", "IXK", "the sum of NK"]),
        ("IXK=4", "IXK=99999999999", &["IXK"]),
        ("NK=2,2", "NK=2,3", &["NK(2)", "paddle"]),
        ("NK=2,2", "NK=1,2", &["IXK", "the sum of NK"]),
        ("NA=2", "NA=3", &["NK"]),
        ("TF=1.0", "TF=-1.0", &["TF", "end time"]),
    ];
    for (old, new, words) in table {
        assert!(REPORT_DECK.contains(old), "{old}");
        place.write("deck.nml", REPORT_DECK.replacen(old, new, 1));
        let told = format!("{old} -> {new}");
        refuse(&place, &told, words);
        // Each error says where it is, with line and column.
        let message = place.nboom(&["check", "deck.nml"]).stderr();
        for line in message.lines().filter(|line| line.starts_with("error: ")) {
            let place = line.strip_prefix("error: deck.nml:").and_then(|rest| {
                let mut numbers = rest.split(':');
                Some((
                    numbers.next()?.parse::<usize>().ok()?,
                    numbers.next()?.parse::<usize>().ok()?,
                ))
            });
            assert!(place.is_some_and(|(l, c)| l > 0 && c > 0), "{told}: {line}");
        }
    }
}

/// Whatever is wrong, in the motion or in a section, all commands say the same about it.
#[test]
fn one_gate_for_all_commands() {
    let place = Place::new("gate");
    let crossed = ("XI2=2.15,.67,-1.74", "XI2=2.15,-1.74,.67");
    type Changes<'a> = &'a [(&'a str, &'a str)];
    let tables: [(Changes<'_>, &[&str]); 3] = [
        (&[("EMM=25.0", "EMM=-25.0")], &["EMM"]),
        (&[("R(2,3)=2.0", "R(2,3)=.01")], &["deck.nml:54:", "T3(1,2)", "at most the radius 0.01"]),
        (
            &[crossed, ("EMM=25.0", "EMM=-25.0"), ("NSTA=1,3,2,1", "NSTA=1,3,9,1")],
            &["deck.nml:56:17: XI2(3,1): found walls 1 and 3", "EMM", "NSTA(3)"],
        ),
    ];
    for (changes, words) in tables {
        let change = |deck: String, (old, new): &(&str, &str)| deck.replacen(old, new, 1);
        let deck = changes.iter().fold(REPORT_DECK.to_owned(), change);
        place.write("deck.nml", deck);
        let told = format!("{changes:?}");
        let run = place.nboom(&["run", "deck.nml"]);
        run.refused(&told, 2, words);
        for command in [
            &["check", "deck.nml"][..],
            &["verify", "deck.nml"],
            &["bench", "deck.nml"],
            &["generate", "deck.nml", "-o", "out"],
            &["compile", "deck.nml", "-o", "out/simulator"],
        ] {
            let finished = place.nboom(command);
            assert_eq!(finished.code(), Some(2), "{command:?}: {told}");
            assert_eq!(finished.stderr(), run.stderr(), "{command:?}: {told}");
        }
        assert!(!place.path("out").exists(), "{told}");
    }
}

#[test]
fn no_text_at_all() {
    let place = Place::new("no-text");
    place.write("deck.nml", "");
    refuse(&place, "empty", &["deck.nml", "&DIM"]);
    place.write("deck.nml", "\n\n   \n");
    refuse(&place, "blank", &["deck.nml", "&DIM"]);
    place.write("deck.nml", (0..=255_u8).cycle().take(100_000).collect::<Vec<_>>());
    refuse(&place, "binary", &["deck.nml", "zero byte", "expected text"]);
    // Without a zero byte it passes for text; control characters stay out of the message.
    place.write("deck.nml", (1..=255_u8).cycle().take(100_000).collect::<Vec<_>>());
    refuse(&place, "binary without zeros", &["deck.nml:"]);
    place.write("deck.nml", "\u{1b}[2J\u{7}EMM=1.0\n");
    refuse(&place, "terminal codes", &["deck.nml:"]);
}

#[test]
fn a_hundred_megabytes() {
    let place = Place::new("garbage");
    let garbage = |pattern: &str| pattern.repeat((100 << 20) / pattern.len());
    for (told, content) in [
        ("of words", garbage("lorem ipsum 12.5, = ( * &\n")),
        ("in one line", garbage("EMM=25.0,")),
        ("after a good deck", format!("{REPORT_DECK}{}", garbage("! note\n"))),
    ] {
        place.write("deck.nml", content);
        refuse(&place, &format!("100 MB {told}"), &["deck.nml", "bytes"]);
    }
    // As much as is read at all: worse than what is refused by its length alone.
    let half = |pattern: &str| pattern.repeat((16 << 20) / pattern.len());
    for pattern in ["EMM=25.0,", "A ", "1,", "&DIM\n", "((((", "\u{fffd}", " EMM=1.0,\n", "9"] {
        place.write("deck.nml", half(pattern));
        refuse(&place, &format!("16 MB of {pattern:?}"), &["deck.nml:"]);
        // The same number again and again is no error; what counts here is that it ends.
        let filled = REPORT_DECK.replace("EMM=25.0,", &pattern.repeat((15 << 20) / pattern.len()));
        place.write("deck.nml", filled);
        let finished = place.nboom(&["check", "deck.nml"]);
        let code = finished.code();
        let accepted = pattern.contains("EMM=");
        assert_eq!(code, Some(if accepted { 0 } else { 2 }), "{pattern:?}: {}", finished.stderr());
    }
}

#[test]
fn what_is_no_file() {
    let place = Place::new("no-file");
    let words = ["deck.nml", "a directory or a device", "expected a file"];
    fs::create_dir(place.path("deck.nml")).expect("writable");
    refuse(&place, "a directory", &words);
    fs::remove_dir(place.path("deck.nml")).expect("it is empty");
    for device in ["/dev/zero", "/dev/null", "/dev/stdin"] {
        symlink(device, place.path("deck.nml")).expect("a unix system");
        refuse(&place, device, &words);
        fs::remove_file(place.path("deck.nml")).expect("it is there");
    }
    symlink("deck.nml", place.path("deck.nml")).expect("a unix system");
    refuse(&place, "a link to itself", &["deck.nml", "cannot be read"]);
    fs::remove_file(place.path("deck.nml")).expect("it is there");
    refuse(&place, "nothing", &["deck.nml", "cannot be read"]);
    place.nboom(&["check", "deck.txt"]).refused("missing", 2, &["deck.txt"]);
}

/// A file that exists and whose reading fails, for the superuser too: a process's own memory.
#[cfg(target_os = "linux")]
#[test]
fn an_unreadable_file() {
    let place = Place::new("unreadable");
    symlink("/proc/self/mem", place.path("deck.nml")).expect("a unix system");
    refuse(&place, "unreadable", &["deck.nml", "cannot be read"]);
}

#[test]
fn limits_of_steps_in_the_wrong_order() {
    let place = Place::new("limits");
    place.write("deck.nml", REPORT_DECK.replace("HMIN=.001,HMAX=0.1E6", "HMIN=5.0,HMAX=1.0"));
    let finished = place.nboom(&["run", "deck.nml", "--integrator", "rkam", "--quiet"]);
    finished.refused(
        "HMIN above HMAX",
        2,
        &["shortest step (HMIN) 5", "at most the longest (HMAX)"],
    );
    assert!(!place.path("out").exists());
}

/// A million million steps are known to be too many before the first.
#[test]
fn a_longest_step_that_leads_nowhere() {
    let place = Place::new("longest");
    place.write("deck.nml", REPORT_DECK);
    let finished = place.nboom(&["run", "deck.nml", "--max-step", "1e-12", "--quiet"]);
    finished.refused("longest step", 2, &["longest step 1e-12", "steps that are allowed"]);
    assert!(!place.path("out").exists());
}
