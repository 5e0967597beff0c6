//! What ends at a stop: in events, in the account, and where a latch fails.

use crate::{Place, code, rows, stderr, stdout};

/// A boom that its spring drives through its latch, if that fails, into a stop.
const BOOM: &str = r#"
[run]
end = 60.0

[main_body]
mass = 100.0
inertia = [40.0, 30.0, 20.0]

[[body]]
name = "boom"
mass = 3.0
mass_centre = [0.0, 1.0, 0.0]
inertia = [1.0, 0.01, 1.0]

[body.hinge]
at = [0.0, 0.5, 0.0]
axis = "x"
start_deg = 90.0
latch_deg = 0.0
stops_deg = [-4.0, inf]
restitution = 0.3
spring = { stiffness = 0.5, rest_deg = -30.0 }
"#;

const STUDY: &str = "scene = 'boom.toml'\ndraws = 1\n\
                     [[fault]]\nname = 'latch fails'\nfailed_latch = ['boom']\n";

/// Kinds and impulses of all events of a run, and what it says.
fn events(place: &Place, case: &str) -> (Vec<(String, String)>, String) {
    let out = format!("out-{case}");
    let output = place.nboom(&["run", "study.toml", "--case", case, "-o", &out]);
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let rows = rows(&place.path(&out).join("events.csv"));
    let cells = rows[1..].iter().map(|row| {
        let cells: Vec<&str> = row.split(',').collect();
        (cells[1].to_owned(), cells[4].to_owned())
    });
    (cells.collect(), stdout(&output))
}

#[test]
fn a_hinge_whose_latch_fails_bounces_and_rests_against_its_stop() {
    let place = Place::new();
    place.write("boom.toml", BOOM);
    place.write("study.toml", STUDY);
    let (latched, account) = events(&place, "1");
    let kinds = |events: &[(String, String)]| -> Vec<String> {
        events.iter().map(|(kind, _)| kind.clone()).collect()
    };
    assert_eq!(kinds(&latched), ["lock_up", "end"]);
    assert!(account.contains("all locked "), "{account}");
    let (failed, account) = events(&place, "2");
    let of_stop = kinds(&failed);
    let [impacts @ .., rest, end] = &of_stop[..] else { panic!("{failed:?}") };
    assert_eq!([rest.as_str(), end.as_str()], ["rest", "end"]);
    // 0.3⁶ is less than a thousandth.
    assert!((4..8).contains(&impacts.len()), "{failed:?}");
    assert!(impacts.iter().all(|kind| kind == "impact"), "{failed:?}");
    for (kind, impulse) in &failed {
        let impulse: Option<f64> = impulse.parse().ok();
        // It drives back to larger angles.
        assert_eq!(impulse.is_some_and(|impulse| impulse > 0.0), kind == "impact", "{failed:?}");
    }
    assert!(account.contains("(boom) against its stop at -4 deg, has no lock"), "{account}");
    assert!(account.contains("\nworst impulse "), "{account}");
}

#[test]
fn a_scene_is_shown_with_its_stops() {
    let place = Place::new();
    place.write("boom.toml", BOOM);
    let output = place.nboom(&["check", "boom.toml"]);
    let told = stdout(&output);
    assert!(told.contains("\n    stops: -4 deg, restitution 0.3\n"), "{told}");
    assert_eq!(stderr(&output), "", "a spring that presses against a stop is fine");
    place.write("boom.toml", &BOOM.replace("0.3\n", "1.3\n"));
    let output = place.nboom(&["check", "boom.toml"]);
    assert_eq!(code(&output), 2);
    let told = stderr(&output);
    assert!(told.contains("boom.toml:21:15: restitution: found restitution 1.3"), "{told}");
}
