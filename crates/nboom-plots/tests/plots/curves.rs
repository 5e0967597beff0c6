use roxmltree::Document;

use crate::directory::{directory, svg, table, write};
use crate::reader::{Panel, elements};

/// The value of a curve at a time, between its points; of a jump its first side.
fn at(curve: &[[f64; 2]], time: f64) -> f64 {
    let after = curve.iter().position(|point| point[0] >= time).unwrap_or(curve.len() - 1).max(1);
    let ([t0, y0], [t1, y1]) = (curve[after - 1], curve[after]);
    if t1 > t0 { y0 + (y1 - y0) * (time - t0) / (t1 - t0) } else { y0 }
}

#[test]
fn curves_are_those_of_the_table_to_a_pixel() {
    let times = || (0..=400).map(|i| f64::from(i) * 0.05);
    let row = |t: f64| vec![1.5 * (0.7 * t).sin(), 0.02 * t * t, 1.05 * (0.7 * t).cos(), 0.04 * t];
    let place = directory("wave", &table("beta_1_1,beta_1_2,tau_1_1,tau_1_2", times(), row));
    for (figure, columns) in [("deployment-angles.svg", [0, 1]), ("hinge-rates.svg", [2, 3])] {
        let text = svg(&place, figure);
        let document = Document::parse(&text).expect("well-formed");
        let panel = Panel::new(&document, 0);
        for (hinge, column) in ["1,1", "1,2"].into_iter().zip(columns) {
            let curve = panel.curve(hinge);
            assert!(curve.len() > 10, "{hinge}: {curve:?}");
            for time in times().skip(1) {
                let (drawn, computed) = (at(&curve, time), row(time)[column].to_degrees());
                assert!(
                    (drawn - computed).abs() < panel.value.pixel(),
                    "{hinge} at {time}: {drawn} {computed}"
                );
            }
        }
    }
}

#[test]
fn one_sample_high_of_very_many_is_seen() {
    let row = |t: f64| vec![if t == 54_321.0 { -2.0 } else { 1e-3 * (t / 900.0).sin() }];
    let place = directory("spike", &table("beta_1_1", (0..100_000).map(f64::from), row));
    let text = svg(&place, "deployment-angles.svg");
    let document = Document::parse(&text).expect("well-formed");
    let panel = Panel::new(&document, 0);
    let curve = panel.curve("1,1");
    assert!(curve.len() < 10_001, "{}", curve.len());
    let lowest = curve.iter().min_by(|a, b| a[1].total_cmp(&b[1])).expect("points");
    assert!((lowest[1] + 2.0_f64.to_degrees()).abs() < panel.value.pixel(), "{lowest:?}");
    assert!((lowest[0] - 54_321.0).abs() < panel.time.pixel(), "{lowest:?}");
}

#[test]
fn jumps_have_both_sides_and_events_their_lines_and_names() {
    let states =
        "t,tau_1_1,tau_2_1\n0.0,0.0,0.1\n1.0,1.0,0.1\n2.0,0.0,0.1\n3.0,0.0,0.1\n4.0,0.0,0.1\n";
    let place = directory("latch", &states.replace("tau", "beta"));
    let states = "t,beta_1_1,beta_2_1,tau_1_1,tau_2_1\n0.0,0,0,0.0,0.1\n1.0,0,0,1.0,0.1\n3.0,0,0,0.0,0.1\n4.0,0,0,0.0,0.1\n";
    write(&place, "states.csv", states);
    write(
        &place,
        "instants.csv",
        "t,beta_1_1,beta_2_1,tau_1_1,tau_2_1\n1.5,0,0,1.5,0.1\n1.5,0,0,0.0,0.1\n",
    );
    let events = "t,kind,appendage,segment,impulse,energy_before,energy_after\n\
                  0.5,release,1,1,,1,1\n1.5,lock_up,1,1,2.0,1,1\n1.5,lock_up,2,1,2.0,1,1\n4.0,end,,,,1,1\n";
    write(&place, "events.csv", events);
    let text = svg(&place, "hinge-rates.svg");
    let document = Document::parse(&text).expect("well-formed");
    let panel = Panel::new(&document, 0);
    let curve = panel.curve("1,1");
    let is_near = |point: &&[f64; 2]| (point[0] - 1.5).abs() < panel.time.pixel();
    let sides: Vec<f64> = curve.iter().filter(is_near).map(|point| point[1]).collect();
    assert_eq!(sides.len(), 2, "{curve:?}");
    assert!(
        (sides[0] - 1.5_f64.to_degrees()).abs() < panel.value.pixel() && sides[1].abs() < 0.5,
        "{sides:?}"
    );
    let marks = panel.marks();
    assert_eq!(marks.len(), 2, "a release, two lock-ups at once, no end: {marks:?}");
    for (mark, time) in marks.iter().zip([0.5, 1.5]) {
        assert!((mark - time).abs() < panel.time.pixel(), "{marks:?}");
    }
    let words: Vec<&str> = elements(&document, "text").filter_map(|node| node.text()).collect();
    for name in
        ["release 1,1", "lock-up 1,1 + 2,1", "latch: rates of deployment", "Time [s]", "Rate [°/s]"]
    {
        assert!(words.contains(&name), "{name}: {words:?}");
    }
}

