use nboom_scalar::{Vec3, Wrench};

use crate::max_von_mises::max_von_mises;
use crate::ordinates::Ordinates;
use crate::{
    Point, PointStress, Properties, SecondMoments, SectionError, SectionWarning, Stress, Wall,
    WallStress, outline, shear_flow,
};

/// A closed thin-walled section with one cell and plane walls.
///
/// Three vertices or more, convex or not, numbered in either direction; the η axis may be anywhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    walls: Vec<Wall>,
    properties: Properties,
    signed_area: f64,
    axis_points: Box<[Option<(usize, f64)>; 4]>,
    ordinates: Ordinates,
}

impl Polygon {
    /// The section with these vertices on the middle line of its walls, from the η axis; wall i, of
    /// thickness i, joins vertex i to the next one, the last to the first.
    ///
    /// # Errors
    /// Everything that is wrong with the numbers, else with the walls, else with the outline.
    pub fn new(vertices: &[Point], thickness: &[f64]) -> Result<Self, Vec<SectionError>> {
        let mut walls = outline::walls(vertices, thickness)?;
        let signed_area = outline::signed_area(&walls);
        let centroid = centroid(&walls);
        let centreline_inertia = SecondMoments::of_walls(&walls, centroid, 0.0);
        let shear_centre =
            centroid + shear_flow::solve(&mut walls, centroid, centreline_inertia, signed_area);
        let flexibility: f64 = walls.iter().map(|wall| wall.length() / wall.thickness()).sum();
        let properties = Properties {
            area: walls.iter().map(Wall::area).sum(),
            centroid,
            inertia: SecondMoments::of_walls(&walls, centroid, 1.0),
            centreline_inertia,
            enclosed_area: signed_area.abs(),
            torsion_constant: 4.0 * signed_area * signed_area / flexibility,
            shear_centre,
        };
        if !properties.are_regular() {
            return Err(vec![SectionError::Range]);
        }
        let axes = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
        let axis_point = |(xi, zeta)| axis_point(&walls, centroid, Point { xi, zeta });
        let axis_points = Box::new(axes.map(axis_point));
        let ordinates = Ordinates::NONE;
        let mut polygon = Self { walls, properties, signed_area, axis_points, ordinates };
        let number = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 };
        polygon.ordinates = Ordinates::new(polygon.walls.len(), |j, wall| {
            polygon.described_by(std::array::from_fn(|i| number(i, j))).wall(wall)
        });
        Ok(polygon)
    }

    /// Its walls, in their order.
    pub fn walls(&self) -> &[Wall] {
        &self.walls
    }

    /// Its properties.
    pub fn properties(&self) -> &Properties {
        &self.properties
    }

    /// The enclosed area, negative where vertices are numbered from ζ towards ξ.
    pub fn signed_area(&self) -> f64 {
        self.signed_area
    }

    /// Whether thin-wall theory may not hold, by the thickest wall.
    ///
    /// Walls are thin if they are against the way to the walls across the cell; how long each is means
    /// nothing, since a round wall may be many. The mean radius stands for that way: the radius of a circle,
    /// half the side of a square, the gap between two flat walls.
    pub fn warnings(&self) -> Vec<SectionWarning> {
        let perimeter: f64 = self.walls.iter().map(Wall::length).sum();
        let mean_radius = 2.0 * self.properties.enclosed_area / perimeter;
        let ratios = self.walls.iter().map(|wall| wall.thickness() / mean_radius).enumerate();
        // Of walls that are alike, the first.
        let thickest = ratios.reduce(|a, b| if b.1 > a.1 { b } else { a });
        thickest
            .and_then(|(wall, ratio)| SectionWarning::of_wall(wall, ratio))
            .into_iter()
            .collect()
    }

    /// A load about the centroid instead of the point on the η axis, eq. (11.7), corrected: note 22.
    pub fn about_centroid(&self, load: &Wrench<f64>) -> Wrench<f64> {
        let Point { xi, zeta } = self.properties.centroid;
        load.seen_from(Vec3::new(-xi, 0.0, -zeta))
    }

    /// The stresses under a load: force and moment, about the point on the η axis, that act on the
    /// part outboard of the section.
    pub fn stresses(&self, load: &Wrench<f64>) -> PolygonStresses<'_> {
        let Wrench { force, moment } = self.about_centroid(load);
        let Properties { area, inertia, .. } = self.properties;
        // The face that points outboard belongs to the inboard part, so it bears the reaction.
        PolygonStresses {
            polygon: self,
            mean: -force.y / area,
            gradient: inertia.solve(-moment.z, moment.x),
            shear: Point { xi: -force.x, zeta: -force.z },
            torsion: -moment.y,
        }
    }

    /// The stresses that these numbers describe, see [`PolygonStresses::numbers`].
    pub fn described_by(&self, numbers: [f64; 6]) -> PolygonStresses<'_> {
        let [mean, by_xi, by_zeta, shear_xi, shear_zeta, torsion] = numbers;
        PolygonStresses {
            polygon: self,
            mean,
            gradient: Point { xi: by_xi, zeta: by_zeta },
            shear: Point { xi: shear_xi, zeta: shear_zeta },
            torsion,
        }
    }

    /// The axis points at 0, 90, 180 and 270 degrees from ξ towards ζ, as a wall and a place on it:
    /// where rays from the centroid leave the section. A section that is not convex may lack some.
    pub fn axis_points(&self) -> [Option<(usize, f64)>; 4] {
        *self.axis_points
    }
}

