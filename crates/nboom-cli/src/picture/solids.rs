//! Bodies as patches that cover each other in the right order.

use std::f64::consts::TAU;
use std::fmt::Write;

use nboom_model::{BodyShape, Solid};
use nboom_scalar::{Mat3, Vec3};

use super::view::View;

/// Sides of a cylinder as it is drawn.
const SIDES: usize = 24;

/// Share of the drawing's extent that a patch may have, and most patches along an edge.
const PATCH: f64 = 0.06;
const MOST_PATCHES: usize = 8;

/// Shares of the drawing's extent by which edges stand before their faces, and panels before what they
/// lie on.
const EDGES_BEFORE: f64 = 0.5 * PATCH;
const PANELS_BEFORE: f64 = 0.2 * PATCH;

/// Red, green and blue of a lit face, from 0 to 255.
const GREY: [f64; 3] = [222.0, 222.0, 226.0];
const BLUE: [f64; 3] = [126.0, 160.0, 214.0];

const EDGE: &str = "#55585e";

/// A piece of a face or of a line, small enough to be either before or behind another one.
pub(super) struct Patch {
    points: Vec<Vec3<f64>>,
    pub depth: f64,
    colour: String,
    /// Of a line.
    width: Option<f64>,
}

impl Patch {
    fn new(points: Vec<Vec3<f64>>, colour: &str, width: Option<f64>, view: &View) -> Self {
        let sum = points.iter().fold(Vec3::zero(), |sum, point| sum + *point);
        let depth = view.depth(sum * (1.0 / points.len() as f64));
        Self { points, depth, colour: colour.to_owned(), width }
    }

    /// A line in pieces.
    pub fn line(
        from: Vec3<f64>,
        to: Vec3<f64>,
        colour: &str,
        width: f64,
        view: &View,
    ) -> Vec<Self> {
        let count = pieces((to - from).norm(), view);
        let at = |k: usize| from + (to - from) * (k as f64 / count as f64);
        let piece = |k| Self::new(vec![at(k), at(k + 1)], colour, Some(width), view);
        (0..count).map(piece).collect()
    }

    /// The patch as an element of SVG.
    pub fn write(&self, text: &mut String, view: &View) {
        let places = self.points.iter().map(|point| view.place(*point));
        let points: Vec<String> = places.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let (points, colour) = (points.join(" "), &self.colour);
        let style = match self.width {
            Some(width) => format!(
                "fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\""
            ),
            // The stroke closes the gap to the next patch.
            None => format!("fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"0.6\""),
        };
        let _ = writeln!(text, "<polygon points=\"{points}\" {style}/>");
    }
}

fn pieces(length: f64, view: &View) -> usize {
    ((length / (PATCH * view.size)).ceil() as usize).clamp(1, MOST_PATCHES)
}

/// A flat face of a solid, corners in order.
struct Face {
    corners: Vec<Vec3<f64>>,
    /// Outwards.
    normal: Vec3<f64>,
    /// Of a panel, which has only one face.
    is_two_sided: bool,
    /// Whether its edges are drawn.
    has_edges: bool,
}

/// The outermost points of a shape on a body whose origin and axes are these.
pub(super) fn corners(shape: &BodyShape, origin: Vec3<f64>, axes: Mat3<f64>) -> Vec<Vec3<f64>> {
    faces(shape, origin, axes).into_iter().flat_map(|face| face.corners).collect()
}

/// What is seen of a shape on a body whose origin and axes are these.
pub(super) fn patches(
    shape: &BodyShape,
    origin: Vec3<f64>,
    axes: Mat3<f64>,
    view: &View,
) -> Vec<Patch> {
    let colour = if let Solid::Panel(_) = shape.solid { BLUE } else { GREY };
    let seen = |face: &Face| face.is_two_sided || view.depth(face.normal) > 0.0;
    let all = faces(shape, origin, axes).into_iter().filter(seen);
    let mut patches: Vec<Patch> = all.flat_map(|face| of_face(&face, colour, view)).collect();
    if let Solid::Panel(_) = shape.solid {
        patches.iter_mut().for_each(|patch| patch.depth += PANELS_BEFORE * view.size);
    }
    patches
}

