use std::io::{self, Write};

use nboom_model::{Column, HingeLabel, WantedTable};
use nboom_sim::Snapshot;

use crate::Headings;
use crate::heads::motion_heads;
use crate::number::{field, number};
use crate::quantities::{Cell, cell};

/// Writes a table of the motion, one row for each output time: the table of states, or one that
/// somebody asks for.
#[derive(Debug)]
pub struct StatesWriter<W> {
    out: W,
    columns: Vec<Column>,
    /// Which of them are in degrees.
    in_degrees: Vec<bool>,
}

impl<W: Write> StatesWriter<W> {
    /// Writes the header of the table of states for hinges with these labels: all columns, angles
    /// in radians.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn new(out: W, hinges: &[HingeLabel]) -> io::Result<Self> {
        Self::of(out, hinges, WantedTable::states(hinges.len()), &Headings::default())
    }

    /// Writes the header of this table. Names of columns in degrees end in `_deg`.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn of(
        mut out: W,
        hinges: &[HingeLabel],
        table: WantedTable,
        headings: &Headings,
    ) -> io::Result<Self> {
        writeln!(out, "{}", headings.line(&motion_heads(&table, hinges)))?;
        let in_degrees =
            table.columns.iter().map(|column| table.is_in_degrees(column, hinges)).collect();
        Ok(Self { out, columns: table.columns, in_degrees })
    }

    /// Writes one row.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn write(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let Self { out, columns, in_degrees } = self;
        number(out, snapshot.time)?;
        for (column, &in_degrees) in columns.iter().zip(&*in_degrees) {
            match cell(column, snapshot) {
                Cell::Number(angle) if in_degrees => field(out, angle.to_degrees())?,
                Cell::Number(value) => field(out, value)?,
                Cell::Code(code) => write!(out, ",{code}")?,
            }
        }
        writeln!(out)
    }

    /// Passes everything written so far on to the system.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture;

    fn table(snapshot: &Snapshot) -> String {
        let mut bytes = Vec::new();
        let mut writer = StatesWriter::new(&mut bytes, &fixture::labels()).expect("memory");
        writer.write(snapshot).expect("memory");
        writer.flush().expect("memory");
        String::from_utf8(bytes).expect("text")
    }

    #[test]
    fn header_is_the_contract_s() {
        let text = table(&fixture::snapshot(0.5));
        assert_eq!(
            text.lines().next(),
            Some(
                "t,rho_x,rho_y,rho_z,v_x,v_y,v_z,chi,kappa_x,kappa_y,kappa_z,omega_x,omega_y,\
                 omega_z,beta_1_1,tau_1_1,alpha_1_1,sigma_1_1,state_1_1,beta_1_2,tau_1_2,\
                 alpha_1_2,sigma_1_2,state_1_2,beta_2_1,tau_2_1,alpha_2_1,sigma_2_1,state_2_1,\
                 kinetic_energy,linear_momentum_x,linear_momentum_y,linear_momentum_z,\
                 angular_momentum_x,angular_momentum_y,angular_momentum_z,nutation"
            )
        );
    }

    #[test]
    fn a_scene_without_hinges_has_no_hinge_columns() {
        let mut bytes = Vec::new();
        StatesWriter::new(&mut bytes, &[]).expect("memory");
        assert!(String::from_utf8_lossy(&bytes).contains("omega_z,kinetic_energy"));
    }

    #[test]
    fn values_read_back_equal_and_in_order() {
        let s = fixture::snapshot(0.1 + 0.2);
        let text = table(&s);
        let row = text.lines().nth(1).expect("a row");
        let found: Vec<f64> = row.split(',').map(|f| f.parse().expect("a number")).collect();
        let mut expected = vec![s.time];
        expected.extend(s.position_inertial.to_array());
        expected.extend(s.velocity_inertial.to_array());
        expected.push(s.attitude.scalar);
        expected.extend(s.attitude.vector.to_array());
        expected.extend(s.omega_body.to_array());
        for (i, state) in [(0, -1.0), (1, 0.0), (2, 1.0)] {
            expected.extend([s.beta[i], s.tau[i], s.alpha[i], s.sigma[i], state]);
        }
        expected.push(s.kinetic_energy);
        expected.extend(s.linear_momentum_inertial.to_array());
        expected.extend(s.angular_momentum_inertial.to_array());
        expected.push(s.nutation);
        assert_eq!(found, expected);
    }

    #[test]
    fn a_wanted_table_has_its_columns_and_degrees() {
        let s = fixture::snapshot(0.5);
        let named = |text| Column::named(text, &fixture::labels(), 0).expect("a column");
        let columns = ["omega", "beta_2_1", "state_1_1", "v_y"].map(named).concat();
        let mut bytes = Vec::new();
        let table = WantedTable { columns, in_degrees: true };
        let mut writer =
            StatesWriter::of(&mut bytes, &fixture::labels(), table, &Headings::default())
                .expect("memory");
        writer.write(&s).expect("memory");
        let text = String::from_utf8(bytes).expect("text");
        let (header, row) = text.split_once('\n').expect("two lines");
        assert_eq!(header, "t,omega_x_deg,omega_y_deg,omega_z_deg,beta_2_1_deg,state_1_1,v_y");
        let found: Vec<f64> = row.trim().split(',').map(|f| f.parse().expect("a number")).collect();
        let [x, y, z] = s.omega_body.to_array().map(f64::to_degrees);
        let beta = s.beta[2].to_degrees();
        assert_eq!(found, [0.5, x, y, z, beta, -1.0, s.velocity_inertial.y]);
    }

    #[test]
    fn a_full_disk_is_an_error_and_no_panic() {
        let full = std::fs::File::create("/dev/full").expect("a unix system");
        let refused = StatesWriter::new(full, &[]).expect_err("the disk is full");
        assert_eq!(refused.kind(), io::ErrorKind::StorageFull);
    }
}
