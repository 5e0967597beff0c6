use nboom_model::{SectionShape, SegmentStructure, Station, Structure, Vertex};
use nboom_scalar::Mat3;

use super::super::assignment::MOST_STATIONS;
use super::super::section::MOST_VERTICES;
use super::appendages::{DeckAppendage, DeckSegment, ROUNDING};
use super::cards::Cards;
use super::obstacle::{DeckDefect, Obstacles};
use super::{matrix, numbers};

/// Reports what a deck cannot say of stations.
pub(super) fn check(
    structure: &Structure,
    appendages: &[DeckAppendage],
    obstacles: &mut Obstacles<'_>,
) {
    for segment in appendages.iter().flat_map(|appendage| &appendage.segments) {
        let departure = segment.axes - Mat3::identity();
        let is_turned = departure.rows.iter().any(|row| row.norm() > ROUNDING);
        let stations = &structure.segments()[segment.body].stations;
        if is_turned && !stations.is_empty() {
            obstacles.add(segment.body, "station", DeckDefect::StationAxes);
        }
    }
    for (i, SegmentStructure { stations, .. }) in structure.segments().iter().enumerate() {
        let mut add = |defect| obstacles.add(i, "station", defect);
        if !(1..=MOST_STATIONS).contains(&stations.len()) {
            add(DeckDefect::Stations(stations.len()));
        }
        let tubes = stations.iter().filter(|station| is_tube(station)).count();
        if ![0, stations.len()].contains(&tubes) {
            add(DeckDefect::Sections);
        }
        let corners = stations.iter().map(|station| vertices(station).len());
        corners.filter(|count| *count > MOST_VERTICES).for_each(|n| add(DeckDefect::Corners(n)));
    }
}

fn is_tube(station: &Station) -> bool {
    matches!(station.section, SectionShape::Tube { .. })
}

fn vertices(station: &Station) -> &[Vertex] {
    match &station.section {
        SectionShape::Tube { .. } => &[],
        SectionShape::Polygon(vertices) => vertices,
    }
}

/// The stress groups.
pub(super) fn write(cards: &mut Cards, structure: &Structure, segments: &[&DeckSegment]) {
    let structures: Vec<&SegmentStructure> =
        segments.iter().map(|segment| &structure.segments()[segment.body]).collect();
    cards.group("&DYNSTA", |cards| {
        let counts = |count: fn(&SegmentStructure) -> usize| -> Vec<usize> {
            structures.iter().map(|structure| count(structure)).collect()
        };
        cards.integers("NSTA", &counts(|structure| structure.stations.len()));
        let polygons = counts(|structure| usize::from(!structure.stations.iter().any(is_tube)));
        cards.integers("ICIR", &polygons);
        let of_vertices = of_stations(&structures, |station| vertices(station).len() as f64);
        cards.unless_zero("NVER", &of_vertices);
        cards.values("S", &of_stations(&structures, |station| station.distance_from_hinge));
        cards.values("DELM", &of_stations(&structures, |station| station.slice.mass));
        cards.unless_zero("R", &of_stations(&structures, |station| tube(station)[0]));
        for (number, structure) in (1..).zip(&structures) {
            section(cards, number, &structure.stations);
        }
        cards.values("CMN", &numbers(&structures, |structure| structure.pulse_constant));
        cards.values("XNU", &numbers(&structures, |structure| structure.material.poissons_ratio));
        cards.values("E", &numbers(&structures, |structure| structure.material.youngs_modulus));
    });
    cards.group("&DYNSTB", |cards| {
        for (number, structure) in (1..).zip(&structures) {
            for (j, station) in (1..).zip(&structure.stations) {
                let inertia = matrix(&station.slice.inertia);
                cards.unless_zero(&format!("DLI{number}{j}"), &inertia);
            }
        }
    });
}

/// Mass centres of the slices, walls and corners of one segment.
fn section(cards: &mut Cards, number: usize, stations: &[Station]) {
    let centers = stations.iter().flat_map(|station| station.slice.center_of_mass.to_array());
    cards.unless_zero(&format!("DELC{number}"), &centers.collect::<Vec<_>>());
    let walls = |of_vertex: fn(&Vertex) -> f64, of_tube: fn(&Station) -> f64| -> Vec<f64> {
        let row = |station: &Station| {
            let mut row = [of_tube(station), 0.0, 0.0, 0.0, 0.0, 0.0];
            let corners = vertices(station).iter().map(of_vertex);
            row.iter_mut().zip(corners).for_each(|(place, number)| *place = number);
            row
        };
        stations.iter().flat_map(row).collect()
    };
    cards.values(&format!("T{number}"), &walls(|vertex| vertex.thickness, |s| tube(s)[1]));
    cards.unless_zero(&format!("XI{number}"), &walls(|vertex| vertex.xi, |_| 0.0));
    cards.unless_zero(&format!("ZETA{number}"), &walls(|vertex| vertex.zeta, |_| 0.0));
}

/// Radius and thickness of a tube, zeros of a polygon.
fn tube(station: &Station) -> [f64; 2] {
    match station.section {
        SectionShape::Tube { radius, thickness } => [radius, thickness],
        SectionShape::Polygon(_) => [0.0; 2],
    }
}

/// A number of each station, with zeros for stations that a segment has not.
fn of_stations(structures: &[&SegmentStructure], number: impl Fn(&Station) -> f64) -> Vec<f64> {
    let row = |structure: &&SegmentStructure| {
        let mut row = [0.0; MOST_STATIONS];
        let numbers = structure.stations.iter().map(&number);
        row.iter_mut().zip(numbers).for_each(|(place, number)| *place = number);
        row
    };
    structures.iter().flat_map(row).collect()
}
