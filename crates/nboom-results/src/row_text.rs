use std::io::{self, Write};

use nboom_model::HingeLabel;
use nboom_scalar::Wrench;
use nboom_sections::{Point, Stress};
use nboom_strength::StationStress;

use crate::number::{field, number, vector_fields};
use crate::signs::StressSigns;

/// Names of the four axis points in `stress.csv`.
const AXIS_POINTS: [&str; 4] = ["0", "90", "180", "270"];

/// Parts that several rows share, kept as text so that they are formatted once.
#[derive(Debug, Default)]
pub(crate) struct RowText {
    /// Of stresses.
    signs: StressSigns,
    /// Time and event.
    instant: Vec<u8>,
    /// Of each row of a time in `stress.csv`.
    heads: Vec<Head>,
    /// Of each row of a time in `hinge_loads.csv`: appendage and segment.
    hinge_heads: Vec<String>,
    /// Load of a station, to the end of the row.
    load: Vec<u8>,
}

/// Where a row of stresses is: appendage, segment, station, point and place.
#[derive(Debug)]
struct Head {
    place: Point,
    text: Vec<u8>,
}

impl RowText {
    pub fn new(signs: StressSigns, hinges: &[HingeLabel]) -> Self {
        let head = |hinge: &HingeLabel| {
            let [appendage, segment] = hinge.numbers();
            format!(",{appendage},{segment}")
        };
        Self { signs, hinge_heads: hinges.iter().map(head).collect(), ..Self::default() }
    }

    /// σ₂₂, σ₂₁ and σ₂₃ as they are written.
    pub fn components(&self, stress: Stress) -> [f64; 3] {
        self.signs.components(stress)
    }

    /// The rows that are added next have this time and event.
    pub fn set_instant(&mut self, time: f64, event: &str) -> io::Result<()> {
        self.instant.clear();
        number(&mut self.instant, time)?;
        write!(self.instant, ",{event}")
    }

    /// The rows that are added next have this time and the hinge that locks or hits its stop then.
    pub fn set_struck(&mut self, time: f64, hinge: &HingeLabel) -> io::Result<()> {
        self.instant.clear();
        number(&mut self.instant, time)?;
        let [appendage, segment] = hinge.numbers();
        write!(self.instant, ",{appendage},{segment}")
    }

    /// Rows of `stress.csv`; at each time of a run for the same stations.
    pub fn add_stresses(
        &mut self,
        out: &mut Vec<u8>,
        hinges: &[HingeLabel],
        stations: impl Iterator<Item = StationStress>,
    ) -> io::Result<()> {
        let mut row = 0;
        for station in stations {
            self.load.clear();
            load_fields(&mut self.load, &station.load)?;
            writeln!(self.load)?;
            let axis_points = AXIS_POINTS.into_iter().zip(station.axis_points);
            let points = axis_points.filter_map(|(name, point)| Some((name, point?)));
            for (name, point) in points.chain([("max", station.max_von_mises)]) {
                out.extend(&self.instant);
                out.extend(self.head(
                    row,
                    &hinges[station.segment],
                    station.station,
                    name,
                    point.place,
                )?);
                stress_fields(out, self.components(point.stress))?;
                let [largest, smallest] = self.signs.principal(point.stress);
                field(out, largest)?;
                field(out, smallest)?;
                field(out, point.stress.von_mises())?;
                out.extend(&self.load);
                row += 1;
            }
        }
        Ok(())
    }

    /// The head of a row, which is that of the previous time unless the place has moved.
    fn head(
        &mut self,
        row: usize,
        hinge: &HingeLabel,
        station: usize,
        name: &str,
        place: Point,
    ) -> io::Result<&[u8]> {
        if self.heads.len() == row {
            let nowhere = Point { xi: f64::NAN, zeta: f64::NAN };
            self.heads.push(Head { place: nowhere, text: Vec::new() });
        }
        let head = &mut self.heads[row];
        if head.place != place {
            head.place = place;
            head.text.clear();
            let [appendage, segment] = hinge.numbers();
            write!(head.text, ",{appendage},{segment},{},{name}", station + 1)?;
            place_fields(&mut head.text, place)?;
        }
        Ok(&head.text)
    }

    /// Rows of `hinge_loads.csv` or `latch_impulses.csv`.
    pub fn add_hinge_loads(&self, out: &mut Vec<u8>, loads: &[Wrench<f64>]) -> io::Result<()> {
        for (head, load) in self.hinge_heads.iter().zip(loads) {
            out.extend(&self.instant);
            out.extend(head.as_bytes());
            load_fields(out, load)?;
            writeln!(out)?;
        }
        Ok(())
    }
}

pub(crate) fn place_fields(out: &mut impl Write, place: Point) -> io::Result<()> {
    field(out, place.xi)?;
    field(out, place.zeta)
}

pub(crate) fn stress_fields(out: &mut impl Write, components: [f64; 3]) -> io::Result<()> {
    components.into_iter().try_for_each(|number| field(out, number))
}

pub(crate) fn load_fields(out: &mut impl Write, load: &Wrench<f64>) -> io::Result<()> {
    vector_fields(out, load.force)?;
    vector_fields(out, load.moment)
}