/// Where the ray from the centroid along an axis leaves the section: the outermost crossing, as a
/// wall and a place on it. A vertex belongs to the wall that starts there.
fn axis_point(walls: &[Wall], centroid: Point, ray: Point) -> Option<(usize, f64)> {
    let none = outline::coincidence(walls);
    let across = |point: Point| {
        let offset = ray.cross(point - centroid);
        if offset.abs() <= none { 0.0 } else { offset }
    };
    let crossing = |(i, wall): (usize, &Wall)| {
        let (start, end) = (across(wall.start()), across(wall.at(1.0)));
        let crosses = start == 0.0 || start * end < 0.0;
        let x = if start == 0.0 { 0.0 } else { start / (start - end) };
        let distance = ray.dot(wall.at(x) - centroid);
        (crosses && distance > 0.0).then_some((i, x, distance))
    };
    let crossings = walls.iter().enumerate().filter_map(crossing);
    crossings.max_by(|a, b| a.2.total_cmp(&b.2)).map(|(i, x, _)| (i, x))
}

/// Relative to the first vertex, so that a distant η axis costs no digits.
fn centroid(walls: &[Wall]) -> Point {
    let from = walls[0].start();
    let moment = |wall: &Wall| (wall.at(0.5) - from) * wall.area();
    let area: f64 = walls.iter().map(Wall::area).sum();
    from + walls.iter().map(moment).fold(Point::ORIGIN, |sum, one| sum + one) * (1.0 / area)
}

/// Stresses in a polygon under one load.
#[derive(Clone, Copy, Debug)]
pub struct PolygonStresses<'a> {
    polygon: &'a Polygon,
    /// Normal stress at the centroid, and its gradient.
    mean: f64,
    gradient: Point,
    /// Shear force and moment about η through the centroid, on the inboard part.
    shear: Point,
    torsion: f64,
}

impl PolygonStresses<'_> {
    /// The numbers that determine them, linear in the load: the normal stress at the centroid, its
    /// gradient, shear force and torsion moment on the inboard part.
    pub fn numbers(&self) -> [f64; 6] {
        let Self { mean, gradient, shear, torsion, .. } = *self;
        [mean, gradient.xi, gradient.zeta, shear.xi, shear.zeta, torsion]
    }

    /// The stress along a wall, from 0; eqs. (11.8) to (11.10), corrected: note 22, and the exact
    /// flow of the closed cell instead of eqs. (11.12) to (11.15), note 23.
    ///
    /// # Panics
    /// When there is no such wall.
    pub fn wall(&self, wall: usize) -> WallStress {
        let wall = &self.polygon.walls[wall];
        let flows = &wall.flows;
        let shear = std::array::from_fn(|power| {
            let torsion = if power == 0 { self.torsion * flows.torsion } else { 0.0 };
            let forces = self.shear.xi * flows.xi[power] + self.shear.zeta * flows.zeta[power];
            (forces + torsion) / wall.thickness()
        });
        WallStress {
            normal: [self.normal_at(wall.start()), self.gradient.dot(wall.along())],
            shear,
            direction: wall.along() * (1.0 / wall.length()),
        }
    }

    /// Normal stress anywhere in the walls, also off their middle line.
    pub fn normal_at(&self, place: Point) -> f64 {
        self.mean + self.gradient.dot(place - self.polygon.properties.centroid)
    }

    /// Shear flow by torsion alone, positive along the numbering; eq. (11.11).
    pub fn torsion_flow(&self) -> f64 {
        self.torsion * self.polygon.walls[0].flows.torsion
    }

    /// The wall, from 0, and the place on it where the von Mises stress is largest.
    pub fn max_von_mises(&self) -> (usize, f64) {
        let (_, squares) = self.polygon.ordinates.squares(self.numbers());
        max_von_mises(squares)
    }

    /// Whether bounds show that the von Mises stress is nowhere above `level`; cheaper than the search
    /// for the largest, and seldom undecided.
    pub fn is_at_most(&self, level: f64) -> bool {
        let (unit, mut squares) = self.polygon.ordinates.squares(self.numbers());
        let level = level / unit;
        let is_level = level >= 0.0 && unit.is_finite();
        is_level && squares.all(|square| square.is_at_most(level * level))
    }

    /// The stress on the point's wall where it is nearest to the point.
    pub fn near(&self, point: &PointStress) -> Stress {
        let number = point.wall.unwrap_or(0);
        self.wall(number).at(self.polygon.walls[number].nearest(point.place))
    }

    /// The stresses at the polygon's axis points.
    pub fn axis_points(&self) -> [Option<PointStress>; 4] {
        self.polygon.axis_points().map(|place| place.map(|(wall, x)| self.at(wall, x)))
    }

    /// The stress at a place of a wall.
    pub fn at(&self, wall: usize, x: f64) -> PointStress {
        let place = self.polygon.walls[wall].at(x);
        PointStress { place, wall: Some(wall), stress: self.wall(wall).at(x) }
    }
}