#[test]
fn direction_cosines_are_those_of_the_main_body_in_inertial_axes() {
    // About the inertial z axis by 30 degrees: the x axis of the body leads to y, its y axis back from x.
    let (sin, cos) = 15.0_f64.to_radians().sin_cos();
    let row = |_: f64| vec![cos, 0.0, 0.0, sin];
    let place =
        directory("turned", &table("chi,kappa_x,kappa_y,kappa_z", (0..3).map(f64::from), row));
    let text = svg(&place, "direction-cosines.svg");
    let document = Document::parse(&text).expect("well-formed");
    let expected = [[0.75_f64.sqrt(), 0.5, 0.0], [-0.5, 0.75_f64.sqrt(), 0.0], [0.0, 0.0, 1.0]];
    for (which, cosines) in expected.iter().enumerate() {
        let panel = Panel::new(&document, which);
        for (axis, cosine) in ["x", "y", "z"].iter().zip(cosines) {
            let curve = panel.curve(&format!("inertial {axis}"));
            assert!(
                (curve[0][1] - cosine).abs() < panel.value.pixel(),
                "{which} {axis}: {curve:?}"
            );
        }
    }
}

#[test]
fn residuals_stand_by_decades_and_zeros_leave_gaps() {
    let place = directory("kept", "t,beta_1_1\n0,0\n4,1\n");
    let ledger = "t,kinetic_energy,residual_energy\n0,1,0\n1,1,1e-12\n2,1,1e-9\n3,1,0\n4,1,1e-10\n";
    write(&place, "ledger.csv", ledger);
    let text = svg(&place, "residuals.svg");
    let document = Document::parse(&text).expect("well-formed");
    let panel = Panel::new(&document, 0);
    let curve = panel.curve("energy");
    assert_eq!(curve.len(), 2, "{curve:?}");
    for ([time, decade], expected) in curve.into_iter().zip([[1.0, -12.0], [2.0, -9.0]]) {
        assert!((time - expected[0]).abs() < panel.time.pixel());
        assert!((decade - expected[1]).abs() < panel.value.pixel());
    }
    let alone = panel.dot("energy").expect("a point between gaps is a dot");
    assert!(
        (alone[0] - 4.0).abs() < panel.time.pixel() && (alone[1] + 10.0).abs() < 0.05,
        "{alone:?}"
    );
}

