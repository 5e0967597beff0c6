use std::f64::consts::{FRAC_PI_2, PI};

use nboom_scalar::Wrench;

use crate::harmonics::Harmonics;
use crate::stress::norm;
use crate::{Point, PointStress, Properties, SecondMoments, SectionError, SectionWarning, Stress};

/// A circular tube around the η axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    radius: f64,
    thickness: f64,
}

/// Exact properties of a tube, whose wall need not be thin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Annulus {
    /// Area.
    pub area: f64,
    /// Second moment of area about any axis through the centre.
    pub inertia: f64,
    /// Torsion constant, the polar second moment.
    pub torsion_constant: f64,
}

impl Tube {
    /// θ of the report's axis points.
    pub const AXIS_ANGLES: [f64; 4] = [0.0, FRAC_PI_2, PI, 1.5 * PI];

    /// The tube with this radius of the middle of its wall, and this thickness.
    ///
    /// # Errors
    /// A radius that is not positive; a thickness that is not, or is above the radius.
    pub fn new(radius: f64, thickness: f64) -> Result<Self, SectionError> {
        let is_positive = radius > 0.0 && radius.is_finite();
        if !is_positive {
            return Err(SectionError::Radius { radius });
        }
        let is_a_wall = thickness > 0.0 && thickness <= radius;
        if !is_a_wall {
            return Err(SectionError::TubeThickness { thickness, radius });
        }
        let tube = Self { radius, thickness };
        if tube.properties().are_regular() { Ok(tube) } else { Err(SectionError::Range) }
    }

    /// Radius of the middle line.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Thickness of the wall.
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Its properties, with all area on the middle line; eq. (12.1).
    pub fn properties(&self) -> Properties {
        let (r, t) = (self.radius, self.thickness);
        let moment = PI * r * r * r * t;
        let inertia = SecondMoments { xi_xi: moment, zeta_zeta: moment, xi_zeta: 0.0 };
        Properties {
            area: 2.0 * PI * r * t,
            centroid: Point::ORIGIN,
            inertia,
            centreline_inertia: inertia,
            enclosed_area: PI * r * r,
            torsion_constant: 2.0 * moment,
            shear_centre: Point::ORIGIN,
        }
    }

    /// S = 2πR²t: the moment about η that causes unit shear stress.
    pub fn torsion_modulus(&self) -> f64 {
        2.0 * PI * self.radius * self.radius * self.thickness
    }

    /// Its exact properties, without thin-wall theory.
    pub fn annulus(&self) -> Annulus {
        let (r, t) = (self.radius, self.thickness);
        let area = 2.0 * PI * r * t;
        let inertia = 0.5 * area * (r * r + 0.25 * t * t);
        Annulus { area, inertia, torsion_constant: 2.0 * inertia }
    }

    /// Whether thin-wall theory may not hold.
    pub fn warnings(&self) -> Vec<SectionWarning> {
        SectionWarning::of_tube(self.thickness / self.radius).into_iter().collect()
    }

    /// The stresses that these numbers describe, see [`TubeStresses::numbers`].
    pub fn described_by(&self, [a, b, c, d, e, f]: [f64; 6]) -> TubeStresses {
        TubeStresses { radius: self.radius, normal: [a, b, c], shear: [d, e, f] }
    }

    /// The stresses under a load: force and moment, about the point on the η axis, that act on the
    /// part outboard of the section.
    pub fn stresses(&self, load: &Wrench<f64>) -> TubeStresses {
        let Wrench { force, moment } = *load;
        let Properties { area, inertia, .. } = self.properties();
        let (bending, shear) = (self.radius / inertia.xi_xi, 2.0 / area);
        // The face that points outboard belongs to the inboard part, so it bears the reaction.
        TubeStresses {
            radius: self.radius,
            normal: [-force.y / area, -moment.z * bending, moment.x * bending],
            shear: [moment.y / self.torsion_modulus(), -force.z * shear, force.x * shear],
        }
    }
}

/// Stresses in a tube under one load; θ is the angle from ξ towards ζ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeStresses {
    /// Radius of the middle line.
    radius: f64,
    /// Normal stress: coefficients of 1, cos θ and sin θ; eq. (11.3), corrected: note 21.
    pub normal: [f64; 3],
    /// Shear stress along increasing θ: coefficients of 1, cos θ and sin θ. It is tangential all
    /// around, unlike that of eqs. (11.1), (11.2) and (11.4), note 21.
    pub shear: [f64; 3],
}

impl TubeStresses {
    /// The coefficients of normal and shear stress, linear in the load.
    pub fn numbers(&self) -> [f64; 6] {
        let ([a, b, c], [d, e, f]) = (self.normal, self.shear);
        [a, b, c, d, e, f]
    }

    /// The stress at θ.
    pub fn at(&self, theta: f64) -> PointStress {
        let (sin, cos) = theta.sin_cos();
        self.towards(cos, sin)
    }

    /// The stresses at the report's axis points, where sines and cosines are exact.
    pub fn axis_points(&self) -> [PointStress; 4] {
        [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(cos, sin)| self.towards(cos, sin))
    }

    fn towards(&self, cos: f64, sin: f64) -> PointStress {
        let value = |[a, b, c]: [f64; 3]| a + b * cos + c * sin;
        let shear = value(self.shear);
        let stress =
            Stress { normal: value(self.normal), shear_xi: -shear * sin, shear_zeta: shear * cos };
        let place = Point { xi: self.radius * cos, zeta: self.radius * sin };
        PointStress { place, wall: None, stress }
    }

    /// Whether the von Mises stress is nowhere above `level`; a bound may show that without a search.
    pub fn is_at_most(&self, level: f64) -> bool {
        let most = |[a, b, c]: [f64; 3]| a.abs() + norm([b, c]);
        let bound = norm([most(self.normal), 3.0_f64.sqrt() * most(self.shear)]);
        bound <= level || self.at(self.max_von_mises()).stress.von_mises() <= level
    }

    /// The θ at which the von Mises stress is largest, from 0 to 2π.
    pub fn max_von_mises(&self) -> f64 {
        let coefficients = self.normal.iter().chain(&self.shear);
        let unit = coefficients.fold(f64::MIN_POSITIVE, |most, c| most.max(c.abs()));
        let square = |form: [f64; 3]| Harmonics::of_square(form.map(|c| c / unit));
        (square(self.normal) + square(self.shear) * 3.0).largest()
    }
}
