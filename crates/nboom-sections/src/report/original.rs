use nboom_scalar::{Vec3, Wrench};

use super::{bending_constants, max_von_mises_of_tube, static_moments, tube_stress};
use crate::{Point, PointStress, Polygon, Section, Stress, Tube, TubeStresses, outline};

/// Most walls of a section whose last wall the original closed.
const CLOSED_WALLS: usize = 3;

/// Which slips of the program of 1970 replace the right formulas for sections; by default none.
/// `docs/the-1970-program.md` has the evidence for each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SectionSlips {
    /// Tubes bend with half of their second moment of area.
    pub tube_inertia: bool,
    /// Shear stress of forces in tubes is in absolute values, [`tube_stress`].
    pub tube_shear: bool,
    /// k₃ of eq. (11.8) is 1 − k₁/k₂, and 1 where I_ξζ is exactly zero.
    pub product_of_inertia: bool,
    /// Both bending terms of polygons have the sign against that of P₂/A.
    pub bending_signs: bool,
    /// C_ξP₂ stands for C_ξP₃ in the torsion moment about the centroid, eq. (11.7).
    pub torsion_arm: bool,
    /// The last wall of a polygon with more than three ends at the η axis, for torsion.
    pub closing_wall: bool,
    /// Shear stress of forces in polygons is that of eqs. (11.14), (12.7) and (12.8).
    pub level_shear: bool,
    /// Normal stress and torsion at an axis point of a polygon are those of the vertex before its
    /// wall, and of the wall that starts there.
    pub vertex_before: bool,
}

impl SectionSlips {
    /// Whether any of them concerns sections of this kind.
    pub fn concern(self, section: &Section) -> bool {
        let Self { tube_inertia, tube_shear, .. } = self;
        let of_tubes = Self { tube_inertia, tube_shear, ..Self::default() };
        let of_polygons = Self { tube_inertia: false, tube_shear: false, ..self };
        let of_kind = if matches!(section, Section::Tube(_)) { of_tubes } else { of_polygons };
        of_kind != Self::default()
    }
}

/// A section as the program of 1970 computed it, with those of its slips that are selected.
///
/// Points and loads are those of [`Section`]. The maximum of a polygon is searched at the starts of
/// walls, since all that Section 18 prints are vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Original {
    section: Section,
    slips: SectionSlips,
}

impl Original {
    /// `section` with these slips.
    pub fn new(section: Section, slips: SectionSlips) -> Self {
        Self { section, slips }
    }

    /// Stresses at the four axis points: at 0, 90, 180 and 270 degrees from ξ towards ζ.
    pub fn axis_points(&self, load: &Wrench<f64>) -> [Option<PointStress>; 4] {
        match &self.section {
            Section::Tube(tube) => {
                Tube::AXIS_ANGLES.map(|theta| Some(self.tube_point(tube, load, theta)))
            }
            Section::Polygon(polygon) => polygon.axis_points().map(|found| {
                let (wall, x) = found?;
                let walls = polygon.walls().len();
                let before = (wall + walls - 1) % walls;
                let listed = if self.slips.vertex_before { before } else { wall };
                let stress = self.polygon_stress(polygon, load, listed, (wall, x));
                Some(PointStress { place: polygon.walls()[wall].at(x), wall: Some(wall), stress })
            }),
        }
    }

    /// The point with the largest von Mises stress; for a polygon, the vertex.
    pub fn max_von_mises(&self, load: &Wrench<f64>) -> PointStress {
        match &self.section {
            Section::Tube(tube) => {
                let stresses = self.tube_stresses(tube, load);
                let of_report = self.slips.tube_shear;
                let theta = if of_report {
                    max_von_mises_of_tube(&stresses)
                } else {
                    stresses.max_von_mises()
                };
                self.tube_point(tube, load, theta)
            }
            Section::Polygon(polygon) => {
                let at_start = |wall: usize| {
                    let place = polygon.walls()[wall].start();
                    let stress = self.polygon_stress(polygon, load, wall, (wall, 0.0));
                    PointStress { place, wall: Some(wall), stress }
                };
                let worse = |a: PointStress, b: PointStress| {
                    if b.stress.von_mises() > a.stress.von_mises() { b } else { a }
                };
                (1..polygon.walls().len()).map(at_start).fold(at_start(0), worse)
            }
        }
    }

    /// The stress of a load at a point that [`Original::max_von_mises`] found for another load.
    pub fn at(&self, point: &PointStress, load: &Wrench<f64>) -> Stress {
        match &self.section {
            Section::Tube(tube) => {
                let theta = point.place.zeta.atan2(point.place.xi);
                self.tube_point(tube, load, theta).stress
            }
            Section::Polygon(polygon) => {
                let wall = point.wall.unwrap_or(0);
                let x = polygon.walls()[wall].nearest(point.place);
                self.polygon_stress(polygon, load, wall, (wall, x))
            }
        }
    }

    fn tube_stresses(&self, tube: &Tube, load: &Wrench<f64>) -> TubeStresses {
        let mut stresses = tube.stresses(load);
        if self.slips.tube_inertia {
            stresses.normal[1] *= 2.0;
            stresses.normal[2] *= 2.0;
        }
        stresses
    }

