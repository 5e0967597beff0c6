use crate::{Point, Wall};

/// Properties of a section, independent of the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// Area of the walls \[L²\], eqs. (12.1) and (12.2).
    pub area: f64,
    /// Their centroid, from the η axis, eq. (12.3).
    pub centroid: Point,
    /// Second moments of area about the centroid \[L⁴\]; for a polygon including the thickness of
    /// its walls.
    pub inertia: SecondMoments,
    /// Centre-line moments: second moments of area with all area on the middle line of the walls.
    pub centreline_inertia: SecondMoments,
    /// Area inside the middle line \[L²\], not negative; eq. (12.9), corrected: note 23.
    pub enclosed_area: f64,
    /// Torsion constant J of Bredt's second formula, 4 A² / ∮ ds/t \[L⁴\].
    pub torsion_constant: f64,
    /// Shear centre, the point through which a shear force causes no twist, from the η axis.
    pub shear_centre: Point,
}

impl Properties {
    /// Whether all are finite, and those that must be are positive.
    pub(crate) fn are_regular(&self) -> bool {
        let positive = |value: f64| value > 0.0 && value.is_finite();
        positive(self.area)
            && positive(self.inertia.determinant())
            && positive(self.centreline_inertia.determinant())
            && positive(self.torsion_constant)
            && self.shear_centre.is_finite()
    }
}

/// Second moments of area about the centroid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SecondMoments {
    /// I_ξξ = ∫ ζ′² dA, about the ξ axis.
    pub xi_xi: f64,
    /// I_ζζ = ∫ ξ′² dA, about the ζ axis.
    pub zeta_zeta: f64,
    /// I_ξζ = + ∫ ξ′ ζ′ dA.
    pub xi_zeta: f64,
}

impl SecondMoments {
    /// The largest and the smallest second moment about any axis through the centroid.
    pub fn principal(self) -> [f64; 2] {
        let mean = 0.5 * (self.xi_xi + self.zeta_zeta);
        let radius = (0.5 * (self.xi_xi - self.zeta_zeta)).hypot(self.xi_zeta);
        [mean + radius, mean - radius]
    }

    /// The axis of the largest one, as an angle from ξ towards ζ between −π/2 and π/2; meaningless
    /// where both are equal.
    pub fn principal_angle(self) -> f64 {
        0.5 * (-2.0 * self.xi_zeta).atan2(self.xi_xi - self.zeta_zeta)
    }

    pub(crate) fn determinant(self) -> f64 {
        self.xi_xi * self.zeta_zeta - self.xi_zeta * self.xi_zeta
    }

    /// Those of a wall about `centroid`, eqs. (12.4) to (12.6), with `own` times its thickness.
    pub(crate) fn of_wall(wall: &Wall, centroid: Point, own: f64) -> Self {
        let (area, way, t) = (wall.area(), wall.along(), own * wall.thickness());
        let middle = wall.at(0.5) - centroid;
        let unit = way * (1.0 / wall.length());
        let across = t * t / 12.0;
        Self {
            xi_xi: area
                * (middle.zeta * middle.zeta
                    + way.zeta * way.zeta / 12.0
                    + across * unit.xi * unit.xi),
            zeta_zeta: area
                * (middle.xi * middle.xi + way.xi * way.xi / 12.0 + across * unit.zeta * unit.zeta),
            xi_zeta: area
                * (middle.xi * middle.zeta + way.xi * way.zeta / 12.0
                    - across * unit.xi * unit.zeta),
        }
    }

    /// The sum over all walls.
    pub(crate) fn of_walls(walls: &[Wall], centroid: Point, own: f64) -> Self {
        let zero = Self { xi_xi: 0.0, zeta_zeta: 0.0, xi_zeta: 0.0 };
        walls.iter().map(|wall| Self::of_wall(wall, centroid, own)).fold(zero, |sum, one| Self {
            xi_xi: sum.xi_xi + one.xi_xi,
            zeta_zeta: sum.zeta_zeta + one.zeta_zeta,
            xi_zeta: sum.xi_zeta + one.xi_zeta,
        })
    }

    /// The (a, b) of the linear stress a ξ′ + b ζ′ with these first moments along ξ′ and ζ′.
    pub(crate) fn solve(self, of_xi: f64, of_zeta: f64) -> Point {
        let determinant = self.determinant();
        Point {
            xi: (of_xi * self.xi_xi - of_zeta * self.xi_zeta) / determinant,
            zeta: (of_zeta * self.zeta_zeta - of_xi * self.xi_zeta) / determinant,
        }
    }
}
