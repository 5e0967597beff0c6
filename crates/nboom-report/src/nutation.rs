//! Nutation about the axis about which a main body spins, which need not be its x axis.

use nboom_scalar::{Quaternion, Vec3};

use crate::Run;
use crate::table::Table;

/// Share of the largest angular momentum of a motion that one must have to say which axis is meant.
const TELLING: f64 = 0.5;

/// How much more than that along the axes before it a momentum along an axis must be.
const MORE: f64 = 1.0 + 1e-9;

/// An axis of the main body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpinAxis {
    /// The first, to which the tables refer nutation.
    #[default]
    X,
    /// The second.
    Y,
    /// The third.
    Z,
}

impl SpinAxis {
    /// All, in order.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// Its number, from 0.
    pub fn number(self) -> usize {
        self as usize
    }
}

impl Run {
    /// The main body's axis along which most of the angular momentum is when it first has half of its largest size. The
    /// nutation of [`motion`](Self::motion) is the angle between both.
    pub fn spin_axis(&self) -> SpinAxis {
        self.spin_axis
    }
}

/// The axis, about which the nutation of the motion then is.
pub(crate) fn about_spin_axis(motion: &mut Table) -> SpinAxis {
    let Some(momenta) = momenta(motion) else { return SpinAxis::default() };
    let largest = momenta.iter().map(|momentum| momentum.norm()).fold(0.0, f64::max);
    let is_telling = |momentum: &&Vec3<f64>| momentum.norm() >= TELLING * largest;
    let Some(first) = momenta.iter().find(is_telling) else { return SpinAxis::default() };
    let share = |axis: SpinAxis| first.to_array()[axis.number()].abs();
    let longer = |known, axis| if share(axis) > MORE * share(known) { axis } else { known };
    let axis = SpinAxis::ALL.into_iter().fold(SpinAxis::default(), longer);
    let place = motion.names.iter().position(|name| name == "nutation");
    if let Some(place) = place.filter(|_| axis != SpinAxis::X) {
        let angle = |momentum: &Vec3<f64>| {
            let parts = momentum.to_array();
            let [along, a, b] = [0, 1, 2].map(|i| parts[(axis.number() + i) % 3]);
            a.hypot(b).atan2(along)
        };
        motion.columns[place] = momenta.iter().map(angle).collect();
    }
    axis
}

/// Angular momenta in the rows of a motion, main-body axes.
fn momenta(motion: &Table) -> Option<Vec<Vec3<f64>>> {
    let momentum = vector(motion, "angular_momentum")?;
    let attitude = vector(motion, "kappa")?;
    let scalar = motion.column("chi")?;
    let of_row = |row: usize| {
        let [momentum, vector] =
            [momentum, attitude].map(|parts| Vec3::from(parts.map(|part| part[row])));
        let attitude = Quaternion { scalar: scalar[row], vector };
        attitude.normalized().to_matrix().transpose() * momentum
    };
    Some((0..motion.rows()).map(of_row).collect())
}

fn vector<'t>(motion: &'t Table, name: &str) -> Option<[&'t [f64]; 3]> {
    let [x, y, z] = ["x", "y", "z"].map(|axis| motion.column(&format!("{name}_{axis}")));
    Some([x?, y?, z?])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A motion with this momentum, inertial axes, of a body that is turned by 90 degrees about x: its y axis is
    /// the inertial z axis, its z axis the inertial −y axis.
    fn turned(momenta: &[[f64; 3]]) -> Table {
        let half = 0.5_f64.sqrt();
        let names = "t chi kappa_x kappa_y kappa_z angular_momentum_x angular_momentum_y angular_momentum_z nutation";
        let mut table = Table::new(names.split(' ').map(str::to_owned).collect());
        for (row, [x, y, z]) in momenta.iter().enumerate() {
            table.push(&[row as f64, half, half, 0.0, 0.0, *x, *y, *z, 1.25]);
        }
        table
    }

    fn nutation(momenta: &[[f64; 3]]) -> (SpinAxis, Vec<f64>) {
        let mut motion = turned(momenta);
        let axis = about_spin_axis(&mut motion);
        (axis, motion.column("nutation").expect("a column").to_vec())
    }

    #[test]
    fn nutation_is_about_the_axis_of_most_momentum_and_about_x_as_in_the_table() {
        assert_eq!(nutation(&[[2.0, 1.0, 0.0]]), (SpinAxis::X, vec![1.25]));
        assert_eq!(nutation(&[[1.0, 1.0, 1.0]]), (SpinAxis::X, vec![1.25]));
        let (axis, angles) = nutation(&[[1.0, 0.0, 3.0], [0.0, 3.0, 3.0]]);
        assert_eq!(axis, SpinAxis::Y);
        let expected = [(1.0_f64 / 3.0).atan(), std::f64::consts::FRAC_PI_4];
        assert!(angles.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{angles:?}");
        let (axis, angles) = nutation(&[[0.0, 2.0, 0.0]]);
        assert_eq!(axis, SpinAxis::Z);
        assert!((angles[0] - std::f64::consts::PI).abs() < 1e-15, "it spins about −z: {angles:?}");
    }

    #[test]
    fn a_momentum_far_below_the_largest_says_nothing_of_the_axis() {
        assert_eq!(nutation(&[[0.0, 0.0, 1e-15], [4.0, 0.0, 0.0]]).0, SpinAxis::X);
        assert_eq!(nutation(&[[0.0; 3]]), (SpinAxis::X, vec![1.25]));
    }
}
