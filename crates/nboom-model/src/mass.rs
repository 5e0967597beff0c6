use nboom_scalar::{RigidInertia, Sym3, Vec3};

use crate::{Finding, shown};

/// Share of the largest principal moment by which an inertia may miss the triangle inequality.
pub const TRIANGLE_TOLERANCE: f64 = 1e-9;

/// Share of the largest entry of the inertia about the origin, J + m r², below which moments about the mass centre
/// may have any sign.
///
/// The equations take J + m r². Each entry of this sum is rounded by up to ½ ε of it; no symmetric 3×3 matrix has a
/// moment above three times its largest entry, so its moments are rounded by up to 1½ ε of the largest. What is less in
/// J is lost there, but for moments about the line from the origin to the mass centre. These decide nothing either: a
/// run refuses a hinge about which there is less than 64 ε of all inertia at it.
const ROUNDING_ABOUT_ORIGIN: f64 = 2.0 * f64::EPSILON;

/// Mass, mass centre and inertia of one rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Mass.
    pub mass: f64,
    /// Mass centre from the body's origin (its hinge; the main body's O), body axes.
    pub center_of_mass: Vec3<f64>,
    /// Inertia about the mass centre, body axes; products carry the tensor's sign (−∫xy dm).
    pub inertia: Sym3<f64>,
}

/// Why mass properties are not those of a body.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.finding())]
#[non_exhaustive]
pub enum MassDefect {
    /// The mass is zero, negative or not finite.
    Mass(f64),
    /// A component of the mass centre is not finite.
    CenterOfMass(Vec3<f64>),
    /// An entry of the inertia is not finite.
    InertiaNotFinite,
    /// Mass times the distance of the mass centre, or times its square, is beyond all numbers.
    Overflow {
        /// The mass.
        mass: f64,
        /// Distance of the mass centre from the body's origin.
        distance: f64,
    },
    /// A principal moment of inertia is negative.
    NegativeMoment(f64),
    /// The largest principal moment exceeds the sum of the two others.
    Triangle([f64; 3]),
    /// A body has inertia but no mass, and slides.
    WheelSlides,
    /// A body has inertia but no mass, and others hang on it.
    WheelCarries,
    /// A body has inertia but no mass, and it is no wheel.
    WheelInertia,
}

impl MassDefect {
    /// What was found and what expected.
    pub fn finding(&self) -> Finding {
        match self {
            Self::Mass(mass) => {
                Finding::new(format!("mass {}", shown(*mass)), "a positive finite mass")
            }
            Self::CenterOfMass(center) => {
                let components = center.to_array().map(shown).join(", ");
                Finding::new(format!("mass centre ({components})"), "finite components")
            }
            Self::InertiaNotFinite => {
                Finding::new("inertia with an entry that is not finite", "finite entries")
            }
            Self::Overflow { mass, distance } => Finding::new(
                format!("mass {mass:e} with mass centre {distance:e} away"),
                "finite moments about the origin",
            ),
            Self::NegativeMoment(moment) => Finding::new(
                format!("principal moment of inertia {}", shown(*moment)),
                "none below zero",
            ),
            Self::Triangle(moments) => Finding::new(
                format!("principal moments of inertia {}", moments.map(shown).join(", ")),
                "the largest at most the sum of the two others",
            ),
            Self::WheelSlides => {
                Finding::new("a slide of a body with inertia but no mass", "a hinge or a mass")
            }
            Self::WheelCarries => {
                Finding::new("inertia of a body without mass that carries others", "none or a mass")
            }
            Self::WheelInertia => Finding::new(
                "inertia of a body without mass that is not about its hinge axis alone",
                "a positive one that is, or a mass",
            ),
        }
    }
}

impl MassProperties {
    /// Mass, mass centre (from the body's origin) and inertia (about the mass centre), the two
    /// latter in body axes.
    pub fn new(mass: f64, center_of_mass: Vec3<f64>, inertia: Sym3<f64>) -> Self {
        Self { mass, center_of_mass, inertia }
    }

    /// Neither mass nor inertia, with the mass centre at the origin.
    pub fn nothing() -> Self {
        Self { mass: 0.0, center_of_mass: Vec3::zero(), inertia: Sym3::zero() }
    }

