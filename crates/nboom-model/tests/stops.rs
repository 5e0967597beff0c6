//! What is told of hinges with stops before a run, and what no longer is.

use nboom_model::{
    Appendage, Hinge, HingeLabel, HingeState, MassProperties, ModelError, ModelWarning, Mount,
    Release, Scene, SceneDescription, Segment, Spring, Stops, TorqueTable,
};
use nboom_scalar::{Sym3, Vec3};

const NO_STOP: f64 = f64::INFINITY;

fn description(hinges: &[Hinge]) -> SceneDescription {
    let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
    let mut description = SceneDescription::at_rest("chain", body, 1.0);
    let segment = |&hinge: &Hinge| Segment { length: 1.0, mass_properties: body, hinge };
    let segments = hinges.iter().map(segment).collect();
    description.attach(&Appendage::Regular { mount: Mount::at(Vec3::unit_y()), segments });
    description
}

fn warnings(hinges: &[Hinge]) -> Vec<ModelWarning> {
    Scene::new(description(hinges)).expect("a scene").warnings()
}

fn stops(lower: f64, upper: f64) -> Stops {
    Stops { lower, upper, restitution: 0.0 }
}

fn spring(quadratic: f64, linear: f64, preload_angle: f64) -> Spring {
    Spring { quadratic, linear, preload_angle }
}

#[test]
fn a_release_by_an_angle_beyond_a_stop_is_told() {
    let told = |angle: f64, trigger: Hinge| {
        let mut waits = Hinge { release: Release::Angle { hinge: 0, angle }, ..Hinge::free() };
        waits.start.state = HingeState::Unreleased;
        warnings(&[trigger, waits])
    };
    let between = Hinge { stops: stops(-0.5, 1.0), ..Hinge::free() };
    let [trigger, hinge] = [0, 1].map(|segment| HingeLabel::new(0, segment));
    let never = [ModelWarning::TriggerStopsBefore { hinge, trigger }];
    for angle in [-0.6, 1.1] {
        assert_eq!(told(angle, between), never, "{angle}");
    }
    // Rounding is no way beyond it.
    for angle in [-0.5, 0.5, 1.0, 1.0 + f64::EPSILON] {
        assert_eq!(told(angle, between), [], "{angle}");
    }
    assert_eq!(told(1.1, Hinge { stops: stops(-0.5, NO_STOP), ..Hinge::free() }), []);
    assert_eq!(
        never[0].to_string(),
        "hinge 1,2 waits for an angle of hinge 1,1 that is beyond a stop of it"
    );
    // A latch on the way comes first.
    let latches = Hinge { lock_angle: Some(0.9), ..between };
    assert!(matches!(told(1.1, latches)[..], [ModelWarning::TriggerLocksBefore { .. }]));
}

#[test]
fn a_spring_that_presses_against_a_stop_does_not_drive_on() {
    // Away from 0.5, that is to smaller angles from the start; further is pushed what starts further.
    let over_centre = Hinge { spring: spring(0.0, 2.0, -0.5), ..Hinge::free() };
    let told = |stops| warnings(&[Hinge { stops, ..over_centre }]);
    for open in [Stops::NONE, stops(-NO_STOP, 1.0)] {
        assert!(matches!(told(open)[..], [ModelWarning::SpringWithoutRest { .. }]), "{open:?}");
    }
    assert_eq!(told(stops(-1.0, NO_STOP)), []);
    // Just where it has no torque, it may go either way.
    let between = Hinge { spring: spring(0.0, 2.0, 0.0), ..Hinge::free() };
    let told = |stops| warnings(&[Hinge { stops, ..between }]).len();
    assert_eq!([stops(-1.0, NO_STOP), stops(-NO_STOP, 1.0), stops(-1.0, 1.0)].map(told), [1, 1, 0]);
}

#[test]
fn a_square_and_a_table_that_press_against_a_stop_do_not_drive_on() {
    // A torque (β + 2)² to larger angles.
    let square = Hinge { spring: spring(1.0, 0.0, 2.0), ..Hinge::free() };
    let told = |stops| warnings(&[Hinge { stops, ..square }]);
    for open in [Stops::NONE, stops(-1.0, NO_STOP)] {
        assert!(matches!(told(open)[..], [ModelWarning::SpringDrivesOn { .. }]), "{open:?}");
    }
    assert_eq!(told(stops(-NO_STOP, 1.0)), []);
    let of_table = |stops| {
        let mut scene = description(&[Hinge { stops, ..Hinge::free() }]);
        let points = vec![[-1.0, 0.5], [0.0, 1.0], [1.0, 2.0]];
        scene.torque_tables.push(TorqueTable { hinge: 0, points });
        Scene::new(scene).expect("a scene").warnings()
    };
    for open in [Stops::NONE, stops(-1.0, NO_STOP)] {
        assert!(matches!(of_table(open)[..], [ModelWarning::TableDrivesOn { .. }]), "{open:?}");
    }
    assert_eq!(of_table(stops(-NO_STOP, 1.0)), []);
}

#[test]
fn no_scene_has_stops_out_of_place_or_a_restitution_beyond_one() {
    let wrong = |stops: Stops, lock: Option<f64>| {
        let hinge = Hinge { stops, lock_angle: lock, ..Hinge::free() };
        let errors = Scene::new(description(&[hinge])).expect_err("a defect").0;
        errors.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let told = wrong(stops(0.25, NO_STOP), None);
    assert!(told.len() == 1 && told[0].contains("the start, 0 deg, between them"), "{told:?}");
    let told = wrong(stops(-1.0, 1.0), Some(2.0));
    assert!(told.len() == 1 && told[0].contains("the latch, 114.592 deg, between"), "{told:?}");
    for restitution in [-0.1, 1.1, f64::NAN] {
        let told = wrong(Stops { restitution, ..stops(-1.0, 1.0) }, None);
        assert!(told.len() == 1 && told[0].contains("a share from 0 to 1"), "{told:?}");
        // Also where there are no stops to which it belongs.
        assert_eq!(wrong(Stops { restitution, ..Stops::NONE }, None).len(), 1);
    }
    let label = HingeLabel::new(0, 0);
    let error = ModelError::Restitution { label, restitution: 2.0 };
    assert!(error.to_string().contains("restitution 2"), "{error}");
}
