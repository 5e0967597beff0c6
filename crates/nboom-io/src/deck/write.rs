//! A scene as a deck, where a deck has words for it.

mod appendages;
mod cards;
mod hinges;
mod inverse;
mod obstacle;
mod stations;

use nboom_model::{HingeState, MassProperties, Material, Scene};
use nboom_scalar::{Quaternion, Sym3, Vec3};

use super::values::LARGEST_COUNT;
use crate::SceneFile;
use crate::angles::{rotation_from_degrees, vector_to_radians};
use appendages::{DeckAppendage, DeckSegment};
use cards::Cards;
use hinges::as_thrust;
use inverse::{degrees, euler_degrees, euler_degrees_of_axes, nearest};
use obstacle::Obstacles;

pub use obstacle::{DeckDefect, DeckObstacle};

/// A scene as a deck.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenDeck {
    /// The text.
    pub text: String,
    /// What of the scene is not in it, in words. No motion depends on it.
    pub left_out: Vec<String>,
}

/// The text of a deck that means a scene. Bodies become segments, with axes of a deck's segments; paddles come
/// last, as a deck has them. Names are comments.
///
/// What is read from the text is the scene again. Numbers that a deck counts otherwise may differ by
/// rounding: angles that are no number of degrees, attitudes and turned axes, positions of a turned main
/// body, directions.
///
/// # Errors
/// Everything that a deck cannot say.
pub fn write_deck(file: &SceneFile) -> Result<WrittenDeck, Vec<DeckObstacle>> {
    let scene = &file.scene;
    let mut obstacles = Obstacles { scene, found: Vec::new() };
    let appendages = appendages::find(scene, &mut obstacles);
    hinges::check(scene, &mut obstacles);
    if scene.bodies.len() > LARGEST_COUNT {
        obstacles.add(LARGEST_COUNT, "body", DeckDefect::Bodies(scene.bodies.len()));
    }
    let structure = file.structure.as_ref().filter(|structure| structure.has_stations());
    if let Some(structure) = structure {
        stations::check(structure, &appendages, &mut obstacles);
    }
    if !obstacles.found.is_empty() {
        return Err(obstacles.found);
    }
    let segments: Vec<&DeckSegment> = appendages.iter().flat_map(|a| &a.segments).collect();
    let left_out = left_out(file, &segments);
    let mut cards = Cards::default();
    for (number, segment) in segments.iter().enumerate() {
        let name = scene.name_of(segment.body).into_iter();
        name.for_each(|name| cards.comment(&format!("Segment {}: {name}", number + 1)));
    }
    cards.group("&DIM", |cards| dimensions(cards, file, &appendages));
    cards.group("&NXPUT", |cards| {
        let interval = structure.map(|_| file.legacy.stress_interval.max(1));
        interval.into_iter().for_each(|every| cards.integers("INSTR", &[every]));
        main_body(cards, scene);
        frames(cards, &appendages);
        bodies(cards, scene, &segments);
        hinges::write(cards, scene, &segments);
        surroundings(cards, scene);
    });
    if let Some(structure) = structure {
        stations::write(&mut cards, structure, &segments);
    }
    cards.group("&ROCK", |cards| times(cards, file, &segments));
    Ok(WrittenDeck { text: cards.text, left_out })
}

