//! Numbers of `summary.json`, by their paths.

use nboom_io::{SceneFile, nearest};
use nboom_model::{Body, HingeState, Joint};
use nboom_tables::{Column, Kind};

use super::hinge::STATE;
use super::{Loads, Named, Needs, What, refused};
use crate::statistics::Meaning;
use crate::table::units;

/// A number of the file.
struct Key {
    /// Its path; lists have empty brackets.
    path: &'static str,
    /// None of a whole number.
    unit: Option<&'static str>,
    needs: Needs,
    about: &'static str,
}

const fn count(path: &'static str, about: &'static str) -> Key {
    Key { path, unit: None, needs: Needs::Nothing, about }
}

const fn number(path: &'static str, unit: &'static str, about: &'static str) -> Key {
    Key { path, unit: Some(unit), needs: Needs::Nothing, about }
}

impl Key {
    const fn of(self, needs: Needs) -> Self {
        Self { needs, ..self }
    }
}

/// All, in their order in the file; `wall_seconds` is none, since it is another one each time.
static KEYS: [Key; 60] = [
    count("degrees_of_freedom", "six, or none of a held main body, and one for each hinge"),
    number("generated_share", "1", "share of the evaluations by generated code").of(Needs::Effort),
    number("selections[].since", "T", "when this code took over"),
    count("selections[].evaluations", "evaluations by this code").of(Needs::Effort),
    number("integrations[].since", "T", "when this integrator took over"),
    number("rtol", "1", "relative error allowed in a step"),
    number("atol", "1", "absolute error allowed in a step"),
    count("samples", "output times after the initial one"),
    number("end_time", "T", "time reached"),
    count("steps_accepted", "steps accepted"),
    count("steps_rejected", "steps rejected"),
    count("evaluations", "evaluations of the accelerations").of(Needs::Effort),
    count("jacobians", "evaluations of the Jacobian"),
    count("factorizations", "factorisations of iteration matrices"),
    count("events", "events, the end included"),
    count("verdict.hinges[].appendage", APPENDAGE),
    count("verdict.hinges[].segment", SEGMENT),
    count("verdict.hinges[].state", STATE),
    number("verdict.hinges[].time", "T", "when its state last changed"),
    number(ANGLE, "rad", "angle or travel at the end"),
    number(MISS, "rad", "how near it came to its lock angle without locking"),
    number("verdict.hinges[].miss_time", "T", "when it was nearest to its lock angle"),
    number(CLOSING_RATE, "rad/T", "its rate just before it locked"),
    number(LARGEST_IMPULSE, "F L T", "magnitude of the largest impulse of a lock-up or an impact"),
    count("verdict.largest_impulse_at.appendage", APPENDAGE),
    count("verdict.largest_impulse_at.segment", SEGMENT),
    number(
        "verdict.largest_impulse_at.time",
        "T",
        "when the impulse of a lock-up or an impact was largest",
    ),
    number(IMPULSE, "F L T", "largest impulse of a lock-up or an impact"),
    number("verdict.worst_load", "F/L^2", "largest von Mises stress").of(Needs::Stresses),
    count("verdict.worst_load_at.appendage", APPENDAGE).of(Needs::Stresses),
    count("verdict.worst_load_at.segment", SEGMENT).of(Needs::Stresses),
    count("verdict.worst_load_at.station", STATION).of(Needs::Stresses),
    number("verdict.worst_load_at.time", "T", "when the stress was largest").of(Needs::Stresses),
    number("verdict.smallest_margin", "1", "smallest margin").of(Needs::Strengths),
    count("verdict.smallest_margin_at.appendage", APPENDAGE).of(Needs::Strengths),
    count("verdict.smallest_margin_at.segment", SEGMENT).of(Needs::Strengths),
    count("verdict.smallest_margin_at.station", STATION).of(Needs::Strengths),
    number("verdict.smallest_margin_at.time", "T", "when it was smallest").of(Needs::Strengths),
    number("verdict.smallest_yield_margin", "1", "smallest margin to yield").of(Needs::Strengths),
    count("verdict.smallest_yield_margin_at.appendage", APPENDAGE).of(Needs::Strengths),
    count("verdict.smallest_yield_margin_at.segment", SEGMENT).of(Needs::Strengths),
    count("verdict.smallest_yield_margin_at.station", STATION).of(Needs::Strengths),
    number("verdict.smallest_yield_margin_at.time", "T", "when it was smallest")
        .of(Needs::Strengths),
    number("verdict.smallest_ultimate_margin", "1", "smallest margin to ultimate")
        .of(Needs::Strengths),
    count("verdict.smallest_ultimate_margin_at.appendage", APPENDAGE).of(Needs::Strengths),
    count("verdict.smallest_ultimate_margin_at.segment", SEGMENT).of(Needs::Strengths),
    count("verdict.smallest_ultimate_margin_at.station", STATION).of(Needs::Strengths),
    number("verdict.smallest_ultimate_margin_at.time", "T", "when it was smallest")
        .of(Needs::Strengths),
    number("verdict.largest_hinge_force", "F", "largest force of a hinge").of(Needs::HingeLoads),
    count("verdict.largest_hinge_force_at.appendage", APPENDAGE).of(Needs::HingeLoads),
    count("verdict.largest_hinge_force_at.segment", SEGMENT).of(Needs::HingeLoads),
    number("verdict.largest_hinge_force_at.time", "T", LOAD_TIME).of(Needs::HingeLoads),
    number("verdict.largest_hinge_moment", "F L", "largest moment of a hinge")
        .of(Needs::HingeLoads),
    count("verdict.largest_hinge_moment_at.appendage", APPENDAGE).of(Needs::HingeLoads),
    count("verdict.largest_hinge_moment_at.segment", SEGMENT).of(Needs::HingeLoads),
    number("verdict.largest_hinge_moment_at.time", "T", LOAD_TIME).of(Needs::HingeLoads),
    number("conservation.linear_momentum", "1", "residual of linear momentum").of(Needs::FreeBody),
    number("conservation.angular_momentum", "1", "residual of angular momentum")
        .of(Needs::FreeBody),
    number("conservation.energy", "1", "residual of energy"),
    number("attitude_drift", "1", "how far from 1 the norm of the attitude has been"),
];

