//! What acts in a scene beside its hinges, and where stresses are wanted: marks on the bodies.

use std::fmt::Write;

use nboom_io::SceneFile;
use nboom_model::{External, ExternalAxes, ExternalKind, HingePlace, Posture};
use nboom_scalar::{Mat3, Vec3};

use super::AXIS;
use super::view::View;

/// A place in the drawing.
type Place = (f64, f64);

/// Length of an arrow beside that of the axes of a hinged body.
const ARROW: f64 = 2.2;

/// Length and half the width of the head of an arrow.
const HEAD: [f64; 2] = [8.0, 3.5];

/// Most turns of a spring, their least distance, and half their width.
const TURNS: usize = 7;
const APART: f64 = 5.0;
const SPRING: f64 = 4.0;

/// A coupling of hinges that are so near each other is a loop of this radius.
const LOOP: f64 = 5.0;

/// What a mark stands for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    KickOff,
    Force,
    Torque,
    Coupling,
    Station,
}

impl Kind {
    /// All, in the order of the legend.
    pub const ALL: [Self; 5] =
        [Self::KickOff, Self::Force, Self::Torque, Self::Coupling, Self::Station];

    fn colour(self) -> &'static str {
        match self {
            Self::KickOff => "#6d28d9",
            Self::Force | Self::Torque => "#db2777",
            Self::Coupling => "#0f766e",
            Self::Station => "#111827",
        }
    }

    /// What the legend says.
    pub fn words(self) -> &'static str {
        match self {
            Self::KickOff => "kick-off spring, where it pushes",
            Self::Force => "force from outside",
            Self::Torque => "torque from outside, right hand",
            Self::Coupling => "coupling",
            Self::Station => "station",
        }
    }

    /// Its name in the file.
    fn class(self) -> &'static str {
        match self {
            Self::KickOff => "kick-off",
            Self::Force => "force",
            Self::Torque => "torque",
            Self::Coupling => "coupling",
            Self::Station => "station",
        }
    }
}

/// A mark between two places, or at the second.
pub(super) struct Mark {
    pub kind: Kind,
    pub from: Place,
    pub to: Place,
}

/// The marks of a posture; `is_start` if it is that of the start.
pub(super) fn marks(file: &SceneFile, posture: &Posture, is_start: bool, view: &View) -> Vec<Mark> {
    let scene = &file.scene;
    let mut marks = Vec::new();
    let mut add = |kind, from: Vec3<f64>, to: Vec3<f64>| {
        marks.push(Mark { kind, from: view.place(from), to: view.place(to) });
    };
    for (body, place) in scene.bodies.iter().zip(&posture.hinges) {
        let spring =
            body.hinge.kick_off.map(|spring| (spring.main_body_point, spring.limit_length));
        if let Some((point, limit)) = spring
            && (place.kick_off - point).norm() <= limit
        {
            add(Kind::KickOff, point, place.kick_off);
        }
    }
    for coupling in scene.couplings.iter().filter(|coupling| !coupling.is_nothing()) {
        let [first, second] = coupling.hinges.map(|hinge| posture.hinges[hinge].point);
        add(Kind::Coupling, first, second);
    }
    for external in &scene.externals {
        let Some((at, along)) = direction(file, external, posture, is_start) else { continue };
        let kind = match external.kind {
            ExternalKind::Force => Kind::Force,
            ExternalKind::Torque => Kind::Torque,
        };
        add(kind, at - along * (ARROW * AXIS * view.size), at);
    }
    for at in stations(file, posture) {
        add(Kind::Station, at, at);
    }
    marks
}

/// All points of marks that a drawing must have room for.
pub(super) fn points(file: &SceneFile, posture: &Posture) -> Vec<Vec3<f64>> {
    let bodies = file.scene.bodies.iter();
    let springs = bodies.filter_map(|body| Some(body.hinge.kick_off?.main_body_point));
    let externals = file.scene.externals.iter().map(|external| frame(external, posture));
    let at = externals.zip(&file.scene.externals).map(|((o, axes), of)| o + axes * of.point);
    springs.chain(at).chain(stations(file, posture)).collect()
}

/// Where a force or torque acts and the unit vector along it; nothing of one that is zero, and of one along inertial axes
/// only at the start, for whose attitude the scene tells.
fn direction(
    file: &SceneFile,
    external: &External,
    posture: &Posture,
    is_start: bool,
) -> Option<(Vec3<f64>, Vec3<f64>)> {
    let (origin, axes) = frame(external, posture);
    let along = match external.axes {
        ExternalAxes::Body => axes * external.amount,
        ExternalAxes::Inertial if is_start => {
            let attitude = file.scene.initial.attitude.normalized().to_matrix();
            attitude.transpose() * external.amount
        }
        ExternalAxes::Inertial => return None,
    };
    let size = along.norm();
    (size > 0.0 && size.is_finite()).then(|| (origin + axes * external.point, along * (1.0 / size)))
}

/// Origin and axes of the body on which a force or torque acts.
fn frame(external: &External, posture: &Posture) -> (Vec3<f64>, Mat3<f64>) {
    let of = |place: &HingePlace| (place.point, place.body_axes);
    external.body.map_or((Vec3::zero(), Mat3::identity()), |body| of(&posture.hinges[body]))
}

fn stations(file: &SceneFile, posture: &Posture) -> Vec<Vec3<f64>> {
    let segments = file.structure.iter().flat_map(|structure| structure.segments());
    let of = segments.zip(&posture.hinges).flat_map(|(segment, place)| {
        let eta = place.body_axes.column(1);
        segment.stations.iter().map(move |of| place.point + eta * of.distance_from_hinge)
    });
    of.collect()
}