fn left_out(file: &SceneFile, segments: &[&DeckSegment]) -> Vec<String> {
    let SceneFile { scene, settings, structure, .. } = file;
    let mut left_out = Vec::new();
    let mut add = |is_there: bool, what: &str| left_out.extend(is_there.then(|| what.to_owned()));
    let has_names = segments.iter().any(|segment| scene.name_of(segment.body).is_some());
    add(has_names, "names of bodies, but as comments");
    add(settings.units.is_some(), "names of units");
    add(settings.sampling.is_some(), "output times");
    let is_asked = settings.table.is_some() || settings.hinge_loads || settings.listing;
    add(is_asked, "columns and files that are asked for");
    let shapes = scene.shapes();
    let has_shape = shapes.main_body.is_some() || shapes.bodies.iter().any(Option::is_some);
    add(has_shape, "shapes, which pictures show");
    let has_strength =
        |material: &Material| material.yield_stress.is_some() || material.ultimate_stress.is_some();
    let mut materials = structure.iter().flat_map(|structure| structure.materials());
    add(materials.any(has_strength), "strengths of materials");
    add(!settings.parameters.is_empty(), "parameters; the deck has their values");
    let pulses = structure.as_ref().is_some_and(|structure| !structure.has_stations());
    add(pulses, "pulse constants, which a deck has beside stations only");
    let is_moved = |segment: &&DeckSegment| {
        let end = segment.axes.column(1) * segment.length;
        (scene.bodies[segment.body].tip - end).norm() > 1e-9 * segment.length
    };
    add(segments.iter().any(is_moved), "outer ends off their segment, which pictures show");
    if !segments.iter().map(|segment| segment.body).is_sorted() {
        add(
            true,
            "the order of appendages: paddles come last in a deck, and have the last numbers",
        );
    }
    left_out
}

fn dimensions(cards: &mut Cards, file: &SceneFile, appendages: &[DeckAppendage]) {
    let paddles = appendages.iter().filter(|appendage| appendage.is_paddle).count();
    cards.integers("NA", &[appendages.len()]);
    cards.integers("NP", &[paddles]);
    cards.integers("IXK", &[file.scene.bodies.len()]);
    let plots = file.legacy.plots.map(|plots| usize::from(!plots));
    plots.into_iter().for_each(|no_plots| cards.integers("NOPLT", &[no_plots]));
}

fn main_body(cards: &mut Cards, scene: &Scene) {
    let MassProperties { mass, center_of_mass, inertia } = &scene.main_body;
    cards.values("EMM", &[*mass]);
    cards.values("HM", &matrix(inertia));
    cards.unless_zero("BBM", &center_of_mass.to_array());
    let initial = &scene.initial;
    let attitude = initial.attitude;
    let angles = euler_degrees(&attitude.to_matrix(), |read| {
        let read = Quaternion::from_matrix(read);
        // A quaternion and its opposite are one attitude.
        let apart = |sign: f64| {
            let vector = (read.vector - attitude.vector * sign).norm();
            vector.max((read.scalar - attitude.scalar * sign).abs())
        };
        apart(1.0).min(apart(-1.0))
    });
    cards.unless_zero("FTSM", &angles.to_array());
    let rates = initial.omega_body.map(degrees);
    cards.unless_zero("OMEG", &rates.to_array());
    // As the reader turns them, with the angles and rates that it finds.
    let rotation = rotation_from_degrees(angles.x, angles.y, angles.z);
    let rotation = Quaternion::from_matrix(&rotation).to_matrix();
    let (position, velocity) = (initial.position_inertial, initial.velocity_inertial);
    let rho = rotation.transpose_mul(position);
    let rho = nearest(rho, |rho| (rotation * rho - position).norm());
    cards.unless_zero("RHO", &rho.to_array());
    let carried = vector_to_radians(rates).cross(rho);
    let rate = rotation.transpose_mul(velocity) - carried;
    let rate = nearest(rate, |rate| (rotation * (rate + carried) - velocity).norm());
    cards.unless_zero("VBAR", &rate.to_array());
}

fn frames(cards: &mut Cards, appendages: &[DeckAppendage]) {
    let counts: Vec<usize> = appendages.iter().map(|a| a.segments.len()).collect();
    cards.integers("NK", &counts);
    cards.values("DBK", &vectors(appendages, |appendage| appendage.point));
    cards.values("FTSIK", &vectors(appendages, |appendage| euler_degrees_of_axes(&appendage.axes)));
}