    fn tube_point(&self, tube: &Tube, load: &Wrench<f64>, theta: f64) -> PointStress {
        let stresses = self.tube_stresses(tube, load);
        let right = stresses.at(theta);
        let stress =
            if self.slips.tube_shear { tube_stress(&stresses, theta) } else { right.stress };
        PointStress { stress, ..right }
    }

    /// The stress listed for a place of a wall, given as wall and fraction of it, with the normal
    /// stress and torsion of the wall `listed`.
    fn polygon_stress(
        &self,
        polygon: &Polygon,
        load: &Wrench<f64>,
        listed: usize,
        (wall, x): (usize, f64),
    ) -> Stress {
        let walls = polygon.walls();
        let of_start = self.slips.vertex_before;
        let place = if of_start { walls[listed].start() } else { walls[wall].at(x) };
        let normal = self.normal(polygon, load, place);
        let torsion = self.torsion(polygon, load, listed);
        let forces = if self.slips.level_shear {
            level_shear(polygon, load.force, walls[wall].at(x))
        } else {
            shear_of_forces(polygon, load.force, wall, x)
        };
        Stress::of_report_signs([normal, torsion[0] + forces[0], torsion[1] + forces[1]])
    }

    /// σ₂₂ of eqs. (11.7) to (11.10).
    fn normal(&self, polygon: &Polygon, load: &Wrench<f64>, place: Point) -> f64 {
        let properties = polygon.properties();
        let inertia = &properties.inertia;
        let Wrench { force, moment } = polygon.about_centroid(load);
        let [k1, k2, right] = bending_constants(inertia);
        let k3 = match (self.slips.product_of_inertia, inertia.xi_zeta == 0.0) {
            (false, _) => right,
            (true, true) => 1.0,
            (true, false) => 1.0 - k1 / k2,
        };
        let about_xi = (moment.x + k1 * moment.z) / k3;
        let about_zeta = (moment.z + k2 * moment.x) / k3;
        let arm = place - properties.centroid;
        let bending = about_zeta * arm.xi / inertia.zeta_zeta - about_xi * arm.zeta / inertia.xi_xi;
        let sign = if self.slips.bending_signs { -1.0 } else { 1.0 };
        force.y / properties.area + sign * bending
    }

    /// σ₂₁ and σ₂₃ of torsion, eqs. (11.11) to (11.13).
    fn torsion(&self, polygon: &Polygon, load: &Wrench<f64>, wall: usize) -> [f64; 2] {
        let walls = polygon.walls();
        let mut moment = polygon.about_centroid(load).moment.y;
        if self.slips.torsion_arm {
            moment += polygon.properties().centroid.xi * (load.force.y - load.force.z);
        }
        let is_last = wall + 1 == walls.len();
        let way = if self.slips.closing_wall && is_last && walls.len() > CLOSED_WALLS {
            Point::ORIGIN - walls[wall].start()
        } else {
            walls[wall].along()
        };
        let flow = 0.5 * moment / polygon.signed_area();
        let stress = way * (-flow / walls[wall].area());
        [stress.xi, stress.zeta]
    }
}

/// σ₂₁ and σ₂₃ of forces by eq. (11.14): static moments of what is beyond the levels of a place, over
/// the widths there.
fn level_shear(polygon: &Polygon, force: Vec3<f64>, place: Point) -> [f64; 2] {
    let inertia = polygon.properties().inertia;
    let [of_xi, of_zeta] = static_moments(polygon, place);
    let [across_xi, across_zeta] = [|p: Point| p.xi, |p: Point| p.zeta].map(|coordinate| {
        let width = width(polygon, coordinate, coordinate(place));
        // No wall crosses an outermost level; there is nothing to shear.
        if width > 0.0 { 1.0 / width } else { 0.0 }
    });
    [
        force.x * of_xi * across_xi / inertia.zeta_zeta,
        force.z * of_zeta * across_zeta / inertia.xi_xi,
    ]
}

/// Thickness along a level of the walls that cross it.
fn width(polygon: &Polygon, coordinate: fn(Point) -> f64, level: f64) -> f64 {
    let none = outline::coincidence(polygon.walls());
    let starts = || polygon.walls().iter().map(|wall| coordinate(wall.start()));
    let is_crossed = starts().any(|c| c < level - none) && starts().any(|c| c > level + none);
    let across = polygon.walls().iter().filter_map(|wall| {
        let (start, end) = (coordinate(wall.start()), coordinate(wall.at(1.0)));
        let crosses = is_crossed && (start > level) != (end > level);
        crosses.then(|| wall.length() * wall.thickness() / (end - start).abs())
    });
    across.sum()
}

/// σ₂₁ and σ₂₃ of forces through the centroid in the closed cell.
fn shear_of_forces(polygon: &Polygon, force: Vec3<f64>, wall: usize, x: f64) -> [f64; 2] {
    let Point { xi, zeta } = polygon.properties().centroid;
    let through_centroid = Wrench::of_force(Vec3::new(xi, 0.0, zeta), force);
    let [_, along_xi, along_zeta] =
        polygon.stresses(&through_centroid).at(wall, x).stress.in_report_signs();
    [along_xi, along_zeta]
}
