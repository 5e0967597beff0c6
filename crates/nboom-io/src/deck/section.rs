use nboom_model::{Finding, SectionShape, Vertex};
use nboom_sections::{Section, SectionError, SectionWarning};

use super::assignment::MOST_STATIONS;
use super::builder::Builder;
use super::values::{Key, plain};

/// Vertices of a section, at most.
pub(super) const MOST_VERTICES: usize = 6;

/// The place of a section in the stress groups: segment and station, from 0.
#[derive(Clone, Copy)]
struct StationNumber {
    segment: usize,
    station: usize,
}

impl Builder<'_, '_, '_> {
    /// The section of station `j` of segment `i`, both from 0. Its errors are reported, and walls
    /// for which thin-wall theory may not hold give a warning.
    pub fn section(&mut self, i: usize, j: usize) -> SectionShape {
        let place = StationNumber { segment: i, station: j };
        let reported = self.report.errors.len();
        let shape = self.shape(place);
        // Missing numbers have stand-ins, whose outline means nothing.
        if self.report.errors.len() > reported {
            return shape;
        }
        match Section::of_shape(&shape) {
            Ok(section) => {
                for warning in section.warnings() {
                    let Finding { found, expected } = warning.finding();
                    let (key, index) = place.of_warning(warning);
                    self.warn(key, index, found, &expected);
                }
            }
            Err(errors) => {
                for error in errors {
                    let (key, index) = place.of_error(&error, &shape);
                    let Finding { found, expected } = error.finding();
                    self.error(key, index, found, &expected);
                }
            }
        }
        shape
    }

    fn shape(&mut self, place: StationNumber) -> SectionShape {
        let StationNumber { segment: i, station: j } = place;
        if self.values.real("ICIR", i) == 0.0 {
            let (radius, thickness) = (place.radius(), place.of_vertex("T", 0));
            let vertices = thickness.1..thickness.1 + MOST_VERTICES;
            let since = format!("ICIR({}) is 0, a tube", i + 1);
            self.warn_ignored_elements(thickness.0, vertices.start + 1..vertices.end, &since);
            for name in ["XI", "ZETA"] {
                self.warn_ignored_elements((name, i + 1, 0), vertices.clone(), &since);
            }
            return SectionShape::Tube {
                radius: self.positive_element(radius.0, radius.1),
                thickness: self.positive_element(thickness.0, thickness.1),
            };
        }
        let count = self.count_in("NVER", MOST_STATIONS * i + j, 3..=MOST_VERTICES);
        let (radius, index) = place.radius();
        let since = format!("ICIR({}) is not 0, a polygon", i + 1);
        self.warn_ignored_elements(radius, index..index + 1, &since);
        let since = format!("NVER({},{}) is {count}", j + 1, i + 1);
        for name in ["T", "XI", "ZETA"] {
            let (key, first) = place.of_vertex(name, 0);
            self.warn_ignored_elements(key, first + count..first + MOST_VERTICES, &since);
        }
        let vertices = (0..count).map(|vertex| {
            let [(xi, first), (zeta, _)] = ["XI", "ZETA"].map(|name| place.of_vertex(name, vertex));
            let coordinate = |key| self.values.cell(key, first).map_or(0.0, |cell| cell.value);
            let (xi, zeta) = (coordinate(xi), coordinate(zeta));
            let (walls, wall) = place.of_vertex("T", vertex);
            Vertex { xi, zeta, thickness: self.positive_element(walls, wall) }
        });
        SectionShape::Polygon(vertices.collect())
    }
}

impl StationNumber {
    fn radius(self) -> (Key, usize) {
        (plain("R"), MOST_STATIONS * self.segment + self.station)
    }

    /// A number of a vertex, or of the wall that starts there.
    fn of_vertex(self, name: &'static str, vertex: usize) -> (Key, usize) {
        ((name, self.segment + 1, 0), MOST_VERTICES * self.station + vertex)
    }

    /// The symbol and the element in storage order.
    fn of_error(self, error: &SectionError, shape: &SectionShape) -> (Key, usize) {
        match *error {
            SectionError::Radius { .. } => self.radius(),
            SectionError::TubeThickness { .. } => self.of_vertex("T", 0),
            SectionError::Thickness { wall, .. } => self.of_vertex("T", wall),
            SectionError::Vertex { vertex, .. } => self.of_vertex("XI", vertex),
            SectionError::ZeroLengthWall { next, .. } => self.of_vertex("XI", next),
            SectionError::Crossing { other, .. } => self.of_vertex("XI", other),
            _ => match shape {
                SectionShape::Tube { .. } => self.radius(),
                SectionShape::Polygon(_) => self.of_vertex("XI", 0),
            },
        }
    }

    fn of_warning(self, warning: SectionWarning) -> (Key, usize) {
        match warning {
            SectionWarning::ThickWall { wall, .. } => self.of_vertex("T", wall),
            _ => self.of_vertex("T", 0),
        }
    }
}
