//! Exit code 3: computations that fail half way say when, where and why, and leave what was
//! computed before, marked incomplete. Exit code 0 with a warning: circles of releases.

use serde_json::Value;

use super::place::{Place, REPORT_DECK};

/// A boom on a hub, hinge axis x through both mass centres: reduced inertia 40·10/50 = 8.
fn boom(cards: &str, end: f64) -> String {
    format!(
        " &DIM\n NA=1,IXYZ=0,IAB=0,NP=0,NOPLT=1,IXK=1,\n &END\n &NXPUT\n INSTR=0,\n \
         BETAIK=30.0,\n BSIK=9000.0,\n NK=1,DBK=0.5,0.0,0.0,FTSIK=3*0.0,\n ELIK=2.0,\n \
         EMIK=3.0,HIIK=10.0,3*0.0,8.0,3*0.0,8.0,CNIK(1,2)=0.0,\n \
         EMM=100.0,HM=40.0,3*0.0,30.0,3*0.0,35.0,\n FTSM=90.0,0.0,0.0,\n{cards}\n &END\n \
         &ROCK\n TF={end:?},SEGSTT=1.0,\n &END\n"
    )
}

fn summary(place: &Place) -> Value {
    serde_json::from_str(&place.read("out/deck/summary.json")).expect("JSON")
}

/// The first number after these words in a text.
fn number_after(text: &str, words: &str) -> f64 {
    let start = text.find(words).unwrap_or_else(|| panic!("no {words:?} in {text}")) + words.len();
    let rest = &text[start..];
    let end = rest.find([',', ':', ' ']).unwrap_or(rest.len());
    rest[..end].parse().unwrap_or_else(|_| panic!("no number after {words:?} in {text}"))
}

/// Refused with 3 at a time about `when`, rows up to then on disk, marked incomplete.
fn fails_at(place: &Place, told: &str, when: f64, words: &[&str]) {
    let finished = place.nboom(&["run", "deck.nml", "--samples", "1000", "--quiet"]);
    finished.refused(told, 3, words);
    let message = finished.stderr();
    assert!(message.contains("marked incomplete"), "{message}");
    let time = number_after(&message, "at time ");
    assert!((time - when).abs() < 1e-3 * when.max(1.0), "{told}: {message}, expected {when}");
    assert_eq!(summary(place)["complete"], false, "{told}");
    let rows = place.read("out/deck/states.csv");
    let last = rows.lines().last().expect("a header at least");
    let last: f64 = last.split(',').next().and_then(|t| t.parse().ok()).expect("a time");
    // Rows come a thousand to the run; the last ones before the failure are there.
    assert!(last > 0.98 * when, "{told}: the rows end at {last}, the failure is at {when}");
    assert!(rows.ends_with('\n'), "{told}");
}

/// I τ' = q₁ τ² grows beyond all bounds at t = I / (q₁ τ₀).
#[test]
fn a_motion_that_grows_without_bounds() {
    let place = Place::new("unbounded");
    let cards = " QNIK(1,1)=4.0,TAUIK=57.29577951308232,";
    place.write("deck.nml", boom(cards, 3.0));
    // 8 / (4 · 1): the hinge, the time and the cause.
    fails_at(&place, "blow-up", 2.0, &["hinge 1,1", "runs away", "dashpot", "out/deck"]);
}

#[test]
fn a_hinge_without_inertia() {
    let place = Place::new("singular");
    let cards = " TAUIK=0.0,RELTB=0.25,IREL=0,";
    let deck = boom(cards, 1.0).replace("HIIK=10.0,3*0.0,8.0,3*0.0,8.0", "HIIK=9*0.0");
    // Held until 0.25, then free to turn about an axis through a point.
    place.write("deck.nml", deck.replace("SEGSTT=1.0", "SEGSTT=0.0"));
    fails_at(&place, "no inertia", 0.25, &["hinge 1,1", "mass matrix", "singular"]);
}

#[test]
fn forces_beyond_all_numbers() {
    let place = Place::new("overflow");
    // A radian from 30 degrees: energy and torque are still numbers, what they make of a light boom is not.
    let cards = " RELTB=0.5,IREL=0,EKNIK(1,2)=-1.0E308,THETIK=87.3,";
    let light = |deck: String| {
        deck.replace("HIIK=10.0,3*0.0,8.0,3*0.0,8.0", "HIIK=0.05,3*0.0,0.04,3*0.0,0.04")
    };
    place.write("deck.nml", light(boom(cards, 1.0)).replace("SEGSTT=1.0", "SEGSTT=0.0"));
    fails_at(&place, "overflow", 0.5, &["hinge 1,1", "not finite"]);
}

#[test]
fn energies_beyond_all_numbers() {
    let place = Place::new("energy");
    for (told, cards, what) in [
        ("thrown", " VBAR=1.0E200,", "momentum"),
        ("wound up", " EKNIK(1,2)=-1.0E308,THETIK=9000.0,", "potential energy of hinge 1,1"),
    ] {
        place.write("deck.nml", boom(cards, 1.0));
        let finished = place.nboom(&["run", "deck.nml", "--quiet"]);
        finished.refused(told, 3, &["at time 0:", what, "not finite", "marked incomplete"]);
        assert_eq!(summary(&place)["complete"], false);
        // No row holds what is no number.
        assert_eq!(place.read("out/deck/states.csv").lines().count(), 1, "{told}");
    }
}