    /// Whether there is neither mass nor inertia.
    pub fn is_nothing(&self) -> bool {
        self.mass == 0.0 && self.inertia == Sym3::zero() && self.center_of_mass.is_finite()
    }

    /// Whether there is no mass, but inertia about `axis` (a unit vector) alone: of a wheel whose mass and whose
    /// inertia across the axis belong to its carrier.
    pub fn is_wheel(&self, axis: Vec3<f64>) -> bool {
        let about_axis = axis.dot(self.inertia * axis);
        let rest = self.inertia + Sym3::outer(axis) * -about_axis;
        self.mass == 0.0
            && self.center_of_mass.is_finite()
            && (about_axis > 0.0 && about_axis.is_finite())
            && rest.largest_entry() <= TRIANGLE_TOLERANCE * about_axis
    }

    /// This body and `other`, which has the same origin and axes, as one.
    ///
    /// The mass centre of two bodies without mass is that of `other`.
    pub fn joined_with(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        let share = if mass > 0.0 { other.mass / mass } else { 1.0 };
        let between = other.center_of_mass - self.center_of_mass;
        // Both offsets from the common centre are parts of `between`: m₁r² + m₂s² = m₁m₂d²/m.
        let offsets = Sym3::across(between, between) * (share * self.mass);
        Self {
            mass,
            center_of_mass: self.center_of_mass + between * share,
            inertia: self.inertia + other.inertia + offsets,
        }
    }

    /// Principal moments of inertia about the mass centre, ascending.
    pub fn principal_moments(&self) -> [f64; 3] {
        let i = &self.inertia;
        let matrix = nalgebra::Matrix3::new(
            i.xx, i.xy, i.xz, //
            i.xy, i.yy, i.yz, //
            i.xz, i.yz, i.zz,
        );
        let mut moments: [f64; 3] = matrix.symmetric_eigenvalues().into();
        moments.sort_by(f64::total_cmp);
        moments
    }

    /// The first reason why no rigid body has these properties, if there is one.
    pub fn defect(&self) -> Option<MassDefect> {
        if !(self.mass > 0.0 && self.mass.is_finite()) {
            return Some(MassDefect::Mass(self.mass));
        }
        self.defect_apart_from_mass()
    }

