//! Finds all that keeps a description from being a scene.

use nboom_scalar::{Sym3, Vec3};

use crate::{
    BaseQuantity, Body, BodyName, Coupling, Finding, HingeLabel, HingeQuantity, HingeState, Joint,
    MassDefect, ModelError, Release, Rotor, RotorPart, SAME_ANGLE, SceneDescription, SceneQuantity,
    UnitQuantity, shown,
};

/// Departure from a unit vector or a rotation that is taken for rounding in the input.
const UNIT_TOLERANCE: f64 = 1e-9;

pub(crate) fn find(scene: &SceneDescription, labels: &[HingeLabel]) -> Vec<ModelError> {
    let mut errors = Vec::new();
    // A main body that is held moves as prescribed, whatever its mass, but without any mass there is no mass centre.
    let carries_mass = scene.bodies.iter().any(|body| body.mass_properties.mass > 0.0);
    let is_ground = scene.base.is_held() && scene.main_body.is_nothing() && carries_mass;
    if let Some(defect) = scene.main_body.defect().filter(|_| !is_ground) {
        errors.push(ModelError::Mass { body: BodyName::MainBody, defect });
    }
    find_in_motion(scene, &mut errors);
    for (i, body) in scene.bodies.iter().enumerate() {
        find_in_tree(scene, labels, i, &mut errors);
        find_in_mass(scene, &labels[i], i, &mut errors);
        find_in_hinge(body, &labels[i], labels.len(), i, &mut errors);
    }
    find_in_tables(scene, &mut errors);
    find_in_couplings(scene, labels, &mut errors);
    find_in_rotors(scene, &mut errors);
    errors
}

fn find_in_rotors(scene: &SceneDescription, errors: &mut Vec<ModelError>) {
    for (i, rotor) in scene.rotors.iter().enumerate() {
        let Rotor { body, axis, inertia, ref speed } = *rotor;
        let mut error = |part, finding| {
            errors.push(ModelError::Rotor { rotor: i, body, part, finding });
        };
        if body.is_some_and(|body| body >= scene.bodies.len()) {
            error(RotorPart::Body, Finding::new("body that is not there", "a body of the scene"));
        }
        if !is_unit(axis.norm()) {
            let found = format!("axis of length {}", shown(axis.norm()));
            error(RotorPart::Axis, Finding::new(found, "a unit vector"));
        }
        if !(inertia > 0.0 && inertia.is_finite()) {
            let found = format!("inertia {}", shown(inertia));
            error(RotorPart::Inertia, Finding::new(found, "a positive finite inertia"));
        }
        if let Some(finding) = speed.defect() {
            error(RotorPart::Speed, finding);
        }
    }
}

fn find_in_couplings(
    scene: &SceneDescription,
    labels: &[HingeLabel],
    errors: &mut Vec<ModelError>,
) {
    for coupling in &scene.couplings {
        let [first, second] = coupling.hinges;
        let label = labels.get(first).cloned().unwrap_or(HingeLabel::new(0, 0));
        let mut error = |found: String, expected| {
            let finding = Finding::new(found, expected);
            errors.push(ModelError::Coupling { label: label.clone(), finding });
        };
        if first.max(second) >= labels.len() || first == second {
            let found = format!(
                "of hinges number {} and {}",
                first.saturating_add(1),
                second.saturating_add(1)
            );
            error(found, "one of two hinges of the scene");
        }
        let Coupling { ratio, stiffness, rest, damping, .. } = *coupling;
        if ![ratio, stiffness, rest, damping].iter().all(|number| number.is_finite()) {
            let [ratio, stiffness, rest, damping] = [ratio, stiffness, rest, damping].map(shown);
            let found = format!(
                "with ratio {ratio}, stiffness {stiffness}, rest {rest}, damping {damping}"
            );
            error(found, "finite numbers");
        }
    }
}

fn find_in_tables(scene: &SceneDescription, errors: &mut Vec<ModelError>) {
    let (tables, count) = (&scene.torque_tables, scene.bodies.len());
    for (i, table) in tables.iter().enumerate() {
        let hinge = table.hinge;
        if hinge >= count || tables[..i].iter().any(|other| other.hinge == hinge) {
            errors.push(ModelError::TableHinge { table: i, hinge, count });
        }
        let defect = match &table.points[..] {
            few @ ([] | [_]) => Some(format!("{} points", few.len())),
            points => points.iter().enumerate().find_map(|(k, &[angle, torque])| {
                let is_finite = angle.is_finite() && torque.is_finite();
                let ascends = k == 0 || angle > points[k - 1][0] + SAME_ANGLE;
                (!(is_finite && ascends))
                    .then(|| format!("point {} at {}, {}", k + 1, shown(angle), shown(torque)))
            }),
        };
        let joint = scene.bodies.get(hinge).map_or(Joint::Revolute, |body| body.joint);
        errors.extend(defect.map(|defect| ModelError::TablePoints { joint, table: i, defect }));
    }
}