/// Steps of the original's integrator as long as they like: a tenth of the energy is lost.
#[test]
fn poor_conservation_is_told_even_when_quiet() {
    let place = Place::new("poor");
    let deck = boom(" EKNIK(1,2)=-30.0,BSIK=9000.0,", 4.0);
    let lax = " HZO=0.5,EU1=1.0E3,EL1=1.0E2,HMIN=0.1,HMAX=1.0,\n &END\n";
    let (before, _) = deck.rsplit_once("\n &END\n").expect("the last group ends");
    place.write("deck.nml", format!("{before}\n{lax}"));
    let warned = |told: &str| told.contains("poor conservation: the energy is off by ");
    for (integrator, is_poor) in [("rkam", true), ("auto", false)] {
        let finished = place.nboom(&["run", "deck.nml", "--quiet", "--integrator", integrator]);
        assert_eq!(finished.code(), Some(0), "{}", finished.stderr());
        assert_eq!(warned(&finished.stderr()), is_poor, "{}", finished.stderr());
        let summary = summary(&place);
        let residual = summary["conservation"]["energy"].as_f64().expect("a number");
        // A thousand times beyond the limit of 1e4 rtol, and as much within.
        assert!(if is_poor { residual > 1e-2 } else { residual < 1e-8 }, "{residual}");
        let in_file = summary["warnings"].as_array().expect("a list").iter();
        let in_file = in_file.filter_map(|warning| warning.as_str()).any(warned);
        assert_eq!(in_file, is_poor, "{summary}");
    }
}

#[test]
fn a_boom_that_chatters_without_end() {
    let place = Place::new("chatter");
    // Out to one radian by the kick-off spring, back by the hinge's, and braked on both ways.
    let cards = " RIK1=0.5,1.0,0.0,SIK1=0.0,1.0,0.0,AES=16.0,3*0.0,XIKF=0.958851,\n \
                 EKNIK(1,2)=-8.0,QNIK(1,2)=-8.0,";
    place.write("deck.nml", boom(cards, 50.0));
    let finished = place.nboom(&["run", "deck.nml", "--quiet", "--max-events", "500"]);
    let words = [
        "hinge 1,1",
        "the 500 events that max_events allows are used up",
        "a spring at its limit length may chatter",
        "marked incomplete",
    ];
    finished.refused("chatter", 3, &words);
    assert_eq!(place.read("out/deck/events.csv").lines().count(), 501);
    assert_eq!(summary(&place)["complete"], false);
}

#[test]
fn a_kick_off_spring_without_length() {
    let place = Place::new("no-length");
    // Both ends at the hinge.
    place.write("deck.nml", boom(" RIK1=0.5,0.0,0.0,AES=16.0,3*0.0,XIKF=1.0,", 1.0));
    let words = ["at time 0", "hinge 1,1", "kick-off spring has no length"];
    place.nboom(&["run", "deck.nml", "--quiet"]).refused("no length", 3, &words);
}

/// A limit on the size of files stops writing as a full disk does; rows written before stay.
#[test]
fn a_disk_that_is_full() {
    for (told, file, blocks, more) in [
        ("states", "states.csv", 64, &["--no-stresses"][..]),
        // These are several times as long as the table, so they are the first to stop.
        ("listing", "listing.txt", 3000, &["--no-stresses", "--listing"]),
        ("stresses", "stress.csv", 3000, &[]),
    ] {
        let place = Place::new(&format!("full-{told}"));
        place.write("deck.nml", REPORT_DECK);
        let mut args = vec!["run", "deck.nml", "-o", "run", "--samples", "5000", "--quiet"];
        args.extend(more);
        let finished = place.nboom_with_files_of(blocks, &args);
        finished.refused(
            told,
            3,
            &["at time ", &format!("run.partial/{file}"), "marked incomplete"],
        );
        let rows = place.read("run/states.csv");
        assert!(rows.lines().count() > 20, "{told}: {} rows", rows.lines().count());
        assert!(rows.ends_with('\n'), "{told}");
        let summary: Value = serde_json::from_str(&place.read("run/summary.json")).expect("JSON");
        assert_eq!(summary["complete"], false, "{told}");
        let error = summary["error"].as_str().expect("a text");
        assert!(error.contains(&format!("run.partial/{file}")), "{told}: {error}");
    }
}

#[test]
fn segments_that_release_each_other_in_a_circle() {
    let place = Place::new("circle");
    // Hinge 1,2 waits for 2,1 and that one for 1,2, each at an angle it does not have.
    let circle = REPORT_DECK.replace("IREL=0,1,1,2,", "IREL=0,3,2,2,");
    assert_ne!(circle, REPORT_DECK);
    place.write("deck.nml", circle);
    for verb in ["check", "run"] {
        let finished = place.nboom(&[verb, "deck.nml"]);
        let message = finished.stderr();
        assert_eq!(finished.code(), Some(0), "{verb}: {message}");
        let warned = |line: &str| {
            line.starts_with("warning: ")
                && ["circle", "1,2", "2,1"].iter().all(|word| line.contains(word))
        };
        assert!(message.lines().any(warned), "{verb}: {message}");
    }
    assert_eq!(summary(&place)["complete"], true);
}
