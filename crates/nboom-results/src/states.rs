use std::io::{self, Write};

use nboom_model::HingeLabel;
use nboom_sim::Snapshot;

use crate::number::{field, number, vector_fields};
use crate::quantities::{AFTER_HINGES, BEFORE_HINGES, OF_A_HINGE, Quantity, Value};

/// Writes the table of states, one row for each output time.
///
/// Position and velocity of O along inertial axes, rates along main-body axes, angles in
/// radians.
#[derive(Debug)]
pub struct StatesWriter<W> {
    out: W,
}

impl<W: Write> StatesWriter<W> {
    /// Writes the header for hinges with these labels.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn new(mut out: W, hinges: &[HingeLabel]) -> io::Result<Self> {
        let columns = |of: &'static [Quantity]| of.iter().flat_map(|quantity| quantity.columns);
        write!(out, "t")?;
        columns(&BEFORE_HINGES).try_for_each(|name| write!(out, ",{name}"))?;
        for label in hinges {
            let [k, i] = label.numbers();
            columns(&OF_A_HINGE).try_for_each(|name| write!(out, ",{name}_{k}_{i}"))?;
        }
        columns(&AFTER_HINGES).try_for_each(|name| write!(out, ",{name}"))?;
        writeln!(out)?;
        Ok(Self { out })
    }

    /// Writes one row.
    ///
    /// # Errors
    /// When `out` refuses it.
    pub fn write(&mut self, snapshot: &Snapshot) -> io::Result<()> {
        let of_hinges =
            (0..snapshot.hinges.len()).flat_map(|i| OF_A_HINGE.iter().map(move |q| (q, i)));
        let of_satellite = |quantities: &'static [Quantity]| quantities.iter().map(|q| (q, 0));
        let quantities =
            of_satellite(&BEFORE_HINGES).chain(of_hinges).chain(of_satellite(&AFTER_HINGES));
        let out = &mut self.out;
        number(out, snapshot.time)?;
        for (quantity, hinge) in quantities {
            match quantity.value {
                Value::Number(value) => field(out, value(snapshot))?,
                Value::Vector(value) => vector_fields(out, value(snapshot))?,
                Value::OfHinge(value) => field(out, value(snapshot, hinge))?,
                Value::CodeOfHinge(value) => write!(out, ",{}", value(snapshot, hinge))?,
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
    fn a_full_disk_is_an_error_and_no_panic() {
        let full = std::fs::File::create("/dev/full").expect("a unix system");
        let refused = StatesWriter::new(full, &[]).expect_err("the disk is full");
        assert_eq!(refused.kind(), io::ErrorKind::StorageFull);
    }
}