fn find_in_motion(scene: &SceneDescription, errors: &mut Vec<ModelError>) {
    let initial = &scene.initial;
    let both_finite = initial.time.is_finite() && scene.end_time.is_finite();
    let lasts_on_numbers = !both_finite || (scene.end_time - initial.time).is_finite();
    let gravity_is_finite = scene.gravity.is_none_or(|gravity| gravity.acceleration.is_finite());
    let finite = [
        (initial.time.is_finite(), SceneQuantity::InitialTime),
        (initial.position_inertial.is_finite(), SceneQuantity::InitialPosition),
        (initial.velocity_inertial.is_finite(), SceneQuantity::InitialVelocity),
        (initial.omega_body.is_finite(), SceneQuantity::InitialRate),
        (scene.end_time.is_finite(), SceneQuantity::EndTime),
        (lasts_on_numbers, SceneQuantity::Duration),
        (gravity_is_finite, SceneQuantity::Gravity),
    ];
    let bad = finite.into_iter().filter(|(ok, _)| !ok);
    errors.extend(bad.map(|(_, quantity)| ModelError::NotFinite { quantity }));
    let attitude = initial.attitude.norm_squared().sqrt();
    check_unit(UnitQuantity::InitialAttitude, attitude, errors);
    if let Some(gravity) = scene.gravity {
        check_unit(UnitQuantity::GravityDirection, gravity.up.norm(), errors);
    }
    find_in_base(scene, errors);
    if scene.end_time < initial.time {
        errors.push(ModelError::EndTime { start: initial.time, end: scene.end_time });
    }
    crate::external::find(scene, errors);
}

/// A main body that is held starts as it is held: a jump would take an impulse.
fn find_in_base(scene: &SceneDescription, errors: &mut Vec<ModelError>) {
    if !scene.base.is_held() {
        return;
    }
    let (mut rate, mut velocity) = (Vec3::zero(), Vec3::zero());
    if let Some(drive) = scene.base.drive() {
        if let Some(finding) = drive.defect(&scene.initial, scene.gravity.as_ref()) {
            errors.push(ModelError::Drive { finding });
            return;
        }
        let [about, along] = drive.rates_at(scene.initial.time);
        rate = drive.axis * about;
        velocity = scene.initial.attitude.normalized().to_matrix() * drive.axis * along;
    }
    let initial = &scene.initial;
    for (quantity, found, expected) in [
        (BaseQuantity::AngularRate, initial.omega_body, rate),
        (BaseQuantity::Velocity, initial.velocity_inertial, velocity),
    ] {
        if (found - expected).norm() > UNIT_TOLERANCE * expected.norm() {
            let (found, expected) = (found.to_array(), expected.to_array());
            errors.push(ModelError::HeldBase { quantity, found, expected });
        }
    }
}

fn check_unit(quantity: UnitQuantity, length: f64, errors: &mut Vec<ModelError>) {
    if !is_unit(length) {
        errors.push(ModelError::NotUnit { quantity, length });
    }
}

/// False also for a length that is not a number.
fn is_unit(length: f64) -> bool {
    (length - 1.0).abs() <= UNIT_TOLERANCE
}

fn find_in_tree(
    scene: &SceneDescription,
    labels: &[HingeLabel],
    i: usize,
    errors: &mut Vec<ModelError>,
) {
    let (body, label) = (&scene.bodies[i], || labels[i].clone());
    let of_this_branch =
        |&inboard: &usize| inboard < i && labels[inboard].appendage == labels[i].appendage;
    if let Some(inboard) = body.inboard.filter(|inboard| !of_this_branch(inboard)) {
        errors.push(ModelError::Order { label: label(), inboard });
    }
    let length = body.axis.norm();
    if !is_unit(length) {
        errors.push(ModelError::Axis { label: label(), length });
    }
    let defect = body.mount.rot_inboard_from_hinge.rotation_defect();
    let is_rotation = defect <= UNIT_TOLERANCE;
    if !is_rotation {
        errors.push(ModelError::MountRotation { label: label(), defect });
    }
}

