mod laws;

use nboom_model::{
    Base, Body, Course, DrivePoint, External, ExternalAxes, ExternalKind, Hinge, HingeLabel,
    HingePlace, HingeState, Joint, MassProperties, Posture, Release, RotorSpeed, Scene,
};
use nboom_scalar::Vec3;

use crate::format::{count, degrees, moment, short, vector};

/// The content of a scene, for people to read; numbers to six digits.
pub(crate) fn text(scene: &Scene) -> String {
    let mut lines = vec![heading(scene)];
    lines.push(format!("main body: {}", mass_properties(&scene.main_body)));
    lines.extend(held(scene).map(|held| format!("  {held}")));
    lines.extend(rotors(scene, None).map(|rotor| format!("  {rotor}")));
    let postures = [Posture::at_start(scene), Posture::locked(scene)];
    for branch in branches(scene) {
        lines.extend(branch_lines(scene, &branch, &postures));
    }
    if !scene.bodies.is_empty() {
        lines.push(PLACES.to_owned());
    }
    lines.extend(environment(scene));
    let [start, end] = [scene.initial.time, scene.end_time].map(|time| moment(scene, time, 10));
    lines.push(format!("span: {start} to {end}"));
    lines.push(skipped(scene));
    lines.join("\n") + "\n"
}

fn heading(scene: &Scene) -> String {
    let bodies = count(1 + scene.bodies.len(), "body", "bodies");
    let freedom = count(scene.degrees_of_freedom(), "degree", "degrees");
    let mass = short(scene.total_mass(), 6);
    format!("{}: {bodies}, {freedom} of freedom, total mass {mass}", scene.name)
}

fn mass_properties(body: &MassProperties) -> String {
    let [a, b, c] = body.principal_moments().map(|moment| short(moment, 6));
    let (mass, center) = (short(body.mass, 6), vector(body.center_of_mass));
    format!("mass {mass}, mass centre {center}, principal moments of inertia {a}, {b}, {c}")
}

fn held(scene: &Scene) -> Option<String> {
    match &scene.base {
        Base::Free => None,
        Base::Fixed => Some("fixed to the ground".to_owned()),
        Base::Driven(drive) => {
            let point = |point: &DrivePoint| {
                let (rate, speed) = (degrees(point.rate), short(point.speed, 6));
                format!("{rate} and {speed} per time unit at {}", moment(scene, point.time, 6))
            };
            let points = drive.points.iter().map(point).collect::<Vec<_>>().join(", ");
            Some(format!("driven about and along {}: {points}", vector(drive.axis)))
        }
    }
}

fn rotors(scene: &Scene, body: Option<usize>) -> impl Iterator<Item = String> {
    scene.rotors.iter().filter(move |rotor| rotor.body == body).map(|rotor| {
        let (axis, inertia) = (vector(rotor.axis), short(rotor.inertia, 6));
        let speed = match &rotor.speed {
            RotorSpeed::Constant(speed) => format!("{} per time unit", degrees(*speed)),
            RotorSpeed::Table(points) => {
                let point = |[time, speed]: &[f64; 2]| {
                    format!("{} per time unit at {}", degrees(*speed), moment(scene, *time, 6))
                };
                points.iter().map(point).collect::<Vec<_>>().join(", ")
            }
        };
        format!("rotor: axis {axis}, inertia {inertia}, {speed}")
    })
}

/// Indices of the bodies of each branch that leaves the main body.
fn branches(scene: &Scene) -> Vec<Vec<usize>> {
    let mut branches: Vec<Vec<usize>> = Vec::new();
    for (i, body) in scene.bodies.iter().enumerate() {
        match branches.last_mut() {
            Some(branch) if body.inboard.is_some() => branch.push(i),
            _ => branches.push(vec![i]),
        }
    }
    branches
}

fn branch_lines(scene: &Scene, branch: &[usize], postures: &[Posture; 2]) -> Vec<String> {
    let segments = count(branch.len(), "segment", "segments");
    let number = scene.label(branch[0]).appendage + 1;
    let mut lines = vec![format!("appendage {number}: {}, {segments}", kind(scene, branch))];
    lines.extend(branch.iter().flat_map(|&i| hinge_lines(scene, i, postures)));
    lines
}

fn kind(scene: &Scene, branch: &[usize]) -> &'static str {
    let is_chain = branch.windows(2).all(|pair| scene.bodies[pair[1]].inboard == Some(pair[0]));
    let outer = &branch[1..];
    let is_parallel = outer.iter().all(|&i| scene.adds_to_inboard_angle(i));
    let turns_about_eta = outer.iter().all(|&i| scene.bodies[i].axis == Vec3::unit_y());
    match (is_chain, is_parallel, outer.len()) {
        (true, true, _) => "regular",
        (true, false, 1) if turns_about_eta => "paddle",
        (true, false, _) => "chain",
        (false, ..) => "tree",
    }
}

