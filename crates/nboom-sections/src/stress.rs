use crate::Point;

/// Stress on a face whose normal points outboard, along η; tension is positive.
///
/// The other components vanish in the wall of a thin-walled beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stress {
    /// σ_ηη, positive in tension.
    pub normal: f64,
    /// σ_ηξ.
    pub shear_xi: f64,
    /// σ_ηζ.
    pub shear_zeta: f64,
}

impl Stress {
    /// Magnitude of the shear stress.
    pub fn shear(self) -> f64 {
        norm([self.shear_xi, self.shear_zeta])
    }

    /// Equivalent stress √(σ² + 3 τ²): that of the distortion energy, eqs. (11.5), (11.6) and
    /// (11.16).
    pub fn von_mises(self) -> f64 {
        let factor = 3.0_f64.sqrt();
        norm([self.normal, factor * self.shear_xi, factor * self.shear_zeta])
    }

    /// The largest and the smallest principal stress; the third one is zero.
    pub fn principal(self) -> [f64; 2] {
        let mean = 0.5 * self.normal;
        let radius = norm([mean, self.shear_xi, self.shear_zeta]);
        [mean + radius, mean - radius]
    }

    /// The report's components (σ₂₂, σ₂₁, σ₂₃): the traction on the outboard part along η, ξ and ζ,
    /// for which compression is positive. Only this and [`Stress::of_report_signs`] change signs
    /// between the two conventions.
    pub fn in_report_signs(self) -> [f64; 3] {
        [-self.normal, -self.shear_xi, -self.shear_zeta]
    }

    /// The stress that has these components in the report.
    pub fn of_report_signs([normal, shear_xi, shear_zeta]: [f64; 3]) -> Self {
        Self { normal: -normal, shear_xi: -shear_xi, shear_zeta: -shear_zeta }
    }
}

/// Range in which sums of squares lose no digit that matters; `f64::hypot` is slow.
const SAFE_SQUARES: std::ops::Range<f64> = 1e-270..1e300;

/// √(a² + b² + …), also where squares overflow or vanish.
pub(crate) fn norm<const N: usize>(components: [f64; N]) -> f64 {
    let squares: f64 = components.iter().map(|c| c * c).sum();
    if SAFE_SQUARES.contains(&squares) {
        return squares.sqrt();
    }
    components.into_iter().fold(0.0, f64::hypot)
}

/// Stress at a point of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointStress {
    /// Where, from the η axis.
    pub place: Point,
    /// On which wall of a polygon, from 0. Where walls meet, shear stress depends on it.
    pub wall: Option<usize>,
    /// The stress.
    pub stress: Stress,
}