/// A body that carries others may be without mass, as the ring between the axes of a gimbal; so may
/// a wheel on which nothing hangs, whose inertia is about its axis alone.
fn find_in_mass(
    scene: &SceneDescription,
    label: &HingeLabel,
    i: usize,
    errors: &mut Vec<ModelError>,
) {
    let body = &scene.bodies[i].mass_properties;
    let carries = || scene.bodies.iter().any(|other| other.inboard == Some(i));
    let wheel = |of: &Body| of.joint == Joint::Revolute && body.is_wheel(of.axis);
    if body.is_nothing() && carries() || wheel(&scene.bodies[i]) && !carries() {
        return;
    }
    let defect =
        if body.mass == 0.0 && body.center_of_mass.is_finite() && body.inertia != Sym3::zero() {
            Some(match scene.bodies[i].joint {
                Joint::Prismatic => MassDefect::WheelSlides,
                Joint::Revolute if carries() => MassDefect::WheelCarries,
                Joint::Revolute => MassDefect::WheelInertia,
            })
        } else {
            body.defect()
        };
    let name = BodyName::Segment(label.clone());
    errors.extend(defect.map(|defect| ModelError::Mass { body: name, defect }));
}

fn find_in_hinge(
    body: &Body,
    label: &HingeLabel,
    count: usize,
    i: usize,
    errors: &mut Vec<ModelError>,
) {
    let label = || label.clone();
    let hinge = &body.hinge;
    let (spring, dashpot) = (&hinge.spring, &hinge.dashpot);
    let spring_numbers = [spring.quadratic, spring.linear, spring.preload_angle];
    let dashpot_numbers = [
        dashpot.rate_quadratic,
        dashpot.rate_linear,
        dashpot.angle_quadratic,
        dashpot.angle_linear,
        dashpot.preload_angle,
    ];
    let all_finite = |numbers: &[f64]| numbers.iter().all(|n| n.is_finite());
    let release_finite = match hinge.release {
        Release::Time(time) => !time.is_nan(),
        Release::Angle { angle, .. } => angle.is_finite(),
        Release::AfterLock { delay, .. } => delay.is_finite(),
        Release::Never => true,
    };
    let finite_points = |points: &[Vec3<f64>]| points.iter().all(|p| p.is_finite());
    let checks = [
        (finite_points(&[body.mount.point, body.tip]), HingeQuantity::Points),
        (all_finite(&spring_numbers), HingeQuantity::Spring),
        (all_finite(&dashpot_numbers), HingeQuantity::Dashpot),
        (hinge.friction.is_finite(), HingeQuantity::Friction),
        (all_finite(&[hinge.start.angle, hinge.start.rate]), HingeQuantity::Start),
        (hinge.lock_angle.is_none_or(f64::is_finite), HingeQuantity::LockAngle),
        (release_finite, HingeQuantity::Release),
        (
            hinge.kick_off.is_none_or(|k| {
                finite_points(&[k.main_body_point, k.body_point])
                    && all_finite(&k.coefficients)
                    && k.limit_length.is_finite()
            }),
            HingeQuantity::KickOff,
        ),
    ];
    let bad = checks.into_iter().filter(|(ok, _)| !ok);
    let not_finite = |(_, quantity)| ModelError::NotFiniteInHinge { label: label(), quantity };
    errors.extend(bad.map(not_finite));
    if let Some(trigger) = hinge.release.trigger()
        && (trigger >= count || trigger == i)
    {
        errors.push(ModelError::Trigger { label: label(), trigger, count });
    }
    if let Release::AfterLock { delay, .. } = hinge.release
        && delay < 0.0
    {
        errors.push(ModelError::ReleaseDelay { label: label(), delay });
    }
    if let Some(spring) = &hinge.kick_off
        && spring.limit_length < 0.0
    {
        errors.push(ModelError::KickOffLimit { label: label(), limit: spring.limit_length });
    }
    if hinge.friction.is_finite() && hinge.friction < 0.0 {
        errors.push(ModelError::NegativeFriction { label: label(), friction: hinge.friction });
    }
    if let Some(finding) = hinge.stops.defect(&label(), hinge.start.angle, hinge.lock_angle) {
        errors.push(ModelError::Stops { label: label(), finding });
    }
    if !(0.0..=1.0).contains(&hinge.stops.restitution) {
        let restitution = hinge.stops.restitution;
        errors.push(ModelError::Restitution { label: label(), restitution });
    }
    if !HingeState::AT_START.contains(&hinge.start.state) {
        errors.push(ModelError::StartState { label: label(), state: hinge.start.state });
    }
    if hinge.start.state != HingeState::Free && hinge.start.rate != 0.0 {
        errors.push(ModelError::HeldRate { label: label(), rate: hinge.start.rate });
    }
}