fn hinge_lines(scene: &Scene, i: usize, postures: &[Posture; 2]) -> Vec<String> {
    let Body { mass_properties: mass, hinge, .. } = &scene.bodies[i];
    let label = scene.label(i);
    let mut lines = vec![format!("  {}: {}", joint(&label), course(scene, &label, hinge))];
    let places = postures.each_ref().map(|posture| place(&posture.hinges[i]));
    let when = ["at the start", "locked"];
    lines.extend(when.iter().zip(places).map(|(when, place)| format!("    {when}: {place}")));
    lines.extend(laws::of(scene, i).map(|law| format!("    {law}")));
    lines.push(format!("    body: {}", mass_properties(mass)));
    lines.extend(rotors(scene, Some(i)).map(|rotor| format!("    {rotor}")));
    lines
}

/// A hinge or slide with its label.
fn joint(label: &HingeLabel) -> String {
    format!("{} {label}", label.joint.name())
}

/// Explains the places of hinges, and what else has components.
const PLACES: &str = "places of hinges, and first ends of kick-off springs: main-body axes, from O; all else of a body: \
                      its axes, from its hinge; locked: with all lock angles reached, hinges without one as at the start";

fn place(hinge: &HingePlace) -> String {
    let [point, tip] = [hinge.point, hinge.tip].map(|place| vector(without_rounding(place)));
    format!("hinge at {point}, axis {}, outer end at {tip}", vector(without_rounding(hinge.axis)))
}

/// Components that are only rounding compared with the largest one, or with 1 in a direction,
/// become zero.
fn without_rounding(v: Vec3<f64>) -> Vec3<f64> {
    let largest = v.to_array().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    v.map(|x| if x.abs() <= 1e-12 * largest { 0.0 } else { x })
}

/// An angle in degrees, or a travel.
fn coordinate(label: &HingeLabel, beta: f64) -> String {
    match label.joint {
        Joint::Revolute => degrees(beta),
        Joint::Prismatic => short(beta, 6),
    }
}

/// How a hinge starts, is released and locks.
fn course(scene: &Scene, label: &HingeLabel, hinge: &Hinge) -> String {
    let at = coordinate(label, hinge.start.angle);
    let start = match hinge.start.state {
        HingeState::Unreleased => format!("unreleased at {at}, {}", release(scene, hinge.release)),
        HingeState::Free | HingeState::Stuck => {
            let rate = coordinate(label, hinge.start.rate);
            format!("free at {at}, rate {rate} per time unit")
        }
        HingeState::Locked => return format!("locked at {at}"),
    };
    let lock = match hinge.lock_angle {
        Some(angle) => format!("locks at {}", coordinate(label, angle)),
        None => "never locks".to_owned(),
    };
    format!("{start}, {lock}")
}

fn release(scene: &Scene, release: Release) -> String {
    match release {
        Release::Time(time) => format!("released at time {}", moment(scene, time, 10)),
        Release::Angle { hinge, angle } => {
            let trigger = scene.label(hinge);
            let passes = trigger.joint.passes_name();
            format!("released when {} {passes} {}", joint(&trigger), coordinate(&trigger, angle))
        }
        Release::AfterLock { hinge, delay } => {
            format!("released {} after {} locks", short(delay, 10), joint(&scene.label(hinge)))
        }
        Release::Never => "never released".to_owned(),
    }
}

fn environment(scene: &Scene) -> Vec<String> {
    let gravity = scene.gravity.as_ref().map_or_else(
        || "gravity: none".to_owned(),
        |g| format!("gravity: {}, up is {}", short(g.acceleration, 6), vector(g.up)),
    );
    let mut lines = vec![gravity];
    if scene.externals.is_empty() {
        lines.push("thrust: none".to_owned());
    }
    lines.extend(scene.externals.iter().map(|external| outside(scene, external)));
    lines
}

/// A force or torque from outside.
pub(crate) fn outside(scene: &Scene, external: &External) -> String {
    let kind = external.kind.name();
    let on = external.body.map(|body| format!(" on the body of {}", joint(&scene.label(body))));
    let at = match external.kind {
        ExternalKind::Force => format!(" at {}", vector(external.point)),
        ExternalKind::Torque => String::new(),
    };
    let along = match external.axes {
        ExternalAxes::Body => "",
        ExternalAxes::Inertial => ", along inertial axes",
    };
    let when = external.course.when(|time| moment(scene, time, 10));
    let when = match &external.course {
        Course::Table(points) => format!("by a table of {} points {when}", points.len()),
        always if *always == Course::ALWAYS => "always on".to_owned(),
        Course::Pulse { .. } => format!("on {when}"),
    };
    let (on, amount) = (on.unwrap_or_default(), vector(external.amount));
    format!("{kind}{on}: {amount}{at}{along}, {when}")
}