fn of_face(face: &Face, colour: [f64; 3], view: &View) -> Vec<Patch> {
    let colour = lit(colour, face.normal);
    let corners = &face.corners;
    let mut patches = match corners[..] {
        [a, b, c, d] => grid([a, b, c, d], &colour, view),
        _ => vec![Patch::new(corners.clone(), &colour, None, view)],
    };
    if face.has_edges {
        for (k, from) in corners.iter().enumerate() {
            let to = corners[(k + 1) % corners.len()];
            let mut edge = Patch::line(*from, to, EDGE, 0.9, view);
            edge.iter_mut().for_each(|piece| piece.depth += EDGES_BEFORE * view.size);
            patches.extend(edge);
        }
    }
    patches
}

/// A parallelogram in patches.
fn grid([a, b, _, d]: [Vec3<f64>; 4], colour: &str, view: &View) -> Vec<Patch> {
    let (along, across) = (b - a, d - a);
    let [m, n] = [along, across].map(|side| pieces(side.norm(), view));
    let at =
        |i: usize, j: usize| a + along * (i as f64 / m as f64) + across * (j as f64 / n as f64);
    let patch = |(i, j)| {
        let points = vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        Patch::new(points, colour, None, view)
    };
    (0..m).flat_map(|i| (0..n).map(move |j| (i, j))).map(patch).collect()
}

/// A colour in light from above.
fn lit(colour: [f64; 3], normal: Vec3<f64>) -> String {
    let light = Vec3::new(0.45, 0.1, 0.89);
    let share = 0.78 + 0.22 * normal.dot(light).abs();
    let [r, g, b] = colour.map(|part| (part * share).clamp(0.0, 255.0) as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn faces(shape: &BodyShape, origin: Vec3<f64>, axes: Mat3<f64>) -> Vec<Face> {
    let middle = origin + axes * shape.middle;
    let turned = axes * shape.axes;
    let place = |v: Vec3<f64>| middle + turned * v;
    let own = match shape.solid {
        Solid::Box(sides) => of_box(sides),
        Solid::Panel(sides) => vec![of_panel(sides)],
        Solid::Cylinder { radius, length, along } => of_cylinder(radius, length, along),
    };
    let placed = |face: Face| Face {
        corners: face.corners.iter().map(|corner| place(*corner)).collect(),
        normal: turned * face.normal,
        ..face
    };
    own.into_iter().map(placed).collect()
}

const UNITS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The face of a box or panel across its axis `i`, on the side of `sign`.
fn across(sides: Vec3<f64>, i: usize, sign: f64) -> Face {
    let sides = sides.to_array();
    let unit = |j: usize| Vec3::from(UNITS[j % 3]);
    let [middle, a, b] = [i, i + 1, i + 2].map(|j| unit(j) * (0.5 * sides[j % 3]));
    let corner = |(p, q)| middle * sign + a * p + b * q;
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner).to_vec();
    Face { corners, normal: unit(i) * sign, is_two_sided: false, has_edges: true }
}

fn of_box(sides: Vec3<f64>) -> Vec<Face> {
    (0..3).flat_map(|i| [1.0, -1.0].map(|sign| across(sides, i, sign))).collect()
}

fn of_panel(sides: Vec3<f64>) -> Face {
    let thin = sides.to_array().iter().position(|side| *side == 0.0).unwrap_or(2);
    Face { is_two_sided: true, ..across(sides, thin, 1.0) }
}

fn of_cylinder(radius: f64, length: f64, along: Vec3<f64>) -> Vec<Face> {
    // Any direction that is not along the axis gives one across it.
    let units = UNITS.map(Vec3::from);
    let beside = units.into_iter().min_by(|a, b| {
        let share = |unit: &Vec3<f64>| unit.dot(along).abs();
        share(a).total_cmp(&share(b))
    });
    let first = along.cross(beside.unwrap_or_else(Vec3::unit_x));
    let first = first * (1.0 / first.norm());
    let second = along.cross(first);
    let out = |k: f64| {
        let (sin, cos) = (TAU * k / SIDES as f64).sin_cos();
        first * cos + second * sin
    };
    let rim = |k: usize, end: f64| out(k as f64) * radius + along * (0.5 * end * length);
    let cap = |end: f64| Face {
        corners: (0..SIDES).map(|k| rim(k, end)).collect(),
        normal: along * end,
        is_two_sided: false,
        has_edges: true,
    };
    let side = |k: usize| Face {
        corners: vec![rim(k, -1.0), rim(k + 1, -1.0), rim(k + 1, 1.0), rim(k, 1.0)],
        normal: out(k as f64 + 0.5),
        is_two_sided: false,
        has_edges: false,
    };
    (0..SIDES).map(side).chain([cap(1.0), cap(-1.0)]).collect()
}