impl Mark {
    pub fn write(&self, text: &mut String) {
        let (class, colour) = (self.kind.class(), self.kind.colour());
        let line = |d: &str, width: f64| {
            format!(
                "<path class=\"{class}\" d=\"{d}\" fill=\"none\" stroke=\"{colour}\" \
                 stroke-width=\"{width}\" stroke-linejoin=\"round\"/>"
            )
        };
        let mark = match self.kind {
            Kind::KickOff => line(&self.zigzag(), 1.4),
            Kind::Coupling => line(&self.bow(), 1.2).replace("/>", " stroke-dasharray=\"3 2\"/>"),
            Kind::Force => line(&self.arrow(1), 2.0),
            Kind::Torque => line(&self.arrow(2), 2.0),
            Kind::Station => {
                let (x, y) = self.to;
                format!(
                    "<path class=\"{class}\" d=\"M{x:.1} {:.1}l4 4l-4 4l-4 -4Z\" fill=\"{colour}\" \
                     stroke=\"white\" stroke-width=\"0.8\"/>",
                    y - 4.0
                )
            }
        };
        let _ = writeln!(text, "{mark}");
    }

    /// Length, and the unit vectors along and across.
    fn along(&self) -> (f64, Place, Place) {
        let (dx, dy) = (self.to.0 - self.from.0, self.to.1 - self.from.1);
        let length = dx.hypot(dy);
        let (x, y) = if length > 0.0 { (dx / length, dy / length) } else { (1.0, 0.0) };
        (length, (x, y), (-y, x))
    }

    /// The place so far along the mark and so far beside it.
    fn at(&self, far: f64, beside: f64) -> String {
        let (_, along, across) = self.along();
        let x = self.from.0 + far * along.0 + beside * across.0;
        let y = self.from.1 + far * along.1 + beside * across.1;
        format!("{x:.1} {y:.1}")
    }

    fn zigzag(&self) -> String {
        let (length, ..) = self.along();
        let turns = ((length / APART) as usize).clamp(1, TURNS);
        let wide = SPRING.min(0.5 * length);
        let turn = |k: usize| {
            let far = length * (k as f64 + 1.0) / (turns as f64 + 1.0);
            format!("L{}", self.at(far, if k.is_multiple_of(2) { wide } else { -wide }))
        };
        let turns: String = (0..turns).map(turn).collect();
        format!("M{}{turns}L{}", self.at(0.0, 0.0), self.at(length, 0.0))
    }

    /// An arc beside the line, which bodies may cover; a loop where there is hardly a line.
    fn bow(&self) -> String {
        let (length, ..) = self.along();
        if length < LOOP {
            let arc = |sign: f64| format!("a{LOOP} {LOOP} 0 1 0 {} 0", sign * 2.0 * LOOP);
            return format!("M{}{}{}", self.at(0.0, 0.0), arc(1.0), arc(-1.0));
        }
        let middle = self.at(0.5 * length, -0.35 * length);
        format!("M{}Q{middle} {}", self.at(0.0, 0.0), self.at(length, 0.0))
    }

    /// With so many heads, as moments have two; a ring for each where it lies along the eye.
    fn arrow(&self, heads: usize) -> String {
        let (length, ..) = self.along();
        let [long, wide] = HEAD;
        if length < long {
            let (x, y) = self.to;
            let ring = |k: usize| {
                let r = wide * (k as f64 + 1.0);
                format!(
                    "M{:.1} {y:.1}a{r} {r} 0 1 0 {} 0a{r} {r} 0 1 0 {} 0",
                    x - r,
                    2.0 * r,
                    -2.0 * r
                )
            };
            return (0..heads).map(ring).collect();
        }
        let head = |k: usize| {
            let tip = length - 0.7 * long * k as f64;
            let [left, right] = [wide, -wide].map(|beside| self.at(tip - long, beside));
            format!("M{left}L{}L{right}", self.at(tip, 0.0))
        };
        let heads: String = (0..heads).map(head).collect();
        format!("M{}L{}{heads}", self.at(0.0, 0.0), self.at(length, 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The path of a mark that is so long, from (10, 20) to the right.
    fn path(kind: Kind, length: f64) -> String {
        let mut text = String::new();
        Mark { kind, from: (10.0, 20.0), to: (10.0 + length, 20.0) }.write(&mut text);
        let (_, after) = text.split_once(" d=\"").expect("a path");
        after.split_once('"').expect("its end").0.to_owned()
    }

    #[test]
    fn a_short_spring_has_few_turns_within_its_length() {
        let turns = |path: &str| path.matches('L').count() - 1;
        assert_eq!(
            [3.0, 12.0, 20.0, 200.0].map(|length| turns(&path(Kind::KickOff, length))),
            [1, 2, 4, 7]
        );
        assert_eq!(path(Kind::KickOff, 4.0), "M10.0 20.0L12.0 22.0L14.0 20.0");
        assert_eq!(path(Kind::KickOff, 0.0), "M10.0 20.0L10.0 20.0L10.0 20.0");
    }

    #[test]
    fn what_has_no_length_on_paper_is_round() {
        let is_round = |kind, length| path(kind, length).contains('a');
        for kind in [Kind::Coupling, Kind::Force, Kind::Torque] {
            assert!(is_round(kind, 0.0) && !is_round(kind, 40.0), "{}", kind.words());
        }
        // A moment has two rings, as it has two heads.
        assert_eq!(
            [Kind::Force, Kind::Torque].map(|kind| path(kind, 1.0).matches('M').count()),
            [1, 2]
        );
    }
}