const APPENDAGE: &str = "appendage of the hinge, from 1";
const SEGMENT: &str = "segment of the hinge, from 1";
const STATION: &str = "station of the segment, from 1";
const LOAD_TIME: &str = "when the load was largest";
const LARGEST_IMPULSE: &str = "verdict.largest_impulse";
const IMPULSE: &str = "verdict.largest_impulse_at.impulse";
const ANGLE: &str = "verdict.hinges[].angle";
const MISS: &str = "verdict.hinges[].miss";
const CLOSING_RATE: &str = "verdict.hinges[].closing_rate";
/// Followed by a name.
const PARAMETER: &str = "parameters.";

/// The margins of the whole.
const MARGINS: [&str; 3] = [
    "verdict.smallest_margin",
    "verdict.smallest_yield_margin",
    "verdict.smallest_ultimate_margin",
];

/// What the number with this path is.
pub(super) fn meaning(path: &str) -> Meaning {
    if MARGINS.contains(&path) { Meaning::Margin } else { Meaning::Other }
}

/// The number with this path.
pub(super) fn named(text: &str, file: &SceneFile, loads: Loads) -> Named {
    if text == "wall_seconds" {
        return Err(refused("a number that is the same each time"));
    }
    if let Some(name) = text.strip_prefix(PARAMETER) {
        return parameter(name, file);
    }
    let unknown = || {
        let expected = "`lock_time of HINGE` and the like, `final COLUMN`, `largest COLUMN`, \
             `smallest COLUMN` or the path of a number of summary.json";
        let meant = nearest(text, KEYS.iter().map(|key| key.path));
        (expected.to_owned(), meant.map(|path| path.replace("[]", "[1]")))
    };
    let (pattern, number) = in_list(text).ok_or_else(unknown)?;
    let key = KEYS.iter().find(|key| key.path == pattern).ok_or_else(unknown)?;
    let hinges = file.scene.labels();
    let label = number.filter(|_| pattern.starts_with("verdict.hinges")).map(|n| hinges.get(n));
    if label == Some(None) {
        return Err((format!("a hinge from 1 to {}", hinges.len()), None));
    }
    if let Some(missing) = key.needs.missing(file, loads) {
        return Err(refused(missing));
    }
    let slides = label.flatten().is_some_and(|label| label.joint.slides());
    let is_impulse = matches!(&*pattern, LARGEST_IMPULSE | IMPULSE);
    let [turning_ends, sliding_ends] =
        [Joint::Revolute, Joint::Prismatic].map(|joint| is_impulse && may_end(joint, file));
    if turning_ends && sliding_ends {
        return Err(refused(
            "`impulse of HINGE` where hinges and slides have latches or stops, whose impulses have different units",
        ));
    }
    let unit = key.unit.map(|unit| match &*pattern {
        ANGLE | MISS if slides => "L",
        CLOSING_RATE if slides => "L/T",
        LARGEST_IMPULSE | IMPULSE if sliding_ends => "F T",
        _ => unit,
    });
    let kind = if unit.is_some() { Kind::Number } else { Kind::Integer };
    let pointer = match number {
        Some(number) => pattern.replace("[]", &format!(".{number}")),
        None => pattern,
    };
    let column = Column::new("", kind, key.about);
    let unit = unit.map(|unit| units(file).label(unit));
    let body = label.flatten().and_then(|label| label.name.as_deref()).map(str::to_owned);
    let what = What::Summary(format!("/{}", pointer.replace('.', "/")));
    Ok((what, Column { unit, body, ..column }, key.needs))
}

/// Whether there are joints of this kind whose motion a latch or a stop may end.
fn may_end(joint: Joint, file: &SceneFile) -> bool {
    let mut of_kind = file.scene.bodies.iter().filter(|body| body.joint == joint);
    of_kind.any(|Body { hinge, .. }| {
        hinge.has_latch_or_stop() && hinge.start.state != HingeState::Locked
    })
}

/// The parameter with this name.
fn parameter(name: &str, file: &SceneFile) -> Named {
    let names = || file.settings.parameters.iter().map(|(name, _)| name.as_str());
    if names().any(|known| known == name) {
        let column = Column::new("", Kind::Number, "parameter of the scene");
        return Ok((What::Summary(format!("/parameters/{name}")), column, Needs::Nothing));
    }
    let meant = nearest(name, names()).map(|name| format!("{PARAMETER}{name}"));
    Err(("a parameter of the scene".to_owned(), meant))
}

/// A path with empty brackets in place of `[number]`, and the number from 0; `None` if it is no path.
fn in_list(text: &str) -> Option<(String, Option<usize>)> {
    let Some((before, rest)) = text.split_once('[') else { return Some((text.to_owned(), None)) };
    let (number, after) = rest.split_once(']')?;
    let number = number.parse::<usize>().ok()?.checked_sub(1)?;
    Some((format!("{before}[]{after}"), Some(number)))
}