fn bodies(cards: &mut Cards, scene: &Scene, segments: &[&DeckSegment]) {
    let properties: Vec<MassProperties> =
        segments.iter().map(|s| s.along(&scene.bodies[s.body].mass_properties)).collect();
    cards.values("ELIK", &numbers(segments, |segment| segment.length));
    cards.values("EMIK", &numbers(&properties, |body| body.mass));
    let inertias: Vec<f64> = properties.iter().flat_map(|body| matrix(&body.inertia)).collect();
    cards.values("HIIK", &inertias);
    for (j, name) in ["CNIK(1,1)", "CNIK(1,2)", "CNIK(1,3)"].into_iter().enumerate() {
        cards.unless_zero(name, &numbers(&properties, |body| body.center_of_mass.to_array()[j]));
    }
}

fn surroundings(cards: &mut Cards, scene: &Scene) {
    let direction = |vector: Vec3<f64>| {
        let to_unit = |vector: Vec3<f64>| vector * (1.0 / vector.norm());
        let unit = to_unit(vector);
        nearest(unit, |near| (to_unit(near) - unit).norm()).to_array()
    };
    if let Some((thrust, times)) = scene.externals.first().and_then(as_thrust) {
        cards.values("FT", &[thrust.amount.norm()]);
        cards.values("FTHAT", &direction(thrust.amount));
        cards.unless_zero("FTBAR", &thrust.point.to_array());
        let [on, off] = times.map(|time| time.clamp(f64::MIN, f64::MAX));
        cards.values("TINT", &[on]);
        cards.values("TFIN", &[off]);
    }
    if let Some(gravity) = scene.gravity.filter(|gravity| gravity.acceleration != 0.0) {
        cards.values("G", &[gravity.acceleration.abs()]);
        cards.values("GHAT", &direction(gravity.up * gravity.acceleration.signum()));
    }
}

fn times(cards: &mut Cards, file: &SceneFile, segments: &[&DeckSegment]) {
    let SceneFile { scene, legacy, .. } = file;
    cards.unless_zero("TZO", &[scene.initial.time]);
    cards.values("TF", &[scene.end_time]);
    let states = segments.iter().map(|s| match scene.bodies[s.body].hinge.start.state {
        HingeState::Unreleased => 0,
        // No hinge starts stuck.
        HingeState::Free | HingeState::Stuck => 1,
        HingeState::Locked => 2,
    });
    cards.integers("SEGSTT", &states.collect::<Vec<usize>>());
    let steps = [
        ("HZO", legacy.first_step),
        ("EU1", legacy.upper_error),
        ("EL1", legacy.lower_error),
        ("HMIN", legacy.min_step),
        ("HMAX", legacy.max_step),
    ];
    for (name, value) in steps {
        value.into_iter().for_each(|value| cards.values(name, &[value]));
    }
    for (name, count) in [("LSTEP", legacy.max_steps), ("IAX", legacy.print_interval)] {
        count.into_iter().for_each(|count| cards.integers(name, &[count]));
    }
}

impl DeckSegment {
    /// Mass properties along the segment axes.
    fn along(&self, body: &MassProperties) -> MassProperties {
        let center_of_mass = self.axes.transpose_mul(body.center_of_mass);
        let inertia = body.inertia.rotated(&self.axes.transpose());
        MassProperties::new(body.mass, center_of_mass, inertia)
    }
}

/// A number of each of several.
fn numbers<T>(all: &[T], number: impl FnMut(&T) -> f64) -> Vec<f64> {
    all.iter().map(number).collect()
}

/// A vector of each of several, one after the other.
fn vectors<T>(all: &[T], mut vector: impl FnMut(&T) -> Vec3<f64>) -> Vec<f64> {
    all.iter().flat_map(|one| vector(one).to_array()).collect()
}

/// A symmetric matrix as decks have it.
fn matrix(inertia: &Sym3<f64>) -> [f64; 9] {
    let Sym3 { xx, yy, zz, xy, xz, yz } = *inertia;
    [xx, xy, xz, xy, yy, yz, xz, yz, zz]
}