#[test]
fn dots_are_the_rows_of_the_envelopes() {
    let place = directory("loads", "t,beta_1_1\n0,0\n4,1\n");
    let loads = "t,event,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta\n\
                 0,,1,1,3,4,0,1,0,0\n4,,1,1,0,0,2,0,2,0\n";
    write(&place, "hinge_loads.csv", loads);
    let envelope = "quantity,magnitude,appendage,segment,t,event,event_appendage,event_segment\n\
                    force,9.5,1,1,2.5,lock_up,1,1\nmoment,2.25,1,1,3,,,\n";
    write(&place, "hinge_load_envelope.csv", envelope);
    let text = svg(&place, "hinge-loads.svg");
    let document = Document::parse(&text).expect("well-formed");
    for (which, first, largest) in [(0, 5.0, [2.5, 9.5]), (1, 1.0, [3.0, 2.25])] {
        let panel = Panel::new(&document, which);
        assert!((panel.curve("1,1")[0][1] - first).abs() < panel.value.pixel());
        let dot = panel.dot("largest, 1,1").expect("a dot");
        assert!((dot[0] - largest[0]).abs() < panel.time.pixel(), "{dot:?}");
        assert!((dot[1] - largest[1]).abs() < panel.value.pixel(), "{dot:?}");
    }
}

#[test]
fn the_largest_load_has_its_dot_after_the_end_of_the_run() {
    let place = directory("late", "t,beta_1_1\n0,0\n4,0\n");
    let loads = "t,event,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta\n\
                 0.0,,1,1,1.0,0,0,1.0,0,0\n4.0,,1,1,1.0,0,0,1.0,0,0\n";
    write(&place, "hinge_loads.csv", loads);
    // The hinge locks at 3.95, and its pulse is highest at 4.05.
    let envelope = "t,event,appendage,segment,event_appendage,event_segment,quantity,magnitude\n\
                    4.05,lock_up,1,1,1,1,force,9.0\n4.05,lock_up,1,1,1,1,moment,9.0\n";
    write(&place, "hinge_load_envelope.csv", envelope);
    let text = svg(&place, "hinge-loads.svg");
    let document = Document::parse(&text).expect("well-formed");
    for which in [0, 1] {
        let panel = Panel::new(&document, which);
        let dot = panel.dot("largest, 1,1").expect("a dot");
        assert!((dot[0] - 4.05).abs() < panel.time.pixel(), "{dot:?}");
    }
}

#[test]
fn without_a_scene_curves_have_the_names_of_the_verdict() {
    let place = directory("named", "t,beta_1_1\n0,0\n4,1\n");
    let hinge = "{\"appendage\": 1, \"segment\": 1, \"name\": \"panel\"}";
    let summary = format!("{{\"complete\": true, \"verdict\": {{\"hinges\": [{hinge}]}}}}");
    write(&place, "summary.json", &summary);
    let text = svg(&place, "deployment-angles.svg");
    let document = Document::parse(&text).expect("well-formed");
    assert_eq!(Panel::new(&document, 0).curve("panel").len(), 2);
}

#[test]
fn nothing_is_said_of_dots_where_there_are_none() {
    let place = directory("loads", "t,beta_1_1\n0,0\n4,1\n");
    let loads = "t,event,appendage,segment,p_xi,p_eta,p_zeta,q_xi,q_eta,q_zeta\n\
                 0,,1,1,3,4,0,1,0,0\n4,,1,1,0,0,2,0,2,0\n";
    write(&place, "hinge_loads.csv", loads);
    assert!(!svg(&place, "hinge-loads.svg").contains("Dots"));
}

const WHEELS: &str = "name = \"wheels\"\n[run]\nend = 4.0\n[main_body]\nmass = 9.0\ninertia = [1.0, 1.0, 1.0]\n\
    [main_body.drive]\naxis = \"z\"\nspeed = [[0.0, 0.0], [4.0, 2.0]]\n\
    [[main_body.rotor]]\naxis = \"y\"\ninertia = 0.05\nspeed_over_time_rad = [[1.0, 0.0], [1.5, 3.0]]\n\
    [[body]]\nname = \"boom\"\nmass = 1.0\nmass_centre = [0.0, 0.5, 0.0]\ninertia = [0.1, 0.1, 0.1]\n\
    tip = [0.0, 1.0, 0.0]\n[body.hinge]\nat = [0.0, 1.0, 0.0]\naxis = \"x\"\n\
    [[body.rotor]]\naxis = \"y\"\ninertia = 0.05\nspeed_rad = 2.0\n";

