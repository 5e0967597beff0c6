//! One scene in TOML, written in four sets of units, has one motion.

use nboom::io::{ReadOptions, parse_scene};
use nboom::model::UnitSystem;
use nboom::sim::EventKind;

use crate::collect::{run, tight};

/// A deployment with every law, in which L, M and T are how many of its units a metre, a kilogram and a
/// second are.
const SCENE: &str = r#"
[parameters]
L = 1.0
M = 1.0
T = 1.0
I = "$M * $L * $L" # of an inertia of 1 kg m2
F = "$M * $L / $T / $T" # of a force of 1 N
Q = "$F * $L" # of a torque of 1 N m

[run]
end = "12 * $T"

[main_body]
mass = "80 * $M"
mass_centre = ["0.1 * $L", 0.0, "-0.05 * $L"]
inertia = ["20 * $I", "25 * $I", "30 * $I"]

[initial]
rate_deg = ["3 / $T", "-2 / $T", "8 / $T"]

[gravity]
acceleration = "0.3 * $L / $T / $T"
up = [0, 1, 2]

[thrust]
force = ["2 * $F", 0.0, "1 * $F"]
point = [0.0, "0.4 * $L", 0.0]
from = "1.5 * $T"
until = "4 * $T"

[[body]]
name = "inner"
mass = "4 * $M"
mass_centre = ["0.05 * $L", "0.6 * $L", 0.0]
inertia = { xx = "0.5 * $I", yy = "0.1 * $I", zz = "0.55 * $I", xy = "0.02 * $I" }
kick_off = { main_body_end = [0.0, "0.9 * $L", 0.0], end = [0.0, "0.7 * $L", "0.1 * $L"], force = ["5 * $F", "-2 * $F / $L", 0.0, 0.0], limit = "0.8 * $L" }

[body.hinge]
at = [0.0, "0.5 * $L", 0.0]
axis = [1, 0.2, 0]
start_deg = 100.0
release = { at = "0.5 * $T" }
latch_deg = 5.0
spring = { stiffness = "0.4 * $Q", quadratic = "0.05 * $Q", rest_deg = -30.0 }
damper = { damping = "0.5 * $Q * $T", rate_squared = "0.01 * $Q * $T * $T" }

[[body]]
name = "outer"
on = "inner"
mass = "2 * $M"
mass_centre = [0.0, "0.5 * $L", "0.1 * $L"]
inertia = ["0.2 * $I", "0.05 * $I", "0.2 * $I"]

[body.hinge]
at = [0.0, "1.2 * $L", 0.0]
axis = "z"
start_deg = -150.0
release = { after = "inner", by = "0.25 * $T" }
latch_deg = -10.0
damper = { damping = "0.2 * $Q * $T" }
torque_deg = [[-160.0, "1 * $Q"], [-60.0, "0.6 * $Q"], [20.0, "0.5 * $Q"]]
"#;

/// Units, and how many of them a metre, a kilogram and a second are.
fn sets() -> [(&'static str, [f64; 3]); 4] {
    let (inch, foot, pound, g) = (0.0254, 0.3048, 0.453_592_37, 9.806_65);
    // The mass that a pound of force accelerates by one length over the square of a second.
    let mass = |length: f64| pound * g / length;
    [
        ("\"SI\"", [1.0, 1.0, 1.0]),
        ("\"in-lbf-s\"", [1.0 / inch, 1.0 / mass(inch), 1.0]),
        ("\"ft-lbf-s\"", [1.0 / foot, 1.0 / mass(foot), 1.0]),
        // 1 kN is the force that accelerates 1 kg by 1 mm/ms2.
        ("{ length = \"mm\", time = \"ms\", force = \"kN\" }", [1e3, 1.0, 1e3]),
    ]
}

#[test]
fn four_sets_of_units_have_one_motion() {
    let mut first = None;
    for (units, [length, mass, time]) in sets() {
        let set = [("L", length), ("M", mass), ("T", time)];
        let set = set.map(|(name, value)| (name.to_owned(), value)).to_vec();
        let options = ReadOptions { set, ..ReadOptions::default() };
        let text = format!("units = {units}\n{SCENE}");
        let file = parse_scene("units.toml", &text, "units", None, &options)
            .unwrap_or_else(|error| panic!("{error}"));
        assert_ne!(file.settings.units, Some(UnitSystem::None));
        let (found, _) = run(&file.scene, &tight(60));
        let events: Vec<_> =
            found.happenings().iter().map(|(kind, _, at)| (*kind, at / time)).collect();
        let angles: Vec<f64> =
            found.samples.iter().flat_map(|sample| sample.beta.clone()).collect();
        let places: Vec<f64> = found
            .samples
            .iter()
            .flat_map(|sample| (sample.position_inertial * (1.0 / length)).to_array())
            .collect();
        let Some((expected, expected_angles, expected_places)) = &first else {
            // Two releases, two latches, thrust, kick-off spring, torque table, end.
            assert!(events.len() >= 8, "{events:?}");
            first = Some((events, angles, places));
            continue;
        };
        // The tolerance of the steps is 1e-12, and numbers of other units are rounded otherwise.
        let near = |a: &[f64], b: &[f64]| {
            a.len() == b.len()
                && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11 * (1.0 + b.abs()))
        };
        let kinds =
            |events: &[(EventKind, f64)]| events.iter().map(|event| event.0).collect::<Vec<_>>();
        let times =
            |events: &[(EventKind, f64)]| events.iter().map(|event| event.1).collect::<Vec<_>>();
        assert_eq!(kinds(&events), kinds(expected), "{units}");
        assert!(near(&times(&events), &times(expected)), "{units}: {events:?} {expected:?}");
        assert!(near(&angles, expected_angles) && near(&places, expected_places), "{units}");
    }
}
