use nboom_model::{External, Gravity, InitialMotion};
use nboom_scalar::{Mat3, Quaternion, Vec3};

use super::builder::Builder;
use super::shown;
use super::values::plain;
use crate::angles;

/// Deviation from a rotation, or from length 1, that counts as rounding in the deck.
const ROTATION_TOLERANCE: f64 = 1e-6;

impl Builder<'_, '_, '_> {
    /// Inertial position and velocity of O along inertial axes, from the components RHO along
    /// body axes and their derivatives VBAR: v = VBAR + ω × RHO.
    pub fn initial_motion(&mut self) -> InitialMotion {
        let attitude = self.attitude();
        let rot_inertial_from_body = attitude.to_matrix();
        let omega_body = angles::vector_to_radians(self.values.vector("OMEG", 0));
        let rho_body = self.values.vector("RHO", 0);
        let velocity_body = self.values.vector("VBAR", 0) + omega_body.cross(rho_body);
        InitialMotion {
            time: self.values.real("TZO", 0),
            attitude,
            position_inertial: rot_inertial_from_body * rho_body,
            velocity_inertial: rot_inertial_from_body * velocity_body,
            omega_body,
        }
    }

    /// M(0) of eq. (9.7) or EMO, times C of the Euler parameters, eq. (9.13).
    fn attitude(&mut self) -> Quaternion<f64> {
        let initial = match self.values.real("IXYZ", 0) {
            0.0 => {
                let [psi, theta, phi] = self.values.vector("FTSM", 0).to_array();
                angles::rotation_from_degrees(psi, theta, phi)
            }
            1.0 => self.given_axes(),
            other => {
                self.error(plain("IXYZ"), 0, shown(other), "0 or 1");
                Mat3::identity()
            }
        };
        let initial = Quaternion::from_matrix(&initial);
        match self.euler_parameters() {
            Some(turn) => with_positive_scalar(initial.compose(turn).normalized()),
            None => initial,
        }
    }

    fn given_axes(&mut self) -> Mat3<f64> {
        if (0..9).any(|i| self.values.get("EMO", i).is_none()) {
            return Mat3::identity();
        }
        let axis = |j| self.values.vector("EMO", j);
        let axes = Mat3::from_columns(axis(0), axis(1), axis(2));
        let defect = axes.rotation_defect();
        if defect <= ROTATION_TOLERANCE {
            return axes;
        }
        let found = format!("axes that depart from a rotation by {}", shown(defect));
        let at = self.values.position(plain("EMO"), 0);
        self.report.error(at, "EMO", found, "three right-handed orthogonal unit vectors");
        Mat3::identity()
    }

    /// The Euler parameters, if they are not those of no rotation.
    fn euler_parameters(&mut self) -> Option<Quaternion<f64>> {
        let scalar = self.values.get("X", 0).unwrap_or(1.0);
        let vector = self.values.vector("EKBAR", 0);
        if scalar == 1.0 && vector == Vec3::zero() {
            return None;
        }
        let given = Quaternion { scalar, vector };
        let length = given.norm_squared().sqrt();
        let symbol = if self.values.is_given("X") { "X" } else { "EKBAR" };
        let at = self.values.position(plain(symbol), 0);
        if (length - 1.0).abs() <= ROTATION_TOLERANCE {
            let expected = "X=1.0 and EKBAR=3*0.0; the initial orientation is turned by them";
            self.report.warn(at, symbol, "other Euler parameters", expected);
            return Some(given.normalized());
        }
        let found = format!("Euler parameters of norm {}", shown(length));
        self.report.error(at, symbol, found, "X=1.0 and EKBAR=3*0.0, or norm 1");
        None
    }

    pub fn gravity(&mut self) -> Option<Gravity> {
        let Some(acceleration) = self.positive_magnitude("G") else {
            self.warn_ignored_elements(plain("GHAT"), 0..3, "G is 0");
            return None;
        };
        Some(Gravity { acceleration, up: self.unit_vector("GHAT")? })
    }

    pub fn thrust(&mut self) -> Option<External> {
        let Some(magnitude) = self.positive_magnitude("FT") else {
            for (name, count) in [("FTHAT", 3), ("FTBAR", 3), ("TINT", 1), ("TFIN", 1)] {
                self.warn_ignored_elements(plain(name), 0..count, "FT is 0");
            }
            return None;
        };
        let direction = self.unit_vector("FTHAT")?;
        let (on, off) = (self.values.real("TINT", 0), self.values.real("TFIN", 0));
        if on == off {
            let found = format!("a thrust from TINT = {} to {}", shown(on), shown(off));
            self.warn(plain("TFIN"), 0, found, "a later end; the thrust never acts");
        }
        let point = self.values.vector("FTBAR", 0);
        Some(External::thrust(direction * magnitude, point, [on, off]))
    }

    /// A magnitude, of which zero means that there is none.
    fn positive_magnitude(&mut self, name: &'static str) -> Option<f64> {
        let magnitude = self.values.real(name, 0);
        if magnitude < 0.0 {
            let expected = "none below zero; turn the unit vector round";
            self.error(plain(name), 0, shown(magnitude), expected);
        }
        (magnitude > 0.0).then_some(magnitude)
    }
}

fn with_positive_scalar(q: Quaternion<f64>) -> Quaternion<f64> {
    if q.scalar < 0.0 {
        return Quaternion { scalar: -q.scalar, vector: -q.vector };
    }
    q
}
