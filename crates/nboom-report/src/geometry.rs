//! The scene as the page draws it.

use std::path::Path;

use nboom_io::{InputError, SceneFile, read_scene};
use nboom_model::{Body, BodyShape, SectionShape, SegmentStructure, Solid, Station, UnitSystem};
use nboom_results::SCENE_FILE;
use nboom_scalar::Mat3;
use serde::Serialize;

use crate::Gap;

type Vector = [f64; 3];
/// Rows of a matrix.
type Rotation = [f64; 9];

#[derive(Serialize)]
pub(crate) struct SceneKeys {
    main_body: MainBodyKeys,
    bodies: Vec<BodyKeys>,
}

#[derive(Serialize)]
struct MainBodyKeys {
    is_held: bool,
    mass: f64,
    center: Vector,
    shape: Option<ShapeKeys>,
}

#[derive(Serialize)]
struct BodyKeys {
    appendage: usize,
    segment: usize,
    slides: bool,
    /// −1 is the main body.
    inboard: isize,
    /// The joint at coordinate zero, in the axes of the inboard body.
    point: Vector,
    rotation: Rotation,
    axis: Vector,
    tip: Vector,
    mass: f64,
    center: Vector,
    shape: Option<ShapeKeys>,
    /// Distances from the hinge, in the order of the stations.
    stations: Vec<f64>,
    /// How far sections reach from the axis.
    radius: Option<f64>,
    start_state: &'static str,
}

#[derive(Serialize)]
struct ShapeKeys {
    #[serde(flatten)]
    solid: SolidKeys,
    middle: Vector,
    axes: Rotation,
}

#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
enum SolidKeys {
    Box { sides: Vector },
    Panel { sides: Vector },
    Cylinder { radius: f64, length: f64, along: Vector },
}

/// Labels of the units of a run.
#[derive(Serialize)]
pub(crate) struct UnitKeys {
    length: String,
    time: String,
    force: String,
    torque: String,
    energy: String,
    momentum: String,
    angular_momentum: String,
    stress: String,
    speed: String,
}

impl From<&UnitSystem> for UnitKeys {
    fn from(units: &UnitSystem) -> Self {
        Self {
            length: units.length().to_owned(),
            time: units.time().to_owned(),
            force: units.force().to_owned(),
            torque: units.torque(),
            energy: units.energy(),
            momentum: units.momentum(),
            angular_momentum: units.angular_momentum(),
            stress: units.stress(),
            speed: units.speed(),
        }
    }
}

/// Reads the scene of a run, if there is one.
pub(crate) fn read(directory: &Path) -> Result<SceneFile, Gap> {
    let path = directory.join(SCENE_FILE);
    if !path.is_file() {
        return Err(Gap::Missing { file: SCENE_FILE, shows: "picture" });
    }
    read_scene(&path).map_err(|error| Gap::Scene { found: first_line(&error) })
}

fn first_line(error: &InputError) -> String {
    error.to_string().lines().next().unwrap_or_default().to_owned()
}

impl From<&SceneFile> for SceneKeys {
    fn from(file: &SceneFile) -> Self {
        let SceneFile { scene, structure, .. } = file;
        let main = &scene.main_body;
        let main_body = MainBodyKeys {
            is_held: scene.base.is_held(),
            mass: main.mass,
            center: main.center_of_mass.to_array(),
            shape: scene.shapes().main_body.as_ref().map(ShapeKeys::from),
        };
        let bodies = scene.bodies.iter().enumerate().map(|(i, body)| {
            let segment = structure.as_ref().map(|structure| &structure.segments()[i]);
            BodyKeys {
                shape: scene.shapes().of(i).map(ShapeKeys::from),
                ..BodyKeys::new(body, scene.label(i).numbers(), segment)
            }
        });
        Self { main_body, bodies: bodies.collect() }
    }
}

impl BodyKeys {
    /// Without shape.
    fn new(body: &Body, [appendage, segment]: [usize; 2], of: Option<&SegmentStructure>) -> Self {
        let stations = of.map_or(&[][..], |of| &of.stations);
        Self {
            appendage,
            segment,
            slides: body.joint.slides(),
            inboard: body.inboard.map_or(-1, |inboard| inboard as isize),
            point: body.mount.point.to_array(),
            rotation: rows(body.mount.rot_inboard_from_hinge),
            axis: body.axis.to_array(),
            tip: body.tip.to_array(),
            mass: body.mass_properties.mass,
            center: body.mass_properties.center_of_mass.to_array(),
            shape: None,
            stations: stations.iter().map(|station| station.distance_from_hinge).collect(),
            radius: stations.iter().map(reach).reduce(f64::max),
            start_state: body.hinge.start.state.name(),
        }
    }
}

/// How far a section reaches from the axis of its segment.
fn reach(station: &Station) -> f64 {
    match &station.section {
        SectionShape::Tube { radius, .. } => *radius,
        SectionShape::Polygon(corners) => {
            corners.iter().map(|corner| corner.xi.hypot(corner.zeta)).fold(0.0, f64::max)
        }
    }
}

impl From<&BodyShape> for ShapeKeys {
    fn from(shape: &BodyShape) -> Self {
        let solid = match shape.solid {
            Solid::Box(sides) => SolidKeys::Box { sides: sides.to_array() },
            Solid::Panel(sides) => SolidKeys::Panel { sides: sides.to_array() },
            Solid::Cylinder { radius, length, along } => {
                SolidKeys::Cylinder { radius, length, along: along.to_array() }
            }
        };
        Self { solid, middle: shape.middle.to_array(), axes: rows(shape.axes) }
    }
}

fn rows(matrix: Mat3<f64>) -> Rotation {
    let columns = [0, 1, 2].map(|j| matrix.column(j).to_array());
    std::array::from_fn(|i| columns[i % 3][i / 3])
}