fn skipped(scene: &Scene) -> String {
    let skipped = nboom_model::skipped(scene);
    let what = if skipped.is_empty() { "nothing".to_owned() } else { skipped.join("; ") };
    format!("not computed, since the scene lacks it: {what}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use nboom_model::{
        Appendage, Gravity, HingeStart, KickOffSpring, Mount, SceneDescription, Segment, Stops,
        TorqueTable,
    };
    use nboom_scalar::Sym3;

    fn segment(hinge: Hinge) -> Segment {
        let body = MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
        Segment { length: 1.0, mass_properties: body, hinge }
    }

    fn with_everything() -> Scene {
        let mut arm = Hinge { lock_angle: Some(1.0_f64.to_radians()), ..Hinge::free() };
        arm.dashpot.rate_linear = -0.5;
        arm.kick_off = Some(KickOffSpring {
            main_body_point: Vec3::unit_x(),
            body_point: Vec3::unit_y(),
            coefficients: [1.0, -2.0, 0.0, 0.0],
            limit_length: 3.0,
        });
        let start = HingeStart { angle: 0.0, rate: 0.0, state: HingeState::Unreleased };
        let release = Release::Angle { hinge: 0, angle: 90.0_f64.to_radians() };
        let paddle = Hinge { start, release, ..Hinge::free() };
        let mut description = SceneDescription::at_rest("all", segment(arm).mass_properties, 2.0);
        description.gravity = Some(Gravity { acceleration: 9.81, up: Vec3::unit_z() });
        let thrust = External::thrust(Vec3::unit_x(), Vec3::zero(), [0.5, 1.5]);
        let course = Course::Table(vec![[0.0, 0.0], [1.0, 1.0], [3.0, 0.0]]);
        let (kind, axes) = (ExternalKind::Torque, ExternalAxes::Inertial);
        let pulse = |on, off| Course::Pulse { on, off };
        description.externals = vec![
            External { course: pulse(0.5, f64::INFINITY), ..thrust.clone() },
            External { course: pulse(f64::NEG_INFINITY, 1.5), ..thrust.clone() },
            External { course: Course::ALWAYS, body: Some(0), ..thrust.clone() },
            External { course, kind, axes, ..thrust.clone() },
            thrust,
        ];
        description.attach(&Appendage::Paddle {
            mount: Mount::at(Vec3::zero()),
            arm: segment(arm),
            paddle: segment(paddle),
        });
        Scene::new(description).expect("the bodies are physical")
    }

    #[test]
    fn everything_a_scene_may_have_is_said() {
        let text = text(&with_everything());
        for words in [
            "appendage 1: paddle, 2 segments",
            "free at 0 deg, rate 0 deg per time unit, locks at 1 deg",
            "damper: damping 0.5",
            "kick-off spring: (1, 0, 0) to (0, 1, 0), coefficients 1, -2, 0, 0, up to length 3",
            "unreleased at 0 deg, released when hinge 1,1 passes 90 deg, never locks",
            "gravity: 9.81, up is (0, 0, 1)",
            "thrust: (1, 0, 0) at (0, 0, 0), on from 0.5 to 1.5",
            "thrust: (1, 0, 0) at (0, 0, 0), on from 0.5 on",
            "thrust: (1, 0, 0) at (0, 0, 0), on until 1.5",
            "thrust on the body of hinge 1,1: (1, 0, 0) at (0, 0, 0), always on",
            "torque: (1, 0, 0), along inertial axes, by a table of 3 points from 0 to 3",
        ] {
            assert!(text.contains(words), "no {words:?} in {text}");
        }
    }

    #[test]
    fn slides_are_named_as_such_and_tables_are_shown() {
        let scene = with_everything();
        let mut description = SceneDescription::clone(&scene);
        description.bodies[0].joint = Joint::Prismatic;
        description.bodies[1].hinge.release = Release::AfterLock { hinge: 0, delay: 0.5 };
        let (lower, upper) = (f64::NEG_INFINITY, 90.0_f64.to_radians());
        description.bodies[0].hinge.stops = Stops { lower: -0.5, upper: 1.25, restitution: 0.0 };
        description.bodies[1].hinge.stops = Stops { lower, upper, restitution: 0.3 };
        let points = vec![[0.0, 2.0], [1.0_f64.to_radians(), -1.0]];
        description.torque_tables =
            [0, 1].map(|hinge| TorqueTable { hinge, points: points.clone() }).into();
        assert!(!text(&scene).contains("stops: "));
        let text = text(&Scene::new(description).expect("the bodies are physical"));
        for words in [
            "slide 1,1: ",
            "force table: 2 at 0, -1 at 0.0174533",
            "torque table: 2 at 0 deg, -1 at 1 deg",
            "    stops: -0.5 and 1.25, restitution 0\n",
            "    stops: 90 deg, restitution 0.3\n",
            "released 0.5 after slide 1,1 locks",
            "thrust on the body of slide 1,1: ",
        ] {
            assert!(text.contains(words), "no {words:?} in {text}");
        }
    }

    #[test]
    fn a_branch_that_forks_is_a_tree() {
        let scene = with_everything();
        let mut description = SceneDescription::clone(&scene);
        description.bodies.push(Body { inboard: Some(0), ..description.bodies[1] });
        let scene = Scene::new(description).expect("the bodies are physical");
        assert!(text(&scene).contains("appendage 1: tree, 3 segments"));
    }
}