    /// The first defect of the other numbers; the mass must be finite and not negative.
    pub fn defect_apart_from_mass(&self) -> Option<MassDefect> {
        if !self.center_of_mass.is_finite() {
            return Some(MassDefect::CenterOfMass(self.center_of_mass));
        }
        if !self.inertia.is_finite() {
            return Some(MassDefect::InertiaNotFinite);
        }
        let about_origin = RigidInertia::new(self.mass, self.center_of_mass, self.inertia);
        if !(about_origin.first_moment.is_finite() && about_origin.about_origin.is_finite()) {
            let [x, y, z] = self.center_of_mass.to_array();
            let distance = x.hypot(y).hypot(z);
            return Some(MassDefect::Overflow { mass: self.mass, distance });
        }
        let moments = self.principal_moments();
        let slack = TRIANGLE_TOLERANCE * moments[2].abs()
            + ROUNDING_ABOUT_ORIGIN * about_origin.about_origin.largest_entry();
        if moments[0] < -slack {
            return Some(MassDefect::NegativeMoment(moments[0]));
        }
        if moments[2] - moments[1] - moments[0] > slack {
            return Some(MassDefect::Triangle(moments));
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_inertia(xx: f64, yy: f64, zz: f64) -> Option<MassDefect> {
        MassProperties::new(1.0, Vec3::zero(), Sym3::diagonal(xx, yy, zz)).defect()
    }

    #[test]
    fn a_plate_at_equality_is_a_body_and_beyond_it_is_not() {
        assert_eq!(with_inertia(45.0, 40.0, 85.0), None);
        assert_eq!(with_inertia(45.0, 40.0, 85.0 * (1.0 + 0.9e-9)), None);
        assert!(matches!(
            with_inertia(45.0, 40.0, 85.0 * (1.0 + 2e-9)),
            Some(MassDefect::Triangle(_))
        ));
        assert!(matches!(with_inertia(-1.0, 2.0, 2.0), Some(MassDefect::NegativeMoment(_))));
    }

    #[test]
    fn a_point_mass_is_a_body() {
        assert_eq!(with_inertia(0.0, 0.0, 0.0), None);
    }

    /// The head of a humanoid, whose tensor is zero but for rounding, and what its mass centre lets pass.
    #[test]
    fn a_point_mass_may_have_rounding_of_its_moments_about_the_origin() {
        let head = |x, share: f64, of: Sym3<f64>| {
            let (mass, center) = (1.33687, Vec3::new(x, -0.1108, 0.0));
            let about_origin = mass * center.dot(center);
            MassProperties::new(mass, center, of * (share * f64::EPSILON * about_origin)).defect()
        };
        let product = Sym3 { xz: 1.0, ..Sym3::zero() };
        let xz = Sym3 { xz: 2.40741e-35, ..Sym3::zero() };
        let of_file = MassProperties::new(1.33687, Vec3::new(0.0185, -0.1108, 0.0), xz);
        assert_eq!(of_file.defect(), None);
        let one_moment = Sym3::diagonal(0.0, 0.0, 1.0);
        let negative = Sym3::diagonal(-1.0, -1.0, -1.0);
        for of in [product, one_moment, negative] {
            assert_eq!(head(0.0185, 1.0, of), None);
            assert!(head(0.0185, 10.0, of).is_some());
        }
        // Its moments about itself are all that a body has that is not away from the origin.
        for of in [product, one_moment, negative] {
            assert!(MassProperties::new(1.33687, Vec3::zero(), of * 2.4e-35).defect().is_some());
        }
    }

    #[test]
    fn principal_moments_do_not_depend_on_the_axes() {
        let rot = nboom_scalar::Mat3::from_euler_121(0.3, 1.2, -2.0);
        let inertia = Sym3::diagonal(1.0, 2.0, 2.5).rotated(&rot);
        let moments = MassProperties::new(1.0, Vec3::zero(), inertia).principal_moments();
        for (found, expected) in moments.iter().zip([1.0, 2.0, 2.5]) {
            assert!((found - expected).abs() < 1e-14);
        }
    }

    #[test]
    fn a_body_whose_moments_overflow_is_refused() {
        let inertia = Sym3::diagonal(1.0, 1.0, 1.0);
        for (mass, distance, is_body) in
            [(1e100, 1e80, true), (1e200, 1e80, false), (1.0, 1e160, false), (1e200, 1e120, false)]
        {
            let body = MassProperties::new(mass, Vec3::unit_y() * distance, inertia);
            let told = MassDefect::Overflow { mass, distance };
            assert_eq!(body.defect(), (!is_body).then_some(told), "{mass:e} at {distance:e}");
        }
    }

    #[test]
    fn two_points_make_a_rod_without_mass() {
        let point = |mass, y| MassProperties::new(mass, Vec3::unit_y() * y, Sym3::zero());
        let rod = point(1.0, 2.0).joined_with(&point(3.0, 6.0));
        assert_eq!((rod.mass, rod.center_of_mass), (4.0, Vec3::unit_y() * 5.0));
        assert_eq!(rod.inertia, Sym3::diagonal(9.0 + 3.0, 0.0, 9.0 + 3.0));

        // The small inertia about the long axis keeps its digits.
        let slender =
            |y| MassProperties { inertia: Sym3::diagonal(1.0, 0.01, 1.0), ..point(3.0, y) };
        assert_eq!(slender(0.1).joined_with(&slender(0.8)).inertia.yy, 0.02);

        let nothing = point(0.0, 2.0).joined_with(&point(0.0, 6.0));
        assert_eq!((nothing.mass, nothing.center_of_mass), (0.0, Vec3::unit_y() * 6.0));
    }

    #[test]
    fn impossible_masses_are_refused() {
        for mass in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let body = MassProperties::new(mass, Vec3::zero(), Sym3::diagonal(1.0, 1.0, 1.0));
            assert!(matches!(body.defect(), Some(MassDefect::Mass(_))));
        }
    }
}