#[test]
fn speeds_of_rotors_are_those_that_the_scene_commands() {
    let place = directory("wheels", "t,beta_1_1,v_x,v_y,v_z\n0,0,0,0,0\n4,0,0,0,2\n");
    write(&place, "scene.toml", WHEELS);
    let text = svg(&place, "rotors.svg");
    let document = Document::parse(&text).expect("well-formed");
    let panel = Panel::new(&document, 0);
    let (first, second) = (panel.curve("rotor 1, main body"), panel.curve("rotor 2, boom"));
    // The corners of its table are no output times.
    for (time, speed) in [(1.0, 0.0), (1.25, 1.5), (1.5, 3.0), (3.0, 3.0)] {
        let drawn = at(&first, time) - f64::to_degrees(speed);
        assert!(drawn.abs() < 2.0 * panel.value.pixel(), "{time}: {first:?}");
    }
    assert!((at(&second, 2.0) - 2.0_f64.to_degrees()).abs() < panel.value.pixel(), "{second:?}");
    let text = svg(&place, "test-rig.svg");
    let document = Document::parse(&text).expect("well-formed");
    let panel = Panel::new(&document, 0);
    assert!((at(&panel.curve("z"), 4.0) - 2.0).abs() < panel.value.pixel());
}

#[test]
fn what_output_has_of_rotors_and_rigs_is_drawn() {
    let place = directory("wheels", "t,beta_1_1\n0,0\n4,0\n");
    write(&place, "scene.toml", WHEELS);
    let output = "t,beta_1_1_deg,rotor_speed_1_deg,rotor_speed_2_deg,motor_torque_1,reaction_moment_x\n\
                  0,0,10,20,0.5,-7\n4,0,10,30,0.5,-9\n";
    write(&place, "output.csv", output);
    let text = svg(&place, "rotors.svg");
    let document = Document::parse(&text).expect("well-formed");
    let panel = Panel::new(&document, 0);
    assert!((at(&panel.curve("rotor 2, boom"), 4.0) - 30.0).abs() < panel.value.pixel());
    let torques = Panel::new(&document, 1);
    assert!((at(&torques.curve("rotor 1, main body"), 2.0) - 0.5).abs() < torques.value.pixel());
    assert!(!text.contains("control law"), "they are those of the run");
    assert!(text.contains("peaks between them are not seen"), "{text}");
    let text = svg(&place, "test-rig.svg");
    let document = Document::parse(&text).expect("well-formed");
    let panel = Panel::new(&document, 0);
    assert!((at(&panel.curve("x"), 4.0) + 9.0).abs() < panel.value.pixel());
}

/// A wheel as it stands on a hinge: no mass, inertia about its axis alone.
const ON_A_HINGE: &str = "[[body]]\nname = \"spinner\"\nmass = 0.0\nmass_centre = [0.0, 0.0, 0.0]\n\
    inertia = [0.0, 0.0, 0.1]\ntip = [0.1, 0.0, 0.0]\n[body.hinge]\nat = [0.0, 0.0, 0.0]\naxis = \"z\"\n";

#[test]
fn a_wheel_on_a_hinge_has_a_panel_of_its_own() {
    let place = directory("wheel", "t,beta_1_1,beta_2_1\n0,0,0\n4,0.5,1000\n");
    write(&place, "scene.toml", &format!("{WHEELS}{ON_A_HINGE}"));
    let text = svg(&place, "deployment-angles.svg");
    let document = Document::parse(&text).expect("well-formed");
    let (boom, wheel) = (Panel::new(&document, 0), Panel::new(&document, 1));
    assert!((at(&boom.curve("boom"), 4.0) - 0.5_f64.to_degrees()).abs() < boom.value.pixel());
    assert!(boom.value.pixel() < 1.0, "{}", boom.value.pixel());
    assert!((at(&wheel.curve("spinner"), 4.0) - 1000_f64.to_degrees()).abs() < wheel.value.pixel());
}
