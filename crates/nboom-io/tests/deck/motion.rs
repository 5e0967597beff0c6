//! Orientation, velocity, gravity and thrust.

use nboom_model::External;
use nboom_scalar::{Mat3, Vec3};

use super::{errors, lines, read, replaced, with_cards};

/// Two roundings of numbers of size one.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

fn near(found: Vec3<f64>, x: f64, y: f64, z: f64) {
    assert!((found - Vec3::new(x, y, z)).norm() <= ROUNDING, "{found:?}");
}

/// M(0) = R_x(psi) R_y(theta) R_x(phi), eq. (9.7): columns are the body axes.
#[test]
fn euler_angles() {
    let axes = read(&with_cards(" FTSM=90.0,90.0,0.0,")).scene.initial.attitude.to_matrix();
    near(axes.column(0), 0.0, 1.0, 0.0);
    near(axes.column(1), 0.0, 0.0, 1.0);
    near(axes.column(2), 1.0, 0.0, 0.0);
    let axes = read(&with_cards(" FTSM=30.0,0.0,15.0,")).scene.initial.attitude.to_matrix();
    let half = 0.5_f64.sqrt();
    near(axes.column(1), 0.0, half, half);
}

/// EMO lists the columns of M(0) one after the other.
#[test]
fn given_axes() {
    let deck =
        with_cards(" EMO=0.0,1.0,0.0,0.0,0.0,1.0,1.0,0.0,0.0,").replace("IXK=4", "IXK=4,IXYZ=1");
    let axes = read(&deck).scene.initial.attitude.to_matrix();
    near(axes.column(0), 0.0, 1.0, 0.0);
    near(axes.column(1), 0.0, 0.0, 1.0);
    let mirrored = deck.replace("EMO=0.0,1.0", "EMO=0.0,-1.0");
    assert_eq!(
        lines(&errors(&mirrored)),
        ["a.nml:16:6: EMO: found axes that depart from a rotation by 2, expected three \
          right-handed orthogonal unit vectors"]
    );
    let missing = replaced("IXK=4", "IXK=4,IXYZ=1");
    assert_eq!(lines(&errors(&missing)), ["a.nml:4:2: EMO: found nothing, expected 9 values"]);
}

/// Position M RHO and velocity M (VBAR + omega x RHO).
#[test]
fn position_and_velocity() {
    let cards = " FTSM=0.0,90.0,0.0,RHO=1.0,0.0,0.0,VBAR=0.0,0.0,2.0,OMEG=0.0,0.0,180.0,";
    let initial = read(&with_cards(cards)).scene.initial;
    let pi = std::f64::consts::PI;
    // R_y(90): body x is inertial -z, body z is inertial x. Body velocity (0, pi, 2).
    near(initial.position_inertial, 0.0, 0.0, -1.0);
    near(initial.velocity_inertial * 0.25, 0.5, pi / 4.0, 0.0);
    assert_eq!(initial.omega_body, Vec3::new(0.0, 0.0, pi));
}

#[test]
fn euler_parameters_turn_the_initial_axes() {
    let file = read(&with_cards(" FTSM=90.0,0.0,0.0,X=0.6,EKBAR=0.0,0.8,0.0,"));
    assert_eq!(
        lines(&file.warnings),
        ["a.nml:16:22: X: found other Euler parameters, expected X=1.0 and EKBAR=3*0.0; the \
          initial orientation is turned by them"]
    );
    let turn = Mat3::about_y(2.0 * 0.8_f64.atan2(0.6));
    let expected = Mat3::about_x(std::f64::consts::FRAC_PI_2) * turn;
    let found = file.scene.initial.attitude.to_matrix();
    assert!((found - expected).rows.iter().all(|row| row.norm() <= ROUNDING));
    // The same rotation by the opposite parameters; the scene's scalar part stays positive.
    let opposite = read(&with_cards(" FTSM=90.0,0.0,0.0,X=-0.6,EKBAR=0.0,-0.8,0.0,"));
    assert_eq!(opposite.scene.initial.attitude, file.scene.initial.attitude);
    assert_eq!(
        lines(&errors(&with_cards(" X=0.0,"))),
        ["a.nml:16:4: X: found Euler parameters of norm 0, expected X=1.0 and EKBAR=3*0.0, or \
          norm 1"]
    );
}

#[test]
fn gravity_by_any_of_its_names() {
    for name in ["GHAT", "GH", "HS", "SH"] {
        let scene = read(&with_cards(&format!(" G=9.5,{name}=0.6,0.0,-0.8,"))).scene;
        let gravity = scene.gravity.expect("there is gravity");
        assert_eq!(gravity.acceleration, 9.5);
        near(gravity.up, 0.6, 0.0, -0.8);
    }
    assert!(read(&with_cards(" G=0.0,GHAT=3*0.0,")).scene.gravity.is_none());
}

#[test]
fn thrust() {
    let cards = " FT=5.0,FTHAT=0.0,-1.0,0.0,FTBAR=1.0,2.0,3.0,TINT=0.5,TFIN=0.75,";
    let scene = read(&with_cards(cards)).scene;
    let expected = (Vec3::new(0.0, -5.0, 0.0), Vec3::new(1.0, 2.0, 3.0), [0.5, 0.75]);
    assert_eq!(scene.externals, [External::thrust(expected.0, expected.1, expected.2)]);
    let never = read(&with_cards(" FT=5.0,FTHAT=1.0,0.0,0.0,"));
    assert_eq!(never.warnings[0].symbol, "TFIN");
    assert!(read(&with_cards(" FT=0.0,FTHAT=3*0.0,")).scene.externals.is_empty());
}

#[test]
fn directions_have_length_one() {
    // Six printed digits are enough, and are made exact.
    let scene = read(&with_cards(" G=1.0,GHAT=0.577350,0.577350,0.577350,")).scene;
    assert!((scene.gravity.unwrap().up.norm() - 1.0).abs() <= ROUNDING);
    let table = [
        (
            " G=1.0,GHAT=0.0,0.0,1.00001",
            "a.nml:16:13: GHAT(1): found (0, 0, 1.00001) of length 1.00001, expected a unit vector",
        ),
        (" FT=1.0,TFIN=1.0", "a.nml:4:2: FTHAT: found nothing, expected 3 values"),
        (
            " FT=-1.0,FTHAT=1.0,0.0,0.0",
            "a.nml:16:5: FT: found -1, expected none below zero; turn the unit vector round",
        ),
        (
            " FT=1.0,FTHAT=1.0,0.0,0.0,TINT=2.0,TFIN=1.0",
            "a.nml:16:41: TFIN: found thrust from 2 to 1, expected an end not before its start",
        ),
    ];
    for (cards, expected) in table {
        assert_eq!(lines(&errors(&with_cards(cards))), [expected], "{cards}");
    }
}
